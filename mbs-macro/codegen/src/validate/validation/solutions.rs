//! Solutions, put back into their equations.
//!
//! An elimination whose pivots have grown by less than [`LARGEST_GROWTH`] leaves
//! a residual of at most (unknowns · growth · ε), 1e-10 of the terms for
//! hundreds of unknowns; a wrong instruction leaves one of their own order.
//! [`RESIDUAL`] lies between the two. A solution that is 0 is what rounding leaves of
//! the terms that it is made of, so the bounds of its rounding errors are allowed beside.

use std::cell::Cell;

use mbs_interface::FunctionId;
use mbs_symbolic::{Program, Rounded, Symbol};

use super::{Check, DIRECTIONS, Jet, Point, run};
use crate::independence::sets;
use crate::independence::sparse::SparseRow;
use crate::inputs::Input;
use crate::model::Meaning;

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

impl Point<'_> {
    /// True if the numbers in the equations are near enough to each other for a
    /// solution to have correct digits in every component.
    fn is_well_scaled(&self) -> bool {
        let range = |sizes: &mut dyn Iterator<Item = f64>| {
            let sizes = sizes.map(f64::abs).filter(|&size| size > 0.0);
            let ends = |(least, largest): (f64, f64), size: f64| (least.min(size), largest.max(size));
            let (least, largest) = sizes.fold((f64::INFINITY, 0.0_f64), ends);
            largest / least
        };
        let entries =
            range(&mut self.run(&self.plan.programs[FunctionId::PhiQ]).into_iter().map(|entry| entry.value));
        let masses = range(&mut (0..self.model.coordinates.len()).map(|at| self.mass(at).value));
        let forces = self.known_forces();
        let largest = forces.iter().fold(0.0_f64, |largest, force| largest.max(force.value.abs()));
        let are_sharp = forces.iter().all(|force| force.error <= BLURRED * largest);
        // A pivot is at worst an entry, and masses are multiplied by its square.
        are_sharp && entries * entries <= WIDEST_RANGE && masses <= WIDEST_RANGE
    }

    /// The solved equations, put back into themselves.
    pub(super) fn solutions(&self) -> Check {
        if !self.is_well_scaled() {
            return Ok(());
        }
        let (n, plan) = (self.model.coordinates.len(), self.plan);
        let motion = self.phi(&|at| self.velocity(at), &|_| 0.0, 1.0);
        let given: Vec<f64> = self.plan.inputs.feedback.iter().map(|&symbol| (self.symbol)(symbol)).collect();
        self.rows_are_met(&motion)?;
        let fed_back = self.feedback_in_steps(&motion);
        let own: Vec<f64> = fed_back.iter().map(|feedback| feedback.value).collect();
        // rows that give a coordinate have no feedback in a step
        let in_steps = |feedback: &[f64]| -> Vec<f64> {
            let is_given = |row: usize| plan.reduction.rows.contains(&row);
            feedback.iter().enumerate().map(|(row, &x)| if is_given(row) { 0.0 } else { x }).collect()
        };
        let states = |all: &[Rounded]| -> Vec<Rounded> {
            plan.inputs.states.iter().map(|state| all[state.coordinate]).collect()
        };
        let s = plan.inputs.states.len();
        let reactions = self.solved(&plan.programs[FunctionId::Reactions], &given);
        if let Some(values) = &reactions {
            self.accelerated("reactions", &values[..n], &given)?;
        }
        // Loads that depend on reactions do so on those without feedback. Several
        // of them are solved for with an error that is bounded elsewhere.
        let feedback =
            if self.model.reactive_loads.is_empty() { given.clone() } else { vec![0.0; given.len()] };
        if let Some(values) = self.solved(&plan.programs[FunctionId::Reactions], &feedback)
            && self.model.reactive_loads.len() <= 1
        {
            self.balance(&values[..n], &values[n..])?;
        }
        let (given_in_steps, own) = (in_steps(&given), in_steps(&own));
        let constrained = self
            .solved(&plan.programs[FunctionId::Constrained], &given)
            .zip(self.solved(&plan.programs[FunctionId::Reactions], &given_in_steps));
        if let Some((values, reactions)) = constrained {
            same("constrained", &values[..s], &states(&reactions))?;
        }
        let stabilized = self
            .solved(&plan.programs[FunctionId::Stabilized], &given)
            .zip(self.solved(&plan.programs[FunctionId::Reactions], &own));
        if let Some((values, reactions)) = stabilized {
            same("stabilized", &values[..s], &states(&reactions))?;
            same("feedback", &values[s..s + own.len()], &fed_back)?;
        }
        let rows = &plan.rows.alone();
        let of_positions = self.model.of_positions(rows);
        for (function, rows) in [
            (FunctionId::PositionCorrection, &of_positions),
            (FunctionId::VelocityCorrection, rows),
            (FunctionId::Projection, rows),
        ] {
            if let Some(values) = self.solved(&plan.programs[function], &given) {
                let along = self.phi(&|at| values[at].value, &|_| 0.0, 0.0);
                let found = along.iter().map(|row| row.first).collect::<Vec<_>>();
                self.rows_are((function.name(), rows), &found, &given, &values[..n])?;
            }
        }
        Ok(())
    }

    /// Coordinates and velocities meet the rows that give them.
    fn rows_are_met(&self, motion: &[Jet]) -> Check {
        let (coefficients, all) = (self.coefficients(), self.run(&self.plan.programs[FunctionId::Complete]));
        let (places, rates) = all.split_at(self.model.coordinates.len());
        for &row in &self.plan.reduction.rows {
            for (rest, given) in [(motion[row].value, places), (motion[row].first, rates)] {
                let error = coefficients[row] * largest(given, |x| x.error);
                if exceeds(rest.value, rest.error / f64::EPSILON, error) {
                    return Err(format!("`complete` does not meet row {row}: {:e} is left", rest.value));
                }
            }
        }
        Ok(())
    }

    /// −2αΦ̇ − β²Φ where the coordinates are completed, with what the rounding of those does to it.
    fn feedback_in_steps(&self, motion: &[Jet]) -> Vec<Rounded> {
        let (coefficients, all) = (self.coefficients(), self.run(&self.plan.programs[FunctionId::Complete]));
        let (places, rates) = all.split_at(self.model.coordinates.len());
        let inputs = &self.plan.inputs;
        let errors = [(inputs.minus_two_alpha, rates), (inputs.minus_beta_squared, places)];
        let error: f64 =
            errors.iter().map(|(gain, of)| (self.symbol)(*gain).abs() * largest(of, |x| x.error)).sum();
        let rows = self.feedback(motion).into_iter().zip(coefficients);
        rows.map(|(row, coefficient)| Rounded { error: row.error + coefficient * error, ..row }).collect()
    }

    /// The largest entry of each row of Φ_q.
    fn coefficients(&self) -> Vec<f64> {
        let mut coefficients = vec![0.0_f64; self.model.constraints.len()];
        for ((row, _), entry) in
            self.plan.phi_q_places.iter().zip(self.run(&self.plan.programs[FunctionId::PhiQ]))
        {
            coefficients[*row] = coefficients[*row].max(entry.value.abs());
        }
        coefficients
    }

    /// The results of a solving program with this feedback, where its pivots have
    /// not grown too much to tell anything.
    fn solved(&self, program: &Program, feedback: &[f64]) -> Option<Vec<Rounded>> {
        let symbol = |symbol: Symbol| match self.plan.inputs.of(symbol) {
            Some(Input::Feedback(row)) => feedback[row],
            _ => (self.symbol)(symbol),
        };
        let values = run(program, &symbol, self.hoisted);
        let growth = values.last().map_or(0.0, |growth| growth.value);
        (growth.abs() <= LARGEST_GROWTH && values.iter().all(|x| x.value.is_finite())).then_some(values)
    }

    /// Φ̈ along the motion with these accelerations is the feedback.
    fn accelerated(&self, name: &str, accelerations: &[Rounded], feedback: &[f64]) -> Check {
        let along = self.phi(&|at| self.velocity(at), &|at| accelerations[at].value, 1.0);
        let rows = along.iter().map(|row| row.second).collect::<Vec<_>>();
        self.rows_are((name, &self.plan.rows.alone()), &rows, feedback, accelerations)
    }

    /// The rows that are solved for have come out as they should.
    fn rows_are(
        &self,
        (name, rows): (&str, &[usize]),
        found: &[Rounded],
        expected: &[f64],
        solution: &[Rounded],
    ) -> Check {
        let (size, error) = (largest(solution, |x| x.value), largest(solution, |x| x.error));
        let coefficients = self.coefficients();
        for &row in rows {
            let terms = found[row].error / f64::EPSILON + expected[row].abs() + coefficients[row] * size;
            if exceeds(found[row].value - expected[row], terms, coefficients[row] * error) {
                return Err(format!(
                    "`{name}` does not solve row {row}: {:e} instead of {:e}",
                    found[row].value, expected[row]
                ));
            }
        }
        self.sets_are(name, found, expected, solution)
    }

    /// The rows of a set have come out as they should, but for what is spare among them.
    fn sets_are(&self, name: &str, found: &[Rounded], expected: &[f64], solution: &[Rounded]) -> Check {
        let rows = &self.plan.rows;
        let Some(spare) = sets::spare(&self.rows_of_phi_q(), rows) else { return Ok(()) };
        let (size, error) = (largest(solution, |x| x.value), largest(solution, |x| x.error));
        let coefficients = self.coefficients();
        for (set, spare) in rows.sets.iter().zip(spare) {
            let rest = |row: usize| found[row].value - expected[row];
            let along: f64 = set.iter().zip(&spare).map(|(&row, n)| n * rest(row)).sum();
            let sum = |of: &dyn Fn(usize) -> f64| set.iter().map(|&row| of(row)).sum::<f64>();
            let of_row =
                |row: usize| found[row].error / f64::EPSILON + expected[row].abs() + coefficients[row] * size;
            let (terms, allowed) = (sum(&of_row), sum(&|row| coefficients[row] * error));
            for (&row, n) in set.iter().zip(&spare) {
                let left = rest(row) - n * along;
                if exceeds(left, terms, allowed) {
                    return Err(format!("`{name}` does not solve row {row} of a set: {left:e} is left"));
                }
            }
        }
        Ok(())
    }

    /// Φ_q, by rows.
    fn rows_of_phi_q(&self) -> Vec<SparseRow<f64>> {
        let mut rows = vec![SparseRow::new(); self.model.constraints.len()];
        let entries = self.run(&self.plan.programs[FunctionId::PhiQ]);
        for (&(row, column), entry) in self.plan.phi_q_places.iter().zip(entries) {
            rows[row].push((column, entry.value));
        }
        rows
    }

    /// Q, with loads that depend on reactions taken at the reactions found.
    fn forces(&self, multipliers: &[Rounded]) -> Vec<Rounded> {
        let mut forces = self.known_forces();
        let symbol = |symbol: Symbol| match self.model.meanings.get(symbol.index()) {
            Some(Meaning::Multiplier(row)) => multipliers[*row].value,
            _ => (self.symbol)(symbol),
        };
        let at_reactions = Point { symbol: &symbol, ..*self };
        for load in &self.model.reactive_loads {
            let value = at_reactions.value(load.work.force);
            for &(coordinate, slope) in &load.work.along {
                forces[coordinate] = forces[coordinate] + value * self.value(slope);
            }
        }
        forces
    }

    /// wᵀ (M q̈ + Φ_qᵀ λ − Q) = 0 along random w.
    fn balance(&self, accelerations: &[Rounded], multipliers: &[Rounded]) -> Check {
        let forces = self.forces(multipliers);
        for direction in 0..DIRECTIONS {
            let along = self.phi(&|at| self.weight(at, direction), &|_| 0.0, 0.0);
            let (terms, errors) = (Cell::new(0.0), Cell::new(0.0));
            // a factor without its own error, which counts beside
            let count = |factor: Rounded, solved: Rounded| {
                let x = factor * Rounded::exact(solved.value);
                terms.set(terms.get() + x.value.abs() + x.error / f64::EPSILON);
                errors.set(errors.get() + factor.value.abs() * solved.error);
                x.value
            };
            let mut rest = 0.0;
            self.over_masses(|mass, row, column| {
                let weight = Rounded::exact(self.weight(row, direction));
                rest += count(weight * mass, accelerations[column]);
            });
            for (at, &force) in forces.iter().enumerate() {
                let weight = Rounded::exact(self.weight(at, direction));
                rest -= count(weight * force, Rounded::exact(1.0));
            }
            for (row, &multiplier) in along.iter().zip(multipliers) {
                rest += count(row.first, multiplier);
            }
            let terms = terms.get() + self.augmented(accelerations);
            if exceeds(rest, terms, errors.get()) {
                return Err(format!("`reactions` do not balance the forces: {rest:e} is left of {terms:e}"));
            }
        }
        Ok(())
    }
}

