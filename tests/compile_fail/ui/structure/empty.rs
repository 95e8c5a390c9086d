//! A mechanism has bodies and says how many degrees of freedom they keep.

use mbs_runtime::mechanism;

mechanism! {
    pub Nothing {}
}

fn main() {}
