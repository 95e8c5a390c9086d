//! Particles, and points whose places depend on coordinates: the same motion as bodies that are tied by constraints, and
//! as the equations of textbooks.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use mbs_runtime::{
    Adaptive, Components, Dop853, Held, Mechanism, NoComponents, Rk4, Simulation, State, Tolerances,
    mechanism,
};
use tests::random::Random;
use tests::solves_as_dense;

mechanism! {
    /// A weight on a spring, in polar coordinates.
    pub SwingingSpring {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        param m = 2 [kg];
        body arm (phi) { inertia = 0; }
        coordinate r [m];
        point end on arm = (r, 0);
        particle weight at arm.end { mass = m; }
        potential spring = 50 [N/m]*(r - 1 [m])^2;
        start { phi = 0.3; r = 1.2 [m]; }
    }
}

mechanism! {
    /// Two pendulums, one on the other, by their angles.
    pub Angles {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        coordinate a [rad];
        coordinate b [rad];
        point first on ground = (0.5 [m]*sin(a), -0.5 [m]*cos(a));
        point second on ground = (ground.first.x + 0.3 [m]*sin(b), ground.first.y - 0.3 [m]*cos(b));
        particle upper at ground.first { mass = 2 [kg]; }
        particle lower at ground.second { mass = 1 [kg]; }
        start { a = 1; b = 2; der(a) = 1 [rad/s]; }
        output x [m] = ground.second.x;
        output y [m] = ground.second.y;
    }
}

mechanism! {
    /// The same as two bodies on rods.
    pub Rods {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        body upper (x1, y1) { mass = 2 [kg]; }
        body lower (x2, y2) { mass = 1 [kg]; }
        distance first (upper, ground) = 0.5 [m];
        distance second (lower, upper) = 0.3 [m];
        start {
            x1 = 0.5 [m]*sin(1); guess y1 = -0.5 [m]*cos(1);
            x2 = 0.5 [m]*sin(1) + 0.3 [m]*sin(2); guess y2 = -0.5 [m]*cos(1) - 0.3 [m]*cos(2);
            der(x1) = 0.5 [m/s]*cos(1); der(x2) = 0.5 [m/s]*cos(1);
        }
        output x [m] = x2;
        output y [m] = y2;
    }
}

mechanism! {
    /// A plate of three particles, pushed at a corner and held at another.
    pub Lumps {
        dof = 2;
        body plate (x, y, phi) { mass = 0; inertia = 0; }
        point corner on plate = (0.3 [m], 0.1 [m]);
        for i in 1..=3 { point p[i] on plate = (0.2 [m]*(i - 2), 0.1 [m]*(i - 2)^2); }
        for i in 1..=3 { particle lump[i] at plate.p[i] { mass = 0.4 [kg]*i; } }
        spring s (plate.corner, ground) { length = 0; stiffness = 30 [N/m]; damping = 0.5 [N*s/m]; }
        force push on plate.corner = (1, 2) [N];
        point_on_line rail (plate.p_1, ground) along (1, 0);
        start { x = 0.2 [m]; phi = 0.4; der(phi) = 1 [rad/s]; guess y = -0.1 [m]; }
        output x_corner [m] = plate.corner.x;
        output y_corner [m] = plate.corner.y;
        output side [N] = lambda(rail);
    }
}

mechanism! {
    /// The same as a body, whose centre of mass is (1/15, 1/20 + 1/60) m from the origin of the plate above.
    pub Plate {
        dof = 2;
        const cx = 0.2 [m]/3;
        const cy = 0.2 [m]/3;
        body plate (x, y, phi) {
            mass = 2.4 [kg];
            inertia = 0.4 [kg]*((-0.2 [m] - cx)^2 + (0.1 [m] - cy)^2) + 0.8 [kg]*(cx^2 + cy^2)
                + 1.2 [kg]*((0.2 [m] - cx)^2 + (0.1 [m] - cy)^2);
        }
        point origin on plate = (-cx, -cy);
        point corner on plate = (0.3 [m] - cx, 0.1 [m] - cy);
        point p on plate = (-0.2 [m] - cx, 0.1 [m] - cy);
        spring s (plate.corner, ground) { length = 0; stiffness = 30 [N/m]; damping = 0.5 [N*s/m]; }
        force push on plate.corner = (1, 2) [N];
        point_on_line rail (plate.p, ground) along (1, 0);
        start {
            x = 0.2 [m] + cx*cos(0.4) - cy*sin(0.4); phi = 0.4; der(phi) = 1 [rad/s];
            der(x) = -(cx*sin(0.4) + cy*cos(0.4))*1 [rad/s]; guess y = 0;
        }
        output x_corner [m] = plate.corner.x;
        output y_corner [m] = plate.corner.y;
        output side [N] = lambda(rail);
    }
}

