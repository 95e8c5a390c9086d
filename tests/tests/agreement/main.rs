//! A mechanism from its text computes what the compiled Rust of the same declaration does,
//! to the last bit: every function, a thousand steps, and runs in lanes.
#![allow(clippy::expect_used, reason = "helpers of tests")]

mod compare;
mod declarations;
mod packs;
mod runs;

use compare::agree;
use declarations::*;
use mbs_codegen::analyse;
use mbs_live::Text;
use mbs_runtime::Error;
use paths::EXHAUSTIVE;

#[test]
fn driven_crank() {
    agree::<Driven>(DRIVEN, &[], 0.5e-3);
}

#[test]
fn free_crank_with_an_input() {
    agree::<Free>(FREE, &[0.5], 0.5e-3);
}

#[test]
fn cam_with_a_spline() {
    agree::<Cam>(CAM, &[], 0.2e-3);
}

#[test]
fn friction_that_depends_on_a_reaction() {
    agree::<Incline>(INCLINE, &[1.5], 1e-4);
}

#[test]
fn redundant_constraints() {
    agree::<Parallelogram>(PARALLELOGRAM, &[], 1e-3);
}

#[test]
fn every_function() {
    agree::<Functions>(FUNCTIONS, &[0.3, -0.2], 1e-3);
}

#[test]
fn chain_too_long_for_a_fused_step() {
    let compiled = analyse(CHAIN.parse().expect("tokens")).expect("a mechanism");
    assert!(compiled.fused_step.is_none());
    if EXHAUSTIVE {
        agree::<Chain>(CHAIN, &[], 1e-4);
    }
}

#[test]
fn conditions_on_parameters() {
    let live = Text::declaration("free.mbs", FREE).compile().expect("a mechanism");
    let refused = [("l1", -0.06), ("m2", -1.0), ("m3", f64::NAN), ("inertia_factor", -1e-3)];
    for (name, value) in refused {
        let at = live.parameters().len();
        let at = (0..at).find(|&at| FREE_PARAMETERS[at] == name).expect("a parameter");
        let found = live.with_parameters(|values| values[at] = value).expect_err("refused");
        let mut parameters = FreeParameters::default();
        match name {
            "l1" => parameters.l1 = value,
            "m2" => parameters.m2 = value,
            "m3" => parameters.m3 = value,
            _ => parameters.inertia_factor = value,
        }
        let expected = Free::new(parameters).expect_err("refused");
        assert_eq!(found.to_string(), expected.to_string());
        assert!(matches!(found, Error::Parameter { .. }));
    }
}
