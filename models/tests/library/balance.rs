//! Forces, moments and power at single states.
//!
//! The states lie along the motion, each coordinate then moved by up to 2 % of
//! the mechanism's size and each velocity chosen at random: they satisfy neither
//! Φ = 0 nor Φ̇ = 0, which the equations do not ask for.

use mbs_runtime::{Components, Dimension, Kinematics, Mechanism, Reactions, Simulation, State};

use crate::Case;
use crate::model::Model;
use crate::random::Random;

const STATES: usize = 40;

/// Residuals in units of ε times the sum of the magnitudes of the terms. Sums of
/// up to 22 terms are off by a few such units, and elimination by positive
/// pivots of the mass block is backward stable.
const ROUNDINGS: f64 = 8.0;

/// The accelerations satisfy the constraints to that, times the growth of the
/// pivots that the elimination itself reports.
const ROUNDINGS_TIMES_GROWTH: f64 = 32.0;

type At<M> = State<<M as Mechanism>::Coordinates>;

/// M q̈ + Φ_qᵀ λ = Q and Φ_q q̈ = γ.
pub fn reactions<M: Model>(case: &Case<M>) {
    let mut worst = [0.0_f64; 2];
    for_each_state(case, |mechanism, at, inputs, solved| {
        let (a, lambda) = (solved.acceleration.into_array(), solved.multipliers.into_array());
        let (a, lambda) = (a.as_ref(), lambda.as_ref());
        let jacobian = mechanism.jacobian(at.t, &at.q);

        let forces = mechanism.forces(at, inputs);
        let mut motion = Balance::default();
        // accelerations by each force alone: where forces nearly cancel, and no
        // γ is left beside, the accelerations have the rounding of these
        let mut singly = vec![0.0; a.len()];
        for (i, row) in mechanism.mass(&at.q).iter().enumerate() {
            let inertia = row.iter().zip(a).map(|(m, a)| m * a);
            let reaction = jacobian.iter().zip(lambda).map(|(row, l)| row[i] * l);
            if row[i] > 0.0 {
                let sum: f64 = reaction.clone().map(f64::abs).sum();
                singly[i] = (sum + forces[i].abs()) / row[i];
            }
            motion.add(inertia.chain(reaction).chain([-forces[i]]));
        }
        let mut constraints = Balance::default();
        for (row, gamma) in jacobian.iter().zip(mechanism.gamma(at)) {
            constraints.add(row.iter().zip(a).map(|(j, a)| j * a).chain([-gamma]));
            if gamma == 0.0 {
                let size = row.iter().zip(&singly).map(|(j, a)| (j * a).abs()).sum();
                constraints.size = constraints.size.max(size);
            }
        }
        worst[0] = worst[0].max(motion.roundings());
        worst[1] = worst[1].max(constraints.roundings() / solved.growth.max(1.0));
    });
    let [forces, constraints] = worst;
    println!("{}: forces {forces:.1}, constraints {constraints:.1} roundings", case.name);
    assert!(forces < ROUNDINGS, "{}: forces {forces}", case.name);
    assert!(constraints < ROUNDINGS_TIMES_GROWTH, "{}: constraints {constraints}", case.name);
}

/// 2T = pᵀv, and dE/dt = λᵀ(Φ_t − Φ̇) + power of inputs and dampers.
///
/// It is vᵀ times the equations of motion: vᵀΦ_qᵀ λ = λᵀ(Φ̇ − Φ_t). On the
/// constraints λᵀΦ_t is left, the power of the drives.
pub fn power<M: Model>(case: &Case<M>) {
    let mut worst = 0.0_f64;
    for_each_state(case, |mechanism, at, inputs, solved| {
        let lambda = solved.multipliers.into_array();
        let phi_dot = mechanism.phi_dot(at).into_array();
        let phi_t = mechanism.phi_t(at.t, &at.q);
        let rates = mechanism.energy_rates(at, &solved.acceleration);
        let applied = (case.power)(mechanism.parameters(), at, inputs);
        let mut balance = Balance::default();
        let v = at.v.into_array();
        let mut kinetic = Balance::default();
        let parts = mechanism.momentum(at).into_iter().zip(v.as_ref()).map(|(p, v)| p * v);
        kinetic.add(parts.chain([-2.0 * mechanism.kinetic_energy(at)]));
        worst = worst.max(kinetic.roundings());
        let drives = lambda.as_ref().iter().zip(phi_dot.as_ref()).zip(&phi_t);
        let drives = drives.flat_map(|((l, dot), t)| [l * dot, -l * t]);
        balance.add(rates.into_iter().chain(drives).chain([-applied]));
        worst = worst.max(balance.roundings());
    });
    println!("{}: power {worst:.1} roundings", case.name);
    assert!(worst < ROUNDINGS, "{}: {worst}", case.name);
}

