"""C++ source as text: tokens without comments, strings and preprocessor lines; classes, functions and variables.

Not a compiler: no types, no overloads, no templates. What it cannot read raises Unreadable.
"""
import re
from dataclasses import dataclass, field

TOKEN = re.compile(
    r"""(?P<skip>//[^\n]*|/\*.*?\*/|^[ \t]*\#(?:\\\n|[^\n])*)
    |(?P<text>R"(?P<mark>\w*)\(.*?\)(?P=mark)"|"(?:\\.|[^"\\])*")
    |(?P<token>\.?\d(?:[eEpP][+-]|'\w|[\w.])*|'(?:\\.|[^'\\])+'|\w+|::|->|&&|\.\.\.|\S)""", re.S | re.M | re.X)
CLOSING = {"(": ")", "[": "]", "{": "}"}
NAME = re.compile(r"[A-Za-z_]\w*$")
NOT_CALLED = {"alignas", "requires", "decltype", "noexcept", "explicit", "__attribute__", "if", "for", "while",
              "switch", "return", "sizeof", "alignof", "static_assert", "catch", "operator"}
MARKS = {"KOKKOS_FUNCTION", "KOKKOS_INLINE_FUNCTION", "KOKKOS_FORCEINLINE_FUNCTION"}
NO_TYPES = {"return", "else", "throw", "new", "delete", "case", "goto", "typename", "using", "operator", "struct"}
BEHIND_NAME = {"=", "{", "(", ";", ",", ")", ":", "["}  # of a variable that is declared
ACCESS = {"public", "private", "protected"}


class Unreadable(Exception):
    pass


@dataclass
class Function:
    name: str
    owner: str  # class, or "" of a free one
    access: str  # "" of one that stands behind its class
    line: int
    marked: bool
    params: tuple  # tokens [begin, end) between the parentheses
    body: tuple = None  # with what initialises members; None where it is only declared
    virtual: bool = False


@dataclass
class Variable:
    """One of a class, or several that share their type."""
    names: list
    line: int
    tokens: list  # up to the first value
    flat: list  # of these what is in no brackets


@dataclass
class Class:
    name: str
    line: int
    bases: list = field(default_factory=list)
    members: list = field(default_factory=list)


