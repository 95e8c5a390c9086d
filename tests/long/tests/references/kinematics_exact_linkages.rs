//! Linkages with exact motion laws.
//!
//! Classical kinematics: Scotch yoke, crank and slotted lever (Whitworth's quick
//! return), Peaucellier–Lipkin (1864), Scott Russell, Archimedes' trammel,
//! pantograph. References in closed form.
//!
//! No integration: kinematic analysis. Limit: rounding.

use mbs_runtime::{Error, Kinematics, Mechanism, mechanism};
use paths::{Case, bisect};

mechanism! {
    ScotchYoke {
        dof = 0;
        const r = 0.04 [m];
        body crank (theta) { inertia = 1 [kg*m^2]; }
        body yoke (x) { mass = 1 [kg]; }
        point pin on crank = (r, 0);
        pin_slot slot (crank.pin, yoke) along (0, 1);
        drive motor: crank.angle = 15 [rad/s]*t;
    }
}

mechanism! {
    SlottedLever {
        dof = 0;
        const r = 0.05 [m];
        const d = 0.12 [m];
        body crank (theta) { inertia = 1 [kg*m^2]; }
        body lever (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point pin on crank = (r, 0);
        point pivot on ground = (0, -d);
        revolute pivot (lever, ground.pivot);
        pin_slot slot (crank.pin, lever) along (1, 0);
        drive motor: crank.angle = 4 [rad/s]*t;
        start { guess phi = 67 [deg]; guess y = -d; }
    }
}

mechanism! {
    Peaucellier {
        dof = 0;
        const long = 0.3 [m];
        const side = 0.15 [m];
        const r = 0.1 [m];
        body crank (xd, yd, theta) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }     // at the near corner
        body a (xa, ya) { mass = 1 [kg]; }
        body b (xb, yb) { mass = 1 [kg]; }
        body p (xp, yp) { mass = 1 [kg]; }                                      // the far corner
        point hub on crank = (-r, 0);
        point hub on ground = (r, 0);
        revolute bearing (crank.hub, ground.hub);
        distance long_a (a, ground) = long;
        distance long_b (b, ground) = long;
        distance near_a (a, crank) = side;
        distance near_b (b, crank) = side;
        distance far_a (p, a) = side;
        distance far_b (p, b) = side;
        drive motor: crank.angle = 1 [deg/s]*t;
        start {
            guess xd = 2*r; guess xp = 0.34 [m];
            guess xa = 0.27 [m]; guess ya = 0.13 [m]; guess xb = 0.27 [m]; guess yb = -0.13 [m];
        }
    }
}

mechanism! {
    ScottRussell {
        dof = 0;
        const a = 0.1 [m];
        body crank (theta) { inertia = 1 [kg*m^2]; }
        body rod (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }           // at the free end
        point tip on crank = (a, 0);
        point middle on rod = (-a, 0);
        point slider on rod = (-2*a, 0);
        revolute pin (rod.middle, crank.tip);
        point_on_line guide (rod.slider, ground) along (1, 0);
        drive motor: crank.angle = 37 [deg] + 1 [deg/s]*t;
        start { guess theta = 37 [deg]; guess phi = 143 [deg]; guess y = 0.12 [m]; }
    }
}

mechanism! {
    Trammel {
        dof = 0;
        const p = 0.15 [m];
        const q = 0.4 [m];
        body rod (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }           // at the tracing point
        point end_x on rod = (p, 0);
        point end_y on rod = (-q, 0);
        point_on_line rail_x (rod.end_x, ground) along (1, 0);
        point_on_line rail_y (rod.end_y, ground) along (0, 1);
        drive motor: rod.angle = -1 [deg/s]*t;
    }
}

mechanism! {
    Pantograph {
        dof = 0;
        const arm1 = 0.3 [m];
        const arm2 = 0.35 [m];
        const ratio = 2.5;
        const m = 1 [kg];
        const j = 1 [kg*m^2];
        body long1 (x1, y1, phi1) { mass = m; inertia = j; }    // at the elbow
        body long2 (x2, y2, phi2) { mass = m; inertia = j; }    // at the output
        body short1 (x3, y3, phi3) { mass = m; inertia = j; }   // at the tracing point, parallel to long1
        body short2 (x4, y4, phi4) { mass = m; inertia = j; }   // at its joint with long1, parallel to long2
        point pivot on long1 = (-arm1, 0);
        point joint on long1 = (arm1/ratio - arm1, 0);
        point elbow on long2 = (-arm2, 0);
        point joint on long2 = (arm2/ratio - arm2, 0);
        point end on short1 = (arm1 - arm1/ratio, 0);
        point end on short2 = (arm2/ratio, 0);
        revolute pivot (long1.pivot, ground);
        revolute elbow (long2.elbow, long1);
        revolute joint1 (short2, long1.joint);
        revolute joint2 (short1.end, long2.joint);
        revolute tracer (short2.end, short1);
        drive trace_x: short1.x = 0.21 [m] + 1 [m/s]*t;
        drive trace_y: short1.y = 0.13 [m] + 1 [m/s]*t;
        start {
            guess x1 = 0.19 [m]; guess y1 = 0.23 [m]; guess phi1 = 51 [deg];
            guess x2 = 0.5 [m]; guess y2 = 0.3 [m]; guess phi2 = 15 [deg];
            guess x3 = 0.21 [m]; guess y3 = 0.13 [m]; guess phi3 = 51 [deg];
            guess x4 = 0.08 [m]; guess y4 = 0.09 [m]; guess phi4 = 15 [deg];
        }
    }
}

