from hypothesis import given
from hypothesis import strategies as st

from jktools.source import Source


def test_lines_and_columns_count_bytes_from_one() -> None:
    source = Source("x", b"ab\r\n\tc\n\xe9d")
    assert source.position(0) == (1, 1)
    assert source.position(5) == (2, 2)
    assert source.position(7) == (3, 1)
    assert source.position(9) == (3, 3)
    assert [source.line(n) for n in (1, 2, 3)] == ["ab", "\tc", "\xe9d"]


@given(st.binary(max_size=60))
def test_a_position_leads_back_to_its_offset(data: bytes) -> None:
    source = Source("x", data)
    for offset in range(len(data) + 1):
        line, column = source.position(offset)
        assert source.offset(line) + column - 1 == offset
        assert b"\n" not in data[source.offset(line) : offset]
