"""Another reading of COG scripts, to hold the front end to: one character and one goal at a time.

It knows the facts of the language (which text is a token, which tokens are a statement) and nothing of the front end,
of Lark or of regular expressions. It says whether the engine takes a script, and where it stops if not; it knows no
limits of size.
"""

from __future__ import annotations

from dataclasses import dataclass, field

LETTERS = frozenset("abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ_")
DIGITS = frozenset("0123456789")
KEYWORDS = frozenset(["if", "else", "while", "do", "for", "goto", "call", "return", "stop", "break", "continue"])
PAIRS = frozenset(("&&", "||", "<=", ">=", "==", "!="))
SINGLES = frozenset(";{},:=()[].&!~-+*/%<>^|")
OPERATORS = frozenset(["||", "&&", "|", "^", "&", "==", "!=", "<", ">", "<=", ">=", "+", "-", "*", "/", "%"])


@dataclass
class Verdict:
    """Where the engine stops reading, or None when it takes the script."""

    stop: int | None = None


@dataclass
class Tokens:
    """Kinds and offsets; the last is the end."""

    kinds: list[str] = field(default_factory=list)
    starts: list[int] = field(default_factory=list)

    def add(self, kind: str, start: int) -> None:
        self.kinds.append(kind)
        self.starts.append(start)


def read(text: str) -> Verdict:
    """Read a whole script."""
    code = _code_start(text)
    if isinstance(code, Verdict):
        return code
    tokens = _tokens(text, code)
    return _Statements(tokens).read()


# ---- header


def _lines(text: str):
    """Joined lines of the header: offset of the first, words, offset behind."""
    at = 0
    while at < len(text):
        start, joined = -1, ""
        while True:
            feed = text.find("\n", at)
            end = len(text) if feed < 0 else feed + 1
            piece, begin, at = text[at:end], at, end
            if piece and piece[0] not in ";#\n\r":
                start = begin + len(piece) - len(piece.lstrip(" \t\r\n,")) if start < 0 else start
                piece = piece.split("#")[0] if "#" in piece else piece
                if len(joined + piece) >= 2 and (joined + piece)[-2] == "\\":
                    joined = (joined + piece)[:-2]
                    if at < len(text):
                        continue
                else:
                    joined += piece
                break
            if at >= len(text):
                break
        words = joined.split("\0")[0].replace(",", " ").replace("\t", " ").replace("\r", " ").replace("\n", " ")
        parted = [word for word in words.split(" ") if word]
        if parted:
            yield start, [w.lower() if w.isascii() else w for w in parted], at


def _value(word: str) -> str:
    key, equals, value = word.partition("=")
    return value if equals else key


def _code_start(text: str) -> int | Verdict:
    lines = list(_lines(text))
    at = 0
    if lines and lines[0][1][0].partition("=")[0] == "flags":
        at = 1
    if at >= len(lines) or _value(lines[at][1][0]) != "symbols":
        known = any(_value(words[0]) == "symbols" for _, words, _ in lines[at:])
        return Verdict(lines[at][0] if known else len(text))
    at += 1
    while at < len(lines) and _value(lines[at][1][0]) != "end":
        at += 1
    if at >= len(lines):
        return Verdict(len(text))
    at += 1
    if at >= len(lines) or _value(lines[at][1][0]) != "code":
        known = any(_value(words[0]) == "code" for _, words, _ in lines[at:])
        return Verdict(lines[at][0] if known else len(text))
    return lines[at][2]


# ---- tokens


def _tokens(text: str, at: int) -> Tokens:
    found = Tokens()
    size = len(text)
    while at < size:
        c = text[at]
        if c in LETTERS:
            start = at
            while at < size and (text[at] in LETTERS or text[at] in DIGITS):
                at += 1
            word = text[start:at].lower()
            if word == "end":
                found.add("$", start)
                return found
            found.add("return" if word == "stop" else word if word in KEYWORDS else "name", start)
        elif c in DIGITS or (c == "." and at + 1 < size and text[at + 1] in DIGITS):
            found.add("value", at)
            at = _number_end(text, at)
        elif c in "\"'":
            end = _quote_end(text, at)
            if end > 0:
                found.add("value", at)
            at = max(end, at + 1)
        elif c == "#" or text[at : at + 2] == "//":
            while at < size and text[at] != "\n":
                at += 1
        elif text[at : at + 2] in PAIRS:
            found.add(text[at : at + 2], at)
            at += 2
        else:
            if c in SINGLES:
                found.add(c, at)
            at += 1
    found.add("$", size)
    return found


