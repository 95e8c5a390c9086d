//! Friction that follows the reactions it changes: answers by hand for blocks,
//! wedges, pins and stacks, the limit at which a mechanism jams, and the order of
//! convergence.

use mbs_runtime::{Error, Mechanism, Simulation, mechanism};

mechanism! {
    /// A block that slides down a slope, pressed on it by its own weight.
    Incline {
        dof = 1;
        const slope = 30 [deg];
        param mu = 0.3;
        param push = 0 [N];
        gravity = (0, -9.81) [m/s^2];
        body block (x, y, phi) { mass = 3 [kg]; inertia = 0.1 [kg*m^2]; }
        prismatic guide (block, ground) along (cos(slope), -sin(slope)) at 0;
        friction rub (block, ground) along (cos(slope), -sin(slope)) {
            coefficient = mu;
            normal = reaction(guide);
            transition = 1e-3 [m/s];
        }
        // across the slope, and against the weight's component
        force pushed on block = (push*sin(slope), push*cos(slope));
        start { x = 0; der(x) = 1 [m/s]; }
        output rub [N] = force(rub);
        output heat [W] = power(rub);
        output normal [N] = reaction(guide, block).y/cos(slope);
        output speed [m/s] = speed(block);
    }
}

/// s̈ = g (sin α − μ cos α) while tanh(v/v_t) is 1 to rounding, v > 40 v_t.
#[test]
fn block_on_an_incline_slides_as_coulomb_says() -> Result<(), Error> {
    let (sine, cosine) = 30.0_f64.to_radians().sin_cos();
    let mut run = Simulation::new(Incline::declared(), 1e-3)?;
    let acceleration = 9.81 * (sine - 0.3 * cosine);
    let solved = run.reactions()?.acceleration;
    assert!((solved.x - acceleration * cosine).abs() < 1e-14, "{}", solved.x);
    assert!((solved.y + acceleration * sine).abs() < 1e-14);
    let outputs = run.outputs()?;
    let weight = 3.0 * 9.81 * cosine;
    assert!((outputs.normal - weight).abs() < 1e-13 && (outputs.rub + 0.3 * weight).abs() < 1e-13);
    // the motion is uniformly accelerated, which Heun's method solves exactly
    run.advance_to(1.0)?;
    let speed = run.outputs()?.speed * cosine;
    let start = 1.0 / cosine;
    assert!((speed / cosine - (start + acceleration)).abs() < 1e-11, "{speed}");
    let heat = run.outputs()?.heat;
    assert!((heat + 0.3 * weight * (start + acceleration)).abs() < 1e-10);
    Ok(())
}

/// The same in single precision: ten roundings of accelerations of size 10.
#[test]
fn single_precision_slides_as_well() -> Result<(), Error> {
    let run = Simulation::new(Incline::<f32>::default(), 1e-3)?;
    let (sine, cosine) = 30.0_f64.to_radians().sin_cos();
    let expected = 9.81 * (sine - 0.3 * cosine) * cosine;
    let found = f64::from(run.reactions()?.acceleration.x);
    assert!((found - expected).abs() < 100.0 * f64::from(f32::EPSILON), "{found} {expected}");
    Ok(())
}

/// A pull that lifts the block off the slope reverses the reaction; the rail
/// then holds it down, and rubs all the same.
#[test]
fn reversed_reaction_rubs_too() -> Result<(), Error> {
    let (sine, cosine) = 30.0_f64.to_radians().sin_cos();
    let parameters = InclineParameters { push: 100.0, ..InclineParameters::default() };
    let run = Simulation::new(Incline::new(parameters)?, 1e-3)?;
    let normal = 100.0 - 3.0 * 9.81 * cosine;
    let acceleration = 9.81 * sine - 0.3 * normal / 3.0;
    let solved = run.reactions()?.acceleration;
    assert!((solved.x - acceleration * cosine).abs() < 1e-13, "{} {}", solved.x, acceleration * cosine);
    Ok(())
}

mechanism! {
    /// A block thrown along a floor.
    Thrown {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body block (x, y) { mass = 2 [kg]; }
        point_on_line floor (block, ground) along (1, 0);
        friction rub (block, ground) along (1, 0) {
            coefficient = 0.4;
            normal = lambda(floor);
            transition = 1e-4 [m/s];
        }
        start { x = 0; der(x) = 2 [m/s]; }
    }
}

