//! The mechanics that a declaration is made of: formulas, and facts about them as plain
//! data. Here are no names, no spans and no tokens; who reads a declaration knows this
//! room, and it knows nobody but the algebra.

pub mod elements;
mod energies;
mod equations;
pub mod joints;
pub mod laws;
mod loads;
mod motion;
mod norm;
mod outline;
mod particles;
mod places;

pub use energies::{Energies, Inertia};
pub use equations::{Equations, Mechanism, derive};
pub use loads::{Applied, Load, Work};
pub use motion::Motion;
pub use norm::norm;
pub use outline::Outline;
pub use particles::{Cluster, Particle};
pub use places::Placed;
