//! A mechanism whose number of coordinates is known at run time only is assembled,
//! checked and examined as one with named components is: pendulums side by side, as many
//! as there are lengths.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::equations::{At, Equations, Preparation, Room, Start, check, consistent, project, reach};
use mbs_runtime::{
    Constraint, Dimension, Error, Gains, Info, Modes, Pivot, Quantity, Sampling, Simulation, mechanism, start,
};

mechanism! {
    /// One of them.
    Pendulum {
        dof = 1;
        param length = 1 [m];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: (x^2 + y^2)/(2*length) = length/2;
        start { guess x = length; guess y = 0; }
    }
}

const GRAVITY: f64 = 9.81;

/// Points of 1 kg on rods: Φ = (x² + y² − l²)/2l for each.
struct Pendulums {
    lengths: Vec<f64>,
    info: Info,
}

impl Pendulums {
    fn new(lengths: &[f64]) -> Self {
        let length = Dimension::of(0, 1, 0);
        let named = |name: String| Quantity {
            name: name.leak(),
            doc: "",
            unit: "m",
            scale: 1.0,
            dimension: length,
            default: 0.0,
        };
        let rod = |name: String| Constraint {
            name: name.leak(),
            doc: "",
            formula: "",
            is_drive: false,
            is_rate: false,
            dimension: length,
        };
        let rows = 0..lengths.len();
        let coordinates: Vec<_> = rows.clone().flat_map(|i| [format!("x{i}"), format!("y{i}")]).collect();
        let coordinates: Vec<_> = coordinates.into_iter().map(named).collect();
        let constraints: Vec<_> = rows.map(|i| rod(format!("rod{i}"))).collect();
        let pivots: Vec<_> =
            constraints.iter().map(|rod| Pivot { constraint: rod.name, coordinate: "" }).collect();
        let (coordinates, constraints, pivots) = (coordinates.leak(), constraints.leak(), pivots.leak());
        let dof = constraints.len() as i32;
        let states: Vec<usize> = (0..coordinates.len()).collect();
        let info = Info::from_parts(
            "Pendulums",
            "",
            dof,
            &[],
            &[],
            coordinates,
            coordinates.len(),
            &[],
            &[],
            constraints,
            states.leak(),
            &[],
            &[],
            [&[], &[]],
            pivots,
            pivots,
            Sampling::NONE,
            &[],
            &[],
            Modes::NONE,
            &[],
        );
        Self { lengths: lengths.to_vec(), info }
    }

    fn room(&self) -> Vec<f64> {
        vec![f64::NAN; Room::<f64>::len(&self.info, 4)]
    }

    /// Φ_qᵀ (Φ_q Φ_qᵀ)⁻¹ (r − Φ_q f) + f of each, and the growth.
    fn solve(&self, q: &[f64], row: impl Fn(usize) -> f64, f: [f64; 2], out: &mut [f64]) -> f64 {
        let mut growth = 0.0;
        for (i, l) in self.lengths.iter().enumerate() {
            let (x, y) = (q[2 * i] / l, q[2 * i + 1] / l);
            let pivot = x * x + y * y;
            let share = (row(i) - x * f[0] - y * f[1]) / pivot;
            (out[2 * i], out[2 * i + 1]) = (f[0] + x * share, f[1] + y * share);
            growth += 1.0 / pivot;
        }
        growth
    }

    fn worst(&self, q: &[f64]) -> Option<(usize, f64)> {
        let growth = |i: usize| (self.lengths[i] / q[2 * i].hypot(q[2 * i + 1])).powi(2);
        (0..self.lengths.len()).map(|i| (i, growth(i))).max_by(|a, b| a.1.total_cmp(&b.1))
    }
}

