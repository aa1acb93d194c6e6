"""The names of a script as the engine binds them: symbols, labels, messages, verbs."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from enum import Enum, auto
from functools import cached_property
from types import MappingProxyType
from typing import TypeVar, cast

import msgspec

from jktools.model.cog.messages import GLOBALS, Message, messages_of
from jktools.model.cog.verbs import Verb, all_verbs, verbs_of
from jktools.syntax.cog.nodes import (
    Assign,
    Call,
    CallLabel,
    Code,
    Expression,
    ExprStatement,
    For,
    Goto,
    Header,
    Index,
    Labeled,
    Name,
    Node,
    Statement,
    String,
    Symbol,
)
from jktools.syntax.cog.walk import expressions, postorder, statements

N = TypeVar("N", bound=Node)


@dataclass(frozen=True)
class Vocabulary:
    """What a script of one game can name without declaring it: verbs, with those of the user's own build, messages."""

    game: str = "jk"
    own_verbs: Mapping[str, Verb] = field(default_factory=lambda: MappingProxyType({}))

    @cached_property
    def verbs(self) -> Mapping[str, Verb]:
        """By lower-case name; the user's own win."""
        return {**verbs_of(self.game), **self.own_verbs} if self.own_verbs else verbs_of(self.game)

    @cached_property
    def messages(self) -> Mapping[str, Message]:
        """By lower-case name."""
        return messages_of(self.game)

    def elsewhere(self, name: str) -> Verb | None:
        """A verb that another game or engine knows, and this one does not."""
        return None if name in self.verbs else all_verbs().get(name)


class Role(Enum):
    """What a name of the code stands for; the script's own symbols come before what all scripts share."""

    SYMBOL = auto()
    """Declared in the header."""
    IMPLICIT = auto()
    """A variable that the engine makes on the spot, a flex 0."""
    VERB = auto()
    MESSAGE = auto()
    """A message that is not declared: its id."""
    SHARED = auto()
    """`global0` to `global15`."""


class Slot(msgspec.Struct, frozen=True):
    """An entry of the script's symbol table; `name[i]` counts them."""

    index: int
    name: str
    type: str
    """The type word of the header; `implicit` or `string` for what only the code names."""
    declared: Symbol | None = None
    text: str | None = None
    """Of a string literal."""

    @property
    def takes_value(self) -> bool:
        """Whether a level's `cogs` line gives it a value."""
        return self.declared is not None and self.type != "message" and not self.declared.local


@dataclass(frozen=True, slots=True)
class Handler:
    """A label that a message runs."""

    message: Message
    label: str
    declared: Symbol


