"""Every motion value of golden.toml is held by a check, and every check passes."""

import fnmatch
from collections.abc import Iterator
from typing import Any

import pytest

from tests.engine import pose_checks  # noqa: F401 (its checks register themselves)
from tests.engine.motion_checks import CHECKS, Check, Golden

APPEARANCE = {"color", "ir_mode", "dynamic_light", "particles", "sight"}
"""Tables of the systems of light, particles and sight, which have tests of their own."""


def leaves(value: Any, path: str = "") -> Iterator[str]:
    if isinstance(value, dict):
        for key, inner in value.items():
            yield from leaves(inner, f"{path}.{key}" if path else key)
    elif isinstance(value, list) and value:
        for i, inner in enumerate(value):
            yield from leaves(inner, f"{path}.{i}")
    else:
        yield path


def motion_keys(golden: Golden) -> list[str]:
    return [path for path in leaves(golden) if path.split(".")[0] not in APPEARANCE]


def holding(path: str) -> list[Check]:
    return [check for pattern, check in CHECKS.items() if fnmatch.fnmatch(path, pattern)]


@pytest.mark.parametrize("check", dict.fromkeys(CHECKS.values()), ids=lambda check: check.__name__)
def test_golden(check: Check, golden: Golden) -> None:
    check(golden)


def test_no_key_is_left_out(golden: Golden) -> None:
    keys = motion_keys(golden)
    assert len(keys) > 100
    assert [path for path in keys if not holding(path)] == []


def test_no_check_holds_nothing(golden: Golden) -> None:
    keys = motion_keys(golden)
    assert [pattern for pattern in CHECKS if not fnmatch.filter(keys, pattern)] == []
