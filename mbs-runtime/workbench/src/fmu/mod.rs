//! Functional mock-up units: archives that other simulators import.
//!
//! The compiler of mechanisms gives the C code and the descriptions. `binary` compiles the code, and
//! `archive` packs all of it.

mod archive;
mod binary;

use mbs_live::{Experiment, FmiVersion};
use mbs_runtime::System;

use crate::figure;
use crate::model::without_text;
use crate::{Error, Model, Motion, Picture, Settings, Start};

pub use binary::{Binary, binaries};

/// A functional mock-up unit: a mechanism as an archive for other simulators, with descriptions,
/// C code, pictures, and binaries for some platforms. It needs nothing else where it is used.
#[derive(Clone, Debug)]
pub struct Fmu {
    /// The name of the code and of the binaries.
    pub identifier: String,
    files: mbs_live::Fmu,
    icon: Option<Vec<u8>>,
    page: String,
}

impl Fmu {
    /// The files of a mechanism, without binaries. Its steps and how long importers are proposed to
    /// simulate are those of the settings.
    ///
    /// # Example
    /// ```
    /// use mbs_live::{FmiVersion, Text};
    /// use mbs_workbench::{Settings, fmu, model};
    ///
    /// let text = "Slider { dof = 1; body block (x) { mass = 1 [kg]; } start { x = 1 [m]; } }";
    /// let slider = model::as_declared(&Text::declaration("slider.mbs", text))?;
    /// let unit = fmu::Fmu::of(&*slider, &Settings { step: 1e-3, ..slider.defaults() })?;
    /// let archive = unit.archive(FmiVersion::V3, &[])?;
    /// assert!(archive.starts_with(b"PK"));
    /// # Ok::<(), mbs_workbench::Error>(())
    /// ```
    ///
    /// # Errors
    /// Those of its declaration, and of a start with this step; [`Error::Name`] of a mechanism whose
    /// declaration is not there as a text.
    pub fn of(model: &dyn Model, settings: &Settings) -> Result<Self, Error> {
        let run = model.start(&Start::of(model, settings)?)?;
        let experiment = Experiment { step: settings.step, end: settings.end };
        let text = model.text().ok_or_else(|| without_text(model.info().name))?;
        let files = text.fmu(experiment)?;
        let icon = icon(model, &*run)?;
        Ok(Self { identifier: files.identifier.clone(), files, icon, page: page(model, experiment) })
    }

    /// The C code, which [`binaries`] are compiled from.
    pub fn sources(&self) -> impl Iterator<Item = (&str, &str)> {
        self.files.sources.iter().map(|file| (file.name.as_str(), file.text.as_str()))
    }

    /// The archive of a version of the standard with these binaries.
    ///
    /// # Errors
    /// [`Error::File`] of writing to memory, which has room.
    pub fn archive(&self, version: FmiVersion, binaries: &[Binary]) -> Result<Vec<u8>, Error> {
        let text = |name: &str, text: &str| (name.to_owned(), text.as_bytes().to_vec());
        let mut files: Vec<(String, Vec<u8>)> = Vec::new();
        let descriptions = self.files.descriptions.iter().filter(|(of, _)| *of == version);
        files.extend(descriptions.map(|(_, description)| text("modelDescription.xml", description)));
        for binary in binaries {
            if let Some(folder) = binary.folder(version) {
                let name = format!("binaries/{folder}/{}{}", self.identifier, binary.ending());
                files.push((name, binary.bytes.clone()));
            }
        }
        files.extend(self.sources().map(|(name, code)| text(&format!("sources/{name}"), code)));
        files.push(text("documentation/index.html", &self.page));
        match version {
            FmiVersion::V2 => {
                files.extend(self.icon.iter().map(|icon| ("model.png".to_owned(), icon.clone())))
            }
            FmiVersion::V3 => {
                files.push(text("sources/buildDescription.xml", &self.files.build));
                files.push(text("terminalsAndIcons/terminalsAndIcons.xml", &self.files.terminals));
                let icon = self.icon.iter();
                files.extend(icon.map(|icon| ("terminalsAndIcons/icon.png".to_owned(), icon.clone())));
            }
        }
        archive::zip(&files).map_err(Error::file("write", std::path::Path::new(&self.identifier)))
    }
}

/// The mechanism at its start; nothing if it has no points.
fn icon(model: &dyn Model, run: &dyn System) -> Result<Option<Vec<u8>>, Error> {
    let sketch = model.sketch();
    if sketch.points.is_empty() {
        return Ok(None);
    }
    let (mut q, mut v) = (coordinates(model), coordinates(model));
    run.state(&mut q, &mut v);
    let mut points = vec![0.0; 2 * sketch.points.len()];
    run.points(run.time(), &q, &mut points);
    let places = points.chunks_exact(2).map(|point| [point[0], point[1]]).collect();
    let motion = Motion { sketch, times: vec![run.time()], places: vec![places] };
    Ok(Some(figure::icon(model.info().name, &Picture::of(&motion))?))
}

fn coordinates(model: &dyn Model) -> Vec<f64> {
    vec![0.0; model.info().coordinates.len()]
}

/// The page of documentation in the archive: what the mechanism is, and how it is simulated.
fn page(model: &dyn Model, experiment: Experiment) -> String {
    let info = model.info();
    include_str!("page.html")
        .replace("STEP", &format!("{:?}", experiment.step))
        .replace("SCHEME", model.scheme().title)
        .replace("VERSION", env!("CARGO_PKG_VERSION"))
        // names and words of the declaration last
        .replace("MECHANISM", &escaped(info.name))
        .replace("ABOUT", &escaped(info.doc))
        .replace("EQUATIONS", &escaped(&model.explanation()))
}

fn escaped(text: &str) -> String {
    text.replace('&', "&amp;").replace('<', "&lt;").replace('>', "&gt;")
}
