"""How many frames a thing's path has."""

from __future__ import annotations

from jktools.facts.cog.dataflow import default_value
from jktools.model import Template, Thing


def frame_count(thing: Thing) -> int | None:
    """The frames of a thing, from its own line or the nearest template that has some; None where that is not known.

    The engine makes room for as many as the first `numframes` says and takes no more (sithTrackThing_LoadPathParams
    in the decompiled engine).
    """
    owner: Thing | Template | None = thing
    while owner is not None:
        for key, value in owner.parameters:
            if key.lower() == "numframes":
                announced = default_value("int", value)
                written = sum(k.lower() == "frame" for k, _ in owner.parameters)
                return min(written, announced) if isinstance(announced, int) and announced > 0 else 0
        if any(key.lower() == "frame" for key, _ in owner.parameters):
            return None  # they go where a template's `numframes` has made room
        if isinstance(owner, Thing):
            if owner.template is None:
                return None
            owner = owner.template
        else:
            parent = owner.parent
            if parent is None and owner.parent_name.lower() != "none":
                return None
            owner = parent
    return 0
