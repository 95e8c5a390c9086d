//! Gears, belts, racks, rolling wheels, cams and couplers: their rows and the
//! derivatives of these against the formulas by hand, and motions and forces
//! that are known in closed form.

use mbs_runtime::{Components, Error, Kinematics, Real, Simulation, mechanism};
use tests::check_against_jets;
use tests::jet::Jet;

mechanism! {
    /// Every transmission once, among bodies that are free otherwise.
    Couplings {
        dof = 9;
        const m = 1 [kg];
        const j = 1 [kg*m^2];
        param r1 = 0.3 [m];
        param r2 = 0.5 [m];
        param phase = 20 [deg];
        body a (xa, ya, phia) { mass = m; inertia = j; }
        body b (xb, yb, phib) { mass = m; inertia = j; }
        body c (xc, yc, phic) { mass = m; inertia = j; }
        body d (xd, yd, phid) { mass = m; inertia = j; }
        body e (xe, ye, phie) { mass = m; inertia = j; }
        body f (xf, yf, phif) { mass = m; inertia = j; }
        point axle on ground = (-5 [m], 0);
        point end on a = (0.2 [m], 0.1 [m]);
        point line on b = (0.1 [m], -0.2 [m]);
        point tip on f = (0.4 [m], 0);
        gear external (a, b) radii (r1, r2) carrier c at phase;
        internal_gear inner (e, f) carrier c teeth (60, 20);
        belt open (b, d) at phase radii (r1, r2) carrier a;
        crossed_belt crossed (d, e) teeth (12, 18);
        rack mesh (a.end, b.line) radius r1 along (3, 4) at r2;
        rolling contact (c, d) along (1, -1) radius r2;
        body disk (angle = psi) { inertia = j; }
        constraint shaft: disk.angle = 0.3*a.angle;
        point centre on disk = (-5 [m], 0);
        cam lift (disk.centre, f.tip) = r1*(15 + cos(2*angle)) + 0.2*r2*sin(angle);
        coupler screw: e.x = 0.1 [m]*d.angle;
        start { guess xf = 1 [m]; guess yf = 1 [m]; guess xc = 1 [m]; guess yb = 0.5 [m]; }
    }
}

/// The rows of [`Couplings`] as the literature writes them.
fn couplings_by_hand(_: Jet, q: [Jet; 19]) -> [Jet; 10] {
    let n = Jet::from_f64;
    let (r1, r2, phase) = (n(0.3), n(0.5), n(20.0_f64.to_radians()));
    let body = |at: usize| ([q[3 * at], q[3 * at + 1]], q[3 * at + 2]);
    let [a, b, c, d, e, f] = [0, 1, 2, 3, 4, 5].map(body);
    let psi = q[18];
    let point = |([x, y], phi): ([Jet; 2], Jet), px: f64, py: f64| {
        let (s, co) = phi.sin_cos();
        [x + co * n(px) - s * n(py), y + s * n(px) + co * n(py)]
    };
    let along = |phi: Jet, u: [f64; 2], from: [Jet; 2], to: [Jet; 2]| {
        let (s, co) = phi.sin_cos();
        let (ux, uy) = (co * n(u[0]) - s * n(u[1]), s * n(u[0]) + co * n(u[1]));
        ux * (to[0] - from[0]) + uy * (to[1] - from[1])
    };
    let (end, line, tip, centre) =
        (point(a, 0.2, 0.1), point(b, 0.1, -0.2), point(f, 0.4, 0.0), point(([n(0.0); 2], psi), -5.0, 0.0));
    let half = 0.5_f64.sqrt();
    let (dx, dy) = (tip[0] - centre[0], tip[1] - centre[1]);
    let polar = dy.atan2(dx) - psi;
    let profile = r1 * (n(15.0) + (polar + polar).cos()) + n(0.2) * r2 * polar.sin();
    [
        r1 * (a.1 - c.1 - phase) + r2 * (b.1 - c.1),
        e.1 - c.1 - (f.1 - c.1) / n(3.0),
        r1 * (b.1 - a.1 - phase) - r2 * (d.1 - a.1),
        d.1 + n(1.5) * e.1,
        along(b.1, [0.6, 0.8], line, end) + r1 * (a.1 - b.1) - r2,
        along(d.1, [half, -half], d.0, c.0) + r2 * (c.1 - d.1),
        along(d.1, [half, half], d.0, c.0) - r2,
        psi - n(0.3) * a.1,
        profile - (dx * dx + dy * dy).sqrt(),
        e.0[0] - n(0.1) * d.1,
    ]
}

