#!/usr/bin/python3
"""Code that will run on a GPU: mistakes that a CPU does not show, found in the text of kernels/ and src/.

    tests/hygiene/device_code.py [FILE...]     by default all files

The rules, each with deliberate mistakes, are in device_code.toml. Before anything else every mistake must be reported
by its rule, and no right piece by any. It reads text because no compiler at hand can do more: clang 14 of Debian 12,
which has a query language for such rules, does not take Kokkos 5. So it knows names, not types: of several functions
with one name it is content if one is marked, and it does not see which operator an expression takes; in kernels/ all
are marked, therefore. Where values come from at run time it does not see either.
"""
import pathlib
import re
import sys
import tomllib

from cpp_text import NAME, Source, Unreadable, declarations, function_around

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = tomllib.loads(pathlib.Path(__file__).with_name("device_code.toml").read_text())
LAMBDA, LAUNCHES = "KOKKOS_LAMBDA", {"parallel_for", "parallel_reduce", "parallel_scan"}
# Names of the standard library that are types and constants; nvcc has the three functions for the device.
HARMLESS = re.compile(r"u?int\d+_t|size_t|ptrdiff_t|numbers|(is_\w+_v)|(remove_\w+_t)|conditional_t|decay_t|"
                      r"move|forward|memcpy")
NO_WORDS = {"throw", "try", "catch", "new", "delete", "typeid", "dynamic_cast", "thread_local"}
NOT_RUN = {"KOKKOS_IF_ON_HOST", "static_assert", "decltype", "sizeof"}
ON_HOST = {"HostSpace", "HostMirror", "host_mirror_type", "host_mirror_space", "DefaultHostExecutionSpace"}
HOLDERS = {"vector", "array", "string", "span", "string_view", "map", "unique_ptr"}
BEFORE_VALUE = ("(", ",", "{", "=", "?", ":", "return")  # what stands before an & that takes an address, or a lambda


class Body:
    """Code of the device: of a marked function or a lambda."""

    def __init__(self, source, params, begin, end, function, is_lambda=False):
        self.source, self.params, self.function, self.is_lambda = source, params, function, is_lambda
        self.places, at = list(range(*params)), begin
        while at < end:
            if source.tokens[at] in NOT_RUN and source.at(at + 1) == "(":
                at = source.partner[at + 1]
            else:
                self.places.append(at)
            at += 1


class Program:
    """All files together."""

    def __init__(self, sources, launchers=frozenset()):
        self.sources, self.found, self.listed = sources, [], set()
        self.functions, self.classes, self.aliases = {}, {}, {}
        for source in sources:
            for one in source.functions:
                self.functions.setdefault(one.name, []).append(one)
            for one in source.classes:
                self.classes.setdefault(one.name, []).append((source, one))
            self.aliases.update(source.aliases)
        # Functions of the project that launch what they are given.
        self.launchers = LAUNCHES | launchers | {
            one.name for source in sources for one in source.functions if source.at(one.params[1] - 1) == "functor"}
        self.bodies = [body for source in sources for body in bodies_of(source)]
        self.functors = self.find_functors()
        self.on_device = self.find_on_device()

    def report(self, rule, source, at, text):
        self.report_line(rule, source, source.lines[at], text)

    def report_line(self, rule, source, line, text):
        self.found.append((source.path, line, rule, text))

    def is_listed(self, table, name):
        for one in (name, "*." + name.rpartition(".")[2]):
            self.listed.add((table, one))
            if one in TABLE[table]:
                return True
        return False

    def find_functors(self):
        """Classes that are launched or captured, and their parts."""
        waiting = [(source, one.owner) for source in self.sources for one in source.functions
                   if one.name == "operator ( )" and one.marked]
        for body in self.bodies:
            if body.is_lambda:
                used = {body.source.tokens[at] for at in body.places}
                waiting += [(body.source, kind) for kind, name in declarations(body.source, body.function)
                            if name in used]
        seen, functors = set(), []
        while waiting:
            source, name = waiting.pop()
            if (source.path, name) in seen:
                continue
            seen.add((source.path, name))
            waiting += [(source, word) for word in self.aliases.get(name, [])]
            for its_source, one in self.classes.get(name, []):
                if its_source is source or not its_source.path.endswith(".cpp"):
                    functors.append((its_source, one))
                    waiting += [(its_source, word) for word in one.bases]
                    waiting += [(its_source, word) for member in one.members for word in member.tokens]
        return functors

    def find_on_device(self):
        """Names of classes that device code can have objects of."""
        named = {body.source.tokens[at] for body in self.bodies for at in body.places}
        marked = {one.owner for known in self.functions.values() for one in known if one.marked}
        return marked | {one.name for _, one in self.functors} | named & set(self.classes)

    def check(self):
        for body in self.bodies:
            check_calls(self, body)
            check_words(self, body)
            if body.is_lambda:
                check_captures(self, body)
                check_place(self, body)
        for source, one in self.functors:
            check_members(self, source, one)
        for source in self.sources:
            check_launches(self, source)
            check_marks(self, source)
        return sorted(set(self.found))


