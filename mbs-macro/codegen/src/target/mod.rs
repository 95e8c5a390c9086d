//! What a compiled mechanism is printed as. A target sees [`Compiled`](crate::Compiled)
//! alone.

mod c;
mod rust;
mod words;

pub use c::{CSources, File, Scalar, c};
pub use rust::rust;