/// Crank angle in degrees, then angle in degrees, rate and acceleration.
const LEVER: [(f64, [f64; 3]); 5] = [
    (0.0, [67.38013505195957, 0.591715976331361, 3.9998599488813418]),
    (60.0, [81.29609374820747, 1.1279593227905842, 0.7668453203776703]),
    (90.0, [90.0, 1.1764705882352942, 0.0]),
    (200.0, [114.5418771724172, 0.14000862793502794, -6.556498347515885]),
    (270.0, [90.0, -2.857142857142857, 0.0]),
];
/// Crank angle in degrees, then the far corner.
const PEAUCELLIER: [(f64, [f64; 2]); 4] = [
    (-50.0, [0.3375, -0.15737883462731203]),
    (0.0, [0.3375, 0.0]),
    (35.0, [0.3375, 0.10641334124665694]),
    (60.0, [0.3375, 0.1948557158514987]),
];
const TRAMMEL: [(f64, [f64; 2]); 2] =
    [(20.0, [0.37587704831436336, 0.05130302149885031]), (110.0, [-0.1368080573302675, 0.14095389311788625])];

/// Goes from 0 to `end` in small enough steps to stay on the branch.
fn walk<M: Mechanism<Real = f64>>(
    mechanism: M,
    end: f64,
) -> Result<mbs_runtime::Motion<M::Coordinates>, Error> {
    let mut kinematics = Kinematics::new(mechanism)?;
    for k in 0..20 {
        kinematics.at(end * f64::from(k) / 20.0)?;
    }
    kinematics.at(end)
}

#[test]
fn scotch_yoke() -> Result<(), Error> {
    let mut case = Case::new("kinematics_exact_linkages, Scotch yoke");
    let motion = walk(ScotchYoke::declared(), 50_f64.to_radians() / 15.0)?;
    let ours = [motion.state.q.x, motion.state.v.x, motion.acceleration.x];
    let reference = [0.025711504387461573, -0.45962666587138684, -5.785088487178854];
    case.all_near(["x", "v", "a"], 50, ours, reference, [1e-14, 1e-13, 1e-13]);
    case.finish();
    Ok(())
}

#[test]
fn slotted_lever() -> Result<(), Error> {
    let mut case = Case::new("kinematics_exact_linkages, slotted lever");
    for (degrees, reference) in LEVER {
        let motion = walk(SlottedLever::declared(), degrees.to_radians() / 4.0)?;
        let ours = [motion.state.q.phi.to_degrees(), motion.state.v.phi, motion.acceleration.phi];
        case.all_near(["angle", "omega", "alpha"], degrees, ours, reference, [1e-12; 3]);
    }
    // the lever stands where the crank is across it
    let mut kinematics = Kinematics::new(SlottedLever::declared())?;
    let mut turn = |low: f64, high: f64| {
        let at = bisect(low / 4.0, high / 4.0, |t| Ok(kinematics.at(t)?.state.v.phi))?;
        Ok::<_, Error>((4.0 * at, kinematics.at(at)?.state.q.phi))
    };
    let (first, low) = turn(-1.0, 0.0)?;
    let (second, high) = turn(3.0, 4.0)?;
    let forward = second - first;
    case.near("swing", (high - low).to_degrees(), 49.24863670432815, 1e-12);
    case.near("time ratio", forward / (std::f64::consts::TAU - forward), 1.75331737219383, 1e-12);
    case.finish();
    Ok(())
}

#[test]
fn peaucellier() -> Result<(), Error> {
    let mut case = Case::new("kinematics_exact_linkages, Peaucellier");
    for (degrees, reference) in PEAUCELLIER {
        let q = walk(Peaucellier::declared(), degrees)?.state.q;
        case.all_near(["x", "y"], degrees, [q.xp, q.yp], reference, [1e-13; 2]);
    }
    case.finish();
    Ok(())
}

#[test]
fn scott_russell() -> Result<(), Error> {
    let mut case = Case::new("kinematics_exact_linkages, Scott Russell");
    let q = walk(ScottRussell::declared(), 0.0)?.state.q;
    case.all_near(["x", "y"], 37, [q.x, q.y], [0.0, 0.12036300463040965], [1e-14; 2]);
    case.finish();
    Ok(())
}

#[test]
fn trammel() -> Result<(), Error> {
    let mut case = Case::new("kinematics_exact_linkages, trammel");
    for (degrees, reference) in TRAMMEL {
        let q = walk(Trammel::declared(), degrees)?.state.q;
        case.all_near(["x", "y"], degrees, [q.x, q.y], reference, [1e-14; 2]);
    }
    case.finish();
    Ok(())
}

#[test]
fn pantograph() -> Result<(), Error> {
    let mut case = Case::new("kinematics_exact_linkages, pantograph");
    let q = walk(Pantograph::declared(), 0.0)?.state.q;
    let ours = [q.x2, q.y2, q.x1, q.y1];
    let reference = [0.525, 0.325, 0.18684692629610988, 0.23470881136782248];
    case.all_near(["output x", "output y", "elbow x", "elbow y"], "rest", ours, reference, [1e-13; 4]);
    case.finish();
    Ok(())
}
