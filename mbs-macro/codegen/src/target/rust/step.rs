//! A whole step as one function on pairs of scalars.

use std::collections::BTreeSet;

use mbs_symbolic::pairs::{Given, Lane, Scalar, Step, Woven};
use mbs_symbolic::{Inconsistency, Operation, Program};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::access::Access;
use super::functions::Fields;
use super::names::Names;
use super::program::{body_of, named, number_tokens, operation_tokens, symbol_tokens};
use super::weave;
use crate::compiled::{Compiled, Kinds};

/// A fused step with what else it gives or is given, for both kinds of feedback.
struct Variant<'a> {
    /// Of the names of its functions.
    suffix: &'static str,
    doc: &'static str,
    programs: &'a Kinds,
    gives_reactions: bool,
    has_clock: bool,
}

/// Those of a mechanism; none if it is too large.
fn variants(compiled: &Compiled) -> Vec<Variant<'_>> {
    let Some(step) = &compiled.fused_step else { return Vec::new() };
    let alone =
        Variant { suffix: "", doc: "", programs: &step.alone, gives_reactions: false, has_clock: false };
    let with_reactions = step.with_reactions.as_ref().map(|programs| Variant {
        suffix: "_with_reactions",
        doc: ", and the reactions at its start",
        programs,
        gives_reactions: true,
        has_clock: false,
    });
    let with_clock = step.clocked.as_ref().map(|clocked| Variant {
        suffix: "_with_clock",
        doc: ", given the functions of time at both of its ends",
        programs: &clocked.step,
        gives_reactions: false,
        has_clock: true,
    });
    [Some(alone), with_reactions, with_clock].into_iter().flatten().collect()
}

