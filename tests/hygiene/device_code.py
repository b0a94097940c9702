#!/usr/bin/python3
"""Code that will run on a GPU: mistakes that a CPU does not show, found in the text of kernels/ and src/.

It reads names, not types; nvcc (scripts/check_cuda.sh) sees more. First every deliberate mistake of WRONG must be
reported by its rule, and nothing of RIGHT by any."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
WHY = {
    "marked": "nvcc compiles for the device only what has a KOKKOS_ mark; constexpr is none",
    "std": "functions and containers of std are for the host; Kokkos:: has the mathematics, min, max, swap, Array",
    "words": "a device has no exceptions, no heap, no type information and no static variables",
    "members": "a functor is copied byte by byte: references, containers, host views and virtual functions stay behind",
    "this": "a KOKKOS_LAMBDA that names a member captures this, an address of the host",
    "lambdas": "what is launched is a functor or a KOKKOS_LAMBDA; other lambdas are for the host",
}
# Functions of kernels/ for the host: they make functors and views, and read keys of a case.
HOST = set("""from keys words footprint fault misfit each make place_of with all is of word posts_of narrower OneOf box
count items_for Field DeviceScalar deposit_stencil_in glued_floor make_chunks""".split())
NOISE = re.compile(r"""//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])'|^[ \t]*\#(?:\\\n|[^\n])*""",
                   re.S | re.M)
BRACKETS = {"(": ")", "[": "]", "{": "}"}
MARK = re.compile(r"\bKOKKOS_(?:INLINE_|FORCEINLINE_)?FUNCTION\b")
LAMBDA = re.compile(r"\bKOKKOS_LAMBDA\s*(?=\()")
LAUNCH = re.compile(r"(?<![.>])\b(?:parallel_(?:for|reduce|scan)|for_each_\w+)\s*(?:<[^;(]*>)?\s*(?=\()")
HARMLESS = r"u?int\d+_t|size_t|ptrdiff_t|numbers|is_\w+_v|remove_\w+_t|conditional_t|decay_t|move|forward|memcpy"
STD = re.compile(rf"\bstd::(?!(?:{HARMLESS})\b)\w+|\bfmt::\w+")
NO_WORDS = re.compile(r"\b(?:throw|try|catch|new|delete|typeid|dynamic_cast|thread_local|static(?!\s+constexpr))\b")
MINE = re.compile(r"(?<![.\w>:])(?:this|\w+_)\b")
HEAD = re.compile(r"(?P<name>\boperator\s*(?:\(\s*\)|[^\s(\w]+|\w[\w\s]*)|~?\b(?!(?:alignas|requires|decltype|noexcept|"
                  r"explicit|static_assert|sizeof)\b)[A-Za-z_]\w*)\s*\(")
ON_HOST = re.compile(r"KOKKOS_IF_ON_HOST\s*\(\(.*?\)\)", re.S)
OF_INDEX = re.compile(r".*?operator\s*\(\)\s*\((?:const )?int\b", re.S)
CLASS = re.compile(r"(?:inline |typedef )*(namespace|extern|struct|class|union|enum)\b")
HOST_MEMBER = re.compile(r"&|\bvirtual\b|\bHostSpace\b|\bHostMirror\b|\bhost_mirror_\w+|" + STD.pattern)


def without_angles(text):
    """Text without template parameters."""
    text, before = re.sub(r"operator\s*[-<>=]+", "operator", text), None
    while text != before:
        text, before = re.sub(r"<[^<>]*>", " ", text), text
    return text


