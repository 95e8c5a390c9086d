//! The classical Runge–Kutta method on every path: a fused step is that of the textbook, to
//! the bit; every other path does what that one does; the order is four; and what cannot be
//! stepped is named as with Heun's method.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_ensemble::{Ensemble, Samples};
use mbs_runtime::{
    Baumgarte, Components, Error, Gains, Held, Heun, Mechanism, Method, PerStage, Real, Rk4, Scheme,
    Simulation, State, Stepped, mechanism,
};
use models::{NPendulum40, SliderCrank, SliderCrankFree, SliderCrankFreeInputs, SliderCrankParameters};
use paths::through_every_path;
use tests::random::Random;

mechanism! {
    /// The free slider-crank of the library, which asks for another scheme.
    Crank {
        dof = 1;
        method = rk4;
        param l1 = 60 [mm];
        param l2 = 180 [mm];
        param m1 = 0.5 [kg];
        param m2 = 1.2 [kg];
        param m3 = 2.0 [kg];
        param inertia_factor = 1/12;
        param omega = 200 [rpm];
        input crank_torque [N*m];
        gravity = (0, -9.81) [m/s^2];
        body crank  (x1, y1, theta1) { mass = m1; inertia = inertia_factor*m1*l1^2; }
        body rod    (x2, y2, theta2) { mass = m2; inertia = inertia_factor*m2*l2^2; }
        body slider (x3)             { mass = m3; }
        torque motor on crank = crank_torque;
        constraint crank_x: x1 = l1/2*cos(theta1);
        constraint crank_y: y1 = l1/2*sin(theta1);
        constraint rod_x: x2 = l1*cos(theta1) + l2/2*cos(theta2);
        constraint rod_y: y2 = l1*sin(theta1) + l2/2*sin(theta2);
        constraint guide: l1*sin(theta1) + l2*sin(theta2) = 0;
        constraint slider: x3 = l1*cos(theta1) + l2*cos(theta2);
        start {
            theta1 = 0;
            guess x1 = l1/2;
            guess x2 = l1 + l2/2;
            guess x3 = l1 + l2;
            der(theta1) = omega;
        }
        output crank_speed [rpm] = der(theta1);
    }
}

/// θ1 after 0.3 s with 0.5 N·m on the crank from 200 rpm, by DOP853 with a tolerance of 1e-12;
/// as in `order.rs`.
const REFERENCE: f64 = 5.644159549774;
const END: f64 = 0.3;
const TORQUE: f64 = 0.5;

/// A step as textbooks write it: k₁ to k₄ of positions and of velocities.
fn by_the_book<M: Mechanism, X: Method>(
    mechanism: &M,
    at: &State<M::States>,
    inputs: &M::Inputs,
    gains: &Gains<M::Real>,
    h: M::Real,
    t_next: M::Real,
) -> Stepped<M::States> {
    let number = M::Real::from_f64;
    let (half_h, two) = (number(0.5) * h, number(2.0));
    let first = mechanism.stabilized(at, inputs, gains);
    let solve = |t, q, v| {
        let at = State { t, q, v };
        if X::EXPLICIT.is_held() {
            let solved = mechanism.constrained(&at, inputs, &first.feedback);
            (solved.acceleration, solved.growth)
        } else {
            let solved = mechanism.stabilized(&at, inputs, gains);
            (solved.acceleration, solved.growth)
        }
    };
    let moved = |x: M::States, by: M::Real, k: M::States| x.zip_map(k, |x, k| x + by * k);
    let (v1, a1) = (at.v, first.acceleration);
    let v2 = moved(at.v, half_h, a1);
    let (a2, growth2) = solve(at.t + half_h, moved(at.q, half_h, v1), v2);
    let v3 = moved(at.v, half_h, a2);
    let (a3, growth3) = solve(at.t + half_h, moved(at.q, half_h, v2), v3);
    let v4 = moved(at.v, h, a3);
    let (a4, growth4) = solve(t_next, moved(at.q, h, v3), v4);
    let mean = |k1: M::States, k2: M::States, k3: M::States, k4: M::States| {
        let sum = k1.zip_map(k2, |k1, k2| k1 + two * k2);
        sum.zip_map(k3, |sum, k3| sum + two * k3).zip_map(k4, |sum, k4| sum + k4)
    };
    let sixth_h = number(1.0 / 6.0) * h;
    let q = moved(at.q, sixth_h, mean(v1, v2, v3, v4));
    let v = moved(at.v, sixth_h, mean(a1, a2, a3, a4));
    let growth = first.growth + growth2 + growth3 + growth4;
    Stepped { next: State { t: t_next, q, v }, growth, sum: M::Real::default() }
}

