//! Constraints and energy over a long run.

use mbs_runtime::{Components, Simulation};

use crate::Case;
use crate::model::Model;

pub const HEADING: &str = "\
mechanism            dof  step [s]  end [s]  max |Phi|          max |der(Phi)|     energy drift
                                             h        h/2       h        h/2       h        h/2";

/// Largest values over a run.
struct Drift {
    phi: f64,
    phi_dot: f64,
    /// Of the energy from its first value, over the largest kinetic energy;
    /// 0 where a drive or a damper changes it anyway.
    energy: f64,
}

/// A step leaves an error of order h³ in the positions and, since the feedback
/// of the next one takes it out within h, of order h² in the velocities: the
/// violations do not add up. Halving the step divides them by 8 and 4; the next
/// terms of the expansion get an eighth of that. Heun's energy error is at least
/// of second order.
///
/// The bounds themselves are what a user may take for closed and conserved: a
/// micrometre, and a hundredth of the largest kinetic energy.
pub fn check<M: Model>(case: &Case<M>) {
    let [coarse, fine] = [case.step, case.step / 2.0].map(|h| run::<M>(case, h));
    let pair = |a: f64, b: f64| {
        if a == 0.0 { "–        –      ".to_owned() } else { format!("{a:.1e}  {b:.1e}") }
    };
    println!(
        "{:20} {:3}  {:8.0e}  {:7}  {}   {}   {}",
        case.name,
        M::INFO.dof,
        case.step,
        case.end,
        pair(coarse.phi, fine.phi),
        pair(coarse.phi_dot, fine.phi_dot),
        pair(coarse.energy, fine.energy)
    );
    for (what, coarse, fine, bound, ratio) in [
        ("constraints", coarse.phi, fine.phi, 1e-6, 8.0),
        ("their rates", coarse.phi_dot, fine.phi_dot, f64::INFINITY, 4.0),
        ("energy", coarse.energy, fine.energy, 1e-2, 4.0),
    ] {
        assert!(coarse <= bound, "{}, {what}: {coarse:e}", case.name);
        assert!(fine <= coarse / (0.875 * ratio), "{}, {what}: {coarse:e}, then {fine:e}", case.name);
    }
}

fn run<M: Model>(case: &Case<M>, h: f64) -> Drift {
    let parameters = case.without.iter().fold(*M::made().parameters(), |p, name| p.with(name, 0.0).unwrap());
    let mut simulation = Simulation::new(M::new(parameters).unwrap(), h).unwrap();
    let start = simulation.energy();
    let mut drift = Drift { phi: 0.0, phi_dot: 0.0, energy: 0.0 };
    let mut kinetic = 0.0_f64;
    for _ in 0..simulation.steps_to(case.end).unwrap() {
        simulation.step().unwrap();
        drift.phi = drift.phi.max(simulation.violation());
        drift.phi_dot = drift.phi_dot.max(simulation.velocity_violation());
        drift.energy = drift.energy.max((simulation.energy() - start).abs());
        kinetic = kinetic.max(simulation.mechanism().kinetic_energy(simulation.state()));
    }
    drift.energy = if M::INFO.dof == 0 { 0.0 } else { drift.energy / kinetic };
    drift
}
