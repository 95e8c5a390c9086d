//! How generated code reads what a program depends on.

use mbs_symbolic::Operand;
use proc_macro2::TokenStream;
use quote::quote;

use super::names::Names;
use crate::compiled::{Compiled, Input, Vector};

/// How generated code reads the symbols of a program.
pub struct Access {
    /// The mechanism, `self` in a method.
    pub this: TokenStream,
    /// Its type, which holds splines.
    pub mechanism: TokenStream,
    /// The parameters, `self.parameters` or a variable.
    pub parameters: TokenStream,
    pub time: TokenStream,
    pub positions: TokenStream,
    pub velocities: TokenStream,
    /// True if `at` is the state of a step, and not of all coordinates.
    is_of_step: bool,
    kind: Kind,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Kind {
    State,
    Arrays,
    Position,
    Parameters,
    Transposed { weights: usize },
}

/// An argument of a function that runs a part of a program.
pub struct Argument {
    pub declaration: TokenStream,
    pub value: TokenStream,
}

impl Access {
    /// In a method that takes `at: &State`.
    pub fn of_state() -> Self {
        Self {
            this: quote!(self),
            mechanism: quote!(Self),
            parameters: quote!(self.parameters),
            time: quote!(at.t),
            positions: quote!(at.q),
            velocities: quote!(at.v),
            is_of_step: false,
            kind: Kind::State,
        }
    }

    /// In a method that takes `at`, the state of a step.
    pub fn of_step() -> Self {
        Self { is_of_step: true, ..Self::of_state() }
    }

    /// In a method that takes `t` and arrays.
    pub fn of_arrays() -> Self {
        Self { time: quote!(t), kind: Kind::Arrays, ..Self::of_step() }
    }

    /// In a method with `t`, `h`, `half_h`, `t_next` and `gains`, and with vectors as arrays, of which the weights have this
    /// length.
    pub fn of_transposed(weights: usize) -> Self {
        Self { time: quote!(t), kind: Kind::Transposed { weights }, ..Self::of_state() }
    }

    /// In a method that takes `t` and `q`.
    pub fn of_position() -> Self {
        Self {
            time: quote!(t),
            positions: quote!(q),
            velocities: quote!(v),
            kind: Kind::Position,
            ..Self::of_state()
        }
    }

    /// In a function that takes `parameters` alone.
    pub fn of_parameters() -> Self {
        Self { parameters: quote!(parameters), kind: Kind::Parameters, ..Self::of_position() }
    }

    /// True if positions are a reference to the vector.
    pub fn is_borrowed(&self) -> bool {
        self.kind == Kind::Position
    }

    /// True if slots and results are arguments too, as of stages on arrays.
    pub fn is_on_arrays(&self) -> bool {
        self.kind == Kind::Arrays
    }

    /// True if a vector is an argument that is an array.
    pub fn has_array(&self, vector: Vector) -> bool {
        match self.kind {
            Kind::Arrays => vector.is_given(),
            Kind::Transposed { .. } => vector != Vector::Parameters,
            Kind::State | Kind::Position | Kind::Parameters => false,
        }
    }

    /// The number of components of a vector.
    pub fn components(&self, compiled: &Compiled, vector: Vector) -> usize {
        match (vector, self.kind) {
            (Vector::Weights, Kind::Transposed { weights }) => weights,
            _ => compiled.components(vector),
        }
    }

    /// The same in a function with the [`arguments`](Self::arguments).
    pub fn in_part(&self, names: &Names) -> Self {
        let mechanism = &names.mechanism;
        let parameters = match self.kind {
            Kind::Parameters => quote!(parameters),
            _ => quote!(this.parameters),
        };
        let (time, positions, velocities) =
            (self.time.clone(), self.positions.clone(), self.velocities.clone());
        let mechanism = quote!(#mechanism::<T>);
        let Self { is_of_step, kind, .. } = *self;
        Self { this: quote!(this), mechanism, parameters, time, positions, velocities, is_of_step, kind }
    }

    /// The arguments of a function that reads these operands.
    pub fn arguments(&self, compiled: &Compiled, names: &Names, operands: &[Operand]) -> Vec<Argument> {
        let Names { mechanism, parameters, runtime, state, stepped, reactions, .. } = names;
        let state = if self.is_of_step { stepped } else { state };
        let (q, rows, inputs) = (&names.coordinates.of_t, &names.constraints.of_t, &names.inputs.of_t);
        let states = &names.states.of_t;
        let uses = |wanted: &dyn Fn(Operand) -> bool| operands.iter().any(|&operand| wanted(operand));
        let means = |wanted: fn(Input) -> bool| {
            uses(&|operand| matches!(operand, Operand::Symbol(symbol) if wanted(compiled.input(symbol))))
        };
        let is_parameter = means(|meaning| matches!(meaning, Input::Parameter(_)));
        let is_hoisted = uses(&|operand| matches!(operand, Operand::Hoisted(_)));
        let is_time = means(|meaning| meaning == Input::Time);
        let is_position = means(|meaning| matches!(meaning, Input::Position(_) | Input::StatePosition(_)));
        let is_velocity = means(|meaning| matches!(meaning, Input::Velocity(_) | Input::StateVelocity(_)));
        let of = |kind| self.kind == kind;
        let argument = |declaration, value| Argument { declaration, value };
        [
            (is_hoisted || is_parameter && !of(Kind::Parameters))
                .then(|| argument(quote!(this: &#mechanism<T>), quote!(self))),
            (is_parameter && of(Kind::Parameters))
                .then(|| argument(quote!(parameters: &#parameters<T>), quote!(&parameters))),
            ((is_time || is_position || is_velocity) && of(Kind::State))
                .then(|| argument(quote!(at: &#state), quote!(at))),
            (is_time && !of(Kind::State)).then(|| argument(quote!(t: T), quote!(t))),
            (is_position && of(Kind::Position)).then(|| argument(quote!(q: &#q), quote!(q))),
            (means(|meaning| matches!(meaning, Input::Input(_))) && !self.has_array(Vector::Inputs))
                .then(|| argument(quote!(inputs: &#inputs), quote!(inputs))),
            means(|meaning| matches!(meaning, Input::MinusTwoAlpha | Input::MinusBetaSquared))
                .then(|| argument(quote!(gains: &#runtime::Gains<T>), quote!(gains))),
            (means(|meaning| matches!(meaning, Input::Feedback(_))) && !self.has_array(Vector::Feedback))
                .then(|| argument(quote!(feedback: &#rows), quote!(feedback))),
            means(|meaning| meaning == Input::Step).then(|| argument(quote!(h: T), quote!(h))),
            means(|meaning| meaning == Input::HalfStep).then(|| argument(quote!(half_h: T), quote!(half_h))),
            means(|meaning| meaning == Input::NextTime).then(|| argument(quote!(t_next: T), quote!(t_next))),
            means(|meaning| meaning == Input::Shift).then(|| argument(quote!(shift: T), quote!(shift))),
            means(|meaning| matches!(meaning, Input::Predicted(_)))
                .then(|| argument(quote!(predicted: &#states), quote!(predicted))),
            (means(|meaning| matches!(meaning, Input::Multiplier(_) | Input::Acceleration(_)))
                && !self.has_array(Vector::Multipliers))
            .then(|| argument(quote!(reactions: &#reactions), quote!(reactions))),
        ]
        .into_iter()
        .flatten()
        .collect()
    }
}
