//! The mechanisms that commands know, by name or from files.
//!
//! A text of the library is compiled when it is asked for. `models/command/src/library.rs` lists the
//! mechanisms of the command.

use std::path::Path;

use mbs_analysis::Trials;
use rayon::prelude::*;

#[cfg(feature = "live")]
use crate::declarations::Text;
use crate::{Error, Model};

/// Mechanisms with the names under which commands know them.
#[derive(Default)]
pub struct Models(Vec<(String, Source)>);

enum Source {
    Model(Box<dyn Model>),
    #[cfg(feature = "live")]
    Text(Box<Text>),
}

/// A mechanism that a command was asked for.
pub(crate) enum Found<'a> {
    /// One that is known by name.
    Known(&'a str, &'a dyn Model),
    /// One that was read from a file, under the file's name without ending.
    #[cfg(feature = "live")]
    Read(String, Box<dyn Model>),
}

impl Found<'_> {
    /// Its name.
    pub fn name(&self) -> &str {
        match self {
            Self::Known(name, _) => name,
            #[cfg(feature = "live")]
            Self::Read(name, _) => name,
        }
    }

    /// The mechanism.
    pub fn model(&self) -> &dyn Model {
        match self {
            Self::Known(_, model) => *model,
            #[cfg(feature = "live")]
            Self::Read(_, model) => model.as_ref(),
        }
    }

    /// Its runs with derivatives.
    ///
    /// # Errors
    /// A type that has none.
    pub fn trials(&self) -> Result<Box<dyn Trials + Sync + '_>, Error> {
        self.model().trials().ok_or_else(|| Error::Name {
            name: self.name().to_owned(),
            reason: "its type was compiled without derivatives; make its model with \
                     `model::differentiated`, or give its declaration as a file"
                .into(),
        })
    }
}

impl Models {
    /// One more.
    pub(crate) fn push(&mut self, name: &str, model: Box<dyn Model>) {
        self.0.push((name.to_owned(), Source::Model(model)));
    }

    /// One more, which is compiled when it is asked for.
    #[cfg(feature = "live")]
    pub(crate) fn push_text(&mut self, name: &str, text: Text) {
        self.0.push((name.to_owned(), Source::Text(Box::new(text))));
    }

    /// The mechanism called `name`.
    ///
    /// # Errors
    /// [`Error::Unknown`]; of a text those of compiling it.
    pub fn get(&self, name: &str) -> Result<&dyn Model, Error> {
        match self.0.iter().find(|(known, _)| known == name) {
            Some((_, source)) => source.model(),
            None => Err(Error::unknown("mechanism", name, self.names())),
        }
    }

    /// The mechanism called so, or that of a file: `my.mbs`, `src/lib.rs`, or
    /// `src/lib.rs:Name` where a Rust file has several.
    pub(crate) fn find(&self, name: &str) -> Result<Found<'_>, Error> {
        match self.0.iter().find(|(known, _)| known == name) {
            Some((name, source)) => Ok(Found::Known(name, source.model()?)),
            None if is_file(name) => read(name),
            None => Err(Error::unknown("mechanism", name, self.names())),
        }
    }

    /// Names and mechanisms, in order.
    ///
    /// # Errors
    /// Those of compiling texts.
    pub fn all(&self) -> Result<Vec<(&str, &dyn Model)>, Error> {
        self.0.par_iter().map(|(name, source)| Ok((name.as_str(), source.model()?))).collect()
    }

    /// The names, in order.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.0.iter().map(|(name, _)| name.as_str())
    }
}

impl Source {
    fn model(&self) -> Result<&dyn Model, Error> {
        match self {
            Self::Model(model) => Ok(model.as_ref()),
            #[cfg(feature = "live")]
            Self::Text(text) => text.model(),
        }
    }
}

/// True if this is meant to be a file.
fn is_file(name: &str) -> bool {
    let (file, _) = split(name);
    let ending = Path::new(file).extension();
    ending.is_some_and(|ending| ending == "mbs" || ending == "rs")
        || file.contains(std::path::MAIN_SEPARATOR)
        || Path::new(file).is_file()
}

/// A file, and the mechanism in it that is meant.
fn split(name: &str) -> (&str, Option<&str>) {
    match name.rsplit_once(".rs:") {
        Some((file, mechanism)) => (&name[..file.len() + ".rs".len()], Some(mechanism)),
        None => (name, None),
    }
}

#[cfg(feature = "live")]
fn read(name: &str) -> Result<Found<'static>, Error> {
    let (file, mechanism) = split(name);
    let path = Path::new(file);
    let stem = path.file_stem().and_then(|stem| stem.to_str()).unwrap_or(file);
    Ok(Found::Read(mechanism.unwrap_or(stem).to_owned(), crate::declarations::read(path, mechanism)?))
}

#[cfg(not(feature = "live"))]
fn read(name: &str) -> Result<Found<'static>, Error> {
    let reason = "this program reads no files with declarations; \
                  it is built without the feature `live` of mbs-workbench";
    Err(Error::Name { name: name.to_owned(), reason: reason.into() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_of_files() {
        assert!(is_file("a.mbs") && is_file("src/lib.rs:Crank") && is_file("some/crank"));
        assert!(!is_file("slider-crank") && !is_file("crank:Crank"));
        assert_eq!(split("src/lib.rs:Crank"), ("src/lib.rs", Some("Crank")));
        assert_eq!(split("a.mbs"), ("a.mbs", None));
    }
}