def bodies_of(source):
    for one in source.functions:
        if one.marked and one.body:
            yield Body(source, one.params, *one.body, one)
    for at, token in enumerate(source.tokens):
        if token == LAMBDA:
            begin = source.tokens.index("{", source.partner[at + 1])
            yield Body(source, (at + 2, source.partner[at + 1]), begin, source.partner[begin],
                       function_around(source, at), True)


def members_of(program, name, seen=()):
    """Names of variables of a class and its bases."""
    names = set()
    for _, one in program.classes.get(name, []):
        names.update(*(member.names for member in one.members))
        for base in one.bases:
            if base not in (*seen, name):
                names |= members_of(program, base, (*seen, name))
    return names


def check_marks(program, source):
    """Marks that no call shows to be missing."""
    of_name = {}
    for one in source.functions:
        full_name = f"{one.owner}.{one.name}"
        if one.name == "operator ( )" and "int" in source.tokens[one.params[0]:one.params[0] + 2] and not one.marked:
            program.report_line("marked", source, one.line, f"operator() of {one.owner}")
        if one.body:
            of_name.setdefault(full_name, set()).add(one.marked)
            if len(of_name[full_name]) > 1:
                program.report_line("marked", source, one.line, f"only some functions {one.name}")
            if source.path.startswith("kernels/") and not one.marked and not program.is_listed("host", full_name):
                program.report_line("kernels", source, one.line, full_name.strip("."))


def check_calls(program, body):
    source, function = body.source, body.function
    owner = function.owner if function else ""
    variables = {name for _, name in declarations(source, function)} | members_of(program, owner)
    for at in body.places:
        name, before = source.tokens[at], source.at(at - 1)
        if not NAME.match(name):
            continue
        if name in ("std", "fmt") and source.at(at + 1) == "::" and before != "::":
            if name == "fmt" or not HARMLESS.fullmatch(source.at(at + 2)):
                program.report("std", source, at, f"{name}::{source.at(at + 2)}")
            continue
        behind = source.past_angles(at + 1) if source.at(at + 1) == "<" else at + 1
        if name in program.classes and before not in ("::", ".", "->"):
            constructors = [one for one in program.functions.get(name, []) if one.owner == name and one.body]
            makes = source.at(behind) in ("(", "{") or NAME.match(source.at(behind))
            if makes and constructors and not any(one.marked for one in constructors):
                program.report("marked", source, at, f"the constructor of {name}")
        elif source.at(behind) == "(":
            wanted = called(program, source, at, owner, variables)
            if wanted and not any(one.marked for one in wanted):
                program.report("marked", source, at, f"{name}()")


def called(program, source, at, owner, variables):
    """The functions of the project that the name at `at` may mean."""
    name, before = source.tokens[at], source.at(at - 1)
    known = [one for one in program.functions.get(name, []) if one.name != one.owner]
    if before in (".", "->"):
        is_variable = any(name in member.names for entries in program.classes.values() for _, one in entries
                          for member in one.members)
        return [] if is_variable else [one for one in known if one.owner in program.on_device]
    if before == "::":
        scope = source.at(at - 2)
        if scope in ("std", "Kokkos", "Experimental", "fmt"):
            return []
        return [one for one in known if one.owner in (scope if scope in program.classes else "")]
    if name in variables:
        return []
    family = {owner} | {base for _, one in program.classes.get(owner, []) for base in one.bases}
    return [one for one in known if owner and one.owner in family] or [one for one in known if not one.owner]


