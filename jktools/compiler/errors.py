"""What can go wrong when compiling, and when opening what was compiled."""

from jktools.source import InputError


class CompileError(Exception):
    """A level that cannot be compiled; the message is one sentence with the place and the cure."""


class PassError(Exception):
    """A pass that failed, which is a bug in jktools; one sentence names the pass, the level and the object."""


class CompiledFileError(InputError):
    """A file that is no compiled level, is damaged, or comes from a newer version; one sentence says which."""
