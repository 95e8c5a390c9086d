//! RATTLE: its orders, its energy over 10⁶ steps, its symmetry in time, what it refuses; the same
//! numbers from types and texts, and derivatives of its runs.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_live::{Prepared, Text};
use mbs_runtime::{
    Adaptive, COMPOSITIONS, Components, Composition, Dop853, Dual, Error, Mechanism, RATTLE, RATTLE4, Rattle,
    State, System, Tolerances, mechanism,
};
use models::double_pendulum::{DoublePendulum, DoublePendulumParameters};
use models::{FourBarFree, FourBarFreeInputs, SpringMassDamper};
use paths::some_of;

mechanism! {
    /// A bead on a rotating bar that a spring holds: a drive and a force that depends on time.
    pub Rotor {
        dof = 1;
        param omega = 3 [rad/s];
        param stiffness = 50 [N/m];
        gravity = (0, -9.81) [m/s^2];
        body bar (angle) { inertia = 1 [kg*m^2]; }
        body bead (x, y) { mass = 1 [kg]; }
        force push on x = 2 [N]*sin(5 [rad/s]*t);
        force spring_x on x = -stiffness*x;
        force spring_y on y = -stiffness*y;
        drive motor: angle = omega*t;
        constraint on_bar: x*sin(angle) = y*cos(angle);
        start { angle = 0; x = 0.2 [m]; guess y = 0; }
    }
}

mechanism! {
    /// The same pendulum with its states reduced.
    pub ReducedPendulum {
        dof = 1;
        states = reduced;
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, angle) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point top on rod = (0, 1 [m]);
        revolute hook (ground, rod.top);
        start { angle = 1; }
    }
}

fn numbers(components: impl Components<Real = f64>) -> Vec<f64> {
    components.into_array().as_ref().to_vec()
}

/// The largest difference of positions after 0.8 s from those of a run to 1e-13.
fn error<M: Mechanism<Real = f64>>(mechanism: M, composition: &'static Composition, steps: u32) -> f64 {
    const END: f64 = 0.8;
    let tolerances = Tolerances { rtol: 1e-13, atol: 1e-14, ..Tolerances::default() };
    let builder = Adaptive::builder(mechanism).scheme::<Dop853>().tolerances(tolerances);
    let mut exact = builder.build().expect("a start");
    exact.advance_to(END).expect("a regular motion");
    let builder = Rattle::builder(mechanism, END / f64::from(steps)).composition(composition);
    let mut run = builder.build().expect("a start");
    run.advance_to(END).expect("a regular motion");
    let pairs = numbers(run.state().q).into_iter().zip(numbers(exact.state().q));
    pairs.map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max)
}

/// Errors of halved steps fall with the order, to 0.1; also with a drive and a force that depends
/// on time.
#[test]
fn errors_fall_with_the_order() {
    fn orders<M: Mechanism<Real = f64>>(mechanism: M) {
        for composition in COMPOSITIONS {
            let [coarse, fine] = [400, 800].map(|steps| error(mechanism, composition, steps));
            let order = (coarse / fine).log2();
            let expected = f64::from(composition.order);
            assert!((order - expected).abs() < 0.1, "{} {}: {order}", M::INFO.name, composition.word);
        }
    }
    orders(DoublePendulum::declared());
    orders(FourBarFree::declared());
    orders(Rotor::declared());
}

/// The energy of a run and its violation.
struct Energy {
    /// The largest deviation from that of the start in the first and in the second half, over the
    /// largest kinetic energy.
    largest: [f64; 2],
    /// The slope of the straight line through the means of 100 blocks of steps, per run and over
    /// the same, and the standard error of that slope from the scatter of the means.
    slope: [f64; 2],
    /// The largest ‖Φ‖ in m.
    violation: f64,
}

