//! A declaration is a name and its statements in braces.

use mbs_runtime::mechanism;

mechanism! {}
mechanism! { { dof = 0; } }
mechanism! { pub SliderCrank; }
mechanism! { pub struct SliderCrank { dof = 0; } }
mechanism! { dof = 0; }

fn main() {}
