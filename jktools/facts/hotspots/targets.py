"""Which things and which scripts a call means: what the expressions that it is given can stand for."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

from jktools.facts.cog.rates import PULSE, TIMER, Site
from jktools.facts.cog.stack import written
from jktools.facts.hotspots.inputs import OWN_CLOCKS, Node, handler_of
from jktools.facts.hotspots.runners import Runner
from jktools.facts.hotspots.traces import Leaf, leaves
from jktools.facts.reachability import OF_STATIC
from jktools.syntax.cog.nodes import Call, Expression

CREATES = frozenset(
    {
        "creatething", "createthingnr", "createthingatpos", "createthingatposnr", "createthingatposold",
        "createthingatposowner", "createthinglocal", "createbackpack", "fireprojectile", "fireprojectiledata",
        "fireprojectilelocal",
    }
)  # fmt: skip
"""What they answer with is a thing that the level does not place."""
PLAYER_VERBS = frozenset({"getlocalplayerthing", "jkgetlocalplayer"})
SENDER_VERBS = frozenset({"getsenderref"})
NOT_BY_THINGS = frozenset(
    {"startup", "loading", "shutdown", "newplayer", "join", "leave", "trigger", *(f"user{i}" for i in range(8))}
)
"""Messages whose sender is no thing, or need not be one."""


class Targets:
    """Of all scripts of one level."""

    def __init__(self, runners: Sequence[Runner]) -> None:
        """Learn the numbers of the scripts and the things that carry them."""
        self._numbered = {r.number: r for r in runners if r.number >= 0}
        self._class_of = {t.number: r for r in runners if r.cog is None and not r.of for t in r.things}
        self._first_free = 1 + max((n for n in self._numbered if n < OF_STATIC), default=-1)
        things = {t.number: t for r in runners for t in r.things}
        captured = {number for r in runners for number in r.links}
        # Of what a class COG captures, only the number is known here: it may be the player.
        self._players = {n for n in captured | things.keys() if n not in things or things[n].resolved.type == "player"}

    def reaches_things_to_come(self, runner: Runner, site: Site) -> bool:
        """Whether a call can mean a thing that sent a message, and that play created."""
        given = written(runner.analysis.program, site.call)[0]
        verbs = (runner.analysis.program.verb_of(each) for each in _calls(runner, given))
        return runner.more and any(verb is not None and verb.name in SENDER_VERBS for verb in verbs)

    def things(self, sender: Node, site: Site) -> tuple[set[int], bool]:
        """The numbers of the placed things that a call means, and whether those are all."""
        number = site.arguments[0].number
        if number is not None:
            return {int(number)}, True
        runner = sender.runner
        given = written(runner.analysis.program, site.call)[0]
        numbers: set[int] = set()
        known = True
        for leaf in [None] if given is None else leaves(runner.analysis, given, starts=True):
            verb = runner.analysis.program.verb_of(leaf) if isinstance(leaf, Call) else None
            if isinstance(leaf, int):
                numbers.add(leaf)
            elif verb is not None and verb.name in PLAYER_VERBS:
                numbers |= self._players
            elif verb is not None and verb.name in SENDER_VERBS:
                numbers |= {thing.number for thing in runner.things}
                known &= self._is_sent_by_thing(sender)
            elif verb is None or verb.name not in CREATES:
                known = False
        return numbers, known

    def _is_sent_by_thing(self, node: Node) -> bool:
        """Whether the sender of every message of a handler is a thing that carries the script."""
        message = handler_of(node).message
        if node.runner.cog is not None or node.runner.of or message.name in NOT_BY_THINGS:
            return False
        own = {site.verb.name for site in node.runner.analysis.rates.sites} & OWN_CLOCKS.keys()
        return message.id not in (PULSE, TIMER) or not own

    def cogs(self, runner: Runner, site: Site, argument: int = 0) -> tuple[set[Runner], bool]:
        """The scripts that an argument of a call names, and whether those are all."""
        number = site.arguments[argument].number
        if number is not None:
            target = self._of_number(int(number))
            return target or set(), target is not None
        given = written(runner.analysis.program, site.call)[argument]
        found: set[Runner] = set()
        known = True
        for leaf in [None] if given is None else leaves(runner.analysis, given, starts=True):
            targets = self._of_leaf(runner, leaf)
            known &= targets is not None
            found |= targets or set()
        return found, known

    def _of_leaf(self, runner: Runner, leaf: Leaf) -> set[Runner] | None:
        """The scripts that a value names; None where that is not known."""
        if isinstance(leaf, int):
            return self._of_number(leaf)
        verb = runner.analysis.program.verb_of(leaf) if leaf is not None else None
        if verb is None or leaf is None:
            return None
        if verb.name == "getselfcog":
            return {runner}
        if verb.name == "getthingclasscog":
            given = runner.analysis.known.arguments.get(leaf)
            number = None if given is None else given[0].number
            carried = None if number is None else self._class_of.get(int(number))
            return {carried} if carried is not None else None
        return None

    def _of_number(self, number: int) -> set[Runner] | None:
        """The script of a number; None where it can be a class COG: what numbers those get is not known."""
        if number in self._numbered:
            return {self._numbered[number]}
        return None if self._first_free <= number < OF_STATIC else set()


def _calls(runner: Runner, given: Expression | None) -> Iterator[Call]:
    for leaf in () if given is None else leaves(runner.analysis, given):
        if isinstance(leaf, Call):
            yield leaf
