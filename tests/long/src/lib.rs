//! Tests of types that take so many steps that optimised code is compiled and run sooner, and tests of optimised
//! code itself, such as its stack. The other tests of types are in `tests`, whose code is not optimised.
