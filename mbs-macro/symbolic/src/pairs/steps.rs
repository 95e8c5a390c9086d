//! The steps of a program on pairs, and what they compute with.

use mbs_interface::sine::Octant;

use crate::arena::Symbol;
use crate::number::Number;
use crate::program::Operation;

/// One of the two lanes of a pair.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Lane {
    /// The first.
    First,
    /// The second.
    Second,
}

/// A scalar that is there before the first step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Given {
    /// A constant.
    Number(Number),
    /// An input.
    Symbol(Symbol),
    /// A value that depends on parameters alone.
    Hoisted(usize),
}

/// Where a step finds a scalar.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Scalar {
    /// A number, a symbol or a hoisted value.
    Given(Given),
    /// The result of an earlier scalar step.
    Step(usize),
    /// A lane of an earlier pair.
    Lane(usize, Lane),
}

impl Scalar {
    /// The step that it is found in.
    pub fn step(&self) -> Option<usize> {
        match *self {
            Self::Given(_) => None,
            Self::Step(at) | Self::Lane(at, _) => Some(at),
        }
    }

    /// The same where steps have other positions.
    pub(super) fn renamed(&self, position: impl Fn(usize) -> usize) -> Self {
        match *self {
            Self::Given(given) => Self::Given(given),
            Self::Step(at) => Self::Step(position(at)),
            Self::Lane(at, lane) => Self::Lane(position(at), lane),
        }
    }
}

/// Where an operation of a sine finds a pair.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Term {
    /// A constant in both lanes.
    Constant(f64),
    /// The result of an earlier step.
    Step(usize),
}

impl Term {
    pub(super) fn step(&self) -> Option<usize> {
        match *self {
            Self::Constant(_) => None,
            Self::Step(at) => Some(at),
        }
    }

    /// The same where steps have other positions.
    pub(super) fn renamed(&self, position: impl Fn(usize) -> usize) -> Self {
        match *self {
            Self::Constant(constant) => Self::Constant(constant),
            Self::Step(at) => Self::Step(position(at)),
        }
    }
}

/// A step of a program on pairs; pairs are named by the position of their steps.
#[derive(Clone, Debug, PartialEq)]
pub enum Step {
    /// A scalar, by an operation on scalars (the second is the first again where
    /// the operation has one operand); its name, if one was suggested.
    Scalar(Operation, Scalar, Scalar, Option<String>),
    /// A pair of two scalars.
    Join(Scalar, Scalar),
    /// A scalar in both lanes.
    Splat(Scalar),
    /// A pair with its lanes exchanged.
    Swap(usize),
    /// A pair with its second lane negated.
    Flip(usize),
    /// An operation on two pairs: `Add`, `Sub`, `Mul` or `Div`, or the magnitude of one that is given
    /// twice.
    Pair(Operation, usize, usize),
    /// A pair of angles as a term of their sines.
    Angles(usize),
    /// The shift that is taken back from a pair of angles: NaN for one that is out of range.
    ShiftBack(usize),
    /// A binary operation on two terms of sines: `Add`, `Sub` or `Mul`.
    Term(Operation, Term, Term),
    /// The sines of a pair of angles, from those without quarter turns; the step after it has the
    /// cosines.
    Sines(usize, Octant<Term>),
    /// The cosines of the same pair of angles.
    Cosines(usize),
}

impl Step {
    /// The scalars that it takes.
    pub(super) fn scalars(&self) -> impl Iterator<Item = &Scalar> {
        let scalars = match self {
            Self::Scalar(_, a, b, _) | Self::Join(a, b) => [Some(a), Some(b)],
            Self::Splat(a) => [Some(a), None],
            _ => [None, None],
        };
        scalars.into_iter().flatten()
    }

    /// The steps whose results it takes.
    pub(super) fn operands(&self) -> impl Iterator<Item = usize> {
        let operands = match self {
            Self::Scalar(_, a, b, _) | Self::Join(a, b) => [a.step(), b.step(), None, None],
            Self::Splat(a) => [a.step(), None, None, None],
            Self::Swap(of) | Self::Flip(of) | Self::Angles(of) | Self::ShiftBack(of) | Self::Cosines(of) => {
                [Some(*of), None, None, None]
            }
            Self::Pair(_, a, b) => [Some(*a), Some(*b), None, None],
            Self::Term(_, a, b) => [a.step(), b.step(), None, None],
            Self::Sines(of, Octant { shifted, sine, cosine }) => {
                [Some(*of), shifted.step(), sine.step(), cosine.step()]
            }
        };
        operands.into_iter().flatten()
    }

    /// The same where steps have other positions.
    pub(super) fn renamed(&self, position: impl Fn(usize) -> usize) -> Self {
        match self {
            Self::Scalar(operation, a, b, name) => {
                Self::Scalar(*operation, a.renamed(&position), b.renamed(&position), name.clone())
            }
            Self::Join(a, b) => Self::Join(a.renamed(&position), b.renamed(&position)),
            Self::Splat(a) => Self::Splat(a.renamed(&position)),
            Self::Swap(of) => Self::Swap(position(*of)),
            Self::Flip(of) => Self::Flip(position(*of)),
            Self::Pair(operation, a, b) => Self::Pair(*operation, position(*a), position(*b)),
            Self::Angles(of) => Self::Angles(position(*of)),
            Self::ShiftBack(of) => Self::ShiftBack(position(*of)),
            Self::Term(operation, a, b) => Self::Term(*operation, a.renamed(&position), b.renamed(&position)),
            Self::Sines(of, Octant { shifted, sine, cosine }) => {
                let [shifted, sine, cosine] = [shifted, sine, cosine].map(|term| term.renamed(&position));
                Self::Sines(position(*of), Octant { shifted, sine, cosine })
            }
            Self::Cosines(of) => Self::Cosines(position(*of)),
        }
    }
}
