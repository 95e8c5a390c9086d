"""Functional mock-up units of mechanisms of the library, exported once for all tests."""

import csv
import os
import pathlib
import re
import subprocess

import pytest

ROOT = pathlib.Path(__file__).parents[2]
MBS = pathlib.Path(os.environ.get("CARGO_TARGET_DIR", ROOT / "target")) / "release" / "mbs"

# with an event and a state that is reduced, which the library has not
PENDULUM = """
/// A pendulum that is driven.
Pendulum {
    dof = 1;
    states = reduced;
    param length = 400 [mm] where length > 0;
    param friction = 0.02 [N*m*s];
    input drive_torque [N*mm];
    gravity = (0, -9.81) [m/s^2];
    body rod (x, y, phi) { mass = 2 [kg]; inertia = 0.01 [kg*m^2]; }
    point eye on rod = (-length, 0);
    revolute pivot (ground, rod.eye);
    torque drive on rod = drive_torque - friction*der(phi);
    start { phi = 0; guess x = length; guess y = 0; }
    output height [mm] = y;
    output support [N] = reaction(pivot);
    event bottom: x = 0 falling;
}
"""

# memories that are called as outputs, and a clock that begins elsewhere
SAMPLED = """
/// A slide that two clocks push.
Sampled {
    dof = 1;
    input target [m] = 0.1;
    body slide (x) { mass = 1 [kg]; }
    memory push [N] = 0;
    memory count [1] = 0;
    every 20 [ms] offset 0.35 [s] {
        set count = count + 1;
        set push = 40 [N/m]*(target - x) - 8 [N*s/m]*der(x);
    }
    every 10 [ms] { set push = 0.9*push; }
    force motor on x = push;
    output push [N] = push;
    output count = count;
    output left [m] = target - x;
}
"""

STOPPED = """
/// Two blocks, one above the other, that fall on a floor beside a wall.
Stopped {
    dof = 3;
    gravity = (0, -9.81) [m/s^2];
    body low (y) { mass = 1 [kg]; }
    body high (x = u, y = w) { mass = 2 [kg]; }
    input wind [N];
    force push on u = wind;
    stop floor: y >= 0 [m] { restitution = 0.5; }
    stop upper: w - y >= 0.02 [m] { restitution = 0.3; }
    stop wall: u <= 0.02 [m] { restitution = 0.8; }
    start { y = 2 [mm]; w = 25 [mm]; der(u) = 0.3 [m/s]; }
    output pressed = floor;
}
"""

MECHANISMS = ["slider-crank", "slider-crank-free", "cam-follower", "tipper", "n-pendulum-40", "pendulum-reduced", "sampled"]


class Export:
    """A mechanism with its units, by version."""

    step = 1e-4

    def __init__(self, name: str, folder: pathlib.Path) -> None:
        self.name, self.folder = name, folder
        self.model = self.native_model = name
        if name == "pendulum-reduced":
            self.model, self.native_model = (str(folder / file) for file in ("pendulum.mbs", "plain.mbs"))
            pathlib.Path(self.model).write_text(PENDULUM)
            # a run of the program that looks for events takes steps as long as it likes
            pathlib.Path(self.native_model).write_text(re.sub(" *event.*\n", "", PENDULUM))
        for other, text in (("sampled", SAMPLED), ("stopped", STOPPED)):
            if name == other:
                self.model = self.native_model = str(folder / f"{name}.mbs")
                pathlib.Path(self.model).write_text(text)
        command("export", "fmu", self.model, "--out", str(folder), "--step", f"{self.step}", "--end", "0.2s")
        self.paths = {version: next(folder.glob(f"*_fmi{version}.fmu")) for version in (2, 3)}

    def native(self, end: float, every: int, *options: str) -> dict[str, list[float]]:
        """The columns of a run of the program, without units in their names."""
        table = self.folder / "native.csv"
        command(
            "simulate", self.native_model, "--step", f"{self.step}", "--end", f"{end}", "--every", f"{every}",
            "--out", str(table), *options,
        )
        with table.open() as file:
            rows = list(csv.reader(file))
        names = [name.split(" [")[0] for name in rows[0]]
        return {name: [float(row[at]) for row in rows[1:]] for at, name in enumerate(names)}


def command(*arguments: str) -> str:
    done = subprocess.run([MBS, *arguments], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    return done.stdout


@pytest.fixture(scope="session", params=MECHANISMS)
def export(request: pytest.FixtureRequest, tmp_path_factory: pytest.TempPathFactory) -> Export:
    return Export(request.param, tmp_path_factory.mktemp(request.param))


@pytest.fixture(scope="session")
def driven(tmp_path_factory: pytest.TempPathFactory) -> Export:
    return Export("slider-crank", tmp_path_factory.mktemp("driven"))


@pytest.fixture(scope="session")
def crank(tmp_path_factory: pytest.TempPathFactory) -> Export:
    return Export("slider-crank-free", tmp_path_factory.mktemp("crank"))


@pytest.fixture(scope="session")
def stopped(tmp_path_factory: pytest.TempPathFactory) -> Export:
    return Export("stopped", tmp_path_factory.mktemp("stopped"))
