"""The header of a script, as the engine's line reader takes it."""

from __future__ import annotations

import pytest

from jktools.syntax.cog import Script
from tests.support.scripts import script_of


def header(*lines: str, ends: str = "\n") -> Script:
    script = script_of(ends.join([*lines, "code", ";", "end", ""]))
    assert script.faults == ()
    return script


def names(script: Script) -> list[tuple[str, str, str | None]]:
    return [(s.type, s.name.key, s.default) for s in script.header.symbols]


def test_words_are_folded_and_parted_by_blanks_tabs_and_commas() -> None:
    script = header("SYMBOLS these", "Thing\tDoor=5,LOCAL", "FLEX Speed=1.5 # fast", ",,", "END of them")
    assert names(script) == [("thing", "door", "5"), ("flex", "speed", "1.5")]
    assert [s.local for s in script.header.symbols] == [True, False]


def test_comments_of_the_header() -> None:
    script = header(
        "# one", "; two", "symbols", "#thing a", ";thing b", " ;thing c", "thing d#local", "//thing e",
        "thing f // local", "end", "# three", "; four",
    )  # fmt: skip
    assert names(script) == [("thing", "d", None), ("thing", "f", None)]
    assert [s.local for s in script.header.symbols] == [False, True]
    assert [s.type for s in script.header.dropped] == [";thing", "//thing"]


@pytest.mark.parametrize("ends", ["\n", "\r\n"])
def test_a_backslash_joins_lines_before_a_bare_line_feed_only(ends: str) -> None:
    script = header("symbols", "thing a \\", "local", "end", ends=ends)
    joined = ends == "\n"
    assert names(script) == [("thing", "a", None)]
    assert [s.local for s in script.header.symbols] == [joined]
    assert [s.type for s in script.header.dropped] == ([] if joined else ["local"])
    (symbol,) = script.header.symbols
    assert script.source.text[symbol.name.start : symbol.name.end] == "a"
    if joined:
        (attribute,) = symbol.attributes
        assert script.source.text[attribute.start : attribute.end] == "local"


def test_what_lies_behind_a_joined_code_line_is_code() -> None:
    script = script_of("symbols\nend\ncode \\\nx = 1;\ny = 2;\nend\n")
    assert script.faults == ()
    assert script.source.text[script.code.start :].startswith("y = 2;")


def test_a_code_line_past_the_buffer_is_code_again() -> None:
    line = "code " + "x" * 1018 + "y = 2;"
    script = script_of(f"symbols\nend\n{line}\nend\n")
    assert script.faults == ()
    assert script.source.text[script.code.start :].startswith("y = 2;")
    assert script_of(f"symbols\nend\n{line}\nend\n", game="mots").rejected


@pytest.mark.parametrize(
    ("line", "flags"),
    [
        ("flags=0x240", 0x240), ("FLAGS=240", 0x240), ("flags = 0x240", 0xF), ("flags= 0x240", 0), ("flags", 0xF),
        ("flags=0x", 0), ("flags=1g", 1), ("flags=fffffffff", 0xFFFFFFFF),
    ],
)  # fmt: skip
def test_flags_are_hexadecimal(line: str, flags: int) -> None:
    assert header(line, "symbols", "end").header.flags == flags


@pytest.mark.parametrize(
    ("line", "local", "link", "mask"),
    [
        ("thing a", False, 0, 0x401), ("thing a nolink", False, -1, 0x401), ("thing a local", True, -1, 0x401),
        ("surface a linkid=7 mask=5", False, 7, 5), ("sector a mask=0x10 linkid=x", False, 0, 0x10),
        ("thing a nolink linkid=2", False, 2, 0x401), ("thing a mask", False, 0, 0x401), ("cog a", False, -1, 0x401),
        ("flex a linkid=3", False, -1, 0x401), ("sound a local", True, -1, 0x401),
        ("int a local mask=3", True, -1, 0x401),
        ("thing a linkid=-1", False, -1, 0x401),
    ],
)  # fmt: skip
def test_links_are_what_the_attributes_make_of_them(line: str, local: bool, link: int, mask: int) -> None:
    (symbol,) = header("symbols", line, "end").header.symbols
    assert (symbol.local, symbol.link, symbol.mask) == (local, link, mask)


def test_a_message_can_bind_another_label() -> None:
    (symbol,) = header("symbols", "message opened=activate", "end").header.symbols
    assert (symbol.name.key, symbol.default) == ("opened", "activate")


def test_symbols_past_the_limits_are_dropped() -> None:
    script = header("symbols", *(f"message m{i}" for i in range(34)), "end")
    assert (len(script.header.symbols), [s.name.key for s in script.header.dropped]) == (32, ["m32", "m33"])
    script = header(
        "symbols", *(f"int l{i} local" for i in range(5)), *(f"thing t{i}" for i in range(130)), "end"
    )  # fmt: skip
    assert [s.name.key for s in script.header.dropped] == ["t128", "t129"]


@pytest.mark.parametrize(
    ("text", "codes"),
    [
        ("// a door\nsymbols\nend\ncode\n;\nend\n", ["JK050", "JK063"]),
        ("symbols\nend\n// here\ncode\n;\nend\n", ["JK063", "JK050"]),
        ("symbols\nthing a\ncode\n;\n", ["JK064", "JK050"]),
        ("symbols\nend\n", ["JK064", "JK050"]),
        ("", ["JK064", "JK050"]),
        ("code\n;\nend\n", ["JK064", "JK050"]),
        ("symbols\nend\ncode\nend\n", ["JK056", "JK050"]),
        ("symbols\nend\ncode\n", ["JK056", "JK050"]),
        ("symbols\nend\ncode\n// nothing\n", ["JK056", "JK050"]),
        ("x\nsymbols\nend\ncode\nx = 1\nend\n", ["JK063", "JK052", "JK050"]),
    ],
)
def test_what_the_engine_refuses_in_a_header(text: str, codes: list[str]) -> None:
    assert sorted(d.code.id for d in script_of(text).faults) == sorted(codes)


def test_what_a_refused_header_holds_is_read_all_the_same() -> None:
    script = script_of("// a door\nflags=0x40\nsymbols\nthing a\nend\ncode\nx: stop;\nend\n")
    assert names(script) == [("thing", "a", None)]
    assert script.header.flags == 0x40
    assert len(script.code.body) == 1


def test_bytes_beyond_ascii_are_not_folded() -> None:
    (symbol,) = header("symbols", "thing \xc4B", "end").header.symbols
    assert symbol.name.key == "\xc4b"


def test_a_zero_byte_ends_a_line() -> None:
    assert names(header("symbols", "thing a\0 local", "end")) == [("thing", "a", None)]
