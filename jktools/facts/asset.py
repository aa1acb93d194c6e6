"""What can be known about one asset file."""

from __future__ import annotations

from jktools.model.resources import Resources
from jktools.syntax.assets.asset import Asset


class AssetFacts:
    """An asset and the files around it."""

    def __init__(self, asset: Asset, resources: Resources | None = None) -> None:
        """Take the file and where the files that it names are looked for; without that none is found."""
        self.asset = asset
        self.resources = resources or Resources()
