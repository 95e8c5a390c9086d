//! The operations of sines and cosines as steps of their own.
//!
//! A sine and a cosine are some fifty operations, among which those of other results find time. They are
//! recorded from `mbs_interface::sine`, the formula that the runtime evaluates.

use std::cell::RefCell;
use std::ops::{Add, Mul, Sub};

use mbs_interface::sine::Octant;

use super::steps::{Step, Term};
use crate::program::Operation;

/// Appends the sines and cosines of the pair of angles `of`, and returns the step of the sines.
pub(super) fn push(steps: &mut Vec<Step>, of: usize) -> usize {
    let tape = Tape(RefCell::new(std::mem::take(steps)));
    let (angles, shift_back) = (tape.push(Step::Angles(of)), tape.push(Step::ShiftBack(of)));
    let recorded = Octant::new(angles, shift_back, |constant| tape.term(Term::Constant(constant)));
    let [shifted, sine, cosine] = [recorded.shifted, recorded.sine, recorded.cosine].map(|of| of.term);
    *steps = tape.0.into_inner();
    let sines = steps.len();
    steps.extend([Step::Sines(of, Octant { shifted, sine, cosine }), Step::Cosines(of)]);
    sines
}

/// Takes down the operations of a formula that is evaluated on [`Recorded`] terms.
struct Tape(RefCell<Vec<Step>>);

impl Tape {
    fn term(&self, term: Term) -> Recorded<'_> {
        Recorded { tape: self, term }
    }

    fn push(&self, step: Step) -> Recorded<'_> {
        let mut steps = self.0.borrow_mut();
        steps.push(step);
        self.term(Term::Step(steps.len() - 1))
    }
}

/// A term, and where operations with it are taken down.
#[derive(Clone, Copy)]
struct Recorded<'a> {
    tape: &'a Tape,
    term: Term,
}

macro_rules! operators {
    ($($Operator:ident $operator:ident),*) => {$(
        impl $Operator for Recorded<'_> {
            type Output = Self;

            fn $operator(self, other: Self) -> Self {
                self.tape.push(Step::Term(Operation::$Operator, self.term, other.term))
            }
        }
    )*};
}

operators!(Add add, Sub sub, Mul mul);
