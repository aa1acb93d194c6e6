"""The research document's numbers, read once."""

import tomllib
from pathlib import Path
from typing import Any

import pytest


@pytest.fixture(scope="session")
def golden() -> dict[str, Any]:
    return tomllib.loads(Path(__file__).with_name("golden.toml").read_text())
