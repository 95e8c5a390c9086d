//! The schemes.

/// A combination of slopes: (share · h) Σ weights · slopes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row {
    /// The factor of the step that all weights have in common.
    pub share: f64,
    /// The weights of the slopes, that of the first stage first; slopes without one are not
    /// used.
    pub weights: &'static [f64],
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
    /// What leads to the second stage and to those behind it.
    pub stages: &'static [Row],
    /// What leads to the end of the step.
    pub update: Row,
    /// Where it was published.
    pub source: &'static str,
}

/// The most stages that a scheme has.
pub const MOST_STAGES: usize = 4;

/// All schemes.
pub const SCHEMES: [&Tableau; 2] = [&HEUN, &RK4];

/// Heun's method, the scheme of a mechanism that asks for none.
pub const HEUN: Tableau = Tableau {
    word: "heun",
    type_name: "Heun",
    title: "Heun's method",
    order: 2,
    stages: &[row(1.0, &[1.0])],
    update: row(0.5, &[1.0, 1.0]),
    source: "K. Heun, Z. Math. Phys. 45 (1900) 23-38",
};

/// The classical Runge–Kutta method.
pub const RK4: Tableau = Tableau {
    word: "rk4",
    type_name: "Rk4",
    title: "the classical Runge-Kutta method",
    order: 4,
    stages: &[row(0.5, &[1.0]), row(0.5, &[0.0, 1.0]), row(1.0, &[0.0, 0.0, 1.0])],
    update: row(1.0 / 6.0, &[1.0, 2.0, 2.0, 1.0]),
    source: "W. Kutta, Z. Math. Phys. 46 (1901) 435-453",
};

const fn row(share: f64, weights: &'static [f64]) -> Row {
    Row { share, weights }
}

impl Row {
    /// The time that it leads to, in steps: c = share · Σ weights.
    #[inline(always)]
    pub const fn node(&self) -> f64 {
        let (mut sum, mut at) = (0.0, 0);
        while at < self.weights.len() {
            sum += self.weights[at];
            at += 1;
        }
        self.share * sum
    }

    /// The stages whose slopes it uses, and their weights.
    #[inline(always)]
    pub fn terms(&self) -> impl Iterator<Item = (usize, f64)> {
        self.weights.iter().copied().enumerate().filter(|(_, weight)| *weight != 0.0)
    }
}

impl Tableau {
    /// How many stages a step has.
    #[inline(always)]
    pub const fn stage_count(&self) -> usize {
        self.stages.len() + 1
    }

    /// Whether both are the same scheme, which its word tells.
    pub const fn is(&self, other: &Self) -> bool {
        let (a, b) = (self.word.as_bytes(), other.word.as_bytes());
        let mut at = 0;
        while at < a.len() && at < b.len() && a[at] == b[at] {
            at += 1;
        }
        at == a.len() && at == b.len()
    }

    /// The scheme with this word.
    pub fn find(word: &str) -> Option<&'static Self> {
        SCHEMES.into_iter().find(|scheme| scheme.word == word)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The conditions of order for the elementary differentials up to order 4 (Hairer,
    /// Nørsett, Wanner, Solving Ordinary Differential Equations I, II.2): Σ bᵢ Φᵢ = 1/γ.
    #[test]
    fn every_scheme_has_its_order_and_no_higher_one() {
        for scheme in SCHEMES {
            let count = scheme.stage_count();
            let b = |i: usize| weight(&scheme.update, i);
            let a = |i: usize, j: usize| if i == 0 { 0.0 } else { weight(&scheme.stages[i - 1], j) };
            let c = |i: usize| if i == 0 { 0.0 } else { scheme.stages[i - 1].node() };
            let all = || 0..count;
            let ac = |i: usize| all().map(|j| a(i, j) * c(j)).sum::<f64>();
            let acc = |i: usize| all().map(|j| a(i, j) * c(j) * c(j)).sum::<f64>();
            let aac = |i: usize| all().map(|j| a(i, j) * ac(j)).sum::<f64>();
            let sum = |of: &dyn Fn(usize) -> f64| all().map(|i| b(i) * of(i)).sum::<f64>();
            let conditions = [
                (1, sum(&|_| 1.0), 1.0),
                (2, sum(&c), 1.0 / 2.0),
                (3, sum(&|i| c(i) * c(i)), 1.0 / 3.0),
                (3, sum(&ac), 1.0 / 6.0),
                (4, sum(&|i| c(i) * c(i) * c(i)), 1.0 / 4.0),
                (4, sum(&|i| c(i) * ac(i)), 1.0 / 8.0),
                (4, sum(&acc), 1.0 / 12.0),
                (4, sum(&aac), 1.0 / 24.0),
                (5, sum(&|i| c(i) * c(i) * c(i) * c(i)), 1.0 / 5.0),
            ];
            // sums of at most four terms below 1
            let is_met = |(_, found, expected): &&(u32, f64, f64)| (found - expected).abs() < 1e-15;
            let is_of = |order: u32| conditions.iter().filter(move |(of, ..)| *of == order);
            for order in 1..=scheme.order {
                assert!(is_of(order).all(|condition| is_met(&condition)), "{}: {order}", scheme.word);
            }
            assert!(!is_of(scheme.order + 1).all(|condition| is_met(&condition)), "{}", scheme.word);
        }
    }

    fn weight(row: &Row, at: usize) -> f64 {
        row.weights.get(at).map_or(0.0, |weight| row.share * weight)
    }

    #[test]
    fn words_and_sizes_fit() {
        for (at, scheme) in SCHEMES.into_iter().enumerate() {
            assert!(
                scheme.stage_count() <= MOST_STAGES && scheme.update.weights.len() <= scheme.stage_count()
            );
            let is_explicit = |(at, row): (usize, &Row)| row.weights.len() <= at + 1;
            assert!(scheme.stages.iter().enumerate().all(is_explicit));
            assert_eq!(Tableau::find(scheme.word), Some(SCHEMES[at]));
            assert!(SCHEMES.iter().enumerate().all(|(of, other)| scheme.is(other) == (of == at)));
        }
        assert_eq!(Tableau::find("euler"), None);
    }
}