/// It stops after v²/(2 μ g) and stays, but for the creep of the smooth law:
/// below v_t it decays with the time constant v_t/(μ g), so the way from
/// 40 v_t on is about v_t·(40 v_t/μg): 1e-7 m. A step lets it overshoot by
/// μ g h² = 4e-8 m.
#[test]
fn thrown_block_stops_after_its_stopping_distance() -> Result<(), Error> {
    let mut run = Simulation::new(Thrown::declared(), 1e-5)?;
    run.advance_to(1.0)?;
    let distance = 2.0 * 2.0 / (2.0 * 0.4 * 9.81);
    let (x, v) = (run.state().q.x, run.state().v.x);
    assert!((x - distance).abs() < 1e-6 && v.abs() < 1e-6, "{x} {distance} {v}");
    Ok(())
}

mechanism! {
    /// A slider pushed at an angle by a massless rod under a vertical load: the
    /// normal force depends on the friction that it causes.
    Wedge {
        dof = 1;
        param mu = 0.3;
        param angle = 40 [deg];
        param push = 50 [N];
        gravity = (0, -9.81) [m/s^2];
        body slider (x, y) { mass = 2 [kg]; }
        body knob (xk, yk) { mass = 1 [kg]; }
        point_on_line floor (slider, ground) along (1, 0);
        // a face of the slider on which the knob slides, without friction
        point_on_line face (knob, slider) along (cos(angle), sin(angle));
        // the knob moves along the vertical alone
        constraint shaft: xk = 0;
        friction rub (slider, ground) along (1, 0) {
            coefficient = mu;
            normal = lambda(floor);
            transition = 1e-3 [m/s];
        }
        force pushed on knob = (0, -push);
        start { x = 0; der(x) = -1 [m/s]; guess xk = 0; }
        output rub [N] = force(rub);
        output normal [N] = reaction(floor, slider).y;
    }
}

/// Newton's laws of the slider and of the knob, solved by hand.
#[test]
fn wedge_with_reaction_friction_is_a_linear_system() -> Result<(), Error> {
    let run = Simulation::new(Wedge::declared(), 1e-3)?;
    let (mu, push, m, mk, g) = (0.3, 50.0, 2.0, 1.0, 9.81);
    let (s, c) = 40.0_f64.to_radians().sin_cos();
    // Unknowns: a of the slider, the force F of the face on the knob, along
    // (−s, c), and N of the floor. The knob stays on the face: y_k = y − x tan a.
    // slider: m a = F s + μ N,      0 = N − m g − F c
    // knob:   −mk a s/c = F c − mk g − push
    let face = (mk * (g + push / mk) - mk * (s / c) * mu * g) / (c + mk / m * (s / c) * (s + mu * c));
    let normal = m * g + face * c;
    let acceleration = (face * s + mu * normal) / m;
    let solved = run.reactions()?;
    assert!((solved.acceleration.x - acceleration).abs() < 1e-12, "{} {acceleration}", solved.acceleration.x);
    let outputs = run.outputs()?;
    assert!((outputs.normal - normal).abs() < 1e-12, "{} {normal}", outputs.normal);
    assert!((outputs.rub - mu * normal).abs() < 1e-12, "{}", outputs.rub);
    Ok(())
}

mechanism! {
    /// A loaded journal: a wheel in a bearing with dry friction at its pin.
    Journal {
        dof = 1;
        param mu = 0.15;
        param radius = 20 [mm];
        param pull = 30 [N];
        gravity = (0, -9.81) [m/s^2];
        body wheel (x, y, phi) { mass = 4 [kg]; inertia = 0.05 [kg*m^2]; }
        revolute pin (ground, wheel);
        torsion_friction rub (wheel, ground) {
            coefficient = mu;
            normal = reaction(pin);
            radius = radius;
            transition = 1e-3 [rad/s];
        }
        force belt on wheel = (pull, 0);
        start { phi = 0; der(phi) = 5 [rad/s]; }
        output rub [N*m] = torque(rub);
        output heat [W] = power(rub);
        output load [N] = reaction(pin);
        output up [N] = reaction(pin, wheel).y;
        output down [N] = reaction(pin, ground).y;
    }
}

