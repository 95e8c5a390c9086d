//! The memory of a run of the switches of its laws.

use crate::corners::MOST_SWITCHES;

/// The memory of the switches.
#[derive(Clone, Copy, Debug)]
pub(super) struct Switching {
    /// The pieces on which the values are, if they are known.
    pub pieces: Option<[f64; MOST_SWITCHES]>,
    /// The number of looks in sequence that found that a jump leads back to itself.
    pub turned: [u8; MOST_SWITCHES],
    /// The number of steps that passed a knot of a value that is held.
    pub rounded: [u8; MOST_SWITCHES],
    /// The length of steps before the last rejections in s.
    pub calm: f64,
    /// The share of the step that was tried at which it passes its first knot, if it is to end right behind it.
    pub knot: Option<f64>,
}

impl Switching {
    pub const fn new() -> Self {
        Self { pieces: None, turned: [0; MOST_SWITCHES], rounded: [0; MOST_SWITCHES], calm: 0.0, knot: None }
    }

    /// From another state, or with other inputs.
    pub fn go_on(&mut self) {
        *self = Self::new();
    }
}
