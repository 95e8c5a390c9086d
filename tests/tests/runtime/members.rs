//! Members that have no result, or came close to having none.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_ensemble::{Ensemble, Extremes, Observe, Violation};
use mbs_runtime::{Error, Simulation, mechanism};

mechanism! {
    /// A driven slider with a force that ends in no number: q̈ does not feel it.
    Driven {
        dof = 0;
        param te = 0.5 [s];
        body slider (x) { mass = 1 [kg]; }
        drive motor: x = 1 [m/s]*t;
        force push on x = 1 [N]*sqrt((te - t)/(1 [s]));
        output pull [N] = effort(motor);
    }
}

/// Every third one has no number from 0.3 s on.
fn member(index: usize) -> Result<Simulation<Driven>, Error> {
    let te = if index.is_multiple_of(3) { 0.305 } else { 2.0 };
    Simulation::new(Driven::new(DrivenParameters { te })?, 1e-2)
}

/// Regression: the peaks of such members came from what was finite, without an error.
#[test]
fn member_without_a_number_ends_with_its_name() {
    let runs = Ensemble::new(1.0).run(10, member, &Extremes::default()).expect("nobody cancels");
    for (index, run) in runs.into_iter().enumerate() {
        let run = run.expect("a start");
        let mut alone = member(index).expect("a start");
        let mut error = None;
        while error.is_none() && alone.time() < 0.995 {
            alone.step().expect("a step");
            error = alone.outputs().err();
        }
        assert_eq!(format!("{:?}", run.ended), format!("{error:?}"), "{index}");
        assert_eq!(run.ended.is_some(), index.is_multiple_of(3));
        assert_eq!((run.state, run.steps), (alone.state(), alone.steps()));
    }
}

/// A quantity need not be a number before the time from which one looks.
#[test]
fn what_nobody_asks_for_need_not_be_a_number() {
    let late = Extremes { from: 0.5 };
    let ends = |end: f64| {
        let runs = Ensemble::new(end).run(4, member, &late).expect("nobody cancels");
        runs.into_iter().map(|run| run.expect("a start").ended.is_some()).collect::<Vec<_>>()
    };
    assert_eq!(ends(0.45), [false; 4]);
    assert_eq!(ends(0.6), [true, false, false, true]);
}

mechanism! {
    /// A slider that goes on.
    Ramp {
        dof = 1;
        body slider (x, y) { mass = 1 [kg]; }
        constraint floor: y = 0;
        start { x = 0; der(x) = 1 [m/s]; }
        output place [m] = x;
    }
}

/// An observer that sees nothing from a place on.
struct Blind;

impl Observe<Ramp> for Blind {
    type Notes<const N: usize> = ();
    type Result = ();

    fn begin<const N: usize>(&self) {}
    fn observe<const N: usize>(
        &self,
        (): &mut (),
        at: &mbs_runtime::lanes::Snapshot<'_, Ramp, N>,
    ) -> [bool; N] {
        at.state().q.x.test(at.state().q.x, |x, _| x < 0.25)
    }
    fn finish<const N: usize>(&self, (): &(), _: usize) {}
}

#[test]
fn what_an_observer_cannot_see_ends_the_member() {
    let member = |_| Simulation::new(Ramp::declared(), 1e-2);
    let runs = Ensemble::new(1.0).run(3, member, &(Blind, Violation)).expect("nobody cancels");
    for run in runs {
        let run = run.expect("a start");
        assert!(matches!(run.ended, Some(Error::NonFinite { coordinate: "what is observed", .. })));
        assert_eq!(run.steps, 25);
    }
}

mechanism! {
    /// A slider-crank with a rod that is hardly longer than the crank: upright, the guide
    /// hardly determines its angle.
    SliderCrank {
        dof = 0;
        param excess = 1;
        const crank = 1 [m];
        const omega = 1 [rad/s];
        let rod = crank*(1 + excess);
        body wheel  (angle = phi) { inertia = 1 [kg*m^2]; }
        body link   (angle = psi) { inertia = 1 [kg*m^2]; }
        body slider (x)           { mass = 1 [kg]; }
        constraint guide: crank*sin(phi) + rod*sin(psi) = 0;
        constraint pin: x = crank*cos(phi) + rod*cos(psi);
        drive motor: phi = omega*t;
        start { guess x = 2 [m]; }
    }
}

/// Upright, cos ψ = −√(1 − 1/(1 + δ)²) ≈ √(2δ), which both stages of a step divide by.
#[test]
fn members_tell_how_close_they_came() {
    let member = |excess: f64| {
        Simulation::new(SliderCrank::new(SliderCrankParameters { excess })?, excess.sqrt() / 50.0)
    };
    let excesses = [1.0, 1e-2, 1e-4, 1e-6];
    let runs = Ensemble::new(2.0).run(4, |index| member(excesses[index]), &()).expect("nobody cancels");
    for (excess, run) in excesses.into_iter().zip(runs) {
        let run = run.expect("a start");
        let mut alone = member(excess).expect("a start");
        alone.advance_to(2.0).expect("a motion");
        assert_eq!((run.ended, run.state), (None, alone.state()));
        assert_eq!((run.digits_left, run.worst_place), (alone.digits_left(), alone.worst_place()));
        let expected = 2.0 / (1.0 - 1.0 / (1.0 + excess).powi(2)).sqrt();
        let growth = alone.worst_growth();
        println!("{excess}: {growth} {expected} {} {:?}", run.digits_left, run.worst_place);
        assert!((growth / expected - 1.0).abs() < 0.01, "{excess}: {growth} {expected}");
        assert!((run.digits_left + (f64::EPSILON * growth).log10()).abs() < 1e-12);
        match run.worst_place {
            None => assert!(growth <= 64.0),
            Some(place) => {
                assert_eq!((place.constraint, place.coordinate), ("guide", "psi"));
                // where cos ψ is at most twice its smallest
                let apart = (place.t - std::f64::consts::FRAC_PI_2).abs();
                assert!(growth > 64.0 && apart < 2.0 * (2.0 * excess).sqrt(), "{place:?}");
            }
        }
    }
}