mechanism! {
    /// A rod that bends in two shapes, whose masses are coupled, between a pivot and a slide.
    pub Bending {
        dof = 3;
        gravity = (0, -9.81) [m/s^2];
        param l = 0.6 [m];
        param m = 0.3 [kg];
        body rod (x, y, phi) { mass = 0; inertia = 0; }
        body block (xb, yb) { mass = 0.5 [kg]; }
        coordinate w[1] [mm];
        coordinate w[2] [mm];
        for i in 1..=4 {
            const s[i] = (2*i - 1)/8;
            point p[i] on rod = (l*s[i] - 2*w[1]^2/l, 4*s[i]*(1 - s[i])*(w[1] + 2*(1 - 2*s[i])*w[2]));
            particle lump[i] at rod.p[i] { mass = m/4; }
        }
        point end on rod = (l - 4*w[1]^2/l, w[2]/4);
        revolute base (rod, ground);
        revolute wrist (rod.end, block);
        potential bending = 200 [N/m]*w[1]^2 + 900 [N/m]*w[2]^2;
        force slide on block = (-1 [N], -20 [N/m]*yb);
        start { phi = 0.1; w[1] = 20 [mm]; w[2] = 5 [mm]; der(w[2]) = 0.1 [m/s]; guess xb = 0.6 [m]; }
    }
}

mechanism! {
    /// A crane that pays out its rope by a drive, from a trolley that a spring holds.
    pub Hoist {
        dof = 2;
        gravity = (0, -9.81) [m/s^2];
        body trolley (x) { mass = 1 [kg]; }
        coordinate swing [rad];
        coordinate rope [m];
        point load on trolley = (rope*sin(swing), -rope*cos(swing));
        particle weight at trolley.load { mass = 3 [kg]; }
        spring s (trolley, ground) { length = 0; stiffness = 50 [N/m]; damping = 2 [N*s/m]; }
        drive winch: rope = 1 [m] + 0.2 [m]*sin(3 [1/s]*t);
        start { x = 0.1 [m]; swing = 0.2; guess rope = 1 [m]; }
        output pull [N] = effort(winch);
    }
}

/// A run to a tolerance of 1e-12.
fn precise<M: Mechanism<Real = f64>>(mechanism: M) -> Adaptive<M, Dop853> {
    let tolerances = Tolerances { rtol: 1e-12, atol: 1e-13, ..Default::default() };
    Adaptive::builder(mechanism).scheme::<Dop853>().tolerances(tolerances).build().expect("a start")
}

/// The largest difference of two runs' outputs over two seconds.
macro_rules! differ {
    ($first:ident, $second:ident, [$($output:ident),*]) => {{
        let (one, other) = ($first::declared(), $second::declared());
        let (mut first, mut second) = (precise(one), precise(other));
        let (mut largest, none): (f64, _) = (0.0, NoComponents::default());
        for k in 1..=20 {
            first.advance_to(0.1 * f64::from(k)).expect("a motion");
            second.advance_to(0.1 * f64::from(k)).expect("a motion");
            let (a, b) = (first.state(), second.state());
            let a = one.outputs(&a, &none, &one.accelerations(&a, &none));
            let b = other.outputs(&b, &none, &other.accelerations(&b, &none));
            $(largest = largest.max((a.$output - b.$output).abs());)*
        }
        largest
    }};
}

#[test]
fn accelerations_solve_the_dense_system() {
    solves_as_dense!(SwingingSpring, 200);
    solves_as_dense!(Angles, 200);
    solves_as_dense!(Lumps, 200);
    solves_as_dense!(Bending, 200);
    solves_as_dense!(Hoist, 200);
}

#[test]
fn a_swinging_spring_has_the_equations_of_polar_coordinates() {
    let mechanism = SwingingSpring::declared();
    let mut random = Random::new(3);
    for _ in 0..100 {
        let [phi, turning, r, speed] = [3.0, 2.0, 0.0, 2.0].map(|size| random.between(-size, size));
        let r = r + random.between(0.3, 2.0);
        let mut at = mechanism.declared_start();
        (at.q.phi, at.q.r, at.v.phi, at.v.r) = (phi, r, turning, speed);
        let found = mechanism.accelerations(&at, &NoComponents::default()).acceleration;
        let expected = [
            (-9.81 * phi.cos() - 2.0 * speed * turning) / r,
            r * turning * turning - 9.81 * phi.sin() - 50.0 * (r - 1.0),
        ];
        // a dozen roundings of terms of up to 200
        for (found, expected) in [found.phi, found.r].into_iter().zip(expected) {
            assert!((found - expected).abs() < 1e-12 * (1.0 + expected.abs()), "{found} {expected}");
        }
    }
}

#[test]
fn angles_give_the_motion_of_bodies_on_rods() {
    // the motion is chaotic: errors of 1e-11 grow about hundredfold in two seconds
    let largest = differ!(Angles, Rods, [x, y]);
    assert!(largest < 1e-8, "{largest:e}");
}

