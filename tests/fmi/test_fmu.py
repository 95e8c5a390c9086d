"""Functional mock-up units in FMPy: valid, with the numbers of the program, exact derivatives, and states
that are saved and restored. What the standard says is taken from the schemas and headers that FMPy brings."""

import ctypes
import math
import pathlib
import re
import shutil
import subprocess
import zipfile

import fmpy
import pytest
from fmpy.fmi2 import FMU2Model, FMU2Slave, fmi2CallbackFunctions, fmi2CallbackLoggerTYPE
from fmpy.fmi3 import FMU3Model, FMU3Slave
from fmpy.validation import validate_fmu

VERSIONS = [2, 3]
HEADERS = pathlib.Path(fmpy.__file__).parent / "c-code"
END, INTERVAL = 0.2, 0.01


def variables(path) -> dict:
    return {variable.name: variable for variable in fmpy.read_model_description(path).modelVariables}


@pytest.mark.parametrize("version", VERSIONS)
def test_it_is_valid(export, version):
    assert validate_fmu(str(export.paths[version])) == []


@pytest.mark.parametrize("version", VERSIONS)
def test_co_simulation_has_the_bits_of_the_program(export, version):
    same_bits(export.paths[version], export.native(END, round(INTERVAL / export.step)))


def same_bits(path: pathlib.Path, native: dict[str, list[float]]) -> None:
    known = variables(path)
    names = [name for name in native if name in known and name != "t"]
    assert len(names) > 4
    result = fmpy.simulate_fmu(
        str(path), fmi_type="CoSimulation", stop_time=END, output_interval=INTERVAL, output=names
    )
    assert len(result) == len(native["t"]) == 21
    for name in names:
        scaled = known[name].displayUnit is not None
        for ours, theirs in zip(native[name], result[name]):
            # what has a display unit is divided by it in the table
            if scaled:
                factor = 1.0 / display_scale(path, known[name])
                assert math.isclose(ours * factor, theirs, rel_tol=1e-14, abs_tol=1e-300), name
            else:
                assert ours == theirs, name


def display_scale(path, variable) -> float:
    for unit in fmpy.read_model_description(path).unitDefinitions:
        for display in unit.displayUnits:
            if unit.name == variable.unit and display.name == variable.displayUnit:
                return display.factor
    raise AssertionError(variable.name)


@pytest.mark.parametrize("version", VERSIONS)
def test_impacts_and_rests_have_the_bits_of_the_program(stopped, version):
    native = stopped.native(END, round(INTERVAL / stopped.step), "--method", "heun")
    assert native["pressed"][-1] == 1.0 and native["y"][-1] == 0.0
    same_bits(stopped.paths[version], native)


@pytest.mark.parametrize("version", VERSIONS)
def test_stops_are_for_co_simulation(stopped, version, tmp_path):
    description = fmpy.read_model_description(stopped.paths[version])
    assert validate_fmu(str(stopped.paths[version])) == []
    assert description.modelExchange is None
    assert not description.coSimulation.providesDirectionalDerivative
    # what an impact leads to is saved with the state
    test_a_state_is_saved_restored_and_serialized(stopped, version, tmp_path)
    test_the_code_agrees_with_the_headers_of_the_standard(stopped, tmp_path / "code")


@pytest.mark.parametrize("version", VERSIONS)
def test_model_exchange_comes_to_the_same_motion(export, version):
    """CVode to 1e-8 against steps of 0.1 ms, whose error is of second order: 100 h² v'' t² at most."""
    path = str(export.paths[version])
    names = [name for name in variables(path) if re.fullmatch(r"\w+", name) and name != "time"]
    states = [name for name in names if f"der({name})" in variables(path)]
    runs = [
        fmpy.simulate_fmu(
            path, fmi_type=kind, stop_time=END, output_interval=INTERVAL, output=states, relative_tolerance=1e-8
        )
        for kind in ("CoSimulation", "ModelExchange")
    ]
    # at a sample there is a row before it and one behind it
    runs = [run[[*(run["time"][1:] > run["time"][:-1]), True]] for run in runs]
    for name in states:
        span = max(abs(runs[0][name])) + 1.0
        assert max(abs(runs[0][name] - runs[1][name])) < 2e-5 * span, name
    # and with its own step by Euler's method, which the feedback has to bear
    euler = fmpy.simulate_fmu(
        path, fmi_type="ModelExchange", solver="Euler", step_size=export.step, stop_time=0.02, output=states
    )
    assert all(math.isfinite(euler[name][-1]) for name in states)


