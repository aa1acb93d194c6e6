"""Records of a level's templates, things and COGs, made on demand over its columns."""

from __future__ import annotations

from jktools.model.views import Sector, View, optional
from jktools.syntax.jkl import Parameters, Table, records
from jktools.syntax.jkl.document import Float32


class _WithParameters(View):
    @property
    def _words(self) -> Parameters:
        raise NotImplementedError

    @property
    def parameters(self) -> list[tuple[str, str]]:
        """Its own parameters in order, as written, without what it inherits."""
        start, end = self._words.start[self.index], self._words.start[self.index + 1]
        return list(zip(self._words.keys[start:end], self._words.values[start:end], strict=True))


class Template(_WithParameters):
    """A kind of thing."""

    kind = "template"
    record = records.TEMPLATE

    @property
    def _table(self) -> Table:
        return self.level.document.templates

    @property
    def _words(self) -> Parameters:
        return self.level.document.templates.parameters

    @property
    def name(self) -> str:
        """As written."""
        return self.level.document.templates.names[self.index]

    @property
    def title(self) -> str:
        """For messages: `template 12 (walkplayer)`."""
        return f"template {self.index} ({self.name})"

    @property
    def parent_name(self) -> str:
        """As written; `none` for a blank base."""
        return self.level.document.templates.parents[self.index]

    @property
    def parent(self) -> Template | None:
        """The template that it inherits from: the first of that name, and only one that stands before it."""
        index = self.level.template_by_name.get(self.parent_name.lower(), -1)
        return self.level.templates[index] if 0 <= index < self.index else None

    @property
    def dropped(self) -> str | None:
        """The engine keeps the first of a name and no more than the heading announces (sithTemplate_Load)."""
        if self.broken:
            return "its line could not be read"
        first = self.level.template_by_name[self.name.lower()]
        if first != self.index:
            return f"template {first} has the same name and comes first"
        heading = self.level.document.templates.heading
        if heading is not None and self.index >= heading.count:
            return f"the heading announces {heading.count} templates"
        return None


class Thing(_WithParameters):
    """A thing as placed."""

    kind = "thing"
    record = records.THING

    @property
    def _table(self) -> Table:
        return self.level.document.things

    @property
    def _words(self) -> Parameters:
        return self.level.document.things.parameters

    @property
    def number(self) -> int:
        """The engine's thing number, which COGs use: the label before the colon."""
        return int(self.level.document.things.number[self.index])

    @property
    def name(self) -> str:
        """As written; the engine uses it for nothing."""
        return self.level.document.things.names[self.index]

    @property
    def title(self) -> str:
        """For messages: `thing 12 (walkplayer)`, by the engine's number."""
        return f"thing {self.number} ({self.template_name})"

    @property
    def template_name(self) -> str:
        """As written."""
        return self.level.document.things.templates[self.index]

    @property
    def template(self) -> Template | None:
        """Its template; None makes the engine place a blank thing."""
        return optional(self.level.templates, self.level.template_by_name.get(self.template_name.lower(), -1))

    @property
    def position(self) -> Float32:
        """(3,) float32, JKU."""
        position: Float32 = self.level.document.things.position[self.index]
        return position

    @property
    def angles(self) -> Float32:
        """(3,) float32: pitch, yaw and roll, degrees."""
        angles: Float32 = self.level.document.things.angles[self.index]
        return angles

    @property
    def sector_index(self) -> int:
        """As written."""
        return int(self.level.document.things.sector[self.index])

    @property
    def sector(self) -> Sector | None:
        """The sector that it names."""
        return optional(self.level.sectors, self.sector_index)

    @property
    def dropped(self) -> str | None:
        """The engine skips a thing whose sector does not exist (sithThing_Load)."""
        if self.broken:
            return "its line could not be read"
        if self.sector is None:
            return f"sector {self.sector_index} does not exist"
        return None


class Cog(View):
    """A placed COG."""

    kind = "cog"
    record = records.COG

    @property
    def _table(self) -> Table:
        return self.level.document.cogs

    @property
    def name(self) -> str:
        """The script's file name as written."""
        return self.level.document.cogs.scripts[self.index]

    script = name

    @property
    def title(self) -> str:
        """For messages: `cog 3 (00_door.cog)`."""
        return f"cog {self.index} ({self.name})"

    @property
    def values(self) -> tuple[str, ...]:
        """The values behind the script, as written."""
        table = self.level.document.cogs
        return table.values[table.value_start[self.index] : table.value_start[self.index + 1]]
