"""The small text assets: sprites, sound classes, puppets, AI classes, items and episodes."""

from __future__ import annotations

import re
from collections.abc import Iterator, Sequence
from dataclasses import dataclass

from jktools.diagnostics import Severity, Subject
from jktools.source import Source, Span
from jktools.syntax.assets import faults
from jktools.syntax.assets import small_lines as records
from jktools.syntax.assets.asset import Asset, Reference
from jktools.syntax.assets.lines import LineReader
from jktools.syntax.misfit import quote
from jktools.syntax.records import WORD, Record
from jktools.syntax.rows import floats, ints

NONE = "none"
"""A name that means no file."""

MOST_SPRITE_TYPE = 2
MOST_INSTINCTS = 16
MOST_BODY_PARTS = 10
MOST_BIN = 199


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Sprite(Asset):
    """An SPR file."""

    material: str = ""
    type: int = -1
    size: tuple[float, float] = (float("nan"), float("nan"))
    """Width and height, JKU."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class SoundClass(Asset):
    """An SND file: which sounds a thing makes in which mode."""

    sounds: tuple[tuple[str, str], ...] = ()
    """Mode and sound, as written."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Puppet(Asset):
    """A PUP file: which keyframes play in which mode and submode."""

    keyframes: tuple[tuple[int, str, str], ...] = ()
    """Mode, submode and keyframe, as written."""
    joints: tuple[tuple[int, int], ...] = ()
    """Body part and hierarchy node."""


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class AIClass(Asset):
    """An AI file: parameters, and the instincts that run."""

    parameters: tuple[tuple[str, str], ...] = ()
    instincts: tuple[tuple[str, ...], ...] = ()
    """Name and arguments of each, as written."""


@dataclass(frozen=True, slots=True)
class Item:
    """One line of items.dat."""

    name: str
    bin: int
    least: float
    most: float
    flags: int
    cog: str | None


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Items(Asset):
    """The items.dat of a game."""

    items: tuple[Item, ...] = ()


@dataclass(frozen=True, slots=True)
class EpisodeStep:
    """One line of an episode's sequence."""

    line: int
    type: str
    """`level` or `cutscene`, in lower case."""
    file: str
    next: int
    next_dark: int
    """The line that follows, -1 for none."""
    place: Span


@dataclass(frozen=True, slots=True, eq=False, kw_only=True)
class Episode(Asset):
    """An episode.jk: what the game offers to play, and in which order."""

    title: str = ""
    type: int = -1
    """1 single player, 2 deathmatch or training, 8 capture the flag."""
    steps: tuple[EpisodeStep, ...] = ()


class _Fields:
    """Goes through a file that the engine reads as fields, line by line."""

    def __init__(self, source: Source, game: str, effect: str) -> None:
        self.reader = LineReader(source, game, effect, skips_blank=True)
        self._references: dict[tuple[str, str], Reference] = {}
        self._words: dict[str, str] = {}

    def lines(self) -> Iterator[int]:
        while (line := self.reader.next()) is not None:
            yield line

    def words(self, line: int) -> list[str]:
        """The words of a line; equal ones are kept once, so that a long file of few names takes little room."""
        found = WORD.findall(self.reader.lines.text(line).replace(",", " "))
        return [self._words.setdefault(word, word) for word in found]

    @property
    def references(self) -> tuple[Reference, ...]:
        """Each file that is named, at the first place that names it."""
        return tuple(self._references.values())

    def refer(self, extension: str, name: str, line: int) -> None:
        if name.lower() != NONE and (extension, name.lower()) not in self._references:
            text = self.reader.lines.text(line)
            at = text.lower().find(name.lower())
            place = self.reader.lines.part(line, at, at + len(name)) if at >= 0 else self.reader.lines.span(line)
            self._references[extension, name.lower()] = Reference(extension, name, place)

    def read(self, record: Record, line: int, subject: Subject | None = None) -> Sequence[str] | None:
        return self.reader.record(record, line, subject)


