"""The COG front end: from a script's text to a tree with spans."""

from jktools.syntax.cog.script import Script, read_script

__all__ = ["Script", "read_script"]