fn energy<M: Mechanism<Real = f64>>(mut run: Rattle<M>, steps: u32) -> Energy {
    const BLOCKS: u32 = 100;
    let (start, mut scale, mut violation) = (run.energy(), 0.0_f64, 0.0_f64);
    let (mut largest, mut means) = ([0.0_f64; 2], Vec::new());
    for block in 0..BLOCKS {
        let mut sum = 0.0;
        for _ in 0..steps / BLOCKS {
            run.step().expect("a regular motion");
            let deviation = run.energy() - start;
            sum += deviation;
            let half = &mut largest[usize::from(2 * block >= BLOCKS)];
            *half = half.max(deviation.abs());
            scale = scale.max(run.mechanism().kinetic_energy(&run.state()));
            violation = violation.max(run.violation());
        }
        means.push(sum / f64::from(steps / BLOCKS) / scale);
    }
    let n = f64::from(BLOCKS);
    let at = |block: usize| (block as f64 + 0.5) / n - 0.5;
    let spread: f64 = (0..means.len()).map(|block| at(block).powi(2)).sum();
    let mean = means.iter().sum::<f64>() / n;
    let slope = means.iter().enumerate().map(|(block, mean)| at(block) * mean).sum::<f64>() / spread;
    let residual = |(block, value): (usize, &f64)| (value - mean - slope * at(block)).powi(2);
    let variance = means.iter().enumerate().map(residual).sum::<f64>() / (n - 2.0);
    Energy { largest: largest.map(|e| e / scale), slope: [slope, (variance / spread).sqrt()], violation }
}

/// Over 10⁶ steps, or 10⁵ in the short run, the energy stays within a band of O(h²) or O(h⁴), which does not widen, and the
/// slope of its means is within twice its uncertainty: no drift can be told from the scatter of the
/// means and from the random walk of roundings, two of them for each substep, which is what is
/// left with order 4. ‖Φ‖ stays at roundings of lengths of 0.5 m and less.
#[test]
fn energy_does_not_drift_in_a_million_steps() {
    let (h, steps) = (1e-3, some_of(1_000_000) as u32);
    let bar_inputs = FourBarFreeInputs { crank_torque: 0.0 };
    for composition in COMPOSITIONS {
        let runs = [
            energy(
                Rattle::builder(DoublePendulum::declared(), h)
                    .composition(composition)
                    .build()
                    .expect("a start"),
                steps,
            ),
            energy(
                Rattle::builder(FourBarFree::declared(), h)
                    .composition(composition)
                    .inputs(bar_inputs)
                    .build()
                    .expect("a start"),
                steps,
            ),
        ];
        for Energy { largest: [first, second], slope: [slope, error], violation } in runs {
            println!(
                "{}: {first:.3e} {second:.3e}, {slope:.1e} ± {error:.1e}, {violation:.1e}",
                composition.word
            );
            assert!(second < 1.05 * first, "{}: {first:e}, then {second:e}", composition.word);
            let walk = f64::EPSILON * (2.0 * f64::from(steps) * composition.shares.len() as f64).sqrt();
            assert!(slope.abs() < 2.0 * error.hypot(walk), "{}: {slope:e} ± {error:e}", composition.word);
            assert!(violation < 16.0 * f64::EPSILON, "{violation:e}");
        }
    }
}

/// With its velocities turned around a run goes back to its start. The motion multiplies roundings
/// by a few orders in 2 s.
#[test]
fn steps_are_symmetric_in_time() {
    for composition in COMPOSITIONS {
        let builder = |declared| Rattle::builder(declared, 1e-2).composition(composition);
        let declared = DoublePendulum::declared();
        let mut run = builder(declared).build().expect("a start");
        let start = run.state();
        run.advance_to(2.0).expect("a regular motion");
        let State { t, q, v } = run.state();
        let turned = State { t, q, v: v.map(|v| -v) };
        let mut back = builder(declared).from_state(turned).build().expect("a start");
        back.advance_to(4.0).expect("a regular motion");
        let pairs = numbers(back.state().q).into_iter().zip(numbers(start.q));
        let largest = pairs.map(|(found, start)| (found - start).abs()).fold(0.0, f64::max);
        assert!(largest < 1e-11, "{}: {largest:e}", composition.word);
    }
}

