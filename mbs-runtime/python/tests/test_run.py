"""Runs: the same numbers as at the command line, names, units, errors."""

from __future__ import annotations

import pickle
import warnings

import numpy as np
import pytest
from conftest import columns

import mbs

RUNS = {
    "slider_crank": ["--end", "0.2s", "--set", "omega=300rpm", "--set", "l1=65"],
    "slider_crank_free": ["--end", "0.2s", "--input", "crank_torque=300 N*mm", "--method", "rk4"],
    "four_bar_free": ["--end", "0.5s", "--rtol", "1e-8", "--step", "2ms"],
    "double_pendulum": ["--end", "0.5s", "--feedback", "projection", "--every", "7"],
    "spring_mass_damper": ["--end", "0.5s", "--method", "trbdf2"],
    "jansen": ["--end", "0.3s"],
    "tipper": ["--end", "0.3s"],
}


def keywords(options: list[str]) -> dict[str, object]:
    found: dict[str, object] = {}
    for option, value in zip(options[::2], options[1::2]):
        if option in ("--set", "--input"):
            name, text = value.split("=")
            found[name] = float(text) if text.isdecimal() else text
        else:
            found[option[2:].replace("-", "_")] = int(value) if option == "--every" else value
    return found


@pytest.mark.parametrize("name", RUNS)
def test_bits_of_the_command_line(name, library, command, tmp_path):
    known = columns(command(tmp_path, "simulate", name.replace("_", "-"), *RUNS[name]))
    run = library(name).simulate(**keywords(RUNS[name]))
    found = {f"{column} [{unit}]" if unit else column: run[column] for column, unit in run.units.items()}
    assert list(found) == list(known)
    for heading, values in known.items():
        np.testing.assert_array_equal(found[heading], values, err_msg=heading)


def test_names_and_units(library):
    crank = library("slider_crank")
    assert (crank.name, crank.dof) == ("SliderCrank", 0)
    assert crank.parameters["l1"][2:] == ("mm", 60.0)
    assert crank.outputs["drive_torque"].unit == "N*m"
    run = crank.simulate(end="50 ms")
    assert run.units["x3"] == "m" and run.units["lambda(rod_x)"] == "N"
    assert len(run) == len(list(run)) and "x3" in run
    assert run.t[-1] == pytest.approx(0.05, abs=1e-12)
    with pytest.raises(KeyError, match="x9.*drive_torque"):
        run["x9"]
    assert "degrees of freedom" in crank.explain() and "\\documentclass" in crank.latex()


def test_inputs_begin_at_their_declared_values():
    text = """Cart {
        dof = 1;
        input push [kN] = 4 [N];
        body cart (x) { mass = 2 [kg]; }
        force pushed on x = push;
        start { x = 0; }
    }"""
    cart = mbs.compile(text)
    assert cart.inputs["push"].value == pytest.approx(0.004, abs=1e-18)
    # x = ½ · 4 N/2 kg · t²
    assert cart.simulate(1.0, step=0.01)["x"][-1] == pytest.approx(1.0, abs=1e-12)
    assert cart.simulate(1.0, step=0.01, push=0)["x"][-1] == 0.0
    run = cart.start(step=0.01)
    assert run.step(steps=100)[0] == pytest.approx(1.0, abs=1e-12)
    run.step({"push": "1 kN"})
    run.reset()
    assert run.step(steps=100)[0] == pytest.approx(1.0, abs=1e-12)


def test_numbers_have_the_declared_unit(library):
    crank = library("slider_crank")
    a, b = crank.simulate(0.01, l1=65), crank.simulate(0.01, l1="0.065 m")
    np.testing.assert_array_equal(a["x3"], b["x3"])
    c = crank.simulate(0.01, parameters={"l1": np.float32(65.0)})
    np.testing.assert_array_equal(a["x3"], c["x3"])


@pytest.mark.parametrize(
    ("asked", "message"),
    [
        ({"omgea": 3}, "did you mean `omega`"),
        ({"omega": "3 mm"}, "length"),
        ({"omega": "fast"}, "not a number"),
        ({"omega": float("nan")}, "finite"),
        ({"method": "runge"}, "no method `runge`"),
        ({"rtol": 0.0}, "tolerance"),
        ({"step": -1}, "step"),
        ({"until": "x3"}, "condition"),
        ({"signals": {"t": [0, 1], "push": [0, 1]}}, "no input"),
        ({"parameters": {"l1": -5}}, "l1"),
        ({"rtol": 1e-6, "feedback": "held"}, "projection"),
    ],
)
def test_refused(asked, message, library):
    with pytest.raises(mbs.Error, match=message):
        library("slider_crank").simulate(**asked)