class Source:
    """A file: its tokens, and what it defines."""

    def __init__(self, path, text):
        self.path, self.tokens, self.lines, self.partner = path, [], [], {}
        self.functions, self.classes, self.aliases = [], [], {}
        line, at = 1, 0
        for found in TOKEN.finditer(text):
            line, at = line + text.count("\n", at, found.start()), found.start()
            if not found["skip"]:
                self.tokens.append(found["token"] or '""')
                self.lines.append(line)
        self.match_brackets()
        self.read(0, len(self.tokens), "", "public")

    def match_brackets(self):
        open_ones = []
        for at, token in enumerate(self.tokens):
            if token in CLOSING:
                open_ones.append(at)
            elif token in CLOSING.values():
                if not open_ones or CLOSING[self.tokens[open_ones[-1]]] != token:
                    raise Unreadable(f"{self.path}:{self.lines[at]}: '{token}' closes nothing")
                self.partner[open_ones.pop()] = at
        if open_ones:
            raise Unreadable(f"{self.path}:{self.lines[open_ones[-1]]}: '{self.tokens[open_ones[-1]]}' is not closed")

    def at(self, index):
        return self.tokens[index] if 0 <= index < len(self.tokens) else ""

    def past_angles(self, at):
        """The place behind the '>' of a '<', or `at` if it is a comparison."""
        depth, here = 0, at
        while here < len(self.tokens):
            token = self.tokens[here]
            if token in CLOSING:
                here = self.partner[here]
            elif token in ";)]}":
                return at
            depth += (token == "<") - (token == ">")
            here += 1
            if depth == 0:
                return here
        return at

    def before_angles(self, at):
        """The place before the '<' of a '>'."""
        depth = 0
        while at > 0:
            depth += (self.tokens[at] == ">") - (self.tokens[at] == "<")
            at -= 1
            if depth == 0:
                break
        return at

    def past_value(self, at):
        """The place of the next ',' or ';', or where the brackets end that this is in."""
        while self.at(at) not in (",", ";", ")", "]", "}", ""):
            at = max(self.past_angles(at), at + 1) if self.tokens[at] == "<" else self.partner.get(at, at) + 1
        return at

    def past(self, at, stop):
        """The place behind the next token `stop` that is in no brackets."""
        while self.at(at) not in (stop, ""):
            at = self.partner.get(at, at) + 1
        return at + 1

    def read(self, at, end, owner, access):
        while at < end:
            if self.tokens[at] in ACCESS and self.at(at + 1) == ":":
                access, at = self.tokens[at], at + 2
            else:
                at = self.read_declaration(at, end, owner, access)

    def read_declaration(self, begin, end, owner, access):
        """Reads one from `begin` on; the place behind it."""
        at, params, flat = begin, None, []
        while at < end:
            token = self.tokens[at]
            if token == ";":
                self.add(owner, access, begin, at, flat, params)
                return at + 1
            if token == "operator":
                params = self.tokens.index("(", at + 3 if self.at(at + 1) == "(" else at)
                at = params
                flat.append("operator")
                continue
            if token == "=":
                self.add(owner, access, begin, at, flat, params)
                return self.past(at, ";")
            if token == ":" and params is not None:
                body = self.body_behind_members(at + 1)
                self.add(owner, access, begin, at, flat, params, (at, self.partner[body]))
                return self.partner[body] + 1
            if token == "{":
                behind = self.read_braces(begin, at, owner, access, flat, params)
                if behind:
                    return behind
            elif token == "(" and params is None and NAME.match(self.at(at - 1)) and self.at(at - 1) not in NOT_CALLED:
                params = at
            elif token == "<" and (NAME.match(self.at(at - 1))):
                at = max(self.past_angles(at), at + 1)
                continue
            if token not in CLOSING:
                flat.append(token)
            at = self.partner.get(at, at) + 1
        return end

    def body_behind_members(self, at):
        """The '{' of a constructor's body, `at` the first member that it initialises."""
        while True:
            while self.tokens[at] not in ("(", "{"):
                at = max(self.past_angles(at), at + 1) if self.tokens[at] == "<" else at + 1
            at = self.partner[at] + 1
            if self.tokens[at] == "...":
                at += 1
            if self.tokens[at] != ",":
                return at
            at += 1

    def read_braces(self, begin, at, owner, access, flat, params):
        """Reads what a '{' begins; the place behind the declaration, or None within that of a variable."""
        close = self.partner[at]
        if params is not None:
            self.add(owner, access, begin, at, flat, params, (at, close))
            return close + 1
        if "namespace" in flat or "extern" in flat:
            self.read(at + 1, close, owner, "public")
            return close + 1
        if "enum" in flat:
            return self.past(close, ";")
        for word in ("struct", "class", "union"):
            if word in flat:
                head = flat[flat.index(word) + 1:]
                names, bases = (head[:head.index(":")], head[head.index(":"):]) if ":" in head else (head, [])
                name = ([one for one in names if NAME.match(one) and one not in ("final", "alignas")] or [""])[-1]
                self.classes.append(Class(name, self.lines[at], [one for one in bases if NAME.match(one)]))
                self.read(at + 1, close, name, "private" if word == "class" else "public")
                return self.past(close, ";")
        return None

    def add(self, owner, access, begin, end, flat, params, body=None):
        """What stands in tokens [begin, end): a function if it has parameters, else a variable or another name."""
        if not flat:
            return
        if params is not None:
            start = params - 1
            if "operator" in flat:
                start = max(at for at in range(begin, params) if self.tokens[at] == "operator")
            elif self.at(start - 1) == "~":
                start -= 1
            name = " ".join(self.tokens[start:params])
            if self.at(start - 1) == "::":
                owner, access = self.tokens[start - 2], ""
            marked = bool(MARKS.intersection(self.tokens[begin:params]))
            self.functions.append(Function(name, owner, access, self.lines[params], marked,
                                           (params + 1, self.partner[params]), body,
                                           "virtual" in flat or "override" in flat))
        elif "using" in flat and self.tokens[end] == "=":
            self.aliases[flat[-1]] = self.tokens[end:self.past(end, ";")]
        elif owner and not {"using", "friend", "static", "typedef", "enum", "static_assert"}.intersection(flat):
            members = next(one for one in reversed(self.classes) if one.name == owner).members
            names = self.names_until(begin, ";")
            if len(flat) > 1 or "<" in self.tokens[begin:end]:
                members.append(Variable(names, self.lines[begin], self.tokens[begin:end], flat))

    def names_until(self, at, stop):
        """Names that are declared from `at` on."""
        names = []
        while self.at(at) not in (stop, ""):
            if NAME.match(self.tokens[at]) and self.at(at + 1) in (",", ";", "=", "{", "[", ":"):
                names.append(self.tokens[at])
            if self.tokens[at] == "=":
                at = self.past_value(at)
                continue
            behind = self.past_angles(at) if self.tokens[at] == "<" else at
            at = behind if behind > at else self.partner.get(at, at) + 1
        return names


def function_around(source, at):
    return next((one for one in source.functions if one.body and one.body[0] < at < one.body[1]), None)


def declarations(source, function):
    """(type, name) of variables and parameters of a function, also of those of lambdas in it."""
    if function is None:
        return
    for at in range(function.params[0], function.body[1] if function.body else function.params[1]):
        if source.tokens[at] == "[" and source.at(at - 1) in ("auto", "&", "&&"):  # auto [a, b]
            yield from (("", name) for name in source.tokens[at + 1:source.partner[at]] if NAME.match(name))
        kind = type_before(source, at) if NAME.match(source.tokens[at]) else ""
        if kind:
            yield kind, source.tokens[at]
            while source.at(at := source.past_value(at + 1)) == ",":  # int a = 1, b
                at += 2 if source.at(at + 1) in ("*", "&") else 1
                if not NAME.match(source.at(at)) or source.at(at + 1) not in BEHIND_NAME:
                    break
                yield kind, source.tokens[at]


def type_before(source, at):
    """The type that a variable declared at this place gets; "" if none is declared here."""
    before = at - 1
    while source.at(before) in ("&", "*", "&&", "const", "..."):
        before -= 1
    if source.at(at + 1) not in BEHIND_NAME or before != at - 1 and source.at(at + 1) == "(":
        return ""
    if source.at(before) == ">":
        before = source.before_angles(before)
    before_type = source.at(before - 1)
    if not NAME.match(source.at(before)) or source.at(before) in NO_TYPES or before_type in (".", "->", "="):
        return ""
    return source.at(before)
