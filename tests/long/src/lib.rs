//! Tests of types that take so many steps that optimised code is compiled and run sooner, and tests that look at
//! optimised code: its stack, its fused steps. The others of their kind are in `tests`, whose code is not
//! optimised.