/// Rows of some ten terms of up to five factors of size 5, evaluated in two
/// different ways: 200 ε.
#[test]
fn every_coupling_agrees_with_jets() {
    check_against_jets!(Couplings, CouplingsCoordinates, couplings_by_hand, 1.5, 3.0, 200.0 * f64::EPSILON);
}

mechanism! {
    /// A planetary train: a motor on the sun, a brake on the arm, the ring fixed.
    Planetary {
        dof = 1;
        const r = 20 [mm];
        param push = 0.3 [N*m];
        param js = 4e-5 [kg*m^2];
        param jp = 1e-5 [kg*m^2];
        param ja = 6e-4 [kg*m^2];
        body sun (angle = phis) { inertia = js; }
        body planet (angle = phip) { inertia = jp; }
        body arm (angle = phia) { inertia = ja; }
        gear inner (sun, planet) radii (r, 1.5*r) carrier arm;
        internal_gear outer (ground, planet) radii (4*r, 1.5*r) carrier arm;
        torque motor on sun = push;
        start { der(phis) = 50 [rad/s]; }
    }
}

/// Willis: the sun turns 1 + R/r = 5 times as fast as the arm. With the inertia
/// seen by the sun, J = js + jp i² + ja/25, the tooth force on the planet comes
/// from the moments about the sun's axis, M − r F = js α.
#[test]
fn planetary_train_has_the_ratio_of_willis() -> Result<(), Error> {
    let run = Simulation::new(Planetary::declared(), 1e-3)?;
    let v = run.state().v;
    // three operations on a rate of 50 rad/s
    assert!((v.phia - 50.0 / 5.0).abs() < 1e-13, "{v:?}");
    // outside the ring's pitch circle: (ω_p − ω_a)/(0 − ω_a) = R/r_p
    let of_planet = (1.0 - 4.0 / 1.5) / 5.0;
    assert!((v.phip - 50.0 * of_planet).abs() < 1e-13);
    let solved = run.reactions()?;
    let inertia = 4e-5 + 1e-5 * of_planet * of_planet + 6e-4 / 25.0;
    let alpha = 0.3 / inertia;
    assert!((solved.acceleration.phis / alpha - 1.0).abs() < 1e-14);
    let force = (0.3 - 4e-5 * alpha) / 0.02;
    assert!((solved.multipliers.inner / force - 1.0).abs() < 1e-13, "{} {force}", solved.multipliers.inner);
    // the planet turns under both tooth forces, r_p (F_ring − F_sun) = jp α_p
    let of_ring = force + 1e-5 * of_planet * alpha / 0.03;
    assert!((solved.multipliers.outer / of_ring - 1.0).abs() < 1e-13);
    // the arm is driven by the couple of both: (r + r_p) F_sun + (R − r_p) F_ring
    let couple = 0.05 * (force + of_ring);
    assert!((couple / (6e-4 * alpha / 5.0) - 1.0).abs() < 1e-13);
    Ok(())
}

mechanism! {
    /// The same train by its numbers of teeth.
    PlanetaryByTeeth {
        dof = 1;
        body sun (angle = phis) { inertia = 4e-5 [kg*m^2]; }
        body planet (angle = phip) { inertia = 1e-5 [kg*m^2]; }
        body arm (angle = phia) { inertia = 6e-4 [kg*m^2]; }
        gear inner (sun, planet) teeth (20, 30) carrier arm;
        internal_gear outer (ground, planet) carrier arm teeth (80, 30);
        torque motor on sun = 0.3 [N*m];
        start { der(phis) = 50 [rad/s]; }
    }
}

/// Teeth are radii up to a factor: the same motion, and torques in place of the
/// tooth forces.
#[test]
fn teeth_are_radii() -> Result<(), Error> {
    let radii = Simulation::new(Planetary::declared(), 1e-3)?.reactions()?;
    let teeth = Simulation::new(PlanetaryByTeeth::declared(), 1e-3)?.reactions()?;
    let same = |a: f64, b: f64| assert!((a / b - 1.0).abs() < 1e-13, "{a} {b}");
    same(teeth.acceleration.phia, radii.acceleration.phia);
    same(teeth.multipliers.inner, 0.02 * radii.multipliers.inner);
    same(teeth.multipliers.outer, 0.08 * radii.multipliers.outer);
    Ok(())
}

