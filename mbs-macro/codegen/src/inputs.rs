//! The meanings of the symbols of programs: those of a declaration, and those that a method of
//! integration adds, which no declaration names.

use mbs_symbolic::{Stage, Symbol};

use crate::model::{Meaning, Model};

/// The meaning of a symbol of a program: a number, or a component of a vector.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Input {
    /// t in s
    Time,
    /// A parameter.
    Parameter(usize),
    /// An input.
    Input(usize),
    /// A component of q.
    Position(usize),
    /// A component of v.
    Velocity(usize),
    /// A component of the positions that are integrated, where those are not all.
    StatePosition(usize),
    /// A component of the velocities that are integrated, where those are not all.
    StateVelocity(usize),
    /// A component of q̈.
    Acceleration(usize),
    /// A component of λ.
    Multiplier(usize),
    /// An amount added to γ of a constraint; of corrections, its residual.
    Feedback(usize),
    /// The predicted acceleration of a coordinate that is integrated.
    Predicted(usize),
    /// The share s of a step that an implicit stage has of its own slope.
    Shift,
    /// −2α
    MinusTwoAlpha,
    /// −β²
    MinusBetaSquared,
    /// h of a step.
    Step,
    /// h/2
    HalfStep,
    /// t + h
    NextTime,
    /// How much a result counts of a function that is transposed; how fast an argument changes of one whose tangent
    /// it is.
    Weight(usize),
}

/// A coordinate that is integrated.
#[derive(Clone, Copy, Debug)]
pub struct State {
    /// Which one it is.
    pub coordinate: usize,
    /// The symbols of its position and its velocity in the functions of a step: those of the
    /// coordinate, unless other coordinates are not integrated.
    pub position: Symbol,
    pub velocity: Symbol,
    /// Its predicted acceleration in an implicit stage.
    pub predicted: Symbol,
}

/// All inputs of programs, and the symbols of those that a method adds.
pub struct Inputs {
    /// In the order of the symbols.
    all: Vec<Input>,
    pub time: Symbol,
    /// The coordinates that are integrated, in their order.
    pub states: Vec<State>,
    pub minus_two_alpha: Symbol,
    pub minus_beta_squared: Symbol,
    /// Per constraint.
    pub feedback: Vec<Symbol>,
    pub step: Symbol,
    pub half_step: Symbol,
    pub next_time: Symbol,
    pub shift: Symbol,
}

impl Inputs {
    /// The symbols of a model, and new ones for a method.
    pub fn new(model: &mut Model) -> Self {
        let mut all: Vec<Input> = model.meanings.iter().copied().map(Input::from).collect();
        let arena = &mut model.arena;
        let mut add = |name: &str, input| {
            all.push(input);
            arena.symbol(name, Stage::Variable)
        };
        let names = model.constraints.iter().enumerate();
        let feedback = names.map(|(row, it)| add(&format!("feedback({})", it.name), Input::Feedback(row)));
        let feedback = feedback.collect();
        let minus_two_alpha = add("(-2*alpha)", Input::MinusTwoAlpha);
        let minus_beta_squared = add("(-beta^2)", Input::MinusBetaSquared);
        let step = add("(h)", Input::Step);
        let half_step = add("(h/2)", Input::HalfStep);
        let next_time = add("(t+h)", Input::NextTime);
        let shift = add("(s)", Input::Shift);
        let time = model.time;
        let states = model.coordinates.iter().enumerate().map(|(coordinate, it)| State {
            coordinate,
            position: it.position,
            velocity: it.velocity,
            predicted: add(&format!("predicted({})", it.quantity.name), Input::Predicted(coordinate)),
        });
        let states = states.collect();
        Self {
            all,
            time,
            states,
            minus_two_alpha,
            minus_beta_squared,
            feedback,
            step,
            half_step,
            next_time,
            shift,
        }
    }

    /// Integrates these coordinates alone, which get symbols of their own.
    pub fn reduce(&mut self, model: &mut Model, coordinates: &[usize]) {
        self.states.clear();
        for (at, &coordinate) in coordinates.iter().enumerate() {
            let of = &model.coordinates[coordinate];
            let [position, velocity] = [of.position, of.velocity].map(|symbol| {
                let name = model.arena.name(symbol).to_owned();
                model.arena.symbol(&name, Stage::Variable)
            });
            let name = format!("predicted({})", of.quantity.name);
            let predicted = model.arena.symbol(&name, Stage::Variable);
            self.all.extend([Input::StatePosition(at), Input::StateVelocity(at), Input::Predicted(at)]);
            self.states.push(State { coordinate, position, velocity, predicted });
        }
    }

    /// The meaning of a symbol.
    pub fn of(&self, symbol: Symbol) -> Option<Input> {
        self.all.get(symbol.index()).copied()
    }

    /// In the order of the symbols.
    pub fn iter(&self) -> impl Iterator<Item = Input> {
        self.all.iter().copied()
    }

    /// Values of symbols: declared parameters, and `other` for the rest.
    pub fn values<'a>(
        &'a self,
        model: &'a Model,
        other: impl Fn(Input) -> f64 + 'a,
    ) -> impl Fn(Symbol) -> f64 + 'a {
        move |symbol| match self.of(symbol) {
            Some(Input::Parameter(at)) => model.parameters[at].value,
            Some(input) => other(input),
            None => f64::NAN,
        }
    }
}

impl From<Meaning> for Input {
    fn from(meaning: Meaning) -> Self {
        match meaning {
            Meaning::Time => Self::Time,
            Meaning::Parameter(at) => Self::Parameter(at),
            Meaning::Input(at) => Self::Input(at),
            Meaning::Coordinate(at) => Self::Position(at),
            Meaning::Velocity(at) => Self::Velocity(at),
            Meaning::Acceleration(at) => Self::Acceleration(at),
            Meaning::Multiplier(at) => Self::Multiplier(at),
        }
    }
}
