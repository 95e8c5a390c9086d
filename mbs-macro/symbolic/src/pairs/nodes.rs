//! Groups of instructions that are computed at once, in an order in which they can be.

use crate::program::{Operand, Program};

/// The nodes of a program: an instruction that stands alone, the two of a pair, or the sines and
/// cosines of two angles. Each stands behind those that it waits for.
pub(super) struct Nodes {
    /// The nodes in their order, each by its first instruction.
    order: Vec<usize>,
    members: Lists,
}

impl Nodes {
    /// Given the node of every instruction; nothing if some wait for each other. Each pair alone
    /// joins independent instructions, but two together may wait for each other.
    pub fn new(program: &Program, node: &[usize]) -> Option<Self> {
        let length = node.len();
        let (mut members, mut users) = (Lists::new(length), Lists::new(length));
        let mut waits = vec![0_usize; length];
        for (at, instruction) in program.instructions.iter().enumerate() {
            members.push(node[at], at);
            for operand in [instruction.a, instruction.b] {
                if let Operand::Value(value) = operand {
                    waits[node[at]] += 1;
                    users.push(node[value], node[at]);
                }
            }
        }
        let is_node = |at: &usize| node[*at] == *at;
        let count = (0..length).filter(is_node).count();
        let mut order: Vec<usize> = (0..length).filter(|at| is_node(at) && waits[*at] == 0).collect();
        let mut done = 0;
        while let Some(&at) = order.get(done) {
            done += 1;
            for user in users.of(at) {
                waits[user] -= 1;
                if waits[user] == 0 {
                    order.push(user);
                }
            }
        }
        (done == count).then_some(Self { order, members })
    }

    /// Their number.
    pub fn len(&self) -> usize {
        self.order.len()
    }

    /// The instructions of each, in the order of the nodes.
    pub fn iter(&self) -> impl Iterator<Item = impl Iterator<Item = usize> + Clone + '_> + '_ {
        self.order.iter().map(|&at| self.members.of(at))
    }
}

/// Lists of numbers, all in one piece of memory.
struct Lists {
    /// The last entry of each list.
    last: Vec<Option<usize>>,
    /// A number, and the entry before it.
    entries: Vec<(usize, Option<usize>)>,
}

impl Lists {
    fn new(count: usize) -> Self {
        Self { last: vec![None; count], entries: Vec::with_capacity(2 * count) }
    }

    fn push(&mut self, list: usize, value: usize) {
        self.entries.push((value, self.last[list]));
        self.last[list] = Some(self.entries.len() - 1);
    }

    fn of(&self, list: usize) -> impl Iterator<Item = usize> + Clone + '_ {
        std::iter::successors(self.last[list], |&entry| self.entries[entry].1)
            .map(|entry| self.entries[entry].0)
    }
}
