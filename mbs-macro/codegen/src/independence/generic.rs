//! The rank of Φ_q whatever the dimensions and the position, in exact
//! arithmetic modulo a prime.
//!
//! Symbols are random numbers, and angles are random points of the circle, so
//! that sin² + cos² = 1 and sums and fractions of angles are what they are. A
//! float constant and a function such as √ or exp is a random number of its own
//! wherever it occurs anew. What depends on others with such stand-ins free
//! depends on them with their true values: a verdict "redundant" is always
//! right, but for a chance below 1e-12. A verdict "independent" may miss a
//! relation between stand-ins; where there are any, floating-point samples are
//! asked as well.

use std::collections::{BTreeMap, HashMap};
use std::f64::consts::FRAC_PI_2;

use mbs_symbolic::{Arena, Expr, Function, Node, Number, Symbol, Tape, Values};

use super::prime_field::{Residue, Turn, dependent_rows};
use super::rank::Dependent;
use super::samples::Generator;
use super::sparse::SparseRow;
use crate::derive::Equations;

/// What exact arithmetic says about the rows.
pub struct Verdict {
    pub dependent: Vec<Dependent>,
    /// Whether nothing was replaced by a stand-in.
    pub is_exact: bool,
}

/// The rows of Φ_q that depend on earlier ones; `None` should a random number
/// have hit the zero of a denominator.
pub fn judge(arena: &Arena, equations: &Equations) -> Option<Verdict> {
    let entries: Vec<Expr> = equations.phi_q.iter().flat_map(|row| row.values().copied()).collect();
    let tape = Tape::new(arena, &entries);
    let mut point = Point::new(arena, &entries);
    let values = tape.run(arena, |node, values| point.value(node, values));
    let is_exact = values.iter().all(|value| value.is_exact);
    let mut residues = values.iter().map(|value| value.residue);
    let rows: Vec<SparseRow<Residue>> =
        equations.phi_q.iter().map(|row| row.keys().copied().zip(residues.by_ref()).collect()).collect();
    (!point.is_broken).then(|| Verdict { dependent: dependent_rows(rows), is_exact })
}

/// A residue, and whether no stand-in went into it.
#[derive(Clone, Copy, Default)]
struct Value {
    residue: Residue,
    is_exact: bool,
}

/// Random values of everything, drawn when they are first asked for.
struct Point<'a> {
    arena: &'a Arena,
    generator: Generator,
    symbols: HashMap<Symbol, Residue>,
    /// Stand-ins for |x|, by the bits of x.
    floats: HashMap<u64, Residue>,
    /// Of every angle, the part that all its occurrences are integer multiples
    /// of: its divisor and that part.
    angles: HashMap<Expr, (i64, Turn)>,
    divisors: BTreeMap<Expr, i64>,
    /// Whether no stand-in went into the node at hand.
    is_exact: bool,
    is_broken: bool,
}

impl<'a> Point<'a> {
    fn new(arena: &'a Arena, roots: &[Expr]) -> Self {
        let mut divisors = BTreeMap::new();
        for expr in arena.reachable(roots) {
            if let Node::Call(Function::Sin | Function::Cos | Function::Tan, angle) = *arena.node(expr) {
                for (term, coefficient) in terms(arena, angle).1 {
                    if let Number::Rational(_, divisor) = coefficient {
                        let common = divisors.entry(term).or_insert(1_i64);
                        *common = lcm(*common, divisor);
                    }
                }
            }
        }
        Self {
            arena,
            generator: Generator::new(),
            symbols: HashMap::new(),
            floats: HashMap::new(),
            angles: HashMap::new(),
            divisors,
            is_exact: true,
            is_broken: false,
        }
    }

    fn random(&mut self) -> Residue {
        Residue::from_bits(self.generator.bits())
    }

    fn stand_in(&mut self) -> Residue {
        self.is_exact = false;
        self.random()
    }

    fn value(&mut self, node: &Node, values: &Values<Value>) -> Value {
        self.is_exact = true;
        let residue = self.residue(node, values);
        Value { residue, is_exact: self.is_exact }
    }

