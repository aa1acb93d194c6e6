"""Records of a level's templates, things and COGs, made on demand over its columns."""

from __future__ import annotations

from jktools.model.resolved import Resolved
from jktools.model.views import Sector, View, optional
from jktools.source import Span
from jktools.syntax.jkl import Parameters, Table, records
from jktools.syntax.jkl.document import Float32
from jktools.syntax.records import WORD


class _WithParameters(View):
    @property
    def _words(self) -> Parameters:
        raise NotImplementedError

    @property
    def parameters(self) -> list[tuple[str, str]]:
        """Its own parameters in order, as written, without what it inherits."""
        start, end = self._words.start[self.index], self._words.start[self.index + 1]
        return list(zip(self._words.keys[start:end], self._words.values[start:end], strict=True))

    def parameter_span(self, place: int) -> Span:
        """Where one of its own parameters stands, counted as in `parameters`."""
        count = int(self._words.start[self.index + 1] - self._words.start[self.index])
        words = [*WORD.finditer(self.record.words(self.level.document.lines.text(self.line)))]
        at = len(words) - count + place
        return self.level.document.lines.part(self.line, words[at].start(), words[at].end())


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
    def resolved(self) -> Resolved:
        """What it is with all that it inherits."""
        return self.level.resolved_templates[self.index]

    @property
    def parent(self) -> Template | None:
        """The template that it inherits from: the one of that name that the engine knows when it reads this one."""
        parent = self.resolved.parent
        return parent.owner if parent is not None and isinstance(parent.owner, Template) else None

    @property
    def dropped(self) -> str | None:
        """The engine keeps the first of a name, nothing without a type, and no more than the heading announces."""
        return self.resolved.dropped


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
        found = self.level.resolved_templates.get(self.template_name)
        return found.owner if found is not None and isinstance(found.owner, Template) else None

    @property
    def resolved(self) -> Resolved:
        """What it is with all that its template gives it."""
        return self.level.resolved_things[self.index]

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
