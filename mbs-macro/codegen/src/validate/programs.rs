//! The programs of a start, run on numbers as the generated code will run them.

use crate::compiled::GROWTH_LIMIT;
use crate::derive::Equations;
use crate::independence::assembly::{Assembly, Position};
use crate::independence::samples::units;
use crate::inputs::Input;
use crate::model::Model;
use crate::plan::Plan;
use mbs_interface::FunctionId;

const ITERATIONS: usize = 50;
const HALVINGS: usize = 10;

/// Corrections below this, in units of the coordinates and relative to the position,
/// change nothing any more.
const CONVERGED: f64 = 1e-12;

/// A declared start.
pub struct Declared {
    pub at: Position,
    pub velocities: Vec<f64>,
}

/// How an assembly by the emitted programs ended.
pub enum Closing {
    /// All rows that are solved for are met; Φ there.
    Closed(Position, Vec<f64>),
    /// The correction has no solution there; the row that is violated most.
    Singular(Position, usize),
    /// The row that stays violated most where the violation is least.
    Open(usize, f64),
}

/// The emitted programs at the declared parameters.
pub struct Programs<'a> {
    model: &'a Model,
    plan: &'a Plan,
    pub assembly: Assembly<'a>,
    pub units: Vec<f64>,
    hoisted: Vec<f64>,
}

impl<'a> Programs<'a> {
    pub fn new(model: &'a Model, equations: &Equations, plan: &'a Plan) -> Self {
        let hoisted = plan.programs[FunctionId::Hoisted].evaluate(&model.values(|_| f64::NAN), &[]);
        Self { model, plan, assembly: Assembly::new(model, equations), units: units(model), hoisted }
    }

    /// The start as it is declared.
    pub fn declared(&self) -> Declared {
        let values = self.plan.programs[FunctionId::Start].evaluate(&self.model.values(|_| f64::NAN), &[]);
        let n = self.model.coordinates.len();
        let (q, rest) = values.split_at(n);
        let (velocities, time) = rest.split_at(n);
        let at = Position { q: q.to_vec(), t: time.iter().copied().sum() };
        Declared { at, velocities: velocities.to_vec() }
    }

    fn phi(&self, at: &Position) -> Vec<f64> {
        let values = self.plan.inputs.values(self.model, |input| known(input, at, &[], &[]));
        self.plan.programs[FunctionId::Phi].evaluate(&values, &self.hoisted)
    }

    /// Positions on Φ = 0 near `start`, by the iteration that the runtime makes.
    pub fn close(&self, start: &Position) -> Closing {
        let mut at = start.clone();
        let mut phi = self.phi(&at);
        let mut best = phi.clone();
        for _ in 0..ITERATIONS {
            if norm(&phi) < norm(&best) {
                best.clone_from(&phi);
            }
            let Some(delta) = self.position_correction(&at, &phi) else {
                return Closing::Singular(at, largest(&phi).0);
            };
            if self.size(&delta) <= CONVERGED * (1.0 + self.size(&at.q)) {
                break;
            }
            let mut length = 1.0;
            for _ in 0..=HALVINGS {
                let q = at.q.iter().zip(&delta).map(|(q, d)| q + length * d).collect();
                let next = Position { q, t: at.t };
                let next_phi = self.phi(&next);
                let improves = norm(&next_phi) < norm(&phi);
                if improves || length < 1.0 / f64::from(1 << (HALVINGS - 1)) {
                    (at, phi) = (next, next_phi);
                    break;
                }
                length *= 0.5;
            }
        }
        if self.assembly.are_met(&self.plan.rows.basis, &at) {
            return Closing::Closed(at, phi);
        }
        // The iteration wanders where there is nothing to find: its best is said.
        let (row, violation) = largest(&best);
        Closing::Open(row, violation)
    }

    /// The largest component in units of the coordinates.
    pub fn size(&self, components: &[f64]) -> f64 {
        let scaled: Vec<f64> = components.iter().zip(&self.units).map(|(x, unit)| x / unit).collect();
        largest(&scaled).1
    }

    /// Δq; `None` where its elimination is singular.
    fn position_correction(&self, at: &Position, phi: &[f64]) -> Option<Vec<f64>> {
        let residual: Vec<f64> = phi.iter().map(|x| -x).collect();
        let values = self.plan.inputs.values(self.model, |input| known(input, at, &[], &residual));
        regular(self.plan.programs[FunctionId::PositionCorrection].evaluate(&values, &self.hoisted))
    }

    /// Velocities on Φ̇ = 0 near those declared, by the runtime's solve and its
    /// refinement; `None` where the elimination is singular.
    pub fn velocities(&self, at: &Position, declared: &[f64]) -> Option<Vec<f64>> {
        let mut v = declared.to_vec();
        for _ in 0..2 {
            let delta = self.velocity_correction(at, &v)?;
            v.iter_mut().zip(delta).for_each(|(v, d)| *v += d);
        }
        Some(v)
    }

    /// Δv; `None` where its elimination is singular.
    fn velocity_correction(&self, at: &Position, v: &[f64]) -> Option<Vec<f64>> {
        let values = self.plan.inputs.values(self.model, |input| known(input, at, v, &[]));
        let phi_dot = self.plan.programs[FunctionId::PhiDot].evaluate(&values, &self.hoisted);
        let residual: Vec<f64> = phi_dot.iter().map(|x| -x).collect();
        let values = self.plan.inputs.values(self.model, |input| known(input, at, v, &residual));
        regular(self.plan.programs[FunctionId::VelocityCorrection].evaluate(&values, &self.hoisted))
    }

    /// The constraint and the coordinate of the pivot that the equations of motion
    /// lose at a position, if they lose any.
    pub fn lost_pivot(&self, at: &Position) -> Option<(Option<usize>, Option<usize>)> {
        let values = self.plan.inputs.values(self.model, |input| known(input, at, &[], &[]));
        let growths = self.plan.programs[FunctionId::Pivots].evaluate(&values, &self.hoisted);
        let (worst, growth) = largest(&growths);
        let is_lost = growth >= GROWTH_LIMIT;
        is_lost.then(|| self.plan.pivot_names.get(worst).copied().unwrap_or_default())
    }
}

/// The solution without its growth, if that leaves digits in every pivot.
fn regular(mut solution: Vec<f64>) -> Option<Vec<f64>> {
    let growth = solution.pop()?;
    (growth < GROWTH_LIMIT && solution.iter().all(|x| x.is_finite())).then_some(solution)
}

fn known(input: Input, position: &Position, velocities: &[f64], residual: &[f64]) -> f64 {
    let known = match input {
        Input::Time => Some(position.t),
        Input::Position(at) => position.q.get(at).copied(),
        Input::Velocity(at) => velocities.get(at).copied(),
        Input::Feedback(at) => residual.get(at).copied(),
        _ => None,
    };
    known.unwrap_or(f64::NAN)
}

fn norm(values: &[f64]) -> f64 {
    values.iter().map(|x| x * x).sum::<f64>().sqrt()
}

/// The place of the largest magnitude, and it; infinite where one is no number.
fn largest(values: &[f64]) -> (usize, f64) {
    let magnitude = |x: &f64| if x.is_nan() { f64::INFINITY } else { x.abs() };
    values.iter().map(magnitude).enumerate().max_by(|a, b| a.1.total_cmp(&b.1)).unwrap_or((0, 0.0))
}
