//! mbs
fn main() {}
