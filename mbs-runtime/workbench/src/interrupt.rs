//! Ctrl-C as a flag: who works for long looks at it, and keeps what there is.

use std::process;
use std::sync::atomic::{AtomicBool, Ordering};

static INTERRUPTED: AtomicBool = AtomicBool::new(false);

/// What a program that was interrupted ends with: 128 + SIGINT.
pub const EXIT_CODE: u8 = 130;

/// A flag that Ctrl-C sets from now on; pressed again, it ends the program at once.
pub fn flag() -> &'static AtomicBool {
    // A program that handles it in its own way has its way.
    let _ = ctrlc::set_handler(|| {
        if INTERRUPTED.swap(true, Ordering::Relaxed) {
            process::exit(EXIT_CODE.into());
        }
    });
    &INTERRUPTED
}
