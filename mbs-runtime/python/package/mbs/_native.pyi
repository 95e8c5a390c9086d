"""The compiled part of the package."""

from typing import Any, TypedDict

import numpy as np
import numpy.typing as npt

from mbs._asked import Array, Asked
from mbs.progress import Told

__version__: str

Described = tuple[str, str, str, float]
Values = list[tuple[str, float, str]]

class Info(TypedDict):
    name: str
    doc: str
    dof: int
    parameters: list[Described]
    inputs: list[Described]
    memories: list[Described]
    modes: list[str]
    coordinates: list[Described]
    states: list[Described]
    outputs: list[Described]
    constraints: list[tuple[str, str, str, str]]
    events: list[tuple[str, str]]

class SummaryDict(TypedDict):
    steps: int
    rejected: int | None
    end: float
    violation: float
    violation_rate: float
    energy_start: float
    energy_end: float

class Point(TypedDict):
    guess: list[tuple[str, str]]
    at: str | None
    after: str | None
    relax: bool
    here: bool

class Ports(TypedDict):
    states: list[str] | None
    inputs: list[str] | None
    outputs: list[str] | None
    parameters: list[str]

class AtRest(TypedDict):
    t: float
    coordinates: Values
    states: Values
    outputs: Values
    multipliers: Values
    rests: Values
    potential_energy: float
    stability: str
    directions: int
    stiffness: list[float]

class Swept(TypedDict):
    extents: dict[str, tuple[str, Array, Array, Array]]
    failed: int
    reasons: list[tuple[int, str]]

class LinearDict(TypedDict):
    about: str
    doubt: str | None
    t: float
    states: list[tuple[str, str]]
    inputs: list[tuple[str, str]]
    outputs: list[tuple[str, str]]
    A: Array
    B: Array
    C: Array
    D: Array
    values: list[float]

class ModeDict(TypedDict):
    eigenvalue: complex
    natural_frequency: float
    damping_ratio: float | None
    behaviour: str
    is_unstable: bool
    shape: dict[str, complex]

class AskedFit(TypedDict):
    measured: list[tuple[str, list[float], list[float], float | None]]
    unknown: list[tuple[str, str | None, list[str | None]]]
    starts: int
    confidence: float

class EstimateDict(TypedDict):
    name: str
    unit: str
    value: float
    standard_error: float
    interval: tuple[float, float]
    guess: float
    is_at_bound: bool

class RemainderDict(TypedDict):
    unit: str
    predicted: Array
    residuals: Array
    deviation: float
    is_estimated: bool

class Fitted(TypedDict):
    estimates: list[EstimateDict]
    remainders: list[RemainderDict]
    covariance: Array
    chi_squared: float
    freedom: int
    has_converged: bool
    runs: int
    confidence: float

class AskedTask(TypedDict):
    positions: list[tuple[str, list[float]]]
    unknown: list[tuple[str, str, str]]
    drive: str | None
    tolerance: float | None
    starts: int | None
    enough: int | None
    seed: int | None

class LinkageDict(TypedDict):
    parameters: dict[str, float]
    missed: float
    path: dict[str, Array]

class Synthesized(TypedDict):
    linkages: list[LinkageDict]
    refused: list[tuple[str, int]]
    starts: int
    nearest: float

Saved = tuple[float, int, list[float], list[float], list[float]]

class Recording:
    def columns(self, patterns: list[str] | None = None) -> list[tuple[str, str, Array]]: ...
    def summary(self) -> SummaryDict: ...
    def events(self) -> list[tuple[str, float, bool]]: ...
    def unmet(self) -> str | None: ...
    def ended(self) -> str | None: ...
    def doubts(self) -> list[str]: ...
    def notes(self) -> list[str]: ...
    def page(self) -> str: ...

class Linear:
    def describe(self) -> LinearDict: ...
    def modes(self) -> list[ModeDict]: ...
    def response(self, frequencies: list[float]) -> npt.NDArray[np.complex128]: ...
    def step_response(self, input: str, end: float, steps: int) -> tuple[list[float], Array]: ...

class Simulation:
    def __init__(self, mechanism: Mechanism, asked: Asked) -> None: ...
    def states(self) -> list[tuple[str, str]]: ...
    def clock(self) -> tuple[float, int, float]: ...
    def state(self) -> Array: ...
    def inputs(self) -> Array: ...
    def set_inputs(self, given: Any) -> None: ...
    def outputs(self) -> Array: ...
    def multipliers(self) -> Array: ...
    def step(self, inputs: Any = None, steps: int = 1) -> Array: ...
    def advance(self, inputs: Array, has_outputs: bool) -> tuple[Array, Array | None]: ...
    def reset(
        self, values: list[tuple[str, str]], state: list[float] | None = None, t: float | None = None
    ) -> None: ...
    def copy(self) -> Simulation: ...
    def saved(self) -> Saved: ...
    def restored(self, saved: Saved) -> Simulation: ...

class Simulations:
    def __init__(
        self,
        mechanism: Mechanism,
        asked: Asked,
        count: int,
        parameters: list[tuple[str, list[float] | list[str]]],
        values: list[tuple[str, list[float]]],
    ) -> None: ...
    def times(self) -> Array: ...
    def state(self) -> Array: ...
    def outputs(self) -> Array: ...
    def failures(self) -> list[tuple[int, str]]: ...
    def step(self, inputs: Array | None, steps: int) -> None: ...
    def reset(self, which: list[int], states: Array | None = None, t: float | None = None) -> None: ...
    def saved(self) -> list[tuple[Saved, str | None]]: ...
    def restore(self, saved: list[tuple[Saved, str | None]]) -> None: ...
    def copy(self) -> Simulations: ...

class Mechanism:
    def info(self) -> Info: ...
    def explanation(self) -> str: ...
    def latex(self) -> str: ...
    def simulate(self, asked: Asked, progress: Told | None = None) -> Recording: ...
    def sweep(
        self,
        asked: Asked,
        axes: list[tuple[str, list[float] | list[str]]],
        paired: bool,
        names: list[str],
        first: int,
        last: int,
        threads: int | None = None,
        progress: Told | None = None,
    ) -> Swept: ...
    def equilibrium(self, asked: Asked, point: Point) -> AtRest: ...
    def linearize(self, asked: Asked, point: Point, ports: Ports) -> Linear: ...
    def derivatives(
        self,
        asked: Asked,
        columns: list[str],
        by: list[str],
        times: list[float] | None = None,
        progress: Told | None = None,
    ) -> tuple[list[Array], list[str], list[str]]: ...
    def fit(self, asked: Asked, fit: AskedFit, progress: Told | None = None) -> Fitted: ...
    def synthesize(self, asked: Asked, task: AskedTask, progress: Told | None = None) -> Synthesized: ...

def compile(text: str | None, file: str, name: str | None = None) -> Mechanism: ...
