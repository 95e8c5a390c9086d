//! The variables that an importer sees, and the numbers by which it asks for them.

use super::structure::tunable;
use super::units::Unit;
use crate::compiled::{Comparison, Compiled, FunctionId, Quantity};
use mbs_symbolic::units::Dimension;

/// The role of a variable for an importer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The independent variable.
    Time,
    /// Set before a run.
    Parameter,
    /// Set before a run and between its steps.
    Tunable,
    /// Set at any time.
    Input,
    /// Set by a clock, and held between its samples.
    Memory,
    /// Calculated, and of interest.
    Local,
    /// Calculated, and offered to others.
    Output,
}

/// A variable. Its value reference is its place in the list.
pub struct Variable {
    pub name: String,
    pub description: String,
    pub role: Role,
    pub unit: Unit,
    /// Its value before a run, of those that are set.
    pub start: Option<f64>,
    /// Bounds that its value must not leave.
    pub bounds: [Option<f64>; 2],
    /// The value reference of what it is the derivative of, if that is integrated.
    pub derivative_of: Option<usize>,
}

/// Where each kind of variables begins among the value references, with its name in the code.
pub struct References {
    pub starts: [(&'static str, usize); GROUPS],
}

const GROUPS: usize = 10;

impl References {
    pub fn new(compiled: &Compiled) -> Self {
        let coordinates = compiled.coordinates.len();
        let groups = [
            ("TIME", 1),
            ("PARAMETERS", compiled.parameters.len()),
            ("INPUTS", compiled.inputs.len() - compiled.sampling.memories),
            ("MEMORIES", compiled.sampling.memories),
            ("POSITIONS", coordinates),
            ("VELOCITIES", coordinates),
            ("ACCELERATIONS", coordinates),
            ("MULTIPLIERS", compiled.constraints.len()),
            ("OUTPUTS", compiled.outputs.len()),
            ("EVENTS", compiled.events.len()),
        ];
        let mut next = 0;
        Self {
            starts: groups.map(|(name, count)| {
                let start = next;
                next += count;
                (name, start)
            }),
        }
    }

    /// Where a kind begins.
    pub fn of(&self, group: Group) -> usize {
        self.starts[group as usize].1
    }
}

/// A kind of variables, in the order of their value references.
#[derive(Clone, Copy)]
pub enum Group {
    Time,
    Inputs = 2,
    Memories,
    Positions,
    Velocities,
    Accelerations,
    Outputs = 8,
    Events,
}

/// All variables, in the order of their value references.
pub fn all(compiled: &Compiled, references: &References) -> Vec<Variable> {
    let is_state = |at: &usize| compiled.states.contains(at);
    let derivative = |group, at: usize| is_state(&at).then(|| references.of(group) + at);
    let mut all = vec![Variable {
        description: "simulation time; the mechanism begins at its declared start".into(),
        ..Variable::calculated("time".into(), Role::Time, Unit::si(Dimension::TIME, 0))
    }];
    let roles = tunable(compiled).into_iter().map(|it| if it { Role::Tunable } else { Role::Parameter });
    all.extend(compiled.parameters.iter().zip(roles).enumerate().map(|(at, (it, role))| Variable {
        start: Some(it.value),
        bounds: bounds(compiled, at),
        ..Variable::of(&it.quantity, role)
    }));
    let (inputs, memories) = compiled.inputs.split_at(compiled.inputs.len() - compiled.sampling.memories);
    let inputs = inputs.iter();
    all.extend(
        inputs.map(|it| Variable { start: Some(it.value), ..Variable::of(&it.quantity, Role::Input) }),
    );
    all.extend(memories.iter().map(|it| Variable::of(&it.quantity, Role::Memory)));
    for order in 0..3_i16 {
        let names = compiled.coordinates.iter().enumerate();
        all.extend(names.map(|(at, it)| {
            // an own state is the rate of its integral
            let is_own = at >= compiled.line_count;
            let unit = match (is_own, order) {
                (false, _) => Unit::of_coordinate(it.dimension, order),
                (true, 1) => Unit::of(it),
                (true, _) => Unit::si(it.dimension.times(Dimension::of(0, 0, 1 - order)), 0),
            };
            let (name, derivative_of) = match (order, is_own) {
                (0, false) => (it.name.clone(), None),
                (0, true) => (format!("integral({})", it.name), None),
                (1, false) => (format!("der({})", it.name), derivative(Group::Positions, at)),
                (1, true) => (it.name.clone(), derivative(Group::Positions, at)),
                (_, false) => (format!("der({},2)", it.name), derivative(Group::Velocities, at)),
                (_, true) => (format!("der({})", it.name), derivative(Group::Velocities, at)),
            };
            let description = if order == i16::from(is_own) { it.doc.clone() } else { String::new() };
            Variable { description, derivative_of, ..Variable::calculated(name, Role::Local, unit) }
        }));
    }
    all.extend(compiled.constraints.iter().map(|it| {
        // a multiplier does work on its constraint
        let unit = Unit::si(Dimension::of(1, 2, -2).over(it.dimension), 0);
        let name = format!("lambda({})", it.name);
        Variable { description: it.doc.clone(), ..Variable::calculated(name, Role::Local, unit) }
    }));
    all.extend(compiled.outputs.iter().map(|it| Variable::of(it, Role::Output)));
    all.extend(compiled.events.iter().map(|it| Variable::of(&it.quantity, Role::Local)));
    with_names_of_their_own(&mut all);
    all
}

/// Names are unique for an importer. An output may be called as what it shows: then that is called `memory(u)`, where a
/// clock sets it, and else the output `output(u)`.
fn with_names_of_their_own(all: &mut [Variable]) {
    for at in 0..all.len() {
        let Some(other) = all[..at].iter().position(|other| other.name == all[at].name) else { continue };
        let at = if all[other].role == Role::Memory { other } else { at };
        let word = match all[at].role {
            Role::Memory => "memory",
            Role::Output => "output",
            _ => "event",
        };
        all[at].name = format!("{word}({})", all[at].name);
    }
}

impl Variable {
    fn of(quantity: &Quantity, role: Role) -> Self {
        let description = quantity.doc.clone();
        Self { description, ..Self::calculated(quantity.name.clone(), role, Unit::of(quantity)) }
    }

    fn calculated(name: String, role: Role, unit: Unit) -> Self {
        Self {
            name,
            description: String::new(),
            role,
            unit,
            start: None,
            bounds: [None; 2],
            derivative_of: None,
        }
    }
}

/// The bounds of a parameter: conditions that compare it, as it is, with 0.
fn bounds(compiled: &Compiled, parameter: usize) -> [Option<f64>; 2] {
    let conditions = compiled.program(FunctionId::Conditions);
    let is_it = |at: usize| {
        let judged = conditions.outputs.get(at).and_then(|operand| compiled.input_of(*operand));
        judged == Some(crate::compiled::Input::Parameter(parameter))
    };
    let mut bounds = [None; 2];
    for condition in compiled.conditions.iter().filter(|condition| is_it(condition.difference)) {
        match condition.comparison {
            Comparison::Greater | Comparison::GreaterOrEqual => bounds[0] = Some(0.0),
            Comparison::Less | Comparison::LessOrEqual => bounds[1] = Some(0.0),
        }
    }
    bounds
}
