//! Mechanisms that are declared twice, for Rust and for C: both run alike, from the start on, to
//! the bit, and end with the same error where one ends.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use c_code::{Built, Choice, Fault, build, compilers};
use mbs_codegen::analyse;
use mbs_codegen::targets::{Scalar, c};
use mbs_runtime::{
    Baumgarte, Components, Error, Held, Mechanism, Method, PerStage, Real, Rk4, Simulation, mechanism,
};
use paths::EXHAUSTIVE;

/// A declaration for Rust, and as text.
macro_rules! declared {
    ($text:ident; $($tokens:tt)*) => {
        mechanism! { $($tokens)* }
        const $text: &str = stringify!($($tokens)*);
    };
}

declared! { SLIDER_CRANK;
    pub SliderCrank {
        dof = 0;
        param l1 = 60 [mm];    param l2 = 180 [mm];
        param m1 = 0.5 [kg];   param m2 = 1.2 [kg];   param m3 = 2.0 [kg];
        param omega = 200 [rpm];
        gravity = (0, -9.81) [m/s^2];
        body crank  (x1, y1, theta1) { mass = m1; inertia = m1*l1^2/12; }
        body rod    (x2, y2, theta2) { mass = m2; inertia = m2*l2^2/12; }
        body slider (x3)             { mass = m3; }
        point base on crank = (-l1/2, 0);    point tip on crank = (l1/2, 0);
        point base on rod   = (-l2/2, 0);    point tip on rod   = (l2/2, 0);
        revolute pivot (crank.base, ground);
        revolute pin   (crank.tip, rod.base);
        revolute wrist (rod.tip, slider);
        drive crank_speed: theta1 = omega*t;
        output torque [N*m] = effort(crank_speed);
    }
}

declared! { FREE;
    pub FreeCrank {
        dof = 1;
        param l1 = 60 [mm];    param l2 = 180 [mm];
        input int [N*m];
        gravity = (0, -9.81) [m/s^2];
        body crank  (x1, y1, theta1) { mass = 0.5 [kg]; inertia = 0.01 [kg*m^2]; }
        body rod    (x2, y2, theta2) { mass = 1.2 [kg]; inertia = 0.02 [kg*m^2]; }
        body slider (x3)             { mass = 2 [kg]; }
        point base on crank = (-l1/2, 0);    point tip on crank = (l1/2, 0);
        point base on rod   = (-l2/2, 0);    point tip on rod   = (l2/2, 0);
        revolute pivot (crank.base, ground);
        revolute pin   (crank.tip, rod.base);
        revolute wrist (rod.tip, slider);
        torque motor on crank = int;
        start { theta1 = 0; der(theta1) = 20 [rad/s]; }
        output speed [rpm] = der(theta1);
        output sharpness = tanh(theta1) + exp(-theta1^2) + abs(x1)/l1;
    }
}

declared! { FOURTH_ORDER;
    pub AccurateCrank {
        dof = 1;
        method = rk4;
        param l1 = 60 [mm];    param l2 = 180 [mm];
        input load [N*m];
        gravity = (0, -9.81) [m/s^2];
        body crank  (x1, y1, theta1) { mass = 0.5 [kg]; inertia = 0.01 [kg*m^2]; }
        body rod    (x2, y2, theta2) { mass = 1.2 [kg]; inertia = 0.02 [kg*m^2]; }
        body slider (x3)             { mass = 2 [kg]; }
        point base on crank = (-l1/2, 0);    point tip on crank = (l1/2, 0);
        point base on rod   = (-l2/2, 0);    point tip on rod   = (l2/2, 0);
        revolute pivot (crank.base, ground);
        revolute pin   (crank.tip, rod.base);
        revolute wrist (rod.tip, slider);
        torque motor on crank = load*cos(5 [rad/s]*t);
        start { theta1 = 0; der(theta1) = 20 [rad/s]; }
    }
}

declared! { ROUGH;
    pub ThrownBlock {
        dof = 3;
        method = rk4;
        param mu = 0.4;
        gravity = (0, -9.81) [m/s^2];
        body block (x, y, phi) { mass = 3 [kg]; inertia = 0.05 [kg*m^2]; }
        point left on block = (-0.2 [m], -0.1 [m]);
        point right on block = (0.2 [m], -0.1 [m]);
        stop at_left: block.left.y >= 0 [m] { restitution = 0.3; friction = mu; along = block.left.x; }
        stop at_right: block.right.y >= 0 [m] { restitution = 0.3; friction = mu; along = block.right.x; }
        start { y = 0.3 [m]; phi = 0.4; der(x) = 2 [m/s]; der(phi) = 4 [rad/s]; }
    }
}