mechanism! {
    /// A motor drives a bar through a pinion, up a slope of 3:4.
    RackAndPinion {
        dof = 1;
        param r = 50 [mm];
        param m = 4 [kg];
        gravity = (0, -10) [m/s^2];
        body pinion (phi) { inertia = 0.02 [kg*m^2]; }
        body bar (x, y) { mass = m; }
        point_on_line guide (bar, ground) along (4, 3);
        rack mesh (pinion, bar) along (1, 0.75) radius r;
        torque motor on pinion = 2.5 [N*m];
        start { phi = 0; }
    }
}

/// u·(p₁ − p₂) + rφ = 0: the bar moves by s = rφ up the slope, so
/// (J/r + m r) φ̈ = M/r − m g sin a, and the tooth pushes the bar by m(s̈ + g sin a).
#[test]
fn rack_and_pinion_accelerate() -> Result<(), Error> {
    let solved = Simulation::new(RackAndPinion::declared(), 1e-3)?.reactions()?;
    let (r, m, weight) = (0.05, 4.0, 4.0 * 10.0 * 0.6);
    let alpha = (2.5 / r - weight) / (0.02 / r + m * r);
    assert!((solved.acceleration.phi / alpha - 1.0).abs() < 1e-13);
    assert!((solved.acceleration.x - 0.8 * r * alpha).abs() < 1e-13);
    assert!((solved.acceleration.y - 0.6 * r * alpha).abs() < 1e-13);
    let tooth = m * r * alpha + weight;
    assert!((solved.multipliers.mesh / tooth - 1.0).abs() < 1e-13);
    // the pinion feels −rλ
    assert!((2.5 - r * solved.multipliers.mesh - 0.02 * alpha).abs() < 1e-13);
    Ok(())
}

mechanism! {
    /// A solid cylinder rolls down a slope of 3:4.
    Cylinder {
        dof = 1;
        param r = 0.2 [m];
        param m = 3 [kg];
        gravity = (0, -10) [m/s^2];
        body wheel (x, y, phi) { mass = m; inertia = m*r^2/2; }
        point track on ground = (1 [m], 0.5 [m]);
        rolling contact (wheel, ground.track) along (4, -3) radius r;
        start { phi = 0; guess x = 1 [m]; guess y = 1 [m]; }
    }
}

/// a = ⅔ g sin α down the slope, friction ⅓ m g sin α and normal force m g cos α;
/// uniformly accelerated motion is what Heun's method integrates exactly.
#[test]
fn cylinder_rolls_down() -> Result<(), Error> {
    let mut run = Simulation::new(Cylinder::declared(), 1e-3)?;
    let solved = run.reactions()?;
    let a = 2.0 / 3.0 * 10.0 * 0.6;
    assert!(
        (solved.acceleration.x - 0.8 * a).abs() < 1e-13 && (solved.acceleration.y + 0.6 * a).abs() < 1e-13
    );
    assert!((solved.acceleration.phi + a / 0.2).abs() < 1e-13);
    // the wheel feels −λ: friction up the slope, −u; the track's force along n
    assert!((solved.multipliers.contact_slip - 3.0 * 10.0 * 0.6 / 3.0).abs() < 1e-13);
    assert!((solved.multipliers.contact_normal + 3.0 * 10.0 * 0.8).abs() < 1e-13);
    let start = run.state().q;
    run.advance_to(0.5)?;
    let q = run.state().q;
    let way = (q.x - start.x).hypot(q.y - start.y);
    // 500 steps, each rounding a position of 1 m
    assert!((way - a * 0.125).abs() < 500.0 * f64::EPSILON, "{way}");
    assert!((0.2 * q.phi + way).abs() < 500.0 * f64::EPSILON);
    Ok(())
}

