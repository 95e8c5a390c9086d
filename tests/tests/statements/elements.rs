//! Force elements against closed-form answers, a motor's run-up and a fall
//! through air, and against the virtual work of their forces.

use mbs_runtime::{
    Adaptive, Components, Dop853, Error, Mechanism, Reactions, Sampled, Simulation, State, System,
    Tolerances, mechanism,
};
use tests::jet::{Jet, first, line};
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

/// ω(t) = u ω₀ (1 − e^{−t/τ}), τ = J ω₀/T_stall. Heun's error for a decay
/// is (h/τ)² t/(6τ) of u ω₀, which the bound exceeds sixfold.
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

/// Properties are checked for the parameters that a program passes in.
#[test]
fn motor_without_a_no_load_speed_does_not_exist() {
    let refused = RunUp::new(RunUpParameters { no_load: 0.0, ..RunUpParameters::default() });
    let Err(Error::Parameter { name, value, .. }) = refused else { panic!("{refused:?}") };
    assert_eq!((name, value), ("no_load of drive", 0.0));
    assert!(RunUp::new(RunUpParameters { stall: 0.0, ..RunUpParameters::default() }).is_ok());
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
        let along = |direction: [f64; 6]| std::array::from_fn(|i| line(q[i], direction[i]));
        let moving = places(along(v));
        let slide = 0.3 * 5.0 * (first(moving.slide) / 0.7).tanh() + 0.6 * first(moving.slide);
        let turn = 2.0 * (first(moving.angle) / 0.9).tanh() + 0.2 * first(moving.angle);
        let motor = 3.0 * (0.7 + first(moving.angle) / 4.0);
        let wind = [first(moving.tip[0]) - 1.0, first(moving.tip[1]) - 2.0];
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
                -slide * first(moved.slide),
                -turn * first(moved.angle),
                -motor * first(moved.angle),
                drag[0] * first(moved.tip[0]) + drag[1] * first(moved.tip[1]),
                thrust[0] * first(moved.mark[0]) + thrust[1] * first(moved.mark[1]),
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
        near("speed", outputs.fast, first(moving.tip[0]).hypot(first(moving.tip[1])));
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

mechanism! {
    /// A mass on a spring without a free length, and the same force by its components.
    Isotropic {
        dof = 4;
        param k = 4 [N/m];
        param c = 0.3 [N*s/m];
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 1 [kg]; }
        spring coil (bob, ground) { stiffness = k; length = 0; damping = c; }
        body twin (xt, yt) { mass = 1 [kg]; }
        force pull on twin = (-k*xt, -k*yt - c*der(yt));
        start { x = 0; y = 0; }
        output tension [N] = force(coil);
        output loss [W] = power(coil) + der(k*distance(bob, ground)^2)/2;
    }
}

/// A spring whose free length is 0 pulls with −k r, also where its places coincide, and so is it damped.
#[test]
fn spring_without_length_is_regular_where_its_places_coincide() -> Result<(), Error> {
    let h = 1e-3;
    for c in [0.0_f64, 0.3] {
        let parameters = IsotropicParameters { c, ..Default::default() };
        let mut run = Simulation::new(Isotropic::new(parameters)?, h)?;
        assert_eq!(run.outputs()?.tension, 0.0);
        for _ in 0..2000 {
            run.step()?;
            let (state, found) = (run.state(), run.outputs()?);
            let (y, v) = (state.q.y, state.v.y);
            assert!((y - state.q.yt).abs() <= 1e-13, "{y} {}", state.q.yt);
            assert!((found.tension - (4.0 * y.abs() + c * v * y.signum())).abs() < 1e-9);
            assert!((found.loss + c * v * v).abs() < 1e-9);
        }
        let energy = run.mechanism().potential_energy(&run.state());
        let (y, yt) = (run.state().q.y, run.state().q.yt);
        assert!((energy - (2.0 * y * y + 9.81 * (y + yt))).abs() < 1e-12);
    }
    Ok(())
}

