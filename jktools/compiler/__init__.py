"""From a level to one binary file, and back to arrays that are views of it."""

from jktools.compiler.errors import CompiledFileError, CompileError
from jktools.compiler.reader import CompiledLevel, open_compiled
from jktools.compiler.writer import CompileSettings, compile_level

__all__ = [
    "CompileError",
    "CompileSettings",
    "CompiledFileError",
    "CompiledLevel",
    "compile_level",
    "open_compiled",
]
