//! A mechanism as C sees it: its quantities with texts that end in a NUL.

use std::ffi::{CStr, CString, c_char};
use std::path::Path;
use std::time::Duration;

use mbs_live::{Live, Text};
use mbs_runtime::{Constraint, Dimension, Info};
use mbs_symbolic::units;

use crate::border::Handle;
use crate::last::c_text;
use crate::status::{Failure, Status};

/// `mbs_quantity` of the header.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Quantity {
    /// Its name.
    pub name: *const c_char,
    /// Its doc comment.
    pub doc: *const c_char,
    /// Its unit.
    pub unit: *const c_char,
    /// SI value of one such unit.
    pub scale: f64,
    /// The declared value in SI units.
    pub value: f64,
}

/// The kinds of quantities, in the order of their numbers from 1 on.
#[derive(Clone, Copy, Debug)]
pub enum Kind {
    Parameter,
    Input,
    Coordinate,
    Output,
    Constraint,
    Point,
}

impl Kind {
    const ALL: [Self; 6] =
        [Self::Parameter, Self::Input, Self::Coordinate, Self::Output, Self::Constraint, Self::Point];

    /// The kind with a number of the header.
    ///
    /// # Errors
    /// There is none.
    pub fn of(number: i32) -> Result<Self, Failure> {
        let place = usize::try_from(number).ok().and_then(|number| number.checked_sub(1));
        let kind = place.and_then(|place| Self::ALL.get(place).copied());
        let most = Self::ALL.len();
        kind.ok_or_else(|| {
            Failure::new(
                Status::Index,
                format!("there is no kind of quantities {number}; they are 1 to {most}"),
            )
        })
    }

    /// The word for a quantity of this kind in messages.
    pub const fn word(self) -> &'static str {
        match self {
            Self::Parameter => "parameter",
            Self::Input => "input",
            Self::Coordinate => "coordinate",
            Self::Output => "output",
            Self::Constraint => "constraint",
            Self::Point => "point",
        }
    }
}

/// A quantity with its texts.
struct Entry {
    name: CString,
    doc: CString,
    unit: CString,
    scale: f64,
    value: f64,
}

/// A mechanism that was compiled, `mbs_mechanism` of the header.
pub struct Mechanism {
    live: Live,
    name: CString,
    /// The quantities of each kind.
    entries: [Vec<Entry>; Kind::ALL.len()],
}

impl Handle for Mechanism {
    const NAME: &'static str = "mechanism";
}

/// The choices that a caller has for compiling.
pub struct Choices<'a> {
    /// Of several mechanisms in Rust the one with this name.
    pub name: Option<&'a str>,
    /// The limit of time in s; 0 for none.
    pub limit: f64,
}

impl Mechanism {
    /// Compiles a text.
    ///
    /// # Errors
    /// It cannot be compiled; the limit is none.
    pub fn compiled(text: &str, file: &str, choices: &Choices<'_>) -> Result<Self, Failure> {
        let is_rust = Path::new(file).extension().is_some_and(|extension| extension == "rs");
        Self::of(if is_rust { Text::rust(file, text) } else { Text::declaration(file, text) }, choices)
    }

    /// Compiles what stands in a file.
    ///
    /// # Errors
    /// It cannot be read; as [`compiled`](Self::compiled).
    pub fn read(path: &str, choices: &Choices<'_>) -> Result<Self, Failure> {
        let text = Text::read(Path::new(path));
        let text = text.map_err(|error| {
            Failure::new(Status::File, format!("the file `{path}` cannot be read: {error}"))
        })?;
        Self::of(text, choices)
    }

    fn of(mut text: Text, choices: &Choices<'_>) -> Result<Self, Failure> {
        if let Some(name) = choices.name {
            text = text.named(name);
        }
        if choices.limit != 0.0 {
            let limit = Duration::try_from_secs_f64(choices.limit).map_err(|error| {
                Failure::new(Status::Value, format!("the limit of time is {} s, but {error}", choices.limit))
            })?;
            text = text.within(limit);
        }
        let live = text.compile()?;
        let (info, points) = (live.declared_info(), live.sketch().points);
        let entries = Kind::ALL.map(|kind| entries(kind, info, points));
        Ok(Self { name: c_text(info.name), entries, live })
    }

