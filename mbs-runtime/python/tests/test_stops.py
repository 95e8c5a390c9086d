"""Stops: runs to a tolerance and with constant steps, sweeps, equilibria."""

from __future__ import annotations

import math

import numpy as np
import pytest

import mbs

TEXT = """
/// A ball that bounces on the floor and comes to rest.
Ball {
    dof = 1;
    param e = 0.7;
    gravity = (0, -9.81) [m/s^2];
    body ball (y) { mass = 2 [kg]; }
    stop floor: y >= 0 [m] { restitution = e; }
    output rests = floor;
    output place [m] = y;
    start { y = 1 [m]; }
}
"""


@pytest.fixture(scope="module")
def ball() -> mbs.Mechanism:
    return mbs.compile(TEXT)


def height(e: float) -> float:
    """At 1.5 s, after two impacts."""
    g, fall = 9.81, math.sqrt(2 / 9.81)
    speed, flown = e * e * g * fall, 1.5 - fall * (1 + 2 * e)
    return speed * flown - 0.5 * g * flown * flown


def test_runs_to_a_tolerance_find_impacts(ball):
    run = ball.simulate(1.5)
    assert abs(run["y"][-1] - height(0.7)) < 1e-5
    assert [event.name for event in run.events] == ["floor", "floor"]


def test_constant_steps_see_impacts_at_their_ends(ball):
    for step in (1e-3, 1e-4):
        run = ball.simulate(4.0, step=step, method="heun")
        # each impact is placed within its step
        assert abs(run["y"][round(1.5 / step)] - height(0.7)) < 2 * step * step
        assert run["y"][-1] == 0.0 and run["rests"][-1] == 1.0


def test_members_of_a_sweep_have_their_own_impacts(ball):
    # two impacts each
    restitutions = [0.69, 0.7, 0.75]
    swept = ball.sweep(e=restitutions, end=1.5, step=1e-4, method="heun")
    for at, e in enumerate(restitutions):
        run = ball.simulate(1.5, step=1e-4, method="heun", e=e)
        assert swept.last["place"][at] == run["place"][-1]
    np.testing.assert_allclose(swept.last["place"], [height(e) for e in restitutions], atol=1e-6)


def test_an_equilibrium_rests_on_stops(ball):
    rest = ball.equilibrium()
    assert rest["y"] == 0.0 and rest.stability == "stable"
    assert rest.rests == {"floor": pytest.approx(19.62)}
