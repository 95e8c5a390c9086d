//! Linear systems about states in motion against differences of runs of the mechanism itself, with inputs,
//! parameters and drives; and drives that are held at rest.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use mbs_analysis::nalgebra::DVector;
use mbs_analysis::{Error, Linearization, OperatingPoint, Ports, Search, equilibrium, linearize, of_type};
use mbs_runtime::equations::{At, Equations};
use mbs_runtime::{Adaptive, Components, Mechanism, State, Tolerances, mechanism, start};

mechanism! {
    /// A crank at a speed of its own that drives a swinging block on a spring.
    pub Shaken {
        dof = 1;
        param r = 0.1 [m];
        param l = 0.6 [m];
        param omega = 7 [rad/s];
        input brake [N*m];
        gravity = (0, -9.81) [m/s^2];
        body crank (x1, y1, a) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        body rod (x2, y2, b) { mass = 2 [kg]; inertia = 0.06 [kg*m^2]; }
        point centre on crank = (-r/2, 0);
        point pin on crank = (r/2, 0);
        point end on rod = (-l/2, 0);
        revolute bearing (crank.centre, ground);
        revolute joint (crank.pin, rod.end);
        drive motor: a = omega*t + 0.5 [rad/s^2]*t^2;
        torque damper on rod = brake - 0.4 [N*m*s]*der(b);
        start { b = -0.8; guess x1 = 0.05 [m]; guess x2 = 0.3 [m]; guess y2 = -0.2 [m]; }
        output height [m] = y2;
        output load [N] = lambda(joint_x);
    }
}

four_bar! { FourBar;
    dof = 1;
    param ground_length = 0.5 [m];
    param stiffness = 3 [N*m];
    input torque [N*m];
    point bearing on ground = (ground_length, 0);
    torque hand on crank = torque - stiffness*t1;
}

/// A mechanism, the coordinate that is its state, and a state in motion of it.
struct Moving<M: Mechanism> {
    state: State<M::Coordinates>,
    keep: &'static [&'static str],
    parameters: Vec<f64>,
    inputs: Vec<f64>,
}

/// A quantity of a mechanism in motion that is changed: z, ż, or one of its inputs or parameters.
#[derive(Clone, Copy)]
enum Change {
    Position,
    Velocity,
    Input(usize),
    Parameter(usize),
}

fn filled<C: Components<Real = f64>>(values: &[f64]) -> C {
    let mut array = C::splat(0.0).into_array();
    array.as_mut().copy_from_slice(values);
    C::from_array(array)
}

impl<M: Mechanism<Real = f64>> Moving<M> {
    /// Where the one coordinate is that is kept.
    fn place(&self) -> usize {
        M::INFO.coordinates.iter().position(|q| q.name == self.keep[0]).expect("a coordinate")
    }

    /// A run from a state that was moved and made consistent with the nonlinear constraints.
    fn run(&self, change: Change, size: f64) -> Adaptive<M> {
        let (mut parameters, mut inputs) = (self.parameters.clone(), self.inputs.clone());
        let (mut q, mut v) = (self.state.q.into_array(), self.state.v.into_array());
        match change {
            Change::Position => q.as_mut()[self.place()] += size,
            Change::Velocity => v.as_mut()[self.place()] += size,
            Change::Input(at) => inputs[at] += size,
            Change::Parameter(at) => parameters[at] += size,
        }
        let mechanism = M::new(filled(&parameters)).expect("it exists");
        let state =
            State { t: self.state.t, q: M::Coordinates::from_array(q), v: M::Coordinates::from_array(v) };
        let start = start::project(&mechanism, &state, self.keep, self.keep).expect("it is near");
        Adaptive::builder(mechanism)
            .from_state(start)
            .inputs(filled(&inputs))
            .tolerances(Tolerances { rtol: 1e-13, atol: 1e-15, ..Tolerances::default() })
            .build()
            .expect("it starts")
    }

    /// z, ż and the outputs after some time.
    fn flown(&self, change: Change, size: f64, time: f64) -> Vec<f64> {
        let mut run = self.run(change, size);
        run.advance_to(self.state.t + time).expect("it runs");
        let state = run.state();
        let (q, v) = (state.q.into_array(), state.v.into_array());
        let mechanism: &dyn Equations<f64> = run.mechanism();
        let at = At { t: state.t, q: q.as_ref(), v: v.as_ref() };
        let [mut a, mut lambda, mut outputs] =
            [M::INFO.coordinates.len(), M::INFO.constraints.len(), M::INFO.outputs.len()]
                .map(|n| vec![0.0; n]);
        let inputs = run.inputs().into_array();
        mechanism.reactions(at, inputs.as_ref(), &mut a, &mut lambda);
        mechanism.outputs(at, inputs.as_ref(), [&a, &lambda], &mut outputs);
        [vec![q.as_ref()[self.place()], v.as_ref()[self.place()]], outputs].concat()
    }

    /// The derivative of that, by the five-point formula.
    fn differenced(&self, change: Change, step: f64, time: f64) -> Vec<f64> {
        let [a, b, c, d] = [2.0, 1.0, -1.0, -2.0].map(|share| self.flown(change, share * step, time));
        (0..a.len()).map(|k| (8.0 * (b[k] - c[k]) - (a[k] - d[k])) / (12.0 * step)).collect()
    }

