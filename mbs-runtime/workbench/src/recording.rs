//! Results of a run: columns of numbers and a summary.

use mbs_analysis::{Signal, Variable};
use mbs_runtime::{Constraint, Effort, Info};

use crate::doubt::Doubt;
use crate::until::Unmet;
use crate::{Column, Error, Occurrence, Unit, names};

/// The figures of a run that one looks at first.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Summary {
    /// Steps taken; samples of a run to a tolerance.
    pub steps: u64,
    /// The steps of a run to a tolerance.
    pub effort: Option<Effort>,
    /// Time of the last good state in s.
    pub end: f64,
    /// Largest ‖Φ‖ over all steps.
    pub max_phi: f64,
    /// Largest ‖Φ̇‖ over all steps.
    pub max_phi_dot: f64,
    /// Kinetic plus potential energy at the start in J.
    pub energy_start: f64,
    /// The same at the end.
    pub energy_end: f64,
}

/// More events than this are not kept.
pub const MOST_OCCURRENCES: usize = 100_000;

/// The result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct Recording {
    /// Time first, then coordinates, velocities, multipliers, outputs, memories, violation.
    pub columns: Vec<Column>,
    /// How many of the columns after time are coordinates, or integrals of own states.
    pub coordinates: usize,
    /// How many of these are coordinates of bodies.
    pub lines: usize,
    /// The number of columns of memories, which stand before that of the violation.
    pub memories: usize,
    /// The summary.
    pub summary: Summary,
    /// The events that it came to, in their order; at most [`MOST_OCCURRENCES`].
    pub occurrences: Vec<Occurrence>,
    /// The condition that was to end the run and did not.
    pub unmet: Option<Unmet>,
    /// Why the run ended before its end time, if it did.
    pub ended: Option<mbs_runtime::Error>,
    /// Why its numbers should not be trusted, although it did not fail.
    pub doubts: Vec<Doubt>,
    /// Notes on how the run differs from what one may expect: events that were not looked for, another method in place
    /// of the declared one, the use of a table of inputs. They are no reason to doubt it.
    pub notes: Vec<String>,
}

impl Recording {
    /// A recording with no rows: which columns there will be.
    #[cfg(feature = "desk")]
    pub(crate) fn empty(info: &Info) -> Self {
        Self {
            columns: columns(info),
            coordinates: info.coordinates.len(),
            lines: info.lines,
            memories: Signal::memories(info).len(),
            summary: Summary::default(),
            occurrences: Vec::new(),
            unmet: None,
            ended: None,
            doubts: Vec::new(),
            notes: Vec::new(),
        }
    }

    /// The places of the columns of memories.
    #[cfg(feature = "desk")]
    pub(crate) fn of_memories(&self) -> std::ops::Range<usize> {
        let end = self.columns.len().saturating_sub(1);
        end.saturating_sub(self.memories)..end
    }

    /// The column called `name`.
    pub fn column(&self, name: &str) -> Option<&Column> {
        self.columns.iter().find(|c| c.name == name)
    }

    /// The columns whose names fit any of these patterns, in the order of the patterns.
    /// In a pattern `*` stands for any letters and `?` for one: `x*`, `der(theta?)`.
    ///
    /// # Errors
    /// [`Error::Unknown`] for a pattern that nothing fits.
    pub fn select<'a>(&self, patterns: impl IntoIterator<Item = &'a str>) -> Result<Vec<&Column>, Error> {
        let mut selected: Vec<&Column> = Vec::new();
        for pattern in patterns {
            let mut fitting = self.columns.iter().filter(|c| names::fits(pattern, &c.name)).peekable();
            if fitting.peek().is_none() {
                let known = self.columns.iter().map(|column| column.name.as_str());
                return Err(Error::unknown("column", pattern, known));
            }
            for column in fitting {
                if !selected.iter().any(|other| other.name == column.name) {
                    selected.push(column);
                }
            }
        }
        Ok(selected)
    }
}

/// The memories that are recorded: their places among the inputs, and their units.
pub(crate) fn memories(info: &Info) -> Vec<(usize, Unit)> {
    let memory = |signal: &Signal| match signal.variable {
        Variable::Input(at) => Some((at, Unit::of_signal(info, signal))),
        _ => None,
    };
    Signal::memories(info).iter().filter_map(memory).collect()
}

/// The columns of a recording, empty.
pub(crate) fn columns(info: &Info) -> Vec<Column> {
    let mut columns = vec![Column::new("t", "s")];
    let column = |signal: Signal| {
        let unit = Unit::of_signal(info, &signal);
        Column::new(signal.name, unit.name())
    };
    columns.extend(Signal::states(info).into_iter().map(column));
    let multiplier = |row: &Constraint| {
        Column::new(format!("lambda({})", row.name), Unit::of_multiplier(row.dimension).name())
    };
    columns.extend(info.constraints.iter().map(multiplier));
    columns.extend(info.outputs.iter().map(|output| Column::new(output.name, Unit::of(output).name())));
    columns.extend(Signal::memories(info).into_iter().map(column));
    columns.push(Column::new("violation", "SI"));
    columns
}
