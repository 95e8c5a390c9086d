//! Andrews' squeezer mechanism, the published problem.

use std::f64::consts::FRAC_PI_2;

use mbs_runtime::{Error, Mechanism, Simulation};
use models::{AndrewsSqueezer, AndrewsSqueezerInputs};
use paths::through_fused_path;

/// Heun's error in the angles is 4e-7 rad at 1e-6 s, and with reduced states 3.3e-6 (both fall with h²); the
/// printed reference is good to 1e-9. Roundings in 3e4 steps, ε/2 of 16 rad each, add up at random to √3e4
/// times that, 3e-13.
#[test]
fn squeezer_is_where_it_ought_to_be() -> Result<(), Error> {
    let of_method = if AndrewsSqueezer::<f64>::INFO.has_reduced_states() { 5e-6 } else { 1e-6 };
    let inputs = AndrewsSqueezerInputs { motor_torque: 0.033 };
    let start = |step| Simulation::builder(AndrewsSqueezer::declared(), step).inputs(inputs).build();
    through_fused_path("andrews_squeezer", 1e-6, start, |case, run| {
        let lambda = run.now()?.multipliers;
        case.near_within("λ1 at the start", lambda.e3_x, 98.56687039624109, 0.0, 1e-10);
        case.near_within("λ2 at the start", lambda.e3_y, -6.122688344255662, 0.0, 1e-10);

        run.advance_to(0.03)?;
        let q = run.now()?.q;
        for (what, ours, reference) in [
            ("β", q.angle1, 15.81077119629904),
            ("Θ", q.angle2 - q.angle1, -15.75637105984298),
            ("γ", q.angle3 + FRAC_PI_2, 0.04082224013073101),
            ("Φ", q.angle4 + FRAC_PI_2 - q.angle5, -0.5347301163226948),
            ("δ", q.angle5, 0.5244099658805303),
            ("Ω", q.angle6 - q.angle7 - FRAC_PI_2, 0.5347301163226948),
            ("ε", q.angle7 + FRAC_PI_2, 1.048080741042263),
        ] {
            case.near_within(what, ours, reference, of_method, 3e-13);
        }
        Ok(())
    })
}
