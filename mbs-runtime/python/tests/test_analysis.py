"""Equilibria, linear systems, modes, gradients, fits and synthesis against closed forms."""

from __future__ import annotations

import numpy as np
import pytest

import mbs


def test_equilibrium(library):
    rest = library("double_pendulum").equilibrium()
    assert rest.stability == "stable" and rest.directions == 0
    up = library("double_pendulum").equilibrium(guess={"angle1": "170 deg"})
    assert up.stability == "unstable" and up.directions == 1
    # a drive holds it: what is found are its reactions
    assert library("slider_crank").equilibrium().stability == "stable"


def test_linear_system_and_modes(spring):
    linear = spring.linearize()
    a, b, c, d = linear
    # ẍ = push/m − k/m x − c/m ẋ with m = 2, c = 4, k = 200
    np.testing.assert_allclose(a, [[0, 1], [-100, -2]], rtol=1e-9, atol=1e-9)
    np.testing.assert_allclose(b, [[0], [0.5]], atol=1e-12)
    np.testing.assert_allclose(c, [[200, 4]], rtol=1e-9)
    np.testing.assert_allclose(d, [[0]], atol=1e-12)
    assert (linear.states, linear.inputs, linear.outputs) == (["x", "der(x)"], ["push"], ["wall"])
    (mode,) = spring.modes()
    assert mode.natural_frequency == pytest.approx(10.0) and mode.damping_ratio == pytest.approx(0.1)
    assert mode.eigenvalue == pytest.approx(-1 + 1j * np.sqrt(99)) and not mode.is_unstable
    softer = spring.modes(k=0.05)
    assert softer[0].natural_frequency == pytest.approx(5.0)


def test_responses(spring):
    linear = spring.linearize(outputs=["x"])
    omega = np.array([1.0, 10.0, 30.0])
    expected = 0.5 / (100 - omega**2 + 2j * omega)
    np.testing.assert_allclose(linear.response(omega)[:, 0, 0], expected, rtol=1e-9)
    scipy = linear.to_scipy()
    np.testing.assert_allclose(scipy.freqresp(omega)[1], expected, rtol=1e-9)
    times, outputs = linear.step_response("push", end=20.0)
    assert outputs[-1, 0] == pytest.approx(1 / 200, rel=1e-7) and times[-1] == 20.0
    with pytest.raises(mbs.Error, match="pull"):
        linear.step_response("pull", end=1.0)


def test_gradients_are_those_of_differences(library):
    crank = library("slider_crank_free")
    asked = {"crank_torque": 0.2, "rtol": 1e-11, "atol": 1e-13}
    by = ["l1", "l2", "m1", "m2", "m3", "theta1"]
    found = crank.gradients(["x3", "der(x3)"], by, times=[0.05, 0.1], **asked)
    assert found.jacobian.shape == (2, 2, 6) and found.units["l1"] == "mm"
    run = crank.simulate(0.1, step=0.05, **asked)
    np.testing.assert_allclose(found.values[:, 0], run["x3"][1:], rtol=1e-9)
    h = 1e-3
    for name in ("l1", "m3"):
        value = crank.parameters[name].value
        ends = [crank.simulate(0.1, step=0.05, parameters={name: value + s * h}, **asked)["x3"][1:] for s in (1, -1)]
        # the difference is of second order, and the runs are good to 1e-11
        np.testing.assert_allclose(found["x3"][name], (ends[0] - ends[1]) / (2 * h), rtol=1e-5, atol=1e-8)
    at_end = crank.gradients(["x3"], ["l1"], end="50 ms", **asked)
    assert at_end.t == [0.05]
    np.testing.assert_allclose(at_end["x3"]["l1"][0], found["x3"]["l1"][0], rtol=1e-6)
    with pytest.raises(mbs.Error, match="l9"):
        crank.gradients(["x3"], ["l9"])


