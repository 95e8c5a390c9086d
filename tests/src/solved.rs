//! Accelerations and reactions beside a dense solution of M q̈ + Φ_qᵀ λ = Q, Φ_q q̈ = γ.

use nalgebra::{DMatrix, DVector};

/// M, Φ_q, Q and γ of a state, for a dense solution.
pub struct Dense {
    matrix: DMatrix<f64>,
    rhs: DVector<f64>,
}

impl Dense {
    /// The system of these matrices, forces and γ.
    pub fn new(mass: DMatrix<f64>, phi_q: DMatrix<f64>, forces: &[f64], gamma: &[f64]) -> Self {
        let (n, m) = (mass.nrows(), phi_q.nrows());
        let mut matrix = DMatrix::zeros(n + m, n + m);
        matrix.view_mut((0, 0), (n, n)).copy_from(&mass);
        matrix.view_mut((n, 0), (m, n)).copy_from(&phi_q);
        matrix.view_mut((0, n), (n, m)).copy_from(&phi_q.transpose());
        Self { matrix, rhs: DVector::from_iterator(n + m, forces.iter().chain(gamma).copied()) }
    }

    /// The condition number of its matrix.
    pub fn condition(&self) -> f64 {
        let singular = self.matrix.singular_values();
        singular.max() / singular.min()
    }
}

/// The largest condition number of a position that is compared: a random one seldom has more.
pub const LARGEST_CONDITION: f64 = 1e7;

/// The elimination solves the dense system. Each of the two is good to
/// size·condition·ε, and the one without exchanges of rows loses the growth of its
/// pivots besides.
pub fn assert_solves(dense: &Dense, ours: &[f64], growth: f64, at: &str) {
    let condition = dense.condition();
    let expected = dense.matrix.clone().lu().solve(&dense.rhs);
    let expected = expected.unwrap_or_else(|| DVector::zeros(dense.rhs.len()));
    let size = ours.len() as f64;
    assert!(growth * condition * f64::EPSILON < 1e-3, "{at}: growth {growth:e}, condition {condition:e}");
    let tolerance = size * f64::EPSILON * condition * (1.0 + growth) * (1.0 + expected.amax());
    let deviation = (DVector::from_column_slice(ours) - &expected).amax();
    assert!(deviation <= tolerance, "{at}: {deviation:e} > {tolerance:e}\n{ours:?}\n{expected}");
}

/// Compares accelerations and reactions of a type with a dense solution: at its declared start, along a run of so many
/// steps and in random positions.
#[macro_export]
macro_rules! solves_as_dense {
    ($mechanism:ident, $steps:expr) => {{
        use mbs_runtime::{Components, NoComponents, Simulation, State};
        use nalgebra::DMatrix;
        use $crate::random::Random;
        use $crate::solved::{Dense, LARGEST_CONDITION, assert_solves};
        let mechanism = $mechanism::declared();
        let none = NoComponents::default();
        let check = |at: &State<_>, must_be_regular: bool| {
            let mass = mechanism.mass(&at.q);
            let phi_q = mechanism.phi_q(at.t, &at.q);
            let dense = Dense::new(
                DMatrix::from_fn(mass.nrows(), mass.ncols(), |i, j| mass[(i, j)]),
                DMatrix::from_fn(phi_q.nrows(), phi_q.ncols(), |i, j| phi_q[(i, j)]),
                mechanism.forces(at, &none).into_array().as_ref(),
                mechanism.gamma(at).into_array().as_ref(),
            );
            if !must_be_regular && dense.condition() > LARGEST_CONDITION {
                return;
            }
            let solved = mechanism.accelerations(at, &none);
            let mut ours = solved.acceleration.into_array().as_ref().to_vec();
            ours.extend(solved.multipliers.into_array().as_ref());
            assert_solves(&dense, &ours, solved.growth, &format!("{} at {at:?}", stringify!($mechanism)));
        };
        let mut run = Simulation::new(mechanism, 1e-3).expect("the start is regular");
        check(&run.state(), true);
        for _ in 0..$steps {
            run.step().expect("the motion is regular");
            check(&run.state(), true);
        }
        let mut random = Random::new(7);
        for _ in 0..200 {
            let mut at = run.state();
            let (mut q, mut v) = (at.q.into_array(), at.v.into_array());
            q.iter_mut().chain(&mut v).for_each(|x| *x = random.between(-3.0, 3.0));
            (at.q, at.v) = (Components::from_array(q), Components::from_array(v));
            check(&at, false);
        }
    }};
}
