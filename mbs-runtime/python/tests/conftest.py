"""What the tests share: the repository, its mechanisms, and the command line to compare with."""

from __future__ import annotations

import subprocess
from collections.abc import Callable
from pathlib import Path

import numpy as np
import pytest

import mbs

ROOT = Path(__file__).resolve().parents[3]


@pytest.fixture(scope="session")
def library() -> Callable[[str], mbs.Mechanism]:
    """Compiles a mechanism of the library, by the name of its file."""
    return lambda name: mbs.compile(ROOT / "models" / "src" / f"{name}.rs")


@pytest.fixture(scope="session")
def command() -> Callable[..., Path]:
    """Runs a command of ``mbs`` that writes a table, and gives the table."""
    subprocess.run(["cargo", "build", "--release", "--quiet"], cwd=ROOT, check=True)
    program = ROOT / "target" / "release" / "mbs"

    def run(folder: Path, *arguments: str) -> Path:
        table = folder / "out.csv"
        subprocess.run([program, *arguments, "--out", table], cwd=folder, check=True, stdout=subprocess.DEVNULL)
        return table

    return run


def columns(table: Path) -> dict[str, np.ndarray]:
    """The columns of a table by their headings; its numbers read back to the bit."""
    with table.open() as file:
        headings = file.readline().strip().split(",")
        rows = [line.strip().split(",") for line in file]
    return {
        heading: np.array([float(row[at]) for row in rows])
        for at, heading in enumerate(headings)
        if heading != "error"
    }


@pytest.fixture
def spring() -> mbs.Mechanism:
    """m ẍ + c ẋ + k x = push."""
    return mbs.compile(
        """Oscillator {
            dof = 1;
            param m = 2 [kg] where m > 0;
            param c = 4 [N*s/m] where c >= 0;
            param k = 0.2 [N/mm] where k > 0;
            input push [N];
            body block (x) { mass = m; }
            force all on x = push - k*x - c*der(x);
            start { x = 0; }
            output wall [N] = k*x + c*der(x);
        }"""
    )
