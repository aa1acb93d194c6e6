"""The configuration file: `jktools.toml`, or `[tool.jktools]` in `pyproject.toml`, found upward from the path.

game = "jk"
base = ["C:/JediKnight"]

[lint]
select = ["JK2", "JK301"]
ignore = ["JK304"]
fail-on = "error"

[severity]
JK301 = "error"

[rules.JK301]
distance = 0.002

[cog.verbs]
jacklogvel = { args = ["thing"], returns = "void" }

[[ignore]]
code = "JK301"
path = "*/lagoon.jkl"
object = "sector 12"
reason = "the box is meant to be open to the north"
"""

from __future__ import annotations

import os
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path
from types import MappingProxyType
from typing import Any, Literal

import msgspec

from jktools.diagnostics import Severity
from jktools.linter import Options, UnknownRuleError, find_rule
from jktools.model.cog.verbs import Kind, Result, Verb, verb_from
from jktools.session.settings import Game, Ignore, Settings
from jktools.source import InputError, Source
from jktools.source.container import describe, describe_bytes
from jktools.source.path import on_disk

FILE_NAME = "jktools.toml"
PROJECT_FILE = "pyproject.toml"

FailOn = Literal["error", "warning", "info", "never"]


class ConfigError(InputError):
    """A configuration that cannot be used; the message names the file and the key."""


class _Lint(msgspec.Struct, frozen=True, forbid_unknown_fields=True, rename="kebab"):
    select: list[str] = []
    ignore: list[str] = []
    fail_on: FailOn = "warning"
    baseline: str = ""


class _Ignore(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    code: str
    path: str = "*"
    object: str = ""
    reason: str = ""


class _Verb(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    args: tuple[Kind, ...] = ()
    returns: Result = "void"
    sleeps: bool = False


class _Cog(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    verbs: dict[str, dict[str, Any]] = {}


class _File(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    game: Game | None = None
    base: list[str] = []
    lint: _Lint = _Lint()
    severity: dict[str, Literal["error", "warning", "info"]] = {}
    rules: dict[str, dict[str, Any]] = {}
    ignore: list[_Ignore] = []
    cog: _Cog = _Cog()


@dataclass(frozen=True, slots=True)
class Config:
    """What a configuration file says."""

    settings: Settings = field(default_factory=Settings)
    fail_on: FailOn = "warning"
    path: Path | None = None
    baseline: Path | None = None
    """Findings that are known already."""


def find_config(typed: str) -> Path | None:
    """The nearest configuration at or above what a user typed; `pack.gob!member` counts as the pack."""
    path = on_disk(typed).absolute()
    for folder in (path, *path.parents):
        own = folder / FILE_NAME
        if own.is_file():
            return own
        project = folder / PROJECT_FILE
        if project.is_file() and _has_section(project):
            return project
    return None


def _has_section(project: Path) -> bool:
    try:
        return re.search(rb"^\s*\[+tool\.jktools\b", project.read_bytes(), re.MULTILINE) is not None
    except OSError:
        return False


def load_config(path: Path) -> Config:
    """Read a configuration. Raises ConfigError, which names the file and the key."""
    try:
        data = path.read_bytes()
        parsed = tomllib.loads(data.decode())
    except OSError as error:
        raise ConfigError(f"cannot read {path}: {describe(error)}") from error
    except UnicodeDecodeError as error:
        raise ConfigError(f"cannot read {path}: {describe_bytes(error)}") from error
    except tomllib.TOMLDecodeError as error:
        raise ConfigError(f"cannot read {path}: {error}") from error
    if path.name == PROJECT_FILE:
        parsed = parsed.get("tool", {}).get("jktools", {})
    try:
        file = msgspec.convert(parsed, _File)
        baseline = path.parent / file.lint.baseline if file.lint.baseline else None
        return Config(_settings(file, Source(str(path), data)), file.lint.fail_on, path, baseline)
    except (msgspec.ValidationError, UnknownRuleError) as error:
        raise ConfigError(f"cannot use {path}: {error}") from error


def _settings(file: _File, source: Source) -> Settings:
    return Settings(
        game=file.game,
        base=tuple(os.path.join(Path(source.path).parent, path) for path in file.base),  # noqa: PTH118 (keeps a!b)
        select=tuple(file.lint.select),
        ignore=tuple(file.lint.ignore),
        severity=MappingProxyType({find_rule(c).code.id: Severity[s.upper()] for c, s in file.severity.items()}),
        options=MappingProxyType(dict(_options(code, values) for code, values in file.rules.items())),
        ignores=tuple(_ignores(file, source)),
        verbs=MappingProxyType(dict(_verb(name, entry) for name, entry in file.cog.verbs.items())),
    )


def _options(code: str, values: dict[str, Any]) -> tuple[str, Options]:
    rule = find_rule(code)
    if rule.options is None:
        raise msgspec.ValidationError(f"rule {rule.code} has no options - at `$.rules.{code}`")
    try:
        return rule.code.id, msgspec.convert(values, rule.options)
    except msgspec.ValidationError as error:
        raise msgspec.ValidationError(f"{error} of rules.{code}") from error


def _verb(name: str, values: dict[str, Any]) -> tuple[str, Verb]:
    try:
        entry = msgspec.convert(values, _Verb)
    except msgspec.ValidationError as error:
        raise msgspec.ValidationError(f"{error} of cog.verbs.{name}") from error
    if re.fullmatch(r"[A-Za-z_][A-Za-z0-9_]*", name) is None:
        raise msgspec.ValidationError(f'"{name}" cannot be called by a script: a verb is letters, digits and "_"')
    return name.lower(), verb_from(name, entry.args, entry.returns, sleeps=entry.sleeps)


def _ignores(file: _File, source: Source) -> list[Ignore]:
    """The entries in the order of the file, each with its place."""
    places = [
        source.span(m.start(), m.end())
        for m in re.finditer(r"^[ \t]*\[\[[ \t]*(tool\.jktools\.)?ignore[ \t]*\]\]", source.text, re.MULTILINE)
    ]
    spans = places if len(places) == len(file.ignore) else [source.span(0, 0)] * len(file.ignore)
    return [
        Ignore(find_rule(entry.code).code.id, entry.path, entry.object, entry.reason, span)
        for entry, span in zip(file.ignore, spans, strict=True)
    ]
