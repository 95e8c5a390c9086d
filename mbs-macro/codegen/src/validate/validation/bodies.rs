//! The declared masses, inertias and gravity, in numbers.

use std::collections::BTreeMap;

use mbs_symbolic::{Expr, Rounded, Symbol, Tape};

use super::Jet;
use crate::mechanics::Particle;
use crate::model::{Block, Coordinate, Direction, Meaning, Model};

/// The mass or inertia of each coordinate, 1 of each own state, gravity along x and y, and particles.
pub struct Bodies {
    /// Of each coordinate, without particles.
    pub own: Vec<Rounded>,
    pub gravity: [Rounded; 2],
    pub particles: Vec<Moved>,
    /// M over pairs of coordinates, the first one not behind the second.
    pub masses: BTreeMap<(usize, usize), Rounded>,
}

/// A particle that moves.
pub struct Moved {
    pub mass: Rounded,
    /// x and y, each with its rate and with its second derivative where velocities do not change.
    pub place: [Jet; 2],
    /// ∂x/∂q and ∂y/∂q of the coordinates that it moves with.
    pub columns: Vec<(usize, [Rounded; 2])>,
}

impl Bodies {
    pub fn new(model: &Model, symbol: &dyn Fn(Symbol) -> f64) -> Self {
        let of = |coordinate: &Coordinate| match coordinate.block {
            Block::Line { body, direction: Direction::Angle } => model.bodies[body].inertia,
            Block::Line { body, .. } => model.bodies[body].mass,
            Block::Free => model.arena.zero(),
            Block::Own => model.arena.one(),
        };
        let roots: Vec<Expr> = model.gravity.into_iter().chain(model.coordinates.iter().map(of)).collect();
        let mut values = evaluate(model, &roots, symbol).into_iter();
        let gravity = [(); 2].map(|()| values.next().unwrap_or_default());
        let own: Vec<_> = values.collect();
        let mut masses: BTreeMap<_, _> = own.iter().enumerate().map(|(at, &mass)| ((at, at), mass)).collect();
        let particles: Vec<_> =
            model.particles.iter().map(|particle| Moved::new(model, particle, symbol)).collect();
        for particle in &particles {
            for (at, (i, a)) in particle.columns.iter().enumerate() {
                for (j, b) in &particle.columns[at..] {
                    let entry = masses.entry((*i.min(j), *i.max(j))).or_default();
                    *entry = *entry + particle.mass * dot(*a, *b);
                }
            }
        }
        Self { own, gravity, particles, masses }
    }
}

impl Moved {
    fn new(model: &Model, particle: &Particle, symbol: &dyn Fn(Symbol) -> f64) -> Self {
        let place = particle.place.components();
        let tape = Tape::new(&model.arena, &place);
        let along = |speed: &dyn Fn(usize) -> f64| -> [Jet; 2] {
            let jets = tape.jets(&model.arena, &|s| {
                let speed = match model.meanings.get(s.index()) {
                    Some(Meaning::Coordinate(at)) => speed(*at),
                    _ => 0.0,
                };
                let [value, first, second] = [symbol(s), speed, 0.0].map(Rounded::exact);
                Jet { value, first, second }
            });
            [0, 1].map(|at| jets[at])
        };
        let symbols = place.into_iter().flat_map(|x| model.arena.symbols_in(x));
        let mut coordinates: Vec<usize> = symbols
            .filter_map(|s| match model.meanings.get(s.index()) {
                Some(Meaning::Coordinate(at)) => Some(*at),
                _ => None,
            })
            .collect();
        coordinates.sort_unstable();
        coordinates.dedup();
        let column = |at: usize| (at, along(&|other| f64::from(other == at)).map(|x| x.first));
        Self {
            mass: evaluate(model, &[particle.mass], symbol).first().copied().unwrap_or_default(),
            place: along(&|at| symbol(model.coordinates[at].velocity)),
            columns: coordinates.into_iter().map(column).collect(),
        }
    }
}

/// a·b
pub fn dot(a: [Rounded; 2], b: [Rounded; 2]) -> Rounded {
    a[0] * b[0] + a[1] * b[1]
}

/// The values of expressions.
pub fn evaluate(model: &Model, roots: &[Expr], symbol: &dyn Fn(Symbol) -> f64) -> Vec<Rounded> {
    Tape::new(&model.arena, roots).evaluate(&model.arena, &|s| Rounded::exact(symbol(s)))
}
