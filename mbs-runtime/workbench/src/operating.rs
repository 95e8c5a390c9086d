//! About what a mechanism is linearized, and where it is at rest.
//!
//! The options of an equilibrium and of a linear system are texts, as those of a run are (`run_options.rs`).

use mbs_analysis::{
    Equilibrium, Family, Linearization, OperatingPoint, Ports, Search, Signal, Stability, Strategy,
    equilibrium, linearize,
};
use mbs_runtime::equations::{Equations, Room, project};
use mbs_runtime::{DOPRI5, Explicit, Info, System, Tolerances};

use crate::quantity::{self, TIME};
use crate::settings::Start;
use crate::{Error, Model, RunOptions, Settings, StartKind, Unit, names};

/// Derivatives that are known to fewer digits than these are in doubt.
const DOUBTFUL: f64 = 1e-6;
/// Parts of a run to a state in motion, after each of which it tells how far it is.
pub(crate) const PARTS: usize = 100;

/// The state about which something is asked, in texts: a value is a number with or without a unit. By default it is
/// the equilibrium that is nearest to the declared start.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct About {
    /// Coordinates and the values from which an equilibrium is looked for; the others follow from the
    /// constraints.
    pub from: Vec<(String, String)>,
    /// The time at which drives and forces are held, the start unless it is said.
    pub at: Option<String>,
    /// True if an equilibrium is looked for where the mechanism would come to rest, past unstable ones.
    pub is_relaxed: bool,
    /// True if no equilibrium is looked for: at rest at the start, or at `from`.
    pub is_here: bool,
    /// In motion, this time after the start, with drives that move on, and nothing of the above.
    pub after: Option<String>,
}

/// Names of the states, the inputs and the outputs of a linear system.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct PortNames {
    /// The coordinates that are states; `None` for those that move most.
    pub states: Option<Vec<String>>,
    /// The inputs; `None` for all.
    pub inputs: Option<Vec<String>>,
    /// Parameters that are inputs too.
    pub parameters: Vec<String>,
    /// Patterns of outputs, `x`, `der(x)`, `lambda(row)`, in which `*` stands for any letters; `None` for the
    /// declared ones, or for all coordinates.
    pub outputs: Option<Vec<String>>,
}

/// A mechanism and the point about which it is linearized.
pub struct Operating<'a> {
    /// The name of the mechanism.
    pub name: &'a str,
    /// The mechanism.
    pub model: &'a dyn Model,
    /// A run of the mechanism.
    pub run: Box<dyn System>,
    /// The point.
    pub point: OperatingPoint,
    /// The equilibrium, where the point is one that was found.
    pub rest: Option<Equilibrium>,
    /// How it was looked for.
    pub search: Search,
    start: Start,
}

impl About {
    /// A run at its start, and how an equilibrium is looked for from there. Modes that hold at the start do so in the search and not
    /// in the run: the search closes their joints.
    ///
    /// # Errors
    /// Values that cannot be read, coordinates that the mechanism does not have, positions from which it cannot
    /// be assembled.
    pub fn search(&self, model: &dyn Model, start: &Start) -> Result<(Box<dyn System>, Search), Error> {
        let run = model.start(&start.without_modes(model.info()))?;
        let t = match &self.at {
            Some(text) => quantity::parse("at", text, TIME)?,
            None => run.time(),
        };
        let mut inputs = vec![0.0; run.equations().info().inputs.len()];
        run.inputs(&mut inputs);
        for mode in model.info().modes.modes {
            inputs[mode.memory] = start.inputs[mode.memory];
        }
        let strategy = if self.is_relaxed { Strategy::Relaxation } else { Strategy::Automatic };
        let from = Some(positions(&*run, t, &self.from)?);
        Ok((run, Search { from, inputs: Some(inputs), t, strategy }))
    }
}

/// The positions of a start, behind them the values of own states, with those that are given in their place, and the
/// others moved onto the constraints.
fn positions(run: &dyn System, t: f64, given: &[(String, String)]) -> Result<Vec<f64>, Error> {
    let info = run.equations().info();
    let n = info.coordinates.len();
    let (mut q, mut v) = (vec![0.0; n], vec![0.0; n]);
    run.state(&mut q, &mut v);
    q.iter_mut().zip(&v).skip(info.lines).for_each(|(q, value)| *q = *value);
    let mut kept = Vec::new();
    for (name, text) in given {
        let mut known = info.coordinates.iter().zip(&mut q).enumerate();
        let Some((at, (coordinate, place))) = known.find(|(_, (coordinate, _))| coordinate.name == name)
        else {
            let kind = if info.lines == n { "coordinate" } else { "coordinate or state" };
            return Err(Error::unknown(kind, name, info.coordinates.iter().map(|q| q.name)));
        };
        let unit = if info.is_own(at) { Unit::of(coordinate) } else { Unit::of_coordinate(coordinate) };
        *place = quantity::parse_in(name, text, coordinate.dimension, &unit)?;
        kept.push(coordinate.name);
    }
    if !kept.is_empty() || t != run.time() {
        let mut numbers = vec![0.0; Room::<f64>::len(info, 0)];
        let mut room = Room::within(&mut numbers, info);
        v.fill(0.0);
        project(run.equations(), t, &mut q, &mut v, [&kept, &[]], &mut room)?;
    }
    Ok(q)
}

