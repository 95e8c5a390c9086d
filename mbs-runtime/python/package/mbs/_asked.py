"""What a person asks of a run, in the texts that the command line reads too."""

from __future__ import annotations

import operator
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np
import numpy.typing as npt

from mbs.errors import Error

if TYPE_CHECKING:
    from mbs.mechanism import Mechanism, Quantity

Array = npt.NDArray[np.float64]

#: A number in the usual unit of a quantity, or a text such as ``"200 rpm"``.
Value = float | int | str | np.floating[Any] | np.integer[Any]

#: Options of a run whose values are texts, or numbers in SI units.
OPTIONS = (
    "end",
    "step",
    "method",
    "rtol",
    "atol",
    "max_step",
    "feedback",
    "alpha",
    "beta",
    "until",
    "start",
)
#: Options of a run that are something else.
OTHERS = ("every", "allow_unstable", "parameters", "inputs", "signals", "state")


class Asked(TypedDict):
    """What the compiled part of the package is asked."""

    options: list[tuple[str, str]]
    parameters: list[tuple[str, str]]
    inputs: list[tuple[str, str]]
    signals: tuple[list[float], list[tuple[str, list[float], str]]] | None
    state: list[tuple[str, str]]
    every: int | None
    allow_unstable: bool


def text(value: Value, name: str = "a value") -> str:
    """A value as text: numbers in the shortest form that reads back as the same number."""
    if isinstance(value, str):
        return value
    try:
        return repr(float(value))
    except (TypeError, ValueError):
        several = "; several values are for `sweep`" if isinstance(value, Iterable) else ""
        raise TypeError(
            f'{name} is a number or a text such as "3 mm", not {_kind(value)}{several}'
        ) from None


def texts(values: Mapping[str, Value], name: str = "values") -> list[tuple[str, str]]:
    """Names and values as texts."""
    if not isinstance(values, Mapping):
        raise TypeError(f"{name} are a dict of names and values, not {_kind(values)}")
    return [(str(key), text(value, f"`{key}`")) for key, value in values.items()]


def _kind(value: object) -> str:
    kind = type(value).__name__
    return f"an array of the shape {value.shape}" if isinstance(value, np.ndarray) else f"{kind} {value!r:.40}"


def numbers(values: Iterable[Any]) -> list[float]:
    """Numbers of any kind."""
    return [float(value) for value in np.asarray(values, dtype=np.float64).ravel()]


def asked(
    name: str,
    parameters: Mapping[str, Quantity],
    inputs: Mapping[str, Quantity],
    given: Mapping[str, Any],
    coordinates: Mapping[str, Quantity] | None = None,
) -> Asked:
    """Options, parameters and inputs among keywords, and of what starts the values of coordinates; a name that is none
    of them is an error."""
    found: Asked = {
        "options": [],
        "parameters": texts(_or_none(given.get("parameters")), "parameters"),
        "inputs": texts(_or_none(given.get("inputs")), "inputs"),
        "signals": signals(given.get("signals")),
        "state": texts(_or_none(given.get("state")), "the values of a state"),
        "every": None if given.get("every") is None else whole(given["every"], "every", 1),
        "allow_unstable": bool(given.get("allow_unstable", False)),
    }
    starts = coordinates or {}
    for key, value in given.items():
        if value is None or key in OTHERS and (key != "state" or coordinates is not None):
            continue
        if key in OPTIONS:
            found["options"].append((key.replace("_", "-"), text(value, f"`{key}`")))
        elif key in parameters:
            found["parameters"].append((key, text(value, f"`{key}`")))
        elif key in inputs:
            found["inputs"].append((key, text(value, f"`{key}`")))
        elif key in starts:
            found["state"].append((key, text(value, f"`{key}`")))
        else:
            raise Error(unknown(name, key, [*parameters, *inputs], [*starts]))
    return found


def whole(value: Any, name: str, least: int) -> int:
    """A whole number that is not too small."""
    try:
        count = operator.index(value)
    except TypeError:
        raise TypeError(f"`{name}` is a whole number from {least} on, not {_kind(value)}") from None
    if count < least:
        raise Error(f"`{name}` is a whole number from {least} on, not {count}")
    return count


def members_of(
    mechanism: Mechanism, count: int, members: Mapping[str, Any]
) -> tuple[list[tuple[str, list[float] | list[str]]], list[tuple[str, list[float]]]]:
    """Values for each of some runs: of parameters, and of coordinates and rates at the start."""
    parameters: list[tuple[str, list[float] | list[str]]] = []
    values: list[tuple[str, list[float]]] = []
    for name, given in members.items():
        column = list(given)
        if len(column) != count:
            raise Error(f"`{name}` has {len(column)} values for {count} runs")
        if name in mechanism.parameters:
            is_text = all(isinstance(value, str) for value in column)
            parameters.append((name, column if is_text else numbers(column)))
        else:
            try:
                values.append((name, numbers(column)))
            except (TypeError, ValueError):
                raise TypeError(f"start values `{name}` of some runs are numbers, in m or rad and s") from None
            wrong = np.flatnonzero(~np.isfinite(values[-1][1]))
            if wrong.size:
                raise Error(f"the start value `{name}` of run {wrong[0]} is {values[-1][1][wrong[0]]}")
    return parameters, values


def _or_none(given: Any) -> Any:
    return {} if given is None else given


def unknown(mechanism: str, key: str, known: Sequence[str], coordinates: Sequence[str] = ()) -> str:
    """Message about a keyword without a meaning, with the nearest known one; ``coordinates`` are known at a start."""
    import difflib

    near = difflib.get_close_matches(key, [*known, *coordinates, *OPTIONS, *OTHERS], 1)
    meant = f", did you mean `{near[0]}`?" if near else ""
    listed = f"its parameters and inputs are {', '.join(known)}" if known else "it has no parameters and inputs"
    kinds = "parameter, input or coordinate" if coordinates else "parameter or input"
    return f"{mechanism} has no {kinds} `{key}`, nor is that an option{meant} ({listed})"


def signals(given: Mapping[str, Any] | None) -> tuple[list[float], list[tuple[str, list[float], str]]] | None:
    """Inputs that change: the times under ``t``, and each input at them, or a pair of that and the words of its way."""
    if given is None:
        return None
    if not isinstance(given, Mapping):
        raise TypeError(f"signals are a dict of the times `t` and of inputs at them, not {_kind(given)}")
    if "t" not in given:
        raise Error("signals have no column `t` with the times in s")
    columns = []
    for name, values in given.items():
        match values:
            case (of, str() as words):
                columns.append((str(name), numbers(of), words))
            case _:
                columns.append((str(name), numbers(values), ""))
    times = next(column for name, column, _ in columns if name == "t")
    return times, [column for column in columns if column[0] != "t"]
