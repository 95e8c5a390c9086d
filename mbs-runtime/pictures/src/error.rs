//! Errors of pictures.

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// A name of a file that says no format.
    #[error("`{name}` cannot be used: {}", Self::ENDING)]
    Ending {
        /// The name.
        name: String,
    },
    /// A figure that could not be drawn.
    #[error("the figure `{title}` could not be drawn: {reason}")]
    Figure {
        /// Its title.
        title: String,
        /// The message of the drawing library.
        reason: String,
    },
}

impl Error {
    /// The reason of [`Ending`](Self::Ending).
    pub const ENDING: &str = "a picture has to end in .svg or .png";
}