    /// The compiled mechanism, of which runs are made.
    pub fn live(&self) -> &Live {
        &self.live
    }

    /// Its name.
    pub fn name(&self) -> &CStr {
        &self.name
    }

    fn entries(&self, kind: Kind) -> &[Entry] {
        &self.entries[kind as usize]
    }

    /// How many quantities of a kind there are.
    pub fn count(&self, kind: Kind) -> usize {
        self.entries(kind).len()
    }

    /// The index of a quantity.
    ///
    /// # Errors
    /// There is none of this name.
    pub fn find(&self, kind: Kind, name: &str) -> Result<usize, Failure> {
        let entries = self.entries(kind);
        let found = entries.iter().position(|entry| entry.name.as_bytes() == name.as_bytes());
        found.ok_or_else(|| {
            let known: Vec<_> = entries.iter().map(|entry| entry.name.to_string_lossy()).collect();
            let (word, known) = (kind.word(), known.join(", "));
            let hint =
                if known.is_empty() { "there is none".to_owned() } else { format!("known are {known}") };
            Failure::new(Status::Name, format!("there is no {word} `{name}`; {hint}"))
        })
    }

    /// A quantity. Its texts stay as long as the mechanism.
    ///
    /// # Errors
    /// There is none with this index.
    pub fn quantity(&self, kind: Kind, index: usize) -> Result<Quantity, Failure> {
        let entries = self.entries(kind);
        let Entry { name, doc, unit, scale, value } =
            entries.get(index).ok_or_else(|| no_index(kind, index, entries.len()))?;
        let (name, doc, unit) = (name.as_ptr(), doc.as_ptr(), unit.as_ptr());
        Ok(Quantity { name, doc, unit, scale: *scale, value: *value })
    }
}

/// There is no quantity with an index.
pub fn no_index(kind: Kind, index: usize, count: usize) -> Failure {
    let word = kind.word();
    let known = match count {
        0 => "there is none".to_owned(),
        1 => "there is one, with the index 0".to_owned(),
        _ => format!("indices are 0 to {}", count - 1),
    };
    Failure::new(Status::Index, format!("there is no {word} with the index {index}; {known}"))
}

/// The quantities of a kind, with their texts.
fn entries(kind: Kind, info: &Info, points: &[&str]) -> Vec<Entry> {
    match kind {
        Kind::Parameter => info.parameters.iter().map(declared).collect(),
        Kind::Input => info.free_inputs().iter().map(declared).collect(),
        Kind::Coordinate => {
            let (places, states) = info.coordinates.split_at(info.lines.min(info.coordinates.len()));
            places.iter().map(place).chain(states.iter().map(declared)).collect()
        }
        Kind::Output => info.outputs.iter().map(declared).collect(),
        Kind::Constraint => info.constraints.iter().map(multiplier).collect(),
        Kind::Point => points.iter().map(|name| in_si(name, "", "m", 0.0)).collect(),
    }
}

/// A quantity in its declared unit, or in the SI unit where there is none.
fn declared(quantity: &mbs_runtime::Quantity) -> Entry {
    let mbs_runtime::Quantity { name, doc, unit, scale, dimension, default } = *quantity;
    if unit.is_empty() || scale == 0.0 {
        return in_si(name, doc, &si_unit(dimension), default);
    }
    Entry { unit: c_text(unit), scale, ..in_si(name, doc, "", default) }
}

/// A coordinate, which is a length or an angle.
fn place(coordinate: &mbs_runtime::Quantity) -> Entry {
    let unit = if coordinate.dimension.length == 0 { "rad" } else { "m" };
    in_si(coordinate.name, coordinate.doc, unit, coordinate.default)
}

/// The multiplier of a constraint. It does work on Φ, so its unit is that of energy over Φ.
fn multiplier(constraint: &Constraint) -> Entry {
    let dimension = Dimension::of(1, 2, -2).over(constraint.dimension);
    in_si(constraint.name, constraint.doc, &si_unit(dimension), 0.0)
}

fn in_si(name: &str, doc: &str, unit: &str, value: f64) -> Entry {
    Entry { name: c_text(name), doc: c_text(doc), unit: c_text(unit), scale: 1.0, value }
}

fn si_unit(dimension: Dimension) -> String {
    units::Dimension::from_exponents(dimension.exponents()).si_unit()
}
