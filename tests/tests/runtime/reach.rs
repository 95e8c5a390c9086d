//! Mechanisms that are driven beyond what they can reach end in the step in which they
//! get there, with the constraint and the time, on every path of a step.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{
    Baumgarte, Components, Error, Held, Mechanism, Method, Pack, PerStage, Real, Simulation, mechanism,
};

mechanism! {
    /// A slider-crank whose rod may be shorter than its crank.
    SliderCrank {
        dof = 0;
        param crank_length = 60 [mm];
        param rod_length = 30 [mm];
        param omega = 200 [rpm];
        gravity = (0, -9.81) [m/s^2];
        body crank (x1, y1, theta1) { mass = 0.5 [kg]; inertia = 1e-4 [kg*m^2]; }
        body rod (x2, y2, theta2) { mass = 1.2 [kg]; inertia = 1e-4 [kg*m^2]; }
        body slider (x3) { mass = 2 [kg]; }
        point base on crank = (-crank_length/2, 0);
        point tip on crank = (crank_length/2, 0);
        point base on rod = (-rod_length/2, 0);
        point tip on rod = (rod_length/2, 0);
        revolute pivot (crank.base, ground);
        revolute pin (crank.tip, rod.base);
        revolute wrist (rod.tip, slider);
        drive motor: theta1 = omega*t;
        start { guess x1 = 0.03 [m]; guess x2 = 0.075 [m]; guess x3 = 0.09 [m]; }
        output torque [N*m] = effort(motor);
    }
}

mechanism! {
    /// A four-bar of which no bar can go round: the crank stops where coupler and
    /// rocker are one line.
    FourBar {
        dof = 0;
        param omega = 60 [rpm];
        const base = 1 [m];
        const crank_length = 0.8 [m];
        const coupler_length = 0.5 [m];
        const rocker_length = 0.6 [m];
        gravity = (0, -9.81) [m/s^2];
        body crank (x1, y1, a1) { mass = 1 [kg]; inertia = 0.05 [kg*m^2]; }
        body coupler (x2, y2, a2) { mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }
        body rocker (x3, y3, a3) { mass = 1 [kg]; inertia = 0.03 [kg*m^2]; }
        point base on crank = (-crank_length/2, 0);
        point tip on crank = (crank_length/2, 0);
        point base on coupler = (-coupler_length/2, 0);
        point tip on coupler = (coupler_length/2, 0);
        point base on rocker = (-rocker_length/2, 0);
        point tip on rocker = (rocker_length/2, 0);
        point far on ground = (base, 0);
        revolute left (crank.base, ground);
        revolute right (rocker.base, ground.far);
        revolute elbow (crank.tip, coupler.base);
        revolute knee (coupler.tip, rocker.tip);
        drive motor: a1 = 40 [deg] + omega*t;
        start {
            guess x1 = 0.31 [m]; guess y1 = 0.26 [m];
            guess x2 = 0.85 [m]; guess y2 = 0.55 [m]; guess a2 = 5 [deg];
            guess x3 = 1.05 [m]; guess y3 = 0.29 [m]; guess a3 = 80 [deg];
        }
    }
}

mechanism! {
    /// A bob on a rod that is pulled sideways: its pivot 2y is one term, which cannot cancel.
    Bob {
        dof = 0;
        param length = 1 [m];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 1 [kg]; }
        constraint rod: x^2 + y^2 = length^2;
        drive pull: x = 0.5*length + 1 [m/s]*t;
        start { guess y = 0.8 [m]; }
    }
}

/// sin θ₁ = l₂/l₁ s after the start.
fn end_of_slider(omega: f64) -> f64 {
    0.5_f64.asin() / omega
}

/// The tip of the crank is as far from the other pivot as coupler and rocker are long.
fn end_of_four_bar(omega: f64) -> f64 {
    let cosine = (1.0 + 0.8 * 0.8 - 1.1 * 1.1) / (2.0 * 0.8);
    (f64::acos(cosine) - 40.0_f64.to_radians()) / omega
}

