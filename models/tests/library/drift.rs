//! Constraints and energy over a long run.

use mbs_runtime::{Components, Simulation};

use crate::Case;
use crate::model::Model;

pub const HEADING: &str = "\
mechanism            dof  step [s]  end [s]  max |Phi|          max |der(Phi)|     energy drift
                                             h        h/2       h        h/2       h        h/2";

/// As in the balance of forces: sums of a few terms.
const ROUNDINGS: f64 = 8.0;

/// One step in so many is asked for the size of its terms.
const SAMPLED: u64 = 500;

/// Largest values over a run.
struct Drift {
    phi: f64,
    phi_dot: f64,
    /// The largest change of the energy from its first value, over the largest kinetic energy; 0 for
    /// mechanisms without a degree of freedom, whose drives change it anyway.
    energy: f64,
    /// Bounds of what rounding alone leaves of each of the three.
    rounding: [f64; 3],
}

/// A step leaves an error of order h³ in the positions and, since the feedback
/// of the next one takes it out within h, of order h² in the velocities: the
/// violations do not add up. Halving the step divides them by 8 and 4; the next
/// terms of the expansion get an eighth of that. Heun's energy error is at least
/// of second order. Linear constraints have no such error: what they leave is of
/// the size of rounding with either step.
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
    let [phi, phi_dot, energy] = fine.rounding;
    for (what, coarse, fine, bound, ratio, rounding) in [
        ("constraints", coarse.phi, fine.phi, 1e-6, 8.0, phi),
        ("their rates", coarse.phi_dot, fine.phi_dot, f64::INFINITY, 4.0, phi_dot),
        ("energy", coarse.energy, fine.energy, 1e-2, 4.0, energy),
    ] {
        assert!(coarse <= bound, "{}, {what}: {coarse:e}", case.name);
        let is_small = fine <= f64::max(coarse / (0.875 * ratio), rounding);
        assert!(is_small, "{}, {what}: {coarse:e}, then {fine:e}, by rounding {rounding:e}", case.name);
    }
}

fn run<M: Model>(case: &Case<M>, h: f64) -> Drift {
    let parameters = case.without.iter().fold(*M::made().parameters(), |p, name| p.with(name, 0.0).unwrap());
    let mut simulation = Simulation::new(M::new(parameters).unwrap(), h).unwrap();
    let start = simulation.energy();
    let mut drift = Drift { phi: 0.0, phi_dot: 0.0, energy: 0.0, rounding: [0.0; 3] };
    let (mut kinetic, mut size) = (0.0_f64, 0.0_f64);
    let steps = simulation.steps_to(case.end).unwrap();
    for step in 0..steps {
        simulation.step().unwrap();
        drift.phi = drift.phi.max(simulation.violation());
        drift.phi_dot = drift.phi_dot.max(simulation.velocity_violation());
        drift.energy = drift.energy.max((simulation.energy() - start).abs());
        kinetic = kinetic.max(simulation.mechanism().kinetic_energy(&simulation.state()));
        if step % SAMPLED == 0 || step + 1 == steps {
            size = size.max(size_of_terms(&simulation));
        }
    }
    drift.energy = if M::INFO.dof == 0 { 0.0 } else { drift.energy / kinetic };
    // Φ = 0 holds to the rounding of its terms, and the feedback takes that out
    // within a step, at a rate of Φ/h. A step rounds kinetic and potential
    // energy, the second of which is at most |E| + T.
    let phi = ROUNDINGS * f64::EPSILON * size;
    let energy = f64::EPSILON * steps as f64 * (start.abs() + 2.0 * kinetic) / kinetic;
    drift.rounding = [phi, phi / h, energy];
    drift
}

/// Σ |Φ_q| |q|, of all constraints.
fn size_of_terms<M: Model>(simulation: &Simulation<M>) -> f64 {
    let state = simulation.state();
    let rows = simulation.mechanism().jacobian(state.t, &state.q);
    let q = state.q.into_array();
    let terms = rows.iter().flat_map(|row| row.iter().zip(q.as_ref()));
    terms.map(|(slope, q)| (slope * q).abs()).sum()
}
