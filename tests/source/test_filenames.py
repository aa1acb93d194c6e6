from __future__ import annotations

import pytest

from jktools.source.filenames import fault_of


@pytest.mark.parametrize(
    "name",
    [
        "jkl/lagoon.jkl",
        "a..b/c...d",
        ".hidden",
        "console.txt",
        "com10",
        "aux_cog.cog",
        "é ü/x y.mat",
        "..x",
        "nulls/co",
    ],
)
def test_ordinary_names_may_be_written(name: str) -> None:
    assert fault_of(name) is None


@pytest.mark.parametrize(
    ("name", "fault"),
    [
        ("", "it has no name"),
        ("/etc/passwd", "its name is absolute"),
        ("//server/share", "its name is absolute"),
        ("C:/x", "its name starts with a drive"),
        ("c:x", "its name starts with a drive"),
        ("../x", "its name leads out of the folder"),
        ("a/../../x", "its name leads out of the folder"),
        ("a/..", "its name leads out of the folder"),
        ("a//b", "its name has an empty part"),
        ("./a", "its name has an empty part"),
        ("a/", "its name has an empty part"),
        ("a/b:stream", "'b:stream' in its name has a character that file names must not have"),
        ("a\nb", r"'a\nb' in its name has a character that file names must not have"),
        ("what?", "'what?' in its name has a character that file names must not have"),
        ("a./b", "'a.' in its name ends with a dot or a blank, which Windows drops"),
        (".. /b", "'.. ' in its name ends with a dot or a blank, which Windows drops"),
        ("a/CON", "'CON' in its name is a device of Windows"),
        ("nul.txt/a", "'nul.txt' in its name is a device of Windows"),
        ("Com1 .jkl", "'Com1 .jkl' in its name is a device of Windows"),
        ("lpt³", "'lpt³' in its name is a device of Windows"),
    ],
)
def test_other_names_say_why_not(name: str, fault: str) -> None:
    assert fault_of(name) == fault
