//! Files of other mechanism programs as declarations.
//!
//! A reader makes a `Linkage` of a file: pins, links, slots and drives, with
//! the names and the numbers of the file. `declaration` writes it in the language. Files of
//! robots, which have masses and stand in space, become declarations by a way of their
//! own. Each declaration is compiled before anybody gets to see it.
//!
//! # How it works
//!
//! * `pylinkage`, `linkage2`, `pyslvs`, `pmks` and `pmks_plus` are the readers, one for each program. Only
//!   PMKS+ says masses (`masses`).
//! * `linkage` joins links that share two pins.
//! * `mobility` counts the degrees of freedom by the rank of the constraints where the linkage is drawn.
//! * `declaration` writes the text. Each line knows the part of the file that it came from, so an answer of
//!   the compiler names that part.
//! * `naming` makes names of the language. Other texts of a file appear in comments only, escaped.

mod address;
mod declaration;
mod geometry;
mod linkage;
mod linkage2;
mod masses;
mod mobility;
mod naming;
mod pmks;
mod pmks_plus;
mod pylinkage;
mod pyslvs;
mod refusal;
mod robot;
mod values;
mod xml;

use std::time::Duration;

pub use refusal::Refusal;
use refusal::shown;

/// A file may come from a stranger: compiling what it describes ends after this time.
const PATIENCE: Duration = Duration::from_secs(60);

/// A file is at most this many bytes, which is hundreds of times what a linkage takes.
pub const LONGEST: usize = 1 << 22;

/// A program whose files are read.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// pylinkage, in the form of its mechanisms and in the older one of its joints.
    Pylinkage,
    /// Linkage, by David Rector.
    Linkage,
    /// Pyslvs, in its expressions.
    Pyslvs,
    /// PMKS by M. I. Campbell: its text, its web addresses and its JSON.
    Pmks,
    /// PMKS+ of PMKS-Web, as it saves and shares.
    PmksPlus,
    /// MJCF, the models of MuJoCo.
    Mjcf,
    /// URDF, the robots of ROS.
    Urdf,
    /// SDF, the models of Gazebo.
    Sdf,
}

/// The formats with the names that `--format` takes.
pub const FORMATS: [(&str, Format); 8] = [
    ("pylinkage", Format::Pylinkage),
    ("linkage2", Format::Linkage),
    ("pyslvs", Format::Pyslvs),
    ("pmks", Format::Pmks),
    ("pmks-plus", Format::PmksPlus),
    ("mjcf", Format::Mjcf),
    ("urdf", Format::Urdf),
    ("sdf", Format::Sdf),
];

/// A declaration that compiles, and what its reader should know.
#[derive(Debug)]
pub struct Imported {
    /// The declaration.
    pub text: String,
    /// Notes on what was assumed, and on what was not carried over.
    pub notes: Vec<String>,
    /// How many links move.
    pub links: usize,
    /// How many degrees of freedom are left.
    pub dof: usize,
}

/// Facts about a file that its caller knows, each `None` if it does not.
#[derive(Clone, Copy, Debug, Default)]
pub struct Known<'k> {
    /// The program that wrote it; else its content shows it.
    pub format: Option<Format>,
    /// The unit of its lengths.
    pub unit: Option<&'k str>,
    /// The name of the model that is wanted, if it has several.
    pub model: Option<&'k str>,
}

/// The declaration of what a file describes.
///
/// # Errors
/// A file that is none of the format, one with a part that the language lacks, and what the
/// compiler says of the mechanism.
pub fn import(file: &str, text: &str, known: Known<'_>) -> Result<Imported, Refusal> {
    let Known { format, unit, model } = known;
    let format = format.map_or_else(|| recognized(text), Ok)?;
    if model.is_some() && format != Format::Sdf {
        return Err(Refusal("it has one mechanism; --model is for files of SDF with several models".into()));
    }
    let text = text.trim_start_matches('\u{feff}');
    let (written, notes) = match format {
        Format::Mjcf | Format::Urdf | Format::Sdf if unit.is_some_and(|unit| unit != "m") => {
            return Err(Refusal(
                "its lengths are in m; --unit is for files that leave their unit open".into(),
            ));
        }
        Format::Mjcf => robot::of_mjcf(text, file)?,
        Format::Urdf => robot::of_urdf(text, file)?,
        Format::Sdf => robot::of_sdf(text, file, model)?,
        Format::Pylinkage => of_linkage(pylinkage::read(text)?, file, unit)?,
        Format::Linkage => of_linkage(linkage2::read(text)?, file, unit)?,
        Format::Pyslvs => of_linkage(pyslvs::read(text)?, file, unit)?,
        Format::Pmks => of_linkage(pmks::read(text)?, file, unit)?,
        Format::PmksPlus => of_linkage(pmks_plus::read(text)?, file, unit)?,
    };
    compiles(&written)?;
    let declaration::Written { lines, links, dof, .. } = written;
    let text = lines.into_iter().map(|line| line.text + "\n").collect();
    Ok(Imported { text, notes, links, dof })
}

