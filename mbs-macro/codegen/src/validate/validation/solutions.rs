//! Solutions, put back into their equations.
//!
//! An elimination whose pivots have grown by less than [`LARGEST_GROWTH`] leaves
//! a residual of at most (unknowns · growth · ε), 1e-10 of the terms for
//! hundreds of unknowns; a wrong instruction leaves one of their own order.
//! [`RESIDUAL`] lies between the two.

use std::cell::Cell;

use mbs_symbolic::{Program, Symbol};

use super::super::rounding::Rounded;
use super::{Check, DIRECTIONS, Jet, Point};
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
    pub(super) fn solutions(&self) -> Check {
        if !self.is_well_scaled() {
            return Ok(());
        }
        let (n, plan) = (self.model.coordinates.len(), self.plan);
        let motion = self.phi(&|at| self.velocity(at), &|_| 0.0, 1.0);
        let given: Vec<f64> = self.plan.inputs.feedback.iter().map(|&symbol| (self.symbol)(symbol)).collect();
        self.rows_are_met(&motion)?;
        let own: Vec<f64> = self.feedback(&motion).iter().map(|feedback| feedback.value).collect();
        // rows that give a coordinate have no feedback in a step
        let in_steps = |feedback: &[f64]| -> Vec<f64> {
            let is_given = |row: usize| plan.reduction.rows.contains(&row);
            feedback.iter().enumerate().map(|(row, &x)| if is_given(row) { 0.0 } else { x }).collect()
        };
        let states = |all: &[f64]| -> Vec<f64> {
            plan.inputs.states.iter().map(|state| all[state.coordinate]).collect()
        };
        let s = plan.inputs.states.len();
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
        let (given_in_steps, own) = (in_steps(&given), in_steps(&own));
        let constrained =
            self.solved(&plan.constrained, &given).zip(self.solved(&plan.reactions, &given_in_steps));
        if let Some((values, reactions)) = constrained {
            same("constrained", &values[..s], &states(&reactions))?;
        }
        let stabilized = self.solved(&plan.stabilized, &given).zip(self.solved(&plan.reactions, &own));
        if let Some((values, reactions)) = stabilized {
            same("stabilized", &values[..s], &states(&reactions))?;
            same("feedback", &values[s..s + own.len()], &own)?;
        }
        for (name, program) in [
            ("position_correction", &plan.position_correction),
            ("velocity_correction", &plan.velocity_correction),
            ("projection", &plan.projection),
        ] {
            if let Some(values) = self.solved(program, &given) {
                let along = self.phi(&|at| values[at], &|_| 0.0, 0.0);
                let rows = along.iter().map(|row| row.first).collect::<Vec<_>>();
                self.rows_are(name, &rows, &given, &values[..n])?;
            }
        }
        Ok(())
    }

    /// Coordinates and velocities meet the rows that give them.
    fn rows_are_met(&self, motion: &[Jet]) -> Check {
        for &row in &self.plan.reduction.rows {
            for rest in [motion[row].value, motion[row].first] {
                if exceeds(rest.value, rest.error / f64::EPSILON) {
                    return Err(format!("`complete` does not meet row {row}: {:e} is left", rest.value));
                }
            }
        }
        Ok(())
    }

    /// The results of a solving program with this feedback, where its pivots have
    /// not grown too much to tell anything.
    fn solved(&self, program: &Program, feedback: &[f64]) -> Option<Vec<f64>> {
        let hoisted: Vec<f64> = self.hoisted.iter().map(|hoisted| hoisted.value).collect();
        let symbol = |symbol: Symbol| match self.plan.inputs.of(symbol) {
            Some(Input::Feedback(row)) => feedback[row],
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
            let value = at_reactions.value(load.work.force);
            for &(coordinate, slope) in &load.work.along {
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
            let terms = terms.get() + self.augmented(accelerations);
            if exceeds(inertia + constraints, terms) {
                return Err(format!(
                    "`reactions` do not balance the forces: {:e} is left of {:e}",
                    inertia + constraints,
                    terms
                ));
            }
        }
        Ok(())
    }
}

impl Point<'_> {
    /// What rows add to the mass block where some coordinate has no mass: terms of the
    /// size of the other masses, which cancel, also where all forces are 0.
    fn augmented(&self, accelerations: &[f64]) -> f64 {
        let masses = || (0..accelerations.len()).map(|at| self.mass(at).value);
        let fastest = accelerations.iter().fold(0.0_f64, |fastest, a| fastest.max(a.abs()));
        if masses().any(|mass| mass == 0.0) { masses().sum::<f64>() * fastest } else { 0.0 }
    }
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
