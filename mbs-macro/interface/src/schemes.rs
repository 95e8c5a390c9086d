//! The schemes, from the one of lowest order to that of highest.
//!
//! # A new scheme
//!
//! A scheme is a constant here and its line in `explicit_schemes!`, by which the runtime has a type for it.
//! A test derives the conditions of its order from all rooted trees. Stability of feedback, and the gains
//! that remove a violation fastest, follow from the table.

use crate::interpolant::OF_DOP853;
use crate::response::Response;
use crate::{Estimate, Row, Tableau};

/// Calls a macro with a line per explicit scheme: the documentation and the name of its type, and its table.
#[macro_export]
macro_rules! explicit_schemes {
    ($call:ident) => {
        $call! {
            /// Heun's method: second order, two evaluations of the right-hand side per step. The
            /// scheme of a mechanism that declares none.
            Heun = $crate::schemes::HEUN;
            /// The pair 3(2) of Bogacki and Shampine: third order, three evaluations per step. For
            /// coarse tolerances.
            Bs3 = $crate::schemes::BS3;
            /// The scheme of Shu and Osher: third order, three evaluations per step. Each stage is a mean of Euler's
            /// steps, so that a bound that these keep (of a friction force, of a flow that only falls) is kept by it.
            Ssp3 = $crate::schemes::SSP3;
            /// The classical Runge–Kutta method: fourth order, four evaluations per step.
            Rk4 = $crate::schemes::RK4;
            /// The pair 5(4) of Dormand and Prince: fifth order, six evaluations per step. The scheme
            /// of runs to a tolerance that ask for no other.
            Dopri5 = $crate::schemes::DOPRI5;
            /// The scheme 8(5,3) of Dormand and Prince: eighth order, twelve evaluations per step. For
            /// fine tolerances.
            Dop853 = $crate::schemes::DOP853;
        }
    };
}

