"""The two readings of the engine that every rule is given in."""

from __future__ import annotations

import enum


class Engine(enum.StrEnum):
    """Whose rules apply. A function that knows both takes `engine=`; the two are never blended.

    A system that the research document does not treat at all has one known rule, the decompiled engine's, and
    its functions take no `engine=`.
    """

    RESEARCH = "research"
    """The findings of the research document ("JK Engine Research", 2018), as it states them."""
    OPENJKDF2 = "openjkdf2"
    """What the decompiled engine (OpenJKDF2) does."""
