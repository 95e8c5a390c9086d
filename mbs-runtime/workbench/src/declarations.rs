//! Declarations in files, and their errors on a terminal.

use std::io::IsTerminal;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::Duration;

use crate::files::note_read;
use crate::live::{as_declared, from_text};
use crate::{Model, Settings};

/// A file may come from a stranger: compiling it ends after this time.
const PATIENCE: Duration = Duration::from_secs(60);

/// A declaration that is compiled when it is asked for.
pub(crate) struct Text {
    text: mbs_live::Text,
    defaults: Settings,
    compiled: OnceLock<Box<dyn Model>>,
}

impl Text {
    /// A declaration whose runs have these defaults.
    pub fn new(text: mbs_live::Text, defaults: Settings) -> Self {
        Self { text, defaults, compiled: OnceLock::new() }
    }

    /// The mechanism.
    ///
    /// # Errors
    /// Those of the declaration.
    pub fn model(&self) -> Result<&dyn Model, crate::Error> {
        if let Some(model) = self.compiled.get() {
            return Ok(model.as_ref());
        }
        let model = from_text(&self.text, self.defaults.clone())?;
        Ok(self.compiled.get_or_init(|| model).as_ref())
    }
}

/// The mechanism that a file declares; `name` chooses among several in a Rust file.
///
/// # Errors
/// A file that cannot be read, and what is wrong with the declaration.
pub(crate) fn read(path: &Path, name: Option<&str>) -> Result<Box<dyn Model>, crate::Error> {
    let text = mbs_live::Text::read(path).map_err(crate::Error::file("read", path))?.within(PATIENCE);
    let text = match name {
        Some(name) => text.named(name),
        None => text,
    };
    let model = as_declared(&text)?;
    text.tables().iter().map(PathBuf::as_path).chain([path]).for_each(note_read);
    Ok(model)
}

/// An error with its source, in colours on a terminal.
pub(crate) fn shown(error: &mbs_live::Error) -> String {
    let text = if has_colours() { error.colored().to_string() } else { error.to_string() };
    text.trim_end().to_owned()
}

/// The same of warnings.
pub(crate) fn shown_warnings(warnings: &mbs_live::Warnings) -> String {
    let text = if has_colours() { warnings.colored().to_string() } else { warnings.to_string() };
    text.trim_end().to_owned()
}

fn has_colours() -> bool {
    std::io::stderr().is_terminal() && std::env::var_os("NO_COLOR").is_none()
}