/// The declaration of a linkage, and its notes.
fn of_linkage(
    mut linkage: linkage::Linkage,
    file: &str,
    unit: Option<&str>,
) -> Result<(declaration::Written, Vec<String>), Refusal> {
    if let Some(unit) = unit {
        linkage.say_unit(unit)?;
    }
    let linkage = linkage.normalized()?;
    Ok((declaration::written(&linkage, file)?, linkage.notes))
}

/// The roots of the formats that are XML.
const ROOTS: [(&str, Format); 4] =
    [("linkage2", Format::Linkage), ("mujoco", Format::Mjcf), ("robot", Format::Urdf), ("sdf", Format::Sdf)];

/// The name of the first element of an XML, behind what may come before it.
fn root(text: &str) -> Option<&str> {
    let mut text = text;
    loop {
        text = text.trim_start();
        let end = match text {
            comment if comment.starts_with("<!--") => "-->",
            instruction if instruction.starts_with("<?") => "?>",
            declaration if declaration.starts_with("<!") => ">",
            _ => break,
        };
        (_, text) = text.split_once(end)?;
    }
    text.strip_prefix('<')?.split(|letter: char| letter.is_whitespace() || "/>".contains(letter)).next()
}

/// The format of a file by its content.
fn recognized(text: &str) -> Result<Format, Refusal> {
    let text = text.trim_start_matches('\u{feff}').trim_start();
    if text.starts_with('{') {
        return Ok(if text.contains("\"TypeOfJoint\"") { Format::Pmks } else { Format::Pylinkage });
    }
    if let Some((_, format)) = ROOTS.iter().find(|(name, _)| root(text) == Some(name)) {
        return Ok(*format);
    }
    if pyslvs::is_begun(text) {
        return Ok(Format::Pyslvs);
    }
    if address::is_of_old_pmks_plus(text) {
        return Err(Refusal(
            "it is an address of an older PMKS+, which names its parts (`j=`, `l=`); the PMKS+ of today reads it, and \
             what that saves is imported"
                .into(),
        ));
    }
    if pmks_plus::is_begun(text) {
        return Ok(Format::PmksPlus);
    }
    if pmks::is_begun(text) {
        return Ok(Format::Pmks);
    }
    let known: Vec<&str> = FORMATS.iter().map(|(name, _)| *name).collect();
    Err(Refusal(format!(
        "it begins like none of the files that are known ({}); --format says which one it is",
        known.join(", ")
    )))
}

/// Compiles what was written; errors name the parts of the file that the lines came from.
fn compiles(written: &declaration::Written) -> Result<(), Refusal> {
    let text: String = written.lines.iter().map(|line| line.text.clone() + "\n").collect();
    let compiled = mbs_live::Text::declaration("imported", text).within(PATIENCE).compile();
    let Err(error) = compiled else { return Ok(()) };
    if written.repeated > 0 && error.problems().iter().any(|problem| is_about_freedom(problem, written)) {
        return Err(singular(written));
    }
    let problem = |problem: &mbs_live::Problem| {
        let line = problem.location.as_ref().and_then(|place| written.lines.get(place.line - 1));
        let of = line.and_then(|line| line.of.as_deref());
        let help = problem.help.as_ref().map(|help| format!(" ({help})")).unwrap_or_default();
        match of {
            Some(of) => format!("{of}: {}{help}", problem.message),
            None => format!("{}{help}", problem.message),
        }
    };
    let problems: Vec<String> = error.problems().iter().take(10).map(problem).collect();
    Err(Refusal(format!("what it describes is refused: {}", problems.join("; "))))
}

/// `true` if a problem is with the number of degrees of freedom: it is in the line `dof = …`.
fn is_about_freedom(problem: &mbs_live::Problem, written: &declaration::Written) -> bool {
    let line = problem.location.as_ref().and_then(|place| written.lines.get(place.line.checked_sub(1)?));
    line.is_some_and(|line| line.text.trim_start().starts_with("dof = "))
}

/// The refusal of a mechanism whose constraints repeat each other where it is drawn and nowhere else.
fn singular(written: &declaration::Written) -> Refusal {
    let (drawn, moved) = (written.dof, written.dof.saturating_sub(written.repeated));
    let freedom = |count| mbs_words::number::counted(count, "degree");
    Refusal(format!(
        "it is drawn in a singular position, as with links in one line: {} of freedom there and {moved} everywhere \
         else; draw it a little away from there",
        freedom(drawn)
    ))
}

#[cfg(test)]
mod tests;
