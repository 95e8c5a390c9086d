"""Sampled controllers: memories that clocks set, in runs, copies, pickles and sweeps."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import mbs

TEXT = """
Drive {
    dof = 1;
    method = rk4;
    step = 0.1 [ms];
    param period = 1 [ms] where period > 0;
    input wanted [rad/s] = 100;
    body rotor (angle = theta) { inertia = 1e-4 [kg*m^2]; }
    memory integral [rad] = 0;
    memory torque [N*m] = 0;
    every period {
        set integral = integral + (wanted - der(theta))*period;
        set torque = 0.01 [N*m*s]*(wanted - der(theta)) + 0.1 [N*m]*integral;
    }
    torque motor on rotor = torque;
    output torque [N*m] = torque;
}
"""


def reference(count: int, inertia: float = 1e-4) -> list[float]:
    """The torque from each sample on: between samples the rotor turns faster by torque·period/inertia."""
    speed, integral, torques = 0.0, 0.0, []
    for _ in range(count):
        integral += (100.0 - speed) * 1e-3
        torques.append(0.01 * (100.0 - speed) + 0.1 * integral)
        speed += torques[-1] * 1e-3 / inertia
    return torques


@pytest.fixture(scope="module")
def drive() -> mbs.Mechanism:
    return mbs.compile(TEXT)


def test_a_run_samples(drive):
    assert list(drive.memories) == ["integral", "torque"] and list(drive.inputs) == ["wanted"]
    for result in (drive.simulate(0.05), drive.simulate(0.05, rtol=1e-9)):
        np.testing.assert_allclose(result["torque"][::10][:50], reference(50), rtol=1e-9)
    with pytest.raises(mbs.Error, match="torque"):
        drive.simulate(0.05, inputs={"torque": 1.0})


def sent(run):
    """The run in another process."""
    return pickle.loads(pickle.dumps(run))


@pytest.mark.parametrize("options", [{}, {"rtol": 1e-9}])
@pytest.mark.parametrize("steps", [0, 7, 20])
def test_a_run_that_is_copied_takes_no_sample_twice(options, steps, drive):
    run = drive.start(step="0.1 ms", wanted=80, **options)
    run.step(steps=steps)
    others = [copy.copy(run), sent(run), sent(sent(run))]
    run.step({"wanted": 60}, steps=25)
    for other in others:
        other.step({"wanted": 60}, steps=25)
        # the length of the steps is looked for anew
        np.testing.assert_allclose(other.state, run.state, rtol=1e-7 if options else 0)
        np.testing.assert_allclose(other["torque"], run["torque"], rtol=1e-7 if options else 0)


def test_periods_are_swept(drive):
    swept = drive.sweep(period=["1 ms", "2 ms", "5 ms"], end=0.05)
    alone = [drive.simulate(0.05, period=period)["torque"][-1] for period in ("1 ms", "2 ms", "5 ms")]
    np.testing.assert_array_equal(swept.last["torque"], alone)
