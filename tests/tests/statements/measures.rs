//! Functions that measure a mechanism: powers balance energies, friction is that
//! of the very reactions that are reported, derivatives of points and signs of
//! reactions are those of rigid bodies.

use mbs_runtime::{Components, Error, Gains, Mechanism, Simulation, State, mechanism};
use tests::random::Random;

mechanism! {
    /// A slider-crank with every element: friction in its pins and its guide
    /// that depends on their reactions, a motor, springs, air, a driven rotor.
    Everything {
        dof = 1;
        param l1 = 60 [mm];
        param l2 = 180 [mm];
        param mu = 0.1;
        param stiffness = 200 [N/m];
        param free = 0.1 [m];
        input voltage [1];
        input push [N];
        gravity = (0, -9.81) [m/s^2];
        body crank  (x1, y1, theta1) { mass = 0.5 [kg]; inertia = 0.5 [kg]*l1^2/12; }
        body rod    (x2, y2, theta2) { mass = 1.2 [kg]; inertia = 1.2 [kg]*l2^2/12; }
        body slider (x3, y3, theta3) { mass = 2.0 [kg]; inertia = 1e-3 [kg*m^2]; }
        body rotor (phi) { mass = 0; inertia = 1e-3 [kg*m^2]; }
        point base on crank = (-l1/2, 0);
        point tip on crank = (l1/2, 0);
        point base on rod = (-l2/2, 0);
        point end on rod = (l2/2, 0);
        revolute bearing (ground, crank.base);
        revolute pin (crank.tip, rod.base);
        revolute wrist (rod.end, slider);
        prismatic guide (slider, ground) along (1, 0);
        drive spin: rotor.angle = 20 [rad/s]*t + 3 [rad/s^2]*t^2;

        torsion_spring coupling (rotor, crank) { damping = 0.02 [N*m*s]; }
        spring buffer (slider, ground) { stiffness = stiffness; length = free; damping = 3 [N*s/m]; }
        motor drive (crank, ground) { stall = 2 [N*m]; no_load = 100 [rpm]; level = voltage; }
        torsion_friction rub_bearing (ground, crank) {
            coefficient = mu; normal = reaction(bearing); radius = 8 [mm]; transition = 0.5 [rad/s];
        }
        torsion_friction rub_pin (crank, rod) {
            coefficient = mu; normal = reaction(pin); radius = 6 [mm]; transition = 0.5 [rad/s];
            viscous = 1e-3 [N*m*s];
        }
        friction rub_guide (slider, ground) along (1, 0) {
            coefficient = mu; normal = lambda(guide_normal); transition = 0.05 [m/s];
        }
        drag air on rod { density = 1.2 [kg/m^3]; area = 0.02 [m^2]; coefficient = 1; wind = (2, 0) [m/s]; }
        force pushed on slider = (push, 0);
        force thrust on rod.end in rod = (0, 2) [N];
        torque brake on crank = -0.01 [N*m*s]*der(theta1);
        force along on phi = 0.1 [N*m];
        start { theta1 = 30 [deg]; der(theta1) = 12 [rad/s]; guess x2 = l1; guess x3 = l1 + l2; }

        output change [W] = der(kinetic_energy() + potential_energy());
        let elastic = 0.5*stiffness*(length(buffer) - free)^2;
        output elastic_power [W] = der(elastic);
        output by_drive [W] = power(spin);
        output by_motor [W] = power(drive);
        output by_coupling [W] = power(coupling);
        output by_buffer [W] = power(buffer);
        output by_friction [W] = power(rub_bearing) + power(rub_pin) + power(rub_guide);
        output by_air [W] = power(air);
        output by_loads [W] = power(pushed) + power(thrust) + power(brake) + power(along);
        output by_joints [W] = power(bearing_x) + power(bearing_y) + power(pin_x) + power(pin_y)
            + power(wrist_x) + power(wrist_y) + power(guide_normal) + power(guide_angle);

        output of_bearing [N*m] = torque(rub_bearing);
        output of_pin [N*m] = torque(rub_pin);
        output of_guide [N] = force(rub_guide);
        output tension [N] = force(buffer);
        output tip_vx [m/s] = der(rod.end.x);
        output tip_ay [m/s^2] = der(der(rod.end.y));
        output tip_speed [m/s] = speed(crank.tip);
        output effort_of_spin [N*m] = effort(spin);
        output on_rod_x [N] = reaction(pin, rod).x;
        output on_rod_y [N] = reaction(pin, rod).y;
        output on_crank_x [N] = reaction(pin, crank).x;
        output on_slider [N] = reaction(guide, slider).y;
        output turning_slider [N*m] = reaction(guide, slider).torque;
        output in_pin [N] = reaction(pin);
        output transmission [deg] = transmission_angle(rod, slider);
    }
}

