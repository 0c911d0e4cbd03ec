"""Reads the message definitions idl/*.idl, and refuses what is outside the accepted subset, naming file and line.

Accepted: `#include "file.idl"`, modules, `const unsigned long NAME = value;`, `@final struct`, `@key` on integer
members that come first, and the types boolean, octet, (unsigned) long, (unsigned) long long, float, double,
string<N>, structs, sequence<T, N>. Bounds are numbers or constants by their full name.
"""
import pathlib
import re
from dataclasses import dataclass, field

# IDL type -> (C++ type, size on the wire in bytes, which is also its alignment)
PRIMITIVES = {
    "boolean": ("bool", 1),
    "octet": ("std::uint8_t", 1),
    "long": ("std::int32_t", 4),
    "unsigned long": ("std::uint32_t", 4),
    "long long": ("std::int64_t", 8),
    "unsigned long long": ("std::uint64_t", 8),
    "float": ("float", 4),
    "double": ("double", 8),
}
KEY_TYPES = ("long", "unsigned long", "long long", "unsigned long long")
CPP_WORDS = {
    "alignas", "auto", "bool", "break", "case", "char", "class", "continue", "default", "delete", "do",
    "else", "enum", "explicit", "export", "extern", "false", "for", "friend", "goto", "if", "inline",
    "int", "namespace", "new", "operator", "private", "protected", "public", "register", "return",
    "short", "signed", "sizeof", "static", "template", "this", "throw", "true", "try", "typename",
    "using", "virtual", "void", "volatile", "while",
}
MAX_KEY_BYTES = 16  # a longer key travels as its MD5 hash, which we do without


class IdlError(Exception):
    """What is wrong with a definition, and where."""

    def __init__(self, place, message):
        super().__init__(f"{place[0]}:{place[1]}: {message}")


@dataclass
class Token:
    kind: str  # word, number, text, symbol, comment, end
    text: str
    place: tuple  # (file, line)
    column: int = 0
    first_on_line: bool = False


@dataclass
class Type:
    kind: str  # primitive, struct, string, sequence
    name: str = ""
    bound: int = 0
    element: "Type" = None


@dataclass
class Member:
    name: str
    type: Type
    key: bool
    place: tuple
    doc: list = field(default_factory=list)
    note: list = field(default_factory=list)


@dataclass
class Struct:
    name: str
    scope: tuple
    place: tuple
    members: list
    doc: list

    @property
    def full_name(self):
        return "::".join(self.scope + (self.name,))


@dataclass
class Constant:
    name: str
    scope: tuple
    value: int
    doc: list
    note: list = field(default_factory=list)

    @property
    def full_name(self):
        return "::".join(self.scope + (self.name,))


@dataclass
class File:
    path: pathlib.Path
    header: list
    includes: list
    items: list  # constants and structs in the file's order


TOKEN = re.compile(
    r"(?P<space>[ \t\r]+)|(?P<line>\n)|(?P<comment>//[^\n]*)|(?P<include>\#include[ \t]+\"[^\"\n]*\")"
    r"|(?P<word>@?[A-Za-z_][A-Za-z_0-9]*)|(?P<number>[0-9]+)|(?P<symbol>::|[{}()<>;,=])"
)


def tokenize(path, text):
    tokens, position, line, line_start, first = [], 0, 1, 0, True
    while position < len(text):
        match = TOKEN.match(text, position)
        if not match:
            found = text[position:].split("\n")[0][:20]
            raise IdlError((path, line), f"found '{found}', which is outside the accepted subset")
        kind = match.lastgroup
        if kind not in ("space", "line"):
            tokens.append(Token(kind, match.group(), (path, line), position - line_start, first))
            first = False
        position = match.end()
        if kind == "line":
            line, line_start, first = line + 1, position, True
    tokens.append(Token("end", "end of file", (path, line), 0, True))
    return tokens