fn fused_is_by_the_book<M: Mechanism<Scheme = Rk4>, X: Method<Scheme = Rk4>>(
    mechanism: &M,
    inputs: M::Inputs,
) {
    let number = M::Real::from_f64;
    let h = number(0.5e-3);
    let gains = Baumgarte::<X>::deadbeat(0.5e-3).gains();
    let mut random = Random::new(11);
    let start = mechanism.declared_start();
    let mut at = State { t: start.t, q: M::states(start.q), v: M::states(start.v) };
    for _ in 0..300 {
        let scale = if random.between(0.0, 1.0) < 0.5 { 0.0 } else { 1e-3 };
        let mut off = at.q.into_array();
        off.as_mut().iter_mut().for_each(|q| *q = *q + number(scale * random.between(-1.0, 1.0)));
        let from = State { q: Components::from_array(off), ..at };
        let t_next = at.t + h;
        let fused = mechanism.fused_step::<X>(&from, &inputs, &gains, h, t_next).expect("a small mechanism");
        let expected = by_the_book::<M, X>(mechanism, &from, &inputs, &gains, h, t_next);
        assert_eq!((fused.next, fused.growth), (expected.next, expected.growth));
        at = by_the_book::<M, X>(mechanism, &at, &inputs, &gains, h, t_next).next;
    }
}

#[test]
fn fused_steps_are_those_of_the_textbook() {
    fused_is_by_the_book::<_, Held<Rk4>>(&Crank::declared(), CrankInputs { crank_torque: TORQUE });
    fused_is_by_the_book::<_, PerStage<Rk4>>(&Crank::declared(), CrankInputs { crank_torque: TORQUE });
    let single = Crank::<f32>::new(CrankParameters::default()).expect("declared parameters");
    fused_is_by_the_book::<_, Held<Rk4>>(&single, CrankInputs { crank_torque: 0.5 });
}

fn run<X: Method>(steps: u32, baumgarte: Baumgarte<X>) -> Simulation<SliderCrankFree, X> {
    let mut simulation = Simulation::builder(SliderCrankFree::declared(), END / f64::from(steps))
        .baumgarte(baumgarte)
        .inputs(SliderCrankFreeInputs { crank_torque: TORQUE })
        .build()
        .expect("a valid start");
    simulation.advance_to(END).expect("a regular motion");
    simulation
}

/// One mechanism declares the scheme and fuses its steps, the other is asked for it and takes
/// them in stages; a third asks for Heun's method against its declaration.
#[test]
fn a_declared_scheme_is_the_default() {
    let inputs = CrankInputs { crank_torque: TORQUE };
    let mut declared =
        Simulation::builder(Crank::declared(), END / 600.0).inputs(inputs).build().expect("ok");
    declared.advance_to(END).expect("a regular motion");
    let asked = run(600, Baumgarte::<Held<Rk4>>::deadbeat(END / 600.0));
    assert_eq!(declared.state().q.into_array(), asked.state().q.into_array());
    assert_eq!(declared.state().v.into_array(), asked.state().v.into_array());
    assert_eq!(<Crank as Mechanism>::Scheme::TABLEAU.word, "rk4");

    let builder = Simulation::builder(Crank::declared(), END / 600.0).inputs(inputs);
    let mut heun = builder.method::<Held<Heun>>().build().expect("ok");
    heun.advance_to(END).expect("a regular motion");
    let expected = run(600, Baumgarte::<Held>::deadbeat(END / 600.0));
    assert_eq!(heun.state().q.into_array(), expected.state().q.into_array());
}

/// From runs with steps of h = 0.5 ms and of its halves: log2 of the ratio of neighbouring
/// differences is the order p + κh, since the error is c hᵖ (1 + O(h)), and two of these tell p.
/// Rounding (a random walk of 4800 steps of 1e-15) is 0.2 % of the smallest difference or less.
/// The finest run also ends at the reference, within its last digit and what is left of the
/// error.
fn observed_order<X: Method>(what: &str, baumgarte: impl Fn(f64) -> Baumgarte<X>) -> f64 {
    let end = |steps: u32| run(steps, baumgarte(END / f64::from(steps))).state().q.theta1;
    let ends = [600, 1200, 2400, 4800].map(end);
    let differences = [0, 1, 2].map(|at| (ends[at] - ends[at + 1]).abs());
    let ratios = [0, 1].map(|at| (differences[at] / differences[at + 1]).log2());
    let order = 2.0 * ratios[1] - ratios[0];
    println!("{what}: {ratios:.4?}, so {order:.4}, differences {differences:?}");
    assert!((ends[3] - REFERENCE).abs() < 5e-13 + differences[2], "{what}: {}", ends[3]);
    order
}

#[test]
fn order_is_four() {
    let fixed = |_| Baumgarte::<PerStage<Rk4>>::new(200.0, 200.0).expect("valid gains");
    for (what, order) in [
        ("held, deadbeat", observed_order("held, deadbeat", Baumgarte::<Held<Rk4>>::deadbeat)),
        ("per stage, fixed gains", observed_order("per stage, fixed gains", fixed)),
        ("none", observed_order("none", |_| Baumgarte::<Held<Rk4>>::NONE)),
    ] {
        assert!((order - 4.0).abs() < 0.1, "{what}: {order}");
    }
}

