"""JK750: a colour effect under which nothing can be seen."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence

from jktools.diagnostics import Severity
from jktools.facts import LevelFacts
from jktools.facts.colour_effects import VIEWS, View, constant_effects, hidden, palettes
from jktools.linter.hotspots import place_of, subject_of
from jktools.linter.rule import Finding, rule
from jktools.model import Level


@rule("JK750", "colour-effect-hides-all", severity=Severity.INFO, since="0.1.0")
def colour_effect_hides_all(level: Level, facts: LevelFacts) -> Iterator[Finding]:
    """Report a colour effect that makes every colour of the level's colormaps the same, as black or white.

    ## Why it matters
    The player sees nothing until the effect is freed. Colours count as the same within one step of the game's screen,
    8 of 255. By the research document an `add` of 274 and more on all channels, or below 0, is a white screen, a
    brightness up to 0.03 a black one, and a filter for channels that the colormap does not have leaves black. The
    decompiled engine adds by another rule: there 247 is white, and a negative `add` does nothing, or in its software
    renderer subtracts. Where they differ the finding says so. Where it is meant, as for a cut, hide this finding with a
    comment. Without the colormap all levels of all channels are tried. Arguments outside their ranges are JK605.

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
            effect = NewColorEffect(0, 0, 0, 0, 0, 0, 274, 274, 274, 1.0);
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
    known = palettes(level)
    for each in constant_effects(facts.runners):
        verdicts = hidden(each.effect, known)
        if any(verdicts.values()):
            yield Finding(
                place_of(each.runner),
                f"{each.runner.title} makes a colour effect to see by, but it {_tell(verdicts)}",
                "lower its add, raise its brightness, or let a filter pass a channel that the level has",
                subject_of(each.runner),
                (each.runner.script.label(each.site.call, "the effect"),),
            )


def _tell(verdicts: Mapping[View, str | None]) -> str:
    """What becomes of all that is seen, and who says so where they do not agree."""
    if len(set(verdicts.values())) == 1:
        return f"turns all that is seen {next(iter(verdicts.values()))}"
    told: dict[str | None, list[str]] = {}
    for view, colour in verdicts.items():
        told.setdefault(colour, []).append(view.title)
    hides = [f"{colour} by {_names(titles)}" for colour, titles in told.items() if colour is not None]
    rest = [f"not by {_names(titles)}" for colour, titles in told.items() if colour is None]
    return f"turns all that is seen {', '.join([*hides, *rest])}"


def _names(titles: Sequence[str]) -> str:
    """The titles of views; that of both ways to draw of the decompiled engine is its own."""
    hardware, software = VIEWS[1].title, VIEWS[2].title
    if hardware in titles and software in titles:
        titles = [title for title in titles if title not in (hardware, software)] + ["the decompiled engine"]
    return " and ".join(titles)
