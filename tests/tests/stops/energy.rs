//! Energy in impacts with constant steps.

use mbs_runtime::{Error, Held, Mechanism, Simulation, mechanism};

mechanism! {
    /// A light ball between the floor and a heavy one that falls: both impacts are in one step.
    Squeezed {
        dof = 2;
        body a (y = ya) { mass = 1 [kg]; }
        body b (y = yb) { mass = 1e6 [kg]; }
        stop floor: ya >= 0 [m] { restitution = 0.9; }
        stop between: yb - ya >= 0 [m] { restitution = 0.9; }
        start { ya = 0.2 [mm]; der(ya) = 10 [m/s]; yb = 0.4 [mm]; der(yb) = -1 [m/s]; }
    }
}

mechanism! {
    /// A rod that turns between stops of a curved gap.
    Turning {
        dof = 1;
        body rod (angle = phi) { inertia = 1 [kg*m^2]; }
        stop low: sin(phi) >= 0.2 { restitution = 1; }
        stop high: sin(phi) <= 0.8 { restitution = 1; }
        start { phi = 30 [deg]; der(phi) = 5 [rad/s]; }
    }
}

mechanism! {
    /// A rod on a pin between two walls: joints turn with it, as gaps do.
    Walls {
        dof = 1;
        body rod (x, y, phi) { mass = 1 [kg]; inertia = 0.1 [kg*m^2]; }
        point hook on rod = (-0.5, 0) [m];
        point tip on rod = (0.5, 0) [m];
        revolute pin (rod.hook, ground);
        stop left: rod.tip.x >= 0.2 [m] { restitution = 1; }
        stop right: rod.tip.x <= 0.8 [m] { restitution = 1; }
        start { phi = 60 [deg]; der(phi) = 5 [rad/s]; guess x = 0.25 [m]; guess y = 0.4 [m]; }
    }
}

mechanism! {
    /// A bead that is pressed on the outside of a ring, and slides along it.
    Ring {
        dof = 2;
        body bead (x, y) { mass = 1 [kg]; }
        stop ring: sqrt(x^2 + y^2) >= 1 [m] { restitution = 0; }
        force pull on bead = (-50 [N/m]*x, -50 [N/m]*y);
        start { x = 0; y = 1 [m]; der(x) = 5 [m/s]; }
    }
}

/// The kinetic energy at the start, and the largest and the last one of a run.
fn energies<M: Mechanism<Real = f64>>(
    run: &mut Simulation<M, Held<M::Scheme>>,
    steps: u64,
) -> Result<[f64; 3], Error> {
    let energy =
        |run: &Simulation<M, Held<M::Scheme>>| Mechanism::kinetic_energy(run.mechanism(), &run.state());
    let begin = energy(run);
    let mut largest = begin;
    for _ in 0..steps {
        run.step()?;
        largest = largest.max(energy(run));
    }
    Ok([begin, largest, energy(run)])
}

/// Where one impact makes another gap close within the step, the next impact follows. Answered at once, with a stop that had
/// been opening, they gave a hundred times the energy.
#[test]
fn impacts_in_one_step_follow_each_other() -> Result<(), Error> {
    for h in [1e-3, 1e-4, 1e-5] {
        let [begin, largest, _] = energies(&mut Simulation::new(Squeezed::declared(), h)?, 200)?;
        assert!(largest <= begin * (1.0 + 1e-12), "{h}: {begin} {largest}");
    }
    Ok(())
}

/// The velocities of the start are measured by the gap's gradient at the end. Measured by that at the start, each impact
/// gave energy.
#[test]
fn a_gradient_that_turns_gives_no_energy() -> Result<(), Error> {
    for h in [1e-3, 4e-3] {
        let [begin, largest, end] =
            energies(&mut Simulation::new(Turning::declared(), h)?, (20.0 / h) as u64)?;
        assert!(
            largest <= begin * (1.0 + 1e-12) && end >= begin * (1.0 - 1e-12),
            "{h}: {begin} {largest} {end}"
        );
    }
    Ok(())
}

/// The velocities of the start are led to the joints at the end. What is left of their turning is of the square of the
/// step, and takes energy.
#[test]
fn joints_that_turn_give_no_energy() -> Result<(), Error> {
    let [begin, largest, end] = energies(&mut Simulation::new(Walls::declared(), 1e-3)?, 40_000)?;
    // some 130 impacts, each of 4 (ω h)² at most
    let each = 4.0 * (5.0_f64 * 1e-3).powi(2);
    assert!(largest <= begin * (1.0 + each) && end > begin * (1.0 - 130.0 * each), "{begin} {largest} {end}");
    Ok(())
}

/// Half of a rest's force acts before a step and half behind, so that what slides keeps its speed to second order.
#[test]
fn what_slides_on_a_curve_keeps_its_speed() -> Result<(), Error> {
    let lost = [2e-3, 1e-3].map(|h| {
        let mut run = Simulation::new(Ring::declared(), h)?;
        let [begin, _, end] = energies(&mut run, (10.0 / h) as u64)?;
        assert_eq!(run.inputs().ring, 1.0);
        Ok::<f64, Error>((end - begin).abs() / begin)
    });
    let [coarse, fine] = lost;
    let (coarse, fine) = (coarse?, fine?);
    assert!(coarse < 1e-3 && fine < 0.4 * coarse, "{coarse:e} {fine:e}");
    Ok(())
}
