//! Which of a sum and its negative is computed.
//!
//! Subtraction costs what addition does, so the sign of a sum is free as long as
//! it has terms of both signs, and products hand the signs of their factors on.
//! An operation is lost where all terms of a sum are negative, or a result is.
//! Sums are negated as long as that saves some of these; from the results
//! backwards, so that the links of a chain come out alike.

use std::collections::BTreeSet;

use super::flatten::{Definition, Flat, Signed, Value};
use super::order::depth_first;
use crate::operators::Function;

/// Sweeps over all sums; the second one seldom finds any.
const SWEEPS: usize = 4;

/// Where the sign of a value ends up.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
enum Sink {
    /// The sign of a term of a sum.
    Term { sum: Value, at: usize },
    /// The sign of a result.
    Output(usize),
    /// The name of this value, which is that of its negative then.
    Name(Value),
    /// Something that needs the value as it is.
    Fixed,
}

pub(super) fn choose(flat: &mut Flat) {
    let roots: Vec<Value> = flat.outputs.iter().map(|output| output.value).collect();
    let order = depth_first(flat, &roots);
    let sinks = sinks(flat, &order);
    let mut misnamed = BTreeSet::new();
    for _ in 0..SWEEPS {
        let mut is_better = false;
        for &value in order.iter().rev() {
            let is_sum = matches!(flat.definitions[value], Definition::Sum(_));
            if is_sum && !sinks[value].contains(&Sink::Fixed) && saving(flat, value, &sinks[value]) > 0 {
                negate(flat, value, &sinks[value], &mut misnamed);
                is_better = true;
            }
        }
        if !is_better {
            break;
        }
    }
    flat.names.retain(|value, _| !misnamed.contains(value));
}

/// Per value, where its sign ends up.
fn sinks(flat: &Flat, order: &[Value]) -> Vec<Vec<Sink>> {
    let mut sinks: Vec<Vec<Sink>> = vec![Vec::new(); flat.definitions.len()];
    for (at, output) in flat.outputs.iter().enumerate() {
        sinks[output.value].push(Sink::Output(at));
    }
    // users before operands
    for &user in order.iter().rev() {
        let mut own = std::mem::take(&mut sinks[user]);
        own.extend(flat.names.contains_key(&user).then_some(Sink::Name(user)));
        sinks[user] = odd(own);
        match &flat.definitions[user] {
            Definition::Leaf(_) | Definition::Call(Function::Abs, _) => {}
            Definition::Sum(terms) => {
                for (at, term) in terms.iter().enumerate() {
                    sinks[term.value].push(Sink::Term { sum: user, at });
                }
            }
            definition @ (Definition::Product(_) | Definition::Reciprocal(_)) => {
                let handed_on = std::mem::take(&mut sinks[user]);
                definition.for_each_operand(|operand| {
                    if !matches!(flat.definitions[operand], Definition::Leaf(_)) {
                        sinks[operand].extend(&handed_on);
                    }
                });
                sinks[user] = handed_on;
            }
            definition => {
                definition.for_each_operand(|operand| sinks[operand].push(Sink::Fixed));
            }
        }
    }
    sinks
}

/// The sinks that occur an odd number of times: a sign that enters twice cancels. Once is
/// enough to keep a value fixed.
fn odd(mut sinks: Vec<Sink>) -> Vec<Sink> {
    sinks.sort_unstable();
    let groups = sinks.chunk_by(|a, b| a == b);
    groups.filter(|group| group.len() % 2 == 1 || group[0] == Sink::Fixed).map(|group| group[0]).collect()
}

fn terms(flat: &Flat, sum: Value) -> &[Signed] {
    match &flat.definitions[sum] {
        Definition::Sum(terms) => terms,
        _ => &[],
    }
}

/// Operations that are spared if this sum is negated.
fn saving(flat: &Flat, sum: Value, sinks: &[Sink]) -> isize {
    // a sum of which no term is positive costs a negation
    let cost = |positive: usize| isize::from(positive == 0);
    let positive = |sum: Value| terms(flat, sum).iter().filter(|term| !term.negative).count();
    let own = positive(sum);
    let mut saving = cost(own) - cost(terms(flat, sum).len() - own);
    let user = |sink: &Sink| match sink {
        Sink::Term { sum, .. } => Some(*sum),
        _ => None,
    };
    for group in sinks.chunk_by(|a, b| user(a) == user(b)) {
        if let Some(user) = user(&group[0]) {
            let before = positive(user);
            let changes =
                |sink: &&Sink| matches!(sink, Sink::Term { at, .. } if terms(flat, user)[*at].negative);
            let gained = group.iter().filter(changes).count();
            saving += cost(before) - cost(before + gained - (group.len() - gained));
        } else {
            for sink in group {
                if let Sink::Output(at) = sink {
                    saving += if flat.outputs[*at].negative { 1 } else { -1 };
                }
            }
        }
    }
    saving
}

fn negate(flat: &mut Flat, sum: Value, sinks: &[Sink], misnamed: &mut BTreeSet<Value>) {
    if let Definition::Sum(terms) = &mut flat.definitions[sum] {
        terms.iter_mut().for_each(|term| term.negative ^= true);
    }
    for sink in sinks {
        match *sink {
            Sink::Term { sum, at } => {
                if let Definition::Sum(terms) = &mut flat.definitions[sum] {
                    terms[at].negative ^= true;
                }
            }
            Sink::Output(at) => flat.outputs[at].negative ^= true,
            Sink::Name(value) => {
                if !misnamed.remove(&value) {
                    misnamed.insert(value);
                }
            }
            Sink::Fixed => {}
        }
    }
}
