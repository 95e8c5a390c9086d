//! Four-bar kinematics with published angles.
//!
//! (1) R. L. Norton, Design of Machinery, Table P4-1 row a: links 6, 2, 7, 9,
//! crank at 30° with 10 rad/s; the manual prints 88.8°/117.3° open and
//! −115.2°/−143.6° crossed. (2) A Purdue homework: 16 at 15°, 8 at 30°, 14, 12;
//! measured from a drawing 60°/97° open, −57°/−95° crossed. (3) Crank-rocker
//! 0.1, 0.03, 0.08, 0.07: swing, time ratio, transmission angles. Reference:
//! intersection of circles with exact derivatives. Norton's vector loop as raw
//! constraints.
//!
//! No integration: kinematic analysis. Limit: rounding; the branch is the
//! guess's.

use mbs_runtime::{Error, Kinematics, mechanism};
use paths::{Case, bisect};

mechanism! {
    FourBar {
        dof = 0;
        param ground = 6 [m];
        param ground_angle = 0 [rad];
        param crank = 2 [m];
        param coupler = 7 [m];
        param rocker = 9 [m];
        param theta2 = 30 [deg];
        param omega2 = 10 [rad/s];
        param guess3 = 90 [deg];
        param guess4 = 120 [deg];
        body link2 (angle2) { inertia = 1 [kg*m^2]; }
        body link3 (angle3) { inertia = 1 [kg*m^2]; }
        body link4 (angle4) { inertia = 1 [kg*m^2]; }
        constraint loop_x:
            crank*cos(angle2) + coupler*cos(angle3) = ground*cos(ground_angle) + rocker*cos(angle4);
        constraint loop_y:
            crank*sin(angle2) + coupler*sin(angle3) = ground*sin(ground_angle) + rocker*sin(angle4);
        drive motor: angle2 = theta2 + omega2*t;
        start { guess angle2 = theta2; guess angle3 = guess3; guess angle4 = guess4; }
    }
}

#[test]
fn kinematics_fourbar() -> Result<(), Error> {
    let mut case = Case::new("kinematics_fourbar");
    let row_a = FourBarParameters::default();
    let radians = |open: [f64; 2]| open.map(f64::to_radians);

    for (branch, [guess3, guess4], reference) in [
        (
            "open",
            radians([90.0, 120.0]),
            [
                88.83724130026172,
                -5.990965718586148,
                26.080016638304492,
                117.28606786035023,
                -3.9917347902138935,
                53.330588286423016,
            ],
        ),
        (
            "crossed",
            radians([-115.0, -144.0]),
            [
                -115.21081216428877,
                -0.6623520049279695,
                77.91985506181153,
                -143.65963872437726,
                -2.6615829333002234,
                50.669283413693016,
            ],
        ),
    ] {
        let parameters = FourBarParameters { guess3, guess4, ..row_a };
        let motion = Kinematics::new(FourBar::new(parameters)?)?.at(0.0)?;
        let (q, v, a) = (motion.state.q, motion.state.v, motion.acceleration);
        case.all_near(
            ["theta3", "omega3", "alpha3", "theta4", "omega4", "alpha4"],
            format_args!("row a, {branch}"),
            [q.angle3.to_degrees(), v.angle3, a.angle3, q.angle4.to_degrees(), v.angle4, a.angle4],
            reference,
            [1e-11; 6],
        );
    }

    let homework = FourBarParameters {
        ground: 16.0,
        ground_angle: 15_f64.to_radians(),
        crank: 8.0,
        coupler: 14.0,
        rocker: 12.0,
        ..row_a
    };
    for (branch, [guess3, guess4], reference) in [
        ("open", radians([60.0, 97.0]), [59.45879537592503, 96.75938012489001]),
        ("closed", radians([-57.0, -95.0]), [-57.56262160437719, -94.86320635334218]),
    ] {
        let parameters = FourBarParameters { guess3, guess4, ..homework };
        let q = Kinematics::new(FourBar::new(parameters)?)?.at(0.0)?.state.q;
        let ours = [q.angle3.to_degrees(), q.angle4.to_degrees()];
        case.all_near(["theta3", "theta4"], format_args!("homework, {branch}"), ours, reference, [1e-11; 2]);
    }

    // one radian a second, so that time is the crank angle
    let crank_rocker = FourBarParameters {
        ground: 0.1,
        crank: 0.03,
        coupler: 0.08,
        rocker: 0.07,
        theta2: 0.0,
        omega2: 1.0,
        guess3: 60_f64.to_radians(),
        guess4: 115_f64.to_radians(),
        ..row_a
    };
    let mut kinematics = Kinematics::new(FourBar::new(crank_rocker)?)?;
    let mut transmission = |t: f64| {
        Ok::<_, Error>({
            let q = kinematics.at(t)?.state.q;
            (q.angle4 - q.angle3).to_degrees()
        })
    };
    case.near("smallest transmission angle", transmission(0.0)?, 55.15009542095351, 1e-11);
    case.near("largest transmission angle", transmission(std::f64::consts::PI)?, 120.0, 1e-11);

    let mut kinematics = Kinematics::new(FourBar::new(crank_rocker)?)?;
    let first = bisect(0.0, 2.0, |t| Ok(kinematics.at(t)?.state.v.angle4))?;
    let angle_first = kinematics.at(first)?.state.q.angle4;
    let second = bisect(3.0, 5.0, |t| Ok(kinematics.at(t)?.state.v.angle4))?;
    let angle_second = kinematics.at(second)?.state.q.angle4;
    let ratio = (second - first) / (std::f64::consts::TAU - (second - first));
    case.near("swing", (angle_first - angle_second).abs().to_degrees(), 50.80259106788365, 1e-11);
    case.near("time ratio", ratio.max(1.0 / ratio), 1.0220533142807584, 1e-12);
    case.finish();
    Ok(())
}