fn random_state(random: &mut Random) -> State<EverythingCoordinates<f64>> {
    let (q, v): ([f64; 10], [f64; 10]) = (random.around_zero(3.0), random.around_zero(5.0));
    State {
        t: random.between(0.0, 2.0),
        q: EverythingCoordinates::from_array(q),
        v: EverythingCoordinates::from_array(v),
    }
}

/// d/dt(T + V) is the power of everything that is not in V, in any state, even
/// one that violates the constraints: then they do work, too. Where friction
/// would jam, the solution is marked as lost, and is left out. All of it is the
/// equation of motion times the velocities, so good to rounding: sums of fifty
/// products, the largest of them given by the powers themselves.
#[test]
fn powers_balance_the_energy() {
    let everything = Everything::declared();
    let mut random = Random::new(21);
    let inputs = EverythingInputs { voltage: 0.8, push: 12.0 };
    let (mut worst, mut jammed) = (0.0_f64, 0);
    for _ in 0..500 {
        let at = random_state(&mut random);
        let solved = everything.accelerations(&at, &inputs);
        if solved.growth == f64::INFINITY {
            jammed += 1;
            continue;
        }
        let o = everything.outputs(&at, &inputs, &solved);
        let of_buffer = o.by_buffer + o.elastic_power;
        let powers = [
            o.by_drive,
            o.by_motor,
            o.by_coupling,
            of_buffer,
            o.by_friction,
            o.by_air,
            o.by_loads,
            o.by_joints,
        ];
        // what goes through the joints cancels: multipliers of 1e5 N times 5 m/s
        let scale = solved.multipliers.into_array().iter().map(|l| l.abs()).sum::<f64>() * 5.0
            + powers.iter().map(|p| p.abs()).sum::<f64>();
        let deviation = (o.change - powers.iter().sum::<f64>()).abs() / scale;
        worst = worst.max(deviation);
        assert!(deviation < 64.0 * f64::EPSILON, "{deviation:e} at {at:?}");
    }
    println!("energy balance: {worst:.1e}, {jammed} positions jam");
    assert!(jammed < 10, "friction of 0.1 seldom jams");
}

/// The friction in the forces is f(λ) with the λ that comes out: the residual of the fixed point, in every
/// state relative to the load.
#[test]
fn friction_is_that_of_the_reactions_it_causes() {
    let everything = Everything::declared();
    let mut random = Random::new(22);
    let inputs = EverythingInputs { voltage: -0.3, push: 4.0 };
    let mut worst = 0.0_f64;
    for _ in 0..500 {
        let at = random_state(&mut random);
        let solved = everything.accelerations(&at, &inputs);
        let o = everything.outputs(&at, &inputs, &solved);
        // Q holds the friction that was solved for; the rest of Q for the
        // slider's x is the push, the buffer and the thrust.
        let q = everything.forces(&at, &inputs).into_array();
        let without = Everything::new(EverythingParameters { mu: 0.0, ..Default::default() })
            .expect("mu = 0 is allowed");
        let rest = without.forces(&at, &inputs).into_array();
        let viscous = 1e-3 * (at.v.theta1 - at.v.theta2);
        let named = |name: &str| {
            let column = EverythingCoordinates::<f64>::NAMES.iter().position(|n| *n == name);
            column.map_or(f64::NAN, |column| q[column] - rest[column])
        };
        let loads = [solved.multipliers.guide_normal.abs(), o.in_pin, 1.0];
        let scale = loads.iter().fold(0.0, |a: f64, b| a.max(*b));
        let mut compare = |solved_for: f64, reported: f64| {
            let deviation = (solved_for - reported).abs() / scale;
            worst = worst.max(deviation);
            assert!(deviation < 1e-12, "{solved_for} {reported} {scale}");
        };
        compare(named("x3"), o.of_guide);
        compare(named("theta2"), -(o.of_pin + viscous));
        compare(named("theta1"), o.of_pin + viscous - o.of_bearing);
    }
    println!("residual of friction: {worst:.1e}");
}

/// All kernels solve with the same forces: with no feedback they give the same
/// accelerations to rounding.
#[test]
fn kernels_agree() {
    let everything = Everything::declared();
    let mut random = Random::new(23);
    let inputs = EverythingInputs { voltage: 1.0, push: 0.0 };
    for _ in 0..100 {
        let at = random_state(&mut random);
        let none = EverythingConstraints::splat(0.0);
        let gains = Gains { minus_two_alpha: 0.0, minus_beta_squared: 0.0 };
        let a = everything.stabilized(&at, &inputs, &gains).acceleration.into_array();
        let b = everything.constrained(&at, &inputs, &none).acceleration.into_array();
        let c = everything.reactions(&at, &inputs, &none).acceleration.into_array();
        let scale = a.iter().fold(1.0_f64, |scale, x| scale.max(x.abs()));
        for i in 0..a.len() {
            assert!((a[i] - b[i]).abs() <= 1e-13 * scale && (a[i] - c[i]).abs() <= 1e-13 * scale);
        }
    }
}