/// J φ̈ = −μ r |F|, |F|² = (m g)² + pull²; the centre of the wheel is at rest.
#[test]
fn journal_is_braked_by_its_load() -> Result<(), Error> {
    let mut run = Simulation::new(Journal::declared(), 1e-4)?;
    let load = (4.0_f64 * 9.81).hypot(30.0);
    let braking = 0.15 * 0.02 * load;
    let outputs = run.outputs()?;
    // sums of squares of size 1e3, so a few ulps of the load
    assert!((outputs.load - load).abs() < 1e-13, "{}", outputs.load);
    assert!((outputs.rub + braking).abs() < 1e-15 && (outputs.heat + 5.0 * braking).abs() < 1e-14);
    assert_eq!((outputs.up, outputs.down), (4.0 * 9.81, -4.0 * 9.81));
    assert!((run.reactions()?.acceleration.phi + braking / 0.05).abs() < 1e-13);
    // at rest after J ω/(μ r F) s; the smooth law adds the last v_t
    run.advance_to(0.9 * 5.0 * 0.05 / braking)?;
    let rate = run.state().v.phi;
    let left = 5.0 - braking / 0.05 * run.time();
    assert!((rate - left).abs() < 1e-10, "{rate} {left}");
    Ok(())
}

/// A pin without any load carries none: the norm of (0, 0) has no kink.
#[test]
fn unloaded_journal_turns_freely() -> Result<(), Error> {
    let run = Simulation::new(
        Journal::new(JournalParameters { pull: 0.0, mu: 0.0, ..JournalParameters::default() })?,
        1e-4,
    )?;
    assert_eq!(run.reactions()?.acceleration.phi, 0.0);
    Ok(())
}

mechanism! {
    /// Two blocks that rub on each other and on the floor: the lower one is
    /// pressed down by both.
    Stack {
        dof = 2;
        param mu = 0.2;
        param nu = 0.35;
        gravity = (0, -9.81) [m/s^2];
        body lower (x, y) { mass = 3 [kg]; }
        body upper (xu, yu, phiu) { mass = 1 [kg]; inertia = 1e-3 [kg*m^2]; }
        point top on lower = (0, 0.1 [m]);
        point_on_line floor (lower, ground) along (1, 0);
        prismatic face (upper, lower.top) along (1, 0);
        friction below (lower, ground) along (1, 0) {
            coefficient = mu; normal = lambda(floor); transition = 1e-4 [m/s];
        }
        friction between (upper, lower) along (1, 0) {
            coefficient = nu; normal = reaction(face); transition = 1e-4 [m/s];
        }
        start { x = 0; xu = 0; der(x) = 0.5 [m/s]; der(xu) = 2 [m/s]; guess yu = 0.1 [m]; }
        output below [N] = force(below);
        output between [N] = force(between);
    }
}

/// Upper block −ν g; lower one (ν m_u g − μ (m_u + m_l) g)/m_l.
#[test]
fn stacked_blocks_exchange_friction() -> Result<(), Error> {
    let run = Simulation::new(Stack::declared(), 1e-4)?;
    let solved = run.reactions()?.acceleration;
    let lower = (0.35 * 1.0 - 0.2 * 4.0) * 9.81 / 3.0;
    assert!((solved.xu + 0.35 * 9.81).abs() < 1e-14, "{}", solved.xu);
    assert!((solved.x - lower).abs() < 1e-14, "{}", solved.x);
    Ok(())
}

mechanism! {
    /// A rod that a thrust pushes along itself against the friction of its
    /// guides: with a coefficient times geometry above 1 it jams.
    Jamming {
        dof = 1;
        param mu = 0.2;
        param arm = 1 [m];
        param span = 0.5 [m];
        body rod (x, y, phi) { mass = 2 [kg]; inertia = 0.1 [kg*m^2]; }
        point front on rod = (span/2, 0);
        point rear on rod = (-span/2, 0);
        point handle on rod = (0, arm);
        point_on_line a (rod.front, ground) along (1, 0);
        point_on_line b (rod.rear, ground) along (1, 0);
        friction rub_a (rod.front, ground) along (1, 0) {
            coefficient = mu; normal = lambda(a); transition = 1e-3 [m/s];
        }
        friction rub_b (rod.rear, ground) along (1, 0) {
            coefficient = mu; normal = lambda(b); transition = 1e-3 [m/s];
        }
        force push on rod.handle = (10 [N], 0);
        start { x = 0; der(x) = 1 [m/s]; }
        output rub [N] = force(rub_a) + force(rub_b);
    }
}

