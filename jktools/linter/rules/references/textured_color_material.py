"""JK113: a surface that textures a material which is a colour."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity
from jktools.facts import LevelFacts
from jktools.linter.rule import Finding, rule
from jktools.model import Level

TEXTURED = 4
"""The geometry mode of textures; 3 is that of colours."""


@rule("JK113", "textured-color-material", severity=Severity.WARNING, since="0.1.0")
def textured_color_material(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report surfaces with geometry mode 4 (textured) whose material is a plain colour.

    ## Why it matters
    A colour has no texels to draw. OpenJKDF2 draws such a surface with mode 3 instead; modders of the original game
    report that the level ends at once. Told once a material, as far as its file is at hand.
    """
    table = level.document.surfaces
    textured = np.flatnonzero((table.geometry_mode == TEXTURED) & ~table.broken)
    used, first, counts = np.unique(table.material[textured], return_index=True, return_counts=True)
    for index, at, count in zip(used.tolist(), first.tolist(), counts.tolist(), strict=True):
        if not 0 <= index < len(level.materials):
            continue
        material = level.resources.material(level.materials[index])
        if material is not None and material.is_color:
            surface = level.surfaces[int(textured[at])]
            more = f", and {count - 1} more do" if count > 1 else ""
            yield Finding(
                Label(surface.span),
                f'{surface.title} has geometry mode {TEXTURED}, but its material "{level.materials[index]}" is a colour'
                + more,
                "write geometry mode 3",
                surface.subject,
            )
