//! What a compiled mechanism is printed as. A target sees [`Compiled`](crate::Compiled)
//! alone.

mod c;
#[cfg(feature = "rust")]
mod rust;
mod words;

pub use c::{CSources, File, Scalar, c};
#[cfg(feature = "rust")]
pub use rust::rust;
