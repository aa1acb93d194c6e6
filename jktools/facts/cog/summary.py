"""What `jktools cog` says of a script, as plain data: its symbols, messages, calls, rates and verbs."""

from __future__ import annotations

import math
from collections.abc import Iterator

import msgspec

from jktools.facts.cog import ranges
from jktools.facts.cog.rates import Site, Source
from jktools.facts.script import ScriptFacts
from jktools.model.cog.program import Handler, Role
from jktools.syntax.cog.header import LINKED_TYPES, NO_LINK
from jktools.syntax.cog.nodes import Call, Name, Node, Symbol

OUTSIDE = frozenset({"event", "thing pulse", "thing timer"})
"""Kinds of sources whose number the script alone does not tell."""

FLAG_NAMES = {
    0x1: "debug", 0x2: "disabled", 0x4: "pulse", 0x8: "timer", 0x10: "paused", 0x20: "class", 0x40: "local",
    0x80: "server", 0x100: "global", 0x200: "no sync",
}  # fmt: skip


class SymbolSummary(msgspec.Struct, frozen=True):
    """A declared symbol that is no message."""

    name: str
    type: str
    default: str | None
    local: bool
    link: int | None
    """Link id; None where its messages do not reach the script."""
    mask: int | None
    line: int


class SourceSummary(msgspec.Struct, frozen=True):
    """One way in which a message comes to be sent."""

    kind: str
    """`once` and `event` come from the level; the others from a call of the script."""
    least_seconds: float | None
    """The shortest interval or delay that the call sets; None where it sets none or it is not known."""
    most_seconds: float | None
    line: int | None
    """Of the call."""
    off: bool
    """Whether the call can only switch a pulse or timer off."""
    senders: tuple[str, ...]
    """Labels of the handlers that lead to the call."""


class MessageSummary(msgspec.Struct, frozen=True):
    """A message that the script declares."""

    name: str
    label: str
    handled: bool
    """Whether it runs code: not without a label of that name, or behind an earlier declaration."""
    line: int
    """Of the label, or of the declaration where there is none."""
    sources: tuple[SourceSummary, ...]
    runs_per_minute: float | None
    """The most that the script itself can cause; None where nothing bounds it, or the level has a say."""


class PassageSummary(msgspec.Struct, frozen=True):
    """A way from the code below one label to another label."""

    source: str
    target: str
    how: str
    """`call`, `goto` or `falls`."""


class RunSummary(msgspec.Struct, frozen=True):
    """How often the runs of a handler call a verb."""

    label: str
    per_run: float | None
    """The most calls a run; None where nothing bounds it."""
    per_second: float
    """More calls a second while a loop of the run sleeps."""


class VerbSummary(msgspec.Struct, frozen=True):
    """A name that the code calls."""

    name: str
    known: bool
    """Whether the game has such a verb."""
    lines: tuple[int, ...]
    """Of each call."""
    sleeps: bool
    sight: str | None
    """`ray`, `flood` or `cached` for a verb of sight, by what it costs."""
    runs: tuple[RunSummary, ...]


class ScriptSummary(msgspec.Struct, frozen=True):
    """A whole script."""

    path: str
    game: str
    rejected: bool
    """Whether the engine refuses it; what follows is then what could be read."""
    flags: int
    symbols: tuple[SymbolSummary, ...]
    messages: tuple[MessageSummary, ...]
    labels: tuple[str, ...]
    calls: tuple[PassageSummary, ...]
    verbs: tuple[VerbSummary, ...]


def summarise(facts: ScriptFacts) -> ScriptSummary:
    """All that is to be said of a script, in the order of its text."""
    script, program = facts.script, facts.program
    return ScriptSummary(
        script.path,
        script.game,
        script.rejected,
        script.header.flags,
        tuple(_symbol(facts, s) for s in script.header.symbols if s.type != "message"),
        tuple(_messages(facts)),
        tuple(program.labels),
        tuple(_passages(facts)),
        tuple(_verbs(facts)),
    )


def _line(facts: ScriptFacts, node: Node) -> int:
    return facts.script.source.position(node.start).line


def _symbol(facts: ScriptFacts, symbol: Symbol) -> SymbolSummary:
    linked = symbol.type in LINKED_TYPES and symbol.link != NO_LINK
    link, mask = (symbol.link, symbol.mask) if linked else (None, None)
    return SymbolSummary(
        symbol.name.key, symbol.type, symbol.default, symbol.local, link, mask, _line(facts, symbol)
    )  # fmt: skip


def _messages(facts: ScriptFacts) -> Iterator[MessageSummary]:
    program, rates = facts.program, facts.rates
    once = {label: 1.0 for label, sources in rates.sources.items() if any(s.kind == "once" for s in sources)}
    most = rates.most_runs(60.0, once)
    for symbol, message in program.declared_messages:
        handler = program.handler_of.get(symbol.name.key)
        own = handler is not None and handler.declared is symbol
        labelled = program.labels.get(symbol.name.key)
        yield MessageSummary(
            message.name if message is not None else symbol.default or symbol.name.key,
            symbol.name.key,
            own,
            _line(facts, labelled.label if own and labelled is not None else symbol),
            tuple(_source(facts, s) for s in rates.sources[handler.label]) if own and handler is not None else (),
            _runs(facts, handler, most[handler.label]) if own and handler is not None else 0.0,
        )


def _runs(facts: ScriptFacts, handler: Handler, most: float) -> float | None:
    if any(s.kind in OUTSIDE for s in facts.rates.sources[handler.label]):
        return None
    return _finite(most)


def _source(facts: ScriptFacts, source: Source) -> SourceSummary:
    low, high = (-math.inf, math.inf) if source.seconds is None else ranges.as_flex(source.seconds)
    line = None if source.site is None else _line(facts, source.site.call)
    return SourceSummary(source.kind, _finite(low), _finite(high), line, source.off, source.senders)


def _passages(facts: ScriptFacts) -> Iterator[PassageSummary]:
    for passage in facts.reach.passages:
        yield PassageSummary(passage.source, passage.target, passage.how)


def _finite(value: float) -> float | None:
    """None for what is not known: infinite, or the end of all ints."""
    return value if math.isfinite(value) and abs(value) < 2**31 - 1 else None


def _verbs(facts: ScriptFacts) -> Iterator[VerbSummary]:
    program = facts.program
    sites: dict[str, list[Site]] = {}
    for site in facts.rates.sites:
        sites.setdefault(site.verb.name, []).append(site)
    calls: dict[str, list[Call]] = {}
    for part in program.of_kind(Call):
        if isinstance(part.callee, Name):
            calls.setdefault(part.callee.name, []).append(part)
    for name, found in calls.items():
        verb = program.verb_of(found[0])
        yield VerbSummary(
            name,
            program.role_of(name) is Role.VERB,
            tuple(_line(facts, call) for call in found),
            verb is not None and verb.sleeps,
            verb.sight if verb is not None else None,
            tuple(_run_counts(facts, sites.get(name, []))),
        )


def _run_counts(facts: ScriptFacts, sites: list[Site]) -> Iterator[RunSummary]:
    for label in facts.rates.repeats:
        passes = [facts.rates.repeats_of(label, site) for site in sites]
        per_run, per_second = sum(p.per_run for p in passes), sum(p.per_second for p in passes)
        if per_run or per_second:
            yield RunSummary(label, _finite(per_run), per_second)
