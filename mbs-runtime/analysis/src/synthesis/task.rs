//! The task of a linkage, and the parameters that may be chosen for it.

use mbs_runtime::Info;

use crate::{Error, Unknown};

/// Positions that a mechanism with one degree of freedom is to pass, and the parameters that are looked for.
///
/// A position is a row of values of outputs and coordinates, in the order in which they are to be passed. A point
/// to be passed at any time is a value of its x and one of its y; with a value of the driving coordinate beside
/// them the timing is prescribed; values of two angles are a function. See
/// [the page on synthesis](crate::linkages) for an example.
#[derive(Clone, Debug, PartialEq)]
pub struct Task {
    /// The mechanism.
    pub info: &'static Info,
    /// Its parameters in SI units, in the order of [`Info::parameters`].
    pub parameters: Vec<f64>,
    /// The parameters that are looked for. Each start begins at random values between their bounds.
    pub unknown: Vec<Unknown>,
    /// Outputs and coordinates that have values at the positions.
    pub columns: Vec<String>,
    /// The values of `columns` in SI units and rad, a row for each position; `None` for a value that is free.
    pub positions: Vec<Vec<Option<f64>>>,
    /// The coordinate that drives. It must not turn back between the positions. `None` permits any motion.
    pub drive: Option<String>,
    /// The largest difference from a value that is asked for, in SI units.
    pub tolerance: f64,
    /// The largest number of starts.
    pub starts: usize,
    /// The number of mechanisms at which the search ends.
    pub enough: usize,
    /// The seed of the random starts. The same seed finds the same mechanisms.
    pub seed: u64,
}

/// Why a mechanism that can be assembled at all positions does not pass them as it should.
///
/// # Example
/// ```
/// # use mbs_analysis::{Task, Unknown};
/// # use mbs_live::{Prepared, Text};
/// # use mbs_runtime::equations::Partials;
/// # let text = "Scotch {
/// #     dof = 1;
/// #     param r = 1 [m];
/// #     body wheel (angle = phi) { inertia = 1 [kg*m^2]; }
/// #     body slider (x) { mass = 1 [kg]; }
/// #     constraint pin: x = r*cos(phi);
/// # }";
/// # let live = Text::declaration("scotch.mbs", text).compile()?;
/// # let over = live.over::<Partials>();
/// # let trials = |values: &[Partials]| {
/// #     let live = over.with_parameters(|own| own.copy_from_slice(values))?;
/// #     Ok(Prepared::new(&live))
/// # };
/// use mbs_analysis::Defect;
///
/// // a wheel passes 0, 1, 2 and 3 rad in this order or backwards, and in no other one
/// let task = Task {
///     unknown: vec![Unknown { name: "r".into(), guess: None, bounds: [0.1, 1.0] }],
///     columns: vec!["phi".into(), "x".into()],
///     positions: [0.0, 2.0, 1.0, 3.0].map(|phi: f64| vec![Some(phi), Some(0.3 * phi.cos())]).to_vec(),
///     starts: 32,
///     ..Task::of(live.declared_info())
/// };
/// let found = task.synthesize(&trials)?;
/// assert!(found.linkages.is_empty());
/// assert!(found.refused.iter().any(|(defect, count)| *defect == Defect::Order && *count > 0));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Defect {
    /// It has to be taken apart between some positions: they lie on another circuit, or behind a position at which
    /// it is singular.
    Circuit,
    /// It passes the positions in another order.
    Order,
    /// The driving coordinate turns back on the way, at a dead centre.
    Branch,
}

/// A mechanism that was found. See the example of [`Task::synthesize`].
#[derive(Clone, Debug, PartialEq)]
pub struct Linkage {
    /// The values of what was looked for, in SI units.
    pub values: Vec<f64>,
    /// The coordinates at each position.
    pub coordinates: Vec<Vec<f64>>,
    /// The coordinates on the way from the first position to the last.
    pub path: Vec<Vec<f64>>,
    /// The largest difference from a value that was asked for, in SI units.
    pub missed: f64,
    /// The number of starts that led to it.
    pub count: usize,
}

impl Task {
    /// A task for a mechanism as it is declared, to which positions and unknowns are to be added. Values may be
    /// missed by 10⁻⁹, and the search ends with the first mechanism or after 20 000 starts. See the example of
    /// [`synthesize`](Self::synthesize).
    pub fn of(info: &'static Info) -> Self {
        Self {
            info,
            parameters: info.parameters.iter().map(|parameter| parameter.default).collect(),
            unknown: Vec::new(),
            columns: Vec::new(),
            positions: Vec::new(),
            drive: None,
            tolerance: 1e-9,
            starts: 20_000,
            enough: 1,
            seed: 0,
        }
    }

    pub(super) fn check(&self) -> Result<(), Error> {
        if self.info.dof != 1 {
            return Err(Error::Freedom { mechanism: self.info.name, dof: self.info.dof });
        }
        let (what, found, expected) = ("parameters", self.parameters.len(), self.info.parameters.len());
        if found != expected {
            return Err(Error::Length { what, found, expected });
        }
        for (at, unknown) in self.unknown.iter().enumerate() {
            let Unknown { name, guess, bounds: [low, high] } = unknown;
            if self.unknown.iter().take(at).any(|other| other.name == *name) {
                return Err(Error::Twice { name: name.clone() });
            }
            if !(low.is_finite() && high.is_finite()) {
                return Err(Error::NoBounds { name: name.clone() });
            }
            let guess = guess.unwrap_or(0.5 * (low + high));
            if !(low < high && *low <= guess && guess <= *high) {
                return Err(Error::Bounds { name: name.clone(), guess, low: *low, high: *high });
            }
        }
        if let Some(row) = self.positions.iter().find(|row| row.len() != self.columns.len()) {
            let (what, found, expected) = ("the values of a position", row.len(), self.columns.len());
            return Err(Error::Length { what, found, expected });
        }
        let values = || self.positions.iter().flatten().flatten();
        if self.positions.len() < 2 || values().next().is_none() || !values().all(|value| value.is_finite()) {
            return Err(Error::NoPositions { positions: self.positions.len() });
        }
        if !(self.tolerance > 0.0 && self.tolerance.is_finite()) {
            return Err(Error::Range { what: "the tolerance", value: self.tolerance, unit: "(SI)" });
        }
        if self.unknown.is_empty() {
            return Err(Error::FewSamples { samples: values().count(), unknowns: 0 });
        }
        Ok(())
    }
}
