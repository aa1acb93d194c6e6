from __future__ import annotations

import os
from pathlib import Path

import hypothesis
import pytest

from tests.support.levels import CORPUS, TWO_ROOMS

# The same examples at every run; `make fuzz` looks for new ones.
hypothesis.settings.register_profile("same", derandomize=True)
hypothesis.settings.load_profile("default" if os.environ.get("JKTOOLS_FUZZ") else "same")


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
