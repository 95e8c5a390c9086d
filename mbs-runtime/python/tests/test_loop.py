"""Mechanisms in the loop of a program: steps one by one, in blocks and side by side, copies, states, messages."""

from __future__ import annotations

import copy
import pickle

import numpy as np
import pytest

import mbs

CART_POLE = """CartPole {
    dof = 2;
    /// Length of the pole
    param length = 500 [mm] where length > 0;
    gravity = (0, -9.81) [m/s^2];
    /// Force on the cart
    input push [N];
    body cart (x) { mass = 1 [kg]; }
    body pole (px, py, theta) { mass = 100 [g]; inertia = 0.1 [kg]*length^2/12; }
    constraint pin_x: px = x + length/2*sin(theta);
    constraint pin_y: py = length/2*cos(theta);
    force hand on x = push;
    start { x = 0; guess py = length/2; theta = 0.05 [rad]; }
    output tip [mm] = x + length*sin(theta);
}"""


@pytest.fixture(scope="module")
def pole() -> mbs.Mechanism:
    return mbs.compile(CART_POLE)


@pytest.fixture(scope="module")
def pendulum() -> mbs.Mechanism:
    """A weight on a rod, in coordinates that a constraint ties together."""
    return mbs.compile(
        """Pendulum {
            dof = 1;
            param length = 1 [m];
            gravity = (0, -9.81) [m/s^2];
            body bob (x, y) { mass = 2 [kg]; }
            constraint rod: x^2 + y^2 = length^2;
            start { x = length; guess y = 0; }
            output tension [N] = 2*lambda(rod)*sqrt(x^2 + y^2);
        }"""
    )


METHODS = [{}, {"method": "rk4"}, {"method": "trbdf2"}, {"feedback": "projection"}, {"feedback": "per-stage"}]


@pytest.mark.parametrize("options", [*METHODS, {"rtol": 1e-8}])
def test_steps_are_those_of_a_run(options, pole):
    # a run to a tolerance ends a step of its own at its end
    recorded = pole.simulate(0.4, step="1 ms", push=2, **options)
    run = pole.start(step="1 ms", push=2, **options)
    for row in range(201):
        assert run.t == recorded.t[row]
        for place, name in enumerate(run.names):
            assert run.state[place] == recorded[name][row] == run[name]
        assert run["tip"] == run.outputs[0] == recorded["tip"][row]
        assert run["lambda(pin_x)"] == recorded["lambda(pin_x)"][row]
        if row < 200:
            run.step()
    assert run.units[0] == "m" and run.units[-1] == "rad/s"


def test_a_block_is_its_steps(pole):
    pushes = 5 * np.sin(np.arange(300))
    one, block = pole.start(step=2e-3), pole.start(step=2e-3)
    states, tips = block.advance(pushes, outputs=True)
    for push, state, tip in zip(pushes, states, tips):
        np.testing.assert_array_equal(one.step(push), state)
        assert one["tip"] == tip[0]
    assert one.steps == block.steps == 300
    np.testing.assert_array_equal(one.step(1.0, steps=50), block.advance(np.ones(50))[-1])


def test_inputs_hold_and_have_their_units(pole):
    a, b, c, d = (pole.start(step="1 ms") for _ in range(4))
    a.step(3)
    b.step({"push": "0.003 kN"})
    c.inputs = [3.0]
    c.step()
    d.step(np.float64(3))
    a.step()
    b.step()
    assert a.inputs == [3.0] and a["push"] == 3.0
    np.testing.assert_array_equal(a.state, b.state)
    np.testing.assert_array_equal(c.state, d.state)
    assert pole.start(push="2 N").inputs == [2.0]


def test_starts_from_any_state(pole, pendulum):
    run = pole.start(step="1 ms", x=0.3, theta="10 deg", state={"der(theta)": 1})
    assert run["x"] == 0.3 and run["theta"] == np.deg2rad(10.0) and run["der(theta)"] == 1.0
    # the others follow
    assert run["px"] == pytest.approx(0.3 + 0.25 * np.sin(run["theta"]), abs=1e-15)
    assert run["der(py)"] == pytest.approx(-0.25 * np.sin(run["theta"]), abs=1e-15)
    recorded = pole.simulate(0.01, step="1 ms", x=0.3, theta="10 deg", state={"der(theta)": 1})
    np.testing.assert_array_equal(run.step(steps=10), [recorded[name][-1] for name in run.names])
    # a coordinate that the declaration only guesses keeps its value too
    swing = pendulum.start(y=-0.6)
    assert swing["y"] == -0.6 and swing["x"] == pytest.approx(0.8, abs=1e-15)
    swing = pendulum.start(state={"x": 0.6, "y": -0.8, "der(x)": 0.4})
    assert swing["der(y)"] == pytest.approx(0.3, abs=1e-15)
    with pytest.raises(mbs.Error, match="rod"):
        pendulum.start(x=0.5, y=0.5)