def check_words(program, body):
    source = body.source
    for at in body.places:
        word = source.tokens[at]
        if word in NO_WORDS or word == "static" and source.at(at + 1) != "constexpr":
            program.report("words", source, at, word)


def check_members(program, source, one):
    for member in one.members:
        for name in member.names:
            reached = [word for word in ("&", "&&", "*") if word in member.flat]
            if reached and not (reached == ["*"] and program.is_listed("pointers", f"{one.name}.{name}")):
                kind = "pointer" if reached == ["*"] else "reference"
                program.report_line("members", source, member.line, f"{kind} {one.name}.{name}")
        for at, token in enumerate(member.tokens):
            after = member.tokens[at + 2] if at + 2 < len(member.tokens) else ""
            if token == "std" and not HARMLESS.fullmatch(after):
                program.report_line("members", source, member.line, f"std::{after} {one.name}.{member.names[-1]}")
            elif token in ON_HOST:
                program.report_line("members", source, member.line, f"{token} in {one.name}.{member.names[-1]}")
    for function in source.functions:
        if function.owner == one.name and function.virtual:
            program.report_line("members", source, function.line, f"virtual {one.name}::{function.name}")


def host_variables(source, function):
    """Names of a function that hold values on the host: containers, addresses of variables."""
    held = {name: kind for kind, name in declarations(source, function) if kind in HOLDERS}
    for at in range(function.params[0], function.body[1]) if function and function.body else ():
        if source.tokens[at] in ("=", "{") and source.at(at + 1) == "&" and NAME.match(source.at(at - 1)):
            if source.at(at - 2) == "*" or source.at(at - 2) == "auto":
                held[source.at(at - 1)] = "address"
    return held


def check_captures(program, body):
    """What a KOKKOS_LAMBDA takes from around it."""
    source, function = body.source, body.function
    owner = function.owner if function else ""
    here = {name for _, name in declarations(source, function)}
    held = host_variables(source, function)
    methods = {name for name, known in program.functions.items() for one in known
               if owner and one.owner == owner and one.name != owner}
    mine = (members_of(program, owner) | methods) - here
    for at in body.places:
        name = source.tokens[at]
        if source.at(at - 1) in (".", "->", "::") or not NAME.match(name):
            continue
        if name == "this" or name in mine or name.endswith("_"):
            program.report("this", source, at, name)
        elif held.get(name) == "address":
            program.report("addresses", source, at, f"{name} is an address of the host")
        elif name in held:
            program.report("std", source, at, f"{name} is a std::{held[name]}")


def check_place(program, body):
    """Whether nvcc takes a KOKKOS_LAMBDA where it stands."""
    source, function, begin = body.source, body.function, body.params[0]
    if function is None:
        return
    known = {one.access for one in program.functions[function.name] if one.owner == function.owner and one.access}
    if function.owner and known and "public" not in known:
        program.report("places", source, begin, f"{function.name} is not public")
    if function.name == function.owner:
        program.report("places", source, begin, f"in the constructor of {function.name}")
    for at in range(function.body[0], begin):
        if source.tokens[at] == "[" and source.at(at - 1) in BEFORE_VALUE and source.at(source.partner[at] + 1) == "(":
            params = source.partner[at] + 1
            inner = source.tokens.index("{", source.partner[params])
            if "auto" in source.tokens[params:source.partner[params]] and inner < begin < source.partner[inner]:
                program.report("places", source, begin, "in a lambda that is a template")


