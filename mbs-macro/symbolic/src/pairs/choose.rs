//! Which instructions share a vector.
//!
//! A pair saves an operation, and costs a move for every operand that is not a pair
//! itself. So pairs are grown: from a seed down its operands as long as that gains.
//! The seed that gains most goes first; what it gains depends on the pairs that
//! are there already, so that seeds are judged again before they are taken.

use std::cmp::Ordering;
use std::collections::{BTreeMap, BinaryHeap};

use rustc_hash::FxHashMap as HashMap;

use super::ancestors::Ancestors;
use super::angles::{Angles, is_sine_or_cosine};
use super::interval::interval;
use super::kinds::{Kind, Partner, kind, matchings};
use super::layout::Layout;
use super::nodes::Nodes;
use super::steps::Lane;
use super::trial::Trial;
use crate::program::{Instruction, Operand, Program};

/// The costs of moves, in operations. Moves into both lanes are used again and again,
/// and moves of constants are done before a loop.
const JOIN: f32 = 1.0;
const JOIN_CONSTANTS: f32 = 0.5;
const SPLAT: f32 = 0.4;
const SWAP: f32 = 0.8;
/// One lane adds, the other subtracts.
const MIXED: f32 = 0.4;
/// A scalar that waits in the second lane.
const EXTRACT: f32 = 0.25;
/// Two results that are written at once.
const WRITE: f32 = 0.8;
/// A cycle that a lane waits for the other.
const WAIT: f32 = 0.02;
/// Lanes that wait longer lose more than the operation that they save.
const LONGEST_WAIT: u32 = 50;
/// How far a seed grows.
const DEPTH: usize = 8;

pub(super) fn choose(program: &Program, angles: &Angles, layout: &Layout<'_>) -> Vec<Option<Partner>> {
    let mut chooser = Chooser::new(program, angles, layout);
    // A pair that was not worth it alone may be once its users are pairs. Every pass but the last
    // takes a pair, and none is given up.
    while chooser.pass() {}
    chooser.partners
}

struct Chooser<'a> {
    program: &'a Program,
    layout: &'a Layout<'a>,
    kinds: Vec<Option<Kind>>,
    users: Vec<Vec<usize>>,
    /// The output that an instruction is.
    outputs: Vec<Option<usize>>,
    /// When a result is there at the earliest.
    latencies: Vec<u32>,
    ancestors: Ancestors,
    partners: Vec<Option<Partner>>,
    /// For sines and cosines of a pair of angles the first of them; for every other
    /// instruction itself.
    turns: Vec<usize>,
    /// Cycles from run to run with the pairs so far; no pair makes it longer.
    interval: Option<f32>,
}

impl<'a> Chooser<'a> {
    fn new(program: &'a Program, angles: &Angles, layout: &'a Layout<'a>) -> Self {
        let length = program.instructions.len();
        let mut users = vec![Vec::new(); length];
        for (at, instruction) in program.instructions.iter().enumerate() {
            for operand in [instruction.a, instruction.b] {
                if let Operand::Value(of) = operand
                    && users[of].last() != Some(&at)
                {
                    users[of].push(at);
                }
            }
        }
        let mut outputs = vec![None; length];
        for (position, output) in program.outputs.iter().enumerate() {
            if let Operand::Value(at) = output {
                outputs[*at] = Some(position);
            }
        }
        let mut chooser = Self {
            program,
            layout,
            kinds: program.instructions.iter().map(kind).collect(),
            users,
            outputs,
            latencies: program.latencies(),
            ancestors: Ancestors::new(program),
            partners: vec![None; length],
            turns: turns(program, angles),
            interval: None,
        };
        chooser.interval = chooser.interval_with(&[]);
        chooser
    }

    /// Takes seeds until none gains; whether there was any.
    fn pass(&mut self) -> bool {
        let mut seeds: BinaryHeap<Seed> = BinaryHeap::new();
        let mut trial = Trial::new(self.partners.len());
        for class in self.classes() {
            for (at, &x) in class.iter().enumerate() {
                let is_near = |y: &&usize| self.latencies[x].abs_diff(self.latencies[**y]) <= LONGEST_WAIT;
                for &y in class[at + 1..].iter().filter(is_near) {
                    let seed = self.judge(x, y, &mut trial);
                    if seed.gain > 0.0 {
                        seeds.push(seed);
                    }
                }
            }
        }
        let mut is_changed = false;
        // A seed leaves, or comes back with what it gains now. That changes only where a pair
        // is taken: until then every seed comes back once at most.
        while let Some(seed) = seeds.pop() {
            let judged = self.judge(seed.x, seed.y, &mut trial);
            if judged.gain <= 0.0 {
                continue;
            }
            if seeds.peek().is_some_and(|next| next.gain > judged.gain) {
                seeds.push(judged);
            } else if let Some(interval) = self.interval_with(trial.pairs())
                && self.interval.is_none_or(|before| interval <= before)
            {
                self.take(trial.pairs());
                self.interval = Some(interval);
                is_changed = true;
            }
        }
        is_changed
    }