/// Along the motion: derivatives of outputs are those of the rigid bodies, and
/// forces of joints those of Newton's laws.
#[test]
fn points_and_reactions_are_those_of_rigid_bodies() -> Result<(), Error> {
    let mut run = Simulation::new(Everything::declared(), 1e-4)?;
    run.inputs_mut().voltage = 1.0;
    run.advance_to(0.05)?;
    let (q, v) = (run.state().q, run.state().v);
    let (a, o) = (run.reactions()?.acceleration, run.outputs()?);
    let near = |a: f64, b: f64, scale: f64| assert!((a - b).abs() <= 1e-13 * scale, "{a} {b}");
    let (s, c) = q.theta2.sin_cos();
    near(o.tip_vx, v.x2 - 0.09 * s * v.theta2, 10.0);
    near(o.tip_ay, a.y2 + 0.09 * (c * a.theta2 - s * v.theta2 * v.theta2), 1e3);
    let (sine, cosine) = q.theta1.sin_cos();
    let tip = (v.x1 - 0.03 * sine * v.theta1).hypot(v.y1 + 0.03 * cosine * v.theta1);
    near(o.tip_speed, tip, 1.0);
    near(o.by_drive, o.effort_of_spin * v.phi, 10.0);
    near(o.tension, 200.0 * (q.x3.hypot(q.y3) - 0.1) + 3.0 * v.x3, 100.0);
    // the rod's force balance: pin, wrist, gravity, thrust and air
    let f = run.reactions()?.multipliers;
    near(o.on_rod_x, f.pin_x, 100.0);
    near(o.on_crank_x, -f.pin_x, 100.0);
    let wind = (v.x2 - 2.0).hypot(v.y2);
    let (air_x, air_y) = (-0.012 * wind * (v.x2 - 2.0), -0.012 * wind * v.y2);
    near(o.on_rod_x - f.wrist_x + air_x - 2.0 * s, 1.2 * a.x2, 100.0);
    near(o.on_rod_y - f.wrist_y - 1.2 * 9.81 + air_y + 2.0 * c, 1.2 * a.y2, 100.0);
    near(f.wrist_y + o.on_slider - 2.0 * 9.81, 2.0 * a.y3, 100.0);
    near(o.turning_slider, 1e-3 * a.theta3, 1.0);
    near(o.in_pin, o.on_rod_x.hypot(o.on_rod_y), 100.0);
    let between = (q.theta2 - q.theta3).rem_euclid(std::f64::consts::PI);
    near(o.transmission, between.min(std::f64::consts::PI - between), 1.0);
    Ok(())
}

mechanism! {
    /// A weight on a line, whose length is a constraint, and a force.
    Line {
        dof = 1;
        gravity = (0, -9.81) [m/s^2];
        body bob (x, y) { mass = 2 [kg]; }
        point hook on ground = (0, 0.2 [m]);
        spring line (bob, ground.hook) { damping = 1 [N*s/m]; }
        constraint held: length(line) = 0.7 [m];
        force blown on bob = (3 [N/m]*length(line), 0);
        start { x = 0; guess y = -0.5 [m]; }
        output tension [N] = lambda(held);
        output blow [W] = power(blown);
        output reaction_of_line [N] = force(line);
    }
}

/// At rest below its hook: tension m g, acceleration 3 N/m · 0.7 m / 2 kg.
#[test]
fn length_of_a_spring_stands_anywhere() -> Result<(), Error> {
    let mut run = Simulation::new(Line::declared(), 1e-3)?;
    let (outputs, solved) = (run.outputs()?, run.reactions()?);
    assert!((outputs.tension - 2.0 * 9.81).abs() < 1e-13, "{}", outputs.tension);
    assert!((solved.acceleration.x - 1.05).abs() < 1e-14);
    assert_eq!(outputs.blow, 0.0);
    run.advance_to(0.1)?;
    let (outputs, v) = (run.outputs()?, run.state().v);
    // the length keeps to h³ times the third derivative, and its rate to h²
    assert!((outputs.blow - 2.1 * v.x).abs() < 1e-6 && outputs.reaction_of_line.abs() < 1e-4);
    Ok(())
}