    /// The linear system where the run is after some time.
    fn linear(&self, time: f64) -> Linearization {
        let mut run = self.run(Change::Position, 0.0);
        if time > 0.0 {
            run.advance_to(self.state.t + time).expect("it runs");
        }
        let state = run.state();
        let (q, v) = (state.q.into_array(), state.v.into_array());
        let point = OperatingPoint::in_motion(state.t, q.as_ref(), v.as_ref(), &self.inputs);
        let family = of_type::<M>();
        let ports = Ports {
            states: Some(vec![self.keep[0].into()]),
            parameters: M::INFO.parameters.iter().map(|p| p.name.into()).collect(),
            family: Some(&family),
            ..Ports::default()
        };
        linearize(run.mechanism(), &point, &ports).expect("a linear system")
    }

    /// At once, and after a while along δẋ = A(t) δx + B(t) δu, by the classical Runge–Kutta method.
    fn agrees(&self) {
        const STEPS: usize = 40;
        const TIME: f64 = 0.2;
        let systems: Vec<_> =
            (0..=2 * STEPS).map(|k| self.linear(TIME * k as f64 / (2 * STEPS) as f64)).collect();
        let inputs = systems[0].inputs.len();
        let changes = [Change::Position, Change::Velocity];
        let inputs_of = (0..self.inputs.len()).map(Change::Input);
        let changes =
            changes.into_iter().chain(inputs_of).chain((0..self.parameters.len()).map(Change::Parameter));
        for (column, change) in changes.enumerate() {
            let mut x = DVector::zeros(2);
            let mut u = DVector::zeros(inputs);
            if column < 2 {
                x[column] = 1.0
            } else {
                u[column - 2] = 1.0
            }
            let response = |at: usize, x: &DVector<f64>| {
                let (linear, y) = (&systems[at], &systems[at].c * x + &systems[at].d * &u);
                (&linear.a * x + &linear.b * &u, [x.as_slice(), y.as_slice()].concat())
            };
            self.compare(change, 0.0, &response(0, &x).1);
            let h = TIME / STEPS as f64;
            for step in 0..STEPS {
                let rate = |half: usize, x: &DVector<f64>| response(2 * step + half, x).0;
                let k1 = rate(0, &x);
                let k2 = rate(1, &(&x + &k1 * (0.5 * h)));
                let k3 = rate(1, &(&x + &k2 * (0.5 * h)));
                let k4 = rate(2, &(&x + &k3 * h));
                x += (k1 + (k2 + k3) * 2.0 + k4) * (h / 6.0);
            }
            self.compare(change, TIME, &response(2 * STEPS, &x).1);
        }
    }

    /// To 1e-7: differences of runs with errors of 1e-13 over 1e-3, and h⁴ of the Runge–Kutta method.
    fn compare(&self, change: Change, time: f64, expected: &[f64]) {
        let found = self.differenced(change, 1e-3, time);
        let size = found.iter().fold(1.0_f64, |size, x| size.max(x.abs()));
        for (found, expected) in found.iter().zip(expected) {
            assert!((found - expected).abs() < 1e-7 * size, "after {time} s: {found} {expected}");
        }
    }
}

fn declared<M: Mechanism>() -> Vec<f64> {
    M::INFO.parameters.iter().map(|p| p.default).collect()
}

/// The tangent turns as the linkage moves, and what moves on it turns with it.
#[test]
fn in_motion_it_is_the_derivative_of_the_motion() {
    let state = start::assemble(&FourBar::declared(), 0.0, &FourBar::declared().declared_start().q)
        .expect("it closes");
    let v = FourBarCoordinates { t1: 4.0, ..Components::splat(0.0) };
    let state = State { t: 0.0, q: state, v };
    let state = start::project(&FourBar::declared(), &state, &["t1"], &["t1"]).expect("it moves");
    Moving::<FourBar> { state, keep: &["t1"], parameters: declared::<FourBar>(), inputs: vec![0.5] }.agrees();
}

/// The drive moves on, and accelerates; the phase of the crank depends on its parameters.
#[test]
fn drives_move_on_in_motion() {
    let state = Shaken::declared().declared_start();
    let v = ShakenCoordinates { b: 1.5, ..Components::splat(0.0) };
    let state = State { t: 0.3, q: state.q, v };
    let state = start::project(&Shaken::declared(), &state, &["b"], &["b"]).expect("it moves");
    Moving::<Shaken> { state, keep: &["b"], parameters: declared::<Shaken>(), inputs: vec![0.2] }.agrees();
}

/// Held drives neither move nor accelerate: a rod about a bearing that stands still.
#[test]
fn drives_are_held_at_rest() -> Result<(), Error> {
    let search = Search { t: 0.4, ..Search::default() };
    let found = equilibrium(&Shaken::declared(), &search)?;
    let linear = linearize(&Shaken::declared(), &OperatingPoint::from(&found), &Ports::default())?;
    assert_eq!(linear.states[0].name, "b");
    let inertia = 0.06 + 2.0 * 0.3 * 0.3;
    assert!((linear.a[(1, 0)] + 2.0 * 9.81 * 0.3 / inertia).abs() < 1e-9);
    assert!((linear.a[(1, 1)] + 0.4 / inertia).abs() < 1e-9);
    assert!(linear.rate.amax() < 1e-9);
    Ok(())
}
