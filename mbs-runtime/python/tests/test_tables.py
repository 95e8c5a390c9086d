"""Tables beside SciPy, at a thousand places each."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest
from scipy.interpolate import CubicSpline, PchipInterpolator, RegularGridInterpolator, interp1d

import mbs

GENERATOR = np.random.default_rng(7)
X = np.concatenate(([-2.0], np.sort(GENERATOR.uniform(-2.0, 3.0, 38)), [3.0]))
Y = GENERATOR.uniform(-5.0, 5.0, X.size)
CLOSED = np.concatenate((Y[:-1], Y[:1]))
A, B = X[::4], X[1::3]
GRID = GENERATOR.uniform(-5.0, 5.0, (A.size, B.size))


def cubic(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    """The product of natural splines."""
    along = CubicSpline(A, GRID, axis=0, bc_type="natural")(x)
    return np.array([CubicSpline(B, row, bc_type="natural")(at) for row, at in zip(along, y)])


def bilinear(x: np.ndarray, y: np.ndarray) -> np.ndarray:
    return RegularGridInterpolator((A, B), GRID)(np.column_stack((x, y)))


CURVES = {
    "linear outside extend": (Y, interp1d(X, Y)),
    "cubic outside hold": (Y, CubicSpline(X, Y, bc_type="natural")),
    "cubic outside periodic": (CLOSED, CubicSpline(X, CLOSED, bc_type="periodic")),
    "monotone outside refuse": (Y, PchipInterpolator(X, Y)),
    "step outside hold": (Y, interp1d(X, Y, kind="previous")),
}
MAPS = {"linear outside extend": bilinear, "cubic outside hold": cubic}


def seen(table: str, arguments: str, folder: Path) -> mbs.Run:
    """A run that looks at a thousand places, 0.2 % apart."""
    text = f"""Looked {{
        dof = 0;
        {table}
        state s [1] = 0;
        der(s) = 1 [1/s];
        let x = -1.999 + 4.99*t/1 [s];
        let y = -1.2 + 3.7*sin(9*t/1 [s])^2;
        output x = x;
        output y = y;
        output f = f({arguments});
    }}"""
    (folder / "looked.mbs").write_text(text)
    return mbs.compile(folder / "looked.mbs").simulate(end=1.0, step=1e-3)


# of 5, the largest value: some hundred roundings
CLOSE = 1e-13 * 5.0


@pytest.mark.parametrize("kind", CURVES)
def test_a_curve_is_that_of_scipy(kind, tmp_path):
    values, expected = CURVES[kind]
    points = ", ".join(f"({x!r}, {y!r})" for x, y in zip(X.tolist(), values.tolist()))
    run = seen(f"table f(x) = [{points}] {kind};", "x", tmp_path)
    assert len(run["f"]) > 1000
    np.testing.assert_allclose(run["f"], expected(run["x"]), rtol=0, atol=CLOSE)


@pytest.mark.parametrize("kind", MAPS)
def test_a_map_of_a_file_is_that_of_scipy(kind, tmp_path):
    rows = [f"{a!r},{b!r},{GRID[i, j].item()!r}" for i, a in enumerate(A.tolist()) for j, b in enumerate(B.tolist())]
    (tmp_path / "map.csv").write_text("\n".join(["x,y,f", *rows]))
    run = seen(f'table f(x, y) = from "map.csv" {kind};', "x, y", tmp_path)
    inside = run["x"] <= A[-1]
    assert inside.sum() > 900
    x, y = np.asarray(run["x"])[inside], np.asarray(run["y"])[inside]
    np.testing.assert_allclose(np.asarray(run["f"])[inside], MAPS[kind](x, y), rtol=0, atol=CLOSE)
