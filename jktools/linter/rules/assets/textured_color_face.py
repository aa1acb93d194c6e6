"""JK142: a face of a model that textures a material which is a colour."""

from collections.abc import Iterator

import numpy as np

from jktools.diagnostics import Label, Severity, Subject
from jktools.facts import AssetFacts
from jktools.linter.rule import Finding, rule
from jktools.linter.rules.references.textured_color_material import TEXTURED
from jktools.syntax.assets.model import Model


@rule("JK142", "textured-color-face", severity=Severity.WARNING, since="0.1.0", looks_at=Model)
def textured_color_face(model: Model, facts: AssetFacts) -> Iterator[Finding]:
    """Report faces of a model with geometry mode 4 (textured) whose material is a plain colour.

    ## Why it matters
    A colour has no texels to draw. Modders report that the original game ends at once when it comes to draw such a
    face, as for surfaces of a level (JK113). Told once a material, as far as its file is at hand.
    """
    told: set[int] = set()
    for mesh in (mesh for geoset in model.geosets for mesh in geoset.meshes):
        faces = mesh.faces
        for face in np.flatnonzero((faces.geometry_mode == TEXTURED) & ~faces.broken).tolist():
            index = int(faces.material[face])
            if index in told or not 0 <= index < len(model.materials):
                continue
            told.add(index)
            material = facts.resources.material(model.materials[index])
            if material is not None and material.is_color:
                yield Finding(
                    Label(model.lines.span(int(faces.lines[face]))),
                    f'face {face} of mesh "{mesh.name}" has geometry mode {TEXTURED}, but its material '
                    f'"{model.materials[index]}" is a colour',
                    "write geometry mode 3",
                    Subject("face", face),
                )
