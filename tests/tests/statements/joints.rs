//! Joints, points and springs: the same motion as the equations that they stand
//! for, and the answers that are known in closed form.

use mbs_runtime::{Components, Error, Mechanism, Simulation, State, mechanism};
use models::SliderCrank;

mechanism! {
    /// The slider-crank of the paper from parts.
    JointedSliderCrank {
        dof = 0;
        param l1 = 60 [mm];
        param l2 = 180 [mm];
        param omega = 200 [rpm];
        gravity = (0, -9.81) [m/s^2];
        body crank  (x1, y1, theta1) { mass = 0.5 [kg]; inertia = 0.5 [kg]*l1^2/12; }
        body rod    (x2, y2, theta2) { mass = 1.2 [kg]; inertia = 1.2 [kg]*l2^2/12; }
        body slider (x3, y3, theta3) { mass = 2.0 [kg]; inertia = 1e-3 [kg*m^2]; }
        point base on crank = (-l1/2, 0);
        point tip on crank = (l1/2, 0);
        point base on rod = (-l2/2, 0);
        point end on rod = (l2/2, 0);
        revolute bearing (ground, crank.base);
        revolute pin (crank.tip, rod.base);
        revolute wrist (rod.end, slider);
        prismatic guide (slider, ground) along (1, 0);
        drive crank_speed: crank.angle = omega*t;
        start { der(theta1) = omega; }
        output drive_torque [N*m] = effort(crank_speed);
    }
}

/// Both forms describe the same motion; they differ in the order of their
/// operations only, so in rounding times the number of steps.
#[test]
fn slider_crank_from_joints_moves_like_its_equations() -> Result<(), Error> {
    let mut equations = Simulation::new(SliderCrank::declared(), 0.5e-3)?;
    let mut joints = Simulation::new(JointedSliderCrank::declared(), 0.5e-3)?;
    for _ in 0..600 {
        equations.step()?;
        joints.step()?;
        let (e, j) = (equations.state(), joints.state());
        let near =
            |a: f64, b: f64, scale: f64| assert!((a - b).abs() <= 1e-12 * scale, "{a} {b} at t = {}", e.t);
        near(e.q.theta2, j.q.theta2, 1.0);
        near(e.q.x3, j.q.x3, 1.0);
        near(e.v.x3, j.v.x3, 10.0);
        near(equations.outputs()?.drive_torque, joints.outputs()?.drive_torque, 3.4);
    }
    Ok(())
}

/// Newton's laws for every body: mass times acceleration is the sum of gravity
/// and the joint forces with the signs that the documentation gives them.
#[test]
fn multipliers_are_forces_on_the_second_body() -> Result<(), Error> {
    let mut run = Simulation::new(JointedSliderCrank::declared(), 0.5e-3)?;
    run.advance_to(0.1)?;
    let (a, f) = (run.reactions()?.acceleration, run.reactions()?.multipliers);
    // Forces reach 200 N; twenty operations of relative rounding 1e-16 each.
    let balances = |sum: f64, inertia: f64| assert!((sum - inertia).abs() < 1e-11, "{sum} {inertia}");
    balances(f.bearing_x - f.pin_x, 0.5 * a.x1);
    balances(f.bearing_y - f.pin_y - 0.5 * 9.81, 0.5 * a.y1);
    balances(f.pin_x - f.wrist_x, 1.2 * a.x2);
    balances(f.pin_y - f.wrist_y - 1.2 * 9.81, 1.2 * a.y2);
    balances(f.wrist_x, 2.0 * a.x3);
    balances(f.wrist_y - f.guide_normal - 2.0 * 9.81, 2.0 * a.y3);
    // Moments about the crank's centre: the drive exerts its effort.
    let (s, c) = run.state().q.theta1.sin_cos();
    let (rx, ry) = (0.03 * c, 0.03 * s);
    let moment = |x: f64, y: f64, fx: f64, fy: f64| x * fy - y * fx;
    let torque = run.outputs()?.drive_torque;
    let bearing = moment(-rx, -ry, f.bearing_x, f.bearing_y);
    let pin = moment(rx, ry, -f.pin_x, -f.pin_y);
    balances(torque + bearing + pin, 0.5 * 0.06 * 0.06 / 12.0 * a.theta1);
    Ok(())
}

