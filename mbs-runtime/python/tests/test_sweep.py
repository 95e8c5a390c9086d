"""Sweeps: the same numbers as runs and as the command line, progress, interruption, workers."""

from __future__ import annotations

import os
import signal
import subprocess
import sys
import textwrap
import threading
import time

import numpy as np
import pytest
from conftest import ROOT, columns

import mbs


def test_bits_of_the_command_line(library, command, tmp_path):
    lengths, speeds = np.linspace(50, 80, 4), ["100 rpm", "300 rpm"]
    swept = library("slider_crank").sweep(l1=lengths, omega=speeds, end=0.1)
    assert swept.low["drive_torque"].shape == (4, 2) and swept.count == 8
    for row, length in enumerate(lengths):
        set_length = ["--set", f"l1={float(length)!r}"]
        param = ["--param", "omega=100rpm..300rpm:2"]
        known = columns(command(tmp_path, "sweep", "slider-crank", *set_length, *param, "--end", "0.1s"))
        for what, found in (("min", swept.low), ("max", swept.high), ("final", swept.last)):
            np.testing.assert_array_equal(found["drive_torque"][row], known[f"{what} drive_torque [N*m]"])


def test_bits_of_runs(library):
    crank = library("slider_crank_free")
    swept = crank.sweep(l1=[55, 60, 65], m3=[1.0, 2.0], end=0.05, outputs=["x3", "motor_power"], crank_torque=0.1)
    for row, length in enumerate([55, 60, 65]):
        for column, mass in enumerate([1.0, 2.0]):
            run = crank.simulate(0.05, l1=length, m3=mass, crank_torque=0.1)
            for name in ("x3", "motor_power"):
                assert swept.low[name][row, column] == run[name].min()
                assert swept.high[name][row, column] == run[name].max()
                assert swept.last[name][row, column] == run[name][-1]


def test_paired_values_belong_together(library):
    crank = library("slider_crank")
    grid = crank.sweep(l1=[50, 60], omega=[100, 200], end=0.02)
    paired = crank.sweep(l1=[50, 60], omega=[100, 200], end=0.02, paired=True)
    np.testing.assert_array_equal(paired.peak["drive_torque"], np.diag(grid.peak["drive_torque"]))
    with pytest.raises(mbs.Error, match="as many values"):
        crank.sweep(l1=[50, 60], omega=[100], paired=True)


def test_runs_that_fail_are_told(library):
    swept = library("slider_crank").sweep(l2=[180, 20, 190], end=0.02)
    assert swept.failed == 1 and list(swept.failures) == [(1,)]
    assert np.isnan(swept.low["drive_torque"]).tolist() == [False, True, False]


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({}, "a sequence of values"),
        ({"l1": []}, "empty"),
        ({"l9": [1, 2]}, "l9"),
        ({"l1": [50, float("inf")]}, "l1"),
        ({"l1": ["5 mm", "3 s"]}, "3 s"),
        ({"l1": [50.0], "outputs": ["speed"]}, "speed"),
    ],
)
def test_refused(asked, message, library):
    with pytest.raises(mbs.Error, match=message):
        swept = library("slider_crank").sweep(**asked)
        # a value that one run refuses is a failure of that run
        raise mbs.Error(" ".join(swept.failures.values()))


def test_frames(library):
    swept = library("slider_crank").sweep(l1=[50, 60], omega=[100, 200, 300], end=0.02)
    frame = swept.to_pandas()
    assert len(frame) == 6 and list(frame)[:3] == ["l1", "omega", "min drive_torque"]
    dataset = swept.to_xarray()
    assert dataset["max drive_torque"].dims == ("l1", "omega")
    row = frame[(frame["l1"] == 60) & (frame["omega"] == 200)].iloc[0]
    assert row["max drive_torque"] == dataset["max drive_torque"].sel(l1=60, omega=200).item()


def test_progress_rises_to_the_end(library):
    told: list[tuple[int, int]] = []
    library("slider_crank").sweep(
        l1=np.linspace(50, 70, 4000), end=0.1, progress=lambda done, of: told.append((done, of))
    )
    assert told == sorted(told) and told[-1] == (4000, 4000)


def test_an_exception_of_the_progress_ends_the_sweep(library):
    def stop(done: int, of: int) -> None:
        raise RuntimeError("enough")

    # some minutes of work
    with pytest.raises(RuntimeError, match="enough"):
        library("slider_crank").sweep(l1=np.linspace(50, 70, 1_000_000), end=10.0, progress=stop)


def test_an_interruption_ends_the_sweep():
    script = textwrap.dedent(
        f"""
        import signal
        import numpy as np, mbs
        # a shell that runs the tests in the background lets them ignore interruptions
        signal.signal(signal.SIGINT, signal.default_int_handler)
        crank = mbs.compile({str(ROOT / "models/src/slider_crank.rs")!r})
        print("begun", flush=True)
        crank.sweep(l1=np.linspace(50, 70, 1_000_000), end=10.0, progress=False)
        """
    )
    process = subprocess.Popen([sys.executable, "-c", script], stdout=subprocess.PIPE, stderr=subprocess.PIPE)
    assert process.stdout is not None and process.stdout.readline() == b"begun\n"
    time.sleep(0.5)
    process.send_signal(signal.SIGINT)
    _, errors = process.communicate(timeout=60)
    assert b"KeyboardInterrupt" in errors


def test_other_threads_go_on_during_a_run(library):
    """The interpreter's lock is released: a run of another thread begins and ends while this one computes."""
    pendulum = library("double_pendulum")
    ended = threading.Event()

    def long() -> None:
        pendulum.simulate(60.0, every=1000, progress=False)
        ended.set()

    thread = threading.Thread(target=long)
    thread.start()
    short = 0
    while not ended.is_set():
        pendulum.simulate(0.01, progress=False)
        short += 1
    thread.join()
    assert short > 3


@pytest.fixture
def cluster():
    from distributed import Client, LocalCluster

    with (
        LocalCluster(n_workers=2, threads_per_worker=1, processes=True, dashboard_address=None) as cluster,
        Client(cluster) as client,
    ):
        yield client


def test_a_killed_worker_costs_nothing_but_its_share(library, cluster):
    crank = library("slider_crank_free")
    asked = {"l1": np.linspace(50, 70, 200), "m3": [1.0, 2.0, 3.0], "l2": 180.0, "end": 0.5, "crank_torque": 0.1}
    known = crank.sweep(**asked)
    told: list[int] = []

    def kill(done: int, of: int) -> None:
        if not told:
            worker = next(iter(cluster.run(os.getpid).values()))
            os.kill(worker, signal.SIGKILL)
        told.append(done)

    swept = crank.sweep(**asked, client=cluster, chunk=20, progress=kill)
    for name in known.low:
        for a, b in ((known.low, swept.low), (known.high, swept.high), (known.last, swept.last)):
            np.testing.assert_array_equal(a[name], b[name])
    # nothing lost, nothing twice
    assert told == [20 * at for at in range(1, 31)]
    assert (swept.failed, swept.failures) == (known.failed, known.failures)


def test_failures_of_workers_have_their_places(library, cluster):
    asked = {"l2": [180, 20, 190, 10, 200], "end": 0.02}
    crank = library("slider_crank")
    assert crank.sweep(**asked, client=cluster, chunk=2).failures == crank.sweep(**asked).failures
