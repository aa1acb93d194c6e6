"""JK140: a file that names another which is not there."""

from collections.abc import Iterator

from jktools.diagnostics import Label, Severity
from jktools.facts import AssetFacts
from jktools.linter.rule import Finding, rule
from jktools.model.resources import Kind
from jktools.syntax.assets.asset import Asset


@rule("JK140", "asset-names-missing-file", severity=Severity.WARNING, since="0.1.0", looks_at=Asset)
def asset_names_missing_file(asset: Asset, facts: AssetFacts) -> Iterator[Finding]:
    """Report a file that a model, sprite, puppet, sound class, cloud, items.dat or episode names and nobody has.

    ## Why it matters
    A model without one of its materials shows dflt.mat, and is rejected where that is missing too; a mode without its
    sound is silent, a submode without its keyframe does not move, a level that an episode names does not load. Without
    a base (`--base`) nothing is reported, since the file may be the game's.
    """
    if not facts.resources.has_base:
        return
    told = set()
    for reference in asset.references:
        kind = Kind.of_extension(reference.extension)
        key = (kind, reference.name.lower())
        if kind is None or key in told or facts.resources.find(kind, reference.name) is not None:
            continue
        told.add(key)
        yield Finding(
            Label(reference.place),
            f'{kind.title} "{reference.name}" is named, but neither the mod nor a base has it',
            f"put it into {' or '.join(kind.folders)}, or mend the name",
        )