def test_communication_steps_of_any_length(crank):
    """Steps that are no multiple of the internal one end where they should, with the order of the method."""
    path = str(crank.paths[3])
    fine = fmpy.simulate_fmu(path, fmi_type="CoSimulation", stop_time=0.1, output_interval=0.1, output=["theta1"])
    for interval in (0.1 / 7, 0.1 / 333, 0.3e-4):
        odd = fmpy.simulate_fmu(
            path, fmi_type="CoSimulation", stop_time=0.1, output_interval=interval, output=["theta1"]
        )
        assert abs(odd["time"][-1] - 0.1) < 1e-9
        # the error of steps of 0.1 ms is 2e-7 here
        assert abs(odd["theta1"][-1] - fine["theta1"][-1]) < 4e-7


def test_a_run_that_starts_later_is_the_same(export):
    path = str(export.paths[3])
    name = next(name for name in variables(path) if f"der({name})" in variables(path))
    here, later = (
        fmpy.simulate_fmu(
            path, fmi_type="CoSimulation", start_time=start, stop_time=start + 0.1, output_interval=0.01,
            output=[name],
        )
        for start in (0.0, 4.0)
    )
    # drives are read at times that agree to the rounding of 4 s, which β² = 1e8/s² makes accelerations of
    rounding = 4 * 2.2e-16
    assert max(abs(here[name] - later[name])) < 1e8 * rounding * 0.1


def instance(path: pathlib.Path, folder: pathlib.Path, kind: str, messages: list | None = None):
    """An instance with its description and the value references by name."""
    folder = folder / f"{path.stem}_{kind}"
    if not folder.exists():
        fmpy.extract(str(path), str(folder))
    description = fmpy.read_model_description(str(folder))
    classes = {
        ("2.0", "CoSimulation"): FMU2Slave, ("2.0", "ModelExchange"): FMU2Model,
        ("3.0", "CoSimulation"): FMU3Slave, ("3.0", "ModelExchange"): FMU3Model,
    }
    identifier = description.coSimulation.modelIdentifier
    fmu = classes[description.fmiVersion, kind](
        guid=description.guid, unzipDirectory=str(folder), modelIdentifier=identifier, instanceName="it"
    )
    references = {variable.name: variable.valueReference for variable in description.modelVariables}
    said = messages if messages is not None else []
    if description.fmiVersion == "2.0":
        callbacks = fmi2CallbackFunctions()
        callbacks.logger = fmi2CallbackLoggerTYPE(lambda c, n, s, k, message: said.append(message.decode()))
        fmu.instantiate(callbacks=callbacks)
    else:
        fmu.instantiate(logMessage=lambda c, s, k, message: said.append(message.decode()))
    return fmu, description, references


def begin(fmu, version: int, start: float = 0.0) -> None:
    if version == 2:
        fmu.setupExperiment(startTime=start)
        fmu.enterInitializationMode()
    else:
        fmu.enterInitializationMode(startTime=start)


def values(fmu, version: int, references: list[int]) -> list[float]:
    return list(fmu.getReal(references) if version == 2 else fmu.getFloat64(references))


def put(fmu, version: int, references: list[int], numbers: list[float]) -> None:
    fmu.setReal(references, numbers) if version == 2 else fmu.setFloat64(references, numbers)