def test_fit(spring):
    times = np.linspace(0, 2, 200)
    nu = np.sqrt(99)
    exact = 0.1 * (1 - np.exp(-times) * (np.cos(nu * times) + np.sin(nu * times) / nu))
    noisy = exact + np.random.default_rng(1).normal(0, 1e-3, times.size)
    noisy[17] = np.nan
    found = spring.fit({"t": times, "x": noisy, "push": np.full(200, 20.0)}, {"m": 3, "c": 2, "k": "0.3 N/mm"})
    for name, truth in (("m", 2.0), ("c", 4.0), ("k", 0.2)):
        estimate = found[name]
        assert abs(estimate.value - truth) < 4 * estimate.standard_error, estimate
    assert found.sigma["x"] == pytest.approx(1e-3, rel=0.2) and len(found.residuals["x"]) == 199
    assert found.covariance.shape == (3, 3)
    again = spring.simulate(0.5, push=20, **found.values_found)
    assert abs(again["x"] - np.interp(again.t, times, exact)).max() < 1e-3
    with pytest.warns(mbs.DoubtWarning, match="`c` ended at its bound"):
        spring.fit({"t": times, "x": exact}, {"c": 6}, bounds={"c": (5, None)}, push=20)
    # k, c and m alone scale with the force, which is 0 here
    with pytest.raises(mbs.Error, match="together"):
        spring.fit({"t": times, "x": exact}, ["m", "c", "k", "x"])


def test_synthesis(library):
    bars = mbs.compile(
        """FourBar {
            dof = 1;
            param a = 20 [mm] where a > 0; param b = 60 [mm] where b > 0;
            param c = 50 [mm] where c > 0; param d = 70 [mm] where d > 0;
            body crank (alpha) { inertia = 1 [kg*m^2]; }
            body rocker (beta) { inertia = 1 [kg*m^2]; }
            constraint coupler: (d + c*cos(beta) - a*cos(alpha))^2 + (c*sin(beta) - a*sin(alpha))^2 = b^2;
            start { alpha = 60 [deg]; guess beta = 80 [deg]; }
        }"""
    )
    # what the declared bars do at some angles of the crank
    known = bars.simulate(0.001)
    assert known["alpha"][0] == pytest.approx(np.pi / 3)
    angles = np.radians([30, 60, 90])
    wanted = []
    for angle in angles:
        rest = bars.linearize(guess={"alpha": float(angle)}, here=True, outputs=["beta"])
        wanted.append(float(rest.values[0]))
    between = {name: ("5 mm", "200 mm") for name in ("a", "b", "c")}
    found = bars.synthesize({"alpha": angles, "beta": wanted}, between, drive="alpha")
    assert found and found.linkages[0].missed < 1e-9
    with pytest.raises(mbs.Error, match="bounds|smaller"):
        bars.synthesize({"alpha": angles, "beta": wanted}, {"a": (5, 5)})


def test_searches_end_by_an_exception_of_their_progress(spring):
    def stop(done: int, of: int) -> None:
        raise RuntimeError("enough")

    bars = mbs.compile(
        """FourBar {
            dof = 1;
            param a = 20 [mm] where a > 0; param b = 60 [mm] where b > 0; param c = 50 [mm] where c > 0;
            body crank (alpha) { inertia = 1 [kg*m^2]; }
            body rocker (beta) { inertia = 1 [kg*m^2]; }
            constraint coupler:
                (70 [mm] + c*cos(beta) - a*cos(alpha))^2 + (c*sin(beta) - a*sin(alpha))^2 = b^2;
            start { alpha = 60 [deg]; guess beta = 80 [deg]; }
        }"""
    )
    angles = np.radians(np.arange(10, 200, 10))
    between = {name: ("5 mm", "200 mm") for name in ("a", "b", "c")}
    # no such function can be generated by three lengths, so that it would be looked for for minutes
    with pytest.raises(RuntimeError, match="enough"):
        bars.synthesize(
            {"alpha": angles, "beta": np.sin(5 * angles)}, between, drive="alpha", starts=10**7, progress=stop
        )
    times = np.linspace(0, 200, 200_000)
    with pytest.raises(RuntimeError, match="enough"):
        spring.fit({"t": times, "x": np.sin(3 * times)}, ["m", "c", "k", "x"], progress=stop)
