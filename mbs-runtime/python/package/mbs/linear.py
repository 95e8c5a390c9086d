"""Linear systems, modes and responses."""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np
import numpy.typing as npt

from mbs._asked import Array, numbers

if TYPE_CHECKING:
    from mbs._native import Linear

Complexes = npt.NDArray[np.complex128]


class Mode(NamedTuple):
    """A small motion δq = Re(φ e^{λt})."""

    eigenvalue: complex
    """λ in 1/s, with Im λ ≥ 0."""
    natural_frequency: float
    """|λ| in rad/s: the frequency without damping."""
    damping_ratio: float | None
    """−Re λ/|λ|; nothing for a motion that nothing drives back."""
    behaviour: str
    """What becomes of it, in words."""
    is_unstable: bool
    """Whether it grows."""
    shape: Mapping[str, complex]
    """φ, a component for each coordinate in m or rad."""

    @property
    def frequency(self) -> float:
        """The natural frequency in Hz."""
        return self.natural_frequency / (2 * np.pi)


class Linearization:
    """ẋ = A x + B u, y = C x + D u, of small deviations from an operating point; SI units and rad."""

    def __init__(self, mechanism: str, native: Linear) -> None:
        self._native = native
        found = native.describe()
        self.mechanism: str = mechanism
        """The name of the mechanism."""
        self.about: str = found["about"]
        """About what it is linearized, in words."""
        self.doubt: str | None = found["doubt"]
        """Why the derivatives are not known well, if they are not."""
        self.states: list[str] = [name for name, _ in found["states"]]
        """x: independent coordinates, then their rates."""
        self.inputs: list[str] = [name for name, _ in found["inputs"]]
        """u"""
        self.outputs: list[str] = [name for name, _ in found["outputs"]]
        """y"""
        self.units: Mapping[str, str] = dict([*found["states"], *found["inputs"], *found["outputs"]])
        """The SI units of all of them; empty for a bare number and for rad."""
        self.A: Array = found["A"]
        self.B: Array = found["B"]
        self.C: Array = found["C"]
        self.D: Array = found["D"]
        self.values: Array = np.asarray(found["values"], dtype=np.float64)
        """y at the operating point."""

    def __iter__(self) -> Iterator[Array]:
        return iter((self.A, self.B, self.C, self.D))

    def __repr__(self) -> str:
        return f"<Linearization of {self.mechanism} about {self.about}: {len(self.states)} states>"

    def modes(self) -> list[Mode]:
        """The modes, with ascending natural frequencies."""
        return [Mode(**mode) for mode in self._native.modes()]

    def response(self, omega: Sequence[float] | Array) -> Complexes:
        """H(iω) at frequencies in rad/s, of shape (frequencies, outputs, inputs)."""
        frequencies = numbers(omega)
        flat = self._native.response(frequencies)
        return flat.reshape(len(frequencies), len(self.outputs), len(self.inputs))

    def step_response(self, input: str, end: float, steps: int = 500) -> tuple[Array, Array]:
        """Times, and the outputs after a unit step of an input, of shape (times, outputs)."""
        times, outputs = self._native.step_response(input, float(end), int(steps))
        return np.asarray(times), outputs

    def to_scipy(self) -> Any:
        """A ``scipy.signal.StateSpace``."""
        from scipy.signal import StateSpace

        return StateSpace(*self)