    fn residue(&mut self, node: &Node, values: &Values<Value>) -> Residue {
        match node {
            Node::Number(number) => self.number(*number),
            Node::Symbol(symbol) => {
                let random = self.random();
                *self.symbols.entry(*symbol).or_insert(random)
            }
            Node::Sum(constant, terms) => {
                let mut sum = self.number(*constant);
                for (term, coefficient) in terms {
                    sum = sum + self.number(*coefficient) * self.operand(values.of(*term));
                }
                sum
            }
            Node::Product(factors) => factors.iter().fold(Residue::ONE, |product, (factor, exponent)| {
                let power = self.operand(values.of(*factor)).power(exponent.unsigned_abs().into());
                product * if *exponent < 0 { self.inverse(power) } else { power }
            }),
            Node::Call(Function::Sin, angle) => self.turn(*angle).sin,
            Node::Call(Function::Cos, angle) => self.turn(*angle).cos,
            Node::Call(Function::Tan, angle) => {
                let turn = self.turn(*angle);
                turn.sin * self.inverse(turn.cos)
            }
            Node::Call(..) | Node::Call2(..) | Node::Spline(..) => self.stand_in(),
            Node::Shared(x) => self.operand(values.of(*x)),
        }
    }

    fn operand(&mut self, value: Value) -> Residue {
        self.is_exact &= value.is_exact;
        value.residue
    }

    fn inverse(&mut self, x: Residue) -> Residue {
        x.inverse().unwrap_or_else(|| {
            self.is_broken = true;
            Residue::ZERO
        })
    }

    fn number(&mut self, number: Number) -> Residue {
        match number {
            Number::Rational(numerator, denominator) => {
                Residue::integer(numerator) * self.inverse(Residue::integer(denominator))
            }
            Number::Float(x) => {
                let random = self.stand_in();
                let magnitude = *self.floats.entry(x.abs().to_bits()).or_insert(random);
                if x < 0.0 { -magnitude } else { magnitude }
            }
        }
    }

    /// The angle: its terms, each a multiple of a random turn, and quarter turns.
    fn turn(&mut self, angle: Expr) -> Turn {
        let (constant, terms) = terms(self.arena, angle);
        let mut turn = self.constant_turn(constant);
        for (term, coefficient) in terms {
            turn = turn.then(self.multiple(term, coefficient));
        }
        turn
    }

    fn multiple(&mut self, term: Expr, coefficient: Number) -> Turn {
        let Number::Rational(numerator, denominator) = coefficient else { return self.random_turn() };
        // Only powers and products of symbols are certain to be unrelated.
        let is_simple = |arena: &Arena, expr| matches!(arena.node(expr), Node::Symbol(_));
        self.is_exact &= match self.arena.node(term) {
            Node::Product(factors) => factors.iter().all(|(factor, _)| is_simple(self.arena, *factor)),
            _ => is_simple(self.arena, term),
        };
        let divisor = self.divisors.get(&term).copied().unwrap_or(1);
        let (divisor, part) = match self.angles.get(&term) {
            Some(known) => *known,
            None => {
                let known = (divisor, self.circle_point());
                self.angles.insert(term, known);
                known
            }
        };
        match numerator.checked_mul(divisor / denominator) {
            Some(count) if divisor % denominator == 0 => part.times(count),
            _ => self.random_turn(),
        }
    }

    /// Multiples of a right angle are exact, and so is 0.
    fn constant_turn(&mut self, constant: Number) -> Turn {
        let quarters = constant.to_f64() / FRAC_PI_2;
        // π is known to a rounding, and so are sums of a few of its multiples.
        if quarters.abs() < 1e6 && (quarters - quarters.round()).abs() <= 8.0 * f64::EPSILON * quarters.abs()
        {
            Turn::RIGHT.times(quarters.round() as i64)
        } else {
            self.random_turn()
        }
    }

    fn random_turn(&mut self) -> Turn {
        self.is_exact = false;
        self.circle_point()
    }

    fn circle_point(&mut self) -> Turn {
        let tangent = self.random();
        Turn::of_half_tangent(tangent).unwrap_or_else(|| {
            self.is_broken = true;
            Turn::NONE
        })
    }
}

/// An angle as a constant and multiples of terms.
fn terms(arena: &Arena, angle: Expr) -> (Number, Vec<(Expr, Number)>) {
    match arena.node(angle) {
        Node::Sum(constant, terms) => (*constant, terms.clone()),
        Node::Number(value) => (*value, Vec::new()),
        Node::Shared(x) => terms(arena, *x),
        _ => (Number::ZERO, vec![(angle, Number::ONE)]),
    }
}

