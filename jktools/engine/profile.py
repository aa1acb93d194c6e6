"""The two engine profiles."""

import enum


class Engine(enum.StrEnum):
    """Name whose word counts: the research document's findings, or what the decompiled engine does."""

    RESEARCH = "research"
    OPENJKDF2 = "openjkdf2"