impl<'a> Operating<'a> {
    /// The mechanism called `name` with the parameters and inputs of `options`, at a point. `told` hears how many parts of
    /// a run to that point are done, and of how many.
    ///
    /// # Errors
    /// Values that cannot be read or that the mechanism does not have; no equilibrium.
    pub fn of(
        name: &'a str,
        model: &'a dyn Model,
        options: &RunOptions,
        about: &About,
        told: &mut dyn FnMut(u64, u64),
    ) -> Result<Self, Error> {
        let settings = options.values(model)?;
        let start = Start::of(model, &settings)?;
        if let Some(text) = &about.after {
            let run = after(model, settings, quantity::parse("after", text, TIME)?, told)?;
            let point = OperatingPoint::of_run(&*run);
            return Ok(Self { name, model, run, point, rest: None, search: Search::default(), start });
        }
        let (run, search) = about.search(model, &start)?;
        let rest = if about.is_here { None } else { Some(equilibrium(run.equations(), &search)?) };
        let from = search.from.as_deref().unwrap_or(&[]);
        // memories are those that the start leaves
        let inputs = search.inputs.as_deref().unwrap_or(&start.inputs);
        let here = || OperatingPoint::resting(model.info(), search.t, from, inputs);
        let point = rest.as_ref().map_or_else(here, OperatingPoint::from);
        Ok(Self { name, model, run, point, rest, search, start })
    }

    /// Names and units of the mechanism.
    pub fn info(&self) -> &'static Info {
        self.model.info()
    }

    /// The linear system between these ports.
    ///
    /// # Errors
    /// As [`linearize`].
    pub fn linearized(&self, names: &PortNames) -> Result<Linearization, Error> {
        let PortNames { states, inputs, parameters, outputs } = names.clone();
        let outputs = outputs.map(|patterns| self.outputs(&patterns)).transpose()?;
        let ports = Ports { states, inputs, outputs, parameters, family: Some(self) };
        Ok(linearize(self.run.equations(), &self.point, &ports)?)
    }

    /// The names that fit some patterns, in their order.
    fn outputs(&self, patterns: &[String]) -> Result<Vec<String>, Error> {
        let info = self.info();
        let measurable = Signal::observable(info).into_iter().filter(|signal| !signal.is_integral(info));
        let known: Vec<String> = measurable.map(|signal| signal.name).collect();
        let mut found: Vec<String> = Vec::new();
        for pattern in patterns {
            let mut fitting = known.iter().filter(|name| names::fits(pattern, name)).peekable();
            if fitting.peek().is_none() {
                return Err(Error::unknown("output", pattern, known.iter().map(String::as_str)));
            }
            let new: Vec<String> = fitting.filter(|name| !found.contains(name)).cloned().collect();
            found.extend(new);
        }
        Ok(found)
    }

    /// About what it is linearized, in words.
    pub fn words(&self) -> String {
        let t = crate::number::significant(self.point.t, 6);
        match &self.rest {
            Some(rest) => {
                let stability = match rest.stability() {
                    Stability::Stable => "a stable equilibrium",
                    Stability::Indifferent => "an indifferent equilibrium",
                    Stability::Unstable { .. } => "an unstable equilibrium",
                };
                if self.point.t == 0.0 {
                    stability.into()
                } else {
                    format!("{stability}, drives held at {t} s")
                }
            }
            None if self.point.drives == mbs_analysis::Drives::Held => "a position at rest".into(),
            None => format!("the motion at t = {t} s"),
        }
    }
}

impl Family for Operating<'_> {
    fn with(
        &self,
        parameters: &[f64],
        look: &mut dyn FnMut(&dyn Equations<f64>),
    ) -> Result<(), mbs_runtime::Error> {
        // of a run to a tolerance, whose steps lead to the samples of any clock
        let start = Start {
            parameters: parameters.to_vec(),
            kind: StartKind::Declared,
            method: Explicit::projected(&DOPRI5),
            other: None,
            tolerances: Some(Tolerances::default()),
            ..self.start.clone()
        };
        look(self.model.start(&start)?.equations());
        Ok(())
    }
}

/// A run to a tolerance that is over.
fn after(
    model: &dyn Model,
    settings: Settings,
    time: f64,
    told: &mut dyn FnMut(u64, u64),
) -> Result<Box<dyn System>, Error> {
    if !(time >= 0.0 && time.is_finite()) {
        let reason = "it has to be 0 or later".into();
        return Err(Error::Value { what: "after".into(), text: format!("{time} s"), reason });
    }
    let tolerances = Some(Tolerances { rtol: 1e-10, atol: 1e-12, ..Tolerances::default() });
    // what is declared for constant steps has no use here
    let (stabilization, alpha, beta) = (None, None, None);
    let (step, end) = if time > 0.0 { (time / PARTS as f64, time) } else { (settings.step, settings.step) };
    let settings = Settings { step, end, tolerances, stabilization, alpha, beta, ..settings };
    let mut run = model.start(&Start::of(model, &settings)?)?;
    let steps = if time > 0.0 { run.ends_at(run.time() + time)? } else { 0 };
    for done in 1..=steps {
        run.step()?;
        told(done, steps);
    }
    Ok(run)
}

/// The doubt about a linear system whose derivatives are not known well; `None` if they are.
pub fn doubt(linear: &Linearization) -> Option<String> {
    let digits = (-linear.uncertainty.log10()).floor().max(0.0);
    (linear.uncertainty >= DOUBTFUL).then(|| {
        format!(
            "the accelerations are not smooth at this point (a stop, or friction that changes its sign): their \
             derivatives are known to {digits} digits"
        )
    })
}
