"""The golden numbers of the research document."""

import tomllib
from pathlib import Path
from typing import Any

import pytest


@pytest.fixture(scope="session")
def golden() -> dict[str, Any]:
    """Give `golden.toml`."""
    return tomllib.loads((Path(__file__).parent / "golden.toml").read_text())
