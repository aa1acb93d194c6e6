"""A whole script: header, code, and why the engine refuses it if it does."""

from __future__ import annotations

from dataclasses import dataclass

from jktools.diagnostics import Diagnostic, Label
from jktools.diagnostics.suppression import LINES, CommentStyle, code_comments
from jktools.source import Source, Span
from jktools.syntax.cog import faults
from jktools.syntax.cog.header import read_header
from jktools.syntax.cog.nodes import Code, Header, Statement
from jktools.syntax.cog.parser import parse
from jktools.syntax.cog.recovery import MOST_FAULTS, Recovery
from jktools.syntax.cog.scanner import LONGEST_TOKEN, Scan, Stray, scan
from jktools.syntax.cog.tables import tables


@dataclass(frozen=True, slots=True)
class Script:
    """A COG script as the engine would hold it, with what it drops still at hand."""

    source: Source
    game: str
    """`jk` or `mots`: the size of the engine's line buffer."""
    header: Header
    code: Code
    faults: tuple[Diagnostic, ...]
    """Empty for a script that the engine takes; else JK050 and the places, in the order of the file."""
    strays: tuple[Stray, ...]
    """Characters of the code that the engine drops in silence."""

    @property
    def path(self) -> str:
        """Where it was read from."""
        return self.source.path

    @property
    def rejected(self) -> bool:
        """Whether the engine refuses it."""
        return bool(self.faults)

    @property
    def comment_styles(self) -> tuple[CommentStyle, ...]:
        """How comments look, in the header and in the code."""
        return LINES, code_comments(self.code.start)

    @property
    def diagnostics(self) -> tuple[Diagnostic, ...]:
        """What reading found."""
        return self.faults


def read_script(source: Source, game: str = "jk") -> Script:
    """Read a script as the engine of `game` does. Never raises: what is wrong is in `faults`."""
    reading = read_header(source, game)
    found = list(reading.faults)
    begin = len(source.data) if reading.code is None else reading.code
    automaton = tables()
    scanned = scan(source.text, begin, automaton)
    stops = [fault.label.span for fault in found]
    body: list[Statement] = []
    if len(scanned.tokens) > 1:
        recovery = Recovery(source, automaton)
        body = parse(scanned, automaton, recovery)
        found += recovery.finish()
        if recovery.stopped is not None:
            stops.append(source.span(recovery.stopped.start, recovery.stopped.end))
    elif reading.code is not None:
        found.append(_empty(source, scanned))
        stops.append(found[-1].label.span)
    found += [_overlong(source, token.start, token.end) for token in scanned.overlong]
    stops += [source.span(token.start, token.start + 1) for token in scanned.overlong]
    code = Code(begin, scanned.tokens[-1].end, tuple(body), tuple(scanned.words), scanned.closed)
    told = _rejected(found, [stop for stop in stops if stop is not None])
    return Script(source, game, reading.header, code, told, tuple(scanned.strays))


def _rejected(found: list[Diagnostic], stops: list[Span]) -> tuple[Diagnostic, ...]:
    """The faults in order, before them one for the script, at the first place where the engine stops."""
    if not stops:
        return ()
    found.sort(key=lambda fault: fault.sort_key)
    stop = min(stops, key=lambda span: span.start)
    whole = Diagnostic(
        faults.COG_REJECTED,
        faults.COG_REJECTED.severity,
        Label(stop),
        f"the engine refuses this script: it stops reading at line {stop.first.line}",
        "until it is mended, no cog of a level can run it, and the numbers of all later cogs are one too low",
    )
    return (whole, *found)


def _empty(source: Source, scanned: Scan) -> Diagnostic:
    end = scanned.tokens[-1]
    found = "its end follows at once" if scanned.closed else "the file ends"
    return Diagnostic(
        faults.EMPTY_CODE, faults.EMPTY_CODE.severity, Label(source.span(end.start, end.end)),
        f"the code must have a statement, but {found}", "write a semicolon, or the code that is missing",
    )  # fmt: skip


def _overlong(source: Source, start: int, end: int) -> Diagnostic:
    what = {"#": "comment", "/": "comment", '"': "string", "'": "vector"}.get(source.text[start], "word")
    return Diagnostic(
        faults.OVERLONG_TOKEN, faults.OVERLONG_TOKEN.severity, Label(source.span(start, start + 1)),
        f"the {what} goes on for {end - start} bytes, but the engine's scanner holds {LONGEST_TOKEN}",
        ("break it into lines" if what == "comment" else "close the quote, or make it shorter")
        + "; the game ends when it reads this",
    )  # fmt: skip


__all__ = ["MOST_FAULTS", "Script", "read_script"]
