//! The length of a vector that may vanish.

use mbs_symbolic::{Scalar, Vector};

/// Below this size the norm of a vector is kept from its kink at 0, so that
/// its derivative exists there: (1e-12)² in SI units.
const SOFTENING: f64 = 1e-24;

/// The length of a vector, smooth at 0; exact where one component is 0.
pub fn norm(vector: Vector<Scalar<'_>>) -> Scalar<'_> {
    let Vector { x, y } = vector;
    match (x.is_zero(), y.is_zero()) {
        (_, true) => x.abs(),
        (true, false) => y.abs(),
        (false, false) => {
            let squares = [x.squared(), y.squared()];
            let softening = x.algebra().number(SOFTENING);
            x.algebra().sum(squares.into_iter().chain([softening])).sqrt()
        }
    }
}
