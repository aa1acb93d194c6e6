"""Names that may be written to disk, on any system."""

from __future__ import annotations

import re

_RESERVED = re.compile(r"(con|prn|aux|nul|conin\$|conout\$|(com|lpt)[0-9¹²³]) *(\..*)?", re.IGNORECASE)
"""Devices of Windows in any folder, with or without an extension (Microsoft, "Naming Files, Paths, and Namespaces")."""

_UNWRITABLE = re.compile(r'[\x00-\x1f\x7f<>:"|?*]')
"""Control characters, and what Windows gives a meaning of its own; a colon also makes a drive or a hidden stream."""


def fault_of(name: str) -> str | None:
    """Why a pack's file must not be written under its name (slashes, not backslashes), or None when it may be.

    The rules of every system hold on each, so that what one unpacks all can.
    """
    if not name:
        return "it has no name"
    if name.startswith("/"):
        return "its name is absolute"
    if re.match(r"[A-Za-z]:", name):
        return "its name starts with a drive"
    return next((fault for part in name.split("/") if (fault := _fault_of_part(part))), None)


def _fault_of_part(part: str) -> str | None:
    if part == "..":
        return "its name leads out of the folder"
    if part in {"", "."}:
        return "its name has an empty part"
    if _UNWRITABLE.search(part):
        return f"{part!r} in its name has a character that file names must not have"
    if part[-1] in ". ":
        return f"{part!r} in its name ends with a dot or a blank, which Windows drops"
    if _RESERVED.fullmatch(part):
        return f"{part!r} in its name is a device of Windows"
    return None