/// Sums that ought to vanish.
#[derive(Default)]
struct Balance {
    residual: f64,
    size: f64,
}

impl Balance {
    fn add(&mut self, terms: impl Iterator<Item = f64>) {
        let (mut sum, mut size) = (0.0, 0.0);
        for term in terms {
            sum += term;
            size += term.abs();
        }
        // a NaN must not disappear
        if sum.is_nan() || sum.abs() > self.residual {
            self.residual = sum.abs();
        }
        self.size = self.size.max(size);
    }

    /// The largest residual over ε times the largest sum of magnitudes.
    fn roundings(&self) -> f64 {
        let roundings = self.residual / (f64::EPSILON * self.size);
        match self.residual {
            0.0 => 0.0,
            // `max` would pass over a NaN
            _ if roundings.is_nan() => f64::INFINITY,
            _ => roundings,
        }
    }
}

fn for_each_state<M: Model>(
    case: &Case<M>,
    mut test: impl FnMut(&M, &At<M>, &M::Inputs, &Reactions<M::Coordinates, M::Constraints>),
) {
    const LENGTH: Dimension = Dimension::of(0, 1, 0);
    let mut random = Random::new(1);
    let mechanism = M::made();
    let none = M::Constraints::splat(0.0);
    for at in motion::<M>(case, &mut random) {
        let array = at.q.into_array();
        let is_length = M::INFO.coordinates.iter().map(|q| q.dimension == LENGTH);
        let size = array.as_ref().iter().zip(is_length.clone()).filter(|(_, l)| *l);
        let size = size.fold(0.0, |size, (x, _)| f64::max(size, x.abs()));
        let (mut q, mut v) = (array, array);
        for (i, is_length) in is_length.enumerate() {
            let size = if is_length { size } else { 1.0 };
            q.as_mut()[i] += 0.02 * size * random.between(-1.0, 1.0);
            v.as_mut()[i] = 5.0 * size * random.between(-1.0, 1.0);
        }
        let at = State { t: at.t, q: M::Coordinates::from_array(q), v: M::Coordinates::from_array(v) };
        let mut inputs = M::Inputs::default().into_array();
        for input in inputs.as_mut() {
            *input = random.between(-5.0, 5.0);
        }
        let inputs = M::Inputs::from_array(inputs);
        test(&mechanism, &at, &inputs, &mechanism.reactions(&at, &inputs, &none));
    }
}

/// States along a second of the declared motion.
fn motion<M: Model>(case: &Case<M>, random: &mut Random) -> Vec<At<M>> {
    let mut times: Vec<f64> = (0..STATES).map(|_| random.between(0.0, 0.1 * case.end)).collect();
    times.sort_by(f64::total_cmp);
    if M::INFO.dof == 0 {
        let mut kinematics = Kinematics::new(M::made()).unwrap();
        let mut now = 0.0;
        let mut to = |t: f64| {
            // close enough to stay on the branch
            while now < t {
                now = t.min(now + 5e-3);
                kinematics.at(now).unwrap();
            }
            kinematics.at(t).unwrap().state
        };
        return times.into_iter().map(&mut to).collect();
    }
    let mut simulation = Simulation::new(M::made(), case.step).unwrap();
    let mut to = |t: f64| {
        simulation.advance_to(t).unwrap();
        simulation.state()
    };
    times.into_iter().map(&mut to).collect()
}