mechanism! {
    /// A rod, and the same rod as two halves welded together.
    WeldedRods {
        dof = 2;
        const l = 0.8 [m];
        const m = 3 [kg];
        gravity = (0, -9.81) [m/s^2];
        body whole (x, y, phi) { mass = m; inertia = m*l^2/12; }
        body upper (x1, y1, phi1) { mass = m/2; inertia = m*l^2/96; }
        body lower (x2, y2, phi2) { mass = m/2; inertia = m*l^2/96; }
        point top on whole = (-l/2, 0);
        point top on upper = (-l/4, 0);
        point bottom on upper = (l/4, 0);
        point end on lower = (0, l/4);
        revolute a (ground, whole.top);
        revolute b (ground, upper.top);
        fixed weld (lower.end, upper.bottom) at 90 [deg];
        start { phi = 0; phi1 = 0; }
        output tip_whole [m] = whole.y;
        output middle [m] = upper.y + lower.y;
    }
}

#[test]
fn two_welded_halves_swing_like_the_whole() -> Result<(), Error> {
    let mut run = Simulation::new(WeldedRods::declared(), 0.5e-3)?;
    run.advance_to(1.0)?;
    let state = run.state();
    // Same equation of motion, but the feedback acts on other constraints: both
    // are off by Heun's truncation, h² |d³φ/dt³| t/6 = 2.5e-7 · 200 / 6 = 8e-6.
    let near = |a: f64, b: f64| assert!((a - b).abs() < 8e-6, "{a} {b}");
    near(state.q.phi, state.q.phi1);
    near(state.q.phi2, state.q.phi1 + core::f64::consts::FRAC_PI_2);
    let outputs = run.outputs()?;
    near(outputs.middle / 2.0, outputs.tip_whole);
    Ok(())
}

mechanism! {
    /// A bob on a link, and a block that slides down a slope of 3:4.
    LinkAndSlope {
        dof = 2;
        gravity = (0, -10) [m/s^2];
        body bob (x, y) { mass = 2 [kg]; }
        point hook on ground = (0, 0.2 [m]);
        distance link (bob, ground.hook) = 0.7 [m];
        body block (xb, yb, phib) { mass = 3 [kg]; inertia = 0.1 [kg*m^2]; }
        prismatic slope (block, ground) along (4, -3);
        start { x = 0; y = -0.5 [m]; der(x) = 1.4 [m/s]; xb = 0; }
    }
}

/// Tension in the lowest position m (g + v²/l); a block on a slope of angle a
/// accelerates by g sin a and presses with m g cos a.
#[test]
fn tension_and_normal_force() -> Result<(), Error> {
    let run = Simulation::new(LinkAndSlope::declared(), 1e-3)?;
    let solved = run.reactions()?;
    assert!((solved.multipliers.link - 2.0 * (10.0 + 1.4 * 1.4 / 0.7)).abs() < 1e-12);
    assert!((solved.acceleration.xb - 10.0 * 0.6 * 0.8).abs() < 1e-13);
    assert!((solved.acceleration.yb + 10.0 * 0.6 * 0.6).abs() < 1e-13);
    // The block is the first body: it feels −λ n, with n = (3, 4)/5.
    assert!((solved.multipliers.slope_normal + 3.0 * 10.0 * 0.8).abs() < 1e-12);
    Ok(())
}

mechanism! {
    /// A ladder between wall and floor.
    Ladder {
        dof = 1;
        param l = 2 [m];
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, phi) { mass = 5 [kg]; inertia = 5 [kg]*l^2/12; }
        point foot on rod = (l/2, 0);
        point head on rod = (-l/2, 0);
        point_on_line floor (rod.foot, ground) along (1, 0);
        pin_slot wall (rod.head, ground) along (0, 1);
        start { phi = -60 [deg]; guess x = 0.5 [m]; guess y = 0.8 [m]; }
    }
}

/// The centre of a sliding ladder moves on a circle of half its length; with the
/// angle a to the floor ä = −(3g/2l) cos a, from Lagrange's equation.
#[test]
fn ladder_slides_down() -> Result<(), Error> {
    let mut run = Simulation::new(Ladder::declared(), 1e-3)?;
    let slope = 60.0_f64.to_radians();
    let fall = run.reactions()?.acceleration.phi;
    assert!((fall - 1.5 * 9.81 / 2.0 * slope.cos()).abs() < 1e-12, "{fall}");
    run.advance_to(0.3)?;
    let q = run.state().q;
    // ‖Φ‖ with held deadbeat feedback at h = 1 ms is of order h³ times the third derivative.
    assert!((q.x * q.x + q.y * q.y - 1.0).abs() < 1e-7);
    Ok(())
}

