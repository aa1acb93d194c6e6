"""Files that appear whole or not at all."""

from __future__ import annotations

import os
import secrets
from collections.abc import Iterable
from pathlib import Path

from jktools.source import InputError


def write_atomically(target: Path, data: bytes | memoryview, *, durable: bool = True) -> None:
    """Write beside the target, flush, then rename: a crash never leaves half a file. Raises InputError.

    Without `durable` that holds for a crash of jktools, but not of the machine, and thousands of small files are
    written in a tenth of the time (benchmarks/bench_packs.py).
    """
    write_parts(target, [data], durable=durable)


def write_report(target: Path, data: bytes) -> None:
    """Write where a user pointed: through a link, and into a device or a pipe instead of replacing it.

    Raises InputError.
    """
    try:
        target = target.resolve()
        if target.exists() and not target.is_file() and not target.is_dir():
            with target.open("wb", buffering=0) as stream:
                stream.write(data)
            return
    except OSError as error:
        raise InputError(f"cannot write {target}: {(error.strerror or str(error)).lower()}") from error
    write_atomically(target, data)


def write_parts(target: Path, parts: Iterable[bytes | memoryview], *, durable: bool = True) -> int:
    """Write what comes piece by piece, as atomically, and give how many bytes it was.

    When a piece cannot be made the target stays as it was. Raises InputError.
    """
    try:
        _make_folder(target.parent)
        fresh = target.parent / f".{target.name[:60]}-{secrets.token_hex(6)}"
        try:  # from before the file is there: an interrupt may come at any time
            with fresh.open("xb") as stream:
                size = sum(stream.write(part) for part in parts)
                stream.flush()
                if durable:
                    os.fsync(stream.fileno())
            fresh.replace(target)
        except BaseException:
            fresh.unlink(missing_ok=True)
            raise
    except OSError as error:
        raise InputError(f"cannot write {target}: {(error.strerror or str(error)).lower()}") from error
    return size


def _make_folder(folder: Path) -> None:
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except (FileExistsError, NotADirectoryError):
        file = next(path for path in (folder, *folder.parents) if path.exists())
        raise InputError(f"cannot write below {file}: it is a file, not a folder") from None
