//! The case whose programs have parts that repeat themselves, again with these as
//! loops; the others have none. Chains are in `models/tests/references`.
#![allow(clippy::duplicate_mod, reason = "the same case, other code")]

use mbs_runtime::Info;

/// Adds a statement to the declaration.
macro_rules! declared {
    ($Name:ident { $($statement:tt)* }) => {
        mbs_runtime::mechanism! { $Name { limit unrolled = 0; $($statement)* } }

        #[test]
        fn has_loops() {
            super::assert_loops(<$Name as mbs_runtime::Mechanism>::INFO);
        }
    };
}

#[path = "andrews_squeezer.rs"]
mod andrews_squeezer;

fn assert_loops(info: &Info) {
    assert!(info.functions.iter().any(|function| function.loops > 0), "{} has no loops", info.name);
}