    /// Free instructions that look alike, operands and operands of operands included.
    fn classes(&self) -> Vec<Vec<usize>> {
        let mut classes: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for at in 0..self.kinds.len() {
            if self.kinds[at].is_some() && self.partners[at].is_none() {
                classes.entry(self.shape(Operand::Value(at), 2)).or_default().push(at);
            }
        }
        classes.into_values().collect()
    }

    fn shape(&self, operand: Operand, depth: usize) -> String {
        let Operand::Value(at) = operand else {
            return match operand {
                Operand::Symbol(_) => "s".to_owned(),
                _ => "c".to_owned(),
            };
        };
        let instruction = &self.program.instructions[at];
        let Some(kind) = self.kinds[at] else { return "f".to_owned() };
        let name = match kind {
            Kind::Sum => '+',
            Kind::Product => '*',
            Kind::Quotient => '/',
            Kind::Magnitude => '|',
        };
        if depth == 0 {
            return name.to_string();
        }
        let mut operands = [self.shape(instruction.a, depth - 1), self.shape(instruction.b, depth - 1)];
        if kind != Kind::Quotient {
            operands.sort();
        }
        format!("{name}({}{})", operands[0], operands[1])
    }

    /// A seed with its gain. The trial then has the pairs that grow from it.
    fn judge(&self, x: usize, y: usize, trial: &mut Trial) -> Seed {
        trial.truncate(0);
        let gain = if self.can_pair(x, y, trial) { self.grow(x, y, trial, 0) } else { 0.0 };
        Seed { gain, x, y }
    }

    fn can_pair(&self, x: usize, y: usize, trial: &Trial) -> bool {
        x != y
            && self.kinds[x].is_some()
            && self.kinds[x] == self.kinds[y]
            && !self.is_paired(x, trial)
            && !self.is_paired(y, trial)
            && !self.ancestors.has(x, y)
            && !self.ancestors.has(y, x)
    }

    fn are_paired(&self, x: usize, y: usize, trial: &Trial) -> bool {
        let partner = Some(Partner { other: y, lane: Lane::First });
        self.partners[x] == partner || trial.partner(x) == partner
    }

    fn is_paired(&self, x: usize, trial: &Trial) -> bool {
        self.partners[x].is_some() || trial.partner(x).is_some()
    }

    /// The gain of the pair and of all that grows from its operands, in their most likely matching.
    fn grow(&self, x: usize, y: usize, trial: &mut Trial, depth: usize) -> f32 {
        trial.push(x, y);
        let [left, right] = [x, y].map(|at| &self.program.instructions[at]);
        let mut gain = 1.0;
        if left.operation != right.operation {
            gain -= MIXED;
        }
        gain -= WAIT * self.latencies[x].abs_diff(self.latencies[y]) as f32;
        gain += self.of_users(x, y, trial);
        let likely = |matching: &[(&Operand, &Operand); 2]| -> f32 {
            matching.iter().map(|&(a, b)| self.likeness(a, b, trial, 2)).sum()
        };
        let all = matchings(left, right).map(|matching| (likely(&matching), matching));
        let best = all.reduce(|best, next| if next.0 > best.0 { next } else { best });
        if let Some((_, [first, second])) = best {
            gain += self.of_operands(first.0, first.1, trial, depth);
            // squares and magnitudes have one operand
            if second != first {
                gain += self.of_operands(second.0, second.1, trial, depth);
            }
        }
        gain
    }

    /// The gain of using these two as a pair: that of pairing them, or minus the cost of moves.
    fn of_operands(&self, a: &Operand, b: &Operand, trial: &mut Trial, depth: usize) -> f32 {
        let (&Operand::Value(x), &Operand::Value(y)) = (a, b) else {
            return -self.cost_of_given(a, b);
        };
        if x == y {
            return -SPLAT;
        }
        if self.are_paired(x, y, trial) {
            return 0.0;
        }
        if self.are_paired(y, x, trial) {
            return -SWAP;
        }
        if depth < DEPTH && self.can_pair(x, y, trial) {
            let before = trial.pairs().len();
            let gain = self.grow(x, y, trial, depth + 1);
            if gain > -JOIN {
                return gain;
            }
            trial.truncate(before);
        }
        -JOIN
    }

