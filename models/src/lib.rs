//! A library of mechanisms, one a file: figure, source, parameters, reference
//! values.
//!
//! | mechanism | degrees of freedom | what it shows |
//! |---|---|---|
//! | [`SliderCrank`] | 0 | fully driven: kinematics, drive torque |
//! | [`SliderCrankFree`] | 1 | an `input` set by the embedding program |
//! | [`Pendulum`] | 1 | Cartesian coordinates, a reaction as output |

pub mod pendulum;
pub mod slider_crank;
pub mod slider_crank_free;

pub use pendulum::Pendulum;
pub use slider_crank::{SliderCrank, SliderCrankParameters};
pub use slider_crank_free::{SliderCrankFree, SliderCrankFreeInputs, SliderCrankFreeParameters};
