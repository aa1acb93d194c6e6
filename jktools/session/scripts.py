"""Scripts, from paths and from the levels that bind them."""

from __future__ import annotations

import contextlib
from collections.abc import Callable, Iterator
from pathlib import Path

from jktools.model import Level
from jktools.session.levels import SCRIPT_EXTENSION, discover, game_of, listed
from jktools.session.settings import Game, Settings
from jktools.source import Container, InputError, Member, resolve
from jktools.source.container import PACK_SEPARATOR, file_member
from jktools.syntax.cog import Script, read_script

SCRIPT_FOLDER = "cog"
"""Where the engine looks for the scripts that a level names."""


def read_member_script(member: Member, settings: Settings) -> Script:
    """Read one script. Raises InputError when the file cannot be opened; its faults are in `faults`."""
    return read_script(member.read(), game_of(member, settings.game))


def load_script(path: str, game: Game | None = None) -> Script:
    """Read the one COG script that a path names, as `masspack.gob!cog/00_door.cog`.

    Raises InputError when the path cannot be opened, is no script, or holds several. What is wrong inside the script
    is in `Script.faults`.
    """
    scripts = discover(path, extensions=(SCRIPT_EXTENSION,))
    if len(scripts) > 1:
        raise InputError(f"{path} holds {len(scripts)} scripts: name one of {listed(m.path for m in scripts)}")
    return read_member_script(scripts[0], Settings(game))


def bound_scripts(level: Level) -> Iterator[Member]:
    """The files of the scripts that a level binds, each once, as far as they lie where the level does.

    In a pack that is its folder `cog`; for a level on disk `cog` beside it or beside its folder, or its own folder.
    Raises InputError when the pack can no longer be opened.
    """
    names = list(dict.fromkeys(cog.name.lower() for cog in level.cogs))
    in_pack = level.path.endswith(f"{PACK_SEPARATOR}{level.source.name}")
    find = _in_pack(level) if in_pack else _on_disk(Path(level.path).parent)
    for name in names:
        member = find(name)
        if member is not None and member.extension == SCRIPT_EXTENSION:
            yield member


def _in_pack(level: Level) -> Callable[[str], Member | None]:
    pack = resolve(level.path[: -len(level.source.name) - len(PACK_SEPARATOR)])
    return lambda name: pack.find(f"{SCRIPT_FOLDER}/{name}") if isinstance(pack, Container) else None


def _on_disk(folder: Path) -> Callable[[str], Member | None]:
    above = folder.parent if folder.name else Path("..")
    files: dict[str, Path] = {}
    for place in (folder / SCRIPT_FOLDER, above / SCRIPT_FOLDER, folder):
        with contextlib.suppress(OSError):  # what cannot be listed holds no script that could be read
            for path in sorted(place.iterdir()):
                files.setdefault(path.name.lower(), path)

    def find(name: str) -> Member | None:
        path = files.get(name)
        return None if path is None else file_member(path, path.as_posix(), path.name)

    return find
