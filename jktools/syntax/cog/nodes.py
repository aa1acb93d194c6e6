"""The tree of a COG script: header, statements, expressions, each with its range of bytes.

Nodes are compared by identity, so that they can key a dict. Their depth is the user's: a sum of a million terms is a
tree a million deep. Walk them with `jktools.syntax.cog.walk`, never by recursion. Nodes with parts are left to the
garbage collector, because only then does Python free a deep tree without recursion of its own.
"""

from __future__ import annotations

import msgspec


class Node(msgspec.Struct, frozen=True, eq=False):
    """A part of a script: the bytes from `start` up to, not including, `end`."""

    start: int
    end: int


# ---- expressions


class Name(Node, frozen=True, eq=False, gc=False):
    """An identifier: a symbol, a verb, or a label where it stands in `Labeled`, `Goto` and `CallLabel`."""

    name: str
    """In lower case, as the engine compares names."""


class Number(Node, frozen=True, eq=False, gc=False):
    """A number. A flex (`float` here) is rounded to float32, an int wraps to 32 bits with sign."""

    value: int | float
    text: str
    """As written."""

    @property
    def is_flex(self) -> bool:
        """Whether the engine pushes a flex."""
        return isinstance(self.value, float)


class String(Node, frozen=True, eq=False, gc=False):
    """A string literal; a backslash keeps the next character from ending it, and stays."""

    value: str
    """Between the quotes."""


class Vector(Node, frozen=True, eq=False, gc=False):
    """A vector literal `'x y z'`; parts that the engine's scanf does not reach are 0."""

    value: tuple[float, float, float]
    """Each rounded to float32."""
    text: str
    """Between the quotes."""


class Unary(Node, frozen=True, eq=False):
    """`-` or `!`."""

    op: str
    operand: Expression


class Binary(Node, frozen=True, eq=False):
    """An operator of two operands: `+ - * / % < > <= >= == != & ^ | && ||`, or `,` outside arguments."""

    op: str
    left: Expression
    right: Expression


class Assign(Node, frozen=True, eq=False):
    """`target = value`. The grammar takes any unary expression as target; only a name or `name[i]` means something."""

    target: Expression
    value: Expression


class Call(Node, frozen=True, eq=False):
    """`callee(arguments)`; the grammar takes any postfix expression as callee."""

    callee: Expression
    arguments: tuple[Expression, ...]


class Index(Node, frozen=True, eq=False):
    """`base[index]`."""

    base: Expression
    index: Expression


Expression = Name | Number | String | Vector | Unary | Binary | Assign | Call | Index


# ---- statements


class ExprStatement(Node, frozen=True, eq=False):
    """An expression and its semicolon; what it pushes stays on the stack."""

    expression: Expression


class Block(Node, frozen=True, eq=False):
    """`{ ... }`."""

    body: tuple[Statement, ...]


class If(Node, frozen=True, eq=False):
    """`if (condition) then`, with `else otherwise` or without."""

    condition: Expression
    then: Statement
    otherwise: Statement | None


class While(Node, frozen=True, eq=False):
    """`while (condition) body`."""

    condition: Expression
    body: Statement


class DoWhile(Node, frozen=True, eq=False):
    """`do body while (condition);`."""

    body: Statement
    condition: Expression


class For(Node, frozen=True, eq=False):
    """`for (first; condition; step) body`; without a condition the loop tests what lies on the stack."""

    first: Expression | None
    condition: Expression | None
    step: Expression
    body: Statement


class Goto(Node, frozen=True, eq=False):
    """`goto label;`."""

    label: Name


class CallLabel(Node, frozen=True, eq=False):
    """`call label;`."""

    label: Name


class Return(Node, frozen=True, eq=False):
    """`return;` or `stop;`, which are the same."""

    keyword: str
    """`return` or `stop`."""


class Labeled(Node, frozen=True, eq=False):
    """`label: statement`; labels may stack and may stand inside blocks."""

    label: Name
    statement: Statement


class Empty(Node, frozen=True, eq=False):
    """`;` alone."""


class Unreadable(Node, frozen=True, eq=False):
    """Text that is no statement, in a script that the engine refuses; nothing is known of what it was to do."""


Statement = (
    ExprStatement | Block | If | While | DoWhile | For | Goto | CallLabel | Return | Labeled | Empty | Unreadable
)


class Code(Node, frozen=True, eq=False):
    """What stands between the `code` line and the end of the code."""

    body: tuple[Statement, ...]
    words: tuple[Name | String, ...]
    """Every name and string literal, labels included, as the engine's scanner meets them: the order in which it makes
    symbols of them. In a script that is refused, those of what could be read."""
    closed: bool
    """Whether an `end` closes it; else the end of the file does."""


# ---- header


class Attribute(Node, frozen=True, eq=False):
    """A word of the header, `key=value`, or a word alone, whose key and value are the same text."""

    key: str
    value: str
    has_value: bool
    """Whether there is a `=`."""


class Symbol(Node, frozen=True, eq=False):
    """A line of the `symbols` section, in lower case as the engine reads it."""

    type: str
    """The type word: `thing`, `flex`, `message`, ... or one that the engine does not know."""
    name: Attribute
    """`name` or `name=default`; for a message `name` or `label=message`."""
    attributes: tuple[Attribute, ...]
    """All words that follow, whether they mean something or not."""
    local: bool
    """Takes no value from a level's `cogs` line."""
    link: int
    """Link id of a thing, surface or sector whose messages the script gets; -1 for no link."""
    mask: int
    """Types of things that may cause a message, one bit a type; 0x400 player, 0x1 no thing."""

    @property
    def default(self) -> str | None:
        """The default value in lower case, None without one. For a message, the message that the label is bound to."""
        return self.name.value if self.name.has_value else None


class Header(Node, frozen=True, eq=False):
    """What stands before the code."""

    flags: int
    """0 without a `flags=` line."""
    flags_word: Attribute | None
    symbols: tuple[Symbol, ...]
    """Those that the engine keeps, in order: of a known type, duplicates included."""
    dropped: tuple[Symbol, ...]
    """Lines that the engine drops in silence: of no known type, without a name, or past a limit."""