mechanism! {
    /// Two bodies apart, with a spring and a torsion spring, and with laws that say the same.
    Springs {
        dof = 12;
        param k = 40 [N/m];
        const c = 0.7 [N*s/m];
        const kt = 3 [N*m];
        const ct = 0.2 [N*m*s];
        body a (x1, y1, p1) { mass = 1 [kg]; inertia = 0.3 [kg*m^2]; }
        body b (x2, y2, p2) { mass = 2 [kg]; inertia = 0.5 [kg*m^2]; }
        body d (x3, y3, p3) { mass = 1 [kg]; inertia = 0.3 [kg*m^2]; }
        body e (x4, y4, p4) { mass = 2 [kg]; inertia = 0.5 [kg*m^2]; }
        point tip on b = (0.2 [m], 0.1 [m]);
        point tip on e = (0.2 [m], 0.1 [m]);
        spring pull (a, b.tip) { stiffness = k; length = 0.4 [m]; damping = c; }
        torsion_spring turn (a, b) { stiffness = kt; angle = 0.1; damping = ct; }
        force law (d, e.tip) = k*(length - 0.4 [m]) + c*rate;
        torque twist (d, e) = -kt*(angle - 0.1) - ct*rate;
        start {
            x2 = 1 [m]; der(y2) = 1 [m/s]; p1 = 0.5; der(p2) = -1 [rad/s];
            x4 = 1 [m]; der(y4) = 1 [m/s]; p3 = 0.5; der(p4) = -1 [rad/s];
        }
        output tension [N] = force(pull) - force(law);
        output moment [N*m] = torque(turn) - torque(twist);
        output lost [W] = power(law) + power(twist) - der(kinetic_energy())/2;
        output apart [m] = length(pull) - length(law);
    }
}

/// A law is what it says: a spring with a damper in other words moves as a spring.
#[test]
fn a_law_is_a_spring_in_other_words() -> Result<(), Error> {
    let mut run = Simulation::new(Springs::declared(), 1e-3)?;
    for _ in 0..20 {
        run.advance_to(run.time() + 0.1)?;
        let state = run.state();
        for numbers in [state.q.into_array(), state.v.into_array()] {
            let (springs, laws) = numbers.split_at(6);
            // terms may be added in another order: a rounding of 5 for each of 2000 steps
            let bound = 2000.0 * 5.0 * f64::EPSILON;
            assert!(springs.iter().zip(laws).all(|(a, b)| (a - b).abs() < bound), "{springs:?} {laws:?}");
        }
        let outputs = run.outputs()?;
        let differences = [outputs.tension, outputs.moment, outputs.apart];
        // forces of stiffness 40 N/m follow positions
        let bound = 40.0 * 2000.0 * 5.0 * f64::EPSILON;
        assert!(differences.iter().all(|it| it.abs() < bound), "{differences:?}");
        // both pairs have the same power: speeds of 10 m/s
        assert!(outputs.lost.abs() < 10.0 * bound, "{}", outputs.lost);
    }
    Ok(())
}

mechanism! {
    /// Two plates on a bushing between their corners, free in the plane.
    Bushed {
        dof = 6;
        param torsion_damping = 0 [N*m*s];
        body a (x1, y1, p1) { mass = 1 [kg]; inertia = 0.3 [kg*m^2]; }
        body b (x2, y2, p2) { mass = 2 [kg]; inertia = 0.5 [kg*m^2]; }
        point tip on a = (-0.3 [m], 0);
        point tip on b = (0.2 [m], 0.1 [m]);
        bushing eye (a.tip, b.tip) {
            stiffness = (100, 300) [N/m]; torsion = 3 [N*m]; angle = 10 [deg];
            torsion_damping = torsion_damping;
        }
        start { x1 = 0.4 [m]; x2 = -0.2 [m]; y2 = 0.1 [m]; der(p1) = 2 [rad/s]; der(y2) = 1 [m/s]; }
        output momentum_x [kg*m/s] = 1 [kg]*der(x1) + 2 [kg]*der(x2);
        output momentum_y [kg*m/s] = 1 [kg]*der(y1) + 2 [kg]*der(y2);
        output spin [kg*m^2/s] = 1 [kg]*(x1*der(y1) - y1*der(x1)) + 0.3 [kg*m^2]*der(p1)
            + 2 [kg]*(x2*der(y2) - y2*der(x2)) + 0.5 [kg*m^2]*der(p2);
        output energy [J] = kinetic_energy() + potential_energy();
        output lost [W] = der(kinetic_energy()) - power(eye);
        output size [N] = force(eye);
    }
}

