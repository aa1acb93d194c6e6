"""Templates and things as the engine holds them: what each inherits, what its own line changes, what is ignored.

Source: sithTemplate_Parse, sithThing_ParseArg and their kin in the decompiled engine. The engine reads templates from
the first to the last. A template starts as a copy of its parent's whole record, if the parent stands above, and each of
its parameters then changes that copy (`template_record.py`). A thing starts as a copy of its template.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from jktools.model.resolved import ANGLES, Ignored, Origin, Reason, Resolved, Setting
from jktools.model.template_acts import Given, has_room, take
from jktools.model.template_record import FREE, NONE, RadiusOf, Record
from jktools.syntax.template.parameters import PARAMETERS, Act, Parameter
from jktools.syntax.template.values import scan

if TYPE_CHECKING:
    from jktools.model.objects import Template, Thing


def unknown_radius(model: str) -> float | None:  # noqa: ARG001 (a RadiusOf)
    """Know no model."""
    return None


class TemplateSet:
    """The templates of a level, resolved in the engine's order, and its things on demand.

    `base` holds the templates of the game's static.jkl, which is read first: its names win over the level's.
    """

    def __init__(
        self,
        templates: Sequence[Template],
        most: int | None = None,
        *,
        game: str = "jk",
        base: TemplateSet | None = None,
        radius_of: RadiusOf = unknown_radius,
    ) -> None:
        """Resolve every template; `most` is what the heading announces."""
        self.game, self.base, self.radius_of = game, base, radius_of
        self.by_name: dict[str, Resolved] = {} if base is None else dict(base.by_name)
        """Those that the engine keeps, by lower-case name."""
        self.entries: list[Resolved] = []
        """One a template as written, kept or not."""
        kept = 0
        for template in templates:
            entry = self._template(template, full=most is not None and kept >= most)
            self.entries.append(entry)
            if entry.dropped is None:
                kept += 1
                self.by_name[template.name.lower()] = entry

    def __len__(self) -> int:
        return len(self.entries)

    def __getitem__(self, index: int) -> Resolved:
        return self.entries[index]

    def get(self, name: str) -> Resolved | None:
        """The template that a name means in a thing's line or in a parameter (sithTemplate_GetTemplate)."""
        return None if name.lower() == NONE else self.by_name.get(name.lower())

    def thing(self, thing: Thing) -> Resolved:
        """A thing with what its line changes. An unknown template makes it a blank one of type free."""
        parent = self.get(thing.template_name)
        line = _Line(self, thing, parent)
        line.turn(thing.angles.tolist())
        line.read(thing.parameters)
        unknown = parent is None and thing.template_name.lower() != NONE
        return line.resolved(thing.dropped, leaves_level=parent.leaves_level if parent is not None else unknown)

    def _template(self, template: Template, *, full: bool) -> Resolved:
        parent = self.by_name.get(template.parent_name.lower())
        unknown = parent is None and template.parent_name.lower() != NONE
        line = _Line(self, template, parent)
        if not template.broken:
            line.read(template.parameters)
        leaves_level = parent.leaves_level if parent is not None else unknown
        return line.resolved(self._dropped(template, line, full, leaves_level), leaves_level=leaves_level)

    def _dropped(self, template: Template, line: _Line, full: bool, leaves_level: bool) -> str | None:
        first = self.by_name.get(template.name.lower())
        if template.broken:
            return "its line could not be read"
        if first is not None:
            owner = first.owner
            if owner.level is not template.level:
                return f"{owner.level.path} has a template of the same name, and is read first"
            return f"template {owner.index} has the same name and comes first"
        if line.type == FREE and not leaves_level:
            return "its type is free"
        return "the heading announces fewer templates" if full else None


class _Line(Record):
    """The record that one line makes, parameter by parameter."""

    def __init__(self, templates: TemplateSet, owner: Template | Thing, parent: Resolved | None) -> None:
        super().__init__(templates, owner, parent)
        self.game = templates.game

    def turn(self, angles: Sequence[float]) -> None:
        """Give a thing the orientation of its line's fields."""
        use = PARAMETERS["orient"].uses[0]
        text = "(" + "/".join(f"{angle:g}" for angle in angles) + ")"
        self.values["orient"] = Setting(tuple(angles), text, use, (Origin(self.owner, ANGLES),))

    def read(self, words: Sequence[tuple[str, str]]) -> None:
        """Take the parameters in their order."""
        for place, (key, text) in enumerate(words):
            key, origin = key.lower(), Origin(self.owner, place)
            reason = self._read(key, text, origin)
            if reason is not None:
                self.ignored.append(Ignored(key, text, reason, origin, self.type, self.move))

    def _read(self, key: str, text: str, origin: Origin) -> Reason | None:
        parameter = PARAMETERS.get(key)
        if parameter is None:
            return Reason.UNKNOWN
        if parameter.game != "jk" and self.game == "jk":
            return Reason.OTHER_GAME
        if not parameter.uses:
            return Reason.NO_HANDLER
        return self._ask_handlers(parameter, text, origin)

    def _ask_handlers(self, parameter: Parameter, text: str, origin: Origin) -> Reason | None:
        reason: Reason | None = Reason.NOT_FOR_THIS
        for use in parameter.uses:
            if not self.serves(use.scope):
                continue
            if use.act is Act.FRAME and not has_room(self, use):
                return Reason.FULL
            value = scan(use.kind, text)
            given = None if value is None else Given(parameter.key, use, value, text, origin)
            reason = Reason.REJECTED if given is None else take(self, given)
            if reason is not Reason.REJECTED:
                break
        return reason
