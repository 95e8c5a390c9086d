//! Compositions: steps made of steps of a symmetric method.

/// Steps of RATTLE, one after the other, as shares of a whole step.
///
/// A symmetric method of second order, composed with shares γ₁ … γₛ that are symmetric, add up to
/// 1 and have Σ γᵢ³ = 0, is of fourth order, and as symplectic as the method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Composition {
    /// The word that asks for it on the command line.
    pub word: &'static str,
    /// Its name for people.
    pub title: &'static str,
    /// The error of a step is O(h^(order + 1)).
    pub order: u32,
    /// γ₁ … γₛ
    pub shares: &'static [f64],
    /// Where it was published.
    pub source: &'static str,
}

/// 1/(4 − ∛4)
const SUZUKI: f64 = 0.414_490_771_794_375_74;

/// RATTLE itself.
pub const RATTLE: Composition = Composition {
    word: "rattle",
    title: "RATTLE",
    order: 2,
    shares: &[1.0],
    source: "H. C. Andersen, J. Comput. Phys. 52 (1983) 24-34",
};

/// Five steps of RATTLE, the third of which goes back.
pub const RATTLE4: Composition = Composition {
    word: "rattle4",
    title: "RATTLE, composed to fourth order",
    order: 4,
    shares: &[SUZUKI, SUZUKI, 1.0 - 4.0 * SUZUKI, SUZUKI, SUZUKI],
    source: "M. Suzuki, Phys. Lett. A 146 (1990) 319-323",
};

/// All compositions.
pub const COMPOSITIONS: [&Composition; 2] = [&RATTLE, &RATTLE4];

impl Composition {
    /// The composition with this word.
    pub fn find(word: &str) -> Option<&'static Self> {
        COMPOSITIONS.into_iter().find(|composition| composition.word == word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// To roundings of sums of five terms of order 1.
    #[test]
    fn shares_meet_the_conditions_of_their_order() {
        for composition in COMPOSITIONS {
            let shares = composition.shares;
            assert!((shares.iter().sum::<f64>() - 1.0).abs() < 1e-15, "{}", composition.word);
            assert!(shares.iter().eq(shares.iter().rev()));
            let cubes: f64 = shares.iter().map(|share| share.powi(3)).sum();
            assert_eq!(cubes.abs() < 1e-15, composition.order == 4, "{}: {cubes}", composition.word);
            assert_eq!(Composition::find(composition.word), Some(composition));
        }
    }
}