class Parser:
    """Reads one file; `known` holds the structs and constants of all files read so far, by full name."""

    def __init__(self, path, known):
        self.path, self.known = path, known
        self.tokens = tokenize(path, path.read_text(encoding="utf-8"))
        self.at, self.scope, self.doc = 0, (), []
        self.file = File(path, [], [], [])

    # tokens; comments are collected on the way as the documentation of what follows
    def peek(self):
        while self.tokens[self.at].kind == "comment":
            token = self.tokens[self.at]
            above = self.tokens[self.at - 1] if self.at else None
            if above and above.kind == "comment" and token.place[1] > above.place[1] + 1:
                self.end_paragraph()
            self.doc.append(token)
            self.at += 1
        return self.tokens[self.at]

    def end_paragraph(self):
        """The comments so far document the file, if they stand at its head, not the next declaration."""
        if not self.file.items and not self.scope:
            self.file.header += [t.text for t in self.doc]
        self.doc = []

    def take(self):
        token = self.peek()
        self.at += 1
        return token

    def expect(self, *texts):
        token = self.take()
        if token.text not in texts:
            wanted = " or ".join(f"'{t}'" for t in texts)
            raise IdlError(token.place, f"found '{token.text}', expected {wanted}")
        return token

    def name(self, what):
        token = self.take()
        if token.kind != "word" or token.text.startswith("@"):
            raise IdlError(token.place, f"found '{token.text}', expected {what}")
        if token.text in CPP_WORDS:
            raise IdlError(token.place, f"'{token.text}' is a word of C++; choose another name")
        return token

    def leading_doc(self, place):
        """The comments directly above the declaration at `place`."""
        if self.doc and place[1] > self.doc[-1].place[1] + 1:
            self.end_paragraph()
        doc, self.doc = self.doc, []
        return [t.text for t in doc]

    def trailing_note(self, column_of_member):
        """The comment behind a declaration, with the further-indented lines that continue it."""
        note, line = [], self.tokens[self.at - 1].place[1]
        while self.tokens[self.at].kind == "comment":
            token = self.tokens[self.at]
            behind = not note and not token.first_on_line and token.place[1] == line
            continued = note and token.first_on_line and token.column > column_of_member
            if not (behind or continued and token.place[1] == line + 1):
                break
            note.append(token.text)
            line = token.place[1]
            self.at += 1
        return note

    # grammar
    def parse_includes(self):
        first = self.peek()
        while first.kind == "include":
            self.end_paragraph()
            self.file.includes.append((self.take().text.split('"')[1], first.place))
            first = self.peek()
        return self.file.includes

    def parse_items(self):
        while self.peek().kind != "end":
            self.parse_item()
        return self.file

    def parse_item(self):
        token = self.peek()
        if token.text == "module":
            self.parse_module()
        elif token.text == "const":
            self.parse_constant()
        elif token.text in ("@final", "struct"):
            self.parse_struct()
        else:
            raise IdlError(token.place, f"found '{token.text}', expected 'module', 'const' or '@final struct'")

    def parse_module(self):
        self.expect("module")
        self.end_paragraph()
        self.scope += (self.name("the module's name").text,)
        self.expect("{")
        while self.peek().text != "}":
            if self.peek().kind == "end":
                raise IdlError(self.peek().place, "the file ends inside a module")
            self.parse_item()
        self.expect("}")
        self.expect(";")
        self.doc = []
        self.scope = self.scope[:-1]

    def parse_constant(self):
        start = self.peek()
        doc = self.leading_doc(start.place)
        self.expect("const")
        self.expect("unsigned")
        self.expect("long")
        name = self.name("the constant's name")
        self.expect("=")
        value = self.number()
        self.expect(";")
        constant = Constant(name.text, self.scope, value, doc)
        constant.note = self.trailing_note(start.column)
        self.declare(constant, name.place)

    def parse_struct(self):
        start = self.peek()
        doc = self.leading_doc(start.place)
        if start.text != "@final":
            raise IdlError(start.place, "a struct must be @final: other kinds exchange nothing across vendors")
        self.expect("@final")
        self.expect("struct")
        name = self.name("the struct's name")
        self.expect("{")
        struct = Struct(name.text, self.scope, name.place, [], doc)
        while self.peek().text != "}":
            struct.members.append(self.parse_member(struct))
        self.expect("}")
        self.expect(";")
        self.doc = []
        if not struct.members:
            raise IdlError(name.place, f"struct {name.text} has no members")
        self.declare(struct, name.place)

    def parse_member(self, struct):
        start = self.peek()
        doc = self.leading_doc(start.place)
        key = start.text == "@key"
        if key:
            self.expect("@key")
            if any(not m.key for m in struct.members):
                raise IdlError(start.place, "@key members come first: a key must be readable on its own")
        member_type = self.parse_type()
        if key and member_type.name not in KEY_TYPES:
            raise IdlError(start.place, "a @key must be an integer")
        name = self.name("the member's name")
        if any(m.name == name.text for m in struct.members):
            raise IdlError(name.place, f"member '{name.text}' appears twice in struct {struct.name}")
        self.expect(";")
        return Member(name.text, member_type, key, name.place, doc, self.trailing_note(start.column))

    def parse_type(self, inside_sequence=False):
        token = self.take()
        if token.text == "string":
            self.expect("<")
            bound = self.bound()
            self.expect(">")
            return Type("string", "string", bound)
        if token.text == "sequence":
            if inside_sequence:
                raise IdlError(token.place, "a sequence of sequences is outside the accepted subset")
            self.expect("<")
            element = self.parse_type(inside_sequence=True)
            self.expect(",")
            bound = self.bound()
            self.expect(">")
            return Type("sequence", "sequence", bound, element)
        words = token.text
        if words == "unsigned":
            words += " " + self.expect("long").text
        if words.endswith("long") and self.peek().text == "long":
            words += " " + self.take().text
        if words in PRIMITIVES:
            return Type("primitive", words)
        return self.struct_type(token)

    def struct_type(self, token):
        struct = self.look_up(self.scoped_name(token))
        if not isinstance(struct, Struct):
            raise IdlError(token.place, f"found type '{token.text}', which is neither declared above nor accepted")
        if any(m.key for m in struct.members):
            raise IdlError(token.place, f"struct {struct.name} has a @key: it is a topic and cannot be a member")
        return Type("struct", struct.full_name)

    def scoped_name(self, token):
        name = token.text
        while self.peek().text == "::":
            self.take()
            name += "::" + self.name("a name after '::'").text
        return name

    def look_up(self, name):
        for depth in range(len(self.scope), -1, -1):
            found = self.known.get("::".join(self.scope[:depth] + (name,)))
            if found:
                return found
        return None

    def bound(self):
        place = self.peek().place
        value = self.number()
        if value < 1:
            raise IdlError(place, "a bound must be at least 1")
        return value

    def number(self):
        token = self.take()
        if token.kind == "number":
            value = int(token.text)
        else:
            constant = self.known.get(self.scoped_name(token))
            if not isinstance(constant, Constant):
                raise IdlError(token.place, f"found '{token.text}', expected a number or a constant's full name")
            value = constant.value
        if value >= 2**32:
            raise IdlError(token.place, f"{value} does not fit an unsigned long")
        return value

    def declare(self, item, place):
        if item.full_name in self.known:
            raise IdlError(place, f"'{item.full_name}' is declared twice")
        self.known[item.full_name] = item
        self.file.items.append(item)


