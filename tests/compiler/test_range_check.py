"""The range check finds an index that leads out of its array wherever in a packed column it stands."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.compiler import CompiledFileError, CompiledLevel, compile_level
from tests.support.halls import halls

COMPILED = compile_level(halls())
COLUMNS = ("corner_vertex", "surface_adjoin", "sector_vertex", "surface_sector")


@pytest.mark.parametrize("column", COLUMNS)
def test_a_wrong_index_is_found_in_every_lane(column: str) -> None:
    """Numbers are compared many at a time: the first, the last, and those where one lot ends and the next begins."""
    compiled = CompiledLevel(COMPILED)
    stored = compiled.geometry.stored[column]
    values = stored.values
    assert values is not None
    assert stored.index is None
    assert values.itemsize == 1
    count = len(values)
    assert count > 16
    octets = np.frombuffer(compiled.data, np.uint8)
    start = values.__array_interface__["data"][0] - octets.__array_interface__["data"][0]
    wrong = int(np.iinfo(values.dtype).max)
    for place in {0, 1, *range(60, 70), count // 2, count - 2, count - 1} & set(range(count)):
        damaged = bytearray(COMPILED)
        damaged[start + place] = wrong
        with pytest.raises(CompiledFileError, match="damaged") as refused:
            CompiledLevel(bytes(damaged))
        assert str(refused.value.__cause__).startswith(f"geometry.{column} {place} is {wrong}, but there are ")


def test_an_index_below_none_is_found() -> None:
    compiled = CompiledLevel(COMPILED)
    values = compiled.geometry.stored["surface_adjoin"].values
    assert values is not None
    assert values.dtype == np.int8
    octets = np.frombuffer(compiled.data, np.uint8)
    start = values.__array_interface__["data"][0] - octets.__array_interface__["data"][0]
    damaged = bytearray(COMPILED)
    damaged[start + len(values) - 1] = 0x100 - 2
    with pytest.raises(CompiledFileError, match=rf"surface_adjoin {len(values) - 1} is -2, but there are "):
        CompiledLevel(bytes(damaged))