mechanism! {
    /// A cylinder on a plank that is pulled along a smooth floor.
    Plank {
        dof = 2;
        param r = 0.2 [m];
        param m = 3 [kg];
        gravity = (0, -10) [m/s^2];
        body wheel (x1, y1, phi1) { mass = m; inertia = m*r^2/2; }
        body plank (x2, y2, phi2) { mass = 2 [kg]; inertia = 1 [kg*m^2]; }
        point top on plank = (0, 0.05 [m]);
        prismatic floor (plank, ground) along (1, 0);
        rolling contact (wheel, plank.top) radius r along (1, 0);
        force pull on plank = (18 [N], 0);
        start { x2 = 0; phi1 = 0; }
    }
}

/// Rolling backwards, the wheel moves a third as fast as the plank: with its
/// acceleration a the friction is m a, and M 3a + m a = F.
#[test]
fn cylinder_stays_behind_on_a_plank() -> Result<(), Error> {
    let solved = Simulation::new(Plank::declared(), 1e-3)?.reactions()?;
    let a = 18.0 / (3.0 * 2.0 + 3.0);
    let near = |x: f64, y: f64| assert!((x - y).abs() < 1e-12, "{x} {y}");
    near(solved.acceleration.x1, a);
    near(solved.acceleration.x2, 3.0 * a);
    near(solved.acceleration.phi1, 2.0 * a / 0.2);
    // on the plank: friction backwards, the weight of the wheel downwards
    near(solved.multipliers.contact_slip, -3.0 * a);
    near(solved.multipliers.contact_normal, -30.0);
    // the floor carries both; the plank is the first body and feels −λ n
    near(solved.multipliers.floor_normal, -50.0);
    // about the plank's centre: friction at its top, 50 mm up, and the floor's
    // torque −λ keep the balance
    near(solved.multipliers.floor_angle, 0.05 * 3.0 * a);
    Ok(())
}

mechanism! {
    /// Two flywheels on a belt.
    Belt {
        dof = 1;
        param r1 = 30 [mm];
        param r2 = 90 [mm];
        body motor (angle = phi1) { inertia = 0.001 [kg*m^2]; }
        body load (angle = phi2) { inertia = 0.036 [kg*m^2]; }
        belt open (motor, load) radii (r1, r2);
        body reverse (angle = phi3) { inertia = 0.002 [kg*m^2]; }
        crossed_belt crossed (motor, reverse) radii (r1, r1) at 10 [deg];
        torque drive on motor = 0.7 [N*m];
        start { phi1 = 0; }
    }
}

/// The motor sees 0.001 + 0.036/9 + 0.002 kg m²; the belt pulls the load by
/// J₂ φ̈₂/r₂ and the crossed one turns backwards.
#[test]
fn belts_reduce_inertia_by_the_square() -> Result<(), Error> {
    let run = Simulation::new(Belt::declared(), 1e-3)?;
    let solved = run.reactions()?;
    let alpha = 0.7 / 0.007;
    assert!((solved.acceleration.phi1 / alpha - 1.0).abs() < 1e-14);
    assert!((solved.acceleration.phi2 / (alpha / 3.0) - 1.0).abs() < 1e-14);
    assert!((solved.acceleration.phi3 / -alpha - 1.0).abs() < 1e-14);
    assert!((solved.multipliers.open / (0.036 * alpha / 3.0 / 0.09) - 1.0).abs() < 1e-13);
    assert!((solved.multipliers.crossed / (0.002 * alpha / 0.03) - 1.0).abs() < 1e-13);
    // the first is at 10° where the second is at 0: φ₁ − 10° + φ₃ = 0
    assert!((run.state().q.phi3 - 10.0_f64.to_radians()).abs() < 1e-15);
    Ok(())
}

mechanism! {
    /// A circle turning about a point 8 mm off its centre lifts a knife edge; its
    /// polar form is ρ = e cos ψ + √(R² − e² sin²ψ).
    EccentricCam {
        dof = 0;
        param e = 8 [mm];
        param r = 25 [mm];
        param omega = 20 [rad/s];
        gravity = (0, -9.81) [m/s^2];
        body disk (angle = phi) { inertia = 1e-5 [kg*m^2]; }
        body follower (y) { mass = 0.4 [kg]; }
        cam lift (disk, follower) = e*cos(angle) + sqrt(r^2 - e^2*sin(angle)^2);
        drive motor: phi = omega*t;
        start { guess y = 30 [mm]; }
        output torque [N*m] = effort(motor);
    }
}

