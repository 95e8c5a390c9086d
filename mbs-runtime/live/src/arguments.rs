//! Arguments of the functions of a mechanism.

use mbs_runtime::Real;

/// Arguments of a function, `C` numbers each. Those that the function does not read may be left
/// empty; one that it reads and does not find is no number.
#[derive(Clone, Copy, Debug)]
pub struct Arguments<'a, T = f64, const C: usize = 1> {
    /// t in s
    pub t: [T; C],
    /// q, or of a step what of it is integrated
    pub q: &'a [[T; C]],
    /// v, or of a step what of it is integrated
    pub v: &'a [[T; C]],
    /// The inputs.
    pub inputs: &'a [[T; C]],
    /// −2α and −β²
    pub gains: [[T; C]; 2],
    /// Amounts added to γ; of corrections, the residual.
    pub feedback: &'a [[T; C]],
    /// q̈; of an implicit stage, what is predicted of it
    pub acceleration: &'a [[T; C]],
    /// λ
    pub multipliers: &'a [[T; C]],
    /// h of a step, in s.
    pub step: [T; C],
    /// t + h in s
    pub t_next: [T; C],
    /// The share of the step that an implicit stage has of its own slope, in s.
    pub shift: [T; C],
    /// Of a transposed program, how much each result of the program counts.
    pub weights: &'a [[T; C]],
}

impl<T: Real, const C: usize> Default for Arguments<'_, T, C> {
    fn default() -> Self {
        let none = [T::from_f64(f64::NAN); C];
        Self {
            t: none,
            q: &[],
            v: &[],
            inputs: &[],
            gains: [none; 2],
            feedback: &[],
            acceleration: &[],
            multipliers: &[],
            step: none,
            t_next: none,
            shift: none,
            weights: &[],
        }
    }
}

/// Where an argument of a program is found in [`Arguments`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Given {
    Time,
    Step,
    HalfStep,
    NextTime,
    Shift,
    MinusTwoAlpha,
    MinusBetaSquared,
    Position(usize),
    Velocity(usize),
    Input(usize),
    Acceleration(usize),
    Multiplier(usize),
    Feedback(usize),
    Weight(usize),
}

impl<T: Real, const C: usize> Arguments<'_, T, C> {
    /// An argument.
    #[inline(always)]
    pub(crate) fn read(&self, given: Given) -> [T; C] {
        let (vector, at) = match given {
            Given::Time => return self.t,
            Given::Step => return self.step,
            Given::HalfStep => return self.step.map(|step| T::from_f64(0.5) * step),
            Given::NextTime => return self.t_next,
            Given::Shift => return self.shift,
            Given::MinusTwoAlpha => return self.gains[0],
            Given::MinusBetaSquared => return self.gains[1],
            Given::Position(at) => (self.q, at),
            Given::Velocity(at) => (self.v, at),
            Given::Input(at) => (self.inputs, at),
            Given::Acceleration(at) => (self.acceleration, at),
            Given::Multiplier(at) => (self.multipliers, at),
            Given::Feedback(at) => (self.feedback, at),
            Given::Weight(at) => (self.weights, at),
        };
        vector.get(at).copied().unwrap_or([T::from_f64(f64::NAN); C])
    }
}