def test_reset_goes_back_to_a_state(pole, pendulum):
    run = pole.start(step="1 ms")
    first = run.state
    later = run.step(4, steps=30)
    after = run.step()
    np.testing.assert_array_equal(run.reset(), first)
    assert run.t == 0 and run.steps == 0 and run.inputs == [0.0]
    np.testing.assert_array_equal(run.reset(later, t=0.03), later)
    assert run.t == 0.03
    np.testing.assert_array_equal(run.step(4), after)
    assert run.reset(theta=0.2)[3] == 0.2
    assert run.reset({"der(x)": 0.5})[4] == 0.5
    with pytest.raises(mbs.Error, match="rod"):
        pendulum.start().reset([0.5, 0.5, 0, 0])
    with pytest.raises(mbs.Error, match="4 numbers"):
        pendulum.start().reset([0.5, 0.5])


def sent(run):
    """The run in another process."""
    return pickle.loads(pickle.dumps(run))


@pytest.mark.parametrize("options", METHODS)
@pytest.mark.parametrize("again", [copy.copy, copy.deepcopy, sent])
def test_copies_go_on_to_the_same_bits(options, again, pole):
    run = pole.start(step="0.7 ms", length=400, **options)
    run.step(2.5, steps=33)
    other = again(run)
    a, b = run.step(steps=20), other.step(steps=20)
    if options.get("method") == "trbdf2" and again is sent:
        # its steps begin with the acceleration that the last one ended with, not with that of the state
        np.testing.assert_allclose(a, b, rtol=0, atol=1e-10)
    else:
        np.testing.assert_array_equal(a, b)
    assert (run.t, run.steps) == (other.t, other.steps)
    run.step(steps=5)
    assert other.steps == 53
    np.testing.assert_array_equal(run.reset(), other.reset())


def test_a_run_to_a_tolerance_is_copied_too(pole):
    run = pole.start(step="10 ms", rtol=1e-9)
    run.step(1, steps=10)
    other, sent = copy.copy(run), pickle.loads(pickle.dumps(run))
    a = run.step(steps=10)
    np.testing.assert_array_equal(a, other.step(steps=10))
    # it looks for the length of its steps anew
    np.testing.assert_allclose(a, sent.step(steps=10), rtol=0, atol=1e-8)


def test_side_by_side_are_the_same_bits(pole):
    angles, lengths = np.linspace(-0.2, 0.2, 100), np.linspace(300, 600, 100)
    pushes = np.random.default_rng(1).normal(size=(20, 100))
    many = pole.start_many(100, step="2 ms", theta=angles, length=lengths)
    assert len(many) == 100 and many.state.shape == (100, 8)
    alone = [pole.start(step="2 ms", theta=angle, length=length) for angle, length in zip(angles, lengths)]
    for row in pushes:
        states = many.step(row)
        np.testing.assert_array_equal(states, [run.step(push) for run, push in zip(alone, row)])
    np.testing.assert_array_equal(many.outputs[:, 0], [run["tip"] for run in alone])
    sent, other = pickle.loads(pickle.dumps(many)), many.copy()
    for runs in (sent, other):
        np.testing.assert_array_equal(runs.step(0.5, steps=3), many.copy().step([0.5], steps=3))
    again = many.reset(angles > 0)
    assert (many.t[angles > 0] == 0).all() and (many.t[angles < 0] > 0.03).all()
    np.testing.assert_array_equal(again[angles < 0], states[angles < 0])
    np.testing.assert_array_equal(many.reset([3], state=states[3])[3], states[3])


def test_a_run_that_fails_leaves_the_others():
    heavy = mbs.compile(
        """Root {
            dof = 1;
            input pull [N];
            body b (x) { mass = 1 [kg]; }
            force all on x = pull + 1 [N]*sqrt(x/(1 [m]));
            start { x = 1 [m]; }
        }"""
    )
    many = heavy.start_many(3, step="10 ms")
    states = many.step([0.0, -100.0, 0.0], steps=100)
    assert np.isfinite(states[[0, 2]]).all() and np.isnan(states[1]).all()
    assert list(many.failures) == [1] and "1 of which failed" in repr(many)
    # Regression: a failed run was sent without its failure, and went on.
    sent = pickle.loads(pickle.dumps(many))
    assert sent.failures == many.failures and np.isnan(sent.step()[1]).all()
    assert np.isfinite(many.reset([1])).all() and not many.failures
    run = heavy.start(step="10 ms")
    with pytest.raises(mbs.Error):
        run.step(-100, steps=100)
    # the last good state
    assert np.isfinite(run.state).all() and 0 < run.steps < 100


