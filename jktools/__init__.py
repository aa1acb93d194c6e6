"""Level compiler and static analyser for Star Wars Jedi Knight: Dark Forces II and Mysteries of the Sith.

level = jktools.load("masspack.gob!jkl/lagoon.jkl")
for finding in jktools.lint(level):
    print(finding.code, finding.message)
data = jktools.build(level)
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

__version__ = "0.1.0"

if TYPE_CHECKING:
    from jktools.compiler import CompiledLevel as CompiledLevel
    from jktools.compiler import CompileError as CompileError
    from jktools.compiler import open_compiled as open_compiled
    from jktools.diagnostics import Diagnostic as Diagnostic
    from jktools.diagnostics import Severity as Severity
    from jktools.facts.fall import drop as drop
    from jktools.facts.sights import sight as sight
    from jktools.facts.sights import sights as sights
    from jktools.geometry import SectorMesh as SectorMesh
    from jktools.model import Level as Level
    from jktools.session import Settings as Settings
    from jktools.session import build as build
    from jktools.session import check as check
    from jktools.session import lint as lint
    from jktools.session import load as load
    from jktools.session import load_script as load_script
    from jktools.session import mesh as mesh
    from jktools.source import InputError as InputError
    from jktools.syntax.cog import Script as Script

_PUBLIC = {
    "CompileError": ("jktools.compiler", "CompileError"),
    "CompiledLevel": ("jktools.compiler", "CompiledLevel"),
    "Diagnostic": ("jktools.diagnostics", "Diagnostic"),
    "InputError": ("jktools.source", "InputError"),
    "Level": ("jktools.model", "Level"),
    "Settings": ("jktools.session", "Settings"),
    "Severity": ("jktools.diagnostics", "Severity"),
    "build": ("jktools.session", "build"),
    "drop": ("jktools.facts.fall", "drop"),
    "check": ("jktools.session", "check"),
    "lint": ("jktools.session", "lint"),
    "load": ("jktools.session", "load"),
    "load_script": ("jktools.session", "load_script"),
    "mesh": ("jktools.session", "mesh"),
    "sight": ("jktools.facts.sights", "sight"),
    "sights": ("jktools.facts.sights", "sights"),
    "Script": ("jktools.syntax.cog", "Script"),
    "SectorMesh": ("jktools.geometry", "SectorMesh"),
    "open_compiled": ("jktools.compiler", "open_compiled"),
}

__all__ = ["__version__", *_PUBLIC]


def __getattr__(name: str) -> Any:
    """Import a part when it is first asked for: `jktools --version` must not load numpy."""
    if name not in _PUBLIC:
        raise AttributeError(f"module 'jktools' has no attribute '{name}'")
    import importlib  # noqa: PLC0415 (as above)

    module, attribute = _PUBLIC[name]
    value = getattr(importlib.import_module(module), attribute)
    globals()[name] = value
    return value


def __dir__() -> list[str]:
    return sorted(__all__)
