"""Where a mechanism is at rest."""

from __future__ import annotations

from collections.abc import Mapping
from typing import TYPE_CHECKING

import numpy as np

from mbs._asked import Array

if TYPE_CHECKING:
    from mbs._native import AtRest


class Equilibrium:
    """A position at which nothing moves."""

    def __init__(self, mechanism: str, found: AtRest) -> None:
        self.mechanism: str = mechanism
        """The name of the mechanism."""
        self.t: float = found["t"]
        """The time in s at which drives are held."""
        self.coordinates: Mapping[str, float] = {name: value for name, value, _ in found["coordinates"]}
        """The coordinates."""
        self.states: Mapping[str, float] = {name: value for name, value, _ in found["states"]}
        """The states of the declaration's own."""
        self.outputs: Mapping[str, float] = {name: value for name, value, _ in found["outputs"]}
        """What is measured there."""
        self.multipliers: Mapping[str, float] = {name: value for name, value, _ in found["multipliers"]}
        """The reactions that hold it, by constraint."""
        self.rests: Mapping[str, float] = {name: force for name, force, _ in found["rests"]}
        """The stops that it rests on, and the forces with which they push."""
        named = [*found["coordinates"], *found["states"], *found["outputs"]]
        rows = [(f"lambda({name})", unit) for name, _, unit in found["multipliers"]]
        self.units: Mapping[str, str] = {**{name: unit for name, _, unit in named}, **dict(rows)}
        """The units of coordinates, states, outputs and ``lambda(row)``."""
        self.potential_energy: float = found["potential_energy"]
        """In J."""
        self.stability: str = found["stability"]
        """``stable``, ``indifferent`` or ``unstable``, as far as the stiffness tells."""
        self.directions: int = found["directions"]
        """In so many directions it falls away."""
        self.stiffness: Array = np.asarray(found["stiffness"], dtype=np.float64)
        """Eigenvalues of the stiffness over the mass in 1/s², ascending: squares of natural frequencies."""

    def __getitem__(self, name: str) -> float:
        for values in (self.coordinates, self.states, self.outputs):
            if name in values:
                return values[name]
        row = name.removeprefix("lambda(").removesuffix(")")
        if name == f"lambda({row})" and row in self.multipliers:
            return self.multipliers[row]
        raise KeyError(f"{name!r}; there is {', '.join(self.units)}")

    def __repr__(self) -> str:
        largest = max((abs(value) for value in self.coordinates.values()), default=0.0)
        # 0 for what is a rounding of the others
        shown = {name: 0.0 if abs(x) < 1e-13 * largest else x for name, x in self.coordinates.items()}
        values = ", ".join(f"{name} = {x:.6g} {self.units[name]}" for name, x in shown.items())
        return f"<Equilibrium of {self.mechanism}, {self.stability}: {values}>"
