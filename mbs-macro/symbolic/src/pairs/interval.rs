//! How many cycles lie between the starts of two runs of a program, one after the other, as the
//! steps of a simulation are.
//!
//! Two things bound that, as in software pipelining (B. R. Rau, "Iterative modulo scheduling",
//! MICRO 27, 1994): how long the results of a run take to become those of the next one, and how
//! many operations a run has. Small mechanisms are bound by the first, large ones by the second. A
//! pair is one operation less, but a lane that waits for the other may make the way from run to
//! run longer.

use rustc_hash::FxHashMap as HashMap;

use super::layout::Layout;
use super::nodes::Nodes;
use crate::arena::Symbol;
use crate::program::{Operand, Program};

/// Cycles per node, moves between lanes included: that of 0.3, 0.5, 0.7, 0.9 and 1.1 which gave the
/// fastest steps of slider-cranks, pendulums and four-bars on a Zen 5. With less, ten rods took a
/// fifth longer; with more, a four-bar with reduced states a tenth.
const CYCLES_PER_NODE: f32 = 0.7;
/// The runs that are followed. The way from run to run is the mean of the last half of them, as
/// the longest way may lead through several results by turns.
const RUNS: u8 = 8;

/// The cycles from run to run: the larger of both bounds.
pub(super) fn interval(program: &Program, nodes: &Nodes, layout: &Layout<'_>) -> f32 {
    recurrence(program, nodes, layout).max(CYCLES_PER_NODE * nodes.len() as f32)
}

/// The way from run to run, on a processor that does everything as soon as its operands are there.
fn recurrence(program: &Program, nodes: &Nodes, layout: &Layout<'_>) -> f32 {
    let carried = carried(program, layout);
    let mut times = vec![0; program.instructions.len()];
    let mut arrivals: HashMap<Symbol, u32> = HashMap::default();
    let mut ends = [0; 2];
    for run in 0..RUNS {
        let time = |operand: Operand, times: &[u32]| match operand {
            Operand::Value(at) => times[at],
            Operand::Symbol(symbol) => arrivals.get(&symbol).copied().unwrap_or(0),
            Operand::Number(_) | Operand::Hoisted(_) => 0,
        };
        for members in nodes.iter() {
            let instructions = members.clone().map(|at| &program.instructions[at]);
            let begin = instructions
                .clone()
                .map(|instruction| time(instruction.a, &times).max(time(instruction.b, &times)))
                .fold(0, u32::max);
            let latency = instructions.map(|instruction| instruction.operation.latency()).fold(0, u32::max);
            for at in members {
                times[at] = begin + latency;
            }
        }
        let results: Vec<(Symbol, u32)> =
            carried.iter().map(|&(symbol, output)| (symbol, time(program.outputs[output], &times))).collect();
        arrivals.extend(results);
        let end = arrivals.values().copied().fold(0, u32::max);
        if run + 1 == RUNS / 2 {
            ends[0] = end;
        }
        ends[1] = end;
    }
    (ends[1] - ends[0]) as f32 / f32::from(RUNS - RUNS / 2)
}

/// The symbols that the next run reads from results of this one, and from which.
fn carried(program: &Program, layout: &Layout<'_>) -> Vec<(Symbol, usize)> {
    let operands = program.instructions.iter().flat_map(|instruction| [instruction.a, instruction.b]);
    let mut carried: Vec<(Symbol, usize)> = operands
        .filter_map(|operand| match operand {
            Operand::Symbol(symbol) => {
                let output = (layout.carried)(symbol).filter(|&output| output < program.outputs.len())?;
                Some((symbol, output))
            }
            _ => None,
        })
        .collect();
    carried.sort_unstable();
    carried.dedup();
    carried
}
