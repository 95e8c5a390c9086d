//! Profiles, tables, laws of motion and the distance of two places: their derivatives
//! against formulas by hand, and motions that are known in closed form.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use core::f64::consts::{PI, TAU};

use mbs_runtime::{
    Adaptive, Components, Error, Kinematics, Mechanism, Real, Simulation, Tolerances, mechanism,
};
use nalgebra::{DMatrix, DVector};
use tests::check_against_jets;
use tests::jet::{Jet, value};

mechanism! {
    /// Profiles and laws in constraints, away from where they switch.
    Functions {
        dof = 5;
        const m = 1 [kg];
        const j = 1 [kg*m^2];
        param stroke = 0.4 [m];
        param share = 0.3;
        param duration = 2 [s];
        profile lift = spline(
            (-20 [deg], 200 [mm]), (35 [deg], 0.3 [m]), (90 [deg], 350 [mm]), (200 [deg], 100 [mm])
        ) period 360 [deg];
        profile wave = spline((0.1, -1), (0.4, 2), (1.5, 0.5)) period 2;
        body disk (x, y, phi) { mass = m; inertia = j; }
        body follower (xf, yf, phif) { mass = m; inertia = j; }
        body slide (x2, y2, phi2) { mass = m; inertia = j; }
        body block (x3, y3, phi3) { mass = m; inertia = j; }
        point tip on follower = (0.1 [m], 0.2 [m]);
        point centre on disk = (-6 [m], 0);
        constraint along: x2 = lift(phi - 2*phif) + 0.1 [m]*wave(t/(1 [s]) + y2/(1 [m]));
        cam contact (disk.centre, follower.tip) = 6 [m] + lift(angle);
        constraint first: x3 = stroke*cycloidal(0.5 + phi/8);
        constraint second: y3 = stroke*polynomial_345(0.5 + phif/8 + 0.1*t/duration);
        constraint third: phi3 = harmonic(0.5 + phif/8);
        constraint fourth: y2 = stroke*trapezoidal(0.45 + phi2/200, share);
        constraint apart: distance(slide, ground.hook) = 7 [m] + 0.3*xf;
        point hook on ground = (0, 7 [m]);
        start { guess phi = 0.1; }
    }
}

/// The same spline in another form: second derivatives M from a full system, and
/// S = M₀ (x₁−x)³/6h + M₁ (x−x₀)³/6h + (y₀/h − M₀h/6)(x₁−x) + (y₁/h − M₁h/6)(x−x₀).
fn spline_by_hand<const N: usize>(points: [(f64, f64); N], period: f64, x: Jet) -> Jet {
    let width = |at: usize| {
        let next = if at + 1 < N { points[at + 1].0 } else { points[0].0 + period };
        next - points[at].0
    };
    let mut matrix = DMatrix::<f64>::zeros(N, N);
    let mut rhs = DVector::<f64>::zeros(N);
    for at in 0..N {
        let (before, behind) = ((at + N - 1) % N, (at + 1) % N);
        matrix[(at, before)] += width(before) / 6.0;
        matrix[(at, at)] += (width(before) + width(at)) / 3.0;
        matrix[(at, behind)] += width(at) / 6.0;
        rhs[at] =
            (points[behind].1 - points[at].1) / width(at) - (points[at].1 - points[before].1) / width(before);
    }
    let curvatures = matrix.lu().solve(&rhs).expect("diagonally dominant");
    let turns = ((value(x) - points[0].0) / period).floor();
    let x = x - Jet::from_f64(turns * period);
    let at = (0..N).rev().find(|&at| points[at].0 <= value(x)).unwrap_or(0);
    let h = width(at);
    let (y0, y1, m0, m1) = (points[at].1, points[(at + 1) % N].1, curvatures[at], curvatures[(at + 1) % N]);
    let n = Jet::from_f64;
    let (after, left) = (x - n(points[at].0), n(points[at].0 + h) - x);
    n(m0 / (6.0 * h)) * left * left * left
        + n(m1 / (6.0 * h)) * after * after * after
        + n(y0 / h - m0 * h / 6.0) * left
        + n(y1 / h - m1 * h / 6.0) * after
}

