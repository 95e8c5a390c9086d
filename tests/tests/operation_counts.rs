//! The operations of every generated function of the models are those that are
//! recorded (BLESS=1 records them anew), and the right-hand sides stay within
//! 1.5 times what a person's elimination needs.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::fmt::Write;
use std::path::Path;
use std::{env, fs};

use mbs_runtime::{Info, Mechanism};
use models::{
    NFourBar1, NFourBar10, NFourBar40, NPendulum10, NPendulum40, Pendulum, SliderCrank, SliderCrankFree,
};

fn table(info: &Info) -> String {
    let mut text = format!("{}\n", info.name);
    for function in info.functions {
        let o = function.operations;
        let _ = writeln!(
            text,
            "  {:20} {:3} mul {:3} add {} div {} sincos {} other, watch {}",
            function.name, o.mul, o.add, o.div, o.sin_cos, o.other, o.watch
        );
    }
    text
}

#[test]
fn operation_counts_are_the_recorded_ones() {
    let counts =
        [table(SliderCrank::<f64>::INFO), table(SliderCrankFree::<f64>::INFO), table(Pendulum::<f64>::INFO)]
            .concat();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/operation_counts.txt");
    if env::var_os("BLESS").is_some_and(|bless| bless == "1") {
        fs::write(&path, &counts).expect("a writable checkout");
    }
    let recorded = fs::read_to_string(&path).expect("recorded counts");
    for (recorded, counted) in recorded.lines().zip(counts.lines()) {
        assert_eq!(recorded, counted, "BLESS=1 records the new counts if they are right");
    }
    assert_eq!(recorded.lines().count(), counts.lines().count());
}

/// A fused multiply-add of the person's program counts as both.
#[test]
fn right_hand_sides_cost_at_most_half_more_than_by_hand() {
    for (info, mul, add, div) in
        [(SliderCrank::<f64>::INFO, 53, 43, 1), (SliderCrankFree::<f64>::INFO, 86, 62, 2)]
    {
        let count = info.operations("stabilized").expect("a function");
        println!(
            "{}: {} mul, {} add, {} div, {} sincos",
            info.name, count.mul, count.add, count.div, count.sin_cos
        );
        assert!(2 * count.mul <= 3 * mul, "{count:?}");
        assert!(2 * count.add <= 3 * add, "{count:?}");
        assert!(2 * count.div <= 3 * div && count.sin_cos <= 2 && count.other == 0, "{count:?}");
    }
}

/// Bounds of the operations of a right-hand side of chains, feedback included. They hold for an elimination
/// that sees their structure.
#[test]
fn chains_cost_what_their_structure_promises() {
    for (info, most) in [
        (NPendulum10::<f64>::INFO, 1_080),
        (NPendulum40::<f64>::INFO, 4_710),
        (NFourBar1::<f64>::INFO, 255),
        (NFourBar10::<f64>::INFO, 2_200),
        (NFourBar40::<f64>::INFO, 8_600),
    ] {
        let count = info.operations("stabilized").expect("a function");
        let arithmetic = count.mul + count.add + count.div;
        println!("{}: {arithmetic}", info.name);
        assert!(arithmetic <= most, "{}: {arithmetic}", info.name);
    }
}