def test_a_run_pickles(pole):
    run = pole.simulate(0.1, theta=0.1)
    sent = pickle.loads(pickle.dumps(run))
    for name in run:
        np.testing.assert_array_equal(run[name], sent[name])
    assert sent.summary == run.summary and sent.units == run.units
    assert sent.page() == run.page()


def test_columns(pole):
    run = pole.simulate(0.1, columns=["theta", "lambda(*)", "tip"])
    assert list(run) == ["t", "theta", "lambda(pin_x)", "lambda(pin_y)", "tip"]
    np.testing.assert_array_equal(run["tip"], pole.simulate(0.1)["tip"])
    with pytest.raises(mbs.Error, match="tipp"):
        pole.simulate(0.1, columns=["tipp"])


def test_a_refused_input_is_not_held(pole):
    run = pole.start(step="1 ms", push=2)
    with pytest.raises(mbs.Error, match="push"):
        run.step(float("nan"))
    with pytest.raises(mbs.Error, match="push"):
        run.advance([0.0, float("inf")])
    assert run.inputs == [2.0] and run.steps == 0
    assert np.isfinite(run.step()).all()


def test_a_declared_start_is_left_as_it_is(pendulum):
    assert pendulum.start(y=-0.6, start="declared")["x"] == 1.0


@pytest.mark.parametrize(
    ("call", "message"),
    [
        (lambda m: m.start(until="x > 1"), "`until` is an option of `simulate`"),
        (lambda m: m.start().step(steps=-1), "`steps` is a whole number"),
        (lambda m: m.start().step(steps=1.5), "`steps` is a whole number"),
        (lambda m: m.start().advance(3), "a row for each"),
        (lambda m: m.start().reset(t=1), "`t` goes with a whole state"),
        (lambda m: m.start().reset([np.nan] * 8), "finite"),
        (lambda m: m.start_many(-1), "`count` is a whole number"),
        (lambda m: m.start_many(2, push=[1, 2]), "`push` of each run is given to `step`"),
        (lambda m: m.start_many(2, x=[1, 2], state={"x": [1, 2]}), "`x` is given twice"),
        (lambda m: m.start_many(2, x=[1, np.inf]), "`x` of run 1 is inf"),
        (lambda m: m.start_many(2, x=["1 cm", "2 cm"]), "`x` of some runs are numbers"),
        (lambda m: m.start_many(2).reset([0.0, 1.0]), "truth values or indices"),
        (lambda m: m.start(state=np.zeros(2)), "are a dict"),
        (lambda m: m.start(parameters={"push": 3}), "`push` cannot be used: it is an input, and no parameter; give `push=3.0`"),
        (lambda m: m.start(y=0.1), "no parameter, input or coordinate `y`.*did you mean `py`"),
        (lambda m: m.start(step=[1, 2]), "`step` is a number or a text"),
        (lambda m: m.start(length=np.zeros(3)), r"`length` is .*shape \(3,\)"),
        (lambda m: m.simulate(length=[1, 2]), "`length`.*`sweep`"),
        (lambda m: m.simulate(end={}), "`end`"),
        (lambda m: m.simulate(every=2.5), "`every` is a whole number"),
        (lambda m: m.simulate(every=0), "`every` is a whole number"),
        (lambda m: m.simulate(1e9), "every="),
        (lambda m: m.simulate(parameters=3), "parameters are a dict"),
        (lambda m: m.simulate(signals=[1, 2]), "signals are a dict"),
        (lambda m: m.simulate(columns="tip"), "columns are a list"),
        (lambda m: m.start().step([1, 2]), "one input, `push`.*list of 2"),
        (lambda m: m.start().step("3 N"), "one input, `push`"),
        (lambda m: m.start().step({"pull": 3}), "pull"),
        (lambda m: m.start().step({"push": []}), "`push` takes a number"),
        (lambda m: m.start().step({"push": "3 mm"}), "length"),
        (lambda m: m.start().step(float("nan")), "push"),
        (lambda m: m.start()["y"], "theta"),
        (lambda m: m.start().advance(np.zeros((3, 2))), r"\(3, 2\)"),
        (lambda m: m.start_many(3, theta=[0, 1]), "`theta` has 2 values for 3 runs"),
        (lambda m: m.start_many(3).step(np.zeros(2)), r"shape \(3, 1\)"),
        (lambda m: m.start_many(3).reset([5]), "3 runs"),
        (lambda m: m.start(method="runge"), "no method `runge`"),
        (lambda m: m.start(max_step=-1), "max_step"),
    ],
)
def test_messages_name_the_culprit(call, message, pole):
    with pytest.raises((mbs.Error, TypeError, KeyError), match=message) as caught:
        call(pole)
    assert "--" not in str(caught.value)
