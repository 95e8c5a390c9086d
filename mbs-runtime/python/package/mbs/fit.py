"""Parameters from measured motions."""

from __future__ import annotations

import warnings
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mbs._asked import Array, Value, numbers, text
from mbs.errors import DoubtWarning, Error
from mbs.progress import Progress, told

if TYPE_CHECKING:
    from mbs._native import AskedFit, Fitted
    from mbs.mechanism import Mechanism


class Estimate(NamedTuple):
    """A value that was found, in its declared unit."""

    name: str
    unit: str
    value: float
    standard_error: float
    """Its standard deviation; 0 at a bound."""
    interval: tuple[float, float]
    """Contains the true value with the probability ``Fit.confidence``."""
    guess: float
    is_at_bound: bool


class Fit(Mapping[str, Estimate]):
    """What a measurement says about a mechanism: an ``Estimate`` for each name that was looked for."""

    def __init__(self, names: list[str], found: Fitted) -> None:
        self._estimates = {estimate["name"]: Estimate(**estimate) for estimate in found["estimates"]}
        count = len(self._estimates)
        self.covariance: Array = found["covariance"].reshape(count, count)
        """Of the estimates, in the products of their units."""
        remainders = list(zip(names, found["remainders"]))
        self.predicted: Mapping[str, Array] = {name: remainder["predicted"] for name, remainder in remainders}
        """What the mechanism does where each column was measured."""
        self.residuals: Mapping[str, Array] = {name: remainder["residuals"] for name, remainder in remainders}
        """Measured less predicted."""
        self.sigma: Mapping[str, float] = {name: remainder["deviation"] for name, remainder in remainders}
        """The standard deviation of the noise of each column, given or estimated."""
        self.chi_squared: float = found["chi_squared"]
        self.freedom: int = found["freedom"]
        """Samples less estimates."""
        self.has_converged: bool = found["has_converged"]
        self.runs: int = found["runs"]
        self.confidence: float = found["confidence"]

    def __getitem__(self, name: str) -> Estimate:
        return self._estimates[name]

    def __iter__(self) -> Any:
        return iter(self._estimates)

    def __len__(self) -> int:
        return len(self._estimates)

    @property
    def values_found(self) -> dict[str, float]:
        """The values alone, as ``simulate`` takes them."""
        return {name: estimate.value for name, estimate in self._estimates.items()}

    def __repr__(self) -> str:
        found = (f"{e.name} = {e.value:.6g} ± {e.standard_error:.2g} {e.unit}".rstrip() for e in self.values())
        return f"<Fit: {', '.join(found)}>"


def fit(
    mechanism: Mechanism,
    data: Mapping[str, Any],
    unknown: Sequence[str] | Mapping[str, Value | None],
    bounds: Mapping[str, tuple[Value | None, Value | None]],
    sigma: Mapping[str, float],
    starts: int,
    confidence: float,
    progress: Progress,
    values: Mapping[str, Any],
) -> Fit:
    """As ``Mechanism.fit``."""
    if "t" not in data:
        raise Error("the data have no column `t` with the times in s")
    columns = {str(name): np.asarray(data[name], dtype=np.float64) for name in data if name != "t"}
    times = np.asarray(data["t"], dtype=np.float64)
    inputs = {name: column for name, column in columns.items() if name in mechanism.inputs}
    given = dict(values)
    if inputs:
        given["signals"] = {"t": times, **inputs}
    guesses = dict(unknown) if isinstance(unknown, Mapping) else dict.fromkeys(unknown)
    for name in [*bounds, *sigma]:
        if name not in guesses and name not in columns:
            raise Error(f"`{name}` is neither looked for nor measured")
    measured = [
        (name, *_samples(times, column), sigma.get(name)) for name, column in columns.items() if name not in inputs
    ]
    ends = {name: tuple(None if end is None else text(end) for end in bound) for name, bound in bounds.items()}
    wanted = [
        (name, None if guess is None else text(guess), list(ends.get(name, (None, None))))
        for name, guess in guesses.items()
    ]
    request: AskedFit = {"measured": measured, "unknown": wanted, "starts": starts, "confidence": confidence}
    with told(progress, mechanism.name, " starts") as tell:
        found = mechanism._native.fit(mechanism._asked(given), request, tell)
    result = Fit([name for name, *_ in measured], found)
    if not result.has_converged:
        warnings.warn("the sum of squares was still falling; begin nearer", DoubtWarning, stacklevel=3)
    for estimate in result.values():
        if estimate.is_at_bound:
            warnings.warn(f"`{estimate.name}` ended at its bound", DoubtWarning, stacklevel=3)
    return result


def _samples(times: Array, values: Array) -> tuple[list[float], list[float]]:
    """What was measured, without gaps."""
    if times.shape != values.shape:
        raise Error("every column has a value, or NaN, for each of the times `t`")
    there = ~np.isnan(values)
    return numbers(times[there]), numbers(values[there])
