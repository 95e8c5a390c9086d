//! What a compiled mechanism is printed as. A target sees [`Compiled`](crate::Compiled)
//! alone.

mod rust;

pub use rust::rust;
