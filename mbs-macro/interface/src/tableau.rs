//! The table of a scheme.

use crate::SCHEMES;
use crate::interpolant::Interpolant;
use crate::response::Response;

/// The most stages that a scheme has.
pub const MOST_STAGES: usize = 12;

/// A combination of slopes: (share · h) Σ weights · slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The factor of the step that all weights have in common.
    pub share: f64,
    /// The weights of the slopes, that of the first stage first; slopes without one are not
    /// used.
    pub weights: &'static [f64],
}

/// An estimate of the error of a step, from its own slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// The differences from the results of schemes of lower order. A row may have a weight more
    /// than there are stages: that of the slope at the end of the step, which is the first slope
    /// of the next one.
    ///
    /// With two rows e and ē the error is taken as ‖e‖²/√(‖e‖² + 0.01‖ē‖²).
    pub differences: &'static [Row],
    /// The estimate falls with this power of the step.
    pub power: u32,
}

/// An explicit Runge–Kutta scheme.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tableau {
    /// The word that asks for it, in a declaration and on the command line.
    pub word: &'static str,
    /// The name of its type in the runtime.
    pub type_name: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// The error of a step is O(h^(order + 1)).
    pub order: u32,
    /// The rows that lead to the second stage and to those behind it.
    pub stages: &'static [Row],
    /// The row that leads to the end of the step.
    pub update: Row,
    /// The estimate of the error of a step; `None` if the scheme has none.
    pub estimate: Option<Estimate>,
    /// The interpolant of a step. `None` if the polynomial of fifth degree through positions, velocities and
    /// accelerations of both ends is as accurate as the step.
    pub interpolant: Option<Interpolant>,
    /// Where it was published.
    pub source: &'static str,
    /// The response to linear problems, which follows from the coefficients.
    pub response: Response,
}

/// Bound of the rounding error of a sum of weights that is 1.
const ROUNDING: f64 = 1e-13;

impl Row {
    /// The time that it leads to, in steps: c = share · Σ weights; 1 for the end of a step, which rounding of
    /// the sum would miss.
    #[inline(always)]
    pub const fn node(&self) -> f64 {
        let (mut sum, mut weights) = (0.0, self.weights);
        while let [weight, rest @ ..] = weights {
            sum += *weight;
            weights = rest;
        }
        let node = self.share * sum;
        let is_end = 1.0 - ROUNDING < node && node < 1.0 + ROUNDING;
        if is_end { 1.0 } else { node }
    }

    /// The stages whose slopes it uses, and their weights.
    #[inline(always)]
    pub fn terms(&self) -> impl Iterator<Item = (usize, f64)> {
        self.weights.iter().copied().enumerate().filter(|(_, weight)| *weight != 0.0)
    }
}

impl Tableau {
    /// The number of stages of a step.
    #[inline(always)]
    pub const fn stage_count(&self) -> usize {
        self.stages.len() + 1
    }

    /// Number of additional slopes and of terms of the interpolant; 0 without one.
    #[inline(always)]
    pub const fn interpolated(&self) -> usize {
        match &self.interpolant {
            Some(interpolant) => interpolant.stages.len() + interpolant.terms.len(),
            None => 0,
        }
    }

    /// True if both are the same scheme, which its word tells.
    pub const fn is(&self, other: &Self) -> bool {
        let (mut a, mut b) = (self.word.as_bytes(), other.word.as_bytes());
        while let ([first, rest_a @ ..], [second, rest_b @ ..]) = (a, b) {
            if *first != *second {
                return false;
            }
            (a, b) = (rest_a, rest_b);
        }
        a.is_empty() && b.is_empty()
    }

    /// The scheme with this word.
    pub fn find(word: &str) -> Option<&'static Self> {
        SCHEMES.into_iter().find(|scheme| scheme.word == word)
    }

    /// The same with what follows from its coefficients.
    pub(crate) const fn completed(self) -> Self {
        Self { response: Response::of(self.stages, &self.update), ..self }
    }

    /// True if the length of its steps can follow from a tolerance.
    pub const fn is_adaptive(&self) -> bool {
        self.estimate.is_some()
    }
}
