//! Numbers in messages.

use core::fmt::{self, Write};

/// A number as a person reads it: what rounding did to its last digits is left out.
pub(super) struct Shown(pub f64);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // twelve digits say when something happened, and no sum of steps is wrong in them
        let mut digits = Digits { text: [0; 24], length: 0 };
        write!(digits, "{:.11e}", self.0)?;
        let text = core::str::from_utf8(digits.text.get(..digits.length).unwrap_or_default());
        let rounded = text.ok().and_then(|text| text.parse().ok()).unwrap_or(self.0);
        write!(f, "{rounded}")
    }
}

/// A number in decimal notation; the longest one is `-1.23456789012e-308`.
struct Digits {
    text: [u8; 24],
    length: usize,
}

impl Write for Digits {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        let end = self.length + text.len();
        self.text.get_mut(self.length..end).ok_or(fmt::Error)?.copy_from_slice(text.as_bytes());
        self.length = end;
        Ok(())
    }
}
