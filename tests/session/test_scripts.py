"""Scripts of a run are read once, whoever asks for them."""

from __future__ import annotations

from pathlib import Path

import pytest

from jktools.facts import script as script_facts_module
from jktools.facts.script import ScriptFacts, script_facts
from jktools.model.cog.program import Vocabulary
from jktools.model.cog.verbs import verb_from
from jktools.model.resources import Library
from jktools.session import Settings, check, discover
from jktools.source import Source
from jktools.syntax.cog import Script, read_script
from tests.support.packs import zip_of

SCRIPT = b"symbols\nmessage startup\nend\ncode\nstartup:\n    DoSomething();\n    return;\nend\n"
LEVEL = (
    b"SECTION: JK\nSECTION: COGSCRIPTS\nWorld scripts 1\n0: a.cog\nend\nSECTION: COGS\nWorld cogs 1\n0: a.cog\nend\n"
)


@pytest.fixture
def pack(tmp_path: Path) -> str:
    path = tmp_path / "mod.zip"
    path.write_bytes(zip_of([("cog/a.cog", SCRIPT), ("jkl/one.jkl", LEVEL), ("jkl/two.jkl", LEVEL)]))
    return path.as_posix()


def test_a_script_is_read_once_for_itself_and_all_levels(pack: str, monkeypatch: pytest.MonkeyPatch) -> None:
    read: list[str] = []

    def reading(source: Source, game: str = "jk") -> Script:
        read.append(source.name)
        return read_script(source, game)

    monkeypatch.setattr(script_facts_module, "read_script", reading)
    found = check([pack], Settings())
    assert read == ["cog/a.cog"]
    assert found.files == 3
    assert [d.code.id for d in found if d.path.endswith("a.cog")] == ["JK531"]


def test_what_is_kept_holds_for_the_same_verbs_and_game_only(pack: str) -> None:
    (member,) = discover(pack, extensions=("cog",))
    library = Library()
    first = script_facts(library, member, Vocabulary("jk"))
    assert script_facts(library, member, Vocabulary("jk")) is first
    own = Vocabulary("jk", {"dosomething": verb_from("dosomething", (), "void")})
    other = script_facts(library, member, own)
    assert isinstance(other, ScriptFacts)
    assert other is not first
    assert not first.program.calls
    assert [verb.name for _, verb in other.program.calls] == ["dosomething"]
    assert script_facts(library, member, Vocabulary("mots")).script.game == "mots"