class Source:
    """A file: its functions (name, class, is marked, begin, end) and the variables of its classes."""

    def __init__(self, path, text):
        self.path, self.functions, self.members, self.found = path, [], {}, []
        self.text = NOISE.sub(lambda noise: re.sub(r"[^\n]", " ", noise[0]), text)
        self.partner, waiting = {}, []
        for at, letter in enumerate(self.text):
            if letter in BRACKETS:
                waiting.append(at)
            elif waiting and letter == BRACKETS[self.text[waiting[-1]]]:
                self.partner[waiting.pop()] = at
        self.read(0, len(self.text), "")
        self.lambdas = [(at.end(), self.partner[self.text.index("{", self.partner[at.end()])])
                        for at in LAMBDA.finditer(self.text)]
        self.device = self.lambdas + [(begin, end) for _, _, marked, begin, end in self.functions if marked]

    def read(self, at, end, owner):
        """Declarations of a namespace or of a class."""
        begin = at
        while at < end:
            letter = self.text[at]
            if letter == "{":
                head = re.sub(r"^(?:\s*(?:public|private|protected)\s*:)+|\btemplate\b", "", self.text[begin:at])
                plain = without_angles(head).strip()
                kind, function = CLASS.match(plain), HEAD.search(plain)
                if kind and kind[1] != "enum":
                    names, _, bases = re.sub(r"alignas\([^)]*\)|::", " ", plain[kind.end():]).partition(" : ")
                    name = (re.findall(r"\w+", names.replace("final", "")) or [""])[-1]
                    inside = "" if kind[1] in ("namespace", "extern") else name
                    if inside:
                        self.members.setdefault(inside, []).append((begin, re.sub(r"[&]|std::", "", bases)))
                    self.read(at + 1, self.partner[at], inside)
                    begin = self.partner[at] + 1
                elif function and not re.search(r"[^=!<>]=", plain[:function.start()]):
                    if re.search(r"\)[^()]*?(?<!:):(?!:)", plain):  # members are initialised before the body
                        while self.text[:at].rstrip()[-1] not in ")}":
                            at = self.text.index("{", self.partner[at])
                    self.add(plain, function, owner, begin, self.partner[at])
                    begin = self.partner[at] + 1
                at = self.partner[at]
            elif letter in "([":
                at = self.partner.get(at, at)
            elif letter == ";":
                head = self.text[begin:at]
                plain = without_angles(head).partition("=")[0]
                if HEAD.search(plain) and "operator=" not in plain:
                    self.add(plain, HEAD.search(plain), owner, begin, begin)
                elif owner and not re.search(r"\b(?:using|friend|static|static_assert|typedef|enum)\b", head):
                    self.members[owner].append((begin, re.sub(r"^\s*(?:public|private|protected)\s*:", "", head)))
                begin = at + 1
            at += 1

    def add(self, head, function, owner, begin, end):
        name = re.sub(r"\s+", "", function["name"])
        owner = (re.findall(r"(\w+)\s*::\s*$", head[:function.start()]) or [owner])[-1]
        self.functions.append((name, owner, bool(MARK.search(head)), begin, end))
        if "virtual" in head and owner in self.members:
            self.members[owner].append((begin, "virtual " + name))

    def report(self, rule, at, what):
        at += len(self.text[at:]) - len(self.text[at:].lstrip())
        self.found.append((self.path, self.text.count("\n", 0, at) + 1, rule, " ".join(what.split())))


def check(sources):
    marked = {name for one in sources for name, _, mark, _, _ in one.functions if mark}
    variables = {word for one in sources for all_of in one.members.values() for _, member in all_of
                 for word in re.findall(r"\w+(?=\s*(?:[,={;]|$))", member)}
    unmarked = {name for one in sources for name, owner, mark, _, _ in one.functions if not mark and not owner}
    unmarked -= marked | variables
    call = re.compile(r"(?<![.\w>:])(\w+)(?:<[\w:, ]*>)?\((?!\))")
    functors = {owner for one in sources for name, owner, mark, _, _ in one.functions if mark and name == "operator()"}
    parts = set()
    while functors - parts:  # with what they are made of
        parts |= functors
        functors = {word for one in sources for name in parts for _, member in one.members.get(name, ())
                    for word in re.findall(r"\w+", member) if any(word in other.members for other in sources)}
    for source in sources:
        text = source.text
        for begin, end in source.device:
            body = ON_HOST.sub(lambda host: " " * len(host[0]), text[begin:end])
            for rule, pattern, start in (("std", STD, 0), ("words", NO_WORDS, body.find("{"))):
                for bad in pattern.finditer(body, start):
                    source.report(rule, begin + bad.start(), bad[0])
            for bad in call.finditer(body):
                if bad[1] in unmarked and not re.search(rf"(?:[>&*]|auto) {bad[1]}\b", text):
                    source.report("marked", begin + bad.start(), bad[1] + "()")
        for begin, end in source.lambdas:
            for bad in MINE.finditer(text, begin, end):
                source.report("this", bad.start(), bad[0])
        of_device = {one[:2] for one in source.functions if one[2]}
        for name, owner, mark, begin, end in source.functions:
            is_kernel = source.path.startswith("kernels/") and name not in HOST or (name, owner) in of_device
            is_functor = name == "operator()" and OF_INDEX.match(text[begin:begin + 300])
            if not mark and (is_kernel and end > begin or is_functor):
                source.report("marked", begin, name)
        for name in parts & set(source.members):
            for at, member in source.members[name]:
                if bad := HOST_MEMBER.search(member.partition("=")[0]):
                    source.report("members", at, f"{bad[0]} in {name}: {member}")
        for bad in re.finditer(r"\bKOKKOS_CLASS_LAMBDA\b", text):
            source.report("lambdas", bad.start(), bad[0])
        for launch in LAUNCH.finditer(text):
            if not any(begin < launch.start() < end for begin, end in source.device):
                for bad in re.finditer(r"[(,]\s*\[[^\]]*\]\s*\(", text[launch.end():source.partner[launch.end()]]):
                    if launch[0].startswith("parallel") or "=" in bad[0]:
                        source.report("lambdas", launch.end() + bad.start() + 1, launch[0])
    return sorted({found for source in sources for found in source.found})


