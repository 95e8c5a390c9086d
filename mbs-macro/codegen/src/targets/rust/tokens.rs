//! Numbers, symbols and operations as tokens.

use mbs_symbolic::layout::Component;
use mbs_symbolic::{Number, Operation, Symbol};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::quote;

use super::access::Access;
use super::names::field;
use super::splines::spline_name;
use crate::compiled::{Compiled, Input};
use crate::diagnostics::Diagnostic;

/// Tokens for a place where nothing right can be written: the compiler refuses them with these words.
pub fn internal(what: &str) -> TokenStream {
    let text = Diagnostic::internal(Span::call_site(), what).text();
    quote!(::core::compile_error!(#text))
}

/// How generated code reads a symbol.
pub fn symbol(compiled: &Compiled, access: &Access, symbol: Symbol) -> TokenStream {
    let Access { parameters, time, positions, velocities, .. } = access;
    let meaning = compiled.input(symbol);
    if let Some(Component { vector, place }) = meaning.component()
        && access.has_array(vector)
    {
        let (array, at) = (vector.ident(), Literal::usize_unsuffixed(place));
        return quote!(#array[#at]);
    }
    let coordinate = |at: usize| field(&compiled.coordinates[at].name);
    let row = |at: usize| field(&compiled.constraints[at].name);
    match meaning {
        Input::Time => time.clone(),
        Input::Parameter(at) => {
            let name = field(&compiled.parameters[at].quantity.name);
            quote!(#parameters.#name)
        }
        Input::Input(at) => {
            let name = field(&compiled.inputs[at].quantity.name);
            quote!(inputs.#name)
        }
        Input::Position(at) => {
            let name = coordinate(at);
            quote!(#positions.#name)
        }
        Input::Velocity(at) => {
            let name = coordinate(at);
            quote!(#velocities.#name)
        }
        Input::StatePosition(at) => {
            let name = coordinate(compiled.states[at]);
            quote!(#positions.#name)
        }
        Input::StateVelocity(at) => {
            let name = coordinate(compiled.states[at]);
            quote!(#velocities.#name)
        }
        Input::Acceleration(at) => {
            let name = coordinate(at);
            quote!(reactions.acceleration.#name)
        }
        Input::Multiplier(at) => {
            let name = row(at);
            quote!(reactions.multipliers.#name)
        }
        Input::Feedback(at) => {
            let name = row(at);
            quote!(feedback.#name)
        }
        Input::Predicted(at) => {
            let name = coordinate(compiled.states[at]);
            quote!(predicted.#name)
        }
        Input::Shift => quote!(shift),
        Input::MinusTwoAlpha => quote!(gains.minus_two_alpha),
        Input::MinusBetaSquared => quote!(gains.minus_beta_squared),
        Input::Step => quote!(h),
        Input::HalfStep => quote!(half_h),
        Input::NextTime => quote!(t_next),
        Input::Weight(_) => internal("a weight is read that is not given"),
    }
}

/// The lints that generated code need not keep: a program does not read all that its function is given, and it is
/// written instruction by instruction, not as a person would.
pub fn lints() -> TokenStream {
    quote!(#[allow(unused_variables, clippy::all)])
}

/// The value of an operation on `a` and, where it has two operands, `b`.
pub fn operation(
    operation: Operation,
    a: &TokenStream,
    b: &TokenStream,
    mechanism: &TokenStream,
) -> TokenStream {
    match operation {
        Operation::Add => quote!(#a + #b),
        Operation::Sub => quote!(#a - #b),
        Operation::Mul => quote!(#a * #b),
        Operation::Div => quote!(#a / #b),
        Operation::Neg => quote!(-#a),
        Operation::Call(function) => {
            let method = Ident::new(function.row().name, Span::call_site());
            let both = [a, b];
            let others = function.arguments(&both).iter().skip(1);
            quote!(#a.#method(#(#others),*))
        }
        Operation::Spline(spline, order) => {
            let (table, order) = (spline_name(spline.index()), Literal::u8_unsuffixed(order));
            quote!(#mechanism::#table.derivative(#order, #a))
        }
    }
}

/// A number as a scalar.
pub fn number(number: Number) -> TokenStream {
    float(number.to_f64())
}

/// A double as a scalar; NaN stands for what is not finite.
pub fn float(value: f64) -> TokenStream {
    if !value.is_finite() {
        return quote!(T::from_f64(::core::primitive::f64::NAN));
    }
    let literal = Literal::f64_unsuffixed(value);
    quote!(T::from_f64(#literal))
}