/// The rows of [`Functions`], with the laws as they stand in books.
fn functions_by_hand(t: Jet, q: [Jet; 12]) -> [Jet; 7] {
    let n = Jet::from_f64;
    let [x, y, phi, xf, yf, phif, x2, y2, phi2, x3, y3, phi3] = q;
    let degrees = f64::to_radians;
    let lift = |x| {
        let points =
            [(degrees(-20.0), 0.2), (degrees(35.0), 0.3), (degrees(90.0), 0.35), (degrees(200.0), 0.1)];
        spline_by_hand(points, TAU, x)
    };
    let wave = |x| spline_by_hand([(0.1, -1.0), (0.4, 2.0), (1.5, 0.5)], 2.0, x);
    let ((s, c), (sf, cf)) = (phi.sin_cos(), phif.sin_cos());
    let tip = [xf + n(0.1) * cf - n(0.2) * sf, yf + n(0.1) * sf + n(0.2) * cf];
    let (dx, dy) = (tip[0] - (x - n(6.0) * c), tip[1] - (y - n(6.0) * s));
    let progress = n(0.5) + phi / n(8.0);
    let cycloidal = progress - (n(TAU) * progress).sin() / n(TAU);
    let u = n(0.5) + phif / n(8.0) + n(0.05) * t;
    let polynomial = u * u * u * (n(10.0) - n(15.0) * u + n(6.0) * u * u);
    let harmonic = (n(1.0) - (n(PI) * (n(0.5) + phif / n(8.0))).cos()) / n(2.0);
    let a = 0.3;
    // between the ramps the velocity is 1/(1 − a)
    let trapezoid = (n(0.45) + phi2 / n(200.0) - n(a / 2.0)) / n(1.0 - a);
    let apart = (x2 * x2 + (y2 - n(7.0)) * (y2 - n(7.0))).sqrt();
    [
        x2 - lift(phi - n(2.0) * phif) - n(0.1) * wave(t + y2),
        n(6.0) + lift(dy.atan2(dx) - phi) - (dx * dx + dy * dy).sqrt(),
        x3 - n(0.4) * cycloidal,
        y3 - n(0.4) * polynomial,
        phi3 - harmonic,
        y2 - n(0.4) * trapezoid,
        apart - n(7.0) - n(0.3) * xf,
    ]
}

/// Cubics through points 0.3 apart have coefficients up to 100, from which two
/// ways to their values differ by some ten roundings: 2000 ε.
#[test]
fn every_function_agrees_with_jets() {
    check_against_jets!(Functions, FunctionsCoordinates, functions_by_hand, 1.5, 3.0, 2000.0 * f64::EPSILON);
}

mechanism! {
    /// An eccentric circle again, given by points: a cosine, sampled.
    SampledCam {
        dof = 0;
        param omega = 20 [rad/s];
        profile lift = spline(
            (0 [deg], 28 [mm]), (60 [deg], 26.5 [mm]), (120 [deg], 23.5 [mm]), (180 [deg], 22 [mm]),
            (240 [deg], 23.5 [mm]), (300 [deg], 26.5 [mm])
        ) period 360 [deg];
        body disk (angle = phi) { inertia = 1e-5 [kg*m^2]; }
        body follower (y) { mass = 0.4 [kg]; }
        cam contact (disk, follower) = lift(angle);
        drive motor: phi = -omega*t;
        start { guess y = 30 [mm]; }
    }
}

