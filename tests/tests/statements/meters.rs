//! Meters of work: the energy balance of all forces between bodies, by states of the mechanism's own.

use mbs_runtime::{Adaptive, Dop853, Error, Tolerances, mechanism};

mechanism! {
    /// All forces between bodies, each with a meter of its work.
    Meters {
        dof = 6;
        param k = 60 [N/m];
        table pull(stretch) = [
            (-0.2 [m], -30 [N]), (0 [m], 0 [N]), (0.1 [m], 4 [N]), (0.5 [m], 60 [N])
        ] monotone outside extend;
        body a (x, y, phi) { mass = 2 [kg]; inertia = 0.3 [kg*m^2]; }
        body b (u, v, psi) { mass = 1 [kg]; inertia = 0.1 [kg*m^2]; }
        point p on a = (0.2 [m], 0.1 [m]);
        point q on b = (-0.3 [m], 0);
        point hook on ground = (0, 1 [m]);

        rope line (a.p, ground.hook) { stiffness = 200 [N/m]; length = 0.8 [m]; damping = 1 [N*s/m]; }
        strut post (b.q, ground) { stiffness = 300 [N/m]; length = 1 [m]; damping = 2 [N*s/m]; }
        bushing mount (a, b) {
            stiffness = (k, 2*k);
            damping = (1 [N*s/m], 0.5 [N*s/m]);
            torsion = 3 [N*m];
        }
        force law (a.p, b.q) = pull(length - 0.6 [m]) + 0.4 [N*s/m]*rate;
        torque turn (a, b) = -2 [N*m]*sin(angle) - 0.05 [N*m*s]*rate;
        spring loaded (b, ground.hook) { stiffness = k; length = 0.4 [m]; preload = 3 [N]; }
        torsion_spring wound (b, ground) { stiffness = 1 [N*m]; angle = 0.2; preload = 0.4 [N*m]; }
        potential well = 8 [J]*(1 - cos(phi)) + k*(x^2 + y^2)/2;
        dissipation oil = 0.2 [N*s/m]*(der(x)^2 + der(u)^2)/2;

        state of_line [J];     der(of_line) = power(line);
        state of_post [J];     der(of_post) = power(post);
        state of_mount [J];    der(of_mount) = power(mount);
        state of_law [J];      der(of_law) = power(law);
        state of_turn [J];     der(of_turn) = power(turn);
        state of_loaded [J];   der(of_loaded) = power(loaded);
        state of_wound [J];    der(of_wound) = power(wound);
        state of_well [J];     der(of_well) = power(well);
        state of_oil [J];      der(of_oil) = power(oil);
        start {
            x = 0.1 [m]; y = -0.2 [m]; phi = 0.3; u = 0.5 [m]; v = 0.2 [m]; psi = -0.4;
            der(x) = 1 [m/s]; der(psi) = 2 [rad/s];
        }
    }
}

/// Over 10 s the work of all forces is the change of the kinetic energy, to 1e-10 of the largest: some 2000 steps with an
/// error of 1e-12 each. What springs without dampers and potentials give, they have stored.
#[test]
fn forces_do_the_work_that_bodies_take() -> Result<(), Error> {
    let tolerances = Tolerances { rtol: 1e-12, atol: 1e-14, ..Tolerances::default() };
    let mut run = Adaptive::builder(Meters::declared()).scheme::<Dop853>().tolerances(tolerances).build()?;
    let kinetic = |run: &Adaptive<Meters, Dop853>| run.mechanism().kinetic_energy(&run.state());
    let before = kinetic(&run);
    let start = run.state();
    run.advance_to(10.0)?;
    let v = run.state().v;
    let works =
        [v.of_line, v.of_post, v.of_mount, v.of_law, v.of_turn, v.of_loaded, v.of_wound, v.of_well, v.of_oil];
    let largest = works.iter().fold(0.0_f64, |largest, work| largest.max(work.abs()));
    assert!(works.iter().all(|work| work.abs() > 5e-3 * largest), "{works:?}");
    let left = works.iter().sum::<f64>() - (kinetic(&run) - before);
    assert!(left.abs() < 1e-10 * largest, "{left} of {largest}");
    let well = |q: MetersCoordinates| 8.0 * (1.0 - q.phi.cos()) + 30.0 * (q.x * q.x + q.y * q.y);
    let loaded = |q: MetersCoordinates| {
        let s = q.u.hypot(q.v - 1.0) - 0.4;
        3.0 * s + 30.0 * s * s
    };
    let wound = |q: MetersCoordinates| (0.4 + 0.5 * (q.psi - 0.2)) * (q.psi - 0.2);
    let q = run.state().q;
    for (energy, work) in [
        (well(q) - well(start.q), v.of_well),
        (loaded(q) - loaded(start.q), v.of_loaded),
        (wound(q) - wound(start.q), v.of_wound),
    ] {
        assert!((energy + work).abs() < 1e-10 * largest, "{energy} {work}");
    }
    Ok(())
}