declared! { FOURTH_ORDER_CHAIN;
    pub AccurateChain {
        dof = 40;
        method = rk4;
        const N = 40;
        gravity = (0, -9.81) [m/s^2];
        for i in 1..=N {
            body bob[i] (x[i], y[i], angle[i]) { mass = 1 [kg]; inertia = (1/12) [kg*m^2]; }
            point top on bob[i] = (0, 0.5 [m]);
            point end on bob[i] = (0, -0.5 [m]);
            if i == 1 {
                revolute pin[i] (ground, bob[i].top);
            } else {
                revolute pin[i] (bob[i-1].end, bob[i].top);
            }
            start { angle[i] = 30 [deg]; der(angle[i]) = 0; }
        }
    }
}

declared! { REDUNDANT;
    pub Parallelogram {
        dof = 1;
        redundant = minimum_norm;
        param a = 0.3 [m];  param b = 0.5 [m];
        gravity = (0, -9.81) [m/s^2];
        body left  (x1, y1, theta1) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        body right (x2, y2, theta2) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        body third (x4, y4, theta4) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        body bar   (x3, y3, theta3) { mass = 2 [kg]; inertia = 0.05 [kg*m^2]; }
        point foot on left  = (-a/2, 0);   point head on left  = (a/2, 0);
        point foot on right = (-a/2, 0);   point head on right = (a/2, 0);
        point foot on third = (-a/2, 0);   point head on third = (a/2, 0);
        point start on bar  = (-b/2, 0);   point end on bar    = (b/2, 0);
        point second on ground = (b, 0);   point middle on ground = (b/2, 0);
        revolute p1 (left.foot, ground);
        revolute p2 (right.foot, ground.second);
        revolute p3 (third.foot, ground.middle);
        revolute p4 (left.head, bar.start);
        revolute p5 (right.head, bar.end);
        revolute p6 (third.head, bar);
        start { theta1 = 60 [deg]; guess theta2 = 60 [deg]; guess theta4 = 60 [deg]; guess theta3 = 0;
                guess x3 = 0.4 [m]; guess y3 = 0.26 [m]; }
    }
}

declared! { REACH;
    pub ShortRod {
        dof = 0;
        param l1 = 60 [mm];    param l2 = 50 [mm];
        body crank  (x1, y1, theta1) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        body rod    (x2, y2, theta2) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        body slider (x3)             { mass = 2 [kg]; }
        point base on crank = (-l1/2, 0);    point tip on crank = (l1/2, 0);
        point base on rod   = (-l2/2, 0);    point tip on rod   = (l2/2, 0);
        revolute pivot (crank.base, ground);
        revolute pin   (crank.tip, rod.base);
        revolute wrist (rod.tip, slider);
        drive crank_speed: theta1 = 3 [rad/s]*t;
    }
}

pendulum!(mechanism; Rods40 40);

/// Runs both, and compares states, accelerations, multipliers and outputs as numbers.
fn compare<M, X: Method>(text: &str, mechanism: M, baumgarte: Baumgarte<X>, step: f64, inputs: &[f64])
where
    M: Mechanism,
{
    const STEPS: usize = 1000;
    let is_float = size_of::<M::Real>() == 4;
    let Some(built) = built(text, if is_float { Scalar::Float } else { Scalar::Double }) else { return };
    let mut array = M::Inputs::default().into_array();
    // memories of a run are no numbers: it sets them
    for (to, from) in array.as_mut().iter_mut().zip(inputs).filter(|(_, from)| !from.is_nan()) {
        *to = M::Real::from_f64(*from);
    }
    let mut run = Simulation::builder(mechanism, step)
        .baumgarte(baumgarte)
        .inputs(M::Inputs::from_array(array))
        .build()
        .expect("it starts");
    let feedback = Some((baumgarte.alpha(), baumgarte.beta(), X::EXPLICIT.is_held()));
    let choice = Choice { step, steps: STEPS, every: 1, feedback, inputs, start: None };
    let lines = built.run(&choice).unwrap_or_else(|fault| panic!("{}: {fault}", M::INFO.name));
    assert_eq!(lines.len(), STEPS + 1);
    for (at, line) in lines.iter().enumerate() {
        let (state, reactions) = (run.state(), run.reactions().expect("reactions"));
        let outputs = run.outputs().expect("outputs").into_array();
        let (q, v) = (state.q.into_array(), state.v.into_array());
        let (a, multipliers) = (reactions.acceleration.into_array(), reactions.multipliers.into_array());
        let vectors = [q.as_ref(), v.as_ref(), a.as_ref(), multipliers.as_ref(), outputs.as_ref()];
        let expected = std::iter::once(&state.t).chain(vectors.into_iter().flatten());
        let expected: Vec<f64> = expected.map(|x| x.to_f64()).collect();
        assert_eq!(line, &expected, "{}, step {at}", M::INFO.name);
        run.step().expect("a step");
    }
}

