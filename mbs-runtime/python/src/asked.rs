//! The options of a run, as Python gives them.

use mbs_runtime::Info;
use mbs_workbench::{About, Error, PortNames, RunOptions, Signals};
use pyo3::prelude::*;

/// Names, values, and the words of their ways.
type Columns = Vec<(String, Vec<f64>, String)>;

/// Options of a run, in texts, as at the command line.
#[derive(FromPyObject, Default)]
#[pyo3(from_item_all)]
pub struct Asked {
    /// Names and texts of [`RunOptions::NAMES`].
    options: Vec<(String, String)>,
    parameters: Vec<(String, String)>,
    inputs: Vec<(String, String)>,
    /// Times, and inputs at them in their declared units.
    signals: Option<(Vec<f64>, Columns)>,
    /// Start values of coordinates and rates.
    state: Vec<(String, String)>,
    every: Option<u64>,
    allow_unstable: bool,
}

/// About which state something is asked.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct AskedPoint {
    guess: Vec<(String, String)>,
    at: Option<String>,
    after: Option<String>,
    relax: bool,
    here: bool,
}

/// Names of what goes into a linear system and comes out of it.
#[derive(FromPyObject)]
#[pyo3(from_item_all)]
pub struct AskedPorts {
    states: Option<Vec<String>>,
    inputs: Option<Vec<String>>,
    parameters: Vec<String>,
    outputs: Option<Vec<String>>,
}

impl Asked {
    /// As the workbench takes it.
    pub fn options(self, info: &Info) -> Result<RunOptions, Error> {
        let signals = self.signals.map(|(times, columns)| signals(info, &times, columns)).transpose()?;
        let mut options = RunOptions {
            parameters: self.parameters,
            inputs: self.inputs,
            signals,
            from: self.state,
            every: self.every,
            finds_events: true,
            allow_unstable: self.allow_unstable,
            ..RunOptions::default()
        };
        for (name, text) in self.options {
            options.set(&name, text)?;
        }
        Ok(options)
    }
}

/// Inputs at these times, each by its way.
fn signals(info: &Info, times: &[f64], columns: Columns) -> Result<Signals, Error> {
    let none = Signals::new(info, times.to_vec(), Vec::new())?;
    columns.into_iter().try_fold(none, |signals, (name, values, words)| {
        signals.with(Signals::new(info, times.to_vec(), vec![(name, values)])?.led(&words)?)
    })
}

impl From<AskedPoint> for About {
    fn from(asked: AskedPoint) -> Self {
        let AskedPoint { guess, at, after, relax, here } = asked;
        Self { from: guess, at, is_relaxed: relax, is_here: here, after }
    }
}

impl From<AskedPorts> for PortNames {
    fn from(asked: AskedPorts) -> Self {
        let AskedPorts { states, inputs, parameters, outputs } = asked;
        Self { states, inputs, parameters, outputs }
    }
}
