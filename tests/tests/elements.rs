//! Force elements against closed-form answers: a motor's run-up, blocks and
//! pins that rub on what presses them, a fall through air, a thrust that turns
//! with its body.

use mbs_runtime::{Components, Error, Mechanism, Reactions, Simulation, State, mechanism};
use tests::jet::Jet;
use tests::random::Random;

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
        let pole = Painleve::new(PainleveParameters { mu, ..Default::default() })?;
        Simulation::new(pole, 1e-6)?.step()
    };
    assert!(run(0.99 * critical).is_ok());
    let jam = run(1.01 * critical);
    assert!(matches!(jam, Err(Error::Singular { .. })), "{jam:?}");
    Ok(())
}

mechanism! {
    /// A ball that falls through air, and one thrown into a wind.
    Fall {
        dof = 3;
        param density = 1.2 [kg/m^3];
        param area = 0.05 [m^2];
        gravity = (0, -9.81) [m/s^2];
        body ball (y) { mass = 0.1 [kg]; }
        drag air on ball { density = density; area = area; coefficient = 0.5; }
        body thrown (xt, yt) { mass = 0.1 [kg]; }
        drag gust on thrown { density = density; area = area; coefficient = 0.5; wind = (3, 4) [m/s]; }
        start { y = 0; }
        output power [W] = power(air);
        output resistance [N] = force(air);
    }
}

/// v(t) = −v∞ tanh(g t/v∞), v∞² = 2 m g/(ρ c A). Heun's error is of order
/// (h g/v∞)² = 2e-7 of v∞ here.
#[test]
fn falling_ball_reaches_its_terminal_velocity() -> Result<(), Error> {
    let mut run = Simulation::new(Fall::declared(), 1e-3)?;
    // at rest in the wind: F = ½ρcA·5·(3, 4)
    let rest = run.reactions()?.acceleration;
    let factor = 0.5 * 1.2 * 0.5 * 0.05 * 5.0 / 0.1;
    assert!((rest.xt - factor * 3.0).abs() < 1e-14 && (rest.yt - (factor * 4.0 - 9.81)).abs() < 1e-14);
    assert_eq!(rest.y, -9.81);
    let terminal = (2.0 * 0.1 * 9.81 / (1.2 * 0.5 * 0.05_f64)).sqrt();
    for t in [0.3, 1.0, 4.0] {
        run.advance_to(t)?;
        let expected = -terminal * (9.81 * t / terminal).tanh();
        let found = run.state().v.y;
        assert!((found - expected).abs() < 4e-7 * terminal, "{found} {expected}");
    }
    let outputs = run.outputs()?;
    assert!((outputs.power + outputs.resistance * run.state().v.y.abs()).abs() < 1e-14);
    Ok(())
}

mechanism! {
    /// Two free bodies, one of which rubs along a line of the other, with a
    /// motor between them, air on one and a thrust in the frame of the other.
    Pair {
        dof = 6;
        body a (xa, ya, phia) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        body b (xb, yb, phib) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
        point tip on a = (0.3, -0.2) [m];
        point mark on b = (0.1, 0.4) [m];
        friction rub (a.tip, b.mark) along (3, 4) {
            coefficient = 0.3; normal = 5 [N]; transition = 0.7 [m/s]; viscous = 0.6 [N*s/m];
        }
        torsion_friction pin (a, b) { torque = 2 [N*m]; transition = 0.9 [rad/s]; viscous = 0.2 [N*m*s]; }
        motor drive (b, a) { stall = 3 [N*m]; no_load = 4 [rad/s]; level = 0.7; }
        drag air on a.tip { density = 1.2 [kg/m^3]; area = 0.5 [m^2]; coefficient = 0.8; wind = (1, 2) [m/s]; }
        force thrust on b.mark in a = (2, 3) [N];
        output sliding [W] = power(rub);
        output turning [W] = power(pin);
        output driving [W] = power(drive);
        output blowing [W] = power(air);
        output pushing [W] = power(thrust);
        output fast [m/s] = speed(a.tip);
    }
}

