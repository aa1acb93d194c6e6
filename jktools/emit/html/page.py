"""The pages: one a level, and one that leads to them."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from typing import Any, NamedTuple

import jinja2
import msgspec
import numpy as np

from jktools import __version__
from jktools.compiler import CompiledLevel
from jktools.diagnostics import Diagnostic, Severity
from jktools.emit.html.picture import LEDGE_NAMES, picture, place_of
from jktools.emit.printable import printable
from jktools.facts.hotspots import CostSummary, frequency, mean_work
from jktools.facts.ledge_kinds import Kind


@dataclass(frozen=True, slots=True)
class LevelPage:
    """What a page shows of one level."""

    path: str
    """Of the level, as the user wrote it."""
    level: CompiledLevel | None
    """None for one that cannot be compiled: then there is nothing to draw."""
    fault: str = ""
    """Why not, a sentence."""
    findings: Sequence[Diagnostic] = ()
    """Of the level and of its scripts, in the one order of every output."""
    costs: Sequence[CostSummary] = ()
    """Of tests of sight, the dearest first."""
    scripts: int = 0
    """How many were looked at beside the level."""


class Link(NamedTuple):
    """A line of the page that leads to others."""

    path: str
    target: str
    """The page, from the folder of this one."""
    counts: str
    fault: str


def level_page(page: LevelPage) -> str:
    """The page of a level: the level from above and in space, its findings, floors and costs. Same level, same text."""
    drawn = picture(page.level) if page.level is not None else None
    positions = {thing["index"]: thing["position"] for thing in drawn["things"]} if drawn else {}
    rows = [_row(page, diagnostic, positions) for diagnostic in page.findings]
    placed = [row for row in rows if row["place"]]
    for number, row in enumerate(placed):
        row["number"] = number
    data = None if drawn is None else _embedded({**drawn, "findings": placed})
    return (
        _templates()
        .get_template("level.html")
        .render(
            version=__version__,
            path=printable(page.path),
            fault=printable(page.fault),
            counts=_counted(page.findings),
            scripts=page.scripts,
            kinds=[] if page.level is None else [f"{n} {kind.replace('_', ' ')}" for kind, n in _held(page.level)],
            settings={} if page.level is None else page.level.settings,
            rows=rows,
            data=data,
            bodies=[] if drawn is None else [_body(body) for body in drawn["bodies"]],
            ledge_kinds=[{"value": int(kind), "name": name} for kind, name in LEDGE_NAMES.items()],
            costs=[_cost(cost) for cost in page.costs],
            css=_source("page.css"),
            script=_source("viewer.js"),
        )
    )


def index_page(title: str, links: Sequence[Link]) -> str:
    """The page that leads to those of several levels."""
    template = _templates().get_template("index.html")
    return template.render(version=__version__, title=printable(title), links=links, css=_source("page.css"))


def link_to(page: LevelPage, target: str) -> Link:
    """The line of a page in the one that leads to it."""
    return Link(printable(page.path), target, _counted(page.findings) or "no findings", printable(page.fault))


def _row(page: LevelPage, diagnostic: Diagnostic, positions: dict[int, Any]) -> dict[str, Any]:
    span, subject = diagnostic.label.span, diagnostic.subject
    own = diagnostic.path == page.path
    place = place_of(page.level, subject, positions) if page.level is not None and own else []
    return {
        "severity": str(diagnostic.severity),
        "code": diagnostic.code.id,
        "name": diagnostic.code.name,
        "message": printable(diagnostic.message),
        "help": printable(diagnostic.help or ""),
        "where": printable(diagnostic.path) + (f":{span.first.line}:{span.first.column}" if span else ""),
        "kind": subject.kind if subject else "",
        "index": subject.index if subject else -1,
        "place": place,
    }


def _body(body: dict[str, Any]) -> dict[str, Any]:
    """A body for the table: its names, how much of its edges is what, and its basins."""
    kinds = body["kind"]
    lengths = np.linalg.norm(body["ends"][:, 3:] - body["ends"][:, :3], axis=1)
    return {
        "name": printable(body["name"]),
        "others": ", ".join(map(printable, body["others"])),
        "lengths": [
            (LEDGE_NAMES[Kind(kind)], f"{lengths[kinds == kind].sum():.1f}") for kind in np.unique(kinds).tolist()
        ],
        "basins": sorted(body["basins"], key=lambda basin: (not basin["stuck"], -basin["deepest"])),
    }


def _cost(cost: CostSummary) -> dict[str, str]:
    return {
        "verb": cost.verb,
        "line": str(cost.line),
        "runner": printable(cost.runner),
        "often": frequency(cost.calls_per_second, cost.more, cost.causes),
        "work": mean_work(cost) if cost.pairs else "not known",
        "finds": cost.finds or "",
        "help": cost.help,
    }


def _held(level: CompiledLevel) -> Iterator[tuple[str, int]]:
    shown = ("sectors", "surfaces", "vertices", "adjoins", "things", "cogs", "templates")
    yield from ((kind, level.counts[kind]) for kind in shown)


def _counted(findings: Sequence[Diagnostic]) -> str:
    counts = Counter(diagnostic.severity for diagnostic in findings)
    return ", ".join(f"{counts[s]} {s}{'s' * (counts[s] > 1)}" for s in reversed(Severity) if counts[s])


def _embedded(data: dict[str, Any]) -> str:
    """JSON that cannot end the element it stands in."""
    return msgspec.json.encode(data, enc_hook=np.ndarray.tobytes).decode().replace("<", "\\u003c")


@cache
def _templates() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.FunctionLoader(_source), autoescape=True, trim_blocks=True, lstrip_blocks=True,
        undefined=jinja2.StrictUndefined,
    )  # fmt: skip


def _source(name: str) -> str:
    return files(__package__).joinpath(name).read_text("utf-8")
