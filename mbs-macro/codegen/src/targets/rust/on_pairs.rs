//! Steps on pairs as statements on `Real::Pair`.
//!
//! * `Real::Pair` is a two-lane vector for `f64`. A scalar that computes a sine as a whole has sine terms
//!   that do nothing (`NoTerm`).
//! * Scalars between pairs stay in vector registers (`Single`). There the compiler finds nothing to take
//!   apart.
//! * Sines have no branch. An angle beyond their range gives no number, and the step is made in stages.

use std::collections::BTreeSet;

use mbs_interface::sine::Octant;
use mbs_symbolic::Operation;
use mbs_symbolic::pairs::{Given, Lane, Scalar, Step, Term};
use proc_macro2::{Ident, Literal, Span, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::tokens;

/// Gives the tokens of a `Single` that no step computes.
pub type Reader<'a> = &'a mut dyn FnMut(Given) -> TokenStream;

/// Writes the steps of a program on pairs, one after the other.
pub struct Writer<'a> {
    /// The type of the mechanism, which holds splines.
    mechanism: &'a TokenStream,
    /// The variables of the steps so far.
    names: Vec<Ident>,
    taken: BTreeSet<String>,
}

impl<'a> Writer<'a> {
    pub fn new(mechanism: &'a TokenStream) -> Self {
        Self { mechanism, names: Vec::new(), taken: BTreeSet::new() }
    }

    /// The imports and types that the statements need around them.
    pub fn prelude(runtime: &TokenStream) -> TokenStream {
        quote! {
            use #runtime::{Octant, Pair as _, Single as _, Term as _};
            type Single<T> = <<T as #runtime::Real>::Pair as #runtime::Pair<T>>::Single;
            type SineTerm<T> = <<T as #runtime::Real>::Pair as #runtime::Pair<T>>::Term;
        }
    }

    /// The statement of the next step.
    pub fn statement(&mut self, step: &Step, read: Reader<'_>) -> TokenStream {
        let at = self.names.len();
        let pair = |at: &usize| &self.names[*at];
        let value = match step {
            Step::Scalar(operation, a, b, name) => {
                let value = self.operation(*operation, *a, *b, read);
                let name = self.scalar_name(name.as_deref());
                self.names.push(name.clone());
                return quote!(let #name = #value;);
            }
            Step::Sines(angles, Octant { shifted, sine, cosine }) => {
                let angles = pair(angles);
                let [shifted, sine, cosine] = [shifted, sine, cosine].map(|term| self.term(term));
                let (sines, cosines) = (format_ident!("sines{at}"), format_ident!("cosines{at}"));
                let octant = quote!(Octant { shifted: #shifted, sine: #sine, cosine: #cosine });
                let statement = quote!(let (#sines, #cosines) = #angles.turned(#octant););
                self.names.extend([sines, cosines]);
                return statement;
            }
            // Named with the sines.
            Step::Cosines(_) => return TokenStream::new(),
            Step::Join(a, b) => {
                let (a, b) = (self.scalar(*a, read), self.scalar(*b, read));
                quote!(T::Pair::join(#a, #b))
            }
            Step::Splat(a) => {
                let a = self.scalar(*a, read);
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
                tokens::operation(*operation, &quote!(#a), &quote!(#b), self.mechanism)
            }
            Step::Angles(of) => {
                let of = pair(of);
                quote!(#of.angles())
            }
            Step::ShiftBack(of) => {
                let of = pair(of);
                quote!(#of.shift_back())
            }
            Step::Term(operation, a, b) => {
                let (a, b) = (self.term(a), self.term(b));
                tokens::operation(*operation, &a, &b, self.mechanism)
            }
        };
        let name = format_ident!("p{at}");
        self.names.push(name.clone());
        quote!(let #name = #value;)
    }

    /// Skips the next step: this variable holds its pair already.
    pub fn take(&mut self, pair: Ident) {
        self.names.push(pair);
    }

    /// An operation on scalars; functions are those of the scalar type itself.
    fn operation(&self, operation: Operation, a: Scalar, b: Scalar, read: Reader<'_>) -> TokenStream {
        let (a, b) = (self.scalar(a, read), self.scalar(b, read));
        match operation {
            Operation::Call(_) | Operation::Spline(..) => {
                let value =
                    tokens::operation(operation, &quote!(#a.get()), &quote!(#b.get()), self.mechanism);
                single(&value)
            }
            _ => tokens::operation(operation, &a, &b, self.mechanism),
        }
    }

    fn term(&self, term: &Term) -> TokenStream {
        match *term {
            Term::Constant(constant) => {
                let constant = Literal::f64_unsuffixed(constant);
                quote!(SineTerm::<T>::constant(#constant))
            }
            Term::Step(at) => self.names[at].to_token_stream(),
        }
    }

    /// A `Single`.
    pub fn scalar(&self, scalar: Scalar, read: Reader<'_>) -> TokenStream {
        match scalar {
            Scalar::Given(given) => read(given),
            Scalar::Step(at) => self.names[at].to_token_stream(),
            Scalar::Lane(at, lane) => of_lane(&self.names[at], lane),
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

/// A lane of a pair, as a `Single`.
pub fn of_lane(pair: &Ident, lane: Lane) -> TokenStream {
    match lane {
        Lane::First => quote!(#pair.first()),
        Lane::Second => quote!(#pair.second()),
    }
}

/// A scalar as a `Single`.
pub fn single(scalar: &TokenStream) -> TokenStream {
    quote!(Single::<T>::new(#scalar))
}
