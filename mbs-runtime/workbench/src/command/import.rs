//! `mbs import`: files of other mechanism programs as declarations.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use clap::Args;
use clap::builder::PossibleValuesParser;

use super::options::signed;
use crate::number::counted;
use crate::{Error, files, say};
use mbs_import::{FORMATS, Format, Imported, Known, LONGEST, import};

/// The units that lengths of a file may have.
const UNITS: [&str; 6] = ["m", "cm", "mm", "um", "inch", "ft"];

#[derive(Args)]
#[command(
    about = "Write the declaration of a linkage or a planar robot from the file of another program",
    after_help = EXAMPLES,
    mut_args(signed),
)]
pub(crate) struct Arguments {
    /// A file of pylinkage (JSON), Linkage (.linkage2), Pyslvs (an expression M[…]), PMKS and PMKS+ (texts,
    /// addresses, .pmks), MuJoCo (MJCF), ROS (URDF) or Gazebo (SDF)
    #[arg(value_name = "FILE")]
    file: PathBuf,
    /// The file to write [default: standard output]
    #[arg(long, value_name = "NAME.mbs")]
    out: Option<PathBuf>,
    /// The program that wrote the file [default: as its content shows]
    #[arg(
        long,
        value_name = "FORMAT",
        value_parser = PossibleValuesParser::new(FORMATS.map(|(name, _)| name)),
    )]
    format: Option<String>,
    /// The unit of lengths in the file [default: m for pylinkage, else mm; files of PMKS+ and of robots say it]
    #[arg(long, value_name = "UNIT", value_parser = PossibleValuesParser::new(UNITS))]
    unit: Option<String>,
    /// The model to import of a file of SDF that has several
    #[arg(long, value_name = "NAME")]
    model: Option<String>,
}

const EXAMPLES: &str = "\
Examples:
  mbs import four_bar.json --out four_bar.mbs    # a mechanism of pylinkage
  mbs import walker.linkage2 --out walker.mbs && mbs watch walker.mbs
  mbs import crank.txt --format pyslvs --unit cm
  mbs import mechanism.pmks --out mechanism.mbs    # saved by PMKS+
  mbs import double_pendulum.sdf --out double_pendulum.mbs    # a model of Gazebo";

impl Arguments {
    pub fn run(&self) -> Result<(), Error> {
        let path = &self.file;
        let out = self.out.as_ref();
        if let Some(out) = out.filter(|out| out.extension().is_none_or(|ending| ending != "mbs")) {
            let reason = "a file with a declaration ends in .mbs".into();
            return Err(Error::Name { name: out.display().to_string(), reason });
        }
        let refused = |reason: String| Error::Import { file: path.clone(), reason };
        let text = read(path)?.ok_or_else(|| refused(format!("it has more than {LONGEST} bytes")))?;
        let name = path.file_name().and_then(|name| name.to_str()).unwrap_or("file");
        let known = Known {
            format: self.format.as_ref().and_then(|wanted| format(wanted)),
            unit: self.unit.as_deref(),
            model: self.model.as_deref(),
        };
        let imported = import(name, &text, known).map_err(|refusal| refused(refusal.0))?;
        let Some(out) = out else { return say(imported.text.trim_end()) };
        files::write(out, imported.text.as_bytes())?;
        summary(out, &imported)
    }
}

fn format(wanted: &str) -> Option<Format> {
    FORMATS.iter().find(|(name, _)| *name == wanted).map(|(_, format)| *format)
}

/// The text of a file; nothing of one that is too long.
fn read(path: &Path) -> Result<Option<String>, Error> {
    let mut text = Vec::new();
    let read = File::open(path).and_then(|file| file.take(LONGEST as u64 + 1).read_to_end(&mut text));
    read.map_err(Error::file("read", path))?;
    Ok((text.len() <= LONGEST).then(|| String::from_utf8_lossy(&text).into_owned()))
}

fn summary(out: &Path, imported: &Imported) -> Result<(), Error> {
    let Imported { notes, links, dof, .. } = imported;
    for note in notes {
        say(format_args!("note:    {note}"))?;
    }
    let out = out.display();
    say(format_args!(
        "written: {out}, with {}, {} of freedom",
        counted(*links, "link"),
        counted(*dof, "degree")
    ))?;
    say(format_args!("next:    mbs watch {out}"))
}