/// The least common multiple; the first number where that would overflow.
fn lcm(a: i64, b: i64) -> i64 {
    let (mut x, mut y) = (a, b);
    while y != 0 {
        (x, y) = (y, x % y);
    }
    (a / x.max(1)).checked_mul(b).unwrap_or(a)
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::judge;
    use crate::derive::{Equations, derive};
    use crate::independence::Samples;
    use crate::inputs::Inputs;
    use crate::model::Model;

    fn equations(declaration: &str) -> (Model, Inputs, Equations) {
        let tokens = declaration.parse().expect("tokens");
        let declaration = crate::syntax::parse(tokens).expect("the right shape");
        let mut model = crate::model::resolve(&declaration).expect("resolvable");
        let inputs = Inputs::new(&mut model);
        let equations = derive(&mut model, &inputs);
        (model, inputs, equations)
    }

    fn mechanism(constraints: &str) -> (Model, Inputs, Equations) {
        equations(&format!(
            "Test {{ dof = 0; param l = 1 [m]; param e = 0.3 [m];
                body a (x1, y1, p) {{ mass = 1 [kg]; inertia = 1 [kg*m^2]; }}
                body b (x2, y2, q) {{ mass = 1 [kg]; inertia = 1 [kg*m^2]; }}
                {constraints} }}"
        ))
    }

    fn dependent(constraints: &str) -> (Vec<(usize, Vec<usize>)>, bool) {
        let (model, _, equations) = mechanism(constraints);
        let verdict = judge(&model.arena, &equations).expect("no zero was hit");
        (verdict.dependent, verdict.is_exact)
    }

    #[test]
    fn angles_add_up() {
        let half = "constraint r: l*sin(p) = x1; constraint s: 2*l*sin(p/2)*cos(p/2) = x1;";
        assert_eq!(dependent(half), (vec![(1, vec![0])], true));
        let sum = "constraint r: l*cos(p + q) = x1;
                   constraint s: l*cos(p)*cos(q) - l*sin(p)*sin(q) = x1;";
        assert_eq!(dependent(sum), (vec![(1, vec![0])], true));
        let quarter = "constraint r: l*cos(p) = x1; constraint s: l*sin(p + 90 [deg]) = x1;";
        assert_eq!(dependent(quarter), (vec![(1, vec![0])], true));
        let other = "constraint r: l*cos(p) = x1; constraint s: l*sin(p + 80 [deg]) = x1;";
        assert_eq!(dependent(other), (vec![], false));
    }

    #[test]
    fn stand_ins_miss_relations_but_invent_none() {
        let roots = "constraint r: sqrt(x1^2 + y1^2) = l; constraint s: x1^2 + y1^2 = l^2;";
        assert_eq!(dependent(roots), (vec![(1, vec![0])], false));
        let powers = "constraint r: l*exp(p)*exp(q) = x1; constraint s: l*exp(p + q) = x1;";
        assert_eq!(dependent(powers).0, []);
    }

    #[test]
    fn dimensions_are_arbitrary() {
        // At e = l the rows would be one.
        let rows = "constraint r: l*p = x1; constraint s: e*p = x1;";
        assert_eq!(dependent(rows), (vec![], true));
    }

    /// One row of a random linkage: a joint, or one that others imply.
    fn row(kind: u8, at: usize, c: i8) -> String {
        match kind {
            0 => format!("constraint c{at}: x1 + {c}*l*cos(p) = x2 + l*cos(q + p);"),
            1 => format!("constraint c{at}: y1 + {c}*l*sin(p) = y2 + l*sin(q + p);"),
            2 => format!("constraint c{at}: (x1 - x2)^2 + (y1 - y2)^2 = {c}*{c}*l^2 + 2*l^2;"),
            3 => format!("constraint c{at}: {c}*x1 - 2*y1 + {c}*l*sin(p)^2 = l;"),
            4 => format!(
                "constraint c{at}: x1 + y1 + {c}*l*(cos(p) + sin(p)) = x2 + y2 + l*cos(q + p) + l*sin(p + q);"
            ),
            _ => format!("constraint c{at}: {c}*l*p + l*q + x1 = l;"),
        }
    }

    proptest! {
        /// The same rows are dependent in exact arithmetic and in floating point,
        /// for rows that often imply each other.
        #[test]
        fn exact_and_sampled_ranks_agree(rows in prop::collection::vec((0_u8..6, 1_i8..3), 1..7)) {
            let text: String = rows.iter().enumerate().map(|(at, &(kind, c))| row(kind, at, c)).collect();
            let (model, inputs, equations) = mechanism(&text);
            let verdict = judge(&model.arena, &equations).expect("no zero was hit");
            prop_assert!(verdict.is_exact);
            let samples = Samples::new(&model, &inputs);
            let sampled = samples.positions().map(|at| samples.echelon(&model, &equations, at));
            let sampled = sampled.max_by_key(|echelon| echelon.rank()).expect("some position");
            prop_assert_eq!(verdict.dependent, sampled.dependent, "{}", text);
        }
    }
}
