//! Expressions as rows of factors and rows of signed summands.

use std::collections::BTreeMap;

use rustc_hash::FxHashMap as HashMap;

use super::hoisted::Hoisted;
use crate::arena::{Arena, Expr, Node, Stage};
use crate::number::Number;
use crate::operators::{Function, Parity};
use crate::program::Operand;
use crate::spline::SplineId;

/// Factors with their exponents.
type Factors = Vec<(Expr, i32)>;

/// Terms with their coefficients.
type Terms = Vec<(Expr, Number)>;

/// A value: a position in [`Flat::definitions`].
pub(super) type Value = usize;

/// How a value comes about.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub(super) enum Definition {
    Leaf(Operand),
    /// Product of values, sorted, repetition allowed.
    Product(Vec<Value>),
    /// Sum of values, each negated or not, sorted, none of them with both signs.
    Sum(Vec<Signed>),
    /// f(x, y), or f(x) with x twice
    Call(Function, [Value; 2]),
    Spline(SplineId, u8, Value),
    Reciprocal(Value),
    Negative(Value),
}

impl Definition {
    pub fn for_each_operand(&self, mut each: impl FnMut(Value)) {
        match self {
            Self::Leaf(_) => {}
            Self::Product(factors) => factors.iter().copied().for_each(each),
            Self::Sum(summands) => summands.iter().for_each(|summand| each(summand.value)),
            Self::Call(function, both) => function.arguments(both).iter().copied().for_each(each),
            Self::Spline(.., x) | Self::Reciprocal(x) | Self::Negative(x) => each(*x),
        }
    }
}

/// A value or its negative.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct Signed {
    pub value: Value,
    pub negative: bool,
}

impl Signed {
    fn plus(value: Value) -> Self {
        Self { value, negative: false }
    }

    fn flipped_if(self, flip: bool) -> Self {
        Self { negative: self.negative ^ flip, ..self }
    }
}

/// The row, sorted, without what stands in it with both signs: x − x is 0. Sums of
/// expressions have that rule too, but two expressions may be one value: x and x computed
/// once, or c·(a − b) and c·(b − a) but for the sign.
pub(super) fn without_opposites(mut row: Vec<Signed>) -> Vec<Signed> {
    row.sort_unstable();
    let mut kept: Vec<Signed> = Vec::with_capacity(row.len());
    for member in row {
        if kept.last() == Some(&member.flipped_if(true)) {
            kept.pop();
        } else {
            kept.push(member);
        }
    }
    kept
}

/// All values, and which are results.
#[derive(Default)]
pub(super) struct Flat {
    pub definitions: Vec<Definition>,
    pub names: HashMap<Value, String>,
    pub outputs: Vec<Signed>,
    index: HashMap<Definition, Value>,
}

impl Flat {
    /// The value with this definition, one per definition.
    pub fn define(&mut self, definition: Definition) -> Value {
        if let Some(&known) = self.index.get(&definition) {
            return known;
        }
        self.definitions.push(definition.clone());
        self.index.insert(definition, self.definitions.len() - 1);
        self.definitions.len() - 1
    }

    /// The values of the results, with the names suggested for their expressions.
    pub fn settle_outputs(&mut self, arena: &Arena, outputs: &[Expr]) -> Vec<Value> {
        let signed = self.outputs.clone();
        let values: Vec<Value> = signed.into_iter().map(|output| self.settle(output)).collect();
        for (&value, &output) in values.iter().zip(outputs) {
            self.name(arena, value, output);
        }
        values
    }

    /// Gives a computed value the name suggested for an expression.
    fn name(&mut self, arena: &Arena, value: Value, expr: Expr) {
        if let Some(name) = arena.label_of(expr)
            && !matches!(self.definitions[value], Definition::Leaf(_))
        {
            self.names.entry(value).or_insert_with(|| name.to_owned());
        }
    }

