//! Names that people type and numbers that they read.
//!
//! # Example
//! ```
//! use mbs_words::{names, number};
//!
//! let known = ["length".to_owned(), "mass".to_owned()];
//! assert_eq!(names::nearest("lenght", &known), Some("length"));
//! assert_eq!(number::significant(0.001234567, 3), "0.00123");
//! ```
#![forbid(unsafe_code)]

pub mod names;
pub mod number;
