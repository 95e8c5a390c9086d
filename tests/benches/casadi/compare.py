"""Steps of generated solvers against CasADi's generated C, in one run.

    pip install casadi --target /tmp/casadi
    PYTHONPATH=/tmp/casadi python3 tests/benches/casadi/compare.py [--native]

The same mechanisms (absolute coordinates, the same numbers), the same step
(Heun's method, feedback of the violation in both stages), from the same start.
CasADi gets its numbers as constants, eliminates with each of its solvers that fits,
and the fastest counts; its C is compiled in one unit with the loop around it, by
gcc -O3. So is our own C, of the mechanisms of the library that stand alone in a file. All programs
are run in turns; medians of all rounds. `--native` builds both
for the processor at hand instead of the architecture's common ground.
"""

import argparse
import os
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

import casadi as ca

ROOT = Path(__file__).resolve().parents[3]
HERE = Path(__file__).resolve().parent
G = 9.81


class System:
    """Coordinates, masses, forces and constraints, as they are declared in `models`."""

    def __init__(self, h):
        self.h, self.t = h, ca.SX.sym("t")
        self.q, self.mass, self.force, self.rows, self.start = [], [], [], [], ([], [])

    def coordinate(self, mass, force=0.0, q=0.0, v=0.0):
        symbol = ca.SX.sym(f"q{len(self.q)}")
        self.q.append(symbol)
        self.mass.append(mass)
        self.force.append(force)
        self.start[0].append(q)
        self.start[1].append(v)
        return symbol

    def body(self, mass, inertia, q, v=(0.0, 0.0, 0.0)):
        return (
            self.coordinate(mass, 0.0, q[0], v[0]),
            self.coordinate(mass, -mass * G, q[1], v[1]),
            self.coordinate(inertia, 0.0, q[2], v[2]),
        )

    def close(self, a, b):
        self.rows += [a[0] - b[0], a[1] - b[1]]


def point(body, x, y):
    """A point of a body in the ground frame."""
    bx, by, angle = body
    c, s = ca.cos(angle), ca.sin(angle)
    return bx + (c * x if x else 0) - (s * y if y else 0), by + (s * x if x else 0) + (c * y if y else 0)


def slider_crank(driven):
    l1, l2, m1, m2, m3, omega = 0.06, 0.18, 0.5, 1.2, 2.0, 200 * 2 * ca.pi / 60
    s = System(0.5e-3)
    v2 = l1 / 2 * omega
    x1, y1, t1 = s.body(m1, m1 * l1**2 / 12, (l1 / 2, 0.0, 0.0), (0.0, v2, omega))
    x2, y2, t2 = s.body(m2, m2 * l2**2 / 12, (l1 + l2 / 2, 0.0, 0.0), (0.0, v2, -omega * l1 / l2))
    x3 = s.coordinate(m3, 0.0, l1 + l2)
    if driven:
        s.rows.append(t1 - omega * s.t)
    else:
        s.force[2] = 0.5
    s.rows += [
        x1 - l1 / 2 * ca.cos(t1),
        y1 - l1 / 2 * ca.sin(t1),
        x2 - l1 * ca.cos(t1) - l2 / 2 * ca.cos(t2),
        y2 - l1 * ca.sin(t1) - l2 / 2 * ca.sin(t2),
        l1 * ca.sin(t1) + l2 * ca.sin(t2),
        x3 - l1 * ca.cos(t1) - l2 * ca.cos(t2),
    ]
    return s


def pendulum(n):
    s = System(1e-3)
    release = 30 * ca.pi / 180
    above = (0.0, 0.0)
    for i in range(n):
        q = ((i + 0.5) * float(ca.sin(release)), -(i + 0.5) * float(ca.cos(release)), release)
        rod = s.body(1.0, 1 / 12, q)
        s.close(above, point(rod, 0, 0.5))
        above = point(rod, 0, -0.5)
    return s


def four_bar(n):
    s = System(1e-3)
    uprights = []
    for i in range(n + 1):
        upright = s.body(1.0, 1 / 12, (float(i), 0.5, ca.pi / 2), (0.5, 0.0, -1.0))
        s.close(point(upright, -0.5, 0), (float(i), 0.0))
        uprights.append(upright)
    for i in range(1, n + 1):
        bar = s.body(1.0, 1 / 12, (i - 0.5, 1.0, 0.0), (1.0, 0.0, 0.0))
        s.close(point(uprights[i - 1], 0.5, 0), point(bar, -0.5, 0))
        s.close(point(uprights[i], 0.5, 0), point(bar, 0.5, 0))
    return s


MODELS = {
    "driven": slider_crank(True),
    "free": slider_crank(False),
    **{f"pendulum {n}": pendulum(n) for n in (1, 10, 40)},
    **{f"four-bar {n}": four_bar(n) for n in (1, 10, 40)},
}


def equations(system):
    """q, v, q̈'s ingredients: M (its diagonal), Q, Φ_q, γ − 2αΦ̇ − β²Φ."""
    q, phi = ca.vertcat(*system.q), ca.vertcat(*system.rows)
    v = ca.SX.sym("v", len(system.q))
    phi_q = ca.jacobian(phi, q)
    phi_dot = ca.jtimes(phi, q, v) + ca.jacobian(phi, system.t)
    gamma = -ca.jtimes(ca.jtimes(phi, q, v), q, v)
    alpha, beta_squared = 1 / system.h, 2 / system.h**2
    return q, v, ca.DM(system.mass), ca.DM(system.force), phi_q, gamma - 2 * alpha * phi_dot - beta_squared * phi


