//! The declared masses, inertias and gravity, in numbers.

use mbs_symbolic::{Expr, Rounded, Symbol, Tape};

use crate::model::{Block, Coordinate, Direction, Model};

/// The mass or inertia of each coordinate, 1 of each own state, and gravity along x and y.
pub struct Bodies {
    pub masses: Vec<Rounded>,
    pub gravity: [Rounded; 2],
}

impl Bodies {
    pub fn new(model: &Model, symbol: &dyn Fn(Symbol) -> f64) -> Self {
        let of = |coordinate: &Coordinate| match coordinate.block {
            Block::Line { body, direction: Direction::Angle } => model.bodies[body].inertia,
            Block::Line { body, .. } => model.bodies[body].mass,
            Block::Own => model.arena.one(),
        };
        let roots: Vec<Expr> = model.gravity.into_iter().chain(model.coordinates.iter().map(of)).collect();
        let mut values = evaluate(model, &roots, symbol).into_iter();
        let gravity = [(); 2].map(|()| values.next().unwrap_or_default());
        Self { masses: values.collect(), gravity }
    }
}

/// The values of expressions.
pub fn evaluate(model: &Model, roots: &[Expr], symbol: &dyn Fn(Symbol) -> f64) -> Vec<Rounded> {
    Tape::new(&model.arena, roots).evaluate(&model.arena, &|s| Rounded::exact(symbol(s)))
}
