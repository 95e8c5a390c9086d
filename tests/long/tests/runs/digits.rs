//! The digits that a pass close to a singular position leaves of a motion.

use mbs_runtime::{Error, Simulation};
use models::NFourBar40;

/// How far the last upright may be from parallel to the first: they are parallel in truth,
/// and a start may be as far off.
const ALLOWED: f64 = 1e-2;

/// The angle between the uprights of a row of forty windows, which rounding leaves at 1e-13
/// in regular positions.
fn skew(run: &Simulation<NFourBar40>) -> f64 {
    (run.state().q.phi_40 - run.state().q.phi_0).abs()
}

/// The time at which the row lies flat for the fifth time by steps of `step`, and how many
/// steps that are; by its last state, so that it is the better the closer that is.
fn flat(step: f64) -> Result<(f64, f64), Error> {
    let flat = -5.0 * std::f64::consts::PI;
    let mut run = Simulation::new(NFourBar40::declared(), step)?;
    while run.state().q.phi_0 - flat > 0.0 {
        run.step()?;
    }
    let state = run.state();
    let late = (state.q.phi_0 - flat) / state.v.phi_0;
    Ok((run.time() - late, (run.steps() as f64 - late / step).round()))
}

/// Regression: with a step that ends at rounding of the flat position, the forty loops left
/// every scale within four steps, each of them `Ok`, and ended as not finite.
#[test]
fn a_step_that_ends_beside_a_singular_position_keeps_the_scale_or_is_refused() -> Result<(), Error> {
    let (time, steps) = flat(0.9501e-3)?;
    let (time, steps) = flat(time / steps + 1e-9)?;
    let mut refused = 0;
    for beside in [0.0, 1e-10, 3e-10, 1e-9, 3e-9, 1e-8, 1e-6] {
        let mut run = Simulation::new(NFourBar40::declared(), (time + beside) / steps)?;
        while run.time() < time + 0.02 {
            match run.step() {
                Ok(()) => {}
                Err(error @ Error::Singular { t, .. }) => {
                    println!("{error}");
                    assert!((t - time).abs() < 2.0 * run.step_size(), "{t} s beside {time} s");
                    refused += 1;
                    break;
                }
                Err(other) => panic!("{other}"),
            }
        }
        let skew = skew(&run);
        println!("{beside:e} s beside: {skew:.1e} rad, {:.1} digits", run.digits_left());
        assert!(skew < ALLOWED, "{skew} rad with {beside} s beside");
        // who is off by more than a part in 10⁵ is told
        assert!(skew < 1e-4 || run.digits_left() < 8.0, "{skew} rad, {} digits", run.digits_left());
    }
    assert!(refused > 0);
    Ok(())
}