@pytest.mark.parametrize("version", VERSIONS)
def test_directional_derivatives_are_those_of_differences(export, version, tmp_path):
    """Of derivatives and outputs by states and inputs, each known by itself, in model exchange."""
    fmu, description, references = instance(export.paths[version], tmp_path, "ModelExchange")
    begin(fmu, version)
    fmu.exitInitializationMode()
    count = len(description.derivatives)
    inputs = [v.valueReference for v in description.modelVariables if v.causality == "input"]
    fmu.enterContinuousTimeMode()
    slopes = (ctypes.c_double * count)()
    derive = fmu.getDerivatives if version == 2 else fmu.getContinuousStateDerivatives
    # in motion: a table may have a kink at the start
    known_states = [unknown.variable.derivative for unknown in description.derivatives]
    moment = 0.0123
    motion = fmpy.simulate_fmu(
        str(export.paths[version]), fmi_type="CoSimulation", stop_time=moment, output_interval=moment,
        output=[state.name for state in known_states],
    )
    at = [float(motion[state.name][-1]) for state in known_states]
    fmu.setTime(moment)
    fmu.setContinuousStates((ctypes.c_double * count)(*at), count)
    of_states = [state.valueReference for state in known_states]
    unknowns = [variable.variable.valueReference for variable in description.derivatives]
    outputs = [variable.variable.valueReference for variable in description.outputs]
    put(fmu, version, inputs, [0.3] * len(inputs))

    def all_results() -> list[float]:
        derive(slopes, count)
        return list(slopes) + values(fmu, version, outputs)

    def along(known: int) -> list[float]:
        return list(fmu.getDirectionalDerivative(unknowns + outputs, [known], [1.0]))

    # central differences: their error is that of rounding over 2 d, and d² times a third derivative
    distance = 1e-5
    for place, known in enumerate(of_states):
        sides = []
        for sign in (1, -1):
            moved = (ctypes.c_double * count)(*at)
            moved[place] += sign * distance
            fmu.setContinuousStates(moved, count)
            sides.append(all_results())
        fmu.setContinuousStates((ctypes.c_double * count)(*at), count)
        compare(along(known), sides, distance)
    for known in inputs:
        sides = []
        for sign in (1, -1):
            put(fmu, version, [known], [0.3 + sign * distance])
            sides.append(all_results())
        put(fmu, version, [known], [0.3])
        compare(along(known), sides, distance)
    if version == 3 and inputs:
        seed = [1.0 + k for k in range(len(unknowns + outputs))]
        backward = fmu.getAdjointDerivative(unknowns + outputs, inputs, seed, nSensitivity=len(inputs))
        for known, found in zip(inputs, backward):
            assert math.isclose(found, sum(a * b for a, b in zip(seed, along(known))), rel_tol=1e-12, abs_tol=1e-9)
    fmu.terminate()
    fmu.freeInstance()


def compare(exact: list[float], sides: list[list[float]], distance: float) -> None:
    scale = max(1.0, max(abs(x) for x in exact))
    for found, above, below in zip(exact, *sides):
        difference = (above - below) / (2 * distance)
        size = scale + max(abs(above), abs(below)) * 1e-11 / distance
        assert abs(found - difference) < 1e-5 * size, (found, difference)


@pytest.mark.parametrize("version", VERSIONS)
def test_a_state_is_saved_restored_and_serialized(export, version, tmp_path):
    fmu, description, references = instance(export.paths[version], tmp_path, "CoSimulation")
    begin(fmu, version)
    fmu.exitInitializationMode()
    names = [v.valueReference for v in description.modelVariables if v.causality in ("output", "local")]

    def advance(start: int, end: int) -> list[list[float]]:
        rows = []
        for k in range(start, end):
            fmu.doStep(currentCommunicationPoint=k * INTERVAL, communicationStepSize=INTERVAL)
            rows.append(values(fmu, version, names))
        return rows

    advance(0, 3)
    saved = fmu.getFMUState()
    first = advance(3, 6)
    data = fmu.serializeFMUState(saved)
    fmu.setFMUState(saved)
    assert advance(3, 6) == first
    fmu.freeFMUState(saved)
    # another instance, later, from the bytes alone
    other, _, _ = instance(export.paths[version], tmp_path, "CoSimulation")
    begin(other, version)
    other.exitInitializationMode()
    fmu.terminate()
    fmu.freeInstance()
    fmu = other
    saved = fmu.deserializeFMUState(data)
    fmu.setFMUState(saved)
    fmu.freeFMUState(saved)
    assert advance(3, 6) == first
    fmu.terminate()
    fmu.freeInstance()


@pytest.mark.parametrize("version", VERSIONS)
@pytest.mark.parametrize("kind", ["CoSimulation", "ModelExchange"])
def test_errors_are_in_the_words_of_the_mechanism(crank, version, kind, tmp_path):
    def refused(change, expected: str) -> None:
        said: list[str] = []
        fmu, _, references = instance(crank.paths[version], tmp_path, kind, said)
        begin(fmu, version)
        with pytest.raises(Exception):
            change(fmu, references)
            fmu.exitInitializationMode()
        assert any(expected in message for message in said), said
        fmu.freeInstance()

    refused(lambda fmu, at: put(fmu, version, [at["l1"]], [-0.1]), "l1: ")
    refused(lambda fmu, at: put(fmu, version, [at["m3"]], [math.nan]), "m3: a parameter is not finite")
    refused(lambda fmu, at: put(fmu, version, [at["x1"]], [1.0]), "only parameters and inputs can be set")
    refused(lambda fmu, at: values(fmu, version, [9999]), "there is no variable with the value reference 9999")
    refused(lambda fmu, at: put(fmu, version, [at["crank_torque"]], [math.inf]), "crank_torque: an input is not finite")
    refused(lambda fmu, at: fmu.terminate(), "cannot be called in initialization mode")


