//! Figures, and files of them.

use std::path::Path;

pub use mbs_pictures::figure::*;

use crate::{Error, files};

/// A picture that is written to a file.
pub trait Save {
    /// Draws to a file; the ending of `path` says how: `.svg` or `.png`.
    ///
    /// # Errors
    /// [`Error::Name`] for another ending, [`Error::File`] if it cannot be written.
    fn save(&self, path: &Path) -> Result<(), Error>;
}

impl Save for Figure {
    fn save(&self, path: &Path) -> Result<(), Error> {
        files::write(path, &self.file(path)?)
    }
}
