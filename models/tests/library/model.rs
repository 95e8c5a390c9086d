//! Functions of generated code besides those of `Mechanism`, in a form that tests can loop over.

use mbs_runtime::{Mechanism, State};

/// The matrices and vectors of the equations of motion as plain numbers.
pub trait Model: Mechanism<Real = f64> {
    /// The mechanism as declared.
    fn made() -> Self;
    /// Φ_q, row by row.
    fn jacobian(&self, t: f64, q: &Self::Coordinates) -> Vec<Vec<f64>>;
    /// Φ_t
    fn phi_t(&self, t: f64, q: &Self::Coordinates) -> Vec<f64>;
    /// γ
    fn gamma(&self, at: &State<Self::Coordinates>) -> Vec<f64>;
    /// M, row by row.
    fn mass(&self, q: &Self::Coordinates) -> Vec<Vec<f64>>;
    /// Q
    fn forces(&self, at: &State<Self::Coordinates>, inputs: &Self::Inputs) -> Vec<f64>;
    /// p = Mv
    fn momentum(&self, at: &State<Self::Coordinates>) -> Vec<f64>;
    /// Time derivatives of kinetic and potential energy for q̇ = v and v̇ =
    /// `acceleration`, by differentiating the code that computes the energies.
    fn energy_rates(&self, at: &State<Self::Coordinates>, acceleration: &Self::Coordinates) -> [f64; 2];
}

/// Implements [`Model`] for a generated mechanism.
macro_rules! model {
    ($Name:ident) => {
        impl Model for $Name<f64> {
            fn made() -> Self {
                $Name::declared()
            }
            fn jacobian(&self, t: f64, q: &Self::Coordinates) -> Vec<Vec<f64>> {
                $Name::phi_q(self, t, q).row_iter().map(|row| row.iter().copied().collect()).collect()
            }
            fn phi_t(&self, t: f64, q: &Self::Coordinates) -> Vec<f64> {
                $Name::phi_t(self, t, q).into_array().to_vec()
            }
            fn gamma(&self, at: &State<Self::Coordinates>) -> Vec<f64> {
                $Name::gamma(self, at).into_array().to_vec()
            }
            fn mass(&self, q: &Self::Coordinates) -> Vec<Vec<f64>> {
                $Name::mass(self, q).row_iter().map(|row| row.iter().copied().collect()).collect()
            }
            fn forces(&self, at: &State<Self::Coordinates>, inputs: &Self::Inputs) -> Vec<f64> {
                $Name::forces(self, at, inputs).into_array().to_vec()
            }
            fn momentum(&self, at: &State<Self::Coordinates>) -> Vec<f64> {
                $Name::kinetic_momentum(self, at).into_array().to_vec()
            }
            fn energy_rates(
                &self,
                at: &State<Self::Coordinates>,
                acceleration: &Self::Coordinates,
            ) -> [f64; 2] {
                let parameters = self.parameters().into_array();
                let constants = std::array::from_fn(|i| Dual::constant(parameters[i]));
                let dual = $Name::<Dual<f64, 1>>::new(Components::from_array(constants)).unwrap();
                let (q, v, a) = (at.q.into_array(), at.v.into_array(), acceleration.into_array());
                let along = State {
                    t: Dual::new(at.t, [1.0]),
                    q: Components::from_array(std::array::from_fn(|i| Dual::new(q[i], [v[i]]))),
                    v: Components::from_array(std::array::from_fn(|i| Dual::new(v[i], [a[i]]))),
                };
                [dual.kinetic_energy(&along), dual.potential_energy(&along)].map(|energy| energy.partials[0])
            }
        }
    };
}
pub(crate) use model;