#[test]
fn a_plate_of_particles_is_a_body() {
    let largest = differ!(Lumps, Plate, [x_corner, y_corner, side]);
    assert!(largest < 1e-8, "{largest:e}");
}

#[test]
fn momentum_is_the_slope_of_the_kinetic_energy() {
    let mechanism = Bending::declared();
    let mut random = Random::new(11);
    for _ in 0..50 {
        let mut at = mechanism.declared_start();
        let (mut q, mut v) = (at.q.into_array(), at.v.into_array());
        q.iter_mut().chain(&mut v).for_each(|x| *x = random.between(-1.0, 1.0));
        (at.q, at.v) = (Components::from_array(q), Components::from_array(v));
        let (energy, mass) = (mechanism.kinetic_energy(&at), mechanism.mass(&at.q));
        let momentum = mechanism.kinetic_momentum(&at).into_array();
        let twice: f64 = momentum.iter().zip(&v).map(|(p, v)| p * v).sum();
        assert!((twice - 2.0 * energy).abs() < 1e-13 * (1.0 + energy), "{twice} {energy}");
        for (i, p) in momentum.iter().enumerate() {
            let product: f64 = v.iter().enumerate().map(|(j, v)| mass[(i, j)] * v).sum();
            assert!((product - p).abs() < 1e-13 * (1.0 + p.abs()), "{product} {p}");
        }
        assert_eq!(mass, mass.transpose());
    }
}

#[test]
fn a_particle_at_a_centre_is_mass_of_the_body() {
    mechanism! {
        Heavier {
            dof = 2;
            gravity = (0, -9.81) [m/s^2];
            body bob (x, y) { mass = 1 [kg]; }
            particle more at bob { mass = 0.5 [kg]; }
            force pull on bob = (3, 1) [N];
        }
    }
    let at = Heavier::declared().declared_start();
    let found = Heavier::declared().accelerations(&at, &NoComponents::default()).acceleration;
    assert_eq!(found.x, 2.0);
    assert!((found.y - (1.0 / 1.5 - 9.81)).abs() < 4.0 * f64::EPSILON * 9.81, "{}", found.y);
    assert_eq!(Heavier::declared().mass(&at.q)[(0, 1)], 0.0);
}

/// Its place is where formulas, forces and springs find it.
#[test]
fn the_name_of_a_particle_is_its_place() {
    mechanism! {
        Named {
            dof = 2;
            body arm (phi) { inertia = 0; }
            coordinate r [m];
            point end on arm = (r, 0);
            particle bob at arm.end { mass = 2 [kg]; }
            force pull on bob = (3, 4) [N];
            spring s (bob, ground) { stiffness = 5 [N/m]; length = 0; }
            start { r = 1 [m]; phi = 0; }
            output x [m] = bob.x;
            output speed [m/s] = speed(bob);
        }
    }
    let (mechanism, none) = (Named::declared(), NoComponents::default());
    let at = mechanism.declared_start();
    let reactions = mechanism.accelerations(&at, &none);
    assert_eq!([reactions.acceleration.r, reactions.acceleration.phi], [-1.0, 2.0]);
    let outputs = mechanism.outputs(&at, &none, &reactions);
    assert_eq!(outputs.x, 1.0);
    // the norm that has a slope at 0
    assert!(outputs.speed <= 1e-12, "{}", outputs.speed);
}

#[test]
fn energies_balance_the_work_over_ten_seconds() {
    let (mut run, mechanism) = (precise(Bending::declared()), Bending::declared());
    let energy = |state: &State<BendingCoordinates>| {
        mechanism.kinetic_energy(state) + mechanism.potential_energy(state)
    };
    let work = |state: &State<BendingCoordinates>| -state.q.xb - 10.0 * state.q.yb * state.q.yb;
    let before = energy(&run.state()) - work(&run.state());
    let mut largest: f64 = 0.0;
    for k in 1..=100 {
        run.advance_to(0.1 * f64::from(k)).expect("a motion");
        largest = largest.max((energy(&run.state()) - work(&run.state()) - before).abs());
    }
    assert!(largest < 1e-9, "{largest:e} J of some 3 J");
}

#[test]
fn a_winch_does_the_work_that_the_load_gets() {
    // of the free load M q̈ + Φ_qᵀλ = Q along the rope: the tension is m (r̈ − r φ̇² − g cos φ + ẍ sin φ)
    let mut run =
        Simulation::builder(Hoist::declared(), 1e-3).method::<Held<Rk4>>().build().expect("a start");
    for _ in 0..1000 {
        run.step().expect("a motion");
        let (state, reactions) = (run.state(), run.reactions().expect("reactions"));
        let (q, v, a) = (state.q, state.v, reactions.acceleration);
        let along = a.rope - q.rope * v.swing * v.swing + a.x * q.swing.sin() - 9.81 * q.swing.cos();
        let found = run.outputs().expect("outputs").pull;
        assert!((found - 3.0 * along).abs() < 1e-9, "{found} {along}");
    }
}
