"""Derivatives of a run."""

from __future__ import annotations

from collections.abc import Mapping

from mbs._asked import Array


class Gradients:
    """Values of columns at some times, and their derivatives.

    ``values[t, column]`` and ``jacobian[t, column, variable]`` are in declared units; ``g["x3"]["l1"]`` is ∂x3/∂l1 over
    the times.
    """

    def __init__(
        self,
        columns: list[str],
        by: list[str],
        found: tuple[list[Array], list[str], list[str]],
    ) -> None:
        (times, values, derivatives), column_units, units = found
        self.t: Array = times
        """The times in s."""
        self.columns, self.by = columns, by
        self.values: Array = values.reshape(len(times), len(columns))
        """A value for each time and column."""
        self.jacobian: Array = derivatives.reshape(len(times), len(columns), len(by))
        """A derivative for each time, column and variable."""
        self.units: dict[str, str] = {**dict(zip(columns, column_units)), **dict(zip(by, units))}
        """The units of columns and variables."""

    def __getitem__(self, column: str) -> Mapping[str, Array]:
        at = self.columns.index(column)
        return {name: self.jacobian[:, at, variable] for variable, name in enumerate(self.by)}

    def __repr__(self) -> str:
        return f"<Gradients of {', '.join(self.columns)} by {', '.join(self.by)} at {len(self.t)} times>"
