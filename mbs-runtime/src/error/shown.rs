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
        Plain(rounded).fmt(f)
    }
}

/// A number with all of its digits, and an exponent where there would be many zeros.
pub(super) struct Plain(pub f64);

impl fmt::Display for Plain {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self(x) = *self;
        let is_plain = x == 0.0 || !x.is_finite() || (1e-5..1e16).contains(&x.abs());
        if is_plain { write!(f, "{x}") } else { write!(f, "{x:e}") }
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

/// The remaining violation of a constraint that cannot be met, in m or rad, as a clause of a message. The clause is
/// empty where the number would say that the constraint is met.
pub(super) struct Violated(pub f64);

/// Violations below it, in m or rad, are no clearance that one would measure: at the end of its reach a
/// mechanism misses its constraints by rounding.
const CLEAR: f64 = 1e-9;

impl fmt::Display for Violated {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0 < CLEAR { Ok(()) } else { write!(f, ", it stays violated by {:.1e}", self.0) }
    }
}
