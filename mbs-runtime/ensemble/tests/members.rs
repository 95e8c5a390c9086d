//! What comes out of members that have no result, or came close to having none.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_ensemble::{Ensemble, Extremes, Observe, Violation};
use mbs_runtime::{Components, Error, Simulation, mechanism};

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
        assert_eq!((run.state, run.steps), (*alone.state(), alone.steps()));
    }
}

/// What lies before the time from which one looks need not be a number.
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
    /// A bead on a hyperbola.
    Bead {
        dof = 1;
        param near = 1e-3 [m];
        body bead (x, y) { mass = 1 [kg]; }
        constraint curve: x^2 - y^2 = near^2;
        start { y = -1 [m]; guess x = 1 [m]; der(y) = 2 [m/s]; }
    }
}

/// A bead on a hyperbola passes its vertex as close to the crossing of the asymptotes as
/// the parameter says: the size of the terms over the pivot.
#[test]
fn members_tell_how_close_they_came() {
    let bead = |near: f64| Simulation::new(Bead::new(BeadParameters { near })?, 1e-5);
    let nears = [0.5, 1e-2, 1e-3, 0.1];
    let runs = Ensemble::new(0.8).run(4, |index| bead(nears[index]), &()).expect("nobody cancels");
    for (near, run) in nears.into_iter().zip(runs) {
        let run = run.expect("a start");
        let mut alone = bead(near).expect("a start");
        let end = alone.advance_to(0.8);
        assert_eq!((run.ended, run.state), (end.err(), *alone.state()));
        assert_eq!((run.digits_left, run.worst_place), (alone.digits_left(), alone.worst_place()));
        println!("{near}: {} {:?} {:?}", alone.worst_growth(), alone.digits_left(), alone.worst_place());
        assert!(run.state.q.into_array().into_iter().all(f64::is_finite));
    }
}