mechanism! {
    /// Springs between points and between angles, and a force at a point.
    Springs {
        dof = 4;
        param push = 3 [N];
        body block (x) { mass = 2 [kg]; }
        spring linear (block, ground) { stiffness = 8 [N/m]; length = 0.5 [m]; }
        body wheel (phi) { inertia = 2 [kg*m^2]; }
        torsion_spring torsional (wheel, ground) { stiffness = 8 [N*m]; angle = 0; damping = 0.8 [N*m*s]; }
        body plate (xp, yp, phip) { mass = 1 [kg]; inertia = 0.5 [kg*m^2]; }
        constraint straight: xp = 0;
        point corner on plate = (0.3, 0.4) [m];
        force pull on plate.corner = (0, push);
        start { x = 0.7 [m]; phi = 1; phip = 30 [deg]; }
    }
}

/// Free and damped oscillations in closed form; the error of Heun's method at
/// h = 1 ms is below h² ω³ t/6 relative, here 1.4e-6.
#[test]
fn springs_oscillate_as_they_should() -> Result<(), Error> {
    let mut run = Simulation::new(Springs::declared(), 1e-3)?;
    let energy = run.mechanism().potential_energy(&run.state());
    assert!((energy - (0.5 * 8.0 * 0.04 + 0.5 * 8.0)).abs() < 1e-14);
    run.advance_to(1.0)?;
    let free = 0.5 + 0.2 * 2.0_f64.cos();
    assert!((run.state().q.x - free).abs() < 1.4e-6 * 0.2);
    let (decay, rate) = (0.2_f64, (4.0_f64 - 0.04).sqrt());
    let damped = (-decay).exp() * (rate.cos() + decay / rate * rate.sin());
    assert!((run.state().q.phi - damped).abs() < 1.4e-6);
    Ok(())
}

/// A force at a point does the work of the point: F along the body and its
/// moment about the centre.
#[test]
fn force_at_a_point_has_its_moment() -> Result<(), Error> {
    let springs = Springs::declared();
    let start: State<_> = springs.declared_start();
    let forces = springs.forces(&start, &Default::default());
    let (s, c) = 30.0_f64.to_radians().sin_cos();
    let arm = 0.3 * c - 0.4 * s;
    assert!((forces.yp - 3.0).abs() < 1e-15 && (forces.phip - 3.0 * arm).abs() < 1e-14);
    assert_eq!(forces.xp, 0.0);
    assert!(forces.into_array().iter().all(|force| force.is_finite()));
    Ok(())
}

mechanism! {
    /// Every size of a joint that has to be positive.
    Sizes {
        dof = 1;
        param length = 1 [m];
        param radius = 1 [m];
        param teeth = 20;
        body bob (x, y) { mass = 1 [kg]; }
        distance link (bob, ground) = length - 0.5 [m];
        body wheel (xw, yw, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        rolling contact (wheel, ground) along (1, 0) radius radius;
        body fan (angle = turn) { inertia = 1 [kg*m^2]; }
        body drum (angle = psi) { inertia = 1 [kg*m^2]; }
        belt strap (wheel, fan) radii (radius, 2*radius);
        gear mesh (fan, drum) teeth (20, teeth);
        constraint together: psi = x/(1 [m]);
        start { x = 0; guess y = -0.5 [m]; guess yw = 1 [m]; }
    }
}

/// A negative length would turn the meaning of the tension round.
#[test]
fn sizes_of_joints_that_are_not_positive_are_refused_at_run_time() {
    let declared = SizesParameters::default();
    let refused = |parameters| Sizes::new(parameters).unwrap_err().to_string();
    let length = |length| refused(SizesParameters { length, ..declared });
    assert_eq!(length(0.4), "`distance of link` is -0.09999999999999998, but it has to be positive");
    assert_eq!(length(0.5), "`distance of link` is 0, but it has to be positive");
    let radius = refused(SizesParameters { radius: -1.0, ..declared });
    assert_eq!(radius, "`radius of contact` is -1, but it has to be positive");
    let teeth = refused(SizesParameters { teeth: 0.0, ..declared });
    assert_eq!(teeth, "`second number of teeth of mesh` is 0, but it has to be positive");
    assert!(Sizes::new(declared).is_ok());
}