macro_rules! list {
    ($($(#[$doc:meta])* $name:ident = $tableau:path;)*) => {
        /// All schemes.
        pub const SCHEMES: [&Tableau; [$(stringify!($name)),*].len()] = [$(&$tableau),*];
    };
}

explicit_schemes!(list);

pub(crate) const fn row(share: f64, weights: &'static [f64]) -> Row {
    Row { share, weights }
}

/// Heun's method, the scheme of a mechanism that asks for none.
pub const HEUN: Tableau = Tableau {
    word: "heun",
    type_name: "Heun",
    title: "Heun's method",
    order: 2,
    stages: &[row(1.0, &[1.0])],
    update: row(0.5, &[1.0, 1.0]),
    estimate: None,
    interpolant: None,
    source: "K. Heun, Z. Math. Phys. 45 (1900) 23-38",
    response: Response::UNKNOWN,
}
.completed();

/// The pair 3(2) of Bogacki and Shampine.
pub const BS3: Tableau = Tableau {
    word: "bs3",
    type_name: "Bs3",
    title: "the pair 3(2) of Bogacki and Shampine",
    order: 3,
    stages: &[row(0.5, &[1.0]), row(0.75, &[0.0, 1.0])],
    update: row(1.0 / 9.0, &[2.0, 3.0, 4.0]),
    estimate: Some(Estimate { differences: &[row(1.0 / 72.0, &[-5.0, 6.0, 8.0, -9.0])], power: 3 }),
    interpolant: None,
    source: "P. Bogacki, L. F. Shampine, Appl. Math. Lett. 2 (1989) 321-325",
    response: Response::UNKNOWN,
}
.completed();

/// The third-order scheme of Shu and Osher that preserves strong stability.
pub const SSP3: Tableau = Tableau {
    word: "ssp3",
    type_name: "Ssp3",
    title: "the strong-stability-preserving scheme of Shu and Osher",
    order: 3,
    stages: &[row(1.0, &[1.0]), row(0.25, &[1.0, 1.0])],
    update: row(1.0 / 6.0, &[1.0, 1.0, 4.0]),
    estimate: None,
    interpolant: None,
    source: "C.-W. Shu, S. Osher, J. Comput. Phys. 77 (1988) 439-471",
    response: Response::UNKNOWN,
}
.completed();

/// The classical Runge–Kutta method.
pub const RK4: Tableau = Tableau {
    word: "rk4",
    type_name: "Rk4",
    title: "the classical Runge-Kutta method",
    order: 4,
    stages: &[row(0.5, &[1.0]), row(0.5, &[0.0, 1.0]), row(1.0, &[0.0, 0.0, 1.0])],
    update: row(1.0 / 6.0, &[1.0, 2.0, 2.0, 1.0]),
    estimate: None,
    interpolant: None,
    source: "W. Kutta, Z. Math. Phys. 46 (1901) 435-453",
    response: Response::UNKNOWN,
}
.completed();

/// The pair 5(4) of Dormand and Prince.
pub const DOPRI5: Tableau = Tableau {
    word: "dopri5",
    type_name: "Dopri5",
    title: "the pair 5(4) of Dormand and Prince",
    order: 5,
    stages: &[
        row(0.2, &[1.0]),
        row(1.0 / 40.0, &[3.0, 9.0]),
        row(1.0 / 45.0, &[44.0, -168.0, 160.0]),
        row(1.0 / 6561.0, &[19372.0, -76080.0, 64448.0, -1908.0]),
        row(1.0, &[9017.0 / 3168.0, -355.0 / 33.0, 46732.0 / 5247.0, 49.0 / 176.0, -5103.0 / 18656.0]),
    ],
    update: row(1.0, &[35.0 / 384.0, 0.0, 500.0 / 1113.0, 125.0 / 192.0, -2187.0 / 6784.0, 11.0 / 84.0]),
    estimate: Some(Estimate {
        differences: &[row(
            1.0,
            &[
                71.0 / 57600.0,
                0.0,
                -71.0 / 16695.0,
                71.0 / 1920.0,
                -17253.0 / 339_200.0,
                22.0 / 525.0,
                -1.0 / 40.0,
            ],
        )],
        power: 5,
    }),
    interpolant: None,
    source: "J. R. Dormand, P. J. Prince, J. Comp. Appl. Math. 6 (1980) 19-26",
    response: Response::UNKNOWN,
}
.completed();

/// The scheme of order 8 of Dormand and Prince, with the estimate 5(3) of Hairer and Wanner.
pub const DOP853: Tableau = Tableau {
    word: "dop853",
    type_name: "Dop853",
    title: "the scheme 8(5,3) of Dormand and Prince",
    order: 8,
    stages: &[
        row(1.0, &[0.05260015195876773]),
        row(1.0, &[0.0197250569845379, 0.0591751709536137]),
        row(1.0, &[0.02958758547680685, 0.0, 0.08876275643042054]),
        row(1.0, &[0.2413651341592667, 0.0, -0.8845494793282861, 0.924834003261792]),
        row(1.0, &[0.037037037037037035, 0.0, 0.0, 0.17082860872947386, 0.12546768756682242]),
        row(1.0, &[0.037109375, 0.0, 0.0, 0.17025221101954405, 0.06021653898045596, -0.017578125]),
        row(
            1.0,
            &[
                0.03709200011850479,
                0.0,
                0.0,
                0.17038392571223998,
                0.10726203044637328,
                -0.015319437748624402,
                0.008273789163814023,
            ],
        ),
        row(
            1.0,
            &[
                0.6241109587160757,
                0.0,
                0.0,
                -3.3608926294469414,
                -0.868219346841726,
                27.59209969944671,
                20.154067550477894,
                -43.48988418106996,
            ],
        ),
        row(
            1.0,
            &[
                0.47766253643826434,
                0.0,
                0.0,
                -2.4881146199716677,
                -0.590290826836843,
                21.230051448181193,
                15.279233632882423,
                -33.28821096898486,
                -0.020331201708508627,
            ],
        ),
        row(
            1.0,
            &[
                -0.9371424300859873,
                0.0,
                0.0,
                5.186372428844064,
                1.0914373489967295,
                -8.149787010746927,
                -18.52006565999696,
                22.739487099350505,
                2.4936055526796523,
                -3.0467644718982196,
            ],
        ),
        row(
            1.0,
            &[
                2.273310147516538,
                0.0,
                0.0,
                -10.53449546673725,
                -2.0008720582248625,
                -17.9589318631188,
                27.94888452941996,
                -2.8589982771350235,
                -8.87285693353063,
                12.360567175794303,
                0.6433927460157636,
            ],
        ),
    ],
    update: row(
        1.0,
        &[
            0.054293734116568765,
            0.0,
            0.0,
            0.0,
            0.0,
            4.450312892752409,
            1.8915178993145003,
            -5.801203960010585,
            0.3111643669578199,
            -0.1521609496625161,
            0.20136540080403034,
            0.04471061572777259,
        ],
    ),
    estimate: Some(Estimate {
        differences: &[
            row(
                1.0,
                &[
                    0.01312004499419488,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                    -1.2251564463762044,
                    -0.4957589496572502,
                    1.6643771824549864,
                    -0.35032884874997366,
                    0.3341791187130175,
                    0.08192320648511571,
                    -0.022355307863886294,
                ],
            ),
            row(
                1.0,
                &[
                    -0.18980075407240762,
                    0.0,
                    0.0,
                    0.0,
                    0.0,
                    4.450312892752409,
                    1.8915178993145003,
                    -5.801203960010585,
                    -0.42268232132379197,
                    -0.1521609496625161,
                    0.20136540080403034,
                    0.022651792198360825,
                ],
            ),
        ],
        power: 8,
    }),
    interpolant: Some(OF_DOP853),
    source: "E. Hairer, S. P. Norsett, G. Wanner, Solving Ordinary Differential Equations I (1993), II.10",
    response: Response::UNKNOWN,
}
.completed();

#[cfg(test)]
mod tests {
    extern crate std;

    use std::vec::Vec;

    use super::*;
    use crate::MOST_STAGES;
    use crate::trees::{order, rows, trees};

    #[test]
    fn there_are_as_many_trees_as_cayley_counted() {
        let count = |order| trees(9).iter().filter(|tree| tree.order == order).count();
        assert_eq!([1, 2, 3, 4, 5, 6, 7, 8, 9].map(count), [1, 1, 2, 4, 9, 20, 48, 115, 286]);
    }

    /// The conditions of order of Butcher: Σ bᵢ Φᵢ(τ) = 1/γ(τ) for every tree τ up to it (Hairer,
    /// Nørsett, Wanner, Solving Ordinary Differential Equations I, Theorem II.2.13).
    #[test]
    fn every_scheme_has_its_order_and_no_higher_one() {
        for scheme in SCHEMES {
            let found = order(&rows(scheme), &scheme.update, 16.0, |tree| 1.0 / tree.density);
            assert_eq!(found, scheme.order, "{}", scheme.word);
        }
    }

    /// An estimate whose rows are 0 up to the orders p and, with two rows, p̄ falls with
    /// h^(p + 1), or with h^(2 (p + 1) - (p̄ + 1)).
    #[test]
    fn estimates_fall_with_the_power_that_they_say() {
        for scheme in SCHEMES {
            let Some(Estimate { differences, power }) = scheme.estimate else { continue };
            let orders: Vec<u32> =
                differences.iter().map(|row| order(&rows(scheme), row, 16.0, |_| 0.0)).collect();
            let expected = match orders[..] {
                [p] => p + 1,
                [p, lower] => 2 * (p + 1) - (lower + 1),
                _ => unreachable!(),
            };
            assert_eq!(power, expected, "{}: {orders:?}", scheme.word);
        }
    }

    /// The weights of the last row of `dopri5` add up to 0.9999999999999998: steps of C ended there.
    #[test]
    fn steps_end_where_they_end() {
        for scheme in SCHEMES {
            assert_eq!(scheme.update.node(), 1.0, "{}", scheme.word);
            let nodes = scheme.stages.iter().map(Row::node);
            assert!(nodes.into_iter().all(|node| node == 1.0 || node < 0.999), "{}", scheme.word);
        }
    }

    #[test]
    fn words_and_sizes_fit() {
        for (at, scheme) in SCHEMES.into_iter().enumerate() {
            let count = scheme.stage_count();
            assert!(count <= MOST_STAGES && scheme.update.weights.len() <= count);
            let is_explicit = |(at, row): (usize, &Row)| row.weights.len() <= at + 1;
            assert!(scheme.stages.iter().enumerate().all(is_explicit));
            let rows = scheme.estimate.map_or(&[][..], |estimate| estimate.differences);
            assert!(rows.iter().all(|row| row.weights.len() <= count + 1));
            assert_eq!(Tableau::find(scheme.word), Some(SCHEMES[at]));
            assert!(SCHEMES.iter().enumerate().all(|(of, other)| scheme.is(other) == (of == at)));
        }
        assert_eq!(Tableau::find("euler"), None);
    }
}