/// With β ~ 1/h the position errors of the stages, O(h²), come back as accelerations of
/// O(1): as documented at [`PerStage`].
#[test]
fn feedback_in_each_stage_with_gains_that_follow_the_step_has_order_two() {
    let order = observed_order("per stage, deadbeat", Baumgarte::<PerStage<Rk4>>::deadbeat);
    assert!((order - 2.0).abs() < 0.2, "{order}");
}

/// The error of θ1 at h = 0.5 ms is 1.6e-8 rad, 16 to 20 times that of `order_is_four` at
/// half the step; rounding leaves 600 steps of ε of 6 rad, enlarged as errors of a rotation are.
#[test]
fn every_path_keeps_the_reference() -> Result<(), Error> {
    let start = |step| {
        let builder = Simulation::builder(SliderCrankFree::declared(), step).method::<Held<Rk4>>();
        builder.inputs(SliderCrankFreeInputs { crank_torque: TORQUE }).build()
    };
    through_every_path("rk4, asked for", 0.5e-3, paths::Single::Longer(1.0), start, |case, run| {
        run.advance_to(END)?;
        case.near_within("theta1", run.now()?.q.theta1, REFERENCE, 2e-8, 1e-12);
        Ok(())
    })?;
    let start = |step| {
        Simulation::builder(Crank::declared(), step).inputs(CrankInputs { crank_torque: TORQUE }).build()
    };
    through_every_path("rk4, declared", 0.5e-3, paths::Single::Longer(1.0), start, |case, run| {
        run.advance_to(END)?;
        case.near_within("theta1", run.now()?.q.theta1, REFERENCE, 2e-8, 1e-12);
        Ok(())
    })
}

/// In eight lanes and on all cores, each with another torque.
#[test]
fn members_of_an_ensemble_are_their_simulations() {
    let member = |at: usize| {
        let inputs = CrankInputs { crank_torque: 0.1 * at as f64 };
        Simulation::builder(Crank::declared(), 1e-3).inputs(inputs).build()
    };
    let outcomes = Ensemble::new(END).run(19, member, &Samples::every(300)).expect("nobody cancels");
    assert_eq!(outcomes.len(), 19);
    for (at, outcome) in outcomes.into_iter().enumerate() {
        let mut alone = member(at).expect("a valid start");
        alone.advance_to(END).expect("a regular motion");
        let run = outcome.expect("a run");
        assert_eq!(run.state.q, alone.state().q, "member {at}");
    }
}

fn long_steps_are_stages<X: Method>(baumgarte: Baumgarte<X>) {
    let builder = Simulation::builder(NPendulum40::declared(), 1e-3).baumgarte(baumgarte);
    let mut long = builder.build().expect("a valid start");
    let mut staged = long;
    for _ in 0..200 {
        long.step().expect("a regular motion");
        staged.step_in_stages().expect("a regular motion");
    }
    assert_eq!(long.state(), staged.state());
}

#[test]
fn steps_on_arrays_are_those_in_stages() {
    long_steps_are_stages(Baumgarte::<Held<Rk4>>::deadbeat(1e-3));
    long_steps_are_stages(Baumgarte::<PerStage<Rk4>>::new(200.0, 200.0).expect("valid gains"));
}

/// Differences between runs with h, h/2 and h/4 have the ratio 2⁴ up to the next term.
#[test]
fn order_is_four_in_loops() {
    let end = |step: f64| {
        let mut run = Simulation::builder(NPendulum40::declared(), step)
            .method::<Held<Rk4>>()
            .build()
            .expect("a valid start");
        run.advance_to(0.32).expect("a regular motion");
        run.state().q.into_array()
    };
    let [coarse, middle, fine] = [4e-3, 2e-3, 1e-3].map(end);
    let distance = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>().sqrt();
    let order = (distance(&coarse, &middle) / distance(&middle, &fine)).log2();
    println!("{order:.4}");
    assert!((order - 4.0).abs() < 0.1, "{order}");
}

/// A rod that is too short cannot follow the crank; the step that ends beyond its reach
/// fails, with the constraint, in the same place as with Heun's method.
#[test]
fn what_is_out_of_reach_is_named() {
    let parameters = SliderCrankParameters { l2: 0.05, ..SliderCrankParameters::default() };
    let crank = SliderCrank::new(parameters).expect("a rod of 50 mm");
    let heun = Simulation::new(crank, 0.5e-3).expect("ok").advance_to(1.0);
    let rk4 = Simulation::builder(crank, 0.5e-3).method::<Held<Rk4>>().build().expect("ok").advance_to(1.0);
    let name = |result: &Result<(), Error>| match result {
        Err(Error::OutOfReach { constraint, .. }) => *constraint,
        other => panic!("{other:?}"),
    };
    assert_eq!(name(&heun), name(&rk4));
}
