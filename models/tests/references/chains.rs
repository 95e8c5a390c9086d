//! Chains of N equal parts, for every N from the same code; the longest ones are loops.

use std::cell::Cell;
use std::f64::consts::{FRAC_PI_2, TAU};

use mbs_runtime::{Components, Error, Held, Mechanism, Simulation, State, start};
use models::{
    NFourBar1, NFourBar2, NFourBar10, NFourBar40, NPendulum1, NPendulum2, NPendulum10, NPendulum40,
};
use paths::{Case, EXHAUSTIVE, Run, through_fused_path};

use super::near;

const G: f64 = 9.81;

/// The value of a component by its name.
fn named<C: Components<Real = f64>>(values: C, name: &str) -> f64 {
    values.get(name).unwrap()
}

/// Arithmetic–geometric mean.
fn agm(mut a: f64, mut b: f64) -> f64 {
    for _ in 0..8 {
        (a, b) = (f64::midpoint(a, b), (a * b).sqrt());
    }
    a
}

/// λ² of the row as a pendulum, for bars of 1 m.
fn n_four_bar_rate_squared(n: f64) -> f64 {
    let inertia = (n + 1.0) / 3.0 + n;
    let moment = (n + 1.0) / 2.0 + n;
    G * moment / inertia
}

/// Time of the first turn, with ω₀ = 1 rad/s. On the way the speed has to be
/// that of the energy, and the uprights parallel.
///
/// With the largest speed Ω = √(ω₀² + 4λ²), Heun's error is within (Ωh)² of Ω².
/// Within 3° of a flat position constraints depend on each other nearly, and
/// speeds are not compared: what is lost there would show behind it. What
/// rounding leaves between uprights grows as they come near to a flat position,
/// to within 3e-5 at these steps: (N + 1) ε/3e-5 < 1e-9.
fn turn<M: Mechanism<Real = f64>>(
    case: &mut Case,
    run: &mut Run<M, Held<M::Scheme>>,
    n: f64,
    step: f64,
) -> Result<f64, Error> {
    let rate_squared = n_four_bar_rate_squared(n);
    loop {
        run.advance(1)?;
        let now = run.now()?;
        let lean = FRAC_PI_2 - named(now.q, "phi_0");
        let speed = -named(now.v, "phi_0");
        let speed_squared = 1.0 + 2.0 * rate_squared * (1.0 - lean.cos());
        if lean.cos().abs() > 0.05 {
            let tolerance = (step * (1.0 + 4.0 * rate_squared)).powi(2);
            case.near("speed squared", speed * speed, speed_squared, tolerance);
        }
        let last = named(now.q, &format!("phi_{n}"));
        case.near("parallel", FRAC_PI_2 - last, lean, 1e-9);
        if lean >= TAU {
            // upright nothing accelerates, so the speed is constant to h²
            return Ok(now.t - (lean - TAU) / speed);
        }
    }
}

/// Within (Ωh)², in s as Ω is some 1/s; what is left after extrapolation to h = 0
/// is the next term, (Ωh)³, which grows by Ω/ω₀ on the way from the slow start.
fn turns_in_time<M: Mechanism<Real = f64>>(mechanism: M, n: f64) -> Result<(), Error> {
    const STEP: f64 = 1.0 / 11_000.0;
    let fastest = (1.0 + 4.0 * n_four_bar_rate_squared(n)).sqrt();
    let reference = TAU / agm(1.0, fastest);
    let start = |step| Simulation::new(mechanism, step);
    let time = |step: f64| {
        let found = Cell::new(f64::NAN);
        through_fused_path(&format!("a row of {n} four-bars"), step, start, |case, run| {
            let time = turn(case, run, n, step)?;
            case.near("a turn", time, reference, (step * fastest).powi(2));
            found.set(time);
            Ok(())
        })?;
        Ok::<_, Error>(found.get())
    };
    let extrapolated = (4.0 * time(STEP / 2.0)? - time(STEP)?) / 3.0;
    near("a turn, extrapolated", extrapolated, reference, fastest * (STEP * fastest).powi(3));
    Ok(())
}

#[test]
fn n_four_bar_is_a_pendulum() -> Result<(), Error> {
    turns_in_time(NFourBar1::declared(), 1.0)?;
    turns_in_time(NFourBar2::declared(), 2.0)?;
    // half a minute and more
    if EXHAUSTIVE {
        turns_in_time(NFourBar10::declared(), 10.0)?;
        turns_in_time(NFourBar40::declared(), 40.0)?;
    }
    Ok(())
}

