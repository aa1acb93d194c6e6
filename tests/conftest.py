from __future__ import annotations

from pathlib import Path

import pytest

from tests.support.levels import CORPUS, TWO_ROOMS


@pytest.fixture(scope="session", autouse=True)
def grammar_cache(tmp_path_factory: pytest.TempPathFactory) -> None:
    """Keep the tests' parse tables out of the user's cache."""
    patch = pytest.MonkeyPatch()
    patch.setenv("JKTOOLS_CACHE", str(tmp_path_factory.mktemp("grammars")))


@pytest.fixture(scope="session")
def corpus() -> Path:
    """The folder of real mods; tests that need it are skipped where it is absent."""
    if not CORPUS.exists():
        pytest.skip("the corpus of real mods is not at hand")
    return CORPUS


@pytest.fixture
def level_file(tmp_path: Path) -> Path:
    """The two rooms on disk."""
    path = tmp_path / "rooms.jkl"
    path.write_text(TWO_ROOMS, "ascii")
    return path
