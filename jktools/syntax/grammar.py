"""Lark grammars of the package, with their parse tables kept between runs."""

from __future__ import annotations

import contextlib
import hashlib
import os
import stat
import sys
import tempfile
from functools import cache
from importlib.resources import files
from importlib.resources.abc import Traversable
from pathlib import Path
from typing import Literal

import lark

CACHE_FOLDER_VARIABLE = "JKTOOLS_CACHE"
"""Names another folder for the parse tables; empty turns the cache off."""


Lexer = Literal["contextual", "basic"]
"""Whether the scanner knows what the parser expects; that of COG code must not: `while` is no name anywhere."""

_SHARED = "words"
"""The grammar that others import their terminals from."""


@cache
def load(name: str, start: tuple[str, ...], lexer: Lexer = "contextual") -> lark.Lark:
    """The parser of `grammars/<name>.lark` with these start rules.

    Building tables takes some 50 ms, reading them back 10. Lark unpickles what it finds, so the cache is trusted
    only in a folder that belongs to this user and that nobody else can write to.
    """
    text = _text(name)
    folder = _cache_folder()
    if folder is None:
        return _build(text, start, lexer)
    parts = (text, _text(_SHARED), start, lexer, lark.__version__, sys.version_info[:2])
    key = hashlib.sha256(repr(parts).encode()).hexdigest()
    kept = folder / f"{name}-{key[:20]}.lark"
    if kept.exists():
        return _build(text, start, lexer, kept)
    # Lark writes its cache in place: let it write beside the target, then rename.
    handle, fresh = tempfile.mkstemp(dir=folder, prefix=f"{name}-")
    os.close(handle)
    Path(fresh).unlink()
    try:
        parser = _build(text, start, lexer, Path(fresh))
        Path(fresh).replace(kept)
    except OSError:
        return _build(text, start, lexer)
    finally:
        with contextlib.suppress(FileNotFoundError):
            Path(fresh).unlink()
    return parser


def _file(name: str) -> Traversable:
    return files("jktools").joinpath("grammars", f"{name}.lark")


def _text(name: str) -> str:
    return _file(name).read_text("utf-8")


def _build(text: str, start: tuple[str, ...], lexer: Lexer, kept: Path | None = None) -> lark.Lark:
    return lark.Lark(
        text,
        parser="lalr",
        lexer=lexer,
        start=list(start),
        cache=False if kept is None else str(kept),
        maybe_placeholders=False,
        import_paths=[str(Path(str(_file(_SHARED))).parent)],
    )


def _cache_folder() -> Path | None:
    chosen = os.environ.get(CACHE_FOLDER_VARIABLE)
    if chosen == "":
        return None
    try:
        base = Path(chosen) if chosen else Path(os.environ.get("XDG_CACHE_HOME") or Path.home() / ".cache") / "jktools"
        base.mkdir(mode=0o700, parents=True, exist_ok=True)
        state = base.stat()
    except (OSError, RuntimeError):
        return None
    owned = not hasattr(os, "getuid") or state.st_uid == os.getuid()
    private = not state.st_mode & (stat.S_IWGRP | stat.S_IWOTH)
    return base if owned and private else None