/// Forces within a pair keep its momenta about any place, and without dampers its energy, although they stand in the axes
/// of the second body, which turns under them.
#[test]
fn a_bushing_keeps_momenta_and_energy() -> Result<(), Error> {
    let fine = Tolerances { rtol: 1e-10, atol: 1e-12, ..Tolerances::default() };
    let run = Adaptive::builder(Bushed::declared()).scheme::<Dop853>().tolerances(fine).build()?;
    let mut samples = Sampled::new(run, 0.1)?;
    let mut first = None;
    for _ in 0..50 {
        samples.step()?;
        let outputs = outputs(&samples)?;
        let [.., lost, size] = outputs;
        let kept: [f64; 4] = [outputs[0], outputs[1], outputs[2], outputs[3]];
        let before = *first.get_or_insert(kept);
        for (kept, before) in kept.into_iter().zip(before) {
            assert!((kept - before).abs() < 1e-8, "{kept} {before}");
        }
        assert!(lost.abs() < 1e-12 && size >= 0.0, "{lost} {size}");
    }
    Ok(())
}

fn outputs<S: System>(run: &S) -> Result<[f64; 6], Error> {
    let (mut a, mut outputs) = ([0.0; 6], [0.0; 6]);
    run.reactions(&mut a, &mut [])?;
    run.outputs(&a, &[], &mut outputs)?;
    Ok(outputs)
}

mechanism! {
    /// A rope and a strut, and laws that say the same, each on a ball that bounces within it.
    Sided {
        dof = 4;
        param k = 200 [N/m];
        param c = 3 [N*s/m];
        const l = 0.5 [m];
        body hung (x = a) { mass = 1 [kg]; }
        body tied (x = b) { mass = 1 [kg]; }
        body held (x = d) { mass = 1 [kg]; }
        body borne (x = e) { mass = 1 [kg]; }
        force one on hung = (-3 [N]*sin(a/(1 [m])), 0);
        force two on tied = (-3 [N]*sin(b/(1 [m])), 0);
        point hook on ground = (0, 0.2 [m]);
        rope r (hung, ground.hook) { stiffness = k; length = l; damping = c; }
        force rope_by_law (tied, ground.hook) = if length > l { max(0, k*(length - l) + c*rate) } else { 0 };
        strut s (held, ground.hook) { stiffness = k; length = l; damping = c; }
        force strut_by_law (borne, ground.hook) = if length < l { -max(0, k*(l - length) - c*rate) } else { 0 };
        start {
            a = 0.1 [m]; b = 0.1 [m]; der(a) = 3 [m/s]; der(b) = 3 [m/s];
            d = 1 [m]; e = 1 [m]; der(d) = -3 [m/s]; der(e) = -3 [m/s];
        }
        output pull [N] = force(r);
        output push [N] = force(s);
        output by_laws [N] = force(r) - force(rope_by_law) + force(s) - force(strut_by_law);
        output lost [W] = der(kinetic_energy()) - power(r) - power(s) - power(rope_by_law) - power(strut_by_law)
            - power(one) - power(two);
    }
}

/// A rope never pushes and a strut never pulls; both are what laws say in other words, to the rounding of steps.
#[test]
fn ropes_and_struts_act_on_one_side() -> Result<(), Error> {
    let mut run = Simulation::new(Sided::declared(), 1e-3)?;
    let (mut pulled, mut pushed, mut slack) = (0.0_f64, 0.0_f64, 0);
    for _ in 0..3000 {
        run.advance_to(run.time() + 1e-3)?;
        let SidedOutputs { pull, push, by_laws, lost } = run.outputs()?;
        // sums of four forces up to 100 N, of powers up to 1 kW
        assert!(pull >= 0.0 && push <= 0.0 && by_laws.abs() < 1e-9 && lost.abs() < 1e-9, "{by_laws} {lost}");
        (pulled, pushed) = (pulled.max(pull), pushed.min(push));
        slack += u32::from(pull == 0.0 && push == 0.0);
    }
    assert!(pulled > 10.0 && pushed < -10.0 && slack > 100, "{pulled} {pushed} {slack}");
    Ok(())
}
