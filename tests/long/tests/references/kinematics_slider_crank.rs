//! Slider-crank kinematics, centric and offset.
//!
//! Textbook formulas; the centric one has the data of Nikravesh, Planar
//! Multibody Dynamics, Example 12.1 (0.12 and 0.26 m, 2π rad/s), the offset one
//! 0.05 and 0.2 m, slider line at y = 0.03 m, 12 rad/s and 40 rad/s². Reference:
//! closed-form derivatives.
//!
//! No integration: kinematic analysis. Limit: rounding.

use mbs_runtime::{Error, Kinematics, mechanism};
use paths::{Case, bisect};

mechanism! {
    SliderCrank {
        dof = 0;
        param r = 0.12 [m];
        param l = 0.26 [m];
        param offset = 0 [m];
        param theta0 = 0 [rad];
        param omega = 1 [rev/s];
        param alpha = 0 [rad/s^2];
        body crank (theta) { inertia = 1 [kg*m^2]; }
        body rod (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }   // (x, y) at the slider
        point tip on crank = (r, 0);
        point pin on rod = (-l, 0);
        point rail on ground = (0, offset);
        revolute pin (rod.pin, crank.tip);
        point_on_line guide (rod, ground.rail) along (1, 0);
        drive motor: crank.angle = theta0 + omega*t + alpha*t^2/2;
        start { guess theta = theta0; guess x = l + r*cos(theta0); guess y = offset; }
    }
}

/// Crank angle in degrees, then x, v, a of the slider and φ, φ̇, φ̈ of the rod.
const CENTRIC: [(f64, [f64; 6]); 5] = [
    (0.0, [0.38, 0.0, -6.923907087533458, 0.0, -2.8999316802367323, 0.0]),
    (
        65.0,
        [
            0.28687500359045,
            -0.8300833456207798,
            -0.5459717921182592,
            -0.43156838977042644,
            -1.3492783132910704,
            17.342225353290132,
        ],
    ),
    (
        90.0,
        [
            0.23065125189341593,
            -0.7539822368615504,
            2.46471332297579,
            -0.4797286376757527,
            0.0,
            20.539277691464914,
        ],
    ),
    (180.0, [0.14, 0.0, 2.5509131375123264, 0.0, 2.8999316802367323, 0.0]),
    (
        245.0,
        [
            0.18544662077268212,
            0.5365965994890901,
            3.458260261696213,
            0.43156838977042644,
            1.3492783132910704,
            -17.342225353290132,
        ],
    ),
];
const OFFSET: [(f64, [f64; 6]); 4] = [
    (
        30.0,
        [
            0.243238760420544,
            -0.2870055575452737,
            -8.633362851747018,
            0.025002604899361135,
            -2.5988884909452596,
            9.51157432841997,
        ],
    ),
    (
        120.0,
        [
            0.1745572003495572,
            -0.4996190654863789,
            1.8972136633475578,
            -0.06655547610231924,
            1.5033283663756594,
            36.10655027655117,
        ],
    ),
    (
        210.0,
        [
            0.14898757504107218,
            0.15137547479335517,
            6.250655770931694,
            0.2785897023916506,
            2.70226409466627,
            -7.625645016601162,
        ],
    ),
    (
        300.0,
        [
            0.21108310989621462,
            0.6377902935637731,
            0.42348615006905915,
            0.3752512966278522,
            -1.612182858333145,
            -37.85869184580882,
        ],
    ),
];

#[test]
fn kinematics_slider_crank() -> Result<(), Error> {
    let mut case = Case::new("kinematics_slider_crank");
    let centric = SliderCrankParameters::default();
    let offset = SliderCrankParameters { r: 0.05, l: 0.2, offset: 0.03, omega: 12.0, alpha: 40.0, ..centric };
    let centric_rows = CENTRIC.map(|row| ("centric", centric, row));
    let offset_rows = OFFSET.map(|row| ("offset", offset, row));
    for (kind, parameters, (degrees, reference)) in centric_rows.into_iter().chain(offset_rows) {
        let parameters = SliderCrankParameters { theta0: degrees.to_radians(), ..parameters };
        let motion = Kinematics::new(SliderCrank::new(parameters)?)?.at(0.0)?;
        let (q, v, a) = (motion.state.q, motion.state.v, motion.acceleration);
        case.all_near(
            ["x", "v", "a", "phi", "phi rate", "phi acceleration"],
            format_args!("{degrees} degrees, {kind}"),
            [q.x, v.x, a.x, q.phi, v.phi, a.phi],
            reference,
            [1e-12; 6],
        );
    }

    // the dead points at constant speed: the slider stands
    let steady = SliderCrank::new(SliderCrankParameters { omega: 1.0, alpha: 0.0, ..offset })?;
    let mut kinematics = Kinematics::new(steady)?;
    let outer = bisect(0.0, 1.0, |t| Ok(kinematics.at(t)?.state.v.x))?;
    let inner = bisect(2.0, 5.0, |t| Ok(kinematics.at(t)?.state.v.x))?;
    let stroke = kinematics.at(outer)?.state.q.x - kinematics.at(inner)?.state.q.x;
    let forward = inner - outer;
    let ratio = forward / (std::f64::consts::TAU - forward);
    case.near("stroke", stroke, 0.10122408835282645, 1e-12);
    case.near("time ratio", ratio.max(1.0 / ratio), 1.0529765635558512, 1e-12);
    case.finish();
    Ok(())
}
