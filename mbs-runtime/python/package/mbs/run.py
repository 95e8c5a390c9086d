"""A run of a mechanism, as arrays by name."""

from __future__ import annotations

import os
from collections.abc import Iterator, Mapping, Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mbs._asked import Array
from mbs.errors import Error

if TYPE_CHECKING:
    from mbs._asked import Asked
    from mbs._native import Recording
    from mbs.mechanism import Mechanism


class Event(NamedTuple):
    """Something that happened during a run."""

    name: str
    """The declared event, or the condition that ended the run."""
    t: float
    """When, in s."""
    rising: bool
    """Whether its value became positive."""


class Summary(NamedTuple):
    """The figures of a run that one looks at first."""

    steps: int
    """Steps taken."""
    rejected: int | None
    """Steps that a run to a tolerance made again."""
    end: float
    """Time of the last state in s."""
    violation: float
    """The largest constraint violation ‖Φ‖ over all steps."""
    violation_rate: float
    """The largest ‖Φ̇‖ over all steps."""
    energy_start: float
    """Kinetic and potential energy at the start in J."""
    energy_end: float
    """The same at the end."""


class Run(Mapping[str, Array]):
    """A run: every coordinate ``x``, rate ``der(x)``, multiplier ``lambda(row)`` and output as an array by its name.

    Values are in the units of ``units``, which are those of the declaration; the times are in ``t``. A run can be
    pickled, unless rustc compiled its mechanism.
    """

    def __init__(
        self, mechanism: Mechanism, asked: Asked, native: Recording, columns: Sequence[str] | None = None
    ) -> None:
        self._native: Recording | None = native
        self._source = mechanism, asked
        self.mechanism: str = mechanism.name
        """The name of the mechanism."""
        if isinstance(columns, str):
            raise TypeError(f"columns are a list of names, not the text {columns!r}")
        found = native.columns(None if columns is None else [str(name) for name in columns])
        self._columns = {name: values for name, _, values in found}
        self.units: dict[str, str] = {name: unit for name, unit, _ in found}
        """The unit of every column; empty for a bare number."""
        self.summary: Summary = Summary(**native.summary())
        """Steps, violations and energies."""
        self.events: list[Event] = [Event(*event) for event in native.events()]
        """What happened, in its order."""
        self.doubts: list[str] = native.doubts()
        """Why the numbers should not be trusted, although the run did not fail."""
        self.notes: list[str] = native.notes()
        """Notes on how the run differs from what one may expect: declared events that a constant step does not look
        for, another method in place of the declared one in a run to a tolerance, the use of signals. They cast no doubt
        on its numbers."""

    @property
    def t(self) -> Array:
        """The times in s."""
        return self._columns["t"]

    def __getitem__(self, name: str) -> Array:
        try:
            return self._columns[name]
        except KeyError:
            raise KeyError(f"{name!r}; there is {', '.join(self._columns)}") from None

    def __iter__(self) -> Iterator[str]:
        return iter(self._columns)

    def __len__(self) -> int:
        return len(self._columns)

    def __repr__(self) -> str:
        return (
            f"<Run of {self.mechanism}: {len(self.t)} rows to t = {self.summary.end:g} s, "
            f"{self.summary.steps} steps, violation {self.summary.violation:.1e}>"
        )

    def __getstate__(self) -> dict[str, Any]:
        return {**self.__dict__, "_native": None}

    def to_pandas(self) -> Any:
        """A ``pandas.DataFrame`` over the time; ``attrs["units"]`` has the units."""
        import pandas as pd

        columns = {name: values for name, values in self._columns.items() if name != "t"}
        frame = pd.DataFrame(columns, index=pd.Index(self.t, name="t"))
        frame.attrs["units"] = dict(self.units)
        return frame

    def to_xarray(self) -> Any:
        """An ``xarray.Dataset`` over the time; every variable has its unit in ``attrs["units"]``."""
        import xarray as xr

        columns = {
            name: ("t", values, {"units": self.units[name]}) for name, values in self._columns.items() if name != "t"
        }
        coordinate = {"t": ("t", self.t, {"units": "s"})}
        return xr.Dataset(columns, coords=coordinate, attrs={"mechanism": self.mechanism})

    def page(self, path: str | os.PathLike[str] | None = None) -> str:
        """One HTML page with the mechanism in motion and its curves, which needs no network; written to a file if
        ``path`` is given."""
        if self._native is None:
            # the same run, to the bit
            mechanism, asked = self._source
            self._native = mechanism._native.simulate(asked)
        html = self._native.page()
        if path is not None:
            Path(path).write_text(html, encoding="utf-8")
        return html

    def _repr_html_(self) -> str:
        if not np.isfinite(self.t).all():
            return f"<pre>{escape(repr(self))}</pre>"
        try:
            page = self.page()
        except Error as error:
            return f"<pre>{escape(repr(self))}\n{escape(str(error))}</pre>"
        return (
            f'<iframe srcdoc="{escape(page, quote=True)}" sandbox="allow-scripts allow-downloads" '
            'style="width:100%;height:640px;border:0"></iframe>'
        )
