"""JK552: a handler that runs on into the next one."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import ScriptFacts
from jktools.facts.cog.loops import ways
from jktools.linter.rule import Finding, rule
from jktools.syntax.cog import Script


@rule("JK552", "falls-into-handler", severity=Severity.WARNING, since="0.1.0", looks_at=Script)
def falls_into_handler(script: Script, facts: ScriptFacts) -> Iterator[Finding]:
    """Report code that runs on into the handler of another message.

    ## Why it matters
    A label does not end what stands above it. Without `return` a handler goes on with the next handler's code, as if
    that message had come too. Labels directly on top of each other are not reported: they share one handler. Nor is a
    handler that seems to be wanted: one of `user0` to `user7`, which only scripts send, or one of a pulse or timer that
    the code above has just set, so that the same is done now and later. What stands behind a loop that never ends is
    not come to.

    ## Bad
        symbols
        message startup
        message activate
        end
        code
        startup:
            Print("start");
        activate:
            Print("active");
            return;
        end

    ## Good
        symbols
        message startup
        message activate
        end
        code
        startup:
            Print("start");
            return;
        activate:
            Print("active");
            return;
        end
    """
    for label, ends in facts.reach.falls:
        name = label.label.name
        above = [end for end in ends if _goes_on(facts, end, facts.analysis.flow.label_block[name])]
        if not above:
            continue
        source = facts.reach.label_of[above[-1]]
        handler = facts.program.handler_of.get(name)
        wanted = handler is not None and (
            handler.message.name.startswith("user") or name in facts.rates.arms.get(source, ())
        )
        if handler is not None and name != source and not wanted:
            yield Finding(
                facts.label(label.label),
                f'the code below "{source}" runs on into "{name}", which is a handler of its own',
                'end the code above with "return;"',
            )


def _goes_on(facts: ScriptFacts, end: int, below: int) -> bool:
    """Whether the block at the end of some code leads to the one below it, as far as its condition tells."""
    flow, known = facts.analysis.flow, facts.known
    if end in known.visited:
        return below in ways(flow.blocks[end], known)
    return flow.label_block[facts.reach.label_of[end]] not in known.visited  # else what is above never comes here
