"""From a level to one binary file, and back to arrays that are views of it."""

from jktools.compiler.errors import CompiledFileError, CompileError, PassError
from jktools.compiler.passes import CHOICES
from jktools.compiler.reader import CompiledLevel, open_compiled
from jktools.compiler.settings import CompileSettings
from jktools.compiler.walking import Basin, Leave, Ledge, ThingFace
from jktools.compiler.writer import Compilation, compilation, compile_level

__all__ = [
    "CHOICES",
    "Basin",
    "Compilation",
    "CompileError",
    "CompileSettings",
    "CompiledFileError",
    "CompiledLevel",
    "Leave",
    "Ledge",
    "PassError",
    "ThingFace",
    "compilation",
    "compile_level",
    "open_compiled",
]