def test_mistakes_of_a_declaration():
    with pytest.raises(mbs.DeclarationError) as caught:
        mbs.compile("Crank {\n    dof = 1;\n    body wheel (phi { }\n}")
    assert "3 │     body wheel (phi { }" in str(caught.value)
    problem = caught.value.problems[0]
    assert (problem["line"], problem["column"]) == (4, 1)
    assert problem["notes"][0]["line"] == 3
    with pytest.raises(OSError):
        mbs.compile("missing.mbs")


def test_signals_and_events(spring):
    run = spring.simulate(2.0, signals={"t": [0.0, 0.1], "push": np.array([0.0, 20.0])}, until="x > 90 mm")
    assert run.events[-1].name == "x > 90 mm" and run.events[-1].rising
    assert run["x"][-1] == pytest.approx(0.09, abs=1e-12)
    with pytest.warns(mbs.DoubtWarning, match="x > 9"):
        spring.simulate(0.1, until="x > 9")


def test_signals_by_words(spring):
    times, values = [0.0, 0.25, 1.0], [500.0, 0.0, 500.0]
    run = spring.simulate(
        4.0, step=4.0, rtol=1e-6, k=1e-9, c=0, m=1000, signals={"t": times, "push": (values, "step outside periodic")}
    )
    # of 500 N for a quarter of every second the mean is 125 N
    assert run["der(x)"][-1] - run["der(x)"][0] == pytest.approx(0.5, abs=1e-6)
    with pytest.raises(mbs.Error, match="did you mean `cubic`"):
        spring.simulate(1.0, signals={"t": times, "push": (values, "cubc")})


def test_a_run_that_ends_early_keeps_what_it_did():
    out_of_reach = mbs.compile(
        """Rod {
            dof = 0;
            body bob (x, y) { mass = 1 [kg]; }
            constraint rod: x^2 + y^2 = 1 [m^2];
            drive pull: x = 0.5 [m] + 0.1 [m/s]*t;
            start { x = 0.5 [m]; guess y = 0.8 [m]; }
        }"""
    )
    with pytest.raises(mbs.EndedEarly, match="ended early") as caught:
        out_of_reach.simulate(10.0)
    # the rod lies level at 5 s
    assert caught.value.run.t[-1] == pytest.approx(5.0, abs=0.05)
    assert len(caught.value.run["x"]) == len(caught.value.run.t)


def test_frames(spring):
    run = spring.simulate(0.1, push=20)
    frame = run.to_pandas()
    assert frame.index.name == "t" and frame.attrs["units"]["x"] == "m"
    np.testing.assert_array_equal(frame["x"], run["x"])
    dataset = run.to_xarray()
    assert dataset["wall"].attrs["units"] == "N"
    np.testing.assert_array_equal(dataset["wall"], run["wall"])


def test_a_run_shows_itself_without_a_network(library):
    html = library("four_bar").simulate(0.1)._repr_html_()
    assert html.startswith("<iframe srcdoc=") and "canvas" in html
    assert 'src=&quot;http' not in html and 'href=&quot;http' not in html


def test_a_mechanism_can_be_sent(library):
    crank = library("slider_crank")
    copy = pickle.loads(pickle.dumps(crank))
    np.testing.assert_array_equal(crank.simulate(0.01)["x3"], copy.simulate(0.01)["x3"])


def test_a_mechanism_that_rustc_compiled(tmp_path):
    import typed

    text = mbs.compile(
        """Pendulum {
            dof = 1;
            param length = 500 [mm] where length > 0;
            gravity = (0, -9.81) [m/s^2];
            input push [N];
            body bob (x, y) { mass = 2 [kg]; }
            constraint rod: x^2 + y^2 = length^2;
            force hand on x = push;
            start { x = length; guess y = 0; }
            output tension [N] = 2*lambda(rod)*sqrt(x^2 + y^2);
        }"""
    )
    for asked in ({}, {"length": 400, "push": 3}, {"rtol": 1e-9}):
        a, b = typed.Pendulum.simulate(0.5, **asked), text.simulate(0.5, **asked)
        for name in b:
            np.testing.assert_array_equal(a[name], b[name], err_msg=name)
    with pytest.raises(mbs.Error, match="did you mean `length`"):
        typed.Pendulum.simulate(lenght=3)
    with pytest.raises(TypeError, match="compiled by rustc"):
        pickle.dumps(typed.Pendulum)


def test_nothing_is_said_where_there_is_no_doubt(library):
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        library("slider_crank").simulate(0.1)
