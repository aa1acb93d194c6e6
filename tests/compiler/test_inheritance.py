"""Templates rest on their parents in the file, and read as what the engine holds."""

from __future__ import annotations

import numpy as np
import pytest

from jktools.compiler import CompiledFileError, CompiledLevel, compile_level
from jktools.compiler.checksum import seal
from jktools.compiler.inheritance import NO_BASE, Value, bases, inherited, own_columns
from jktools.model import Level
from tests.support.levels import level_of, two_rooms

TEMPLATES = """World templates 12
base none type=actor move=physics size=.1 thingflags=0x400 health=40
guard base health=60
captain guard light=.5
crateguard guard type=weapon
orphan lost health=7
late none type=cog size=.3
heir late size=.5"""


def rooms() -> Level:
    return level_of(two_rooms(*TEMPLATES.splitlines()))


def held(level: CompiledLevel) -> list[dict[str, tuple[str | None, int, tuple[float, ...]]]]:
    """Of each template, its values by the parameter: name, who set it, numbers."""
    t = level.templates
    assert t is not None
    found = []
    for i in range(len(t.source)):
        rows = range(t.value_start[i], t.value_start[i + 1])
        found.append({
            level.strings[t.value_key[k]]: (
                None if t.value_text[k] < 0 else level.strings[t.value_text[k]],
                int(t.value_source[k]),
                tuple(t.number[t.number_start[k] : t.number_start[k + 1]].tolist()),
            )
            for k in rows
        })  # fmt: skip
    return found


def test_every_value_is_what_the_model_resolves() -> None:
    level = rooms()
    found = held(CompiledLevel(compile_level(level)))
    assert len(found) == len(level.resolved_templates) > 6
    for mine, resolved in zip(found, level.resolved_templates, strict=True):
        assert mine.keys() == resolved.values.keys()
        for key, setting in resolved.values.items():
            name, setter, numbers = mine[key]
            assert setter == setting.origins[0].owner.index, key
            if isinstance(setting.value, str):
                assert name == setting.value, key
            elif isinstance(setting.value, (int, float)):
                assert numbers == (setting.value,), key


def test_only_what_differs_from_the_base_is_written() -> None:
    compiled = CompiledLevel(compile_level(rooms()))
    t = compiled.templates
    assert t is not None
    names = [compiled.strings[i] for i in t.name]
    own = {
        name: {compiled.strings[k] for k in t.own_key[t.own_start[i] : t.own_start[i + 1]]}
        for i, name in reversed(list(enumerate(names)))
    }
    rests = {name: names[b] if b >= 0 else None for name, b in zip(names, t.base.tolist(), strict=True)}
    assert (own["guard"], rests["guard"]) == ({"health", "maxhealth"}, "base")
    assert (own["captain"], rests["captain"]) == ({"light", "thingflags"}, "guard"), "light switches a flag on"
    assert rests["crateguard"] is None, "as a weapon it has no health: it lacks what its parent has"
    assert rests["orphan"] is None
    captain = names.index("captain")
    rows = slice(t.own_start[captain], t.own_start[captain + 1])
    setters = {compiled.strings[k]: n for k, n in zip(t.own_key[rows], t.own_setter[rows].tolist(), strict=True)}
    assert setters == {"light": 0, "thingflags": 1 + names.index("base")}, "the flags are those of base, and one more"


def test_values_come_back_whatever_they_rest_on() -> None:
    rng = np.random.default_rng(5)

    def value() -> Value:
        return Value(*(int(rng.integers(low, high)) for low, high in ((-1, 3), (-1, 20), (0, 3))))

    values = [{key: value() for key in rng.permutation(6)[: rng.integers(7)].tolist()} for _ in range(60)]
    parents = [int(rng.integers(-1, 60)) for _ in values]
    rest = bases(values, parents)
    assert any(each != NO_BASE for each in rest)
    source = list(range(0, 120, 2))

    class Table:
        def __getattr__(self, name: str) -> np.ndarray[tuple[int], np.dtype[np.int64]]:
            return np.array(source) if name == "source" else columns[name]

    columns = own_columns(values, source, rest)
    found = inherited(Table())
    for i, mine in enumerate(values):
        part = slice(found["value_start"][i], found["value_start"][i + 1])
        keys, *told = (found[f"value_{name}"][part].tolist() for name in ("key", "text", "source", "list"))
        assert dict(zip(keys, (Value(*each) for each in zip(*told, strict=True)), strict=True)) == mine


def test_a_base_that_does_not_come_before_is_refused() -> None:
    data = bytearray(compile_level(rooms()))
    whole = CompiledLevel(bytes(data))
    assert whole.templates is not None
    stored = whole.templates.stored["base"]
    assert stored.values is not None
    place = stored.values.__array_interface__["data"][0] - np.frombuffer(whole.data, np.uint8).ctypes.data
    row = stored.values.tolist().index(3)
    data[place + row] = row if stored.index is None else 200
    with pytest.raises(CompiledFileError) as refused:
        CompiledLevel(seal(data), "x.jklb")
    assert "which does not come before it" in str(refused.value.__cause__)
