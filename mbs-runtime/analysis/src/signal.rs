//! Inputs and outputs of a linear system.

use mbs_runtime::{Dimension, Info, Quantity};

use crate::Error;

const SECOND: Dimension = Dimension::of(0, 0, 1);
const PER_SECOND: Dimension = Dimension::of(0, 0, -1);

/// A quantity of a mechanism, by its position in [`Info`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Variable {
    /// A coordinate, in m or rad; of an own state z, its integral ∫ z dt.
    Coordinate(usize),
    /// The rate of a coordinate, in m/s or rad/s; or an own state.
    Velocity(usize),
    /// An input.
    Input(usize),
    /// A parameter.
    Parameter(usize),
    /// A declared output.
    Output(usize),
    /// The multiplier of a constraint: a force, or a torque.
    Multiplier(usize),
}

/// A quantity of a linear system, in SI units and rad. See the example of [`Signal::of`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Signal {
    /// Its name: `x`, `der(x)`, `lambda(pin_x)`, or that of an own state, an input, a parameter or an output; that
    /// of the integral of an own state is `integral(z)`.
    pub name: String,
    /// The quantity of the mechanism.
    pub variable: Variable,
    /// Its dimension.
    pub dimension: Dimension,
}

impl Signal {
    /// The signal of a variable; `None` if the mechanism does not have it.
    ///
    /// # Example
    /// A slide on a wedge, y = 0.2 x:
    /// ```
    /// use mbs_analysis::{Signal, Variable};
    /// # use mbs_runtime::{Dimension, Mechanism, mechanism};
    /// # mechanism! {
    /// #     pub Wedge {
    /// #         dof = 1;
    /// #         param slope = 0.2;
    /// #         body slide (x, y) { mass = 1 [kg]; }
    /// #         constraint guide: y = slope*x;
    /// #         output height [m] = y;
    /// #     }
    /// # }
    ///
    /// let info = <Wedge as Mechanism>::INFO;
    /// let speed = Signal::of(info, Variable::Velocity(0)).ok_or("two coordinates")?;
    /// assert_eq!((speed.name.as_str(), speed.dimension), ("der(x)", Dimension::of(0, 1, -1)));
    /// // the multiplier of a length is a force
    /// let force = Signal::of(info, Variable::Multiplier(0)).ok_or("one constraint")?;
    /// assert_eq!(force.name, "lambda(guide)");
    /// assert_eq!(force.dimension, Dimension::of(1, 1, -2));
    /// assert_eq!(Signal::of(info, Variable::Coordinate(2)), None);
    /// # Ok::<(), &str>(())
    /// ```
    pub fn of(info: &Info, variable: Variable) -> Option<Self> {
        let declared = |list: &[Quantity], at: usize| list.get(at).map(|q| (q.name.to_owned(), q.dimension));
        let (name, dimension) = match variable {
            Variable::Coordinate(at) if info.is_own(at) => declared(info.coordinates, at)
                .map(|(name, of)| (format!("integral({name})"), of.over(PER_SECOND))),
            Variable::Velocity(at) if info.is_own(at) => declared(info.coordinates, at),
            Variable::Coordinate(at) => declared(info.coordinates, at),
            Variable::Velocity(at) => {
                declared(info.coordinates, at).map(|(name, of)| (format!("der({name})"), of.over(SECOND)))
            }
            Variable::Input(at) => declared(info.inputs, at),
            Variable::Parameter(at) => declared(info.parameters, at),
            Variable::Output(at) => declared(info.outputs, at),
            Variable::Multiplier(at) => info.constraints.get(at).map(|row| {
                // λ does work on Φ
                (format!("lambda({})", row.name), Dimension::of(1, 2, -2).over(row.dimension))
            }),
        }?;
        Some(Self { name, variable, dimension })
    }

    /// True for the integral of an own state, on which nothing depends: a linear system does not have it.
    ///
    /// # Example
    /// ```
    /// use mbs_analysis::Signal;
    /// # use mbs_runtime::{Mechanism, mechanism};
    /// # mechanism! {
    /// #     pub Decay {
    /// #         dof = 0;
    /// #         state z [1] = 1;
    /// #         der(z) = -z/(1 [s]);
    /// #     }
    /// # }
    ///
    /// let info = <Decay as Mechanism>::INFO;
    /// let integrals: Vec<bool> = Signal::states(info).iter().map(|signal| signal.is_integral(info)).collect();
    /// assert_eq!(integrals, [true, false]);
    /// ```
    pub fn is_integral(&self, info: &Info) -> bool {
        matches!(self.variable, Variable::Coordinate(at) if info.is_own(at))
    }

    fn all(info: &Info, count: usize, of: impl Fn(usize) -> Variable) -> Vec<Self> {
        (0..count).filter_map(|at| Self::of(info, of(at))).collect()
    }

    /// All coordinates, then all rates; with own states, the integrals and the states.
    pub fn states(info: &Info) -> Vec<Self> {
        let n = info.coordinates.len();
        [Self::all(info, n, Variable::Coordinate), Self::all(info, n, Variable::Velocity)].concat()
    }

