"""Speed of the package: from text to arrays, steps in a loop, sweeps against the command line, two threads, a million
runs, a new interpreter.

Times are medians of some turns on this machine; the ratios are what means something.
"""

from __future__ import annotations

import json
import resource
import subprocess
import sys
import tempfile
import threading
import time
from pathlib import Path
from statistics import median

import numpy as np

import mbs

ROOT = Path(__file__).resolve().parents[3]
CRANK = ROOT / "models" / "src" / "slider_crank.rs"


def taken(work: object, turns: int) -> float:
    """The median time of some turns, in s."""
    times = []
    for _ in range(turns):
        begin = time.perf_counter()
        work()  # type: ignore[operator]
        times.append(time.perf_counter() - begin)
    return median(times)


def from_text() -> None:
    def work() -> None:
        mbs.compile(CRANK).simulate(0.6)["x3"]

    print(f"from text to arrays of 1200 steps: {1e3 * taken(work, 21):.1f} ms")


CART_POLE = """CartPole {
    dof = 2;
    gravity = (0, -9.81) [m/s^2];
    input push [N];
    body cart (x) { mass = 1 [kg]; }
    body pole (px, py, theta) { mass = 100 [g]; inertia = 2e-3 [kg*m^2]; }
    constraint pin_x: px = x + 250 [mm]*sin(theta);
    constraint pin_y: py = 250 [mm]*cos(theta);
    force hand on x = push;
    start { x = 0; guess py = 250 [mm]; theta = 0.05 [rad]; }
}"""


def loop() -> None:
    """Steps of a cart with a pole: one by one, a block at once, and environments side by side."""
    pole = mbs.compile(CART_POLE)
    run, many = pole.start(step="1 ms"), pole.start_many(4096, step="1 ms")
    count, pushes = 20_000, np.zeros(20_000)

    def one_by_one() -> None:
        run.reset()
        for push in pushes:
            run.step(push)

    def block() -> None:
        run.reset()
        run.advance(pushes)

    def side_by_side() -> None:
        for _ in range(5):
            many.step(pushes[:4096])

    one, together, beside = (taken(work, 7) for work in (one_by_one, block, side_by_side))
    print(
        f"steps of a cart with a pole in 1 s: {count / one:.2e} one by one, {count / together:.2e} in a block, "
        f"{5 * 4096 / beside:.2e} side by side"
    )


def sweeps() -> None:
    """The same 100,000 runs from Python and from the command line, in turns."""
    subprocess.run(["cargo", "build", "--release", "--quiet"], cwd=ROOT, check=True)
    crank = mbs.compile(CRANK)
    lengths, speeds = np.linspace(50, 80, 250), np.linspace(100, 300, 400)
    line = ["sweep", "slider-crank", "--param", "l1=50mm..80mm:250", "--param", "omega=100rpm..300rpm:400"]
    options = ["--end", "0.1s", "--json"]

    def python() -> None:
        crank.sweep(l1=lengths, omega=speeds, end=0.1, progress=False)

    def rust() -> None:
        found = subprocess.run([ROOT / "target/release/mbs", *line, *options], check=True, capture_output=True)
        json.loads(found.stdout)

    pairs = [(taken(rust, 1), taken(python, 1)) for _ in range(5)]
    ratio = median(a / b for a, b in pairs)
    print(f"throughput of a sweep: {ratio:.2f} × that of the command line")


def threads() -> None:
    """Two runs one after the other, and in two threads."""
    pendulum = mbs.compile(ROOT / "models" / "src" / "double_pendulum.rs")

    def run() -> None:
        pendulum.simulate(20.0, every=1000, progress=False)

    def both() -> None:
        pair = [threading.Thread(target=run) for _ in range(2)]
        for thread in pair:
            thread.start()
        for thread in pair:
            thread.join()

    def one_by_one() -> None:
        run()
        run()

    ratio = median(taken(one_by_one, 1) / taken(both, 1) for _ in range(7))
    print(f"two threads: {ratio:.2f} × one")


def a_million() -> None:
    """A million paired runs of random parameters: time and memory."""
    crank = mbs.compile(CRANK)
    count = 1_000_000
    generator = np.random.default_rng(1)
    lengths, speeds = generator.uniform(50, 80, count), generator.uniform(100, 300, count)
    before = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    begin = time.perf_counter()
    swept = crank.sweep(l1=lengths, omega=speeds, end=0.05, paired=True)
    took = time.perf_counter() - begin
    more = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
    print(f"{swept.count} runs of 100 steps: {took:.1f} s, {more / 1024:.0f} MB more")


def start() -> None:
    """A new interpreter."""
    with tempfile.TemporaryDirectory() as folder:
        took = taken(lambda: subprocess.run([sys.executable, "-c", "import mbs"], cwd=folder, check=True), 7)
    print(f"a new interpreter with the package: {1e3 * took:.0f} ms")


if __name__ == "__main__":
    for bench in (start, from_text, loop, threads, sweeps, a_million):
        bench()
