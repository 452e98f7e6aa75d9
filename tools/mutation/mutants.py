# SPDX-License-Identifier: MIT
"""Where and how a C source can be changed: the mutants of a file.

A mutant is one small change: an operator for its neighbour, a constant one up or down, a sign, a
condition turned round, a statement left out, in a table of transitions another word. Comments,
includes, declarations, capacities (room, not behaviour), BELT_ASSERT and BELT_STATIC_ASSERT stay.
"""

import hashlib
import re
import sys
from collections import Counter
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "checks"))

import tree  # noqa: E402

TOKEN = re.compile(
    r'"(?:\\.|[^"\\])*"'
    r"|0[xX][0-9a-fA-F]+[uUlL]*"
    r"|(?:\d+\.\d*|\.\d+|\d+)(?:[eE][+-]?\d+)?[uUlLfF]*"
    r"|[A-Za-z_]\w*"
    r"|<<=|>>=|->|\+\+|--|<<|>>|<=|>=|==|!=|&&|\|\||[-+*/%&|^]="
    r"|[^\s\w]"
)
BINARY = {
    **{"+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["*"]},
    **{"&": ["|"], "|": ["&"], "^": ["|"], "<<": [">>"], ">>": ["<<"]},
}
ANYWHERE = {
    **{"<": ["<=", ">="], "<=": ["<", ">"], ">": [">=", "<="], ">=": [">", "<"]},
    **{"==": ["!="], "!=": ["=="], "&&": ["||"], "||": ["&&"]},
    **{"+=": ["-="], "-=": ["+="], "*=": ["/="], "/=": ["*="]},
    **{"|=": ["&="], "&=": ["|="], "^=": ["|="], "<<=": [">>="], ">>=": ["<<="]},
    **{"++": ["--"], "--": ["++"], "true": ["false"], "false": ["true"]},
    **{"BELT_HALF": ["BELT_REAL(1)", "BELT_REAL(0)"]},
}
UNARY = {"-", "~", "!"}
KEYWORDS = {"return", "case", "sizeof", "else", "do", "goto", "if", "for", "while", "switch"}
NO_STATEMENT = KEYWORDS | {"default", "typedef", "static", "const", "struct", "enum"}
TYPES = {"const", "char", "void", "int", "unsigned", "signed", "long", "bool", "float", "double"}
CLAIMS = {"BELT_ASSERT", "BELT_STATIC_ASSERT", "offsetof"}
DEFINE = re.compile(r"^[ \t]*#[ \t]*define[ \t]+(\w+)(\([^)]*\))?((?:[^\n]*\\\n)*[^\n]*)", re.M)
DIRECTIVE = re.compile(r"^[ \t]*#(?:[^\n]*\\\n)*[^\n]*", re.M)
ROW = re.compile(r"\brow\(([^()]*)\)")


@dataclass(frozen=True)
class Token:
    text: str
    start: int
    end: int


@dataclass(frozen=True)
class Mutant:
    id: str
    file: str
    line: int
    start: int
    end: int
    text: str  # what stands in for start ... end
    before: str  # the lines it changes, on one line
    after: str

    def apply(self, source: str) -> str:
        return source[: self.start] + self.text + source[self.end :]


def is_type(text: str) -> bool:
    return text in TYPES or (text.endswith("_t") and text != "_t")


def is_number(text: str) -> bool:
    return text[0].isdigit() or (text[0] == "." and len(text) > 1)


def other_numbers(text: str, is_real: bool) -> list[str]:
    """0 and the double for a number of belt_real_t, one up and one down for a count."""
    is_hex = text.lower().startswith("0x")
    if is_real or (not is_hex and re.search(r"[.eEfF]", text)):
        value = float(text.rstrip("fF"))
        return ["1"] if value == 0.0 else ["0", repr(2.0 * value)]
    digits = text.rstrip("uUlL")
    suffix = text[len(digits) :]
    value = int(digits, 0)
    if value == 0:
        return ["1" + suffix]
    form = hex if is_hex else str
    return [form(value + 1) + suffix, form(value - 1) + suffix]


class File:
    """Tokens of one source, and the changes they allow: (start, end, text)."""

    def __init__(self, text: str):
        self.clean = tree.without_comments(text, keep_strings=True)
        self.changes: list[tuple[int, int, str]] = []
        code = DIRECTIVE.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), self.clean)
        self.tokens = [Token(m[0], m.start(), m.end()) for m in TOKEN.finditer(code)]
        self.match = self.brackets()
        self.walk()
        self.defines()

    def brackets(self) -> dict[int, int]:
        """Index of each bracket's other half."""
        pairs, open_ones = {}, []
        for index, token in enumerate(self.tokens):
            if token.text in "([{":
                open_ones.append(index)
            elif token.text in ")]}":
                other = open_ones.pop()
                pairs[index], pairs[other] = other, index
        return pairs

    def walk(self) -> None:
        """Function bodies and initialisers; every other brace is a type."""
        index = 0
        while index < len(self.tokens):
            if self.tokens[index].text == "{":
                before = self.tokens[index - 1].text
                if before in {")", "="}:
                    self.inside(index + 1, self.match[index], is_code=before == ")")
                index = self.match[index]
            index += 1

    def inside(self, first: int, last: int, is_code: bool) -> None:
        index = first
        while index < last:
            token = self.tokens[index].text
            if token in CLAIMS and self.tokens[index + 1].text == "(":
                index = self.match[index + 1] + 1
                continue
            if token == "sizeof":
                index += 2
                continue
            self.change_token(index)
            if is_code:
                self.negate(index)
                self.leave_out(index)
            index += 1

    def change(self, first: int, last: int, text: str) -> None:
        self.changes.append((self.tokens[first].start, self.tokens[last].end, text))

    def is_operand(self, index: int) -> bool:
        """Whether a binary operator can follow this token."""
        token = self.tokens[index].text
        if token == ")":
            inner = self.tokens[self.match[index] + 1 : index]
            return not all(is_type(t.text) or t.text == "*" for t in inner)
        if token == "]" or is_number(token):
            return True
        return token.isidentifier() and token not in KEYWORDS and not is_type(token)

    def change_token(self, index: int) -> None:
        token = self.tokens[index].text
        others = ANYWHERE.get(token, [])
        if token in BINARY and self.is_operand(index - 1):
            others = BINARY[token]
        elif token in UNARY and not self.is_operand(index - 1):
            others = [""]
        elif is_number(token):
            is_real = [t.text for t in self.tokens[index - 2 : index]] == ["BELT_REAL", "("]
            others = other_numbers(token, is_real)
        for other in others:
            self.change(index, index, other)

    def negate(self, index: int) -> None:
        """if (C), while (C), C ? a : b."""
        token = self.tokens[index].text
        if token in {"if", "while"}:
            first, last = index + 1, self.match[index + 1]
            inner = self.clean[self.tokens[first].end : self.tokens[last].start]
            self.change(first, last, f"(!({inner}))")
        elif token == "?":
            first = index - 1
            if self.tokens[first].text == ")":
                first = self.match[first]
                if self.tokens[first - 1].text.isidentifier() and self.is_operand(first - 1):
                    first -= 1  # a call
            while self.tokens[first - 1].text in {"->", "."}:
                first -= 2
            condition = self.clean[self.tokens[first].start : self.tokens[index - 1].end]
            self.change(first, index - 1, f"!({condition})")

    def leave_out(self, index: int) -> None:
        """A statement that is no declaration and does not return a value."""
        before, token = self.tokens[index - 1].text, self.tokens[index].text
        if before not in {";", "{", "}"} and not self.is_label(index - 1):
            return
        if before == ";" and self.is_in_brackets(index):
            return  # in the head of a loop
        is_declaration = is_type(token) or (
            self.tokens[index + 1].text.isidentifier() and token not in {"break", "continue"}
        )
        is_return = token == "return" and self.tokens[index + 1].text == ";"
        if (token in NO_STATEMENT and not is_return) or is_declaration or token in "{};":
            return
        last = index
        while self.tokens[last].text != ";":
            if self.tokens[last].text in {")", "]", "}"}:
                return  # an initialiser
            last = self.match.get(last, last) + 1
        self.change(index, last, ";")

    def is_label(self, index: int) -> bool:
        """Whether this colon ends a label of a switch."""
        if self.tokens[index].text != ":":
            return False
        while self.tokens[index].text not in {"?", ";", "{", "}"}:
            if self.tokens[index].text in {"case", "default"}:
                return True
            index -= 1
        return False

    def is_in_brackets(self, index: int) -> bool:
        depth = 0
        for token in reversed(self.tokens[:index]):
            if token.text in "{}":
                return False
            depth += {")": 1, "(": -1}.get(token.text, 0)
            if depth < 0:
                return True
        return False

    def defines(self) -> None:
        """Constants, and the rows of tables that a macro holds."""
        for match in DEFINE.finditer(self.clean):
            name, arguments, body = match.groups()
            at = match.start(3)
            if arguments == "(row)":
                self.rows(body, at)
            elif not arguments and not name.endswith("_CAPACITY"):
                self.tokens = [
                    Token(m[0], at + m.start(), at + m.end()) for m in TOKEN.finditer(body)
                ]
                if self.tokens and self.tokens[0].text != "\\":
                    self.tokens.insert(0, Token("(", at, at))
                    self.tokens.append(Token(")", match.end(3), match.end(3)))
                    self.match = self.brackets()
                    self.inside(1, len(self.tokens) - 1, is_code=False)

    def rows(self, body: str, at: int) -> None:
        """In each row another word in its last two places: the next of that column."""
        rows = [
            [(m.start(1) + f.start(), f[0]) for f in re.finditer(r"[^,\s][^,]*", m[1])]
            for m in ROW.finditer(body)
        ]
        for column in (-2, -1):
            words = list(dict.fromkeys(row[column][1] for row in rows if len(row) > 1))
            for row in rows:
                if len(words) > 1 and len(row) > 1:
                    start, word = row[column]
                    other = words[(words.index(word) + 1) % len(words)]
                    self.changes.append((at + start, at + start + len(word), other))


def one_line(text: str) -> str:
    return re.sub(r"\s+", " ", text).strip()


def mutants_of(name: str, text: str) -> Iterator[Mutant]:
    """Every mutant of a file, in the order of their places. Their ids hang on the lines they change
    and on nothing else in the file, but where the same change can be made twice: there they are
    counted."""
    seen: Counter[str] = Counter()
    for start, end, other in sorted(set(File(text).changes)):
        first = text.rfind("\n", 0, start) + 1
        last = text.find("\n", end)
        before = one_line(text[first:last])
        after = one_line(text[first:start] + other + text[end:last])
        change = f"{name}\n{before}\n{after}"
        seen[change] += 1
        digest = hashlib.sha256(f"{change}\n{seen[change]}".encode()).hexdigest()[:10]
        line = text.count("\n", 0, start) + 1
        yield Mutant(f"{name}:{digest}", name, line, start, end, other, before, after)


def all_mutants(folder: Path) -> list[Mutant]:
    found = []
    for path in sorted(folder.glob("*.[ch]")):
        found += mutants_of(path.name, path.read_text(encoding="utf-8"))
    return found
