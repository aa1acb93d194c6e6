"""Where text and files come from: sources with spans, and the containers that hold them."""

from jktools.source.container import Container, Folder, Member
from jktools.source.errors import InputError
from jktools.source.gob import Gob
from jktools.source.path import Target, resolve
from jktools.source.text import Position, Source, Span

__all__ = [
    "Container",
    "Folder",
    "Gob",
    "InputError",
    "Member",
    "Position",
    "Source",
    "Span",
    "Target",
    "resolve",
]
