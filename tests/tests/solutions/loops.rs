//! Chains as loops and as straight lines are the same program: every operation
//! is done on the same operands, so that results agree to the bit.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::lanes::Pack;
use mbs_runtime::{
    Baumgarte, Components, Error, Held, Mechanism, Method, PerStage, Simulation, State, mechanism,
};
use models::{NFourBar40, NPendulum40};
use tests::four_bar;

/// The same declaration with loops wherever they pay, and without any.
macro_rules! both {
    ($loops:ident, $straight:ident; $($body:tt)*) => {
        mechanism! { pub $loops { limit unrolled = 0; $($body)* } }
        mechanism! { pub $straight { limit unrolled = 1_000_000; $($body)* } }
    };
}

both! { PendulumLoops, PendulumStraight;
    dof = 12;
    const N = 12;
    param l = 0.4 [m] where l > 0;
    param c = 0.02 [N*m*s];
    input torque [N*m];
    gravity = (0, -9.81) [m/s^2];
    for i in 1..=N {
        // every rod has a mass of its own
        body rod[i] (x[i], y[i], theta[i]) { mass = (1 + i/10) [kg]; inertia = (1 + i/10)*(l^2/12)*1 [kg]; }
        point base on rod[i] = (-l/2, 0);
        point tip on rod[i] = (l/2, 0);
        if i == 1 { revolute pin[i] (rod[i].base, ground); }
        if i > 1 { revolute pin[i] (rod[i-1].tip, rod[i].base); }
        torsion_friction bearing[i] (rod[i], ground) { torque = 0.1 [N*m]; transition = 0.5 [rad/s]; }
        start { theta[i] = (i*17) [deg]; der(theta[i]) = i*0.3 [rad/s]; }
        output height[i] = rod[i].tip.y;
        output pull[i] = lambda(pin[i].x);
    }
    torque motor on rod[N] = torque;
}

four_bar!(mechanism; FourBarLoops 12 limit unrolled = 0; output speed = der(theta[0]););
four_bar!(mechanism; FourBarStraight 12 limit unrolled = 1_000_000; output speed = der(theta[0]););

/// Everything that generated code computes, along a run.
fn run<M: Mechanism<Real = f64>>(steps: usize) -> Vec<u64> {
    let mechanism = M::new(M::Parameters::default()).expect("declared values are valid");
    let mut simulation = Simulation::builder(mechanism, 1e-3).build().expect("the start is consistent");
    let mut values = Vec::new();
    for step in 0..steps {
        if step % 16 == 0 {
            let State { t, q, v } = simulation.state();
            let at = simulation.state();
            let reactions = simulation.reactions().expect("the position is regular");
            let outputs = simulation.outputs().expect("the position is regular");
            values.extend_from_slice(q.into_array().as_ref());
            values.extend_from_slice(v.into_array().as_ref());
            values.extend_from_slice(reactions.acceleration.into_array().as_ref());
            values.extend_from_slice(reactions.multipliers.into_array().as_ref());
            values.extend_from_slice(outputs.into_array().as_ref());
            let mechanism = simulation.mechanism();
            values.extend_from_slice(mechanism.phi(t, &q).into_array().as_ref());
            values.extend_from_slice(mechanism.phi_dot(&at).into_array().as_ref());
            values.extend(mechanism.points(t, &q).as_ref().iter().flatten());
            values.push(mechanism.kinetic_energy(&at));
            values.push(mechanism.potential_energy(&at));
            values.extend(mechanism.worst_pivot(t, &q).map(|(_, growth)| growth));
        }
        simulation.step().expect("no step ends in a singular position");
    }
    values.into_iter().map(f64::to_bits).collect()
}

#[test]
fn loops_are_the_straight_lines_of_a_pendulum() {
    assert_eq!(run::<PendulumLoops>(200), run::<PendulumStraight>(200));
}

