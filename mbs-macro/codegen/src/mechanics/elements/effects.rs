//! An element to compute with, and what comes of it.

use std::collections::BTreeMap;

use mbs_symbolic::units::Dimension;
use mbs_symbolic::{Algebra, Expr, Scalar, Vector};

use crate::mechanics::{Applied, Motion, Outline, Placed, Work};

/// An element with its places found and its properties read.
pub struct Element<'a> {
    pub algebra: &'a Algebra<'a>,
    pub first: Placed<Scalar<'a>>,
    /// The first again where there is no second.
    pub second: Placed<Scalar<'a>>,
    /// A direction on the second body; (1, 0) without one.
    pub along: Vector<Scalar<'a>>,
    /// Components by name: one of a scalar, two of a vector.
    pub values: BTreeMap<&'static str, Vec<Expr>>,
    /// Where it may stick: the memories of which way it slides, and of the force that holds it.
    pub memories: Option<[Expr; 2]>,
    /// Its own state, where it has one.
    pub state: Option<Expr>,
    /// The outlines about its places.
    pub outlines: [Outline<Scalar<'a>>; 2],
    /// The words that it gives.
    pub words: BTreeMap<&'static str, &'static str>,
}

impl<'a> Element<'a> {
    pub fn get(&self, property: &str) -> Option<Scalar<'a>> {
        self.values.get(property)?.first().map(|&value| self.algebra.scalar(value))
    }

    /// The value of a property, or 0 if it was left out.
    pub fn get_or_zero(&self, property: &str) -> Scalar<'a> {
        self.get(property).unwrap_or_else(|| self.algebra.number(0))
    }

    pub fn vector(&self, property: &str) -> Option<Vector<Scalar<'a>>> {
        let &[x, y] = self.values.get(property)?.as_slice() else { return None };
        Some(self.algebra.vector([x, y]))
    }

    /// φ₁ − φ₂
    pub fn relative_angle(&self) -> Scalar<'a> {
        self.first.angle - self.second.angle
    }
}

/// The forces, energies and other effects of an element.
pub struct Effects<'m> {
    motion: &'m Motion,
    pub applied: Vec<Applied>,
    /// Energies that it holds.
    pub energies: Vec<Expr>,
    /// The scalar that it exerts.
    pub exerts: Option<Exerts>,
    /// A distance that must not vanish, and its value without force.
    pub gap: Option<(Expr, Expr)>,
    /// Dry friction that sticks.
    pub sticks: Option<Sticks>,
    /// The rate of its own state.
    pub state_rate: Option<Expr>,
}

/// Dry friction that holds still what does not overcome it.
#[derive(Clone, Copy)]
pub struct Sticks {
    /// The way that it has slid.
    pub slip: Expr,
    /// The size of the force while it slides, and the largest one with which it sticks.
    pub limits: [Expr; 2],
}

/// A tension, a friction force, a torque.
#[derive(Clone, Copy)]
pub struct Exerts {
    pub value: Expr,
    pub dimension: Dimension,
}

impl<'m> Effects<'m> {
    /// None yet.
    pub fn new(motion: &'m Motion) -> Self {
        Self {
            motion,
            applied: Vec::new(),
            energies: Vec::new(),
            exerts: None,
            gap: None,
            sticks: None,
            state_rate: None,
        }
    }

    /// ẋ
    pub fn rate<'a>(&self, x: Scalar<'a>) -> Scalar<'a> {
        self.motion.rate(x)
    }

    /// Adds a force F that does the virtual work F δs.
    pub fn apply(&mut self, force: Scalar<'_>, s: Scalar<'_>) {
        let work = Work::along(self.motion, force, s);
        self.applied.push(work.applied(force.algebra(), self.motion));
    }

    /// Adds the energy ½ k s².
    pub fn store<'a>(&mut self, stiffness: Scalar<'a>, s: Scalar<'a>) {
        self.energies.push((stiffness * s.squared() / 2).expr());
    }

    /// Says what it exerts.
    pub fn exert(&mut self, value: Scalar<'_>, dimension: Dimension) {
        self.exerts = Some(Exerts { value: value.expr(), dimension });
    }
}
