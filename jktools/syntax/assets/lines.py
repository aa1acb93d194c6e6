"""What the readers of text assets share: a cursor over the logical lines, and how faults are told."""

from __future__ import annotations

import re
from collections.abc import Collection, Sequence

import lark
import numpy as np

from jktools.diagnostics import Code, Severity, Subject
from jktools.diagnostics.wording import miscounted
from jktools.source import Source
from jktools.syntax.assets import faults
from jktools.syntax.assets.faultlist import FaultList
from jktools.syntax.lines import BLANK, LogicalLines
from jktools.syntax.misfit import misfit_of, quote
from jktools.syntax.records import Record, keywords
from jktools.syntax.rows import Rows, well_formed

_LABEL = re.compile(r"[ \t\r\f\v]*[-+]?[0-9]+:")


class LineReader:
    """Reads one file from its first line to its last."""

    def __init__(
        self, source: Source, game: str, effect: str, *, strict: bool = False, skips_blank: bool = False
    ) -> None:
        """Start before the first line; `effect` says in messages what the engine does with a bad file.

        `strict` leaves every record to the grammar. `skips_blank` is for files that the engine reads as fields: it
        passes over lines of blanks, as it does not where it reads with scanf.
        """
        self.source = source
        self.lines = LogicalLines(source, game)
        self.effect = effect
        self.strict = strict
        self.at = 0
        self.faults = FaultList(source)
        self._told_blank = skips_blank
        self._told_at = -1
        for line in self.lines.cut_lines():
            self.fault(
                faults.MALFORMED_ASSET, line,
                f"the line is longer than the engine's buffer of {self.lines.buffer_size} bytes",
                "split it; the engine reads the rest as the next line",
            )  # fmt: skip

    # ---- lines

    @property
    def done(self) -> bool:
        """Whether every line has been read."""
        return self.at >= len(self.lines)

    def text(self) -> str:
        """The line at hand."""
        return self.lines.text(self.at)

    def skip_blank(self) -> None:
        """Pass over lines of blanks; the engine takes such a line for the one it waits for, and that is told."""
        while not self.done and self.lines.kinds[self.at] & BLANK:
            if not self._told_blank:
                self._told_blank = True
                self.fault(
                    faults.MALFORMED_ASSET, self.at, "the line has blanks only, but the engine does not pass over it",
                    f"remove the blanks, so that the line is empty; {self.effect}",
                )  # fmt: skip
            self.at += 1

    def has(self, record: Record, line: int) -> bool:
        """Whether a line starts with the words of a record."""
        return line < len(self.lines) and keywords(self.lines.text(line)).startswith(record.keyword + " ")

    def is_at(self, record: Record) -> bool:
        """Whether the line at hand, blank ones passed, starts with the words of a record."""
        self.skip_blank()
        return self.has(record, self.at)

    def next(self) -> int | None:
        """Pass over blank lines and give the one at hand, passing over it too; None at the end."""
        self.skip_blank()
        if self.done:
            return None
        self.at += 1
        return self.at - 1

    def seek(self, record: Record, stops: Collection[Record] = ()) -> bool:
        """Move to the next line of a record unless one of `stops` comes first; else stay."""
        for line in range(self.at, len(self.lines)):
            if self.has(record, line):
                self.at = line
                return True
            if any(self.has(stop, line) for stop in stops):
                break
        return False

    def labelled(self) -> range:
        """Move behind the lines that start with a label, as `12:`, and give them."""
        self.skip_blank()
        first = self.at
        while not self.done and _LABEL.match(self.text()):
            self.at += 1
        return range(first, self.at)

    def labelled_one(self) -> range:
        """Move behind the line at hand if it starts with a label, and give it."""
        self.skip_blank()
        first = self.at
        self.at += not self.done and _LABEL.match(self.text()) is not None
        return range(first, self.at)

    # ---- records

    def value(self, record: Record, stops: Collection[Record] = ()) -> Sequence[str] | None:
        """Read the line that must come now, by its words; None, and a fault told, when it does not or is broken.

        What stands before it is passed over, but nothing beyond a line of `stops`.
        """
        if not self.is_at(record):
            if self.at == self._told_at:  # the same line, or the end, was not what came before either
                return self.value(record, stops) if self.seek(record, stops) else None
            self._told_at = self.at
            found = "the file ends" if self.done else f"found {quote(self.text())}"
            self.fault(
                faults.MALFORMED_ASSET, self.at, f'expected the line "{record.keyword}", but {found}',
                f"write the lines in the order of the format; {self.effect}",
            )  # fmt: skip
            if not self.seek(record, stops):
                return None
        line, self.at = self.at, self.at + 1
        return self.record(record, line, None)

    def rows(self, record: Record, kind: str, lines: Sequence[int]) -> Rows:
        """Read the records on these lines; the native reader takes what is well-formed, the grammar the rest."""

        def read_one(row: int, line: int) -> Sequence[str] | None:
            return self.record(record, line, Subject(kind, row))

        return Rows(record, self.lines, np.array(lines, np.intp), read_one, strict=self.strict)

    def record(self, record: Record, line: int, subject: Subject | None) -> Sequence[str] | None:
        """Parse a line with the grammar; None, and a fault told, when the engine could not read it."""
        text = self.lines.text(line)
        if self.faults.full:
            # A file of garbage: what is not told need not be explained nor kept, and the grammar takes its time.
            if not record.keyword and not well_formed(record, self.lines, line):
                self.faults.count()
                return None
            return record.salvage(text)
        title = record.title if subject is None else f"{subject.kind} {subject.index}"
        try:
            tokens = record.parse(text)
        except lark.UnexpectedInput as error:
            misfit = misfit_of(record, text, error)
            read = record.salvage(text)
            message = f"{title}: expected {misfit.wanted}, {misfit.what}"
            if read is None:
                self.fault(faults.MALFORMED_ASSET, line, message, f"mend the line; {self.effect}", subject)
            else:
                taken = f"; the engine reads {read[misfit.ordinal]}" if 0 <= misfit.ordinal < len(read) else ""
                self.fault(faults.LOOSELY_READ_ASSET, line, message + taken, "write the value that you mean", subject)
            return read
        if record.more != "*" and tokens and tokens[-1].end_pos != len(text.rstrip()):
            self._surplus(record, line, title, text, subject)
        return tokens

    def _surplus(self, record: Record, line: int, title: str, text: str, subject: Subject | None) -> None:
        words = record.surplus(text)
        if words:
            self.fault(
                faults.LOOSELY_READ_ASSET, line, f"{title} ends before {quote(' '.join(words))}, but the line goes on",
                "remove what the engine does not read, or put a # before it", subject,
            )  # fmt: skip

    # ---- faults

    def fault(
        self,
        code: Code,
        line: int,
        message: str,
        help: str | None = None,
        subject: Subject | None = None,
        severity: Severity | None = None,
    ) -> None:
        """Tell a fault at a logical line, or at one that is not there for the file as such."""
        if self.faults.full:
            self.faults.count()
            return
        place = self.lines.span(line) if 0 <= line < len(self.lines) else self.source
        self.faults.tell(code, place, message, help, subject, severity)

    def outside(self, rows: Rows, kind: str) -> None:
        """Tell of numbers that the engine's 32 bits cannot hold. Call when all columns are made."""
        for index, field in sorted(rows.outside.items()):
            text = str(rows.fields[index][rows.record.ordinal(field)])
            self.fault(
                faults.LOOSELY_READ_ASSET, int(rows.lines[index]),
                f"{kind} {index} has {field} {quote(text)}, but the engine holds it in 32 bits",
                "write a number that fits", Subject(kind, index),
            )  # fmt: skip

    def at_end(self, what: str) -> None:
        """Tell of text that nobody reads, unless something else is wrong already."""
        while not self.done and self.lines.kinds[self.at] & BLANK:
            self.at += 1
        if not self.done and not self.faults.found:
            self.fault(
                faults.SURPLUS_IN_ASSET, self.at,
                f"{what} ends before {quote(self.text())}, but the file goes on",
                "remove what the engine does not read, or put a # before it",
            )  # fmt: skip

    def counted(self, line: int, kind: str, announced: int, found: int) -> None:
        """Tell when a heading announces another number of records than follow."""
        if announced != found:
            self.fault(
                faults.ASSET_COUNT_MISMATCH, line,
                miscounted(announced, kind, found),
                f"write {found}, or restore what is missing; {self.effect}",
            )  # fmt: skip
