"""What every asset file has: its bytes, what is wrong with it, and the files that it names."""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TypeVar

from jktools.diagnostics import Diagnostic, Severity
from jktools.source import Source, Span

BINARY_EXTENSIONS = frozenset({"cmp", "mat", "wav"})


@dataclass(frozen=True, slots=True)
class Reference:
    """A file that another one names."""

    extension: str
    """Which kind of file is meant, as `mat`."""
    name: str
    """As written."""
    place: Span | Source


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Asset:
    """A file as it was read. What could not be read is left out, and told in `diagnostics`."""

    source: Source
    diagnostics: tuple[Diagnostic, ...] = ()
    references: tuple[Reference, ...] = field(default=())
    """The files that it names, in its order."""

    @property
    def path(self) -> str:
        """Where it was read from."""
        return self.source.path

    @property
    def is_binary(self) -> bool:
        """Whether it has no lines, and so no comments."""
        return self.source.name.rpartition(".")[2].lower() in BINARY_EXTENSIONS

    @property
    def rejected(self) -> bool:
        """Whether the engine refuses the file, or reads beyond its data."""
        return any(d.severity is Severity.ERROR for d in self.diagnostics)


AnyAsset = TypeVar("AnyAsset", bound=Asset)