class Program:
    """A script's header and code with every name resolved. Nothing here raises, whatever the script says."""

    def __init__(self, header: Header, code: Code, vocabulary: Vocabulary | None = None) -> None:
        """Bind nothing yet."""
        self.header = header
        self.code = code
        self.vocabulary = vocabulary or Vocabulary()

    # ---- the symbol table

    @cached_property
    def slots(self) -> tuple[Slot, ...]:
        """Declared symbols, then what the code names first, in its order: variables, labels, one entry a string."""
        found = [Slot(i, s.name.key, s.type, s) for i, s in enumerate(self.header.symbols)]
        known = {slot.name for slot in found}
        verbs, messages = self.vocabulary.verbs, self.vocabulary.messages
        for word in self.code.words:
            if isinstance(word, String):
                found.append(Slot(len(found), "", "string", text=word.value))
            elif word.name not in known:
                known.add(word.name)
                if word.name not in verbs and word.name not in messages and word.name not in GLOBALS:
                    found.append(Slot(len(found), word.name, "implicit"))
        return tuple(found)

    @cached_property
    def slot_of(self) -> Mapping[str, Slot]:
        """By name: the first of a name owns it."""
        found: dict[str, Slot] = {}
        for slot in self.slots:
            if slot.type != "string":
                found.setdefault(slot.name, slot)
        return found

    @cached_property
    def string_slots(self) -> Mapping[int, Slot]:
        """The hidden entry of each string literal, by where the literal starts."""
        literals = [word.start for word in self.code.words if isinstance(word, String)]
        return dict(zip(literals, (slot for slot in self.slots if slot.type == "string"), strict=True))

    def role_of(self, name: str) -> Role:
        """What a name stands for where the code reads, assigns or calls it."""
        slot = self.slot_of.get(name)
        if slot is not None:
            return Role.IMPLICIT if slot.declared is None else Role.SYMBOL
        if name in self.vocabulary.verbs:
            return Role.VERB
        return Role.MESSAGE if name in self.vocabulary.messages else Role.SHARED

    @cached_property
    def valued(self) -> tuple[Slot, ...]:
        """The symbols that a level's `cogs` line gives values to, in its order."""
        return tuple(slot for slot in self.slots if slot.takes_value)

    # ---- labels and messages

    @cached_property
    def statements(self) -> tuple[Statement, ...]:
        """All statements, each before those in it."""
        return tuple(statements(self.code.body))

    @cached_property
    def labels(self) -> Mapping[str, Labeled]:
        """By name: the last of a name is the one that counts."""
        return {s.label.name: s for s in self.of_kind(Labeled)}

    @cached_property
    def declared_messages(self) -> tuple[tuple[Symbol, Message | None], ...]:
        """The `message` symbols, each with the message that it binds, None for a name that is no message."""
        known = self.vocabulary.messages
        declared = [symbol for symbol in self.header.symbols if symbol.type == "message"]
        return tuple((symbol, known.get(symbol.default or symbol.name.key)) for symbol in declared)

    @cached_property
    def handlers(self) -> tuple[Handler, ...]:
        """What each message runs; the first declaration of an id wins, and one without a label runs nothing."""
        found: dict[int, Handler] = {}
        for symbol, message in self.declared_messages:
            if message is not None:
                found.setdefault(message.id, Handler(message, symbol.name.key, symbol))
        return tuple(h for h in found.values() if h.label in self.labels)

    @cached_property
    def handler_of(self) -> Mapping[str, Handler]:
        """By label."""
        return {h.label: h for h in self.handlers}

    def handles(self, message_id: int) -> bool:
        """Whether a message runs anything here."""
        return any(h.message.id == message_id for h in self.handlers)

    # ---- uses

    @cached_property
    def expressions(self) -> tuple[Expression, ...]:
        """Every expression of the code and all that is in it, parts before the whole."""
        found: list[Expression] = []
        for statement in self.statements:
            for whole in expressions(statement):
                found += postorder(whole)
        return tuple(found)

    @cached_property
    def _by_kind(self) -> Mapping[type[Node], list[Node]]:
        found: dict[type[Node], list[Node]] = {}
        for nodes in (self.statements, self.expressions):
            for node in nodes:
                kind = type(node)
                if kind in found:
                    found[kind].append(node)
                else:
                    found[kind] = [node]
        return found

    def of_kind(self, kind: type[N]) -> Sequence[N]:
        """Every statement or expression of one kind, as `statements` and `expressions` list them."""
        return cast("Sequence[N]", self._by_kind.get(kind, ()))

    @cached_property
    def dropped(self) -> frozenset[Expression]:
        """Expressions that nothing takes the value of: statements of their own, and the first and last of a `for`."""
        found: list[Expression | None] = [s.expression for s in self.of_kind(ExprStatement)]
        for loop in self.of_kind(For):
            found += (loop.first, loop.step)
        return frozenset(each for each in found if each is not None)

    @cached_property
    def calls(self) -> tuple[tuple[Call, Verb], ...]:
        """The calls that reach a verb."""
        found = []
        for part in self.of_kind(Call):
            verb = self.verb_of(part)
            if verb is not None:
                found.append((part, verb))
        return tuple(found)

    def verb_of(self, call: Call) -> Verb | None:
        """The verb that a call runs; None where a symbol hides it, or there is none."""
        if not isinstance(call.callee, Name) or call.callee.name in self.slot_of:
            return None
        return self.vocabulary.verbs.get(call.callee.name)

    @cached_property
    def assigned(self) -> Mapping[str, tuple[Name, ...]]:
        """Where each name is assigned, as a whole or as the start of an array."""
        found: dict[str, list[Name]] = {}
        for part in self.of_kind(Assign):
            target = part.target.base if isinstance(part.target, Index) else part.target
            if isinstance(target, Name):
                found.setdefault(target.name, []).append(target)
        return {name: tuple(places) for name, places in found.items()}

    @cached_property
    def read(self) -> Mapping[str, tuple[Name, ...]]:
        """Where each name is read: not where it is called, assigned as a whole, or a label."""
        skipped: set[Expression] = {part.target for part in self.of_kind(Assign)}
        skipped.update(part.callee for part in self.of_kind(Call))
        found: dict[str, list[Name]] = {}
        for part in self.of_kind(Name):
            if part not in skipped:
                found.setdefault(part.name, []).append(part)
        return {name: tuple(places) for name, places in found.items()}

    @cached_property
    def called(self) -> Mapping[str, tuple[Name, ...]]:
        """Where each name stands before parentheses."""
        found: dict[str, list[Name]] = {}
        for part in self.of_kind(Call):
            if isinstance(part.callee, Name):
                found.setdefault(part.callee.name, []).append(part.callee)
        return {name: tuple(places) for name, places in found.items()}

    @cached_property
    def jumps(self) -> tuple[Goto | CallLabel, ...]:
        """Every `goto` and `call`, in the order of the text."""
        return tuple(sorted((*self.of_kind(Goto), *self.of_kind(CallLabel)), key=lambda s: s.start))