/// ω² and angles of the slowest mode of a hanging chain, for rods of 1 m and 1 kg.
/// By powers of K⁻¹M, whose largest eigenvalue is 1/ω²; the next one is smaller
/// than a quarter of it.
fn slowest_mode(n: usize) -> (f64, Vec<f64>) {
    // rods that hang below the lower one of i and j
    let below = |i: usize, j: usize| (n - 1 - i.max(j)) as f64;
    let mass = |i: usize, j: usize| below(i, j) + if i == j { 1.0 / 3.0 } else { 0.5 };
    let mut mode = vec![1.0; n];
    let mut omega_squared = 0.0;
    for _ in 0..40 {
        let row = |i: usize| (0..n).map(|j| mass(i, j) * mode[j]).sum::<f64>() / (G * (below(i, i) + 0.5));
        let next: Vec<f64> = (0..n).map(row).collect();
        // the last angle is the largest
        omega_squared = 1.0 / next[n - 1];
        mode = next.iter().map(|angle| angle * omega_squared).collect();
    }
    (omega_squared, mode)
}

/// Compares a swing in the slowest mode with the linear theory, and returns its ω². Nonlinear terms are some
/// tens of times the amplitude's square, relative to the linear ones. Rounding of forces of 400 N is 1e-8 of
/// what accelerates the lightest mode. Heun's phase error in a turn is (ωh)² π/3 = 6e-7 for the slowest mode.
fn swings_in_its_mode<M: Mechanism<Real = f64>>(mechanism: M, n: usize) -> Result<f64, Error> {
    const AMPLITUDE: f64 = 1e-4;
    const LIMIT: f64 = 2e-6;
    let (omega_squared, mode) = slowest_mode(n);
    let mut q = M::Coordinates::splat(0.0);
    let (mut x, mut y) = (0.0, 0.0);
    for (i, part) in mode.iter().enumerate() {
        let (sin, cos) = (AMPLITUDE * part).sin_cos();
        for (name, value) in [("x", x + sin / 2.0), ("y", y - cos / 2.0), ("theta", AMPLITUDE * part)] {
            q = q.with(&format!("{name}_{}", i + 1), value).unwrap();
        }
        (x, y) = (x + sin, y - cos);
    }
    let at_rest = State { t: 0.0, q, v: M::Coordinates::splat(0.0) };
    let at_rest = start::consistent(&mechanism, &at_rest).unwrap();
    let period = TAU / omega_squared.sqrt();
    let start = |step| Simulation::builder(mechanism, step).from_state(at_rest).build();

    let compare = |case: &mut Case, what: &str, ours: M::Coordinates, factor: f64, limit: f64| {
        for (i, part) in mode.iter().enumerate() {
            let angle = named(ours, &format!("theta_{}", i + 1)) / AMPLITUDE;
            case.near(format_args!("{what}, rod {}", i + 1), angle, factor * part, limit);
        }
    };
    through_fused_path(&format!("{n} hanging rods"), period / 8192.0, start, |case, run| {
        let acceleration = run.now()?.acceleration;
        compare(case, "acceleration", acceleration, -omega_squared, LIMIT * omega_squared);
        run.advance_to(period / 4.0)?;
        compare(case, "after a quarter", run.now()?.q, 0.0, LIMIT);
        run.advance_to(period)?;
        compare(case, "after a period", run.now()?.q, 1.0, LIMIT);
        Ok(())
    })?;
    Ok(omega_squared)
}

#[test]
fn n_pendulum_has_its_slowest_mode() -> Result<(), Error> {
    let one = swings_in_its_mode(NPendulum1::declared(), 1)?;
    near("N = 1", one, 1.5 * G, 1e-12);
    let two = swings_in_its_mode(NPendulum2::declared(), 2)?;
    near("N = 2", two, (3.0 - 6.0 / 7_f64.sqrt()) * G, 1e-12);
    swings_in_its_mode(NPendulum10::declared(), 10)?;
    let forty = swings_in_its_mode(NPendulum40::declared(), 40)?;
    // rods of 1/40 of the rope: their own inertia matters to the square of that
    let rope = 2.404825557695773_f64.powi(2) / 4.0 * G / 40.0;
    near("rope", forty / rope, 1.0, 1.0 / 1600.0);
    Ok(())
}

/// So the references above hold for straight lines and for loops.
#[test]
fn long_chains_are_loops_and_short_ones_straight_lines() {
    fn has_loops<M: Mechanism>() -> bool {
        M::INFO.functions.iter().any(|function| function.loops > 0)
    }
    assert!(has_loops::<NFourBar40>() && has_loops::<NPendulum40>());
    assert!(!has_loops::<NFourBar2>() && !has_loops::<NPendulum2>());
}
