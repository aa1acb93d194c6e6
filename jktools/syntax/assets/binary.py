"""What the readers of binary assets share: a cursor over the bytes that accounts for every one of them."""

from __future__ import annotations

import struct
from typing import Any

from jktools.diagnostics import Diagnostic
from jktools.source import Source
from jktools.syntax.assets import faults
from jktools.syntax.assets.faultlist import FaultList


class ByteReader:
    """Reads one file from its first byte to its last; nothing of the size that a file claims is allocated."""

    def __init__(self, source: Source, what: str) -> None:
        """Start before the first byte; `what` is the file in messages, as `the material`."""
        self.source = source
        self.what = what
        self.at = 0
        self.lost = False
        """Whether what follows cannot be told apart any more."""
        self.faults = FaultList(source)

    @property
    def left(self) -> int:
        """Bytes that have not been read."""
        return len(self.source.data) - self.at

    def take(self, form: struct.Struct, part: str) -> tuple[Any, ...] | None:
        """Read one record; None, and a fault told, when the file ends before it does."""
        start = self.at
        if not self.skip(form.size, part):
            return None
        return form.unpack_from(self.source.data, start)

    def skip(self, size: int, part: str) -> bool:
        """Pass over bytes that nobody asks for; False, and a fault told, when there are fewer."""
        if size > self.left:
            self.lost = True
            self.faults.tell(
                faults.CUT_OFF_ASSET, self.source,
                f"{self.what} should go on for {size} bytes with {part}, but {self.left} are left",
                "copy or export the file again",
            )  # fmt: skip
            return False
        self.at += size
        return True

    def starts(self, magic: bytes, found: bytes) -> bool:
        """Whether the file starts as its format does; told when not."""
        if magic == found:
            return True
        self.lost = True
        shown = found.decode("latin-1").encode("unicode_escape").decode("ascii")
        self.faults.tell(
            faults.MALFORMED_ASSET, self.source,
            f'{self.what} should start with "{magic.decode("ascii")}", but starts with "{shown}"',
            "export the file again; the engine refuses it",
        )  # fmt: skip
        return False

    def unknown(self, found: str) -> None:
        """Tell of something that no known file has."""
        self.lost = True
        self.faults.tell(
            faults.UNKNOWN_ASSET_VERSION, self.source, f"{self.what} has {found}",
            "export it again with a tool for Jedi Knight; the engine reads it as one that it knows",
        )  # fmt: skip

    def finish(self) -> tuple[Diagnostic, ...]:
        """What was told; bytes that are left are told too, unless it is known why."""
        if self.left and not self.lost:
            self.faults.tell(
                faults.SURPLUS_IN_ASSET, self.source,
                f"{self.what} ends after {self.at} bytes, but the file has {len(self.source.data)}",
                "export the file again; nobody reads the rest",
            )  # fmt: skip
        return self.faults.finish()