impl Variant<'_> {
    /// What its functions give.
    fn result(&self, names: &Names) -> TokenStream {
        let Names { runtime, reactions, .. } = names;
        let states = &names.states.of_t;
        let stepped = quote!(#runtime::Stepped<#states>);
        if self.gives_reactions { quote!((#stepped, #reactions)) } else { stepped }
    }

    /// One of its functions.
    fn function(
        &self,
        compiled: &Compiled,
        names: &Names,
        (name, feedback): (&str, &str),
        program: &Program,
    ) -> Result<TokenStream, Inconsistency> {
        let Names { runtime, stepped: state, .. } = names;
        let (inputs, result) = (&names.inputs.of_t, self.result(names));
        let woven = weave::woven(compiled, program, self.gives_reactions)?;
        let Body { statements, stepped, reactions } =
            Body::new(compiled, names, &Fields::new(compiled), &woven);
        let value = if self.gives_reactions { quote!((#stepped, #reactions)) } else { stepped };
        let clock = self.has_clock.then(|| quote!([now, next]: [&<Self as #runtime::Mechanism>::Clock; 2],));
        let name = format_ident!("{name}{}", self.suffix);
        let doc = format!("A step with feedback {feedback}{}.", self.doc);
        Ok(quote! {
            #[doc = #doc]
            #[inline(always)]
            fn #name(&self, at: &#state, #clock inputs: &#inputs, gains: &#runtime::Gains<T>, h: T, t_next: T) -> #result {
                #statements #value
            }
        })
    }

    /// The trait's function, which chooses between the two.
    fn choice(&self, names: &Names) -> TokenStream {
        let Names { runtime, stepped: state, .. } = names;
        let (inputs, result) = (&names.inputs.of_t, self.result(names));
        let [name, held, per_stage] =
            ["fused_step", "step_held", "step_per_stage"].map(|name| format_ident!("{name}{}", self.suffix));
        let (given, clock) = match self.has_clock {
            true => (quote!(clock: [&Self::Clock; 2],), quote!(clock,)),
            false => (TokenStream::new(), TokenStream::new()),
        };
        quote! {
            #[inline(always)]
            fn #name<X: #runtime::Method>(&self, at: &#state, #given inputs: &#inputs, gains: &#runtime::Gains<T>, h: T, t_next: T) -> ::core::option::Option<#result> {
                ::core::option::Option::Some(if X::EXPLICIT.is_held() {
                    self.#held(at, #clock inputs, gains, h, t_next)
                } else {
                    self.#per_stage(at, #clock inputs, gains, h, t_next)
                })
            }
        }
    }
}

/// The functions of both kinds of feedback, also with the reactions and with a clock; nothing
/// if the mechanism is too large.
///
/// # Errors
/// A step on pairs that does not compute what its program does.
pub fn functions(compiled: &Compiled, names: &Names) -> Result<TokenStream, Inconsistency> {
    let mut functions = TokenStream::new();
    for variant in variants(compiled) {
        let Kinds { held, per_stage } = variant.programs;
        functions.extend(variant.function(compiled, names, ("step_held", "held over it"), held)?);
        let per_stage = variant.function(compiled, names, ("step_per_stage", "in every stage"), per_stage)?;
        functions.extend(per_stage);
    }
    if functions.is_empty() {
        return Ok(functions);
    }
    let Names { mechanism, runtime, .. } = names;
    Ok(quote! {
        #[allow(unused_variables, clippy::all)]
        impl<T: #runtime::Real> #mechanism<T> { #functions }
    })
}

/// The trait's functions.
pub fn choice(compiled: &Compiled, names: &Names) -> TokenStream {
    variants(compiled).iter().map(|variant| variant.choice(names)).collect()
}

/// The type of the functions of time of a step, and their values.
pub fn clock(compiled: &Compiled, names: &Names) -> TokenStream {
    let Some(clock) = compiled.clock() else {
        return quote! {
            type Clock = [T; 0];
            #[inline(always)]
            fn clock(&self, t: T) -> [T; 0] { [] }
        };
    };
    let body = body_of(compiled, names, clock, &Access::of_position());
    let count = clock.outputs.len();
    let (statements, values) = (&body.statements, body.array(0..count));
    let count = Literal::usize_unsuffixed(count);
    quote! {
        type Clock = [T; #count];
        #[inline(always)]
        fn clock(&self, t: T) -> [T; #count] { #statements #values }
    }
}

/// What a step's function does, and the values that it ends with.
struct Body {
    statements: TokenStream,
    stepped: TokenStream,
    /// Nothing if the program does not give them.
    reactions: TokenStream,
}

impl Body {
    fn new(compiled: &Compiled, names: &Names, fields: &Fields, woven: &Woven) -> Self {
        let runtime = &names.runtime;
        let mut writer =
            Writer { compiled, access: Access::of_step(), names: Vec::new(), taken: BTreeSet::new() };
        let statements: TokenStream = woven.steps.iter().map(|step| writer.statement(step)).collect();
        let value = |&output| {
            let value = writer.scalar(output);
            quote!(#value.get())
        };
        let outputs: Vec<TokenStream> = woven.outputs.iter().map(value).collect();
        let (n, s, m) = (fields.coordinates.len(), fields.states.len(), fields.rows.len());
        let of_states = |values| named(&names.states.of_t, &fields.states, values);
        let (q, v) = (of_states(&outputs[..s]), of_states(&outputs[s..2 * s]));
        let (reactions, growth) = match &outputs[2 * s..] {
            [growth, _] => (TokenStream::new(), growth),
            with_reactions => {
                let acceleration = named(&names.coordinates.of_t, &fields.coordinates, &with_reactions[..n]);
                let multipliers = named(&names.constraints.of_t, &fields.rows, &with_reactions[n..n + m]);
                let growth_here = &with_reactions[n + m + 1];
                let reactions = quote! {
                    #runtime::Reactions { acceleration: #acceleration, multipliers: #multipliers, growth: #growth_here }
                };
                (reactions, &with_reactions[n + m])
            }
        };
        let sum = outputs.last();
        let statements = quote! {
            use #runtime::{Pair as _, Single as _};
            type Single<T> = <<T as #runtime::Real>::Pair as #runtime::Pair<T>>::Single;
            let half_h = T::from_f64(0.5) * h;
            #statements
        };
        let stepped = quote! {
            #runtime::Stepped { next: #runtime::State { t: t_next, q: #q, v: #v }, growth: #growth, sum: #sum }
        };
        Self { statements, stepped, reactions }
    }
}

struct Writer<'a> {
    compiled: &'a Compiled,
    access: Access,
    /// Of the steps so far.
    names: Vec<Ident>,
    taken: BTreeSet<String>,
}

impl Writer<'_> {
    fn statement(&mut self, step: &Step) -> TokenStream {
        let at = self.names.len();
        let pair = |at: &usize| &self.names[*at];
        let value = match step {
            Step::Scalar(operation, a, b, name) => {
                let value = self.operation(*operation, *a, *b);
                let name = self.scalar_name(name.as_deref());
                self.names.push(name.clone());
                return quote!(let #name = #value;);
            }
            Step::Sines(angles) => {
                let angles = pair(angles);
                let (sines, cosines) = (format_ident!("sines{at}"), format_ident!("cosines{at}"));
                let statement = quote!(let (#sines, #cosines) = #angles.straight_sin_cos(););
                self.names.extend([sines, cosines]);
                return statement;
            }
            // Named with the sines.
            Step::Cosines(_) => return TokenStream::new(),
            Step::Join(a, b) => {
                let (a, b) = (self.scalar(*a), self.scalar(*b));
                quote!(T::Pair::join(#a, #b))
            }
            Step::Splat(a) => {
                let a = self.scalar(*a);
                quote!(T::Pair::splat(#a))
            }
            Step::Swap(of) => {
                let of = pair(of);
                quote!(#of.swap())
            }
            Step::Flip(of) => {
                let of = pair(of);
                quote!(#of.flip())
            }
            Step::Pair(operation, a, b) => {
                let (a, b) = (pair(a), pair(b));
                operation_tokens(*operation, &quote!(#a), &quote!(#b), &self.access.mechanism)
            }
        };
        let name = format_ident!("p{at}");
        self.names.push(name.clone());
        quote!(let #name = #value;)
    }

    /// An operation on scalars; functions are those of the scalar type itself.
    fn operation(&self, operation: Operation, a: Scalar, b: Scalar) -> TokenStream {
        let (a, b) = (self.scalar(a), self.scalar(b));
        match operation {
            Operation::Call(_) | Operation::Call2(_) | Operation::Spline(..) => single(operation_tokens(
                operation,
                &quote!(#a.get()),
                &quote!(#b.get()),
                &self.access.mechanism,
            )),
            _ => operation_tokens(operation, &a, &b, &self.access.mechanism),
        }
    }

    fn scalar(&self, scalar: Scalar) -> TokenStream {
        match scalar {
            Scalar::Given(Given::Number(number)) => single(number_tokens(number)),
            Scalar::Given(Given::Symbol(symbol)) => {
                single(symbol_tokens(self.compiled, &self.access, symbol))
            }
            Scalar::Given(Given::Hoisted(at)) => {
                let at = Literal::usize_unsuffixed(at);
                single(quote!(self.hoisted[#at]))
            }
            Scalar::Step(at) => self.names[at].to_token_stream(),
            Scalar::Lane(at, lane) => {
                let name = &self.names[at];
                match lane {
                    Lane::First => quote!(#name.first()),
                    Lane::Second => quote!(#name.second()),
                }
            }
        }
    }

    fn scalar_name(&mut self, suggested: Option<&str>) -> Ident {
        match suggested {
            Some(name) if syn::parse_str::<Ident>(name).is_ok() && self.taken.insert(name.to_owned()) => {
                Ident::new(name, Span::call_site())
            }
            _ => format_ident!("v{}", self.names.len()),
        }
    }
}

fn single(scalar: TokenStream) -> TokenStream {
    quote!(Single::<T>::new(#scalar))
}