def read_sprite(source: Source, game: str = "jk") -> Sprite:
    """Read an SPR: one line with a material and its measures (sithSprite_LoadEntry)."""
    fields = _Fields(source, game, "the engine refuses the sprite, and a level that lists it")
    line = next(fields.lines(), -1)
    values = fields.read(records.SPRITE, line) if line >= 0 else None
    if line < 0:
        fields.reader.fault(
            faults.MALFORMED_ASSET, -1, "expected a line with a sprite, but the file has none",
            f"write its material, type, size, modes, light and offset; {fields.reader.effect}",
        )  # fmt: skip
    if values is None:
        return Sprite(source=source, diagnostics=fields.reader.faults.finish())
    material, kind = str(values[0]), ints([str(values[1])])[0][0]
    width, height = map(float, floats([str(values[2]), str(values[3])]))
    fields.refer("mat", material, line)
    if not 0 <= kind <= MOST_SPRITE_TYPE:
        fields.reader.fault(
            faults.MALFORMED_ASSET, line, f"the sprite has type {kind}, but the engine knows 0 to {MOST_SPRITE_TYPE}",
            f"write one of them; {fields.reader.effect}",
        )  # fmt: skip
    if not (width > 0 and height > 0):
        fields.reader.fault(
            faults.MALFORMED_ASSET, line, f"the sprite is {width:g} by {height:g} JKU, but both must be above 0",
            f"write its width and height; {fields.reader.effect}",
        )  # fmt: skip
    fields.reader.at_end("the sprite")
    return Sprite(
        source=source, diagnostics=fields.reader.faults.finish(), references=fields.references,
        material=material, type=kind, size=(width, height),
    )  # fmt: skip


def read_sound_class(source: Source, game: str = "jk") -> SoundClass:
    """Read an SND: a mode and a sound a line (sithSoundClass_LoadEntry)."""
    fields = _Fields(source, game, "the engine passes over the line")
    sounds = []
    for line in fields.lines():
        words = fields.words(line)
        if len(words) < 2:
            fields.reader.fault(
                faults.LOOSELY_READ_ASSET, line, f"expected a mode and a sound, but found {quote(' '.join(words))}",
                "write the sound behind the mode, or none; the engine passes over the line",
            )  # fmt: skip
            continue
        sounds.append((words[0], words[1]))
        fields.refer("wav", words[1], line)
    return SoundClass(
        source=source, diagnostics=fields.reader.faults.finish(), references=fields.references,
        sounds=tuple(sounds),
    )  # fmt: skip


_JOINT = re.compile(r"([-+]?[0-9]+)=([-+]?[0-9]+)")


def read_puppet(source: Source, game: str = "jk") -> Puppet:
    """Read a PUP: `mode=` lines, submodes with their keyframes, and a block of joints (sithAnimClass_LoadPupEntry)."""
    fields = _Fields(source, game, "the engine passes over the line")
    mode, in_joints = 0, False
    keyframes: list[tuple[int, str, str]] = []
    joints: list[tuple[int, int]] = []
    for line in fields.lines():
        words = fields.words(line)
        first = words[0].lower()
        if in_joints:
            joint = _JOINT.fullmatch(first)
            if first == "end":
                in_joints = False
            elif joint is None:
                fields.reader.fault(
                    faults.LOOSELY_READ_ASSET, line, f'expected "body part=node", but found {quote(words[0])}',
                    "write both numbers, as 0=9",
                )  # fmt: skip
            else:
                part, node = ints([joint[1], joint[2]])[0]
                joints.append((part, node))
                if not 0 <= part < MOST_BODY_PARTS:
                    fields.reader.fault(
                        faults.LOOSELY_READ_ASSET, line,
                        f"body part {part} is named, but the engine knows 0 to {MOST_BODY_PARTS - 1}",
                        "remove the line; the engine passes over it",
                    )  # fmt: skip
        elif first == "joints":
            in_joints = True
        elif first.startswith("mode="):
            number = re.match(r"[-+]?[0-9]+", first[5:])
            mode = ints([number.group()])[0][0] if number else 0
        elif len(words) > 1:
            keyframes.append((mode, words[0], words[1]))
            fields.refer("key", words[1], line)
    if in_joints:
        fields.reader.fault(
            faults.LOOSELY_READ_ASSET, len(fields.reader.lines) - 1, 'the joints have no "end"',
            'put a line "end" behind the last one', severity=Severity.INFO,
        )  # fmt: skip
    return Puppet(
        source=source, diagnostics=fields.reader.faults.finish(), references=fields.references,
        keyframes=tuple(keyframes), joints=tuple(joints),
    )  # fmt: skip


