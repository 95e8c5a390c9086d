"""A mechanism in the loop of a program: steps when they are asked for, with inputs that the program chooses."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

import numpy as np
import numpy.typing as npt

from mbs import _native
from mbs._asked import Array, Asked, Value, members_of, texts, whole
from mbs.errors import Error

if TYPE_CHECKING:
    from mbs.mechanism import Mechanism

#: Inputs of a step: a number where there is one input, a number for each in their order, or some by their names.
Inputs = float | Sequence[float] | npt.NDArray[Any] | Mapping[str, Value]


class Simulation:
    """A mechanism in motion, step by step, as ``Mechanism.start`` begins it.

    The state is an array of the coordinates and then of their rates, in m, rad and s; ``names`` has what is where.
    Inputs and outputs are in the units of the declaration. Inputs hold until they are set again.

    A copy goes on to the same bits. So does a run that was pickled, but for ``trbdf2``, ``rattle`` and runs to a tolerance
    (those with ``rtol``, and those of a mechanism with declared events): they carry an acceleration or the length of a
    step over to the next one, and go on within their accuracy. A run to a tolerance counts its steps anew.

    >>> ball = mbs.compile("Ball { dof = 1; input push [N]; body b (x) { mass = 2 [kg]; } force all on x = push; }")
    >>> run = ball.start(step="10 ms", x=1.0)
    >>> for _ in range(100):
    ...     x, speed = run.step(-4*(x - 1) if run.steps else 0)
    """

    def __init__(self, mechanism: Mechanism, asked: Asked, native: _native.Simulation | None = None) -> None:
        self._asked = asked
        self._native = _native.Simulation(mechanism._native, asked) if native is None else native
        self.mechanism: Mechanism = mechanism
        """The mechanism."""
        states = self._native.states()
        self.names: list[str] = [name for name, _ in states]
        """Names of the numbers of a state: coordinates ``x``, then rates ``der(x)``."""
        self.units: list[str] = [unit for _, unit in states]
        """Their units."""

    def __repr__(self) -> str:
        t, steps, step = self._native.clock()
        return f"<Simulation of {self.mechanism.name}: t = {t:g} s after {steps} steps of {step:g} s>"

    @property
    def t(self) -> float:
        """The time in s."""
        return self._native.clock()[0]

    @property
    def steps(self) -> int:
        """Steps since the start; of a run to a tolerance, times at which it was looked at."""
        return self._native.clock()[1]

    @property
    def step_size(self) -> float:
        """The length of a step in s."""
        return self._native.clock()[2]

    @property
    def state(self) -> Array:
        """The coordinates, then their rates."""
        return self._native.state()

    @property
    def outputs(self) -> Array:
        """The outputs, in the order and the units of ``mechanism.outputs``."""
        return self._native.outputs()

    @property
    def inputs(self) -> Array:
        """The inputs, in the order and the units of ``mechanism.inputs``; what is assigned holds until the next."""
        return self._native.inputs()

    @inputs.setter
    def inputs(self, inputs: Inputs) -> None:
        self._native.set_inputs(inputs)

    def __getitem__(self, name: str) -> float:
        """A coordinate ``x``, its rate ``der(x)``, an output, a multiplier ``lambda(row)``, an input, or ``t``."""
        if name in self.names:
            return float(self.state[self.names.index(name)])
        mechanism = self.mechanism
        if name in mechanism.outputs:
            return float(self.outputs[list(mechanism.outputs).index(name)])
        if name in mechanism.inputs:
            return float(self.inputs[list(mechanism.inputs).index(name)])
        rows = [f"lambda({row})" for row in mechanism.constraints]
        if name in rows:
            return float(self._native.multipliers()[rows.index(name)])
        if name == "t":
            return self.t
        known = ["t", *self.names, *rows, *mechanism.outputs, *mechanism.inputs]
        raise KeyError(f"{name!r}; there is {', '.join(known)}")

    def step(self, inputs: Inputs | None = None, steps: int = 1) -> Array:
        """Takes a step, or some, and gives the state after it. ``inputs`` hold from here on; without them those
        from before.

        Raises ``Error`` if there is no such step; the state is then that of the last good one.
        """
        return self._native.step(inputs, steps if steps == 1 else whole(steps, "steps", 0))

    @overload
    def advance(self, inputs: Any) -> Array: ...
    @overload
    def advance(self, inputs: Any, outputs: bool) -> tuple[Array, Array]: ...
    def advance(self, inputs: Any, outputs: bool = False) -> Array | tuple[Array, Array]:
        """Takes a step with each row of ``inputs``, and gives the states after each as the rows of an array. With
        ``outputs`` the outputs there too.

        A row has a number for each input; where there is one, ``inputs`` may be a plain list. Of a mechanism without
        inputs they are the number of steps.
        """
        count = len(self.mechanism.inputs)
        if count == 0:
            rows = np.empty((whole(inputs, "inputs", 0), 0))
        else:
            rows = np.asarray(inputs, dtype=np.float64)
            if count == 1 and rows.ndim == 1:
                rows = rows[:, np.newaxis]
        if rows.ndim != 2 or rows.shape[1] != count:
            names = ", ".join(self.mechanism.inputs)
            raise Error(f"inputs of some steps have a row for each, with {count} numbers ({names}), not {rows.shape}")
        states, measured = self._native.advance(rows, outputs)
        return states if measured is None else (states, measured)

    def reset(
        self, state: Sequence[float] | npt.NDArray[Any] | Mapping[str, Value] | None = None,
        *, t: float | None = None, **values: Value,
    ) -> Array:  # fmt: skip
        """Goes back to the start and gives its state; parameters stay, and inputs are those of the start.

        ``reset(y=0.1)`` and ``reset({"der(y)": 2})`` start with other values, which the other coordinates follow.
        ``reset(run.state)`` goes to a whole state, which has to be consistent, at the time ``t``.
        """
        if state is None or isinstance(state, Mapping):
            given = {**(state or {}), **values}
            if t is not None:
                raise Error("`t` goes with a whole state; what is declared starts at its own time")
            self._native.reset(texts(given), None, None)
        else:
            if values:
                raise Error("a state is given whole, or by the names of its values; not both")
            values_of = [float(value) for value in state]
            if len(values_of) != len(self.names):
                raise Error(f"a state has {len(self.names)} numbers ({', '.join(self.names)}), not {len(values_of)}")
            if not np.isfinite(values_of).all():
                raise Error(f"a state has finite numbers, not {values_of}")
            self._native.reset([], values_of, t)
        return self.state

    def copy(self) -> Simulation:
        """A copy, which goes on by itself to the same bits."""
        return Simulation(self.mechanism, self._asked, self._native.copy())

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Simulation:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored, (self.mechanism, self._asked, self._native.saved())


def _restored(mechanism: Mechanism, asked: Asked, saved: _native.Saved) -> Simulation:
    """A run that was sent from another process."""
    native = _native.Simulation(mechanism._native, asked).restored(saved)
    return Simulation(mechanism, asked, native)


class Simulations:
    """Runs of one mechanism side by side, on all cores, as ``Mechanism.start_many`` begins them.

    Arrays have a row for each run. A run that cannot go on has NaN until it is reset, and its reason in ``failures``.
    """

    def __init__(
        self,
        mechanism: Mechanism,
        asked: Asked,
        count: int,
        members: dict[str, Any],
        native: _native.Simulations | None = None,
    ) -> None:
        parameters, values = members_of(mechanism, count, members)
        self._given = (asked, count, members)
        self._native = (
            _native.Simulations(mechanism._native, asked, count, parameters, values) if native is None else native
        )
        self.mechanism: Mechanism = mechanism
        """The mechanism."""
        self.count: int = count
        """Number of runs."""
        coordinates, states = list(mechanism.coordinates), list(mechanism.states)
        integrals, rates = [f"integral({name})" for name in states], [f"der({name})" for name in coordinates]
        self.names: list[str] = [*coordinates, *integrals, *rates, *states]
        """Names of the columns of a state: coordinates ``x``, integrals of own states, rates ``der(x)``, own states."""

    def __len__(self) -> int:
        return self.count

    def __repr__(self) -> str:
        failed = len(self.failures)
        also = f", {failed} of which failed" if failed else ""
        return f"<{self.count} Simulations of {self.mechanism.name}{also}>"

    @property
    def t(self) -> Array:
        """Times in s."""
        return self._native.times()

    @property
    def state(self) -> Array:
        """A row for each run: the coordinates, then their rates."""
        return self._native.state()

    @property
    def outputs(self) -> Array:
        """A row for each run: the outputs, in the units of the declaration; NaN where they have no value."""
        return self._native.outputs()

    @property
    def failures(self) -> dict[int, str]:
        """Why runs failed since they were reset, by their index."""
        return dict(self._native.failures())

    def step(self, inputs: Any = None, steps: int = 1) -> Array:
        """Takes a step of every run, or some, and gives the states.

        ``inputs`` have a row for each run, or are the same for all: they are broadcast to (runs, inputs). Where there
        is one input, a number for each run will do.
        """
        rows = None
        if inputs is not None:
            shape = (self.count, len(self.mechanism.inputs))
            rows = np.asarray(inputs, dtype=np.float64)
            if shape[1] == 1 and rows.shape == (self.count,):
                rows = rows[:, np.newaxis]
            try:
                rows = np.ascontiguousarray(np.broadcast_to(rows, shape))
            except ValueError:
                names = ", ".join(self.mechanism.inputs)
                raise Error(
                    f"inputs of {self.count} runs are an array of the shape {shape}, with a column for each of "
                    f"({names}), not {rows.shape}"
                ) from None
        self._native.step(rows, whole(steps, "steps", 0))
        return self.state

    def reset(self, which: Any = None, state: Any = None, *, t: float | None = None) -> Array:
        """Puts runs back to their starts and gives the states of all: those of which ``which`` is true, or whose
        indices it has; all unless it is given. ``state`` has a whole state for each of them instead, which has to be
        consistent at the time ``t``."""
        if which is None:
            indices = np.arange(self.count)
        else:
            chosen = np.asarray(which)
            if chosen.size and chosen.dtype != np.bool_ and not np.issubdtype(chosen.dtype, np.integer):
                raise TypeError(f"`which` has truth values or indices, not numbers of the type {chosen.dtype}")
            indices = np.flatnonzero(chosen) if chosen.dtype == np.bool_ else chosen.ravel().astype(np.int64)
            if (chosen.dtype == np.bool_ and chosen.shape != (self.count,)) or np.any(
                (indices < 0) | (indices >= self.count)
            ):
                raise Error(f"there are {self.count} runs: `which` has a truth value for each, or indices from 0 on")
        states = None
        if state is not None:
            width = len(self.names)
            try:
                states = np.ascontiguousarray(
                    np.broadcast_to(np.asarray(state, dtype=np.float64), (len(indices), width))
                )
            except ValueError:
                raise Error(
                    f"states of {len(indices)} runs have {width} columns ({', '.join(self.names)}), not the shape "
                    f"{np.shape(state)}"
                ) from None
        self._native.reset(indices.tolist(), states, t)
        return self.state

    def copy(self) -> Simulations:
        """A copy, whose runs go on by themselves to the same bits."""
        asked, count, members = self._given
        return Simulations(self.mechanism, asked, count, members, self._native.copy())

    __copy__ = copy

    def __deepcopy__(self, memo: dict[int, Any]) -> Simulations:
        return self.copy()

    def __reduce__(self) -> tuple[Any, ...]:
        return _restored_all, (self.mechanism, *self._given, self._native.saved())


def _restored_all(
    mechanism: Mechanism, asked: Asked, count: int, members: dict[str, Any], saved: list[tuple[_native.Saved, str | None]]
) -> Simulations:
    """Runs that were sent from another process."""
    runs = Simulations(mechanism, asked, count, members)
    runs._native.restore(saved)
    return runs
