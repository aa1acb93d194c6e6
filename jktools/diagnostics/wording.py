"""Phrases that messages share."""

from __future__ import annotations


def numbered(count: int, one: str, many: str | None = None) -> str:
    """What there is to name by number: `the materials 0 to 2`, `material 0 alone` or `no materials`."""
    many = many or f"{one}s"
    if count > 1:
        return f"the {many} 0 to {count - 1}"
    return f"{one} 0 alone" if count else f"no {many}"


def counted(count: int, one: str, many: str | None = None) -> str:
    """A number of things: `1 joint`, `2 joints`."""
    return f"{count} {one if count == 1 else many or f'{one}s'}"


def miscounted(announced: int, kinds: str, found: int) -> str:
    """That a heading is wrong: `the heading announces 3 vertices, but 1 follows`."""
    return f"the heading announces {announced} {kinds}, but {found} follow{'s' * (found == 1)}"
