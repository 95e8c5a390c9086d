//! Over ten seconds every force does the work by which the kinetic energy changes: elements of one side, bearings, laws of
//! one's own, tables, potentials, dissipations, weights of particles. Weights are told by heights.

use mbs_runtime::{Adaptive, Dop853, Error, Mechanism, Tolerances, mechanism};

mechanism! {
    /// Two plates that nothing holds but forces, one with a weight that slides on it.
    Balance {
        dof = 7;
        gravity = (0, -9.81) [m/s^2];
        body a (x1, y1, p1) { mass = 2 [kg]; inertia = 0.05 [kg*m^2]; }
        body b (x2, y2, p2) { mass = 1 [kg]; inertia = 0.02 [kg*m^2]; }
        coordinate slide [m];
        point hook on a = (0.2 [m], 0.1 [m]);
        point eye on a = (-0.2 [m], 0);
        point eye on b = (0.1 [m], 0.05 [m]);
        point nose on b = (-0.1 [m], 0);
        point top on ground = (0.3 [m], 1 [m]);
        point floor on ground = (-0.2 [m], -1.2 [m]);
        point rider on a = (slide, 0.3 [1/m]*slide^2);
        particle weight at a.rider { mass = 0.4 [kg]; }

        table progressive(stretch) = [(0 [m], 0 [N]), (0.2 [m], 10 [N]), (0.4 [m], 40 [N]), (0.6 [m], 100 [N])]
            monotone outside extend;

        rope r (a.hook, ground.top) { stiffness = 300 [N/m]; length = 0.9 [m]; damping = 2 [N*s/m]; }
        strut s (b.nose, ground.floor) { stiffness = 200 [N/m]; length = 0.9 [m]; damping = 1 [N*s/m]; }
        bushing c (b.eye, a.eye) {
            stiffness = (400 [N/m], 250 [N/m]); damping = (1 [N*s/m], 2 [N*s/m]);
            torsion = 3 [N*m]; torsion_damping = 0.02 [N*m*s]; angle = 10 [deg];
        }
        spring stretched (a.eye, ground.floor) { stiffness = 20 [N/m]; length = 1 [m]; preload = 3 [N]; }
        torsion_spring wound (b, ground) { stiffness = 0.5 [N*m]; angle = 0; preload = 0.1 [N*m]; damping = 0.01 [N*m*s]; }
        force law (b.nose, ground.top) = progressive(length) + 0.5 [N*s/m]*rate;
        torque clutch (a, b) = -0.2 [N*m]*sin(angle) - 0.01 [N*m*s]*rate;
        potential field = 4 [N/m]*x1^2 + 1 [N]*x2;
        dissipation oil = 0.3 [N*s/m]*der(x1)*der(x2) + 0.4 [N*s/m]*(der(x1)^2 + der(x2)^2);
        force held on slide = -60 [N/m]*slide - 0.2 [N*s/m]*der(slide);
        force wind on b = (2 [N]*sin(3 [1/s]*t), 0);

        let by_springs = power(r) + power(s) + power(c) + power(stretched) + power(wound);
        let by_laws = power(law) + power(clutch) + power(field) + power(oil) + power(held) + power(wind);
        state work [J] = 0;
        der(work) = by_springs + by_laws;
        start { x1 = 0.1 [m]; y1 = 0.1 [m]; x2 = -0.1 [m]; p2 = 0.2; der(p1) = 2 [rad/s]; slide = 0.1 [m]; }
        output kinetic [J] = kinetic_energy();
        output height [J] = 9.81 [m/s^2]*(2 [kg]*y1 + 1 [kg]*y2 + 0.4 [kg]*weight.y);
    }
}

#[test]
fn work_is_the_change_of_energy() -> Result<(), Error> {
    let (mechanism, tolerances) =
        (Balance::declared(), Tolerances { rtol: 1e-13, atol: 1e-14, ..Tolerances::default() });
    let mut run = Adaptive::builder(mechanism).scheme::<Dop853>().tolerances(tolerances).build()?;
    let none = Default::default();
    let (mut first, mut off, mut largest) = (None, 0.0_f64, 0.0_f64);
    for k in 0..=200 {
        run.advance_to(0.05 * f64::from(k))?;
        let state = run.state();
        let outputs = mechanism.outputs(&state, &none, &mechanism.accelerations(&state, &none));
        let energy = outputs.kinetic + outputs.height;
        let balance = energy - state.v.work;
        off = off.max((balance - *first.get_or_insert(balance)).abs());
        largest = largest.max(outputs.kinetic).max(state.v.work.abs());
    }
    assert!(off < 1e-9 * largest, "{off:e} J of {largest} J");
    // it has moved
    assert!(largest > 10.0, "{largest} J");
    Ok(())
}