def read_ai_class(source: Source, game: str = "jk") -> AIClass:
    """Read an AI: parameters on the first line, then an instinct a line (sithAIClass_LoadEntry)."""
    fields = _Fields(source, game, "the engine refuses the file and takes default.ai")
    parameters: list[tuple[str, str]] = []
    instincts: list[tuple[str, ...]] = []
    for line in fields.lines():
        words = fields.words(line)
        if not parameters:
            parameters = [(key.lower(), value) for key, _, value in (word.partition("=") for word in words)]
            continue
        instincts.append(tuple(words))
        if len(instincts) == MOST_INSTINCTS + 1:
            fields.reader.fault(
                faults.TOO_MANY_INSTINCTS, line,
                f"{words[0]} is instinct {MOST_INSTINCTS + 1} of the list, but the engine keeps {MOST_INSTINCTS}",
                "remove instincts; the engine passes over the rest",
            )  # fmt: skip
    if not parameters:
        fields.reader.fault(
            faults.MALFORMED_ASSET, -1, "expected a line with parameters, but the file has none",
            f"write one, as maxstep=0.5; {fields.reader.effect}",
        )  # fmt: skip
    return AIClass(
        source=source, diagnostics=fields.reader.faults.finish(), parameters=tuple(parameters),
        instincts=tuple(instincts),
    )  # fmt: skip


def read_items(source: Source, game: str = "jk") -> Items:
    """Read an items.dat: an item a line (sithItem and jkPlayer in the decompiled engine)."""
    fields = _Fields(source, game, "the engine passes over the item")
    items: list[Item] = []
    for line in fields.lines():
        if fields.words(line)[0].lower() == "end":
            break
        values = fields.read(records.ITEM, line, Subject("item", len(items)))
        if values is None:
            continue
        name, number, least, most, flags, *more = map(str, values)
        bin_ = ints([number])[0][0]
        low, high = map(float, floats([least, most]))
        cog = next((w.partition("=")[2] for w in more if w.lower().startswith("cog=")), None)
        if not 0 <= bin_ <= MOST_BIN:
            fields.reader.fault(
                faults.ASSET_INDEX_OUT_OF_RANGE, line, f"item {name} has bin {bin_}, but the bins are 0 to {MOST_BIN}",
                "choose a free bin; the engine has no room for it", Subject("item", len(items)),
            )  # fmt: skip
        items.append(Item(name, bin_, low, high, ints([flags], 16)[0][0], cog))
        if cog:
            fields.refer("cog", cog, line)
    return Items(
        source=source, diagnostics=fields.reader.faults.finish(), references=fields.references,
        items=tuple(items),
    )  # fmt: skip


def read_episode(source: Source, game: str = "jk") -> Episode:
    """Read an episode.jk: title, type, and the sequence of levels and cutscenes."""
    fields = _Fields(source, game, "the game does not list the episode")
    reader = fields.reader
    line = reader.next()
    title = "" if line is None else reader.lines.text(line).strip().strip('"')
    kind = reader.value(records.EPISODE_TYPE)
    heading = reader.at
    count = reader.value(records.EPISODE_COUNT)
    steps: list[EpisodeStep] = []
    for at in reader.labelled():
        values = reader.record(records.EPISODE_LINE, at, Subject("step", len(steps)))
        if values is None:
            continue
        label, _, _, what, file, _, _, following, dark = map(str, values[:9])
        number, after, after_dark = ints([label.rstrip(":"), following, dark])[0]
        steps.append(EpisodeStep(number, what.lower(), file, after, after_dark, reader.lines.span(at)))
        fields.refer("jkl" if what.lower().startswith("l") else "smk", file, at)
    if count is not None:
        reader.counted(heading, "steps", ints([str(count[0])])[0][0], len(steps))
    _check_steps(reader, steps)
    if not reader.done and reader.text().strip().lower() == "end":
        reader.at += 1
    return Episode(
        source=source, diagnostics=reader.faults.finish(), references=fields.references, title=title,
        type=ints([str(kind[0])])[0][0] if kind else -1, steps=tuple(steps),
    )  # fmt: skip


def _check_steps(reader: LineReader, steps: Sequence[EpisodeStep]) -> None:
    known = {step.line for step in steps}
    for index, step in enumerate(steps):
        for following in sorted({step.next, step.next_dark} - known - {-1}):
            reader.faults.tell(
                faults.ASSET_INDEX_OUT_OF_RANGE, step.place,
                f"step {step.line} leads to line {following}, but there is none",
                "name a line of the sequence, or -1 for its end", Subject("step", index),
            )  # fmt: skip