def read_all(paths):
    """Files in the order in which they can be included, and everything they declare."""
    known, files, open_files = {}, {}, []

    def read(path, place):
        path = path.resolve()
        if path in files:
            return
        if path in open_files:
            raise IdlError(place, f"'{path.name}' includes itself")
        if not path.is_file():
            raise IdlError(place, f"file '{path}' does not exist")
        open_files.append(path)
        parser = Parser(path, known)
        for include, include_place in parser.parse_includes():
            read(path.parent / include, include_place)
        files[path] = parser.parse_items()
        open_files.pop()

    for path in paths:
        read(pathlib.Path(path), ("command line", 0))
    check(known)
    return list(files.values()), known


def check(known):
    for struct in structs(known):
        size = key_bytes(struct)
        if size > MAX_KEY_BYTES:
            raise IdlError(struct.place, f"the key of {struct.name} takes {size} bytes, at most {MAX_KEY_BYTES} fit")


def structs(known):
    return [item for item in known.values() if isinstance(item, Struct)]


def topics(known):
    """The topic types: every struct that is no other's member."""
    nested = set()
    for struct in structs(known):
        for member in struct.members:
            nested.add((member.type.element or member.type).name)
    return [s for s in structs(known) if s.full_name not in nested]


def key_bytes(struct):
    end = 0
    for member in struct.members:
        if member.key:
            size = PRIMITIVES[member.type.name][1]
            end = -(-end // size) * size + size
    return end


def max_bytes(kind, known):
    """Upper bound of a value's size on the wire, wherever it starts."""
    if kind.kind == "primitive":
        size = PRIMITIVES[kind.name][1]
        return size + size - 1
    if kind.kind == "string":
        return 3 + 4 + kind.bound + 1
    if kind.kind == "struct":
        return sum(max_bytes(m.type, known) for m in known[kind.name].members)
    if kind.element.kind == "primitive":
        return 3 + 4 + 7 + kind.bound * PRIMITIVES[kind.element.name][1]
    return 3 + 4 + kind.bound * max_bytes(kind.element, known)