fn built(text: &str, scalar: Scalar) -> Option<Built> {
    let compiler = *compilers().first()?;
    let compiled = analyse(text.parse().expect("tokens")).unwrap_or_else(|error| panic!("{error}"));
    let sources = c(&compiled, scalar).unwrap_or_else(|error| panic!("{error}"));
    Some(build(&sources, compiler, crate::OPTIMIZATION).unwrap_or_else(|fault| panic!("{fault}")))
}

#[test]
fn the_driven_slider_crank_runs_alike() {
    compare(SLIDER_CRANK, SliderCrank::declared(), Baumgarte::<Held>::deadbeat(0.5e-3), 0.5e-3, &[]);
    compare(SLIDER_CRANK, SliderCrank::declared(), Baumgarte::<PerStage>::deadbeat(0.5e-3), 0.5e-3, &[]);
}

#[test]
fn a_free_crank_with_an_input_named_like_a_type_runs_alike() {
    compare(FREE, FreeCrank::declared(), Baumgarte::<Held>::deadbeat(1e-3), 1e-3, &[0.5]);
    compare(FREE, FreeCrank::declared(), Baumgarte::<PerStage>::deadbeat(1e-3), 1e-3, &[-0.25]);
}

/// Fused, and, where the growth of a step rises or the mechanism is long, stage by stage.
#[test]
fn schemes_of_higher_order_run_alike() {
    let held = Baumgarte::<Held<Rk4>>::deadbeat(1e-3);
    compare(FOURTH_ORDER, AccurateCrank::declared(), held, 1e-3, &[0.5]);
    if EXHAUSTIVE {
        let per_stage = Baumgarte::<PerStage<Rk4>>::deadbeat(1e-3);
        compare(FOURTH_ORDER, AccurateCrank::declared(), per_stage, 1e-3, &[0.5]);
        compare(FOURTH_ORDER_CHAIN, AccurateChain::declared(), held, 1e-3, &[]);
        compare(FOURTH_ORDER, AccurateCrank::<f32>::default(), held, 1e-3, &[0.5]);
    }
}

/// In both precisions: it hits with one corner and the other, slides and comes to rest.
#[test]
fn a_block_on_a_rough_floor_runs_alike() {
    let memories = [f64::NAN; 8];
    let held = Baumgarte::<Held<Rk4>>::deadbeat(1e-3);
    compare(ROUGH, ThrownBlock::declared(), held, 1e-3, &memories);
    if EXHAUSTIVE {
        let per_stage = Baumgarte::<PerStage<Rk4>>::deadbeat(1e-3);
        compare(ROUGH, ThrownBlock::declared(), per_stage, 1e-3, &memories);
        compare(ROUGH, ThrownBlock::<f32>::default(), held, 1e-3, &memories);
    }
}

#[test]
fn a_chain_in_loops_runs_alike() {
    let text = pendulum!(stringify; Rods40 40);
    compare(text, Rods40::declared(), Baumgarte::<Held>::deadbeat(1e-3), 1e-3, &[]);
    if EXHAUSTIVE {
        compare(text, Rods40::declared(), Baumgarte::<PerStage>::deadbeat(1e-3), 1e-3, &[]);
    }
}

#[test]
fn redundant_constraints_run_alike() {
    compare(REDUNDANT, Parallelogram::declared(), Baumgarte::<Held>::deadbeat(1e-4), 1e-4, &[]);
}

#[test]
fn in_single_precision_both_run_alike() {
    let mechanism = SliderCrank::<f32>::default();
    compare(SLIDER_CRANK, mechanism, Baumgarte::<Held>::deadbeat(0.5e-3), 0.5e-3, &[]);
}

#[test]
fn what_leads_out_of_reach_ends_both_in_the_same_step() {
    let Some(built) = built(REACH, Scalar::Double) else { return };
    let mut run = Simulation::new(ShortRod::declared(), 1e-3).expect("it starts");
    let error = loop {
        if let Err(error) = run.step() {
            break error;
        }
    };
    let Error::OutOfReach { constraint, .. } = error else { panic!("{error}") };
    let steps = run.steps() as usize;
    let run = |steps| {
        built.run(&Choice { step: 1e-3, steps, every: steps, feedback: None, inputs: &[], start: None })
    };
    assert_eq!(run(steps).expect("the last good step").len(), 2);
    let Err(Fault::Program(words)) = run(steps + 1) else { panic!("it goes on") };
    assert!(words.starts_with("error 5 ") && words.ends_with(constraint), "{words}: {constraint}");
}
