//! The order in which values are computed.

use super::flatten::{Definition, Flat, Value};
use crate::operators::Function;
use crate::program::Operand;

/// The values that the outputs need, operands before users; functions of inputs
/// come first. A call in the middle would make the machine save every value that
/// is alive across it.
///
/// More than `unrolled` values, which may become loops, are ordered by the pivots that they
/// wait for.
pub(super) fn order(flat: &Flat, outputs: &[Value], unrolled: usize) -> Vec<Value> {
    let order = depth_first(flat, outputs);
    let is_leaf = |value: Value| matches!(flat.definitions[value], Definition::Leaf(_));
    let of_inputs = |value: &Value| match flat.definitions[*value] {
        Definition::Call(_, [x, y]) => is_leaf(x) && is_leaf(y),
        Definition::Spline(.., x) => is_leaf(x),
        _ => false,
    };
    let mut roots: Vec<Value> = order.iter().copied().filter(of_inputs).collect();
    if order.len() <= unrolled {
        roots.extend(outputs);
        return depth_first(flat, &roots);
    }
    // sine and cosine of an angle side by side, the angles in the order of the components
    let input = |&value: &Value| match flat.definitions[value] {
        Definition::Call(_, [x, _]) | Definition::Spline(.., x) => match flat.definitions[x] {
            Definition::Leaf(Operand::Symbol(symbol)) => symbol.index(),
            _ => usize::MAX,
        },
        _ => usize::MAX,
    };
    let is_sine = |&value: &Value| matches!(flat.definitions[value], Definition::Call(Function::Sin, _));
    roots.sort_by_key(|value| (input(value), !is_sine(value)));
    Eager::new(flat, order, depth_first(flat, &roots)).run()
}

/// Orders a long program for loops: what needs a pivot stands right behind what it
/// waits for, short branches first, and the rest where it is first needed. Pivots
/// wait for each other; the right-hand sides, the watch and the next link fill that time,
/// and most results are used in the copy that computes them.
struct Eager<'a> {
    flat: &'a Flat,
    /// Depth first.
    values: Vec<Value>,
    /// True if a value needs a pivot.
    is_late: Vec<bool>,
    users: Vec<Vec<Value>>,
    is_done: Vec<bool>,
    order: Vec<Value>,
}

impl<'a> Eager<'a> {
    fn new(flat: &'a Flat, values: Vec<Value>, first: Vec<Value>) -> Self {
        let count = flat.definitions.len();
        let mut is_late = vec![false; count];
        let mut users = vec![Vec::new(); count];
        for &value in &values {
            let definition = &flat.definitions[value];
            let mut waits = matches!(definition, Definition::Reciprocal(_));
            definition.for_each_operand(|operand| {
                waits |= is_late[operand];
                users[operand].push(value);
            });
            is_late[value] = waits;
        }
        // how many operations lie between a value and the last one that waits for it
        let mut heights = vec![0_usize; count];
        for &value in values.iter().rev() {
            heights[value] = users[value].iter().map(|&user| heights[user] + 1).max().unwrap_or(0);
        }
        // what is tried last comes first
        users.iter_mut().for_each(|users| users.sort_by_key(|&user| std::cmp::Reverse(heights[user])));
        let mut is_done = vec![false; count];
        first.iter().for_each(|&value| is_done[value] = true);
        Self { flat, values, is_late, users, is_done, order: first }
    }

    fn run(mut self) -> Vec<Value> {
        let values = std::mem::take(&mut self.values);
        for &value in &values {
            // users are pushed when a value is done, which each is once
            let mut stack = vec![value];
            while let Some(value) = stack.pop() {
                if !self.is_late[value] || self.is_done[value] {
                    continue;
                }
                let mut is_ready = true;
                self.flat.definitions[value].for_each_operand(|operand| {
                    is_ready &= self.is_done[operand] || !self.is_late[operand];
                });
                if !is_ready {
                    continue;
                }
                self.demand(value);
                stack.extend(&self.users[value]);
            }
        }
        values.into_iter().for_each(|value| self.demand(value));
        self.order
    }

    /// The value, behind those of its operands that are not there yet.
    fn demand(&mut self, value: Value) {
        let mut stack = vec![(value, false)];
        while let Some((value, operands_done)) = stack.pop() {
            if operands_done {
                self.order.push(value);
            } else if !std::mem::replace(&mut self.is_done[value], true) {
                stack.push((value, true));
                push_operands(self.flat, value, &mut stack);
            }
        }
    }
}

pub(super) fn depth_first(flat: &Flat, roots: &[Value]) -> Vec<Value> {
    let mut order = Vec::new();
    let mut seen = vec![false; flat.definitions.len()];
    let mut stack: Vec<(Value, bool)> = roots.iter().rev().map(|&value| (value, false)).collect();
    while let Some((value, operands_done)) = stack.pop() {
        if operands_done {
            order.push(value);
        } else if !std::mem::replace(&mut seen[value], true) {
            stack.push((value, true));
            push_operands(flat, value, &mut stack);
        }
    }
    order
}

/// The operands of a value, the first one on top.
fn push_operands(flat: &Flat, value: Value, stack: &mut Vec<(Value, bool)>) {
    let first = stack.len();
    flat.definitions[value].for_each_operand(|operand| stack.push((operand, false)));
    stack[first..].reverse();
}