/// The edge moves like the slider of a crank e with a rod R: with θ = π/2 − ωt,
/// y = e cos θ + √(R² − e² sin² θ). The contact carries weight and inertia, and
/// the motor its power.
#[test]
fn eccentric_circle_is_a_slider_crank() -> Result<(), Error> {
    let mut kinematics = Kinematics::new(EccentricCam::declared())?;
    let run = Simulation::new(EccentricCam::declared(), 1e-4)?;
    let (e, r, w) = (8e-3_f64, 25e-3_f64, 20.0_f64);
    for k in 0..100 {
        let t = 0.01 * f64::from(k);
        let motion = kinematics.at(t)?;
        let (s, c) = (w * t).sin_cos();
        // in terms of φ = ωt: y = e sin φ + √(R² − e² cos² φ)
        let root = (r * r - e * e * c * c).sqrt();
        let root_dot = e * e * s * c * w / root;
        let root_ddot = (e * e * (c * c - s * s) * w * w - root_dot * root_dot) / root;
        let (y, v, a) = (e * s + root, e * c * w + root_dot, -e * s * w * w + root_ddot);
        // φ reaches 20, with an ulp of 16 ε; the rates scale with ω
        let ulp = 16.0 * f64::EPSILON;
        assert!((motion.state.q.y - y).abs() < ulp * r, "{t}");
        assert!((motion.state.v.y - v).abs() < 4.0 * ulp * r * w, "{t}");
        assert!((motion.acceleration.y - a).abs() < 16.0 * ulp * r * w * w, "{t}");
    }
    let solved = run.reactions()?;
    let push = 0.4 * (9.81 + solved.acceleration.y);
    assert!((solved.multipliers.lift - push).abs() < 1e-13);
    // the power of the motor lifts the follower: M ω = F v
    let power = run.outputs()?.torque * w;
    assert!((power - push * run.state().v.y).abs() < 1e-13, "{power}");
    Ok(())
}

mechanism! {
    /// A screw under load: a coupler between a turn and a way.
    Screw {
        dof = 1;
        param lead = 5 [mm];
        body spindle (phi) { inertia = 2e-4 [kg*m^2]; }
        body nut (x) { mass = 6 [kg]; }
        coupler thread: nut.x = lead/(2*pi)*spindle.angle;
        force load on nut = (-400 [N], 0);
        torque motor on spindle = 0.5 [N*m];
        start { phi = 0; }
    }
}

/// With k = lead/2π: (J + m k²) φ̈ = M − k F; the thread pushes the nut by −λ.
#[test]
fn screw_drives_its_nut() -> Result<(), Error> {
    let solved = Simulation::new(Screw::declared(), 1e-3)?.reactions()?;
    let k = 0.005 / core::f64::consts::TAU;
    let alpha = (0.5 - k * 400.0) / (2e-4 + 6.0 * k * k);
    assert!((solved.acceleration.phi / alpha - 1.0).abs() < 1e-13);
    assert!((solved.multipliers.thread / -(400.0 + 6.0 * k * alpha) - 1.0).abs() < 1e-13);
    Ok(())
}

mechanism! {
    /// A cam of n lobes: closed for whole n alone.
    LobedCam {
        dof = 1;
        param n = 3;
        param r = 20 [mm];
        body disk (angle = phi) { inertia = 1e-5 [kg*m^2]; }
        body follower (y) { mass = 0.4 [kg]; }
        cam lift (disk, follower) = r*(1 + 0.1*cos(n*angle + 1));
        start { guess y = 20 [mm]; }
    }
}

/// The radius would jump where the polar angle passes half a turn.
#[test]
fn cam_that_does_not_close_is_refused_at_run_time() {
    let with = |n| LobedCam::new(LobedCamParameters { n, r: 0.02 });
    assert!(with(4.0).is_ok());
    let refused = with(2.5).unwrap_err();
    let Error::Parameter { name, value, .. } = refused else { panic!("{refused:?}") };
    assert_eq!(name, "jump of the radius of lift");
    // r/10 (cos(2.5π + 1) − cos(−2.5π + 1)) = −r/5 sin(2.5π) sin 1
    assert!((value + 0.004 * 1.0_f64.sin()).abs() < 1e-15, "{value}");
    assert!(LobedCam::<f32>::new(LobedCamParameters { n: 5.0, r: 0.02 }).is_ok());
}