@pytest.mark.parametrize("version", VERSIONS)
def test_a_step_that_fails_says_why_and_when(driven, version, tmp_path):
    """A crank that is longer than its rod cannot be driven beyond asin(l2/l1)."""
    said: list[str] = []
    fmu, _, references = instance(driven.paths[version], tmp_path, "CoSimulation", said)
    begin(fmu, version)
    put(fmu, version, [references["l1"]], [0.2])
    fmu.exitInitializationMode()
    with pytest.raises(Exception):
        for k in range(100):
            fmu.doStep(currentCommunicationPoint=k * INTERVAL, communicationStepSize=INTERVAL)
    assert len(said) == 1 and said[0].startswith(("guide: ", "rod_y: ")), said
    assert "cannot be met any more" in said[0] or "singular" in said[0]
    assert 0.0 < values(fmu, version, [references["time"]])[0] < 1.0
    fmu.freeInstance()


@pytest.mark.parametrize("version", VERSIONS)
def test_a_parameter_of_a_constraint_is_fixed_once_a_run_has_begun(crank, version, tmp_path):
    known = variables(crank.paths[version])
    assert known["l1"].variability == "fixed" and known["m2"].variability == "tunable"
    # it has no place after the start
    assert known["omega"].variability == "fixed"
    said: list[str] = []
    fmu, _, references = instance(crank.paths[version], tmp_path, "CoSimulation", said)
    begin(fmu, version)
    put(fmu, version, [references["l1"]], [0.05])
    fmu.exitInitializationMode()
    # the crank points along the axis at the start
    assert math.isclose(values(fmu, version, [references["x3"]])[0], 0.23, rel_tol=1e-12)
    with pytest.raises(Exception):
        put(fmu, version, [references["l1"]], [0.06])
    assert said == ["the parameter l1 is fixed once a run has begun"]
    # a heavier rod is accelerated less, where it stands
    put(fmu, version, [references["crank_torque"]], [100.0])
    before = values(fmu, version, [references["x3"], references["der(theta1,2)"]])
    put(fmu, version, [references["m2"]], [10.0])
    after = values(fmu, version, [references["x3"], references["der(theta1,2)"]])
    assert after[0] == before[0] and 0.0 < after[1] < before[1]
    fmu.freeInstance()


def test_the_binary_exports_every_function_of_the_standard(crank, tmp_path):
    declared = set()
    for version in VERSIONS:
        text = (HEADERS / f"fmi{version}Functions.h").read_text()
        declared |= set(re.findall(rf"FMI{version}_Export\s+\w+\s+(fmi{version}\w+);", text))
        declared |= set(re.findall(rf"^FMI{version}_Export fmi{version}\w+TYPE\s+(fmi{version}\w+);", text, re.M))
    assert len(declared) > 100
    with zipfile.ZipFile(crank.paths[3]) as archive:
        name = next(name for name in archive.namelist() if name.endswith(".so"))
        archive.extract(name, tmp_path)
    table = subprocess.run(["nm", "-D", "--defined-only", tmp_path / name], capture_output=True, text=True, check=True)
    exported = {line.split()[-1] for line in table.stdout.splitlines()}
    assert declared <= exported
    # and nothing of its own, which another unit might have too
    assert {name for name in exported if not name.startswith("fmi")} <= {"_init", "_fini"}


def test_the_code_agrees_with_the_headers_of_the_standard(export, tmp_path):
    for compiler in ("gcc", "clang"):
        if shutil.which(compiler) is None:
            print(f"skipped: `{compiler}` is not on this machine")
            continue
        folder = tmp_path / compiler
        with zipfile.ZipFile(export.paths[2]) as archive:
            archive.extractall(folder)
        code = next((folder / "sources").glob("*_fmi.c"))
        flags = ["-std=c99", "-Wall", "-Wextra", "-Werror", "-DMBS_FMI_HEADERS", f"-I{HEADERS}"]
        done = subprocess.run([compiler, *flags, "-fsyntax-only", code], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
