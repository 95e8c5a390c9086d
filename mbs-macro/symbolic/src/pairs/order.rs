//! The steps of a program on pairs in the order in which a processor can do them.
//!
//! A processor looks some hundred instructions ahead, and a program that finishes one result
//! after the other has little in them that does not wait. So steps stand where a processor would
//! do them that sees the whole program: of those whose operands are there, the one with the
//! longest way to an end comes first (list scheduling: R. L. Graham, "Bounds for certain
//! multiprocessing anomalies", Bell System Technical Journal 45, 1966).

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap};

use super::{Step, Woven};
use crate::operators::Function;
use crate::program::Operation;

/// Parts of a cycle, so that times are whole numbers.
const CYCLE: u32 = 2;
/// How long a step keeps the processor from the next one: two are done in a cycle. One, four, and
/// sines that take the time of all their instructions give orders that are no faster.
const ISSUE: u32 = CYCLE / 2;

/// The same steps, each when its turn is.
pub(super) fn in_order(woven: &Woven) -> Woven {
    let graph = Graph::new(&woven.steps);
    let order = graph.schedule(&woven.steps);
    let mut places = vec![0; order.len()];
    for (place, &step) in order.iter().enumerate() {
        places[step] = place;
    }
    let moved = |step: usize| places[step];
    Woven {
        steps: order.iter().map(|&step| woven.steps[step].renamed(moved)).collect(),
        outputs: woven.outputs.iter().map(|output| output.renamed(moved)).collect(),
    }
}

/// What waits for what. Cosines come with their sines: both are one step here, the sines.
struct Graph {
    users: Vec<BTreeSet<usize>>,
    /// How many steps each one waits for.
    waits: Vec<usize>,
    /// The longest way from the begin of a step to an end.
    heights: Vec<u32>,
}

impl Graph {
    fn new(steps: &[Step]) -> Self {
        let mut users = vec![BTreeSet::new(); steps.len()];
        let mut waits = vec![0; steps.len()];
        for (at, step) in own(steps) {
            for operand in step.operands() {
                let of = if matches!(steps[operand], Step::Cosines(_)) { operand - 1 } else { operand };
                waits[at] += usize::from(users[of].insert(at));
            }
        }
        let mut heights = vec![0; steps.len()];
        for at in (0..steps.len()).rev() {
            let above = users[at].iter().map(|&user| heights[user]).fold(0, u32::max);
            heights[at] = above + latency(&steps[at]);
        }
        Self { users, waits, heights }
    }

    /// The steps in the order in which they are done. Each is done once, when all that it waits
    /// for is.
    fn schedule(mut self, steps: &[Step]) -> Vec<usize> {
        // whose operands are there: the highest first, of equals the earliest
        let mut ready = BinaryHeap::new();
        // whose operands will be there at a time
        let mut coming: BinaryHeap<Reverse<(u32, usize)>> =
            own(steps).filter(|&(at, _)| self.waits[at] == 0).map(|(at, _)| Reverse((0, at))).collect();
        let mut begins = vec![0; steps.len()];
        let mut order = Vec::with_capacity(steps.len());
        let mut now = 0;
        loop {
            while let Some(&Reverse((begin, at))) = coming.peek()
                && (begin <= now || ready.is_empty())
            {
                now = now.max(begin);
                coming.pop();
                ready.push((self.heights[at], Reverse(at)));
            }
            let Some((_, Reverse(at))) = ready.pop() else { return order };
            order.push(at);
            let end = now + latency(&steps[at]);
            now += ISSUE;
            if matches!(steps[at], Step::Sines(_)) {
                order.push(at + 1);
            }
            for &user in &self.users[at] {
                begins[user] = end.max(begins[user]);
                self.waits[user] -= 1;
                if self.waits[user] == 0 {
                    coming.push(Reverse((begins[user], user)));
                }
            }
        }
    }
}

/// The steps but for cosines, which come with their sines.
fn own(steps: &[Step]) -> impl Iterator<Item = (usize, &Step)> {
    steps.iter().enumerate().filter(|(_, step)| !matches!(step, Step::Cosines(_)))
}

fn latency(step: &Step) -> u32 {
    CYCLE
        * match step {
            Step::Scalar(operation, ..) | Step::Pair(operation, ..) => operation.latency(),
            Step::Sines(_) | Step::Cosines(_) => Operation::Call(Function::Sin).latency(),
            Step::Join(..) | Step::Splat(_) | Step::Swap(_) | Step::Flip(_) => 1,
        }
}