/// ρ = 25 mm + 3 mm cos ψ at ψ = π/2 + ωt, off by 5/384 h⁴ of the amplitude with
/// h = 60°; after a whole turn the follower is where it was.
#[test]
fn sampled_cam_follows_its_points() -> Result<(), Error> {
    let mut kinematics = Kinematics::new(SampledCam::declared())?;
    let bound = 5.0 / 384.0 * (PI / 3.0).powi(4) * 3e-3;
    for k in 0..60 {
        let t = 0.01 * f64::from(k);
        let motion = kinematics.at(t)?;
        let exact = 25e-3 + 3e-3 * (PI / 2.0 + 20.0 * t).cos();
        assert!((motion.state.q.y - exact).abs() < bound, "{t}: {} {exact}", motion.state.q.y);
        let again = kinematics.at(t + TAU / 20.0)?;
        // the angle of 20 rad has an ulp of 16 ε, the slope is 3 mm/rad
        assert!((again.state.q.y - motion.state.q.y).abs() < 3e-3 * 32.0 * f64::EPSILON, "{t}");
    }
    // at the sampled points themselves it is exact
    let at_sample = kinematics.at((PI / 3.0 - PI / 2.0 + TAU) / 20.0)?;
    assert!((at_sample.state.q.y - 26.5e-3).abs() < 3e-3 * 32.0 * f64::EPSILON);
    Ok(())
}

mechanism! {
    /// The laws side by side, over two seconds from t = 1 s on.
    Laws {
        dof = 0;
        const m = 1 [kg];
        param stroke = 0.1 [m];
        let s = (t - 1 [s])/(2 [s]);
        body a (xa) { mass = m; }
        body b (xb) { mass = m; }
        body c (xc) { mass = m; }
        body d (xd) { mass = m; }
        body e (xe) { mass = m; }
        drive to_a: xa = stroke*cycloidal(s);
        drive to_b: xb = stroke*polynomial_345(s);
        drive to_c: xc = stroke*harmonic(s);
        drive to_d: xd = stroke*trapezoidal(s, 0.25);
        drive to_e: xe = stroke*trapezoidal(s, 1/2);
    }
}

/// Position, velocity and acceleration at the time t.
fn laws_at(t: f64) -> Result<[[f64; 5]; 3], Error> {
    let motion = Kinematics::new(Laws::declared())?.at(t)?;
    Ok([motion.state.q.into_array(), motion.state.v.into_array(), motion.acceleration.into_array()])
}

/// Before and behind, everything rests exactly; in the middle all laws are half
/// way, at the peak velocities 2, 15/8, π/2, 4/3 and 2 of stroke/duration.
#[test]
fn laws_rise_from_rest_to_rest() -> Result<(), Error> {
    for t in [0.0, 0.999] {
        assert_eq!(laws_at(t)?, [[0.0; 5]; 3], "{t}");
    }
    for t in [3.001, 7.0] {
        let [q, v, a] = laws_at(t)?;
        // 10 − 15 + 6 = 1 exactly; sines of 2π and quotients round
        assert!(q.iter().all(|q| (q - 0.1).abs() < 4.0 * f64::EPSILON), "{q:?}");
        assert_eq!([v, a], [[0.0; 5]; 2], "{t}");
    }
    let [q, v, _] = laws_at(2.0)?;
    assert!(q.iter().all(|q| (q - 0.05).abs() < 4.0 * f64::EPSILON), "{q:?}");
    for (v, peak) in v.iter().zip([2.0, 15.0 / 8.0, PI / 2.0, 4.0 / 3.0, 2.0]) {
        assert!((v - 0.05 * peak).abs() < 4.0 * f64::EPSILON, "{v} {peak}");
    }
    Ok(())
}

