from __future__ import annotations

from pathlib import Path

import pytest

from tests.runtime.compiler import PLAIN, built, compiler


@pytest.fixture(scope="session")
def programs(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder that compiled programs go into."""
    if compiler() is None:
        pytest.skip("no C++ compiler is at hand")
    return tmp_path_factory.mktemp("runtime")


@pytest.fixture(scope="session")
def jklb_query(programs: Path) -> Path:
    """The sample program."""
    return built("runtime/sample/jklb_query.cpp", programs / "jklb_query", PLAIN)
