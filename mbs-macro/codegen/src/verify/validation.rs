//! What is about to be emitted, against an independent evaluation of what was
//! declared: Φ along curves (`jets`), forces and energies from their
//! definitions, and the solved equations put back into themselves.
//!
//! Functions agree within their running error bounds. A solution is put back:
//! an elimination whose pivots have grown by less than [`LARGEST_GROWTH`] leaves
//! a residual of at most (unknowns · growth · ε), 1e-10 of the terms for
//! hundreds of unknowns; a wrong instruction leaves one of their own order.
//! [`RESIDUAL`] lies between the two.

mod bodies;

use std::cell::Cell;

use mbs_symbolic::{Expr, Operand, Program, Symbol, Tape};

use self::bodies::{Bodies, evaluate};
use super::Samples;
use super::assembly::Assembly;
use super::jets::{self, Jet};
use super::rounding::{Rounded, run};
use crate::derive::Equations;
use crate::diagnostics::{Diagnostic, Diagnostics};
use crate::model::{Direction, Meaning, Model};
use crate::plan::Plan;

const LARGEST_GROWTH: f64 = 1e3;
const RESIDUAL: f64 = 1e-6;

/// How far two eliminations may differ, relative to the largest component: that
/// is a matter of the condition too.
const DIFFERENCE: f64 = 1e-4;

/// The largest mass over the smallest, or the square of that of Φ_q, beyond
/// which solutions lose all digits of some components and tell nothing.
const WIDEST_RANGE: f64 = 1e12;

/// Forces that have lost more than this by cancellation differ from one program
/// to the next.
const BLURRED: f64 = 1e-8;

/// Directions in which the balance of forces is looked at.
const DIRECTIONS: usize = 3;

/// Everything agrees at the sampled positions.
///
/// # Errors
/// The first function that does not, as the compiler's own fault.
pub fn check_programs(
    model: &Model,
    equations: &Equations,
    plan: &Plan,
    samples: &Samples,
) -> Result<(), Diagnostics> {
    if has_extreme_numbers(model, plan) {
        return Ok(());
    }
    let tape = Tape::new(&model.arena, &model.constraints.iter().map(|c| c.phi).collect::<Vec<_>>());
    let hoisted = run(&plan.prepare, &model.values(|_| f64::NAN), &[]);
    // Redundant constraints repeat the others on Φ = 0 only.
    let assembled = (!plan.rows.redundant.is_empty()).then(|| {
        let assembly = Assembly::new(model, equations);
        assembly.close(&plan.rows.basis, &samples.start_position(model)).at
    });
    for position in samples.positions() {
        let symbol = |symbol: Symbol| match (model.meanings.get(symbol.index()), &assembled) {
            (Some(Meaning::Coordinate(at)), Some(assembled)) => assembled.q[*at],
            (Some(Meaning::Time), Some(assembled)) => assembled.t,
            _ => samples.value(symbol, position),
        };
        let bodies = Bodies::new(model, &symbol);
        let point = Point { model, plan, tape: &tape, hoisted: &hoisted, bodies: &bodies, symbol: &symbol };
        let found = point.functions().and_then(|()| point.solutions());
        found.map_err(|wrong| Diagnostic::internal(model.name.span(), wrong))?;
    }
    Ok(())
}

/// Whether products of two or three of the declared numbers leave the range of a
/// double: what comes of that tells nothing.
fn has_extreme_numbers(model: &Model, plan: &Plan) -> bool {
    let is_extreme = |x: f64| x != 0.0 && !(1e-100..1e100).contains(&x.abs());
    let programs = [&plan.prepare, &plan.phi, &plan.gamma, &plan.forces, &plan.mass];
    let numbers = programs.iter().flat_map(|program| &program.instructions).flat_map(|i| [i.a, i.b]);
    let in_code = numbers.into_iter().any(|operand| match operand {
        Operand::Number(number) => is_extreme(number.to_f64()),
        _ => false,
    });
    in_code || model.parameters.iter().any(|parameter| is_extreme(parameter.value))
}

/// What is wrong, in words.
type Check = Result<(), String>;

#[derive(Clone, Copy)]
struct Point<'a> {
    model: &'a Model,
    plan: &'a Plan,
    tape: &'a Tape,
    hoisted: &'a [Rounded],
    bodies: &'a Bodies,
    symbol: &'a dyn Fn(Symbol) -> f64,
}

