"""A compiled mechanism and what can be asked of it."""

from __future__ import annotations

import os
import warnings
from collections.abc import Mapping, Sequence
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from mbs import _native
from mbs._asked import Asked, Value, asked, numbers, whole
from mbs.equilibrium import Equilibrium
from mbs.errors import DoubtWarning, EndedEarly, Error
from mbs.fit import Fit, fit
from mbs.gradients import Gradients
from mbs.linear import Linearization, Mode
from mbs.progress import Progress, told
from mbs.run import Run
from mbs.simulation import Simulation, Simulations
from mbs.sweep import Sweep, sweep
from mbs.synthesis import Synthesis, synthesize

if TYPE_CHECKING:
    from mbs.sweep import Client


class Quantity(NamedTuple):
    """A parameter, an input, a coordinate or an output."""

    name: str
    """Its name."""
    doc: str
    """What it is."""
    unit: str
    """The unit in which numbers without one are read, and results are given."""
    value: float
    """The declared value, in this unit; of a coordinate at the start, 0 of an output."""


class Constraint(NamedTuple):
    """A constraint row, Φ = 0."""

    name: str
    """Its name; ``lambda(name)`` is its multiplier."""
    doc: str
    """What it is."""
    unit: str
    """The unit of its multiplier."""
    formula: str
    """Φ."""


def compile(source: str | os.PathLike[str], name: str | None = None) -> Mechanism:
    """Compiles a declaration: its text, or a file that has it, in some milliseconds.

    A text is what contains a ``{``. A file is a declaration by itself, or a Rust file with blocks ``mechanism! { … }``
    of which ``name`` chooses one. Tables of files are read beside it.

    Raises ``DeclarationError`` with the underlined source, and ``OSError``.

    >>> ball = mbs.compile("Ball { dof = 1; gravity = (0, -9.81) [m/s^2]; body b (y) { mass = 1 [kg]; } }")
    >>> float(ball.simulate(end=1.0)["y"][-1].round(3))
    -4.905
    """
    if isinstance(source, str) and "{" in source:
        return _compiled(source, "declaration", name)
    path = Path(source)
    return _compiled(path.read_text(encoding="utf-8"), str(path), name)


def _compiled(text: str, file: str, name: str | None) -> Mechanism:
    """A mechanism that can be compiled again elsewhere."""
    return Mechanism(_native.compile(text, file, name), (text, file, name))


