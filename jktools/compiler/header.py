"""What a compiled level says of itself: version, source, settings, the level's header lines, passes."""

from __future__ import annotations

from typing import Any

import numpy as np

from jktools.compiler.columns import camel_case
from jktools.compiler.errors import CompiledFileError

WORLD = (
    "version", "gravity", "ceiling_sky_z", "horizon_distance", "horizon_pixels_per_rev", "horizon_sky_offset",
    "ceiling_sky_offset", "mipmap_distances", "lod_distances", "perspective_distance", "gouraud_distance",
)  # fmt: skip
"""Fields of the table World."""


class Header:
    """The tables of a compiled level that are no section."""

    def __init__(self, root: Any, path: str) -> None:
        """Look at the root table of a file that was checked."""
        self._root = root
        self.path = path

    def _text(self, data: bytes) -> str:
        try:
            return data.decode()
        except UnicodeDecodeError as error:
            raise CompiledFileError(f"cannot read {self.path}: the file is damaged; build it again") from error

    def why_absent(self, section: str) -> str:
        """Why the file does not have a section, as the pass that computes it noted."""
        state = self.passes.get(section)
        return (state and state["note"]) or f"jktools {self.tool_version} did not write it"

    @property
    def world(self) -> dict[str, Any]:
        """The header lines of the level, by their names in the schema."""
        world = self._root.World()
        if world is None:
            return {}
        found: dict[str, Any] = {}
        for name in WORLD:
            vector = getattr(world, f"{camel_case(name)}AsNumpy", None)
            value = getattr(world, camel_case(name))() if vector is None else vector()
            found[name] = [] if vector is not None and isinstance(value, int) else value
        return {name: value.tolist() if isinstance(value, np.ndarray) else value for name, value in found.items()}

    @property
    def format(self) -> str:
        """Version of the file format, `major.minor`."""
        return f"{self._root.FormatMajor()}.{self._root.FormatMinor()}"

    @property
    def format_minor(self) -> int:
        """The minor version of the file format."""
        return int(self._root.FormatMinor())

    @property
    def tool_version(self) -> str:
        """Version of the jktools that wrote it."""
        return self._text(self._root.ToolVersion())

    @property
    def checksum(self) -> str:
        """As stored, in hex."""
        return bytes(self._root.ChecksumAsNumpy()).hex()

    @property
    def source(self) -> tuple[str, str]:
        """Path inside the pack, and SHA-256 in hex, of the level that it was made from."""
        path, digest = next(iter(self._sources), ("", ""))
        return path, digest

    @property
    def _sources(self) -> list[tuple[str, str]]:
        entries = [self._root.Inputs(i) for i in range(self._root.InputsLength())]
        return [(self._text(e.Path()), bytes(e.Sha256AsNumpy()).hex()) for e in entries]

    @property
    def settings(self) -> dict[str, str]:
        """What it was compiled for."""
        settings = self._root.Settings()
        return {
            "game": self._text(settings.Game()),
            "engine": self._text(settings.Engine()),
            "accuracy": self._text(settings.Accuracy()),
        }

    @property
    def cut_anyway(self) -> bool:
        """Whether it leaves out templates and names that nothing is known to reach."""
        return bool(self._root.Settings().CutAnyway())

    @property
    def plain(self) -> bool:
        """Whether every column was to be its plain vector; no file before 1.3 is so."""
        return bool(self._root.Settings().Plain())

    @property
    def only(self) -> list[str]:
        """The passes that alone were asked for; none for all, and for files before 1.2, which do not tell."""
        settings = self._root.Settings()
        return [self._text(settings.Only(i)) for i in range(settings.OnlyLength())]

    @property
    def skip(self) -> list[str]:
        """The passes that were not to run; none for files before 1.2, which do not tell."""
        settings = self._root.Settings()
        return [self._text(settings.Skip(i)) for i in range(settings.SkipLength())]

    @property
    def passes(self) -> dict[str, dict[str, Any]]:
        """Which passes ran, and which failed; `note` says why one did not run."""
        entries = [self._root.Passes(i) for i in range(self._root.PassesLength())]
        return {
            self._text(e.Name()): {
                "ran": bool(e.Ran()),
                "failed": bool(e.Failed()),
                "note": None if e.Note() is None else self._text(e.Note()),
            }
            for e in entries
        }
