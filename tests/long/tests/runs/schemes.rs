//! Every scheme has its order on constrained mechanisms with exact solutions, with feedback and
//! with projection. The conditions of order themselves are tested where the coefficients are
//! (`mbs-interface`).
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::f64::consts::TAU;

use mbs_runtime::{
    DOP853, Error, Explicit, Mechanism, Method, MethodVisitor, SCHEMES, Simulation, State, Tableau,
    mechanism, with_type,
};
use models::slider_crank_free::{SliderCrankFree, SliderCrankFreeCoordinates};
use paths::EXHAUSTIVE;
use tests::swing::{Swing, SwingCoordinates, quarter_period};

mechanism! {
    /// Two sliders on a lever, one of them on a spring: (1 kg + 4 · 0.5 kg) ẍ = −12 N/m x.
    pub Lever {
        dof = 1;
        body near (x) { mass = 1 [kg]; }
        body far (x2) { mass = 0.5 [kg]; }
        constraint lever: x2 = 2*x;
        force spring on x = -12 [N/m]*x;
        start { x = 1 [m]; guess x2 = 2 [m]; }
    }
}

/// How far a run of so many steps is from where it should end.
struct Miss<M: Mechanism<Real = f64>> {
    mechanism: M,
    end: f64,
    steps: u32,
    miss: fn(&State<M::Coordinates>) -> f64,
}

impl<M: Mechanism<Real = f64>> MethodVisitor for Miss<M> {
    type Result = Result<f64, Error>;

    fn visit<X: Method>(self) -> Self::Result {
        let step = self.end / f64::from(self.steps);
        let mut run = Simulation::builder(self.mechanism, step).method::<X>().build()?;
        run.advance_to(self.end)?;
        Ok((self.miss)(&run.state()))
    }
}

/// After five quarters of its period 4 K(1/√2) √(l/g) the bob is at the bottom.
fn swing(method: Explicit, steps: u32) -> f64 {
    let end = 5.0 * quarter_period();
    let miss = |at: &State<SwingCoordinates>| at.q.x.hypot(at.q.y + 1.0);
    let miss = Miss { mechanism: Swing::declared(), end, steps, miss };
    with_type(method, miss).expect("a type").expect("a regular motion")
}

/// x = cos 2t, for ten periods.
fn lever(method: Explicit, steps: u32) -> f64 {
    let miss = |at: &State<LeverCoordinates>| (at.q.x - 1.0).hypot(0.5 * at.v.x);
    let miss = Miss { mechanism: Lever::declared(), end: 5.0 * TAU, steps, miss };
    with_type(method, miss).expect("a type").expect("a regular motion")
}

/// The exponent between runs of `steps` and of half as many more steps.
fn order(miss: impl Fn(u32) -> f64, steps: u32) -> f64 {
    (miss(steps) / miss(3 * steps / 2)).ln() / 1.5_f64.ln()
}

/// The numbers of steps, on the lever and on the swing, leave errors small enough for the leading
/// term, and large enough not to be rounding. On the swing the errors of the scheme of order 8
/// fall with the tenth power and faster until they are rounding.
#[test]
fn every_scheme_has_its_order_with_feedback_and_with_projection() {
    let steps = [
        ("heun", 1600, 3200),
        ("bs3", 1600, 800),
        ("ssp3", 1600, 800),
        ("rk4", 1600, 3200),
        ("dopri5", 800, 200),
    ];
    for (word, on_lever, on_swing) in steps {
        let scheme = Tableau::find(word).expect("a scheme");
        for method in [Explicit::held(scheme), Explicit::projected(scheme)] {
            let found = [order(|n| lever(method, n), on_lever), order(|n| swing(method, n), on_swing)];
            let is_its_own = found.iter().all(|order| (order - f64::from(scheme.order)).abs() < 0.1);
            assert!(is_its_own, "{method:?}: {found:?}");
        }
    }
    for method in [Explicit::held(&DOP853), Explicit::projected(&DOP853)] {
        let found = order(|n| lever(method, n), 200);
        assert!((found - 8.0).abs() < 0.1, "{method:?}: {found}");
        assert!(swing(method, 80) < 1e-11, "{method:?}");
    }
    assert_eq!(steps.len() + 1, SCHEMES.len());
}

/// A correction δ of the positions leaves |δ|² of x² + y² − l². With steps of 20 ms, in which the
/// bob turns by up to 5°, the local error of schemes of fourth order and higher is below 10⁻⁸ m:
/// what is left is rounding.
#[test]
fn projection_leaves_the_square_of_the_local_error() {
    for scheme in SCHEMES.into_iter().filter(|scheme| scheme.order > 3) {
        let visitor = Violation { steps: 100 };
        let largest = with_type(Explicit::projected(scheme), visitor).expect("a type").expect("a motion");
        assert!(largest < 1e-14, "{}: {largest:e}", scheme.word);
    }
}

struct Violation {
    steps: u32,
}

impl MethodVisitor for Violation {
    type Result = Result<f64, Error>;

    fn visit<X: Method>(self) -> Self::Result {
        let mut run = Simulation::builder(Swing::declared(), 0.02).method::<X>().build()?;
        let mut largest = 0.0_f64;
        for _ in 0..self.steps {
            run.step()?;
            largest = largest.max(run.violation()).max(run.velocity_violation());
        }
        Ok(largest)
    }
}

/// With feedback in every stage, whose deadbeat gains grow with 1/h, positions of a loop are of second order
/// at most and velocities of first; with schemes of third order both are of first order.
#[test]
fn feedback_in_every_stage_costs_order() {
    type Of = fn(&State<SliderCrankFreeCoordinates>) -> f64;
    let crank = |method: Explicit, steps: u32, miss: Of| {
        let miss = Miss { mechanism: SliderCrankFree::declared(), end: 0.3, steps, miss };
        with_type(method, miss).expect("a type").expect("a regular motion")
    };
    let [angle, rate]: [Of; 2] = [|at| at.q.theta1, |at| at.v.theta1];
    let exact = |of: Of| crank(Explicit::projected(&DOP853), 3000, of);
    let [exact_angle, exact_rate] = [exact(angle), exact(rate)];
    // hundreds of thousands of steps each
    for scheme in SCHEMES.into_iter().step_by(if EXHAUSTIVE { 1 } else { 3 }) {
        let order_of = |of: Of, exact: f64, steps: u32| {
            let [coarse, fine] =
                [steps, 2 * steps].map(|n| crank(Explicit::per_stage(scheme), n, of) - exact);
            (coarse / fine).log2()
        };
        let position = order_of(angle, exact_angle, 9600);
        let expected = if scheme.order == 3 { 1.0 } else { 2.0 };
        assert!((position - expected).abs() < 0.1, "{}: {position}", scheme.word);
        // what is of second order is still as large there with fourth order and fifth; of eighth, all is rounding
        if !scheme.is(&DOP853) {
            let velocity = order_of(rate, exact_rate, 76_800);
            assert!(velocity > 0.95 && velocity < 1.35, "{}: {velocity}", scheme.word);
        }
    }
}
