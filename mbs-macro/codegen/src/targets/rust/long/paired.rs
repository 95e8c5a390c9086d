//! Copies of the same instructions as a loop on pairs.

use mbs_symbolic::Operand;
use mbs_symbolic::layout::{Loop, Read, WovenCopy};
use mbs_symbolic::pairs::{Given, Lane, Scalar, Step};
use proc_macro2::{Ident, TokenStream};
use quote::{ToTokens, format_ident, quote};
use rustc_hash::FxHashMap as HashMap;

use super::around::Around;
use super::columns::{Columns, carried_name, head};
use super::context::Context;
use crate::compiled::Vector;
use crate::targets::rust::on_pairs::{self, of_lane, single};
use crate::targets::rust::{tokens, writer};

/// A loop over the copies, each of which reads its columns, computes on pairs, and stores.
pub fn copies(context: &Context<'_>, repeated: &Loop<Vector>, copy: &WovenCopy) -> TokenStream {
    let Context { compiled, program, access, pairs, layout, .. } = *context;
    let outside = writer::Writer::new(compiled, program, access, pairs, 0..0).with_layout(layout);
    let carried = Variables::new(copy);
    let mut columns = Columns::new(context, repeated);
    let mut read = |given: Given| match given {
        Given::Number(number) => single(&tokens::number(number)),
        Given::Hoisted(at) => single(&outside.operand(Operand::Hoisted(at))),
        Given::Symbol(symbol) => match copy.given[symbol.index()] {
            Read::Carried(at) => carried.value(at),
            Read::Same(operand) => single(&outside.operand(operand)),
            read @ (Read::Each(_) | Read::Own(_)) => single(
                &columns.read(read).unwrap_or_else(|| tokens::internal("a copy is given its own result")),
            ),
        },
    };
    let mut writer = on_pairs::Writer::new(&access.mechanism);
    let mut around = Around::default();
    let mut body = TokenStream::new();
    for (at, step) in copy.woven.steps.iter().enumerate() {
        match carried.joined(step) {
            Some(pair) => writer.take(pair),
            None => body.extend(writer.statement(step, &mut read)),
        }
        let results = copy.woven.outputs[repeated.carried.len()..].iter().zip(&copy.kept);
        for (result, &kept) in results.filter(|(result, _)| result.step() == Some(at)) {
            let value = writer.scalar(*result, &mut read);
            body.extend(around.keep(context, repeated.steps[kept].kept, &quote!(#value.get())));
        }
    }
    let first = |at: usize| single(&outside.operand(repeated.carried[at].first));
    let next = |at: usize| writer.scalar(copy.woven.outputs[at], &mut read);
    let (first, next) = carried.statements(repeated.carried.len(), first, next);
    let reads = columns.reads;
    let (head, prelude) = (head(repeated), on_pairs::Writer::prelude(&context.names.runtime));
    let Around { before, after, .. } = around;
    quote!(#prelude #before #first #head { #reads #body #next } #after)
}

/// The variables of values that are carried from copy to copy: pairs, and scalars.
struct Variables<'a> {
    copy: &'a WovenCopy,
    /// Of a carried value the pair and the lane that it is in.
    lanes: HashMap<usize, (usize, Lane)>,
}

impl<'a> Variables<'a> {
    fn new(copy: &'a WovenCopy) -> Self {
        let lanes = |(pair, &[first, second]): (usize, &[usize; 2])| {
            [(first, (pair, Lane::First)), (second, (pair, Lane::Second))]
        };
        Self { copy, lanes: copy.together.iter().enumerate().flat_map(lanes).collect() }
    }

    /// A carried value, as a `Single`.
    fn value(&self, at: usize) -> TokenStream {
        match self.lanes.get(&at) {
            Some(&(pair, lane)) => of_lane(&pair_name(pair), lane),
            None => carried_name(at).into_token_stream(),
        }
    }

    /// The variable that holds what a step joins.
    fn joined(&self, step: &Step) -> Option<Ident> {
        let carried = |scalar: &Scalar| match *scalar {
            Scalar::Given(Given::Symbol(symbol)) => match self.copy.given[symbol.index()] {
                Read::Carried(at) => Some(at),
                Read::Same(_) | Read::Own(_) | Read::Each(_) => None,
            },
            _ => None,
        };
        let Step::Join(a, b) = step else { return None };
        let joined = [carried(a)?, carried(b)?];
        self.copy.together.iter().position(|pair| *pair == joined).map(pair_name)
    }

    /// Statements before the loop, which give the variables their first values, and statements at the
    /// end of a copy, which give them the next ones.
    fn statements(
        &self,
        count: usize,
        first: impl Fn(usize) -> TokenStream,
        mut next: impl FnMut(usize) -> TokenStream,
    ) -> (TokenStream, TokenStream) {
        let [mut before, mut values, mut after] = [(); 3].map(|()| TokenStream::new());
        let mut add = |name: Ident, first: TokenStream, next: TokenStream| {
            before.extend(quote!(let mut #name = #first;));
            // a next value may be made of other variables, so all are computed before one changes
            let value = format_ident!("next_{name}");
            values.extend(quote!(let #value = #next;));
            after.extend(quote!(#name = #value;));
        };
        for (at, &[a, b]) in self.copy.together.iter().enumerate() {
            add(pair_name(at), joined(first(a), first(b)), joined(next(a), next(b)));
        }
        for at in (0..count).filter(|at| !self.lanes.contains_key(at)) {
            add(carried_name(at), first(at), next(at));
        }
        (before, quote!(#values #after))
    }
}

fn pair_name(at: usize) -> Ident {
    format_ident!("carried_pair_{}", at + 1)
}

fn joined(a: TokenStream, b: TokenStream) -> TokenStream {
    quote!(T::Pair::join(#a, #b))
}
