"""What every section's reader shares: the cursor over the lines, and how faults are told."""

from __future__ import annotations

import re
from collections.abc import Sequence

import lark
import numpy as np
import numpy.typing as npt

from jktools.diagnostics import Code, Diagnostic, Label, Severity, Subject
from jktools.diagnostics.wording import miscounted
from jktools.source import Source, Span
from jktools.syntax.jkl import faults, records
from jktools.syntax.jkl.document import Heading
from jktools.syntax.jkl.records import Record
from jktools.syntax.lines import BLANK, END, SECTION, LogicalLines
from jktools.syntax.misfit import misfit_of
from jktools.syntax.misfit import quote as quote
from jktools.syntax.rows import Rows, ints

MOST_FAULTS = 1000
"""Faults told of one file; a file of garbage must not yield a report longer than itself."""


_BLANKS = r"[ \t\r\f\v]"


def _count(text: str) -> int:
    """A count as it is written, held within 32 bits."""
    return ints([text])[0][0]


class Context:
    """Reads one file from its first line to its last."""

    def __init__(self, source: Source, game: str, strict: bool = False) -> None:
        """Start before the first logical line; `strict` leaves every record to the grammar."""
        self.source = source
        self.game = game
        self.strict = strict
        self.lines = LogicalLines(source, game)
        self.at = 0
        self.diagnostics: list[Diagnostic] = []
        self._untold = 0

    # ---- lines

    @property
    def done(self) -> bool:
        """Whether every line has been read."""
        return self.at >= len(self.lines)

    def text(self) -> str:
        """The line at hand."""
        return self.lines.text(self.at)

    def _is(self, kinds: int) -> bool:
        return not self.done and bool(self.lines.kinds[self.at] & kinds)

    def at_section(self) -> bool:
        """Whether the line at hand starts a section, or there is none left."""
        return self.done or self._is(SECTION)

    def at_end_word(self) -> bool:
        """Whether the line at hand is `end`."""
        return self._is(END)

    def skip_blank(self) -> None:
        """Pass over lines of blanks, as the engine's field reader does."""
        while self._is(BLANK):
            self.at += 1

    def block(self, until: int, *, blank: bool = True) -> npt.NDArray[np.intp]:
        """Move to the next line of one of these kinds and give the lines before it, with or without blank ones."""
        first, self.at = self.at, self.lines.next_of(until, self.at)
        lines = np.arange(first, self.at)
        return lines if blank else lines[self.lines.kinds[lines] & BLANK == 0]

    # ---- records

    def rows(self, record: Record, kind: str, lines: npt.NDArray[np.intp]) -> Rows:
        """Read the records on these lines; the native reader takes what is well-formed, the grammar the rest."""

        def read_one(row: int, line: int) -> Sequence[str] | None:
            return self.record(record, line, Subject(kind, row))

        return Rows(record, self.lines, lines, read_one, strict=self.strict)

    # ---- faults

    def fault(
        self,
        code: Code,
        place: Span | Source | int,
        message: str,
        help: str | None = None,
        subject: Subject | None = None,
        severity: Severity | None = None,
        note: str = "",
    ) -> None:
        """Tell a fault; `place` may be a logical line, or one that is not there for the file as such."""
        if len(self.diagnostics) >= MOST_FAULTS:
            self._untold += 1
            return
        if isinstance(place, int):
            place = self.lines.span(place) if 0 <= place < len(self.lines) else self.source
        self.diagnostics.append(Diagnostic(code, severity or code.severity, Label(place, note), message, help, subject))

    def finish(self) -> tuple[Diagnostic, ...]:
        """Everything that was told, in the order of the file."""
        if self._untold:
            self.diagnostics.append(
                Diagnostic(
                    faults.TOO_MANY_FAULTS,
                    faults.TOO_MANY_FAULTS.severity,
                    Label(self.source),
                    f"{MOST_FAULTS} faults are reported, but the file has {self._untold} more",
                    "mend the first ones; the rest often follow from them",
                )
            )
        return tuple(sorted(self.diagnostics, key=lambda d: d.sort_key))

    def heading(self, words: str) -> Heading | None:
        """Read the heading `words N`, or tell that it is missing and stay where we are."""
        self.skip_blank()
        expected = f'expected the heading "{words}" and a count'
        if self.at_section():
            place: Span | Source | int = self.source if self.done else self.at
            self.fault(faults.MALFORMED_RECORD, place, f"{expected}, but the section ends here")
            return None
        line, text = self.at, self.text()
        pattern = _BLANKS + "*" + f"{_BLANKS}+".join(map(re.escape, words.split())) + f"(?={_BLANKS}|$)"
        prefix = re.match(pattern, text, re.IGNORECASE)
        if prefix is None:
            misspelt = re.search(rf"{words.split()[-1]}{_BLANKS}+([0-9]+)$", text.rstrip(), re.IGNORECASE)
            if misspelt is not None:
                self.at += 1
                self.fault(
                    faults.MALFORMED_RECORD, line, f"{expected}, but found {quote(text)}",
                    f'write "{words}"; the engine refuses the level',
                )  # fmt: skip
                return Heading(line, _count(misspelt.group(1)))
            self.fault(
                faults.MALFORMED_RECORD, line, f"{expected}, but found {quote(text)}",
                f"put a line '{words} N' before the records, with their number",
            )  # fmt: skip
            return None
        self.at += 1
        try:
            _, fields = records.parse_any("count", text)
        except lark.UnexpectedInput:
            number = re.match(rf"{_BLANKS}*([0-9]+)", text[prefix.end() :])
            self.fault(
                faults.MALFORMED_RECORD if number is None else faults.LOOSELY_READ_RECORD, line,
                f'expected a count behind "{words}", but found {quote(text[prefix.end() :])}',
                "write the number of records that follow",
            )  # fmt: skip
            return None if number is None else Heading(line, _count(number.group(1)))
        if str(fields[-1]).startswith("-"):
            self.fault(
                faults.MALFORMED_RECORD, line, f'the heading "{words}" announces {quote(str(fields[-1]))}, but a count '
                "cannot be negative", "write the number of records that follow",
            )  # fmt: skip
            return None
        return Heading(line, _count(str(fields[-1])))

    def record(self, record: Record, line: int, subject: Subject | None) -> Sequence[str] | None:
        """Parse a line with the grammar; None, and a fault told, when the engine could not read it."""
        text = self.lines.text(line)
        if len(self.diagnostics) >= MOST_FAULTS:
            # A file of garbage: what is not told need not be explained, and the grammar takes its time.
            self._untold += not (self.strict and _is_clean(record, text))
            return record.salvage(text)
        try:
            tokens = record.parse(text)
        except lark.UnexpectedInput as error:
            return self._malformed(record, line, text, error, subject)
        if tokens[-1].end_pos != len(text.rstrip()):
            self._surplus(record, line, text, subject)
        return tokens

    def _surplus(self, record: Record, line: int, text: str, subject: Subject | None) -> None:
        if _goes_on(record):
            return
        words = record.surplus(text)
        if words:
            start, end = words[0].start_pos, words[-1].end_pos
            assert start is not None
            assert end is not None
            self.fault(
                faults.LOOSELY_READ_RECORD, self.lines.part(line, start, end),
                f"{name(record, subject)} ends before {quote(text[start:end])}, but the line goes on",
                "remove what the engine does not read, or put a # before it", subject,
            )  # fmt: skip

    def _malformed(
        self, record: Record, line: int, text: str, error: lark.UnexpectedInput, subject: Subject | None
    ) -> list[str] | None:
        misfit = misfit_of(record, text, error)
        start, found, ordinal, wanted, what = (
            misfit.start, misfit.found, misfit.ordinal, misfit.wanted, misfit.what
        )  # fmt: skip
        read = record.salvage(text)
        place = self.lines.part(line, start, start + len(found)) if found else self.lines.span(line)
        if read is None and record is records.THING:  # sithThing_Load passes over a line with fewer fields
            self.fault(
                faults.LOOSELY_READ_RECORD, place, f"{name(record, subject)}: expected {wanted}, {what}",
                "mend the line; the engine skips a thing with fewer fields", subject,
            )  # fmt: skip
        elif read is None:
            self.fault(
                faults.MALFORMED_RECORD, place, f"{name(record, subject)}: expected {wanted}, {what}",
                "mend the line; the engine takes the parent from what the line before left there"
                if record is records.TEMPLATE
                else "mend the line; the engine refuses a level with such a record",
                subject,
            )  # fmt: skip
        else:
            taken = f"; the engine reads {read[ordinal]}" if 0 <= ordinal < len(read) else ""
            self.fault(
                faults.LOOSELY_READ_RECORD, place, f"{name(record, subject)}: expected {wanted}, {what}{taken}",
                "write the value that you mean", subject,
            )  # fmt: skip
        return read

    def outside(self, rows: Rows, kind: str) -> None:
        """Tell of numbers that the engine's 32 bits cannot hold. Call when all columns are made."""
        for index, field in sorted(rows.outside.items()):
            text = str(rows.fields[index][rows.record.ordinal(field)])
            self.beyond(int(rows.lines[index]), kind, index, field, text)

    def beyond(self, line: int, kind: str, index: int, field: str, text: str) -> None:
        """Tell of one number that the engine's 32 bits cannot hold."""
        self.fault(
            faults.LOOSELY_READ_RECORD, line,
            f"{kind} {index} has {field} {quote(text)}, but the engine holds it in 32 bits",
            "write a number that fits", Subject(kind, index),
        )  # fmt: skip

    def counted(self, heading: Heading | None, kind: str, found: int, help: str | None = None) -> None:
        """Tell when a heading that must be exact announces another number than there are."""
        if heading is not None and heading.count != found:
            self.fault(
                faults.COUNT_MISMATCH, heading.line,
                miscounted(heading.count, kind, found),
                help or f"write {found}, or restore what is missing; the engine refuses the level",
            )  # fmt: skip


def _goes_on(record: Record) -> bool:
    """Whether the record's own reader looks at what stands behind its fields."""
    return record.more == "*" or record is records.SURFACE


def _is_clean(record: Record, text: str) -> bool:
    """Whether the grammar takes a line to its end."""
    try:
        tokens = record.parse(text)
    except lark.UnexpectedInput:
        return False
    return _goes_on(record) or tokens[-1].end_pos == len(text.rstrip())


def name(record: Record, subject: Subject | None) -> str:
    """How a record is called in a message: `vertex 12`."""
    return record.title if subject is None else f"{subject.kind} {subject.index}"
