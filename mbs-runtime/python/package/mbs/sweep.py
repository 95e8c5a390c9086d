"""Many runs that differ in parameters."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import prod
from typing import TYPE_CHECKING, Any, Protocol

import numpy as np

from mbs._asked import OPTIONS, OTHERS, Array, Asked
from mbs.errors import Error
from mbs.progress import Progress, Told, told

if TYPE_CHECKING:
    from mbs._native import Swept
    from mbs.mechanism import Mechanism

#: A parameter and its values: numbers in its declared unit, or texts.
Axis = tuple[str, list[float] | list[str]]


class Client(Protocol):
    """What a sweep needs of a ``distributed.Client``."""

    def submit(self, func: Any, *args: Any, **kwargs: Any) -> Any: ...

    def scheduler_info(self) -> Any: ...


@dataclass(frozen=True)
class Request:
    """What is swept, in values that can be sent to another machine."""

    asked: Asked
    axes: list[Axis]
    paired: bool
    outputs: list[str]

    @property
    def shape(self) -> tuple[int, ...]:
        lengths = tuple(len(values) for _, values in self.axes)
        return lengths[:1] if self.paired else lengths


class Sweep:
    """The smallest, largest and last value of each quantity in every run of a sweep.

    ``low``, ``high``, ``last`` and ``peak`` (the largest magnitude) are arrays by name, with an axis for each parameter
    in the order in which they were given; ``axes`` has their values. A run that failed has NaN.
    """

    def __init__(self, request: Request, units: Mapping[str, str], swept: Swept) -> None:
        shape = request.shape
        self.axes: dict[str, Any] = {name: np.asarray(values) for name, values in request.axes}
        """The parameters and their values, as they were given."""
        self.is_paired: bool = request.paired
        """Whether the values belong together, run by run."""
        self.low: dict[str, Array] = {}
        self.high: dict[str, Array] = {}
        self.last: dict[str, Array] = {}
        self.units: dict[str, str] = {name: units[name] for name in self.axes}
        """The units of quantities, and those of parameters that were given as numbers."""
        for name, (unit, low, high, last) in swept["extents"].items():
            self.units[name] = unit
            self.low[name], self.high[name], self.last[name] = (
                column.reshape(shape) for column in (low, high, last)
            )
        self.failed: int = swept["failed"]
        """How many runs failed."""
        self.failures: dict[tuple[int, ...], str] = {
            tuple(int(at) for at in np.unravel_index(index, shape)): reason for index, reason in swept["reasons"]
        }
        """Why, by the places of the first hundred."""

    @property
    def peak(self) -> dict[str, Array]:
        """The largest magnitudes."""
        return {name: np.maximum(np.abs(self.low[name]), np.abs(self.high[name])) for name in self.low}

    @property
    def count(self) -> int:
        """How many runs there are."""
        lengths = [len(values) for values in self.axes.values()]
        return lengths[0] if self.is_paired else prod(lengths)

    def __repr__(self) -> str:
        failed = f", {self.failed} failed" if self.failed else ""
        return f"<Sweep of {', '.join(self.axes)}: {self.count} runs{failed}; {', '.join(self.low)}>"

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` of variables ``min …``, ``max …`` and ``final …``."""
        import xarray as xr

        if self.is_paired:
            dims: Sequence[str] = ("run",)
            coords: dict[str, Any] = {name: ("run", values) for name, values in self.axes.items()}
        else:
            dims = tuple(self.axes)
            coords = {name: (name, values, {"units": self.units[name]}) for name, values in self.axes.items()}
        variables = {
            f"{what} {name}": (dims, values, {"units": self.units[name]})
            for name in self.low
            for what, values in self._extents(name)
        }
        return xr.Dataset(variables, coords=coords)

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` with a row for each run, in the columns that ``mbs sweep --out`` writes."""
        import pandas as pd

        if self.is_paired:
            columns = dict(self.axes)
        else:
            grids = np.meshgrid(*self.axes.values(), indexing="ij")
            columns = {name: grid.ravel() for name, grid in zip(self.axes, grids)}
        for name in self.low:
            columns |= {f"{what} {name}": values.ravel() for what, values in self._extents(name)}
        frame = pd.DataFrame(columns)
        frame.attrs["units"] = dict(self.units)
        return frame

    def _extents(self, name: str) -> list[tuple[str, Array]]:
        return [("min", self.low[name]), ("max", self.high[name]), ("final", self.last[name])]


def sweep(
    mechanism: Mechanism,
    outputs: Sequence[str] | None,
    paired: bool,
    progress: Progress,
    client: Client | None,
    chunk: int | None,
    values: Mapping[str, Any],
) -> Sweep:
    """As ``Mechanism.sweep``."""
    request = _request(mechanism, outputs, paired, values)
    units = {name: quantity.unit for name, quantity in mechanism.parameters.items()}
    with told(progress, mechanism.name, " runs") as tell:
        if client is None:
            swept = here(mechanism, request, 0, prod(request.shape), tell)
        else:
            from mbs import distributed

            swept = distributed.sweep(mechanism, request, client, chunk, tell)
    return Sweep(request, units, swept)


def here(
    mechanism: Mechanism, request: Request, first: int, last: int, tell: Told | None, threads: int | None = None
) -> Swept:
    """Runs ``first`` to ``last`` of a sweep, in this process."""
    return mechanism._native.sweep(
        request.asked, request.axes, request.paired, request.outputs, first, last, threads, tell
    )


def _request(mechanism: Mechanism, outputs: Sequence[str] | None, paired: bool, values: Mapping[str, Any]) -> Request:
    options = (*OPTIONS, *OTHERS)
    swept = {name: value for name, value in values.items() if name not in options and _is_list(value)}
    given = {name: value for name, value in values.items() if name not in swept}
    axes: list[Axis] = [(name, _axis(name, value)) for name, value in swept.items()]
    if not axes:
        raise Error("a sweep needs a parameter with a sequence of values, such as l1=np.linspace(50, 80, 31)")
    lengths = {len(value) for _, value in axes}
    if paired and len(lengths) > 1:
        raise Error("paired parameters have as many values as each other, one for each run")
    names = list(outputs) if outputs is not None else list(mechanism.outputs) or list(mechanism.coordinates)
    return Request(mechanism._asked(given), axes, paired, names)


def _is_list(value: Any) -> bool:
    return not isinstance(value, str | bytes) and hasattr(value, "__len__") and hasattr(value, "__iter__")


def _axis(name: str, values: Any) -> list[float] | list[str]:
    listed = list(values)
    if not listed:
        raise Error(f"the parameter `{name}` is given an empty sequence")
    if all(isinstance(value, str) for value in listed):
        return [str(value) for value in listed]
    array = np.asarray(values, dtype=np.float64)
    if array.ndim != 1:
        raise Error(f"the values of the parameter `{name}` have to be one sequence, not {array.ndim} nested ones")
    return [float(value) for value in array]
