//! Splines as constants.

use mbs_symbolic::Segment;
use proc_macro2::{Ident, Literal, TokenStream};
use quote::{ToTokens, format_ident, quote};

use super::names::Names;
use crate::compiled::Compiled;

/// The associated constant that holds a spline.
pub fn spline_name(at: usize) -> Ident {
    format_ident!("SPLINE_{at}")
}

/// The splines, each an associated constant.
pub fn splines<'a>(compiled: &'a Compiled, names: &'a Names) -> impl Iterator<Item = TokenStream> + 'a {
    let runtime = &names.runtime;
    let number = |value: f64| {
        // of an argument that the spline refuses
        if value.is_nan() { quote!(f64::NAN) } else { Literal::f64_unsuffixed(value).into_token_stream() }
    };
    compiled.splines.iter().enumerate().map(move |(at, spline)| {
        let segment = |Segment { from, coefficients }: &Segment| {
            let (from, coefficients) = (number(*from), coefficients.map(number));
            quote!(#runtime::__private::Segment { from: #from, coefficients: [#(#coefficients),*] })
        };
        let (name, origin) = (spline_name(at), number(spline.origin));
        let period = match spline.period.map(number) {
            Some(period) => quote!(::core::option::Option::Some(#period)),
            None => quote!(::core::option::Option::None),
        };
        let segments = spline.segments.iter().map(segment);
        let doc = format!("`{}`, cubic from point to point.", spline.name);
        // a spline whose value no program needs stands there all the same; its numbers are written to the last digit
        quote! {
            #[doc = #doc]
            #[allow(dead_code, clippy::all)]
            const #name: &'static #runtime::__private::Spline = &#runtime::__private::Spline {
                origin: #origin,
                period: #period,
                segments: &[#(#segments),*],
            };
        }
    })
}