#[test]
fn loops_are_the_straight_lines_of_four_bars() {
    // through the change points of these parallelograms, where bars are aligned
    assert_eq!(run::<FourBarLoops>(1200), run::<FourBarStraight>(1200));
    let mut simulation = Simulation::builder(FourBarLoops::declared(), 1e-3).build().expect("consistent");
    simulation.advance_to(1.2).expect("no step ends in a singular position");
    assert!(simulation.state().q.theta_0 < -1.0, "it has gone through θ = 0");
}

/// The description says whether a mechanism has loops.
#[test]
fn the_description_tells_loops_from_straight_lines() {
    let loops = |info: &mbs_runtime::Info| info.functions.iter().any(|function| function.loops > 0);
    assert!(loops(<PendulumLoops>::INFO) && loops(<FourBarLoops>::INFO));
    assert!(!loops(<PendulumStraight>::INFO) && !loops(<FourBarStraight>::INFO));
}

mechanism! {
    /// Long, and without any constraint.
    pub Springs {
        dof = 160;
        const N = 80;
        param k = 200 [N/m];
        param m = 0.3 [kg];
        gravity = (0, -9.81) [m/s^2];
        for i in 1..=N {
            body mass[i] (x[i], y[i]) { mass = m; }
            if i == 1 { spring string[i] (ground, mass[i]) { stiffness = k; damping = 1 [N*s/m]; length = 0.2 [m]; } }
            if i > 1 { spring string[i] (mass[i-1], mass[i]) { stiffness = k; damping = 1 [N*s/m]; length = 0.2 [m]; } }
            start { x[i] = (0.25*i) [m]; y[i] = (0.01*sin(i)) [m]; }
        }
    }
}

/// Runs steps whole, in stages, as errors are looked for, and in lanes.
fn whole_and_in_stages<M: Mechanism<Real = f64>, X: Method>(feedback: fn(f64) -> Baumgarte<X>) {
    let mechanism = M::new(M::Parameters::default()).expect("declared values are valid");
    let mut whole = Simulation::builder(mechanism, 1e-3)
        .baumgarte(feedback(1e-3))
        .build()
        .expect("the start is consistent");
    let mut stages = whole;
    let mut lanes = Pack::new([whole; 3]);
    let bits = |State { t, q, v }: State<M::Coordinates>| {
        let (q, v) = (q.into_array(), v.into_array());
        let all = q.as_ref().iter().chain(v.as_ref()).chain([&t]).map(|x| x.to_bits());
        all.collect::<Vec<_>>()
    };
    for _ in 0..100 {
        whole.step().expect("no step ends in a singular position");
        stages.step_in_stages().expect("nor in stages");
        assert_eq!(lanes.step(), [true; 3]);
        assert_eq!(bits(whole.state()), bits(stages.state()));
        assert_eq!(bits(whole.state()), bits(lanes.state(2)));
    }
}

/// Long steps convert their state to arrays once; in stages it is converted for each.
#[test]
fn long_steps_are_those_in_stages() {
    const { assert!(Springs::<f64>::OPERATIONS > 1024, "short programs have no loops") };
    whole_and_in_stages::<NPendulum40, Held>(Baumgarte::deadbeat);
    whole_and_in_stages::<NPendulum40, PerStage>(Baumgarte::deadbeat);
    whole_and_in_stages::<NFourBar40, Held>(Baumgarte::deadbeat);
    whole_and_in_stages::<NFourBar40, PerStage>(Baumgarte::deadbeat);
    whole_and_in_stages::<Springs, Held>(Baumgarte::deadbeat);
    whole_and_in_stages::<Springs, PerStage>(Baumgarte::deadbeat);
}

/// A long step that is no good leaves the state alone, and the error is that of a stage.
#[test]
fn a_bad_long_step_changes_nothing() {
    let mut start = Simulation::new(NPendulum40::declared(), 1e-3).expect("consistent").state();
    start.v.theta_7 = 1e200;
    let mut simulation = Simulation::builder(NPendulum40::declared(), 1e-3)
        .from_state(start)
        .as_declared()
        .build()
        .expect("large, but finite");
    assert!(matches!(simulation.step(), Err(Error::NonFinite { .. })));
    assert_eq!(simulation.state(), start);
    assert_eq!(simulation.steps(), 0);
}