    fn cost_of_given(&self, a: &Operand, b: &Operand) -> f32 {
        let is_constant = |operand: &Operand| match *operand {
            Operand::Number(_) | Operand::Hoisted(_) => true,
            Operand::Symbol(symbol) => (self.layout.is_constant)(symbol),
            Operand::Value(_) => false,
        };
        match (a, b) {
            (Operand::Number(_), Operand::Number(_)) => 0.0,
            (&Operand::Symbol(x), &Operand::Symbol(y)) if (self.layout.are_neighbours)(x, y) => 0.0,
            _ if a == b => {
                if is_constant(a) {
                    0.0
                } else {
                    SPLAT
                }
            }
            _ if is_constant(a) && is_constant(b) => JOIN_CONSTANTS,
            _ => JOIN,
        }
    }

    /// Users that are a pair already no longer join their operands; users that
    /// are scalars have to fetch theirs.
    fn of_users(&self, x: usize, y: usize, trial: &Trial) -> f32 {
        let mut gain = 0.0;
        for &user in &self.users[x] {
            let partner = self.partners[user].filter(|partner| partner.lane == Lane::First);
            let Some(partner) = partner.filter(|partner| self.users[y].contains(&partner.other)) else {
                continue;
            };
            let [left, right] = [user, partner.other].map(|at| &self.program.instructions[at]);
            let wanted = (&Operand::Value(x), &Operand::Value(y));
            if matchings(left, right).any(|matching| matching.contains(&wanted)) {
                gain += JOIN;
                break;
            }
        }
        if let (Some(a), Some(b)) = (self.outputs[x], self.outputs[y])
            && (self.layout.are_written_together)(a, b)
        {
            gain += WRITE;
        }
        if self.users[y].iter().any(|&user| !self.is_paired(user, trial)) {
            gain -= EXTRACT;
        }
        gain
    }

    /// How well two operands seem to go together.
    fn likeness(&self, a: &Operand, b: &Operand, trial: &Trial, depth: usize) -> f32 {
        let (&Operand::Value(x), &Operand::Value(y)) = (a, b) else {
            return if matches!((a, b), (Operand::Value(_), _) | (_, Operand::Value(_))) {
                -1.0
            } else {
                1.0 - self.cost_of_given(a, b)
            };
        };
        if x == y {
            return 1.0 - SPLAT;
        }
        if self.are_paired(x, y, trial) {
            return 2.0;
        }
        if self.are_paired(y, x, trial) {
            return 1.0;
        }
        if !self.can_pair(x, y, trial) {
            let [left, right] = [x, y].map(|at| &self.program.instructions[at]);
            return if is_sine_or_cosine(left) && is_sine_or_cosine(right) { 0.5 } else { 0.0 };
        }
        if depth == 0 {
            return 1.0;
        }
        let [left, right] = [x, y].map(|at| &self.program.instructions[at]);
        let of = |matching: [(&Operand, &Operand); 2]| -> f32 {
            matching.iter().map(|&(a, b)| self.likeness(a, b, trial, depth - 1)).sum()
        };
        1.0 + matchings(left, right).map(of).fold(f32::MIN, f32::max) / 2.0
    }

    fn take(&mut self, pairs: &[(usize, usize)]) {
        for &(first, second) in pairs {
            self.partners[first] = Some(Partner { other: second, lane: Lane::First });
            self.partners[second] = Some(Partner { other: first, lane: Lane::Second });
        }
    }

    /// The cycles from run to run with these pairs too; nothing if some pairs wait for each other.
    fn interval_with(&self, pairs: &[(usize, usize)]) -> Option<f32> {
        // Instructions that are computed at once are known by one of them.
        let mut node = self.turns.clone();
        for (at, partner) in self.partners.iter().enumerate() {
            if let Some(partner) = partner {
                node[at] = at.min(partner.other);
            }
        }
        for &(first, second) in pairs {
            node[first] = first.min(second);
            node[second] = first.min(second);
        }
        let nodes = Nodes::new(self.program, &node)?;
        Some(interval(self.program, &nodes, self.layout))
    }
}

fn turns(program: &Program, angles: &Angles) -> Vec<usize> {
    let mut first = HashMap::default();
    let of_pair = |(at, instruction): (usize, &Instruction)| match angles.get(&instruction.a) {
        Some((pair, _)) if is_sine_or_cosine(instruction) => *first.entry(*pair).or_insert(at),
        _ => at,
    };
    program.instructions.iter().enumerate().map(of_pair).collect()
}

/// A pair, and the gain of it and of all that grows from it.
#[derive(Clone, Copy, PartialEq)]
struct Seed {
    gain: f32,
    x: usize,
    y: usize,
}

impl Eq for Seed {}

impl Ord for Seed {
    /// Of equal gains the earliest instructions are greatest.
    fn cmp(&self, other: &Self) -> Ordering {
        self.gain.total_cmp(&other.gain).then_with(|| (other.x, other.y).cmp(&(self.x, self.y)))
    }
}

impl PartialOrd for Seed {
    fn partial_cmp(&self, other: &Self) -> Option<Ordering> {
        Some(self.cmp(other))
    }
}