LOOP = 'void f(int n, Values v) {{ Kokkos::parallel_for("f", n, {}); }}'
FUNCTOR = "struct F {{ {}; KOKKOS_FUNCTION void operator()(int i) const {{ g(i); }} }};"
WRONG = {
    "marked": [
        "inline Real square(Real a) { return a * a; }", "struct Sum { Real s; explicit Sum(Real a) : s{a} {} };",
        "constexpr Sum operator+(const Sum& a, const Sum& b) { return {a.s + b.s}; }",
        "struct Fill { Values v; void operator()(int i) const { v(i) = 1; } };",
        "Real square(Real a); " + LOOP.format("KOKKOS_LAMBDA(int i) { v(i) = square(v(i)); }")],
    "std": ["KOKKOS_FUNCTION Real f(Real a) { return std::sqrt(a); }",
            "KOKKOS_FUNCTION int f(const std::vector<int>& v) { return v[0]; }",
            LOOP.format("KOKKOS_LAMBDA(int i) { v(i) = std::min(i, 2); }"),
            "struct A { Real a; KOKKOS_FUNCTION A(Real b) : a{std::abs(b)} {} };"],
    "words": ["KOKKOS_FUNCTION int f(int a) { if (a < 0) throw 1; return a; }",
              "KOKKOS_FUNCTION int* f(int n) { return new int[n]; }",
              "KOKKOS_FUNCTION int f() { static int calls = 0; return ++calls; }"],
    "members": [FUNCTOR.format("const Grid& grid"), FUNCTOR.format("std::span<const int> v"),
                FUNCTOR.format("Kokkos::View<int*, Kokkos::HostSpace> v"), FUNCTOR.format("std::function<int(int)> v"),
                "struct Part { int& n; }; " + FUNCTOR.format("Part part"),
                "struct Law { virtual Real at(int i) const; }; " + FUNCTOR.format("Law law")],
    "this": [LOOP.format("KOKKOS_LAMBDA(int i) { v_(i) = i; }"),
             LOOP.format("KOKKOS_LAMBDA(int i) { this->v(i) = i; }")],
    "lambdas": [LOOP.format("[=](int i) { v(i) = i; }"), LOOP.format("KOKKOS_CLASS_LAMBDA(int i) { g(i); }")],
}
RIGHT = [
    "struct S { S() = default; S(const S&) = delete; KOKKOS_FUNCTION operator Real() const { return s; } Real s; };",
    "template <class T> requires(sizeof(T) == 8) KOKKOS_FUNCTION T f(T a) { return Kokkos::sqrt(a); } using L = S;",
    "KOKKOS_FUNCTION std::int64_t f(std::size_t a) { static constexpr int n = 3; return a * std::numbers::pi * n; }",
    FUNCTOR.format('Kokkos::View<int*> v; static constexpr const char* kName = "f"'),
    "struct InKernel { const Grid& grid; KOKKOS_FUNCTION int f() const { return grid.n; } };",
    LOOP.format("KOKKOS_LAMBDA(int i) { v(i).x_ = i; }").replace("void", "KOKKOS_FUNCTION void"),
]


def main():
    count = 0
    for rule, pieces in {**WRONG, "": RIGHT}.items():
        for piece in pieces:
            reported = {found[2] for found in check([Source("kernels/piece", piece.replace("void f(", "void from("))])}
            if reported != ({rule} if rule else set()):
                sys.exit(f"device_code: rule '{rule}', by {', '.join(reported) or 'none'} reported: {piece}")
            count += bool(rule)
    left_out = re.findall(r"if\(Kokkos_ENABLE_CUDA\).*\n *list\(REMOVE_ITEM core_sources .*?}/(.*?)\"",
                          (ROOT / "CMakeLists.txt").read_text())
    paths = {str(path.relative_to(ROOT)): path for top in ("kernels", "src") for path in (ROOT / top).rglob("*.[hc]pp")}
    sources = [Source(name, path.read_text()) for name, path in sorted(paths.items()) if name not in left_out]
    found = check(sources)
    for path, line, rule, text in found:
        print(f"{path}:{line}: {rule}: {text}")
    for rule in sorted({one[2] for one in found}):
        print(f"{rule}: {WHY[rule]}")
    bodies = sum(len(one.device) for one in sources)
    print(f"device_code: {count} deliberate mistakes found, {bodies} bodies of the device, {len(found)} problems")
    return len(found) > 0


if __name__ == "__main__":
    sys.exit(main())