    /// All that can be observed of a mechanism: outputs, coordinates, their rates, multipliers.
    ///
    /// # Example
    /// ```
    /// # use mbs_analysis::{Signal, Variable};
    /// # use mbs_runtime::{Dimension, Mechanism, mechanism};
    /// # mechanism! {
    /// #     pub Wedge {
    /// #         dof = 1;
    /// #         param slope = 0.2;
    /// #         body slide (x, y) { mass = 1 [kg]; }
    /// #         constraint guide: y = slope*x;
    /// #         output height [m] = y;
    /// #     }
    /// # }
    /// let signals = Signal::observable(<Wedge as Mechanism>::INFO);
    /// let names: Vec<&str> = signals.iter().map(|signal| signal.name.as_str()).collect();
    /// assert_eq!(names, ["height", "x", "y", "der(x)", "der(y)", "lambda(guide)"]);
    /// ```
    pub fn observable(info: &Info) -> Vec<Self> {
        let n = info.coordinates.len();
        [
            Self::all(info, info.outputs.len(), Variable::Output),
            Self::all(info, n, Variable::Coordinate),
            Self::all(info, n, Variable::Velocity),
            Self::all(info, info.constraints.len(), Variable::Multiplier),
        ]
        .concat()
    }

    /// All by which a run can be differentiated: parameters, then coordinates and their rates at the start.
    ///
    /// # Example
    /// ```
    /// # use mbs_analysis::{Signal, Variable};
    /// # use mbs_runtime::{Dimension, Mechanism, mechanism};
    /// # mechanism! {
    /// #     pub Wedge {
    /// #         dof = 1;
    /// #         param slope = 0.2;
    /// #         body slide (x, y) { mass = 1 [kg]; }
    /// #         constraint guide: y = slope*x;
    /// #         output height [m] = y;
    /// #     }
    /// # }
    /// let signals = Signal::adjustable(<Wedge as Mechanism>::INFO);
    /// let names: Vec<&str> = signals.iter().map(|signal| signal.name.as_str()).collect();
    /// assert_eq!(names, ["slope", "x", "y", "der(x)", "der(y)"]);
    /// ```
    pub fn adjustable(info: &Info) -> Vec<Self> {
        let n = info.coordinates.len();
        [
            Self::all(info, info.parameters.len(), Variable::Parameter),
            Self::all(info, n, Variable::Coordinate),
            Self::all(info, n, Variable::Velocity),
        ]
        .concat()
    }

    /// The memories that tell what state a mechanism is in, but for those of which an output has the name.
    ///
    /// # Example
    /// ```
    /// # use mbs_analysis::Signal;
    /// # use mbs_runtime::{Mechanism, mechanism};
    /// # mechanism! {
    /// #     pub Ball {
    /// #         dof = 1;
    /// #         body ball (y) { mass = 2 [kg]; }
    /// #         stop floor: y >= 0 [m] { restitution = 0.7; }
    /// #     }
    /// # }
    /// let memories = Signal::memories(<Ball as Mechanism>::INFO);
    /// let names: Vec<&str> = memories.iter().map(|signal| signal.name.as_str()).collect();
    /// assert_eq!(names, ["floor", "floor_impulse"]);
    /// ```
    pub fn memories(info: &Info) -> Vec<Self> {
        let is_output = |signal: &Self| info.outputs.iter().any(|output| output.name == signal.name);
        let memories = info.told_memories().filter_map(|at| Self::of(info, Variable::Input(at)));
        memories.filter(|signal| !is_output(signal)).collect()
    }

    /// The inputs with these names, or all.
    pub(crate) fn inputs(info: &Info, names: Option<&[String]>) -> Result<Vec<Self>, Error> {
        // stops and modes set their memories where something jumps, and in between these change nothing
        let first = info.free_inputs().len();
        let of_stop = |at: usize| info.stops.iter().any(|stop| stop.memory == at || stop.memory + 1 == at);
        let of_mode = |at: usize| info.modes.modes.iter().any(|mode| mode.memory == at);
        let memories = info.told_memories().filter(|at| !of_stop(*at) && !of_mode(*at));
        let places = (0..first).chain(memories);
        let all: Vec<Self> = places.filter_map(|at| Self::of(info, Variable::Input(at))).collect();
        names.map_or(Ok(all.clone()), |names| chosen("input", &all, names))
    }

    /// The parameters with these names.
    pub(crate) fn parameters(info: &Info, names: &[String]) -> Result<Vec<Self>, Error> {
        chosen("parameter", &Self::all(info, info.parameters.len(), Variable::Parameter), names)
    }

    /// The coordinates with these names.
    pub(crate) fn coordinates(info: &Info, names: &[String]) -> Result<Vec<Self>, Error> {
        chosen("coordinate", &Self::all(info, info.coordinates.len(), Variable::Coordinate), names)
    }

    /// The outputs with these names: declared ones, coordinates, their rates, own states and multipliers. Without
    /// names the declared ones, or the coordinates and own states of a mechanism that declares none. The integral of
    /// an own state is none: a linear system does not have it.
    pub(crate) fn outputs(info: &Info, names: Option<&[String]>) -> Result<Vec<Self>, Error> {
        if let Some(names) = names {
            let mut known = Self::observable(info);
            known.retain(|signal| !signal.is_integral(info));
            return chosen("output", &known, names);
        }
        let declared = Self::all(info, info.outputs.len(), Variable::Output);
        let of = |at: usize| if info.is_own(at) { Variable::Velocity(at) } else { Variable::Coordinate(at) };
        let coordinates = || Self::all(info, info.coordinates.len(), of);
        Ok(if declared.is_empty() { coordinates() } else { declared })
    }
}

fn chosen(kind: &'static str, known: &[Signal], names: &[String]) -> Result<Vec<Signal>, Error> {
    let find = |name: &String| {
        let found = known.iter().find(|signal| signal.name == *name).cloned();
        found.ok_or_else(|| Error::Unknown {
            kind,
            name: name.clone(),
            known: known.iter().map(|signal| signal.name.clone()).collect(),
        })
    };
    names.iter().map(find).collect()
}
