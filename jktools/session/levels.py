"""From paths to levels."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Sequence
from typing import get_args

from jktools.compiler import CompileSettings, compile_level
from jktools.compiler.mapping import is_compiled
from jktools.geometry import Accuracy, SectorMesh
from jktools.model import Level
from jktools.model.resources import Kind, Library
from jktools.session.settings import Game, Settings
from jktools.source import PACK_EXTENSIONS, Container, Folder, InputError, Member, Target, Zip, enter, resolve
from jktools.source.container import PACK_SEPARATOR
from jktools.syntax.assets.asset import Asset
from jktools.syntax.assets.reading import ASSET_EXTENSIONS, read_asset
from jktools.syntax.jkl import read as read_jkl
from jktools.syntax.jkl import read_library

LEVEL_EXTENSION = "jkl"
SCRIPT_EXTENSION = "cog"
LIBRARY_EXTENSION = "tpl"
"""A template library of an editor: read as a level that holds templates only."""

LEVELS = (LEVEL_EXTENSION, LIBRARY_EXTENSION)
"""What is read as a level."""

_KINDS = {LEVEL_EXTENSION: "a .jkl level", LIBRARY_EXTENSION: "a .tpl library", SCRIPT_EXTENSION: "a .cog script"}

ACCURACIES: tuple[Accuracy, ...] = get_args(Accuracy)


def discover(typed: str, problems: list[str] | None = None, extensions: Collection[str] = LEVELS) -> list[Member]:
    """The levels that a path names, in the container's order; packs in folders and in zips are entered.

    Files of other `extensions` are found the same way, assets only in the folders where the engine looks for them. A
    pack inside that cannot be opened is told in `problems`, one sentence, and the rest is read; without `problems` it
    raises. Raises InputError when the path itself cannot be
    opened or holds no such file.
    """
    inside: list[str] = []
    levels = list(_files(resolve(typed), extensions, inside))
    if problems is None and inside:
        raise InputError(inside[0])
    if not levels and not inside:
        if is_compiled(typed):
            raise InputError(f"cannot read {typed} as a source: it is a compiled level; name what it was compiled from")
        kinds = ", ".join(_KINDS[extension] for extension in extensions if extension in _KINDS)
        raise InputError(f"nothing to read in {typed}: expected {kinds} or a folder or pack that holds one")
    if problems is not None:
        problems += inside
    return levels


def _files(target: Target, extensions: Collection[str], problems: list[str]) -> Iterator[Member]:
    for member in target.members if isinstance(target, Container) else [target]:
        if member.extension in extensions:
            # In a folder of a site lie other files of the same names: those in the game's folders are the game's.
            if member is target or member.extension not in ASSET_EXTENSIONS or Kind.placed(member.name):
                yield member
        # The game opens no pack inside a GOB; by its path one can be read all the same.
        elif member.extension in PACK_EXTENSIONS and isinstance(target, (Folder, Zip)):
            try:
                yield from _files(enter(target, member), extensions, problems)
            except InputError as error:
                problems.append(str(error))


def game_of(member: Member, chosen: Game | None) -> Game:
    """The game whose reading applies: what was chosen, or that of the pack's extension."""
    if chosen is not None:
        return chosen
    pack = member.path.rpartition(PACK_SEPARATOR)[0]
    return "mots" if pack.lower().endswith(".goo") else "jk"


def read_level(member: Member, settings: Settings, library: Library | None = None) -> Level:
    """Read one level. Raises InputError when the file cannot be opened; its faults are in `diagnostics`.

    `library` is what its run reads files from; without one the bases of the settings are opened anew.
    """
    game = game_of(member, settings.game)
    read = read_library if member.extension == LIBRARY_EXTENSION else read_jkl
    resources = (library or Library(settings.base)).resources_of(member)
    return Level(read(member.read(), game, strict_grammar=settings.strict_grammar), resources)


def read_member_asset(member: Member, settings: Settings) -> Asset:
    """Read one asset. Raises InputError when the file cannot be opened; its faults are in `diagnostics`."""
    return read_asset(member.read(), member.extension, game_of(member, settings.game))


def load(path: str, base: Sequence[str] = (), game: Game | None = None) -> Level:
    """Read the one level that a path names, as `masspack.gob!jkl/lagoon.jkl`.

    `base` are folders or packs with the game's own files, searched in their order after those beside the level; see
    `Level.resources`. Raises InputError when a path cannot be opened, or `path` is no level or holds several. What is
    wrong inside the level is in `Level.diagnostics`.
    """
    library = path.lower().endswith(f".{LIBRARY_EXTENSION}")
    levels = discover(path, extensions=(LIBRARY_EXTENSION if library else LEVEL_EXTENSION,))
    if len(levels) > 1:
        raise InputError(f"{path} holds {len(levels)} levels: name one of {listed(m.path for m in levels)}")
    level = read_level(levels[0], Settings(game, base=tuple(base)))
    if not level.document.sections:
        raise InputError(f"cannot read {levels[0].path}: it has no SECTION: lines, so it is no level")
    return level


def build(
    level: Level,
    accuracy: Accuracy = "balanced",
    engine: str = "research",
    *,
    cut_anyway: bool = False,
    plain: bool = False,
) -> bytes:
    """Compile a level, as `jktools build` does, and give the bytes of the file.

    `accuracy` is `fast`, `balanced` or `exact`: that of what is computed; `fast` also moves vertices onto a grid
    (docs/format.md tells how far). `cut_anyway` leaves out templates that nothing is known to reach, though COGs are
    missing that might tell otherwise. `plain` writes nothing but plain vectors, which take more bytes. Raises
    CompileError for a level that the engine would refuse, ValueError for another accuracy.
    """
    if accuracy not in ACCURACIES:
        raise ValueError(f"accuracy is {accuracy!r}, but can be {', '.join(ACCURACIES)}")
    return compile_level(level, CompileSettings(engine, accuracy, cut_anyway=cut_anyway, plain=plain))


def mesh(level: Level) -> SectorMesh:
    """The sectors of a level for questions of place and sight; what cannot be computed with is left out."""
    return SectorMesh.from_level(level)


def listed(paths: Iterable[str], most: int = 5) -> str:
    """The first few of some paths, for a message."""
    names: Sequence[str] = list(paths)
    return ", ".join(names[:most]) + (", ..." if len(names) > most else "")
