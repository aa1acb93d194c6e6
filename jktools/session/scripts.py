"""Scripts, from paths and from the levels that bind them."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.facts.references import file_references
from jktools.model import Level
from jktools.model.cog.program import Vocabulary
from jktools.model.resources import Kind
from jktools.session.levels import SCRIPT_EXTENSION, discover, game_of, listed
from jktools.session.settings import Game, Settings
from jktools.source import InputError, Member
from jktools.syntax.cog import Script, read_script


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


def vocabulary_of(member: Member, settings: Settings) -> Vocabulary:
    """What a script can name: the words of its game, and the verbs of the user's own build."""
    return Vocabulary(game_of(member, settings.game), settings.verbs)


def bound_scripts(level: Level) -> Iterator[Member]:
    """The files of the scripts that a level binds and that come with it, each once: placed ones, then those of things.

    A thing has the script that its own line or its template's names (`cog=`). Scripts of a base are the game's own, and
    not the level's to answer for.
    """
    carried = (r.name for r in file_references(level) if r.kind is Kind.COG and r.where in ("template", "thing"))
    for name in dict.fromkeys(name.lower() for name in (*(cog.name for cog in level.cogs), *carried)):
        found = level.resources.find(Kind.COG, name)
        if found is not None and found.own and found.member.extension == SCRIPT_EXTENSION:
            yield found.member