/// The same forces by virtual work: jets along each coordinate give the
/// variation of places that are written out here.
#[test]
fn elements_do_the_virtual_work_of_their_forces() {
    let pair = Pair::declared();
    let mut random = Random::new(11);
    for _ in 0..200 {
        let (q, v): ([f64; 6], [f64; 6]) = (random.around_zero(2.0), random.around_zero(2.0));
        let along = |direction: [f64; 6]| std::array::from_fn(|i| Jet::line(q[i], direction[i]));
        let moving = places(along(v));
        let slide = 0.3 * 5.0 * (moving.slide.first / 0.7).tanh() + 0.6 * moving.slide.first;
        let turn = 2.0 * (moving.angle.first / 0.9).tanh() + 0.2 * moving.angle.first;
        let motor = 3.0 * (0.7 + moving.angle.first / 4.0);
        let wind = [moving.tip[0].first - 1.0, moving.tip[1].first - 2.0];
        let drag = wind.map(|w| -0.5 * 1.2 * 0.5 * 0.8 * wind[0].hypot(wind[1]) * w);
        let (s, c) = q[2].sin_cos();
        let thrust = [2.0 * c - 3.0 * s, 2.0 * s + 3.0 * c];

        let at = State { t: 0.0, q: PairCoordinates::from_array(q), v: PairCoordinates::from_array(v) };
        let forces = pair.forces(&at, &Default::default()).into_array();
        // friction forces and lever arms of size 10, twenty roundings
        let near = |what: &str, a: f64, b: f64| assert!((a - b).abs() < 1e-13, "{what}: {a} {b}");
        let mut powers = [0.0; 5];
        for (i, force) in forces.into_iter().enumerate() {
            let moved = places(along(std::array::from_fn(|j| f64::from(u8::from(i == j)))));
            let works = [
                -slide * moved.slide.first,
                -turn * moved.angle.first,
                -motor * moved.angle.first,
                drag[0] * moved.tip[0].first + drag[1] * moved.tip[1].first,
                thrust[0] * moved.mark[0].first + thrust[1] * moved.mark[1].first,
            ];
            near("Q", force, works.iter().sum());
            powers = std::array::from_fn(|k| powers[k] + works[k] * v[i]);
        }
        let none = Reactions { acceleration: at.q, multipliers: Default::default(), growth: 0.0 };
        let outputs = pair.outputs(&at, &Default::default(), &none);
        let measured = [outputs.sliding, outputs.turning, outputs.driving, outputs.blowing, outputs.pushing];
        for (ours, theirs) in measured.into_iter().zip(powers) {
            near("power", ours, theirs);
        }
        near("speed", outputs.fast, moving.tip[0].first.hypot(moving.tip[1].first));
    }
}

struct Places {
    tip: [Jet; 2],
    mark: [Jet; 2],
    /// How far the tip is along (3, 4)/5 on b.
    slide: Jet,
    /// φ_a − φ_b
    angle: Jet,
}

fn places([xa, ya, phia, xb, yb, phib]: [Jet; 6]) -> Places {
    use mbs_runtime::Real;
    let turned = |angle: Jet, x: f64, y: f64| {
        let (s, c) = angle.sin_cos();
        let (x, y) = (Jet::from_f64(x), Jet::from_f64(y));
        [x * c - y * s, x * s + y * c]
    };
    let ([tx, ty], [mx, my], [ux, uy]) =
        (turned(phia, 0.3, -0.2), turned(phib, 0.1, 0.4), turned(phib, 0.6, 0.8));
    let (tip, mark) = ([xa + tx, ya + ty], [xb + mx, yb + my]);
    let slide = ux * (tip[0] - mark[0]) + uy * (tip[1] - mark[1]);
    Places { tip, mark, slide, angle: phia - phib }
}
