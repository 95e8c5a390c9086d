"""Dimensions for a path, a function or given positions."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from mbs._asked import Array, Value, numbers, text
from mbs.progress import Progress, told

if TYPE_CHECKING:
    from mbs._native import AskedTask, Synthesized
    from mbs.mechanism import Mechanism


class Linkage(NamedTuple):
    """A mechanism that was found."""

    parameters: dict[str, float]
    """What was looked for, as ``simulate`` takes it."""
    missed: float
    """The largest difference from a value that was asked for, in SI units."""
    path: dict[str, Array]
    """The coordinates on the way from the first position to the last, in m and rad."""


class Synthesis:
    """Mechanisms that pass the positions without defects: those that miss least first."""

    def __init__(self, found: Synthesized) -> None:
        self.linkages: list[Linkage] = [Linkage(**linkage) for linkage in found["linkages"]]
        self.refused: Mapping[str, int] = dict(found["refused"])
        """How often a mechanism was refused for a defect of circuit, order or branch."""
        self.starts: int = found["starts"]
        """From so many starts it was looked."""
        self.nearest: float = found["nearest"]
        """By how much the positions are missed at least, defects or not, in SI units."""

    def __bool__(self) -> bool:
        return bool(self.linkages)

    def __repr__(self) -> str:
        return f"<Synthesis: {len(self.linkages)} found from {self.starts} starts, nearest {self.nearest:.1e}>"


def synthesize(
    mechanism: Mechanism,
    through: Mapping[str, Any],
    between: Mapping[str, tuple[Value, Value]],
    drive: str | None,
    tolerance: float | None,
    starts: int | None,
    enough: int | None,
    seed: int | None,
    progress: Progress,
    values: Mapping[str, Any],
) -> Synthesis:
    """As ``Mechanism.synthesize``."""
    task: AskedTask = {
        "positions": [(str(name), numbers(through[name])) for name in through],
        "unknown": [(name, text(low), text(high)) for name, (low, high) in between.items()],
        "drive": drive,
        "tolerance": tolerance,
        "starts": starts,
        "enough": enough,
        "seed": seed,
    }
    with told(progress, mechanism.name, " starts") as tell:
        return Synthesis(mechanism._native.synthesize(mechanism._asked(values), task, tell))