def _number_end(text: str, at: int) -> int:
    if text[at : at + 2].lower() == "0x" and text[at + 2 : at + 3] in set("0123456789abcdefABCDEF"):
        at += 2
        while at < len(text) and text[at] in "0123456789abcdefABCDEF":
            at += 1
        return at
    while at < len(text) and text[at] in DIGITS:
        at += 1
    if text[at : at + 1] == ".":
        at += 1
        while at < len(text) and text[at] in DIGITS:
            at += 1
    if text[at : at + 1] in ("e", "E"):
        tail = at + 1 + (text[at + 1 : at + 2] in ("+", "-"))
        if text[tail : tail + 1] in DIGITS:
            at = tail
            while at < len(text) and text[at] in DIGITS:
                at += 1
    return at


def _quote_end(text: str, at: int) -> int:
    quote = text[at]
    at += 1
    while at < len(text):
        if text[at] == quote:
            return at + 1
        if text[at] == "\\":
            if text[at + 1 : at + 2] in ("\n", ""):
                return -1
            at += 1
        at += 1
    return -1


# ---- statements


class _Statements:
    def __init__(self, tokens: Tokens) -> None:
        self.kinds, self.starts = tokens.kinds, tokens.starts
        self.at = 0

    def read(self) -> Verdict:
        goals = ["more", "statement"]
        while goals:
            goal = goals.pop()
            if not self._meet(goal, goals):
                return Verdict(self.starts[self.at])
        return Verdict(None if self.kinds[self.at] == "$" else self.starts[self.at])

    @property
    def kind(self) -> str:
        return self.kinds[self.at]

    def _take(self, *wanted: str) -> bool:
        for kind in wanted:
            if kind == "expression":
                if not self._expression():
                    return False
            elif self.kind != kind:
                return False
            else:
                self.at += 1
        return True

    def _meet(self, goal: str, goals: list[str]) -> bool:
        if goal == "more":
            if self.kind not in ("$", "}"):
                goals += ["more", "statement"]
            return True
        if goal == "else":
            if self.kind == "else":
                self.at += 1
                goals.append("statement")
            return True
        if goal == "while":
            return self._take("while", "(", "expression", ")", ";")
        if goal != "statement":
            return self._take(goal)
        kind = self.kind
        if kind == "name" and self.kinds[self.at + 1] == ":":
            self.at += 2
            goals.append("statement")
            return True
        if kind == "{":
            self.at += 1
            goals += ["}", "more"]
            return True
        if kind in ("if", "while"):
            goals += ["else", "statement"] if kind == "if" else ["statement"]
            return self._take(kind, "(", "expression", ")")
        if kind == "do":
            self.at += 1
            goals += ["while", "statement"]
            return True
        if kind == "for":
            goals.append("statement")
            opened = self._take("for", "(")
            for _ in range(2):
                opened = opened and (self.kind == ";" or self._expression()) and self._take(";")
            return opened and self._take("expression", ")")
        if kind in ("goto", "call"):
            return self._take(kind, "name", ";")
        if kind == "return":
            return self._take("return", ";")
        return self._take(";") if kind == ";" else self._take("expression", ";")

    def _expression(self) -> bool:
        """Read as long as an expression can go on; the place is where it cannot."""
        brackets: list[tuple[str, bool]] = []
        unary = True  # whether what was read since the last = or , is one unary expression
        while True:
            while self.kind in ("-", "!", "("):  # a value is wanted
                if self.kind == "(":
                    brackets.append((")", unary))
                    unary = True
                self.at += 1
            if self.kind not in ("name", "value"):
                return False
            self.at += 1
            while True:  # a value was read
                kind = self.kind
                if kind in ("(", "["):
                    brackets.append((")" if kind == "(" else "]", unary))
                    unary = True
                    self.at += 1
                    if kind == "(" and self.kind == ")":
                        unary = brackets.pop()[1]
                        self.at += 1
                        continue
                    break
                if brackets and kind == brackets[-1][0]:
                    unary = brackets.pop()[1]
                    self.at += 1
                    continue
                if kind == "," or (kind == "=" and unary):
                    unary = True
                elif kind in OPERATORS:
                    unary = False
                else:
                    return not brackets
                self.at += 1
                break
