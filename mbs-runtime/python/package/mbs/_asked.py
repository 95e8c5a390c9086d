"""What a person asks of a run, in the texts that the command line reads too."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, TypedDict

import numpy as np
import numpy.typing as npt

from mbs.errors import Error

if TYPE_CHECKING:
    from mbs.mechanism import Quantity

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
OTHERS = ("every", "allow_unstable", "parameters", "inputs", "signals")


class Asked(TypedDict):
    """What the compiled part of the package is asked."""

    options: list[tuple[str, str]]
    parameters: list[tuple[str, str]]
    inputs: list[tuple[str, str]]
    signals: tuple[list[float], list[tuple[str, list[float]]]] | None
    every: int | None
    allow_unstable: bool


def text(value: Value) -> str:
    """A value as text: numbers in the shortest form that reads back as the same number."""
    return value if isinstance(value, str) else repr(float(value))


def texts(values: Mapping[str, Value]) -> list[tuple[str, str]]:
    """Names and values as texts."""
    return [(name, text(value)) for name, value in values.items()]


def numbers(values: Iterable[Any]) -> list[float]:
    """Numbers of any kind."""
    return [float(value) for value in np.asarray(values, dtype=np.float64).ravel()]


def asked(
    name: str,
    parameters: Mapping[str, Quantity],
    inputs: Mapping[str, Quantity],
    given: Mapping[str, Any],
) -> Asked:
    """Options, parameters and inputs among keywords; a name that is none of them is an error."""
    found: Asked = {
        "options": [],
        "parameters": texts(given.get("parameters") or {}),
        "inputs": texts(given.get("inputs") or {}),
        "signals": signals(given.get("signals")),
        "every": given.get("every"),
        "allow_unstable": bool(given.get("allow_unstable", False)),
    }
    for key, value in given.items():
        if key in OTHERS or value is None:
            continue
        if key in OPTIONS:
            found["options"].append((key.replace("_", "-"), text(value)))
        elif key in parameters:
            found["parameters"].append((key, text(value)))
        elif key in inputs:
            found["inputs"].append((key, text(value)))
        else:
            raise Error(unknown(name, key, [*parameters, *inputs]))
    return found


def unknown(mechanism: str, key: str, known: Sequence[str]) -> str:
    """What to say of a keyword without a meaning."""
    import difflib

    near = difflib.get_close_matches(key, [*known, *OPTIONS, *OTHERS], 1)
    meant = f", did you mean `{near[0]}`?" if near else ""
    listed = f"its parameters and inputs are {', '.join(known)}" if known else "it has no parameters and inputs"
    return f"{mechanism} has no parameter or input `{key}`, nor is that an option{meant} ({listed})"


def signals(given: Mapping[str, Any] | None) -> tuple[list[float], list[tuple[str, list[float]]]] | None:
    """Inputs that change: the times under ``t``, and each input at them."""
    if given is None:
        return None
    columns = {str(name): numbers(values) for name, values in given.items()}
    if "t" not in columns:
        raise Error("signals have no column `t` with the times in s")
    return columns.pop("t"), list(columns.items())