/// The moment of the push about the centre is taken by N_a = −N_b, so
/// |N| = F arm/span and m ẍ = F (1 − 2 μ arm/span).
#[test]
fn drawer_is_pushed_at_its_handle() -> Result<(), Error> {
    let run = Simulation::new(Jamming::declared(), 1e-4)?;
    let expected = 10.0 * (1.0 - 2.0 * 0.2 / 0.5) / 2.0;
    let found = run.reactions()?.acceleration.x;
    assert!((found - expected).abs() < 1e-13, "{found} {expected}");
    Ok(())
}

mechanism! {
    /// Painlevé's rod: a pole that is pushed over the floor, leaning forward.
    Painleve {
        dof = 2;
        param mu = 0.5;
        gravity = (0, -9.81) [m/s^2];
        body pole (x, y, phi) { mass = 1 [kg]; inertia = 0.01 [kg*m^2]; }
        point foot on pole = (-0.5 [m], 0);
        point_on_line floor (pole.foot, ground) along (1, 0);
        friction rub (pole.foot, ground) along (1, 0) {
            coefficient = mu; normal = lambda(floor); transition = 1e-3 [m/s];
        }
        start { phi = 120 [deg]; der(x) = 1 [m/s]; guess y = 0.4 [m]; }
    }
}

/// With the foot at r = 0.5 m behind the centre and J = m k², the friction
/// coefficient times geometry is μ r² s c/(k² + r² c²), so the pole jams from
/// μ = (k² + r² c²)/(r² s c) on, s and c of its slope.
#[test]
fn pole_jams_beyond_the_critical_friction() -> Result<(), Error> {
    let (s, c) = 60.0_f64.to_radians().sin_cos();
    let critical = (0.01 + 0.25 * c * c) / (0.25 * s * c);
    let run = |mu: f64| {
        let pole = Painleve::new(PainleveParameters { mu })?;
        Simulation::new(pole, 1e-6)?.step()
    };
    assert!(run(0.99 * critical).is_ok());
    let jam = run(1.01 * critical);
    let Err(Error::Singular { constraint, coordinate, growth, .. }) = jam else { panic!("{jam:?}") };
    // no pivot of the constraints is to blame
    assert_eq!((constraint, coordinate, growth), ("", "", f64::INFINITY));
    Ok(())
}

/// Friction that leaves the reactions as they are costs no more than a force:
/// nothing is solved for, nothing watched.
#[test]
fn friction_that_changes_no_reaction_is_a_plain_force() {
    for info in [Thrown::<f64>::INFO, Stack::<f64>::INFO, Journal::<f64>::INFO] {
        let operations = info.operations("stabilized").unwrap_or_default();
        assert_eq!((operations.div, operations.watch), (0, 0), "{}", info.name);
    }
}

mechanism! {
    /// A pendulum that rubs at its pin, with a wide transition.
    Rubbing {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body rod (x, y, phi) { mass = 2 [kg]; inertia = 0.05 [kg*m^2]; }
        point top on rod = (-0.3 [m], 0);
        revolute pin (ground, rod.top);
        torsion_friction rub (rod, ground) {
            coefficient = 0.3; normal = reaction(pin); radius = 40 [mm]; transition = 4 [rad/s];
        }
        start { phi = -10 [deg]; }
    }
}

/// The reactions that rub are those without feedback, so the feedback, which is
/// of the order h, does not spoil the order: errors fall fourfold with h/2.
#[test]
fn reaction_friction_keeps_the_second_order() -> Result<(), Error> {
    let angle = |h: f64| -> Result<f64, Error> {
        let mut run = Simulation::new(Rubbing::declared(), h)?;
        run.advance_to(0.8)?;
        Ok(run.state().q.phi)
    };
    let [a, b, c] = [1e-3, 5e-4, 2.5e-4].map(angle);
    let (a, b, c) = (a?, b?, c?);
    let ratio = (a - b) / (b - c);
    // third-order terms change it by h times rates of 10/s
    assert!((ratio - 4.0).abs() < 0.3, "{ratio}");
    Ok(())
}
