//! A whole step as one function on pairs of scalars.
//!
//! A step in stages gives the same bits. It is taken where this one is not healthy.

use mbs_symbolic::pairs::{Given, Woven};
use mbs_symbolic::{Inconsistency, Program};
use proc_macro2::{Literal, TokenStream};
use quote::{format_ident, quote};

use super::access::Access;
use super::body::named;
use super::names::{Fields, Names};
use super::tokens;
use super::{on_pairs, weave};
use crate::compiled::{Compiled, Kinds};

/// A fused step with what else it gives, for both kinds of feedback.
struct Variant<'a> {
    /// Of the names of its functions.
    suffix: &'static str,
    doc: &'static str,
    programs: &'a Kinds,
    gives_reactions: bool,
}

/// Those of a mechanism; none if it is too large.
fn variants(compiled: &Compiled) -> Vec<Variant<'_>> {
    let Some(step) = &compiled.fused_step else { return Vec::new() };
    let alone = Variant { suffix: "", doc: "", programs: &step.alone, gives_reactions: false };
    let with_reactions = step.with_reactions.as_ref().map(|programs| Variant {
        suffix: "_with_reactions",
        doc: ", and the reactions at its start",
        programs,
        gives_reactions: true,
    });
    [Some(alone), with_reactions].into_iter().flatten().collect()
}

impl Variant<'_> {
    /// The type that its functions return.
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
        let name = format_ident!("{name}{}", self.suffix);
        let doc = format!("A step with feedback {feedback}{}.", self.doc);
        Ok(quote! {
            #[doc = #doc]
            #[inline(always)]
            fn #name(&self, at: &#state, inputs: &#inputs, gains: &#runtime::Gains<T>, h: T, t_next: T) -> #result {
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
        quote! {
            #[inline(always)]
            fn #name<X: #runtime::Method>(&self, at: &#state, inputs: &#inputs, gains: &#runtime::Gains<T>, h: T, t_next: T) -> ::core::option::Option<#result> {
                ::core::option::Option::Some(if const { X::EXPLICIT.is_held() } {
                    self.#held(at, inputs, gains, h, t_next)
                } else {
                    self.#per_stage(at, inputs, gains, h, t_next)
                })
            }
        }
    }
}

/// The functions of both kinds of feedback, also with the reactions; nothing if the mechanism is too large.
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
    let lints = tokens::lints();
    Ok(quote! {
        #lints
        impl<T: #runtime::Real> #mechanism<T> { #functions }
    })
}

/// The trait's functions.
pub fn choice(compiled: &Compiled, names: &Names) -> TokenStream {
    variants(compiled).iter().map(|variant| variant.choice(names)).collect()
}

/// The statements of a step's function, and the values that it ends with.
struct Body {
    statements: TokenStream,
    stepped: TokenStream,
    /// Nothing if the program does not give them.
    reactions: TokenStream,
}

impl Body {
    fn new(compiled: &Compiled, names: &Names, fields: &Fields, woven: &Woven) -> Self {
        let (runtime, access) = (&names.runtime, Access::of_step());
        let mut read = |given| on_pairs::single(&given_tokens(compiled, &access, given));
        let mut writer = on_pairs::Writer::new(&access.mechanism);
        let statements: TokenStream =
            woven.steps.iter().map(|step| writer.statement(step, &mut read)).collect();
        let mut value = |&output| {
            let value = writer.scalar(output, &mut read);
            quote!(#value.get())
        };
        let outputs: Vec<TokenStream> = woven.outputs.iter().map(&mut value).collect();
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
        let prelude = on_pairs::Writer::prelude(runtime);
        let statements = quote! {
            #prelude
            let half_h = T::from_f64(0.5) * h;
            #statements
        };
        let stepped = quote! {
            #runtime::Stepped { next: #runtime::State { t: t_next, q: #q, v: #v }, growth: #growth, sum: #sum }
        };
        Self { statements, stepped, reactions }
    }
}

/// How a scalar is read that no step computes.
fn given_tokens(compiled: &Compiled, access: &Access, given: Given) -> TokenStream {
    match given {
        Given::Number(number) => tokens::number(number),
        Given::Symbol(symbol) => tokens::symbol(compiled, access, symbol),
        Given::Hoisted(at) => {
            let (this, at) = (&access.this, Literal::usize_unsuffixed(at));
            quote!(#this.hoisted[#at])
        }
    }
}