impl Point<'_> {
    fn run(&self, program: &Program) -> Vec<Rounded> {
        run(program, self.symbol, self.hoisted)
    }

    /// Φ along q + s·first + s²/2·second, t + s·rate.
    fn phi(&self, first: &dyn Fn(usize) -> f64, second: &dyn Fn(usize) -> f64, rate: f64) -> Vec<Jet> {
        jets::evaluate(self.tape, &self.model.arena, &|symbol| {
            let value = (self.symbol)(symbol);
            match self.model.meanings.get(symbol.index()) {
                Some(Meaning::Time) => Jet::curve(value, rate, 0.0),
                Some(Meaning::Coordinate(at)) => Jet::curve(value, first(*at), second(*at)),
                _ => Jet::curve(value, 0.0, 0.0),
            }
        })
    }

    fn velocity(&self, at: usize) -> f64 {
        (self.symbol)(self.model.coordinates[at].velocity)
    }

    fn value(&self, expr: Expr) -> Rounded {
        evaluate(self.model, &[expr], self.symbol).first().copied().unwrap_or_default()
    }

    fn gain(&self, meaning: Meaning) -> Rounded {
        let at = self.model.meanings.iter().position(|&known| known == meaning);
        let symbol = at.and_then(|at| self.model.arena.symbol_at(at));
        Rounded::exact(symbol.map_or(f64::NAN, self.symbol))
    }

    /// −2αΦ̇ − β²Φ
    fn feedback(&self, motion: &[Jet]) -> Vec<Rounded> {
        let (damping, stiffness) = (self.gain(Meaning::MinusTwoAlpha), self.gain(Meaning::MinusBetaSquared));
        motion.iter().map(|row| damping * row.first + stiffness * row.value).collect()
    }

    fn functions(&self) -> Check {
        let (plan, model) = (self.plan, self.model);
        let motion = self.phi(&|at| self.velocity(at), &|_| 0.0, 1.0);
        let in_time = self.phi(&|_| 0.0, &|_| 0.0, 1.0);
        let rows = |of: &dyn Fn(&Jet) -> Rounded| motion.iter().map(of).collect::<Vec<_>>();
        self.agree("phi", &plan.phi, &rows(&|row| row.value))?;
        self.agree("phi_dot", &plan.phi_dot, &rows(&|row| row.first))?;
        self.agree("gamma", &plan.gamma, &rows(&|row| -row.second))?;
        self.agree("phi_t", &plan.phi_t, &in_time.iter().map(|row| row.first).collect::<Vec<_>>())?;
        let feedback = self.feedback(&motion);
        let rhs: Vec<_> = motion.iter().zip(&feedback).map(|(row, &f)| f - row.second).collect();
        self.agree("baumgarte_rhs", &plan.baumgarte_rhs, &rhs)?;
        self.jacobian()?;
        let forces = self.known_forces();
        self.agree("mass", &plan.mass, &self.bodies.masses)?;
        // what depends on reactions is judged by the balance that it keeps
        if model.reactive_loads.is_empty() {
            self.agree("forces", &plan.forces, &forces)?;
        }
        let (kinetic, potential) = self.energies();
        self.agree("kinetic_energy", &plan.kinetic_energy, &[kinetic])?;
        self.agree("potential_energy", &plan.potential_energy, &[potential])?;
        let outputs: Vec<_> = model.outputs.iter().map(|output| self.value(output.value)).collect();
        self.agree("outputs", &plan.outputs, &outputs)
    }

    /// A program gives what is expected, as far as rounding lets one tell.
    fn agree(&self, name: &str, program: &Program, expected: &[Rounded]) -> Check {
        let found = self.run(program);
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
        let entries = self.run(&self.plan.phi_q);
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

    /// Numbers of order 1 that are not in any relation to each other.
    fn weight(&self, at: usize, direction: usize) -> f64 {
        1.0 + ((at + 1) as f64 * (direction as f64 + 0.618)).sin()
    }

    fn mass(&self, at: usize) -> Rounded {
        self.bodies.masses[at]
    }

    fn gravity(&self, at: usize) -> Rounded {
        match self.model.coordinates[at].direction {
            Direction::X => self.bodies.gravity[0],
            Direction::Y => self.bodies.gravity[1],
            Direction::Angle => Rounded::default(),
        }
    }

    /// Q without the loads that depend on reactions.
    fn known_forces(&self) -> Vec<Rounded> {
        let weight = |at: usize| self.mass(at) * self.gravity(at);
        let mut forces: Vec<_> = (0..self.model.coordinates.len()).map(weight).collect();
        for load in &self.model.loads {
            forces[load.coordinate] = forces[load.coordinate] + self.value(load.value);
        }
        forces
    }

    fn energies(&self) -> (Rounded, Rounded) {
        let potentials = self.model.potentials.iter();
        let mut potential = potentials.fold(Rounded::default(), |sum, &energy| sum + self.value(energy));
        let mut kinetic = Rounded::default();
        for (at, coordinate) in self.model.coordinates.iter().enumerate() {
            let (mass, velocity) = (self.mass(at), Rounded::exact(self.velocity(at)));
            kinetic = kinetic + Rounded::exact(0.5) * mass * velocity * velocity;
            let position = Rounded::exact((self.symbol)(coordinate.position));
            potential = potential - mass * self.gravity(at) * position;
        }
        (kinetic, potential)
    }

    /// Whether the numbers in the equations are near enough to each other for a
    /// solution to have correct digits in every component.
    fn is_well_scaled(&self) -> bool {
        let range = |sizes: &mut dyn Iterator<Item = f64>| {
            let sizes = sizes.map(f64::abs).filter(|&size| size > 0.0);
            let ends = |(least, largest): (f64, f64), size: f64| (least.min(size), largest.max(size));
            let (least, largest) = sizes.fold((f64::INFINITY, 0.0_f64), ends);
            largest / least
        };
        let entries = range(&mut self.run(&self.plan.phi_q).into_iter().map(|entry| entry.value));
        let masses = range(&mut (0..self.model.coordinates.len()).map(|at| self.mass(at).value));
        let forces = self.known_forces();
        let largest = forces.iter().fold(0.0_f64, |largest, force| largest.max(force.value.abs()));
        let are_sharp = forces.iter().all(|force| force.error <= BLURRED * largest);
        // A pivot is at worst an entry, and masses are multiplied by its square.
        are_sharp && entries * entries <= WIDEST_RANGE && masses <= WIDEST_RANGE
    }

    /// The solved equations, put back into themselves.
    fn solutions(&self) -> Check {
        if !self.is_well_scaled() {
            return Ok(());
        }
        let (n, plan) = (self.model.coordinates.len(), self.plan);
        let motion = self.phi(&|at| self.velocity(at), &|_| 0.0, 1.0);
        let given: Vec<f64> =
            self.model.symbols.feedback.iter().map(|&symbol| (self.symbol)(symbol)).collect();
        let own: Vec<f64> = self.feedback(&motion).iter().map(|feedback| feedback.value).collect();
        let reactions = self.solved(&plan.reactions, &given);
        if let Some(values) = &reactions {
            self.accelerated("reactions", &values[..n], &given)?;
        }
        // Loads that depend on reactions do so on those without feedback. Several
        // of them are solved for with an error that is bounded elsewhere.
        let feedback =
            if self.model.reactive_loads.is_empty() { given.clone() } else { vec![0.0; given.len()] };
        if let Some(values) = self.solved(&plan.reactions, &feedback)
            && self.model.reactive_loads.len() <= 1
        {
            self.balance(&values[..n], &values[n..])?;
        }
        if let (Some(values), Some(reactions)) = (self.solved(&plan.constrained, &given), reactions) {
            same("constrained", &values[..n], &reactions[..n])?;
        }
        let stabilized = self.solved(&plan.stabilized, &given).zip(self.solved(&plan.reactions, &own));
        if let Some((values, reactions)) = stabilized {
            same("stabilized", &values[..n], &reactions[..n])?;
            same("feedback", &values[n..n + own.len()], &own)?;
        }
        for (name, program) in [
            ("position_correction", &plan.position_correction),
            ("velocity_correction", &plan.velocity_correction),
        ] {
            if let Some(values) = self.solved(program, &given) {
                let along = self.phi(&|at| values[at], &|_| 0.0, 0.0);
                let rows = along.iter().map(|row| row.first).collect::<Vec<_>>();
                self.rows_are(name, &rows, &given, &values[..n])?;
            }
        }
        Ok(())
    }

    /// The results of a solving program with this feedback, where its pivots have
    /// not grown too much to tell anything.
    fn solved(&self, program: &Program, feedback: &[f64]) -> Option<Vec<f64>> {
        let hoisted: Vec<f64> = self.hoisted.iter().map(|hoisted| hoisted.value).collect();
        let symbol = |symbol: Symbol| match self.model.meanings.get(symbol.index()) {
            Some(Meaning::Feedback(row)) => feedback[*row],
            _ => (self.symbol)(symbol),
        };
        let values = program.evaluate(&symbol, &hoisted);
        let growth = values.last().copied().unwrap_or(0.0);
        (growth.abs() <= LARGEST_GROWTH && values.iter().all(|x| x.is_finite())).then_some(values)
    }

    /// Φ̈ along the motion with these accelerations is the feedback.
    fn accelerated(&self, name: &str, accelerations: &[f64], feedback: &[f64]) -> Check {
        let along = self.phi(&|at| self.velocity(at), &|at| accelerations[at], 1.0);
        let rows = along.iter().map(|row| row.second).collect::<Vec<_>>();
        self.rows_are(name, &rows, feedback, accelerations)
    }

    /// The rows that are solved for have come out as they should.
    fn rows_are(&self, name: &str, rows: &[Rounded], expected: &[f64], solution: &[f64]) -> Check {
        let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0_f64, |a, x| a.max(x.abs()));
        let size = largest(&mut solution.iter().copied());
        let mut coefficients = vec![0.0_f64; rows.len()];
        for ((row, _), entry) in self.plan.phi_q_places.iter().zip(self.run(&self.plan.phi_q)) {
            coefficients[*row] = coefficients[*row].max(entry.value.abs());
        }
        for &row in &self.plan.rows.basis {
            let terms = rows[row].error / f64::EPSILON + expected[row].abs() + coefficients[row] * size;
            if exceeds(rows[row].value - expected[row], terms) {
                return Err(format!(
                    "`{name}` does not solve row {row}: {:e} instead of {:e}",
                    rows[row].value, expected[row]
                ));
            }
        }
        Ok(())
    }

    /// Q, with loads that depend on reactions taken at the reactions found.
    fn forces(&self, multipliers: &[f64]) -> Vec<Rounded> {
        let mut forces = self.known_forces();
        let symbol = |symbol: Symbol| match self.model.meanings.get(symbol.index()) {
            Some(Meaning::Multiplier(row)) => multipliers[*row],
            _ => (self.symbol)(symbol),
        };
        let at_reactions = Point { symbol: &symbol, ..*self };
        for load in &self.model.reactive_loads {
            let value = at_reactions.value(load.force);
            for &(coordinate, slope) in &load.along {
                forces[coordinate] = forces[coordinate] + value * self.value(slope);
            }
        }
        forces
    }

    /// wᵀ (M q̈ + Φ_qᵀ λ − Q) = 0 along random w.
    fn balance(&self, accelerations: &[f64], multipliers: &[f64]) -> Check {
        let forces = self.forces(multipliers);
        for direction in 0..DIRECTIONS {
            let along = self.phi(&|at| self.weight(at, direction), &|_| 0.0, 0.0);
            let terms = Cell::new(0.0);
            let count = |x: Rounded| {
                terms.set(terms.get() + x.value.abs() + x.error / f64::EPSILON);
                x.value
            };
            let inertia: f64 = accelerations
                .iter()
                .enumerate()
                .map(|(at, &acceleration)| {
                    let weight = Rounded::exact(self.weight(at, direction));
                    let inertia = count(weight * self.mass(at) * Rounded::exact(acceleration));
                    inertia - count(weight * forces[at])
                })
                .sum();
            let constraints: f64 =
                along.iter().zip(multipliers).map(|(row, &m)| count(row.first * Rounded::exact(m))).sum();
            if exceeds(inertia + constraints, terms.get()) {
                return Err(format!(
                    "`reactions` do not balance the forces: {:e} is left of {:e}",
                    inertia + constraints,
                    terms.get()
                ));
            }
        }
        Ok(())
    }
}

/// Whether two values are the same to rounding. Where the expected one is not a
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

/// Two ways to the same vector, compared by its largest component.
fn same(name: &str, found: &[f64], expected: &[f64]) -> Check {
    let size = expected.iter().fold(0.0_f64, |size, x| size.max(x.abs()));
    let differs = |(found, expected): (&f64, &f64)| (found - expected).abs() > DIFFERENCE * size;
    match found.iter().zip(expected).position(differs) {
        None => Ok(()),
        Some(at) => Err(format!("result {at} of `{name}` is {:e} instead of {:e}", found[at], expected[at])),
    }
}

/// Whether a residual is more than rounding; one that is no number tells nothing.
fn exceeds(residual: f64, terms: f64) -> bool {
    terms.is_finite() && residual.abs() > RESIDUAL * terms + f64::MIN_POSITIVE
}

#[cfg(test)]
mod tests;
