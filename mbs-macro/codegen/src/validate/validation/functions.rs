//! Functions against their definitions, evaluated with jets. They agree within
//! their running error bounds.

use mbs_interface::FunctionId;
use mbs_symbolic::Rounded;

use super::bodies::{Moved, dot};
use super::{Check, DIRECTIONS, Jet, Point};

impl Point<'_> {
    /// Every function gives what its definition does.
    pub(super) fn functions(&self) -> Check {
        let model = self.model;
        let motion = self.phi(&|at| self.velocity(at), &|_| 0.0, 1.0);
        let in_time = self.phi(&|_| 0.0, &|_| 0.0, 1.0);
        let rows = |of: &dyn Fn(&Jet) -> Rounded| motion.iter().map(of).collect::<Vec<_>>();
        self.agree(FunctionId::Phi, &rows(&|row| row.value))?;
        self.agree(FunctionId::PhiDot, &rows(&|row| row.first))?;
        self.agree(FunctionId::Gamma, &rows(&|row| -row.second))?;
        self.agree(FunctionId::PhiT, &in_time.iter().map(|row| row.first).collect::<Vec<_>>())?;
        let feedback = self.feedback(&motion);
        let rhs: Vec<_> = motion.iter().zip(&feedback).map(|(row, &f)| f - row.second).collect();
        self.agree(FunctionId::BaumgarteRhs, &rhs)?;
        self.jacobian()?;
        let forces = self.known_forces();
        self.masses()?;
        // what depends on reactions is judged by the balance that it keeps
        if model.reactive_loads.is_empty() {
            self.agree(FunctionId::Forces, &forces)?;
        }
        let (kinetic, potential) = self.energies();
        self.agree(FunctionId::KineticEnergy, &[kinetic])?;
        self.agree(FunctionId::PotentialEnergy, &[potential])?;
        let momentum = |at: usize| match model.coordinates[at].is_own() {
            true => Rounded::default(),
            false => self.bodies.own[at] * Rounded::exact(self.velocity(at)),
        };
        let mut momentum: Vec<_> = (0..model.coordinates.len()).map(momentum).collect();
        for Moved { mass, place, columns } in &self.bodies.particles {
            let velocity = [0, 1].map(|at| place[at].first);
            for (at, column) in columns {
                momentum[*at] = momentum[*at] + *mass * dot(*column, velocity);
            }
        }
        self.agree(FunctionId::KineticMomentum, &momentum)?;
        let outputs: Vec<_> = model.outputs.iter().map(|output| self.value(output.value)).collect();
        self.agree(FunctionId::Outputs, &outputs)?;
        let events: Vec<_> = model.events.iter().map(|event| self.value(event.value)).collect();
        self.agree(FunctionId::Events, &events)?;
        let clocks = model.clocks.iter();
        let times: Vec<_> =
            clocks.clone().flat_map(|it| [self.value(it.period), self.value(it.offset)]).collect();
        self.agree(FunctionId::Clocks, &times)?;
        let sets = clocks.map(|clock| &clock.sets);
        let sets = sets.chain(model.transitions.iter().map(|transition| &transition.sets));
        let samples: Vec<_> = sets.flatten().map(|(_, value)| self.value(*value)).collect();
        self.agree(FunctionId::Samples, &samples)?;
        let transitions = model.transitions.iter().map(|transition| self.value(transition.value));
        self.agree(FunctionId::Transitions, &transitions.collect::<Vec<_>>())?;
        let contacts = model.contacts();
        let gaps = contacts.flat_map(|of| [of.gap, of.rate, of.acceleration].map(|x| self.value(x)));
        self.agree(FunctionId::Gaps, &gaps.collect::<Vec<_>>())?;
        let limits = model.frictions.iter().flat_map(|friction| friction.limits.map(|x| self.value(x)));
        self.agree(FunctionId::Limits, &limits.collect::<Vec<_>>())
    }

    /// The entries of M; those that have no place are 0.
    fn masses(&self) -> Check {
        let mut expected = self.bodies.masses.clone();
        let places = self.plan.mass_places.iter();
        let entries: Vec<_> = places.map(|place| expected.remove(place).unwrap_or_default()).collect();
        self.agree(FunctionId::Mass, &entries)?;
        match expected.into_iter().find(|(_, entry)| !is_close(Rounded::default(), *entry)) {
            Some(((i, j), entry)) => {
                Err(format!("`mass` leaves out its entry ({i}, {j}), {:e}", entry.value))
            }
            None => Ok(()),
        }
    }

    /// A function gives what is expected, as far as rounding lets one tell.
    fn agree(&self, function: FunctionId, expected: &[Rounded]) -> Check {
        let (name, found) = (function.name(), self.run(&self.plan.programs[function]));
        if found.len() != expected.len() {
            return Err(format!("`{name}` has {} results instead of {}", found.len(), expected.len()));
        }
        let differs = |at: &usize| !is_close(found[*at], expected[*at]);
        match (0..expected.len()).find(differs) {
            None => Ok(()),
            Some(at) => Err(format!(
                "result {at} of `{name}` is {:e} where an independent evaluation gives {:e}",
                found[at].value, expected[at].value
            )),
        }
    }

    /// Φ_q w along random w.
    fn jacobian(&self) -> Check {
        let entries = self.run(&self.plan.programs[FunctionId::PhiQ]);
        for direction in 0..DIRECTIONS {
            let along = self.phi(&|at| self.weight(at, direction), &|_| 0.0, 0.0);
            let mut products = vec![Rounded::default(); along.len()];
            for (&(row, column), &entry) in self.plan.phi_q_places.iter().zip(&entries) {
                products[row] = products[row] + entry * Rounded::exact(self.weight(column, direction));
            }
            for (row, (product, jet)) in products.iter().zip(&along).enumerate() {
                if !is_close(*product, jet.first) {
                    return Err(format!(
                        "row {row} of `phi_q` is not the derivative of its constraint: {:e} instead of {:e}",
                        product.value, jet.first.value
                    ));
                }
            }
        }
        Ok(())
    }

    fn energies(&self) -> (Rounded, Rounded) {
        let potentials = self.model.potentials.iter();
        let mut potential = potentials.fold(Rounded::default(), |sum, &energy| sum + self.value(energy));
        let mut kinetic = Rounded::default();
        let lines = self.model.coordinates.iter().enumerate().filter(|(_, coordinate)| !coordinate.is_own());
        for (at, coordinate) in lines {
            let (mass, velocity) = (self.bodies.own[at], Rounded::exact(self.velocity(at)));
            kinetic = kinetic + Rounded::exact(0.5) * mass * velocity * velocity;
            let position = Rounded::exact((self.symbol)(coordinate.position));
            potential = potential - mass * self.gravity(at) * position;
        }
        for Moved { mass, place, .. } in &self.bodies.particles {
            let (at, velocity) = (place.map(|x| x.value), place.map(|x| x.first));
            kinetic = kinetic + Rounded::exact(0.5) * *mass * dot(velocity, velocity);
            potential = potential - *mass * dot(self.bodies.gravity, at);
        }
        (kinetic, potential)
    }
}

/// True if two values are the same to rounding. Where the expected one is not a
/// number, or rounding leaves nothing of it, there is nothing to compare.
fn is_close(found: Rounded, expected: Rounded) -> bool {
    // Bounds are of first order; a factor covers the rest.
    let bound = 4.0 * (found.error + expected.error) + f64::MIN_POSITIVE;
    let is_unknown = |x: Rounded| x.value.is_finite() && !x.error.is_finite();
    if !expected.value.is_finite() || is_unknown(expected) || is_unknown(found) {
        return true;
    }
    (found.value - expected.value).abs() <= bound
}
