"""The forms of a column: each comes back bit for bit, and the smallest is taken."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra import numpy as arrays

from jktools.compiler.columns import Column
from jktools.compiler.packing import Stored, absent, pack, pack_group

INDEX, WHOLE, UNSIGNED, REAL, VECTOR = (
    Column("i4", rows_of="x", index_of="y", or_none=True),
    Column("i4"),
    Column("u4"),
    Column("f4"),
    Column("f4", 3),
)


def back(values: Any, column: Column) -> tuple[Stored | None, bytes]:
    stored = pack(np.array(values), column)
    whole = absent(column, len(values)) if stored is None else stored
    assert len(whole) == len(values)
    return stored, whole.array(column).tobytes()


@pytest.mark.parametrize(
    ("values", "column", "kind"),
    [
        ([5, 3, 200], UNSIGNED, "|u1"),
        ([5, -1, 100], INDEX, "|i1"),
        ([5, -1, 128], INDEX, "<i2"),
        ([5, 0, 65535], UNSIGNED, "<u2"),
        ([5, 0, 65536], UNSIGNED, "<u4"),
        ([5, -1, 40000], INDEX, "<i4"),
    ],
)
def test_whole_numbers_take_the_fewest_bytes_that_hold_all(values: list[int], column: Column, kind: str) -> None:
    many = values * 40
    stored, octets = back(many, column)
    assert stored is not None
    assert stored.values is not None
    assert stored.values.dtype.str == kind or stored.index is not None
    assert octets == np.array(many, f"<{column.type}").tobytes()


def test_a_column_of_nothing_is_absent() -> None:
    assert pack(np.full(9, -1), INDEX) is None
    assert pack(np.zeros(9), Column("f4", rows_of="x")) is None
    assert pack(np.full(9, -0.0), Column("f4", rows_of="x")) is not None, "-0.0 is not 0.0"
    assert pack(np.zeros(9), Column("f4")) is not None, "it counts itself"
    assert pack(np.zeros(1), Column("u4", rows_of="x", cuts="y")) is not None, "it cuts"


def test_one_row_stands_for_all() -> None:
    stored = pack(np.full((500, 3), np.nan), VECTOR)
    assert stored is not None
    assert (len(stored), stored.count) == (500, 500)
    assert np.isnan(stored.array(VECTOR)).all()
    assert sum(part.nbytes for part in stored.vectors) == 12


def test_a_run_needs_no_values() -> None:
    stored = pack(np.arange(7, 407), WHOLE)
    assert stored is not None
    assert (stored.values, stored.first, stored.count) == (None, 7, 400)
    assert stored.array(WHOLE).tolist() == list(range(7, 407))
    backwards = pack(np.arange(400)[::-1], WHOLE)
    assert backwards is not None
    assert backwards.values is not None


def test_rows_that_repeat_are_pooled_where_that_pays() -> None:
    directions = np.array([[1, 0, 0], [0, 0.5, 0], [0, 0, -0.0]] * 100, "f4")
    stored = pack(directions, VECTOR)
    assert stored is not None
    assert stored.index is not None
    assert stored.values is not None
    assert (stored.values.shape, stored.index.dtype.str) == ((3, 3), "|u1")
    assert stored.array(VECTOR).tobytes() == directions.tobytes()
    distinct = pack(np.arange(300.0).reshape(-1, 3), VECTOR)
    assert distinct is not None
    assert distinct.is_plain(VECTOR)


def test_a_group_shares_one_index() -> None:
    columns = {"a": Column("u4", group="g"), "b": Column("f4", rows_of="a", group="g")}
    numbers = np.tile(np.arange(300) * 1000, 5)
    values = {"a": numbers, "b": numbers / 7}
    stored = pack_group(values, columns)
    a, b = stored["a"], stored["b"]
    assert a is not None
    assert b is not None
    assert a.index is b.index
    assert a.index is not None
    assert a.values is not None
    assert len(a.values) == 300
    for name, column in columns.items():
        each = stored[name]
        assert each is not None
        assert each.array(column).tobytes() == values[name].astype(f"<{column.type}").tobytes()


def test_a_group_falls_into_parts_that_repeat_together() -> None:
    """a and b repeat in one way, c and d in another; e repeats nothing. One pool for all would hold every row."""
    columns = {name: Column("u4", rows_of=None if name == "a" else "a", group="g") for name in "abcde"}
    rng = np.random.default_rng(2)
    one, two = rng.integers(0, 40, 6000), rng.integers(0, 50, 6000)
    values = {
        "a": one * 70_000, "b": one * 90_000, "c": two * 110_000, "d": two * 130_000,
        "e": rng.permutation(6000).astype(np.int64) * 600_000,
    }  # fmt: skip
    stored = pack_group(values, columns)
    index = {name: None if each is None else each.index for name, each in stored.items()}
    assert index["a"] is index["b"] is not None
    assert index["c"] is index["d"] is not None
    assert index["a"] is not index["c"]
    assert index["e"] is None
    for name, column in columns.items():
        each = stored[name]
        assert each is not None
        assert each.array(column).tolist() == values[name].tolist()


@given(st.data())
def test_every_column_comes_back_bit_for_bit(data: st.DataObject) -> None:
    column = data.draw(
        st.sampled_from([INDEX, WHOLE, UNSIGNED, REAL, VECTOR, Column("f8", rows_of="x"), Column("u1", rows_of="x")])
    )
    rows = data.draw(st.integers(0, 30))
    few = data.draw(
        arrays.arrays(np.dtype(f"<{column.type}"), (4, column.width), unique=False, elements=None, fill=st.nothing())
    )
    values = few[data.draw(st.lists(st.integers(0, 3), min_size=rows, max_size=rows))]
    _, octets = back(values.reshape(-1) if column.width == 1 else values, column)
    assert octets == values.tobytes()


def test_a_grid_counts_steps_from_its_origin() -> None:
    stored = Stored(np.array([[-32768, 0, 32767]], "<i2"), step=2.0**-10, origin=(32768, 0, 1))
    assert stored.array(VECTOR).tolist() == [[0, 0, 32]]
