"""JK750: a colour effect under which nothing can be seen."""

from __future__ import annotations

from collections.abc import Iterator

from jktools.diagnostics import Severity
from jktools.facts import LevelFacts
from jktools.facts.colour_effects import constant_effects, palettes, shown
from jktools.linter.hotspots import place_of, subject_of
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK750", "colour-effect-hides-all", severity=Severity.INFO, since="0.1.0")
def colour_effect_hides_all(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a colour effect that makes every colour of the level's colormaps the same, as black or white.

    ## Why it matters
    The player sees nothing until the effect is freed: an `add` of 290 and more, or below 0, is a white screen, a
    brightness of 0 a black one, and a filter for channels that the colormap does not have leaves black. Where that is
    meant, as for a cut, hide this finding with a comment. Without the colormap all levels of all channels are tried.
    Arguments outside their ranges are JK605.

    ## Bad
        World cogs 1
        0: fx.cog
        == cog/fx.cog
        symbols
        message activated
        int effect local
        end
        code
        activated:
            effect = NewColorEffect(0, 0, 0, 0, 0, 0, 290, 290, 290, 1.0);
            Sleep(1.0);
            FreeColorEffect(effect);
            return;
        end

    ## Good
        World cogs 1
        0: fx.cog
        == cog/fx.cog
        symbols
        message activated
        int effect local
        end
        code
        activated:
            effect = NewColorEffect(0, 0, 0, 0, 0, 0, 145, 145, 145, 1.0);
            Sleep(1.0);
            FreeColorEffect(effect);
            return;
        end
    """
    for each in constant_effects(facts.runners):
        views = shown(each.effect, palettes(level))
        if not all(view.is_one_colour for view in views):
            continue
        colour = "black" if views[0].is_black else "white" if views[0].is_white else "one colour"
        yield Finding(
            place_of(each.runner),
            f"{each.runner.title} makes a colour effect to see by, but it turns all that is seen {colour}",
            "lower its add, raise its brightness, or let a filter pass a channel that the level has",
            subject_of(each.runner),
            (each.runner.script.label(each.site.call, "the effect"),),
        )