/// The error, and the state that it leaves, of a run that has to end at `dead_end`.
fn check<M: Mechanism, X: Method>(
    name: &str,
    mut run: Simulation<M, X>,
    dead_end: f64,
    mut step: impl FnMut(&mut Simulation<M, X>) -> Result<(), Error>,
) {
    let h = run.step_size().to_f64();
    let error = loop {
        if let Err(error) = step(&mut run) {
            break error;
        }
        assert!(run.time().to_f64() < dead_end + 20.0 * h, "{name}: it goes on");
    };
    let violation = run.violation().to_f64();
    println!(
        "{name}: h = {h}, {:+.2} steps, violation {violation:.1e}: {error}",
        (run.time().to_f64() - dead_end) / h
    );
    let late = (run.time().to_f64() + h - dead_end) / h;
    assert!((-0.05..=1.05).contains(&late), "{name}: {late} steps late: {error}");
    let good = match error {
        Error::OutOfReach { t, constraint, .. } => {
            (t - run.time().to_f64() - h).abs() < 0.01 * h && !constraint.is_empty()
        }
        // a stage met the dead end itself
        Error::Singular { .. } => true,
        _ => false,
    };
    assert!(good, "{name}: {error}");
    assert!(run.state().q.is_finite() && violation < 0.02, "{name}: {violation}");
}

fn on_every_path<M: Mechanism<Real = f64>, S: Mechanism<Real = f32>, X: Method>(
    name: &str,
    mechanism: M,
    single: S,
    dead_end: f64,
) {
    for share in [9.6, 20.3, 37.0, 53.01, 100.5, 177.99, 301.77, 1000.0, 5000.1, 20000.9] {
        let h = dead_end / share;
        let gains = Baumgarte::<X>::deadbeat(h);
        let run = Simulation::builder(mechanism, h).baumgarte(gains).build().expect("a start");
        check(&format!("{name}, fused"), run, dead_end, Simulation::step);
        check(&format!("{name}, in stages"), run, dead_end, Simulation::step_in_stages);
        check(&format!("{name}, with reactions"), run, dead_end, |run| run.step_with_reactions().map(|_| ()));
        if share < 400.0 {
            let run = Simulation::builder(single, h).baumgarte(gains).build().expect("a start");
            check(&format!("{name}, in single precision"), run, dead_end, Simulation::step);
        }
        let mut pack = Pack::new([run; 4]);
        let mut alone = run;
        let error = loop {
            if let Err(error) = alone.step() {
                break error;
            }
        };
        while pack.advance(77) > 0 || pack.step() == [true; 4] {}
        assert_eq!(pack.state(2), alone.state());
        assert_eq!(pack.simulation(2).step(), Err(error), "{name}");
        assert!(run.worst_growth() == 0.0 && alone.worst_growth() > 2.0);
        assert_eq!(pack.simulation(2).worst_growth(), alone.worst_growth());
        assert_eq!(pack.simulation(2).worst_place(), alone.worst_place());
    }
}

#[test]
fn crank_that_cannot_go_round_ends_where_it_cannot_go_on() {
    let omega = SliderCrankParameters::<f64>::default().omega;
    let end = end_of_slider(omega);
    on_every_path::<_, SliderCrank<f32>, Held>("held", SliderCrank::declared(), SliderCrank::default(), end);
    on_every_path::<_, SliderCrank<f32>, PerStage>(
        "per-stage",
        SliderCrank::declared(),
        SliderCrank::default(),
        end,
    );
}

#[test]
fn four_bar_that_cannot_go_round_ends_where_it_cannot_go_on() {
    let omega = FourBarParameters::<f64>::default().omega;
    let end = end_of_four_bar(omega);
    on_every_path::<_, FourBar<f32>, Held>("held", FourBar::declared(), FourBar::default(), end);
    on_every_path::<_, FourBar<f32>, PerStage>("per-stage", FourBar::declared(), FourBar::default(), end);
}

/// x = length after half a second.
#[test]
fn bob_that_is_pulled_beyond_its_rod_ends_where_it_cannot_go_on() {
    on_every_path::<_, Bob<f32>, Held>("held", Bob::declared(), Bob::default(), 0.5);
    on_every_path::<_, Bob<f32>, PerStage>("per-stage", Bob::declared(), Bob::default(), 0.5);
}
