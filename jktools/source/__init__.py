"""Where text and files come from: sources with spans, and the containers that hold them."""

from jktools.source.container import Container, Folder, Member
from jktools.source.errors import InputError
from jktools.source.formats import PACK_EXTENSIONS, enter, open_pack
from jktools.source.gob import Gob
from jktools.source.pack import Pack, PackBytes
from jktools.source.path import Target, resolve
from jktools.source.text import Position, Source, Span
from jktools.source.zip import Zip

__all__ = [
    "PACK_EXTENSIONS",
    "Container",
    "Folder",
    "Gob",
    "InputError",
    "Member",
    "Pack",
    "PackBytes",
    "Position",
    "Source",
    "Span",
    "Target",
    "Zip",
    "enter",
    "open_pack",
    "resolve",
]
