//! How a mechanism moves: which symbols are its coordinates, and how fast they change.

use mbs_symbolic::{Algebra, Expr, Scalar, Symbol};
use rustc_hash::{FxHashMap as HashMap, FxHashSet as HashSet};

/// The symbols of the motion.
pub struct Motion {
    time: Symbol,
    /// Where the symbol of a coordinate stands among them.
    coordinates: HashMap<Symbol, usize>,
    /// Of every coordinate.
    velocities: Vec<Symbol>,
    /// λ of every constraint.
    multipliers: HashSet<Symbol>,
}

impl Motion {
    /// Of nothing yet.
    pub fn new(time: Symbol) -> Self {
        let (coordinates, velocities, multipliers) = Default::default();
        Self { time, coordinates, velocities, multipliers }
    }

    /// Enters the next coordinate.
    pub fn add_coordinate(&mut self, position: Symbol, velocity: Symbol) {
        self.coordinates.insert(position, self.velocities.len());
        self.velocities.push(velocity);
    }

    /// Enters the multiplier of a constraint.
    pub fn add_multiplier(&mut self, multiplier: Symbol) {
        self.multipliers.insert(multiplier);
    }

    /// True if something is a function of reactions.
    pub fn depends_on_reactions(&self, x: Scalar<'_>) -> bool {
        x.symbols().iter().any(|symbol| self.multipliers.contains(symbol))
    }

    /// ∂x/∂q for every coordinate q along which it is not 0.
    pub fn slopes(&self, x: Scalar<'_>) -> Vec<(usize, Expr)> {
        let mut slopes = Vec::new();
        for symbol in x.symbols() {
            let Some(&coordinate) = self.coordinates.get(&symbol) else { continue };
            let slope = x.partial(symbol);
            if !slope.is_zero() {
                slopes.push((coordinate, slope.expr()));
            }
        }
        slopes
    }

    /// ∂x/∂v for every velocity v along which it is not 0.
    pub fn slopes_of_rate(&self, x: Scalar<'_>) -> Vec<(usize, Expr)> {
        let slopes = self.velocities.iter().enumerate().map(|(at, &velocity)| (at, x.partial(velocity)));
        slopes.filter(|(_, slope)| !slope.is_zero()).map(|(at, slope)| (at, slope.expr())).collect()
    }

    /// x where all velocities are 0.
    pub fn at_standstill<'a>(&self, x: Scalar<'a>) -> Scalar<'a> {
        let zero = x.algebra().number(0).expr();
        x.substitute(&self.velocities.iter().map(|&velocity| (velocity, zero)).collect())
    }

    /// The part of x, which is linear in the velocities, that they make.
    pub fn part_in_velocities<'a>(&self, x: Scalar<'a>) -> Scalar<'a> {
        let algebra = x.algebra();
        let parts = self.slopes_of_rate(x).into_iter();
        algebra.sum(parts.map(|(at, slope)| algebra.scalar(slope) * self.velocity(algebra, at)))
    }

    /// ẋ, of a function of coordinates and time.
    pub fn rate<'a>(&self, x: Scalar<'a>) -> Scalar<'a> {
        x.derivative(&self.direction(x, true))
    }

    /// ẋ with time held.
    pub fn rate_at_rest<'a>(&self, x: Scalar<'a>) -> Scalar<'a> {
        x.derivative(&self.direction(x, false))
    }

    /// The velocity of a coordinate.
    pub fn velocity<'a>(&self, algebra: &'a Algebra<'a>, coordinate: usize) -> Scalar<'a> {
        algebra.variable(self.velocities[coordinate])
    }

    /// The rates of the symbols of x; that of time only if `has_time`.
    fn direction(&self, x: Scalar<'_>, has_time: bool) -> HashMap<Symbol, Expr> {
        let mut direction = HashMap::default();
        for symbol in x.symbols() {
            if let Some(&coordinate) = self.coordinates.get(&symbol) {
                direction.insert(symbol, self.velocity(x.algebra(), coordinate).expr());
            } else if has_time && symbol == self.time {
                direction.insert(symbol, x.algebra().number(1).expr());
            }
        }
        direction
    }
}
