//! Friction by bristles, the law called LuGre: steady sliding, rests that do not creep, and stick–slip on a belt against
//! a reference.

use mbs_runtime::implicit::Esdirk4;
use mbs_runtime::{Adaptive, AdaptiveScheme, Dop853, Error, Tolerances, mechanism};

use super::TIGHT;

// Canudas de Wit, Olsson, Åström and Lischinsky (1995), table I: σ₀ = 10⁵ N/m, σ₁ = √10⁵ N·s/m, σ₂ = 0.4 N·s/m,
// F_C = 1 N, F_S = 1.5 N, v_s = 1 mm/s; with a spring of 2 N/m on a belt of 0.1 m/s
mechanism! {
    Belt {
        dof = 1;
        param belt = 0.1 [m/s];
        body block (x) { mass = 1 [kg]; }
        coordinate way [m];
        drive run: way = belt*t;
        point top on ground = (way, 0);
        force spring on x = -2 [N/m]*x;
        friction grip (block, ground.top) along (1, 0) {
            coefficient = 0.1; static = 0.15; normal = 10 [N]; viscous = 0.4 [N*s/m];
            law = lugre; presliding = 10 [um]; relaxation = 1e-5 [m/N]*sqrt(1e5 [N^2*s^2/m^2]); stribeck = 1 [mm/s];
        }
        output force [N] = force(grip);
    }
}

/// Position, speed and bend of the bristles at 2, 4, …, 20 s. The three equations were integrated by DOP853 and by Radau IIA
/// of SciPy 1.17 with tolerances of 1e-13 and 1e-12, whose steps end where the speed of sliding changes its sign; both agree
/// to 1e-13 m, 5e-13 m/s and 1e-16 m.
const REFERENCE: [[f64; 3]; 10] = [
    [0.195_414_154_387_2, 0.099_997_296_899_8, -3.901_943_031_547e-6],
    [0.395_407_450_443_5, 0.099_995_773_753_5, -7.901_795_944_821e-6],
    [0.595_395_016_203_2, 0.099_990_318_254_6, -1.190_147_549_252e-5],
    [0.732_908_507_654_3, -0.131_663_560_792_0, -1.000_000_000_003e-5],
    [0.371_240_956_729_0, 0.019_083_236_089_9, -9.999_999_999_999e-6],
    [0.559_126_189_434_3, 0.099_992_154_925_9, -1.117_612_750_582e-5],
    [0.753_308_810_409_4, 0.025_487_309_029_8, -9.999_999_999_999e-6],
    [0.384_216_524_616_4, -0.091_757_027_480_7, -1.000_000_000_000e-5],
    [0.522_856_812_904_4, 0.099_993_405_832_9, -1.045_075_687_170e-5],
    [0.722_825_047_650_1, 0.099_944_670_412_4, -1.444_791_092_209e-5],
];

/// The largest differences from the reference in position, speed and bend.
fn from_reference<S: AdaptiveScheme>(tolerance: f64) -> Result<([f64; 3], u64), Error> {
    let tolerances = Tolerances { rtol: tolerance, atol: tolerance, ..TIGHT };
    let mut run = Adaptive::builder(Belt::declared()).scheme::<S>().tolerances(tolerances).build()?;
    let mut worst = [0.0_f64; 3];
    for (at, expected) in REFERENCE.iter().enumerate() {
        run.advance_to(2.0 * (at + 1) as f64)?;
        let state = run.state();
        let found = [state.q.x, state.v.x, state.v.grip_bristle];
        for ((worst, found), expected) in worst.iter_mut().zip(found).zip(expected) {
            *worst = worst.max((found - expected).abs());
        }
    }
    Ok((worst, run.effort().steps))
}

/// While it sticks the bristles follow at a rate of 1e5/s, which an implicit scheme need not resolve. Every slip magnifies
/// what is left of the errors before, which makes them some thousand times
/// the tolerance of a step.
#[test]
fn a_block_on_a_belt_sticks_and_slips() -> Result<(), Error> {
    let (explicit, count) = from_reference::<Dop853>(1e-13)?;
    for (error, allowed) in explicit.into_iter().zip([1e-10, 1e-10, 1e-14]) {
        assert!(error < allowed, "{explicit:?}");
    }
    for tolerance in [1e-6, 1e-8, 1e-10] {
        let (implicit, fewer) = from_reference::<Esdirk4>(tolerance)?;
        assert!(implicit.into_iter().all(|error| error < 1e4 * tolerance), "{tolerance} {implicit:?}");
        assert!(20 * fewer < count, "{tolerance} {fewer} {count}");
    }
    Ok(())
}

// on slopes of tan α = 0.29 and 0.31, and a pin
mechanism! {
    Slopes {
        dof = 3;
        gravity = (0, -9.81) [m/s^2];
        param below = 0.29;
        param beyond = 0.31;
        body held (x1, y1, phi1) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body freed (x2, y2, phi2) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        prismatic guide (held, ground) along (1, -below) at 0;
        prismatic chute (freed, ground) along (1, -beyond) at 0;
        friction rub (held, ground) along (1, -below) {
            coefficient = 0.3; normal = reaction(guide); law = lugre; presliding = 0.1 [mm]; relaxation = 10 [ms];
        }
        friction scrape (freed, ground) along (1, -beyond) {
            coefficient = 0.3; normal = reaction(chute); law = lugre; presliding = 0.1 [mm]; relaxation = 10 [ms];
        }
        body arm (angle = theta) { inertia = 0.1 [kg*m^2]; }
        torsion_friction pin (arm, ground) {
            torque = 2 [N*m]; breakaway = 3 [N*m]; law = lugre; presliding = 0.1 [deg]; relaxation = 10 [ms];
            stribeck = 0.1 [rad/s];
        }
        torque load on arm = 2.5 [N*m]*min(t/1 [s], 1);
    }
}

/// Below atan μ bristles bend by z = z_c tan α/μ, and the block rests; beyond it slides with g (sin α − μ cos α). A pin rests
/// under a load between its torque and its breakaway torque that grows slowly.
#[test]
fn bristles_hold_without_creeping() -> Result<(), Error> {
    let tolerances = Tolerances { rtol: 1e-8, atol: 1e-10, ..TIGHT };
    let mut run = Adaptive::builder(Slopes::declared()).scheme::<Esdirk4>().tolerances(tolerances).build()?;
    run.advance_to(10.0)?;
    let before = run.state();
    run.advance_to(100.0)?;
    let (state, steps) = (run.state(), run.effort().steps);
    // every step may leave its tolerance
    let creep = state.q.x1 - before.q.x1;
    assert!(creep.abs() < 1e-10 * steps as f64 && state.v.x1.abs() < 1e-8, "{creep} {steps}");
    assert!((state.v.rub_bristle - 1e-4 * 0.29 / 0.3).abs() < 1e-10 && state.v.theta.abs() < 1e-10);
    assert!((state.v.pin_bristle - 0.1_f64.to_radians() * 2.5 / 2.0).abs() < 1e-10);
    let slope = 0.31_f64.atan();
    let expected = 9.81 * (slope.sin() - 0.3 * slope.cos()) * slope.cos();
    let found = (state.v.x2 - before.v.x2) / 90.0;
    assert!((found - expected).abs() < 1e-9, "{found} {expected}");
    Ok(())
}