class Mechanism:
    """A compiled mechanism.

    What it is asked takes parameters and inputs by their names: ``m.simulate(end=0.6, omega="200 rpm", l1=65)``. A
    number is in the unit of the declaration, a text has its own. Times are in s. A name that is an option too is given
    in ``parameters={…}`` or ``inputs={…}``.
    """

    def __init__(self, native: _native.Mechanism, source: tuple[str, str, str | None] | None = None) -> None:
        self._native = native
        self._source = source
        info = native.info()
        self.name: str = info["name"]
        """The declared name."""
        self.doc: str = info["doc"]
        """Its documentation."""
        self.dof: int = info["dof"]
        """Degrees of freedom: coordinates less independent constraints."""
        self.parameters: Mapping[str, Quantity] = _by_name(info["parameters"])
        """The parameters with their declared values."""
        self.inputs: Mapping[str, Quantity] = _by_name(info["inputs"])
        """The inputs with their defaults."""
        self.memories: Mapping[str, Quantity] = _by_name(info["memories"])
        """The memories, which clocks, stops and modes set, with their declared values."""
        self._modes: Mapping[str, Quantity] = {name: self.memories[name] for name in info["modes"]}
        self.coordinates: Mapping[str, Quantity] = _by_name(info["coordinates"])
        """The coordinates with the declared start."""
        self.states: Mapping[str, Quantity] = _by_name(info["states"])
        """The states of the declaration's own, with the declared start."""
        self.outputs: Mapping[str, Quantity] = _by_name(info["outputs"])
        """The outputs."""
        self.constraints: Mapping[str, Constraint] = {row[0]: Constraint(*row) for row in info["constraints"]}
        """The constraints, drives included."""
        self.events: Mapping[str, str] = dict(info["events"])
        """The declared events and what they are."""

    def __repr__(self) -> str:
        lists = ("parameters", "inputs", "memories", "coordinates", "states", "outputs")
        counts = ", ".join(f"{len(getattr(self, name))} {name}" for name in lists if getattr(self, name))
        return f"<Mechanism {self.name}: {self.dof} degrees of freedom, {counts}>"

    def _repr_html_(self) -> str:
        rows = "".join(
            f"<tr><td>{escape(q.name)}</td><td>{q.value:g}</td><td>{escape(q.unit)}</td><td>{escape(q.doc)}</td></tr>"
            for q in [*self.parameters.values(), *self.inputs.values()]
        )
        return f"<p><b>{escape(self.name)}</b>: {escape(self.doc)}</p><table>{rows}</table>"

    def __reduce__(self) -> tuple[Any, ...]:
        if self._source is None:
            raise TypeError(f"{self.name} was compiled by rustc, and has no text by which it could be sent elsewhere")
        return _compiled, self._source

    def _asked(self, given: Mapping[str, Any], starts: bool = False) -> Asked:
        inputs = {**self.inputs, **self._modes}
        return asked(self.name, self.parameters, inputs, given, {**self.coordinates, **self.states} if starts else None)

    def _has_no_end(self, values: Mapping[str, Any]) -> None:
        """Refuses what a run in a loop has no use for."""
        for name in ("end", "until", "every", "columns", "signals", "progress"):
            if name in values and name not in self.parameters and name not in self.inputs:
                raise Error(f"`{name}` is an option of `simulate`: this run takes its steps when it is asked to")

    def explain(self) -> str:
        """The equations, their elimination and its operations, as text."""
        return self._native.explanation()

    def latex(self) -> str:
        """The same as a LaTeX document."""
        return self._native.latex()

    def simulate(
        self,
        end: Value | None = None,
        *,
        step: Value | None = None,
        method: str | None = None,
        rtol: Value | None = None,
        atol: Value | None = None,
        max_step: Value | None = None,
        until: str | None = None,
        every: int | None = None,
        start: str | None = None,
        feedback: str | None = None,
        alpha: Value | None = None,
        beta: Value | None = None,
        allow_unstable: bool = False,
        parameters: Mapping[str, Value] | None = None,
        inputs: Mapping[str, Value] | None = None,
        signals: Mapping[str, Sequence[float] | tuple[Sequence[float], str]] | None = None,
        state: Mapping[str, Value] | None = None,
        columns: Sequence[str] | None = None,
        progress: Progress = None,
        **values: Value,
    ) -> Run:
        """A run, from the declared start to ``end``.

        ``step``, ``method``, ``feedback``, ``alpha``, ``beta`` are as declared unless they are given, else Heun's
        method with 0.5 ms and deadbeat feedback. With ``rtol``, ``atol`` or ``max_step`` the steps are as long as their
        error permits (``rtol`` is 1e-6 and ``atol`` a thousandth of it unless given), and ``step`` is the time between
        two rows; so are runs with declared events, unless the mechanism declares a method with constant steps, and
        those that end at a condition, ``until="x3 > 200mm"``. ``every`` keeps every so many rows. ``start="declared"``
        does not make the start consistent. ``signals`` are inputs that change: ``{"t": times, "force": values}``,
        straight lines between, or by the words of a table, ``{"t": times, "force": (values, "cubic outside
        periodic")}``. Coordinates are start values, ``x3=0.2``, as are those in ``state={"der(x3)": 1}``; the other
        coordinates follow them. ``columns=["x*", "lambda(pin_x)"]`` keeps these.

        Raises ``Error``, and ``EndedEarly`` with the run up to there. What makes its numbers doubtful is a
        ``DoubtWarning``.
        """
        options = dict(
            end=end, step=step, method=method, rtol=rtol, atol=atol, max_step=max_step, until=until, every=every,
            start=start, feedback=feedback, alpha=alpha, beta=beta, allow_unstable=allow_unstable,
            parameters=parameters, inputs=inputs, signals=signals, state=state,
        )  # fmt: skip
        asked = self._asked({**options, **values}, starts=True)
        with told(progress, self.name, " steps") as tell:
            native = self._native.simulate(asked, tell)
        run = Run(self, asked, native, columns)
        ended = native.ended()
        if ended is not None:
            raise EndedEarly(f"the run ended early: {ended}", run)
        unmet = native.unmet()
        if unmet is not None:
            warnings.warn(f"the run came to its end before `{unmet}`", DoubtWarning, stacklevel=2)
        for doubt in run.doubts:
            warnings.warn(doubt, DoubtWarning, stacklevel=2)
        return run

    def start(
        self,
        *,
        step: Value | None = None,
        method: str | None = None,
        rtol: Value | None = None,
        atol: Value | None = None,
        max_step: Value | None = None,
        start: str | None = None,
        feedback: str | None = None,
        alpha: Value | None = None,
        beta: Value | None = None,
        allow_unstable: bool = False,
        parameters: Mapping[str, Value] | None = None,
        inputs: Mapping[str, Value] | None = None,
        state: Mapping[str, Value] | None = None,
        **values: Value,
    ) -> Simulation:
        """A run that takes its steps when it is asked to: for controllers, environments and games.

        ``run = m.start(step="10 ms", y=0.1)``, then ``run.step(force)``. Options are those of ``simulate``; coordinates
        are start values, as are those in ``state={"der(y)": 2}``, and the other coordinates follow them. With ``rtol``
        a step leads over ``step`` seconds in as many steps as its error asks for. Events are passed over.
        """
        self._has_no_end(values)
        options = dict(
            step=step, method=method, rtol=rtol, atol=atol, max_step=max_step, start=start, feedback=feedback,
            alpha=alpha, beta=beta, allow_unstable=allow_unstable, parameters=parameters, inputs=inputs, state=state,
        )  # fmt: skip
        return Simulation(self, self._asked({**options, **values}, starts=True))

    def start_many(
        self,
        count: int,
        *,
        parameters: Mapping[str, Any] | None = None,
        state: Mapping[str, Any] | None = None,
        **values: Any,
    ) -> Simulations:
        """Some runs side by side, whose steps are taken together on all cores: a vectorised environment.

        Options are those of ``start``. A parameter or a start value that is an array has a value for each run:
        ``m.start_many(4096, step="10 ms", length=lengths, state={"der(y)": speeds})``.
        """
        whole(count, "count", 0)
        self._has_no_end(values)
        for name, value in values.items():
            if name in self.inputs and np.ndim(value) > 0:
                raise Error(f"the input `{name}` of each run is given to `step`")
            if name in (state or {}) or name in (parameters or {}):
                raise Error(f"`{name}` is given twice")
        several: dict[str, Any] = {}
        one: dict[str, dict[str, Any]] = {"parameters": {}, "state": {}}
        for kind, given in (("parameters", parameters), ("state", state)):
            for name, value in (given or {}).items():
                (one[kind] if np.ndim(value) == 0 else several)[name] = value
        names = {*self.parameters, *self.coordinates}
        several |= {name: value for name, value in values.items() if name in names and np.ndim(value) > 0}
        alone = {name: value for name, value in values.items() if name not in several}
        return Simulations(self, self._asked({**one, **alone}, starts=True), count, several)

    def sweep(
        self,
        *,
        outputs: Sequence[str] | None = None,
        paired: bool = False,
        progress: Progress = None,
        client: Client | None = None,
        chunk: int | None = None,
        **values: Any,
    ) -> Sweep:
        """Runs with all combinations of the parameters that are given as sequences, in lanes and on all cores.

        ``m.sweep(l1=np.linspace(50, 80, 31), omega=["100 rpm", "200 rpm"], end=0.6)`` makes 62 runs. With ``paired``
        the sequences have one value for each run. Of ``outputs`` (coordinates or outputs; all outputs unless it is said)
        the smallest, the largest and the last value are kept, whatever the number of steps. Everything else is as in
        ``simulate``. Runs that fail have NaN, and their reasons are in ``Sweep.failures``.

        With the ``client`` of a Dask cluster its workers make the runs, ``chunk`` of them to a task.
        """
        return sweep(self, outputs, paired, progress, client, chunk, values)

    def equilibrium(
        self,
        *,
        guess: Mapping[str, Value] | None = None,
        at: Value | None = None,
        relax: bool = False,
        **values: Any,
    ) -> Equilibrium:
        """Where the mechanism is at rest: the nearest equilibrium to the declared start, or to ``guess`` in some
        coordinates; with ``relax`` the stable one at which it would come to rest. ``at`` is the time at which drives are
        held. A mode holds with its name set to 1, ``m.equilibrium(caught=1)``."""
        point = _point(guess=guess, at=at, relax=relax)
        return Equilibrium(self.name, self._native.equilibrium(self._asked(values), point))

    def linearize(
        self,
        *,
        guess: Mapping[str, Value] | None = None,
        at: Value | None = None,
        relax: bool = False,
        here: bool = False,
        after: Value | None = None,
        states: Sequence[str] | None = None,
        linear_inputs: Sequence[str] | None = None,
        outputs: Sequence[str] | None = None,
        by: Sequence[str] = (),
        **values: Any,
    ) -> Linearization:
        """The linear system ẋ = A x + B u, y = C x + D u of small deviations, in SI units and minimal coordinates.

        About the equilibrium that ``equilibrium`` finds with the same arguments; with ``here`` about the start at rest,
        in equilibrium or not; with ``after`` about the motion that time after the start. Parameters that are named in
        ``by`` are inputs of the linear system too.
        """
        point = _point(guess=guess, at=at, relax=relax, here=here, after=after)
        ports: _native.Ports = {
            "states": _list(states),
            "inputs": _list(linear_inputs),
            "outputs": _list(outputs),
            "parameters": list(by),
        }
        found = Linearization(self.name, self._native.linearize(self._asked(values), point, ports))
        if found.doubt is not None:
            warnings.warn(found.doubt, DoubtWarning, stacklevel=2)
        return found

    def modes(self, **values: Any) -> list[Mode]:
        """Natural frequencies, damping and shapes of small motions; arguments as in ``linearize``."""
        return self.linearize(**values).modes()

    def gradients(
        self,
        columns: Sequence[str],
        by: Sequence[str],
        *,
        times: Sequence[float] | Any = None,
        progress: Progress = None,
        **values: Any,
    ) -> Gradients:
        """Exact derivatives of ``columns`` of a run with respect to parameters and start values ``x``, ``der(x)``, at
        some ``times`` (its end unless they are given), by dual numbers; to rtol = 1e-9 unless it is said."""
        at = None if times is None else numbers(times)
        with told(progress, self.name, " times") as tell:
            found = self._native.derivatives(self._asked(values), list(columns), list(by), at, tell)
        return Gradients(list(columns), list(by), found)

    def fit(
        self,
        data: Mapping[str, Any],
        unknown: Sequence[str] | Mapping[str, Value | None],
        *,
        bounds: Mapping[str, tuple[Value | None, Value | None]] | None = None,
        sigma: Mapping[str, float] | None = None,
        starts: int = 12,
        confidence: float = 0.95,
        progress: Progress = None,
        **values: Any,
    ) -> Fit:
        """Parameters and start values with which the mechanism moves as measured, by Levenberg and Marquardt's method
        with exact derivatives.

        ``data`` has the times ``t`` in s and columns with coordinates, rates, outputs or multipliers, in their units;
        NaN is what was not measured; columns with inputs act on the mechanism. ``unknown`` are names, or names with
        guesses. ``sigma`` has the standard deviations of the noise that are known, others are estimated.
        """
        return fit(self, data, unknown, bounds or {}, sigma or {}, starts, confidence, progress, values)

    def synthesize(
        self,
        through: Mapping[str, Any],
        between: Mapping[str, tuple[Value, Value]],
        *,
        drive: str | None = None,
        tolerance: float | None = None,
        starts: int | None = None,
        enough: int | None = None,
        seed: int | None = None,
        progress: Progress = None,
        **values: Any,
    ) -> Synthesis:
        """Dimensions with which a mechanism of one degree of freedom passes given positions, in their order.

        ``through`` has values of coordinates and outputs at each position, NaN for one that is free. ``between`` has
        the bounds of the parameters that are looked for. ``tolerance`` is in SI units, 1e-9 unless it is given.
        """
        return synthesize(
            self, through, between, drive, tolerance, starts, enough, seed, progress, values
        )


def _by_name(quantities: list[tuple[str, str, str, float]]) -> dict[str, Quantity]:
    return {row[0]: Quantity(*row) for row in quantities}


def _list(names: Sequence[str] | None) -> list[str] | None:
    return None if names is None else list(names)


def _point(
    guess: Mapping[str, Value] | None,
    at: Value | None,
    relax: bool,
    here: bool = False,
    after: Value | None = None,
) -> _native.Point:
    from mbs._asked import text, texts

    return {
        "guess": texts(guess or {}, "the values of a guess"),
        "at": None if at is None else text(at, "`at`"),
        "after": None if after is None else text(after, "`after`"),
        "relax": relax,
        "here": here,
    }