def check_launches(program, source):
    in_device = {at for body in program.bodies if body.source is source for at in body.places}
    functors = {one.name for _, one in program.functors}
    for at, name in enumerate(source.tokens):
        if name == "KOKKOS_CLASS_LAMBDA":
            program.report("lambdas", source, at, name)
        if at in in_device or not NAME.match(name) or source.at(at - 1) in (".", "->"):
            continue
        behind = source.past_angles(at + 1) if source.at(at + 1) == "<" else at + 1
        function = function_around(source, at)
        if name in program.launchers and source.at(behind) == "(" and function:
            for here in range(behind, source.partner[behind]):
                word = source.tokens[here]
                if here in in_device or source.at(here - 1) in (".", "->"):
                    continue
                if word == "[" and source.at(here - 1) in BEFORE_VALUE or is_lambda(source, function, word):
                    program.report("lambdas", source, here, f"a lambda to {name}")
            check_addresses(program, source, behind, in_device, function)
        elif name in functors:
            if NAME.match(source.at(behind)):
                behind += 1
            if source.at(behind) in ("{", "(") and function:
                check_addresses(program, source, behind, in_device, function)


def is_lambda(source, function, name):
    tokens = source.tokens
    return any(tokens[at:at + 3] == [name, "=", "["] for at in range(*function.body))


def check_addresses(program, source, bracket, in_device, function):
    """Nothing between this bracket and its partner takes an address of the host."""
    held = host_variables(source, function)
    for at in range(bracket, source.partner[bracket]):
        word, before = source.tokens[at], source.at(at - 1)
        if at in in_device:
            continue
        if word == "&" and before in BEFORE_VALUE or word == "this" and before != "*" and source.at(at + 1) != "->":
            program.report("addresses", source, at, f"{word}{source.at(at + 1)}" if word == "&" else word)
        elif word in held and held[word] != "address" and source.tokens[at + 1:at + 3] == [".", "data"]:
            program.report("addresses", source, at, f"{word}.data() of the host")


def prove(launchers):
    """Every deliberate mistake is reported by its rule, no right piece by any; the number of mistakes."""
    count = 0
    for rule, entry in TABLE["rules"].items():
        for piece in entry["wrong"] + entry["right"]:
            reported = {found[2] for found in Program([Source(f"{rule}/piece", piece)], launchers).check()}
            if reported != ({rule} if piece in entry["wrong"] else set()):
                sys.exit(f"device_code: rule {rule}, by {', '.join(reported) or 'none'} reported: {piece}")
        count += len(entry["wrong"])
    return count


def host_only():
    """Sources that a build for CUDA leaves out, as CMakeLists.txt says."""
    rule = r'if\(Kokkos_ENABLE_CUDA\).*\n *list\(REMOVE_ITEM core_sources "\${PROJECT_SOURCE_DIR}/(.*?)"\)'
    return set(re.findall(rule, (ROOT / "CMakeLists.txt").read_text()))


def main(wanted):
    paths = [path for top in ("kernels", "src") for path in sorted((ROOT / top).rglob("*.[hc]pp"))]
    names = [str(path.relative_to(ROOT)) for path in paths]
    left_out = host_only()
    if not left_out:
        sys.exit("device_code: CMakeLists.txt no longer says which source a build for CUDA leaves out")
    for name in wanted:
        if name not in names:
            sys.exit(f"device_code: {name} is no source of kernels/ or src/")
    try:
        program = Program([Source(name, path.read_text()) for name, path in zip(names, paths) if name not in left_out])
        count = prove(frozenset(program.launchers))
        found = [one for one in program.check() if not wanted or one[0] in wanted]
    except Unreadable as error:
        sys.exit(f"device_code: {error}")
    for path, line, rule, text in found:
        print(f"{path}:{line}: {rule}: {text}")
    unused = [name for table in ("pointers", "host") for name in TABLE[table] if (table, name) not in program.listed]
    if unused:
        sys.exit(f"device_code: device_code.toml has what is not there: {', '.join(unused)}")
    for rule in sorted({one[2] for one in found}):
        print(f"{rule}: {TABLE['rules'][rule]['why'].replace(chr(10), ' ')}")
    if found:
        sys.exit(f"{len(found)} problem(s)")
    print(f"device_code: {count} deliberate mistakes found; {len(program.bodies)} bodies of the device, "
          f"{len(program.functors)} functors and parts are in order")


if __name__ == "__main__":
    main(sys.argv[1:])