/// At the start the acceleration is that from the right: 0 for the cycloid and
/// the polynomial, π²/2 for the harmonic law, 1/(a(1 − a)) for a trapezoid, in
/// units of stroke/duration²; at the end it is over.
#[test]
fn laws_have_their_end_conditions() -> Result<(), Error> {
    let [q, v, a] = laws_at(1.0)?;
    assert_eq!([q, v], [[0.0; 5]; 2]);
    for (a, start) in a.iter().zip([0.0, 0.0, PI * PI / 2.0, 16.0 / 3.0, 4.0]) {
        assert!((a - 0.025 * start).abs() < 8.0 * f64::EPSILON, "{a} {start}");
    }
    assert_eq!(laws_at(3.0)?[2], [0.0; 5]);
    // just inside, the cycloid and the polynomial start and end without a jump:
    // their third derivatives are 4π² and 60; at the end the polynomial's terms,
    // up to 60 in its slope and 180 in the next, cancel but for their rounding
    let inside = 1e-6;
    let rounding = 2.0 * f64::EPSILON;
    for t in [1.0 + 2.0 * inside, 3.0 - 2.0 * inside] {
        let [_, v, a] = laws_at(t)?;
        assert!(a[..2].iter().all(|a| a.abs() < 0.025 * (60.0 * inside + 180.0 * rounding)), "{a:?}");
        assert!(v[..2].iter().all(|v| v.abs() < 0.05 * (30.0 * inside * inside + 60.0 * rounding)), "{v:?}");
        // the trapezoid is at its full deceleration on its way out
        let sign = if t < 2.0 { 1.0 } else { -1.0 };
        assert!((a[3] - sign * 0.025 * 16.0 / 3.0).abs() < 1e-14, "{a:?}");
    }
    // a quarter in, the trapezoid has done (a/2)/(1 − a) of the way and stops accelerating
    let [q, v, a] = laws_at(1.5)?;
    assert!((q[3] - 0.1 / 6.0).abs() < 1e-16 && (v[3] - 0.05 * 4.0 / 3.0).abs() < 1e-16);
    assert_eq!(a[3], 0.0);
    Ok(())
}

/// Velocities are what positions integrate: over the whole rise, Heun's method
/// keeps each coordinate at its drive, jumps of the acceleration included.
#[test]
fn laws_can_be_integrated() -> Result<(), Error> {
    let mut run = Simulation::new(Laws::declared(), 1e-3)?;
    let mut kinematics = Kinematics::new(Laws::declared())?;
    for _ in 0..40 {
        run.advance_to(run.time() + 0.1)?;
        let exact = kinematics.at(run.time())?.state.q.into_array();
        for (q, exact) in run.state().q.into_array().iter().zip(exact) {
            // feedback leaves h³ times the third derivative, 0.0125·4π², and
            // where the acceleration jumps by 0.13 m/s², h² of that
            assert!((q - exact).abs() < 1.4e-7, "{} {q} {exact}", run.time());
        }
    }
    Ok(())
}

mechanism! {
    /// A boom on a cylinder that extends at constant speed.
    Excavator {
        dof = 0;
        param a = 1.2 [m];
        param b = 0.8 [m];
        param speed = 50 [mm/s];
        gravity = (0, -9.81) [m/s^2];
        body boom (angle = phi) { inertia = 40 [kg*m^2]; }
        point eye on boom = (a, 0);
        point pin on ground = (0, -b);
        torque weight on boom = -900 [N*m]*cos(phi);
        drive cylinder: distance(boom.eye, ground.pin) = 1.5 [m] + speed*t;
        start { guess phi = 5 [deg]; }
        output push [N] = effort(cylinder);
        output length [m] = distance(boom.eye, ground.pin);
        output extension [m/s] = der(distance(boom.eye, ground.pin));
    }
}

/// The law of cosines for the triangle of pin, joint and eye: L² = a² + b² +
/// 2ab sin φ. The cylinder's power is what turns the boom against its weight.
#[test]
fn cylinder_is_a_drive_of_a_distance() -> Result<(), Error> {
    let mut run = Simulation::new(Excavator::declared(), 1e-3)?;
    let (a, b, u) = (1.2, 0.8, 0.05);
    for _ in 0..5 {
        let (q, v) = (run.state().q.phi, run.state().v.phi);
        let length = 1.5 + u * run.time();
        let sine = (length * length - a * a - b * b) / (2.0 * a * b);
        let rate = length * u / (a * b * q.cos());
        // h³ times third derivatives of order 1e-3, with feedback
        assert!((q.sin() - sine).abs() < 1e-12, "{q}");
        assert!((v - rate).abs() < 1e-9, "{v} {rate}");
        let outputs = run.outputs()?;
        assert!((outputs.length - length).abs() < 1e-12 && (outputs.extension - u).abs() < 1e-9);
        let acceleration = run.reactions()?.acceleration.phi;
        let torque = 40.0 * acceleration + 900.0 * q.cos();
        // the arm of the cylinder about the joint is dL/dφ = ab cos φ / L
        let push = torque / (a * b * q.cos() / outputs.length);
        assert!((outputs.push / push - 1.0).abs() < 1e-12, "{} {push}", outputs.push);
        run.advance_to(run.time() + 0.5)?;
    }
    Ok(())
}

