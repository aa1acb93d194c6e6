"""What a level is compiled for."""

from __future__ import annotations

from dataclasses import dataclass

from jktools.geometry import Accuracy


@dataclass(frozen=True, slots=True)
class CompileSettings:
    """Choices of one compilation. Engine and accuracy are recorded in the file, and so is why a pass did not run."""

    engine: str = "research"
    accuracy: Accuracy = "balanced"
    only: frozenset[str] = frozenset()
    """Passes to run, with those that they need; none means all."""
    skip: frozenset[str] = frozenset()
    """Passes not to run."""
    keep_going: bool = False
    """When a pass fails, leave out its section and compile the rest."""
    cut_anyway: bool = False
    """Leave out templates that nothing is known to reach, though not all COGs are at hand to tell."""
    plain: bool = False
    """Write every column as its plain vector, every text as it is and every template with all its values: larger, for
    readers that take nothing but arrays."""
