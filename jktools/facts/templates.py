"""What the templates of a level say of themselves, followed up the parents as written."""

from __future__ import annotations

from jktools.model import Level, Template, Thing

NO_PARENT = "none"
UNTYPED = ""


def template_types(level: Level) -> tuple[str | None, ...]:
    """Each template's type in lower case: the nearest `type=` up its parents, `UNTYPED` where none says it.

    None where the level does not define a parent, so that only the game's own templates could tell.
    """
    types: list[str | None] = []
    for template in level.templates:
        parent = template.parent
        if parent is not None:
            inherited = types[parent.index]
        else:
            inherited = UNTYPED if template.parent_name.lower() == NO_PARENT else None
        types.append(_own_type(template) or inherited)
    return tuple(types)


def thing_types(level: Level, of_templates: tuple[str | None, ...]) -> tuple[str | None, ...]:
    """Each thing's type in lower case, as `template_types`; None where its template is unknown."""
    types: list[str | None] = []
    for index, name in enumerate(level.document.things.templates):
        at = level.template_by_name.get(name.lower(), -1)
        types.append(_own_type(level.things[index]) or (of_templates[at] if at >= 0 else None))
    return tuple(types)


def _own_type(owner: Template | Thing) -> str | None:
    """The last `type=` of a record's own parameters."""
    own = [value.lower() for key, value in owner.parameters if key.lower() == "type"]
    return own[-1] if own else None
