//! Force elements against closed-form answers: a motor's run-up, blocks and
//! pins that rub on what presses them, a fall through air, a thrust that turns
//! with its body.

use mbs_runtime::{Error, Mechanism, Simulation, mechanism};

mechanism! {
    /// A flywheel on a direct-current motor.
    RunUp {
        dof = 1;
        param inertia = 0.02 [kg*m^2];
        param stall = 2 [N*m];
        param no_load = 3000 [rpm];
        input voltage [1];
        body rotor (phi) { mass = 0; inertia = inertia; }
        motor drive (rotor, ground) { stall = stall; no_load = no_load; level = voltage; }
        start { phi = 0; }
        output torque [N*m] = torque(drive);
        output power [W] = power(drive);
    }
}

/// ω(t) = u ω₀ (1 − e^{−t/τ}), τ = J ω₀/T_stall. Heun's relative error for a
/// decay is below (h/τ)² t/(6τ): 1e-9 for h = 1e-3 τ at t = 2τ … with a margin
/// of the truncated term in u ω₀.
#[test]
fn motor_runs_up_exponentially() -> Result<(), Error> {
    let no_load = 3000.0 * std::f64::consts::PI / 30.0;
    let tau = 0.02 * no_load / 2.0;
    let mut run = Simulation::new(RunUp::declared(), 1e-3 * tau)?;
    run.inputs_mut().voltage = 0.5;
    assert!((run.outputs()?.torque - 1.0).abs() < 1e-15);
    for t in [0.5 * tau, 2.0 * tau] {
        run.advance_to(t)?;
        let expected = 0.5 * no_load * (1.0 - (-t / tau).exp());
        let bound = 1e-6 * (t / tau) * 0.5 * no_load;
        let rotor = run.state().v.phi;
        assert!((rotor - expected).abs() < bound, "{rotor} {expected}");
        let outputs = run.outputs()?;
        assert!((outputs.power - outputs.torque * rotor).abs() <= 1e-15 * outputs.power.abs());
    }
    Ok(())
}

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

/// By hand, with N the force of the floor, F that of the face across it, y_k =
/// −x tan a: knob (ẍ tan a) m_k = … ; slider m ẍ = … − μ N sign(ẋ).
#[test]
fn wedge_with_reaction_friction_is_a_linear_system() -> Result<(), Error> {
    let run = Simulation::new(Wedge::declared(), 1e-3)?;
    let (mu, push, m, mk, g) = (0.3, 50.0, 2.0, 1.0, 9.81);
    let (s, c) = 40.0_f64.to_radians().sin_cos();
    // unknowns a (of the slider), F (face on the knob, along (−s, c)), N.
    // The knob stays on the line through the slider: y_k = y − x tan a.
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
