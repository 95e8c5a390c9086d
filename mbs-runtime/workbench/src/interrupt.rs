//! Ctrl-C as a flag, for work that keeps what there is of it.
//!
//! Everything else leaves Ctrl-C to the system, which ends the program at once.

use std::ops::Deref;
use std::process;
use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);
/// `true` while there is a [`Flag`]. The first Ctrl-C then sets it, and the next one ends the program.
static IS_LOOKED_AT: AtomicBool = AtomicBool::new(false);

/// The exit code of a program that was interrupted: 128 + SIGINT.
pub const EXIT_CODE: u8 = 130;

/// The flag that Ctrl-C sets while this lives. Pressed again, or later, it ends the program at once.
pub struct Flag(());

/// Ctrl-C sets the flag from now on. Who asks for it looks at it often, and at nothing else for long.
pub fn flag() -> Flag {
    IS_LOOKED_AT.store(true, Ordering::SeqCst);
    // A program that handles it in its own way has its way.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Ordering::SeqCst) || !IS_LOOKED_AT.load(Ordering::SeqCst) {
            process::exit(EXIT_CODE.into());
        }
    });
    Flag(())
}

impl Deref for Flag {
    type Target = AtomicBool;

    fn deref(&self) -> &AtomicBool {
        &INTERRUPTED
    }
}

impl Drop for Flag {
    fn drop(&mut self) {
        IS_LOOKED_AT.store(false, Ordering::SeqCst);
    }
}
