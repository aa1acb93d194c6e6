"""The facts of one script."""

from __future__ import annotations

from collections.abc import Sequence
from functools import cached_property

from jktools.diagnostics import Label
from jktools.facts.cog.analysis import Analysis
from jktools.facts.cog.dataflow import Known
from jktools.facts.cog.rates import Rates
from jktools.facts.cog.reach import Reach
from jktools.model.cog.program import Program, Vocabulary
from jktools.model.resources import Library
from jktools.source import Member, Span
from jktools.syntax.cog import Script, read_script
from jktools.syntax.cog.nodes import Node, Unreadable

WEIGHT = 30
"""Bytes that a script and all that is known of it take, for each byte of its text; measured on real scripts."""


class ScriptFacts:
    """Facts are pulled: nothing is computed that no rule asks for, and nothing twice.

    They hold for every value that a level can give the script; `jktools.facts.cog.instance` knows one placed script.
    """

    def __init__(self, script: Script, vocabulary: Vocabulary | None = None) -> None:
        """Know nothing yet; `vocabulary` has the user's own verbs, else it is that of the script's game."""
        self.script = script
        self.vocabulary = vocabulary or Vocabulary(script.game)

    @cached_property
    def program(self) -> Program:
        """The script with its names bound."""
        return Program(self.script.header, self.script.code, self.vocabulary)

    @cached_property
    def analysis(self) -> Analysis:
        """Its flow, for any values that a level gives it."""
        return Analysis(self.program)

    @property
    def reach(self) -> Reach:
        """Which code can run at all."""
        return self.analysis.reach

    @property
    def known(self) -> Known:
        """What variables, arguments and conditions can be."""
        return self.analysis.known

    @property
    def rates(self) -> Rates:
        """What sends each handler its message, and how often."""
        return self.analysis.rates

    @cached_property
    def is_whole(self) -> bool:
        """Whether all of the code could be read, so that what is not there is missing."""
        read = self.script.code.body or not self.script.rejected
        return bool(read) and not self.program.of_kind(Unreadable)

    def is_doubtful(self, start: int, end: int) -> bool:
        """Whether the engine stops, or drops a quote, in a range of bytes or next to it.

        What stands there was read by guess, and the fault says more than whatever else can be said of it.
        """
        return any(first <= end and start <= last for first, last in self._doubts)

    @cached_property
    def _doubts(self) -> Sequence[tuple[int, int]]:
        spans = [fault.label.span for fault in self.script.faults]
        found = [(span.start, span.end) for span in spans if span is not None]
        return [*found, *((stray.start, stray.end) for stray in self.script.strays if stray.text in "\"'")]

    def span(self, node: Node) -> Span:
        """Where a node stands."""
        return self.script.source.span(node.start, node.end)

    def label(self, node: Node, text: str = "") -> Label:
        """A label at a node."""
        return Label(self.span(node), text)


def script_facts(library: Library, member: Member, vocabulary: Vocabulary) -> ScriptFacts:
    """The facts of a script, read and worked out once a run, however many levels place it and whoever asks.

    Raises InputError when the file cannot be opened.
    """
    what = f"script of {vocabulary.game}"
    kept = library.recall(member.path, what)
    if isinstance(kept, ScriptFacts) and kept.vocabulary == vocabulary:
        return kept
    source = library.source(member)
    facts = ScriptFacts(read_script(source, vocabulary.game), vocabulary)
    library.keep(member.path, what, WEIGHT * len(source.data), facts)
    return facts