def accelerations(system, solver):
    """q̈(t, q, v), eliminated by one of CasADi's solvers; None where it does not fit."""
    q, v, mass, force, phi_q, rhs = equations(system)
    n, m = q.numel(), rhs.numel()
    inverse = ca.diag(1 / mass)
    if solver == "kinematic":
        if n != m:
            return None
        a = ca.solve(phi_q, rhs)
    elif solver == "kkt":
        if n > 9:
            return None
        kkt = ca.vertcat(ca.horzcat(ca.diag(mass), phi_q.T), ca.horzcat(phi_q, ca.SX(m, m)))
        a = ca.solve(kkt, ca.vertcat(force, rhs))[:n]
    else:
        schur = ca.mtimes([phi_q, inverse, phi_q.T])
        right = ca.mtimes([phi_q, inverse, force]) - rhs
        if solver == "schur ldl":
            d, lt, p = ca.ldl(schur, True)
            multipliers = ca.ldl_solve(right, d, lt, p)
        elif n > 9:
            return None
        else:
            multipliers = ca.solve(schur, right)
        a = ca.mtimes(inverse, force - ca.mtimes(phi_q.T, multipliers))
    a = ca.cse(ca.densify(a))
    return ca.Function("rhs", [system.t, q, v], [a])


def build(folder, name, system, solver, flags):
    """The program that times the steps of one solver; None where it does not fit."""
    function = accelerations(system, solver)
    if function is None:
        return None
    stem = f"{name} {solver}".replace(" ", "_").replace("-", "_")
    function.generate(f"{stem}.c", {"casadi_int": "int"})
    n = len(system.q)
    numbers = lambda values: "{" + ", ".join(repr(float(x)) for x in values) + "}"
    (folder / f"{stem}_main.c").write_text(
        f'#include "{stem}.c"\n#define N {n}\n#define H {system.h!r}\n#define WORK {max(1, function.sz_w())}\n'
        f"static const double q0[N] = {numbers(system.start[0])}, v0[N] = {numbers(system.start[1])};\n"
        f'#include "{HERE / "heun.h"}"\n'
    )
    program = folder / stem
    subprocess.run(["gcc", "-O3", *flags, f"{stem}_main.c", "-o", program, "-lm"], cwd=folder, check=True)
    return program


# File, step in s and inputs of the mechanisms that are timed as printed C.
PRINTED = {"driven": ("slider_crank.rs", 0.5e-3, 0.0), "free": ("slider_crank_free.rs", 0.5e-3, 0.5)}


def build_printed(folder, name, export, flags):
    """The program that times the steps of our C."""
    file, h, value = PRINTED[name]
    command = [export, ROOT / "models/src" / file, folder]
    prefix = subprocess.run(command, check=True, capture_output=True, text=True).stdout.strip()
    text = (HERE / "ours.c").read_text().replace("NAME", prefix).replace("CAPS", prefix.upper())
    text = text.replace("= H,", f"= {h!r},").replace("INPUT;", f"{value!r};")
    (folder / f"{prefix}_time.c").write_text(text)
    program = folder / f"{prefix}_time"
    subprocess.run(["gcc", "-O3", *flags, f"{prefix}_time.c", "-o", program, "-lm"], cwd=folder, check=True)
    return program


def run(program, *arguments):
    """{name: (ns per step, sum of the last state)}"""
    lines = subprocess.run([program, *arguments], check=True, capture_output=True, text=True).stdout.splitlines()
    rows = [line.rsplit(" ", 2) for line in lines]
    return {name: (float(time), float(total)) for name, time, total in rows}


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--native", action="store_true", help="build for the processor at hand")
    parser.add_argument("--rounds", type=int, default=15)
    options = parser.parse_args()
    flags = ["-march=native"] if options.native else []
    target = ROOT / "target" / ("native" if options.native else "")
    environment = {**os.environ, "RUSTFLAGS": "-C target-cpu=native"} if options.native else os.environ
    for package, example in (("tests", "step_times"), ("c_code", "export")):
        command = ["cargo", "build", "--release", "-p", package, "--example", example, "--target-dir", target]
        subprocess.run(command, cwd=ROOT, env=environment, check=True)
    ours, export = target / "release/examples/step_times", target / "release/examples/export"

    with tempfile.TemporaryDirectory() as folder:
        folder = Path(folder)
        os.chdir(folder)
        programs = {}
        for name, system in MODELS.items():
            for solver in ("kinematic", "kkt", "schur", "schur ldl"):
                program = build(folder, name, system, solver, flags)
                if program:
                    programs[name, solver] = program
                    print(f"built {name}, {solver}", file=sys.stderr)
        for name in PRINTED:
            programs[name, "our C"] = build_printed(folder, name, export, flags)
        times = {}
        sums = {}
        for _ in range(options.rounds):
            for name, (time, total) in run(ours).items():
                times.setdefault((name, "ours"), []).append(time)
                sums[name] = total
            for (name, solver), program in programs.items():
                (time, total), = run(program).values()
                times.setdefault((name, solver), []).append(time)
                # the same motion; other orders of operations round apart
                if abs(total - sums[name]) > 1e-6 * (1 + abs(total)):
                    sys.exit(f"{name}: {solver} ends at {total}, the generated solver at {sums[name]}")

    print(f"{'ns per Heun step, medians':28}{'ours':>9}{'our C':>9}{'CasADi':>9}{'ratio':>8}  its fastest solver")
    for name in MODELS:
        median = {s: statistics.median(t) for (n, s), t in times.items() if n == name}
        mine, in_c = median.pop("ours"), median.pop("our C", float("nan"))
        solver = min(median, key=median.get)
        print(f"{name:28}{mine:9.1f}{in_c:9.1f}{median[solver]:9.1f}{mine / median[solver]:8.2f}  {solver}")


if __name__ == "__main__":
    main()
