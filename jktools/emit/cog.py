"""What is known of scripts, as JSON and as text."""

from __future__ import annotations

import re
from collections.abc import Iterator, Mapping, Sequence

import msgspec

from jktools import __version__
from jktools.diagnostics import Diagnostic
from jktools.emit.json import diagnostic_object, dump
from jktools.emit.printable import printable
from jktools.facts.cog.summary import (
    FLAG_NAMES,
    MessageSummary,
    RunSummary,
    ScriptSummary,
    SourceSummary,
    SymbolSummary,
    VerbSummary,
)
from jktools.facts.hotspots import CostSummary, frequency, mean_work

Costs = Mapping[str, Sequence[CostSummary]]
"""What tests of sight cost in a level, by the lower-case name of the script."""

VERSION = 1
"""Of the shape of this output; grows when a reader would have to change."""

Told = tuple[ScriptSummary, Sequence[Diagnostic]]
"""A script, and why the engine refuses it."""


def as_json(scripts: Sequence[Told], costs: Costs | None = None) -> str:
    """The report as JSON; its shape is docs/cog.schema.json. Scripts have `costs` where a level was asked for."""
    return dump(
        {
            "version": VERSION,
            "tool": {"name": "jktools", "version": __version__},
            "scripts": [
                {
                    **msgspec.to_builtins(summary),
                    "faults": [diagnostic_object(d) for d in faults],
                    **({} if costs is None else {"costs": msgspec.to_builtins(_of(summary, costs))}),
                }
                for summary, faults in scripts
            ],
        }
    )


def as_text(scripts: Sequence[Told], costs: Costs | None = None) -> str:
    """The report for people; with what tests of sight cost where a level was asked for."""
    lines: list[str] = []
    for summary, faults in scripts:
        lines += _lines(summary, faults)
        if costs is not None:
            lines += _cost_lines(_of(summary, costs))
    return "\n".join(map(printable, lines)) + "\n"


def _of(script: ScriptSummary, costs: Costs) -> Sequence[CostSummary]:
    return costs.get(re.split(r"[/\\!]", script.path)[-1].lower(), ())


def _cost_lines(costs: Sequence[CostSummary]) -> Iterator[str]:
    yield f"  costs of sight ({len(costs)}):"
    for cost in costs:
        often = frequency(cost.calls_per_second, cost.more, cost.causes)
        yield f"    {cost.verb}, line {cost.line}, {cost.runner}: {often}; {_work(cost)}"
        yield f"      {cost.help}"


def _work(cost: CostSummary) -> str:
    if not cost.pairs:
        return "its cost is not known"
    known = "" if cost.finds is None else f"; {cost.finds}"
    return f"{mean_work(cost)}, {cost.most_surfaces} in {cost.most_sectors} at most{known}"


def _lines(script: ScriptSummary, faults: Sequence[Diagnostic]) -> Iterator[str]:
    flags = ", ".join(name for bit, name in FLAG_NAMES.items() if script.flags & bit)
    yield f"{script.path}: script for game {script.game}, flags 0x{script.flags:x}{f' ({flags})' * bool(flags)}"
    if script.rejected:
        yield "  refused by the engine; this is what could be read:"
        yield from (f"    line {d.label.span.first.line}: {d.message}" for d in faults if d.label.span is not None)
    yield f"  symbols ({len(script.symbols)}):"
    yield from (f"    {_symbol(symbol)}" for symbol in script.symbols)
    yield f"  messages ({len(script.messages)}):"
    for message in script.messages:
        yield f"    {_message(message)}"
        yield from (f"      {_source(source)}" for source in message.sources)
    yield f"  labels ({len(script.labels)}): {', '.join(script.labels)}".rstrip(" :")
    yield f"  calls ({len(script.calls)}):"
    yield from (f"    {c.source} {'->' if c.how != 'falls' else 'falls into'} {c.target}"
                f"{f' ({c.how})' * (c.how != 'falls')}" for c in script.calls)  # fmt: skip
    yield f"  verbs ({len(script.verbs)}):"
    yield from (f"    {_verb(verb)}" for verb in script.verbs)


def _symbol(symbol: SymbolSummary) -> str:
    words = [f"{symbol.type:<9} {symbol.name}"]
    if symbol.default is not None:
        words.append(f"= {symbol.default}")
    if symbol.local:
        words.append("(local)")
    if symbol.link is not None and symbol.mask is not None:
        words.append(f"(linked, id {symbol.link}, mask 0x{symbol.mask:x})")
    return " ".join(words)


def _message(message: MessageSummary) -> str:
    label = f" at {message.label}" * (message.label != message.name)
    if not message.handled:
        return f"{message.name}{label}: runs nothing"
    runs = message.runs_per_minute
    alone = all(source.kind == "once" for source in message.sources)
    rate = "" if runs is None or alone else f", at most {runs:.6g} times a minute by what the script does"
    return f"{message.name}{label}: line {message.line}{rate}"


_KINDS = {
    "once": "sent once",
    "event": "sent by the level or the player",
    "pulse": "pulse of this script",
    "timer": "timer of this script",
    "each timer": "one timer for each call",
    "thing pulse": "pulse of a thing",
    "thing timer": "timer of a thing",
    "message": "sent by this script",
    "trigger": "trigger sent by this script",
}


def _source(source: SourceSummary) -> str:
    words = _KINDS[source.kind]
    low, high = source.least_seconds, source.most_seconds
    if source.line is None:
        return words + ", set by the flags" * (source.kind in ("pulse", "timer"))
    if source.off:
        words += " switched off"
    elif low is not None and high is not None:
        words += f" every {low:.6g} s" if low == high else f" every {low:.6g} to {high:.6g} s"
    elif low is not None:
        words += f" every {low:.6g} s or more"
    elif source.kind not in ("message", "trigger"):
        words += ", at an interval that is not known"
    senders = f" from {', '.join(source.senders)}" if source.senders else ""
    return f"{words}, line {source.line}{senders}"


def _verb(verb: VerbSummary) -> str:
    count = len(verb.lines)
    words = f"{verb.name}: {count} call{'s' * (count != 1)}, line {', '.join(map(str, verb.lines[:8]))}"
    words += ", ..." * (count > 8)
    if not verb.known:
        words += "; no verb of this game"
    if verb.sleeps:
        words += "; sleeps"
    if verb.sight is not None:
        often = [_often(run) for run in verb.runs if run.per_run is not None]
        often[:1] = [f"at most {first}" for first in often[:1]]
        often += [_often(run) for run in verb.runs if run.per_run is None]
        words += f"; sight ({verb.sight})" + (": " + ", ".join(often) if often else "")
    return words


def _often(run: RunSummary) -> str:
    count = "any number of times" if run.per_run is None else f"{run.per_run:.6g}"
    asleep = f" and {run.per_second:.6g} a second" if run.per_second else ""
    return f"{count} a run of {run.label}{asleep}"
