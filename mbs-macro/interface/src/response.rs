//! The response of a scheme to linear problems, computed from its coefficients when it is compiled.

use crate::roots::quadratic_factor;
use crate::{MOST_STAGES, Row};

/// How a scheme responds to linear problems.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Response {
    /// The coefficients of the stability function R(z), the constant one first: a step of ẋ = λx
    /// multiplies x with R(hλ).
    pub stability_function: [f64; MOST_STAGES + 1],
    /// a and b of the most damped quadratic factor z² + a z + b of R.
    pub factor: [f64; 2],
    /// m = Σ bᵢ cᵢ and w = Σ bᵢ, with which a constant force acts on e and on ė.
    pub moments: [f64; 2],
}

impl Response {
    /// Of a scheme that is not [`completed`](crate::Tableau::completed).
    pub(crate) const UNKNOWN: Self = Self {
        stability_function: [f64::NAN; MOST_STAGES + 1],
        factor: [f64::NAN; 2],
        moments: [f64::NAN; 2],
    };

    /// That of a scheme.
    pub(crate) const fn of(stages: &[Row], update: &Row) -> Self {
        let stability_function = stability_function(stages, update);
        let moments = moments(stages, update);
        Self { factor: quadratic_factor(&stability_function), stability_function, moments }
    }
}

const fn moments(stages: &[Row], update: &Row) -> [f64; 2] {
    let (mut sum, mut at) = (0.0, 1);
    while at < update.weights.len() {
        sum += update.weights[at] * stages[at - 1].node();
        at += 1;
    }
    [update.share * sum, update.node()]
}

/// R(z) = 1 + z Σ bᵢ pᵢ(z), where pᵢ = 1 + z Σ aᵢⱼ pⱼ(z) is the value in stage i.
const fn stability_function(stages: &[Row], update: &Row) -> [f64; MOST_STAGES + 1] {
    let mut values = [[0.0; MOST_STAGES + 1]; MOST_STAGES + 1];
    values[0][0] = 1.0;
    let count = stages.len() + 1;
    let mut stage = 1;
    while stage <= count {
        let row = if stage == count { update } else { &stages[stage - 1] };
        values[stage][0] = 1.0;
        let mut power = 1;
        while power <= MOST_STAGES {
            let (mut sum, mut of) = (0.0, 0);
            while of < row.weights.len() {
                sum += row.weights[of] * values[of][power - 1];
                of += 1;
            }
            values[stage][power] = row.share * sum;
            power += 1;
        }
        stage += 1;
    }
    values[count]
}
