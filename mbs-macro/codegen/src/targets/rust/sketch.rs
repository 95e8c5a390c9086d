//! The constant and the function that pictures are made from.

use proc_macro2::{Literal, TokenStream};
use quote::quote;

use super::body::Body;
use super::names::Names;
use crate::compiled::{Link, Sketch, SketchBody};

/// The value of `SKETCH`.
pub fn emit(sketch: &Sketch, names: &Names) -> TokenStream {
    let runtime = &names.runtime;
    let points = &sketch.points;
    let bodies = sketch.bodies.iter().map(|SketchBody { name, points, is_rigid }| {
        let points = positions(points);
        quote!(#runtime::sketch::Body { name: #name, points: #points, is_rigid: #is_rigid })
    });
    let (ground, particles) = (positions(&sketch.ground), positions(&sketch.particles));
    let joints = sketch.joints.iter().map(|joint| {
        let Link { name, kind, first, second, ahead } = joint;
        let (first, second) = (Literal::usize_unsuffixed(*first), Literal::usize_unsuffixed(*second));
        let ahead = match ahead.map(Literal::usize_unsuffixed) {
            Some(ahead) => quote!(::core::option::Option::Some(#ahead)),
            None => quote!(::core::option::Option::None),
        };
        quote! {
            #runtime::sketch::Joint { name: #name, kind: #kind, first: #first, second: #second, ahead: #ahead }
        }
    });
    let springs = sketch.springs.iter().map(|spring| {
        let Link { name, kind, first, second, .. } = spring;
        let (first, second) = (Literal::usize_unsuffixed(*first), Literal::usize_unsuffixed(*second));
        quote!(#runtime::sketch::Spring { name: #name, kind: #kind, first: #first, second: #second })
    });
    quote! {
        #runtime::Sketch {
            points: &[#(#points),*],
            bodies: &[#(#bodies),*],
            ground: #ground,
            particles: #particles,
            joints: &[#(#joints),*],
            springs: &[#(#springs),*],
        }
    }
}

fn positions(positions: &[usize]) -> TokenStream {
    let positions = positions.iter().map(|&at| Literal::usize_unsuffixed(at));
    quote!(&[#(#positions),*])
}

/// The places from a program that gives x and y of each in turn.
pub fn places(body: &Body) -> TokenStream {
    let Body { statements, outputs, runtime, .. } = body;
    if body.places.is_some() {
        let values = body.array(0..outputs.len());
        return quote!(#statements #runtime::__private::pairs(&#values));
    }
    let places = outputs.chunks(2);
    quote!(#statements [#([#(#places),*]),*])
}
