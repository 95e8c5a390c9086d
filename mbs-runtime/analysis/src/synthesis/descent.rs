//! From a guess to a mechanism that passes the positions, by damped steps of Gauss and Newton.

use nalgebra::DVector;

use super::blocks::{Block, Step, cost, fall, step};
use super::system::{Guess, System};

/// Iterations of a start at most,
const ITERATIONS: usize = 400;
/// of which so many in a row have to make the sum smaller
const PATIENCE: usize = 12;
/// than this part of itself: most starts lead nowhere, and are left early.
const SLOW: f64 = 0.7;
/// Trials of a damping.
const TRIALS: usize = 12;
/// At this sum the rows vanish to rounding.
const ROUNDING: f64 = 1e-28;
/// Where positions cannot be met exactly, constraints count so much more than they.
const HEAVY: f64 = 1e3;
/// A sum that is so large is not worth it.
const FAR: f64 = 0.1;

/// The mechanism to which a guess leads, on its constraints.
pub fn descend(system: &System<'_>, guess: Guess) -> Option<Guess> {
    let near = iterate(system, guess, 1.0)?;
    if !system.is_overdetermined() {
        return Some(near.0);
    }
    let (near, _) = (near.1 < FAR).then(|| iterate(system, near.0, HEAVY))??;
    on_constraints(system, near)
}

/// Makes the sum of squares small; gives it too.
fn iterate(system: &System<'_>, mut here: Guess, weight: f64) -> Option<(Guess, f64)> {
    let mut blocks = system.blocks(&here, weight, true)?;
    let mut sum = cost(&blocks);
    let (mut damping, mut growth) = (1e-2, 2.0);
    let mut recent = (0, sum);
    for iteration in 0..ITERATIONS {
        if iteration - recent.0 >= PATIENCE {
            if sum > SLOW * recent.1 {
                break;
            }
            recent = (iteration, sum);
        }
        let mut is_better = false;
        for _ in 0..TRIALS {
            let Some((there, change)) = tried(system, &here, &blocks, damping) else { break };
            let trial = system.blocks(&there, weight, false).map(|blocks| cost(&blocks));
            if let Some(trial) = trial.filter(|trial| *trial < sum) {
                let ratio = (sum - trial) / fall(&blocks, &change);
                damping *= (1.0 - (2.0 * ratio - 1.0).powi(3)).clamp(1.0 / 3.0, 2.0);
                (growth, sum, here, is_better) = (2.0, trial, there, true);
                break;
            }
            damping *= growth;
            growth *= 2.0;
        }
        if !is_better || sum < ROUNDING {
            break;
        }
        blocks = system.blocks(&here, weight, true)?;
    }
    Some((here, sum))
}

/// The guess after a step that stays within the bounds, and the step.
fn tried(system: &System<'_>, here: &Guess, blocks: &[Block], damping: f64) -> Option<(Guess, Step)> {
    let [of_q, of_p] = &system.scales;
    let bounds = || system.task.unknown.iter().map(|unknown| unknown.bounds);
    let mut held = vec![false; of_p.len()];
    let mut change = step(blocks, damping, [of_q, of_p], &held)?;
    // what a bound stops does not take part
    for (held, ((value, change), [low, high])) in
        held.iter_mut().zip(here.values.iter().zip(&change.unknowns).zip(bounds()))
    {
        *held = (*value <= low && *change < 0.0) || (*value >= high && *change > 0.0);
    }
    if held.contains(&true) {
        change = step(blocks, damping, [of_q, of_p], &held)?;
    }
    let mut there = here.clone();
    there.coordinates.iter_mut().zip(&change.coordinates).for_each(|(q, change)| *q += change);
    let values = here.values.iter().zip(&change.unknowns).zip(bounds());
    let values = values.map(|((value, change), [low, high])| (value + change).clamp(low, high));
    there.values = DVector::from_iterator(here.values.len(), values);
    change.unknowns = &there.values - &here.values;
    Some((there, change))
}

/// The same with coordinates that keep the constraints.
fn on_constraints(system: &System<'_>, mut guess: Guess) -> Option<Guess> {
    let [of_q, _] = &system.scales;
    let m = system.info().constraints.len();
    let none = DVector::zeros(0);
    for _ in 0..20 {
        let blocks = system.blocks(&guess, 1.0, true)?;
        let constraints = |block: &Block| Block {
            residuals: block.residuals.rows(0, m).clone_owned(),
            by_coordinates: block.by_coordinates.rows(0, m).clone_owned(),
            by_unknowns: nalgebra::DMatrix::zeros(m, 0),
        };
        let rows: Vec<Block> = blocks.iter().map(constraints).collect();
        if cost(&rows) < ROUNDING {
            break;
        }
        let change = step(&rows, 1e-16, [of_q, &none], &[])?;
        guess.coordinates.iter_mut().zip(&change.coordinates).for_each(|(q, change)| *q += change);
    }
    Some(guess)
}
