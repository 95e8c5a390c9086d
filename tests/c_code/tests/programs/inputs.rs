//! A run in C begins with the declared inputs, as one of the text does.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use c_code::{build_around, compile, compilers};
use mbs_live::{Run, Scalar, Text};
use mbs_runtime::System;

const CART: &str = "Cart {
    dof = 1;
    input wind [N];
    input push [kN] = 4.2 [N];
    body cart (x) { mass = 2 [kg]; }
    force pushed on x = push - wind - 3 [N/m]*x;
    start { x = 0.1 [m]; }
}";

/// Prints the bits of x after a hundred steps, and the inputs.
const MAIN: &str = r#"#include "NAME.h"
#include <stdio.h>
#include <string.h>

static void print(NAME_real x)
{
    const double value = (double)x;
    unsigned long long bits;
    memcpy(&bits, &value, sizeof bits);
    printf("%016llx ", bits);
}

int main(void)
{
    struct NAME_parameters parameters;
    struct NAME mechanism;
    struct NAME_run run;
    NAME_default_parameters(&parameters);
    int code = NAME_init(&mechanism, &parameters);
    code = code == CAPS_OK ? NAME_start(&run, &mechanism, 1e-2) : code;
    for (int k = 0; code == CAPS_OK && k < 100; k++) {
        code = NAME_step(&run);
    }
    print(run.state.q.x);
    print(run.inputs.wind);
    print(run.inputs.push);
    return code;
}
"#;

#[test]
fn a_run_begins_with_the_declared_inputs() {
    let text = Text::declaration("cart.mbs", CART);
    let live = text.compile().unwrap();
    let mut run = Run::builder(&live, 1e-2).build().unwrap();
    run.advance(100).unwrap();
    let bits = |x: f64| format!("{:016x} ", x.to_bits());
    let expected = [run.q()[0], 0.0, 4.2].map(bits).concat();
    for compiler in compilers() {
        for scalar in [Scalar::Double, Scalar::Float] {
            let sources = text.c(scalar).unwrap();
            compile(&sources, compiler, &[]).unwrap_or_else(|fault| panic!("{fault}"));
            let printed = build_around(&sources, MAIN, compiler, "-O1").and_then(|built| built.output());
            let printed = printed.unwrap_or_else(|fault| panic!("{fault}"));
            match scalar {
                Scalar::Double => assert_eq!(printed, expected),
                Scalar::Float => assert!(printed.ends_with(&bits(f64::from(4.2_f32))), "{printed}"),
            }
        }
    }
}