const TIGHT: Tolerances = Tolerances { rtol: 1e-10, atol: 1e-12, max_step: f64::INFINITY, first_step: None };

mechanism! {
    /// A ball between two springs of different stiffness, each of which pushes on its side.
    Bilinear {
        dof = 1;
        body ball (x) { mass = 1 [kg]; }
        table pull(x) = [(-1 [m], -400 [N]), (0 [m], 0 [N]), (1 [m], 100 [N])] linear outside extend;
        force springs on x = -pull(x);
        start { x = 0.1 [m]; }
    }
}

/// Half a period is π/10 s on the one side and π/20 s on the other. The error control finds the kinks: the run takes
/// less than three times the steps of one without them.
#[test]
fn a_table_with_a_kink_is_run_to_a_tolerance() -> Result<(), Error> {
    let period = PI / 10.0 + PI / 20.0;
    let mut run = Adaptive::builder(Bilinear::declared()).tolerances(TIGHT).build()?;
    run.advance_to(20.0 * period)?;
    let state = run.state();
    assert!((state.q.x - 0.1).abs() < 1e-8 && state.v.x.abs() < 1e-8, "{state:?}");
    // dopri5 takes 16 steps for a radian at this tolerance, here of 20 periods
    assert!(run.effort().steps < 3 * 2000, "{:?}", run.effort());
    Ok(())
}

mechanism! {
    /// A slide that a motor moves by a table of time, and a valve that opens in steps.
    Sequence {
        dof = 1;
        body slide (x) { mass = 2 [kg]; }
        body load (y) { mass = 1 [kg]; }
        table way(t) = [(0 [s], 0 [mm]), (1 [s], 100 [mm]), (2 [s], 100 [mm]), (3 [s], 0 [mm])]
            monotone outside hold;
        table valve(t) = [(0.5 [s], 2 [N]), (1.5 [s], -2 [N])] step outside extend;
        drive motor: x = way(t);
        force push on y = valve(t);
        start { y = 0; }
        output effort [N] = effort(motor);
    }
}

/// On its way up the drive is x = 0.15u − 0.05u³, which has a flat end at the dwell and the slope of the parabola
/// through three points at its beginning; down it is the same from behind. Its motor gives m ẍ. The first value of the
/// steps holds before it, and the last one for ever: y = t² up to 1.5 s, then a parabola downwards.
#[test]
fn tables_of_time_drive_and_switch() -> Result<(), Error> {
    let mut run = Adaptive::builder(Sequence::declared()).tolerances(TIGHT).build()?;
    for t in [0.25_f64, 0.75, 1.5, 2.25, 3.5] {
        run.advance_to(t)?;
        let u = if t < 2.0 { t.min(1.0) } else { (3.0 - t).max(0.0) };
        let expected = 0.15 * u - 0.05 * u.powi(3);
        let acceleration = if (1.0..2.0).contains(&t) || t > 3.0 { 0.0 } else { -0.3 * u };
        let fall = (t - 1.5).max(0.0);
        let way = t * t - 2.0 * fall * fall;
        let (state, inputs) = (run.state(), <Sequence as Mechanism>::Inputs::default());
        let slides = Sequence::declared();
        let reactions = slides.reactions(&state, &inputs, &Components::splat(0.0));
        let outputs = slides.outputs(&state, &inputs, &reactions);
        assert!((state.q.x - expected).abs() < 1e-9, "{t}: {} {expected}", state.q.x);
        assert!((outputs.effort - 2.0 * acceleration).abs() < 1e-9, "{t}: {} {acceleration}", outputs.effort);
        assert!((state.q.y - way).abs() < 1e-8, "{t}: {} {way}", state.q.y);
    }
    Ok(())
}