/// A text computes what the type does, to the bit; `System` sees what the type tells.
#[test]
fn texts_run_alike() {
    let text = "Swing {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, angle) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point top on rod = (0, 1 [m]);
        revolute hook (ground, rod.top);
        start { angle = 1; }
    }";
    mechanism! {
        pub Swing {
            dof = 1;
            gravity = (0, -9.81) [m/s^2];
            body rod (x, y, angle) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
            point top on rod = (0, 1 [m]);
            revolute hook (ground, rod.top);
            start { angle = 1; }
        }
    }
    let live = Text::declaration("swing.mbs", text).compile().expect("a declaration");
    let mut of_text = Rattle::builder(Prepared::new(&live), 1e-2).build().expect("a start");
    let mut of_type = Rattle::builder(Swing::declared(), 1e-2).build().expect("a start");
    of_text.advance(500).expect("a regular motion");
    of_type.advance(500).expect("a regular motion");
    let mut found = [[[0.0; 3]; 2]; 2];
    let runs: [&dyn System; 2] = [&of_text, &of_type];
    for (run, [q, v]) in runs.into_iter().zip(&mut found) {
        run.state(q, v);
    }
    assert_eq!(found[0], found[1]);
    assert_eq!(found[1][0].to_vec(), numbers(of_type.state().q));
}

/// A run is one of this instant: inputs take effect from the step on before which they are set.
#[test]
fn inputs_act_from_the_next_step_on() {
    let mut pushed = Rattle::builder(FourBarFree::declared(), 1e-3).build().expect("a start");
    pushed.advance_to(0.1).expect("a regular motion");
    let inputs = FourBarFreeInputs { crank_torque: 0.2 };
    let state = pushed.state();
    pushed.inputs_mut().crank_torque = 0.2;
    pushed.advance_to(0.2).expect("a regular motion");
    let builder = Rattle::builder(FourBarFree::declared(), 1e-3).inputs(inputs);
    let mut other = builder.from_state(state).build().expect("a start");
    other.advance_to(0.2).expect("a regular motion");
    let pairs = numbers(pushed.state().q).into_iter().zip(numbers(other.state().q));
    // both start from the same state but for the predictor of the first positions
    pairs.for_each(|(a, b)| assert!((a - b).abs() < 1e-13, "{a} {b}"));
    pushed.inputs_mut().crank_torque = f64::NAN;
    assert!(matches!(pushed.step(), Err(Error::Input { name: "crank_torque", .. })));
}

/// Derivatives by a length agree with differences, to their error: h² times a third derivative,
/// and roundings over h.
#[test]
fn duals_carry_derivatives_through_steps() {
    let at = |length1: f64| {
        let parameters = DoublePendulumParameters { length1, ..*DoublePendulum::declared().parameters() };
        let mut run = Rattle::builder(DoublePendulum::new(parameters).expect("lengths"), 5e-3).build();
        let run = run.as_mut().expect("a start");
        run.advance_to(1.0).expect("a regular motion");
        numbers(run.state().q)
    };
    let mut parameters: DoublePendulumParameters<Dual<f64, 1>> =
        DoublePendulum::declared().parameters().over();
    parameters.length1 = Dual::variable(0.5, 0);
    let mut run =
        Rattle::builder(DoublePendulum::new(parameters).expect("lengths"), 5e-3).build().expect("a start");
    run.advance_to(1.0).expect("a regular motion");
    let step = 1e-5;
    let [before, after] = [at(0.5 - step), at(0.5 + step)];
    for (dual, (before, after)) in run.state().q.into_array().into_iter().zip(before.into_iter().zip(after)) {
        let difference = (after - before) / (2.0 * step);
        assert!(
            (dual.partials[0] - difference).abs() < 1e-7 * (1.0 + difference.abs()),
            "{dual:?} {difference}"
        );
    }
}

#[test]
fn what_has_no_such_step_is_refused() {
    let damped = Rattle::builder(SpringMassDamper::declared(), 1e-3).build();
    assert!(matches!(damped.err(), Some(Error::VelocityForce { coordinate: "x" })));
    let reduced = Rattle::builder(ReducedPendulum::declared(), 1e-3).build();
    assert!(matches!(reduced.err(), Some(Error::ReducedStates { method: "rattle" })));
    let step = Rattle::builder(DoublePendulum::declared(), 0.0).build();
    assert!(matches!(step.err(), Some(Error::Step { .. })));
    // a rod cannot turn by some revolutions in a step
    let mut long =
        Rattle::builder(FourBarFree::declared(), 0.7).composition(&RATTLE4).build().expect("a start");
    let before = long.state();
    let error = (0..10).find_map(|_| long.step().err());
    assert!(error.is_some(), "{:?}", long.state());
    assert!(long.steps() > 0 || long.state() == before);
    assert_eq!(RATTLE.word, "rattle");
}