impl Equations<f64> for Pendulums {
    fn info(&self) -> &Info {
        &self.info
    }
    fn phi(&self, _: f64, q: &[f64], phi: &mut [f64]) {
        for (i, l) in self.lengths.iter().enumerate() {
            phi[i] = (q[2 * i].powi(2) + q[2 * i + 1].powi(2) - l * l) / (2.0 * l);
        }
    }
    fn phi_dot(&self, At { q, v, .. }: At<'_, f64>, phi_dot: &mut [f64]) {
        for (i, l) in self.lengths.iter().enumerate() {
            phi_dot[i] = (q[2 * i] * v[2 * i] + q[2 * i + 1] * v[2 * i + 1]) / l;
        }
    }
    fn free_reactions(&self, _: At<'_, f64>, _: &[f64], _: &mut [f64], _: &mut [f64]) -> f64 {
        f64::NAN
    }
    // no clocks
    fn clock(&self, _: usize) -> [f64; 2] {
        [f64::NAN; 2]
    }
    fn sample(&self, _: At<'_, f64>, _: &mut [f64], _: usize) {}
    fn complete(&self, states: At<'_, f64>, q: &mut [f64], v: &mut [f64]) {
        q.copy_from_slice(states.q);
        v.copy_from_slice(states.v);
    }
    fn stabilized(
        &self,
        at: At<'_, f64>,
        inputs: &[f64],
        gains: &Gains<f64>,
        acceleration: &mut [f64],
        feedback: &mut [f64],
    ) -> f64 {
        let mut rates = vec![0.0; feedback.len()];
        self.phi_dot(at, &mut rates);
        self.phi(at.t, at.q, feedback);
        for (feedback, rate) in feedback.iter_mut().zip(rates) {
            *feedback = gains.minus_two_alpha * rate + gains.minus_beta_squared * *feedback;
        }
        self.constrained(at, inputs, feedback, acceleration)
    }
    fn constrained(
        &self,
        at: At<'_, f64>,
        inputs: &[f64],
        feedback: &[f64],
        acceleration: &mut [f64],
    ) -> f64 {
        self.accelerations(at, inputs, feedback, acceleration)
    }
    // no force depends on positions or velocities
    fn implicit(&self, at: At<'_, f64>, inputs: &[f64], _: f64, _: &[f64], acceleration: &mut [f64]) -> f64 {
        self.accelerations(at, inputs, &vec![0.0; self.lengths.len()], acceleration)
    }
    fn accelerations(&self, at: At<'_, f64>, _: &[f64], feedback: &[f64], acceleration: &mut [f64]) -> f64 {
        let v = at.v;
        let gamma = |i: usize| -(v[2 * i].powi(2) + v[2 * i + 1].powi(2)) / self.lengths[i];
        self.solve(at.q, |i| gamma(i) + feedback[i], [0.0, -GRAVITY], acceleration)
    }
    fn position_correction(&self, _: f64, q: &[f64], residual: &[f64], correction: &mut [f64]) -> f64 {
        self.solve(q, |i| residual[i], [0.0; 2], correction)
    }
    fn velocity_correction(&self, _: f64, q: &[f64], residual: &[f64], correction: &mut [f64]) -> f64 {
        self.solve(q, |i| residual[i], [0.0; 2], correction)
    }
    fn projection(&self, _: f64, q: &[f64], violation: &[f64], correction: &mut [f64]) -> f64 {
        self.solve(q, |i| violation[i], [0.0; 2], correction)
    }
    fn worst_pivot(&self, _: f64, q: &[f64]) -> Option<(usize, f64)> {
        self.worst(q)
    }
    fn worst_start_pivot(&self, _: f64, q: &[f64]) -> Option<(usize, f64)> {
        self.worst(q)
    }
    fn kinetic_energy(&self, at: At<'_, f64>) -> f64 {
        0.5 * at.v.iter().map(|v| v * v).sum::<f64>()
    }
    fn potential_energy(&self, at: At<'_, f64>) -> f64 {
        GRAVITY * at.q.iter().skip(1).step_by(2).sum::<f64>()
    }
    fn reactions(&self, _: At<'_, f64>, _: &[f64], _: &mut [f64], _: &mut [f64]) -> f64 {
        f64::NAN
    }
    // nothing is measured, watched, drawn or a parameter
    fn outputs(&self, _: At<'_, f64>, _: &[f64], _: [&[f64]; 2], _: &mut [f64]) {}
    fn events(&self, _: At<'_, f64>, _: &[f64], _: &mut [f64]) {}
    fn points(&self, _: f64, _: &[f64], _: &mut [f64]) {}
    fn parameters(&self, _: &mut [f64]) {}
}

/// Guesses that differ from pendulum to pendulum.
fn guesses(n: usize) -> (Vec<f64>, Vec<f64>) {
    let q = (0..n).flat_map(|i| [0.8 + 0.1 * i as f64, -0.5 - 0.2 * i as f64]).collect();
    let v = (0..n).flat_map(|i| [1.0 - i as f64, 0.3]).collect();
    (q, v)
}

#[test]
fn start_of_each_is_that_of_the_one_with_named_components() {
    let lengths = [1.0, 1.5, 0.7, 2.0, 1.1];
    let pendulums = Pendulums::new(&lengths);
    let mut numbers = pendulums.room();
    let mut room = Room::within(&mut numbers, &pendulums.info);
    let (mut q, mut v) = guesses(5);
    consistent(&pendulums, 0.0, &mut q, &mut v, &mut room).expect("a start");
    check(&pendulums, At { t: 0.0, q: &q, v: &v }, 1e-3, &mut room).expect("a consistent start");
    reach(&pendulums, 0.0, &q, &[], 1e-3, &mut room).expect("it is there");
    let (guess_q, guess_v) = guesses(5);
    for (i, length) in lengths.into_iter().enumerate() {
        let pendulum = Pendulum::new(PendulumParameters { length }).expect("a length");
        let mut guess = Simulation::new(pendulum, 1e-3).expect("a start").state();
        (guess.q.x, guess.q.y) = (guess_q[2 * i], guess_q[2 * i + 1]);
        (guess.v.x, guess.v.y) = (guess_v[2 * i], guess_v[2 * i + 1]);
        let one = start::consistent(&pendulum, &guess).expect("a start");
        for (a, b) in
            [(one.q.x, q[2 * i]), (one.q.y, q[2 * i + 1]), (one.v.x, v[2 * i]), (one.v.y, v[2 * i + 1])]
        {
            assert!((a - b).abs() < 1e-15 * 4.0, "{i}: {a} {b}");
        }
    }
}

#[test]
fn what_is_kept_and_what_is_refused_has_its_name() {
    let pendulums = Pendulums::new(&[1.0, 1.5]);
    let mut numbers = pendulums.room();
    let mut room = Room::within(&mut numbers, &pendulums.info);
    let (mut q, mut v) = guesses(2);
    project(&pendulums, 0.0, &mut q, &mut v, [&["y0", "x1"], &["x0"]], &mut room).expect("a start");
    assert_eq!((q[1], q[2], v[0]), (-0.5, 0.9, 1.0));
    assert!((q[0] - 0.75_f64.sqrt()).abs() < 1e-15 && (q[3] + 1.2).abs() < 1e-15);

    let error = project(&pendulums, 0.0, &mut q, &mut v, [&["y2"], &[]], &mut room);
    assert_eq!(error, Err(Error::NoCoordinate { name: "y2" }));
    let mut prepare = |start, q: &[f64]| {
        let preparation = Preparation { start, inputs: &[], step: 1e-3, keeps_constraints: true };
        preparation.prepare(&pendulums, 0.0, &mut q.to_vec(), &mut v.clone(), &mut room)
    };
    assert_eq!(prepare(Start::Given, &q), Ok(f64::INFINITY));
    let mut bad = q.clone();
    bad[3] -= 0.1;
    let error = prepare(Start::Given, &bad);
    assert!(
        matches!(error, Err(Error::Inconsistent { constraint: "rod1", is_rate: false, .. })),
        "{error:?}"
    );
    bad[2] = f64::NAN;
    let error = prepare(Start::Unchecked, &bad);
    assert_eq!(error, Err(Error::NonFinite { t: 0.0, coordinate: "x1" }));
    let error = prepare(Start::Declared, &[0.8, -0.5, 0.0, 0.0]);
    assert!(matches!(error, Err(Error::Singular { constraint: "rod1", coordinate: "", .. })), "{error:?}");
}