impl Point<'_> {
    /// The size of the terms that rows add to the mass block where some coordinate has no mass.
    /// They are as large as the other masses, and cancel, also where all forces are 0.
    fn augmented(&self, accelerations: &[Rounded]) -> f64 {
        let masses = || (0..accelerations.len()).map(|at| self.mass(at).value);
        let fastest = largest(accelerations, |x| x.value);
        if masses().any(|mass| mass == 0.0) { masses().sum::<f64>() * fastest } else { 0.0 }
    }
}

fn largest(values: &[Rounded], size: impl Fn(&Rounded) -> f64) -> f64 {
    values.iter().fold(0.0_f64, |largest, x| largest.max(size(x).abs()))
}

/// Two ways to the same vector, compared by its largest component.
fn same(name: &str, found: &[Rounded], expected: &[Rounded]) -> Check {
    let size = largest(expected, |x| x.value);
    let differs = |(found, expected): (&Rounded, &Rounded)| {
        let allowed = DIFFERENCE * size + BOUNDS * (found.error + expected.error);
        (found.value - expected.value).abs() > allowed
    };
    match found.iter().zip(expected).position(differs) {
        None => Ok(()),
        Some(at) => {
            let (found, expected) = (found[at].value, expected[at].value);
            Err(format!("result {at} of `{name}` is {found:e} instead of {expected:e}"))
        }
    }
}

/// Bounds of rounding errors are of first order; a factor covers the rest.
const BOUNDS: f64 = 4.0;

/// True if a residual is more than rounding: of the terms that it is made of, and of a solution
/// whose rounding errors, as they enter, are at most `error`. One that is no number tells nothing.
fn exceeds(residual: f64, terms: f64, error: f64) -> bool {
    terms.is_finite() && residual.abs() > RESIDUAL * terms + BOUNDS * error + f64::MIN_POSITIVE
}