    /// The value itself, a negation spelled out.
    fn settle(&mut self, signed: Signed) -> Value {
        if !signed.negative {
            return signed.value;
        }
        match &self.definitions[signed.value] {
            Definition::Leaf(Operand::Number(number)) => {
                let negative = -*number;
                self.define(Definition::Leaf(Operand::Number(negative)))
            }
            _ => self.define(Definition::Negative(signed.value)),
        }
    }
}

pub(super) fn flatten(arena: &mut Arena, outputs: &[Expr], hoisted: Option<&mut Hoisted>) -> Flat {
    let mut flattening = Flattening { arena, hoisted, flat: Flat::default(), known: HashMap::default() };
    // Operands first, so that no recursion is deeper than one node.
    for expr in flattening.arena.reachable(outputs) {
        if flattening.is_computed_whole(expr) {
            flattening.value(expr);
        }
    }
    for &output in outputs {
        let signed = flattening.value(output);
        flattening.flat.outputs.push(signed);
    }
    flattening.flat
}

struct Flattening<'a> {
    arena: &'a mut Arena,
    hoisted: Option<&'a mut Hoisted>,
    flat: Flat,
    known: HashMap<Expr, Signed>,
}

impl Flattening<'_> {
    /// True if the expression is to be computed with the parameters.
    fn is_hoisted(&self, expr: Expr) -> bool {
        self.hoisted.is_some() && self.arena.stage(expr) <= Stage::Parameter
    }

    /// True if every user of the expression needs its value as it is. Products
    /// are taken apart by the sums that they stand in.
    fn is_computed_whole(&self, expr: Expr) -> bool {
        let is_row = match self.arena.node(expr) {
            Node::Product(_) => true,
            Node::Sum(constant, terms) => constant.is_zero() && terms.len() == 1,
            _ => false,
        };
        !is_row && !self.is_hoisted(expr)
    }

    fn value(&mut self, expr: Expr) -> Signed {
        if let Some(&known) = self.known.get(&expr) {
            return known;
        }
        let signed = self.new_value(expr);
        self.known.insert(expr, signed);
        if !signed.negative {
            self.flat.name(self.arena, signed.value, expr);
        }
        signed
    }

    fn new_value(&mut self, expr: Expr) -> Signed {
        match *self.arena.node(expr) {
            Node::Number(number) => self.constant(number),
            Node::Symbol(symbol) => self.leaf(Operand::Symbol(symbol)),
            Node::Sum(constant, ref terms) if constant.is_zero() && terms.len() == 1 => {
                let (term, coefficient) = terms[0];
                self.product(coefficient, term)
            }
            Node::Product(_) => self.product(Number::ONE, expr),
            _ if self.is_hoisted(expr) => self.hoist(expr),
            Node::Shared(x) => self.value(x),
            Node::Sum(constant, ref terms) => {
                let terms = terms.clone();
                self.sum(constant, terms)
            }
            Node::Call(function, both) => {
                let is_even = function.row().parity == Parity::Even;
                let both = both.map(|x| self.value(x));
                let both = both.map(|x| if is_even { x.value } else { self.flat.settle(x) });
                Signed::plus(self.flat.define(Definition::Call(function, both)))
            }
            Node::Spline(spline, order, x) => {
                let x = self.value(x);
                let x = self.flat.settle(x);
                Signed::plus(self.flat.define(Definition::Spline(spline, order, x)))
            }
        }
    }

    fn leaf(&mut self, operand: Operand) -> Signed {
        Signed::plus(self.flat.define(Definition::Leaf(operand)))
    }

    fn constant(&mut self, number: Number) -> Signed {
        self.leaf(Operand::Number(number.abs())).flipped_if(number.is_negative())
    }

    fn hoist(&mut self, expr: Expr) -> Signed {
        let Some(hoisted) = self.hoisted.as_mut() else { return self.value(expr) };
        let position = hoisted.position(expr);
        self.leaf(Operand::Hoisted(position))
    }

    /// coefficient·term, the part that depends on parameters alone as one factor.
    fn product(&mut self, coefficient: Number, term: Expr) -> Signed {
        let factors = match self.arena.node(term) {
            Node::Product(factors) => factors.clone(),
            _ => vec![(term, 1)],
        };
        let (early, late): (Vec<_>, Vec<_>) =
            factors.into_iter().partition(|(factor, _)| self.is_hoisted(*factor));

        let mut values = Vec::new();
        let mut negative = coefficient.is_negative();
        if !early.is_empty() || !coefficient.abs().is_one() {
            let early = self.arena.product(&early);
            let early = self.arena.scale(early, coefficient.abs());
            let factor = match self.arena.node(early) {
                Node::Number(number) => self.constant(*number),
                Node::Symbol(symbol) => self.leaf(Operand::Symbol(*symbol)),
                _ => self.hoist(early),
            };
            negative ^= factor.negative;
            values.push(factor.value);
        }
        for (factor, exponent) in late {
            let base = self.value(factor);
            negative ^= base.negative && exponent % 2 != 0;
            let value =
                if exponent < 0 { self.flat.define(Definition::Reciprocal(base.value)) } else { base.value };
            values.extend((0..exponent.unsigned_abs()).map(|_| value));
        }
        values.sort_unstable();
        let value = match values[..] {
            [] => return self.constant(Number::ONE).flipped_if(negative),
            [value] => value,
            _ => self.flat.define(Definition::Product(values)),
        };
        Signed { value, negative }
    }

    fn sum(&mut self, constant: Number, terms: Terms) -> Signed {
        let (early, late): (Vec<_>, Vec<_>) = terms.into_iter().partition(|(term, _)| self.is_hoisted(*term));
        let mut values = Vec::new();
        if early.is_empty() {
            if !constant.is_zero() {
                values.push(self.constant(constant));
            }
        } else {
            let early = self.arena.sum(&early);
            let constant = self.arena.number(constant);
            let early = self.arena.add(early, constant);
            values.push(self.value(early));
        }
        for (term, coefficient) in self.collect_late(&late) {
            values.push(self.product(coefficient, term));
        }
        let values = without_opposites(values);
        let flip = self.is_better_negated(&values);
        let values: Vec<_> = values.into_iter().map(|value| value.flipped_if(flip)).collect();
        match values[..] {
            [] => self.constant(Number::ZERO),
            [value] => value.flipped_if(flip),
            _ => Signed::plus(self.flat.define(Definition::Sum(values))).flipped_if(flip),
        }
    }

    /// Like terms up to factors that depend on parameters alone: p·x + q·x is
    /// (p + q)·x, whose first factor is hoisted.
    fn collect_late(&mut self, terms: &[(Expr, Number)]) -> Terms {
        let mut groups: BTreeMap<Factors, Terms> = BTreeMap::new();
        for &(term, coefficient) in terms {
            let factors = match self.arena.node(term) {
                Node::Product(factors) => factors.clone(),
                _ => vec![(term, 1)],
            };
            let (early, late): (Vec<_>, Vec<_>) =
                factors.into_iter().partition(|(factor, _)| self.is_hoisted(*factor));
            let early = self.arena.product(&early);
            groups.entry(late).or_default().push((early, coefficient));
        }
        let mut collected = Vec::new();
        for (mut late, early) in groups {
            if let [(early, coefficient)] = early[..] {
                late.push((early, 1));
                collected.push((self.arena.product(&late), coefficient));
            } else {
                let sum = self.arena.sum(&early);
                let sum = self.arena.share(sum);
                late.push((sum, 1));
                collected.push((self.arena.product(&late), Number::ONE));
            }
        }
        collected
    }

    /// A sum is computed as it stands, unless its negative is there already.
    fn is_better_negated(&self, values: &[Signed]) -> bool {
        let negated: Vec<_> = values.iter().map(|value| value.flipped_if(true)).collect();
        self.flat.index.contains_key(&Definition::Sum(negated))
    }
}
