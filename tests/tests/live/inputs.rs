//! Inputs begin at their declared values, in runs of texts and in what is printed of them.
#![allow(clippy::unwrap_used, reason = "helpers of tests")]

use mbs_live::{Experiment, Live, Prepared, Run, Scalar, Text};
use mbs_runtime::{Adaptive, Dopri5, Sampled, System};

/// A cart of 2 kg that its input pushes, by 4 N unless it is set.
const CART: &str = "Cart {
    dof = 1;
    input wind [N];
    input push [kN] = 4 [N];
    body cart (x) { mass = 2 [kg]; }
    force pushed on x = push + wind;
    start { x = 0; }
}";

fn text(declaration: &str) -> Text {
    Text::declaration("mechanism.mbs", declaration)
}

fn compiled(declaration: &str) -> Live {
    text(declaration).compile().unwrap()
}

fn declared(live: &Live) -> Vec<(&str, f64)> {
    live.declared_info().inputs.iter().map(|input| (input.name, input.default)).collect()
}

/// x = ½ · 4 N/2 kg · t²
#[test]
fn runs_begin_at_the_declared_values() {
    let live = compiled(CART);
    assert_eq!(declared(&live), [("wind", 0.0), ("push", 4.0)]);
    let mut run = Run::builder(&live, 0.01).build().unwrap();
    let mut inputs = [f64::NAN; 2];
    run.inputs(&mut inputs);
    assert_eq!(inputs, [0.0, 4.0]);
    run.advance(100).unwrap();
    assert!((run.q()[0] - 1.0).abs() < 1e-12, "{}", run.q()[0]);
    let adaptive = Adaptive::builder(Prepared::new(&live)).scheme::<Dopri5>().build().unwrap();
    let mut adaptive = Sampled::new(adaptive, 1.0).unwrap();
    adaptive.step().unwrap();
    let (mut x, mut v) = ([0.0], [0.0]);
    adaptive.state(&mut x, &mut v);
    assert!((x[0] - 1.0).abs() < 1e-12, "{}", x[0]);
    // what is set stays
    let mut still = Run::builder(&live, 0.01).inputs(&[0.0, 0.0]).build().unwrap();
    still.advance(100).unwrap();
    assert_eq!(still.q(), [0.0]);
}

/// A bare number is in the unit of the input, a formula has its own; loops and assemblies give each copy its value.
#[test]
fn values_have_units() {
    let live = compiled(
        "Wagons {
            dof = 2;
            const half = 0.5;
            input voltage [mV] = -12;
            input angle [deg] = 90;
            input turn [deg] = pi/2;
            input force [kN] = half*3 [N];
            input level [1] = 2*half;
            assembly Wagon {
                const idle = 3 [N];
                input push [N] = 2*idle;
                body wagon (x) { mass = 1 [kg]; }
                force pushed on x = push;
            }
            instance first: Wagon;
            instance second: Wagon;
            for i in 1..=2 { input share[i] [mm] = i; }
        }",
    );
    let half_a_turn = core::f64::consts::FRAC_PI_2;
    let expected = [
        ("voltage", -0.012),
        ("angle", half_a_turn),
        ("turn", half_a_turn),
        ("force", 1.5),
        ("level", 1.0),
        ("first_push", 6.0),
        ("second_push", 6.0),
        ("share_1", 0.001),
        ("share_2", 0.002),
    ];
    assert_eq!(declared(&live), expected);
}

/// Printed sources and the page of a mechanism have the values, and nothing of them where all are 0.
#[test]
fn printed_code_begins_at_them() {
    let plain = text(&CART.replace(" = 4 [N];", ";"));
    let pushed = text(CART);
    for (text, is_declared) in [(&plain, false), (&pushed, true)] {
        let c = text.c(Scalar::Double).unwrap();
        assert_eq!(c.source.text.contains("cart_default_inputs(&run->inputs);"), is_declared);
        assert_eq!(c.source.text.contains("cart_declared_inputs[] = {"), is_declared);
        assert_eq!(
            c.header.text.contains("void cart_default_inputs(struct cart_inputs *inputs);"),
            is_declared
        );
        assert_eq!(c.header.text.contains("declared as 0.004 kN = 4 in SI units"), is_declared);
        let begins = if is_declared { "are as they are declared." } else { "are 0." };
        assert!(c.header.text.contains(begins));
        let fmu = text.fmu(Experiment { step: 1e-3, end: 1.0 }).unwrap();
        let code = &fmu.sources.last().unwrap().text;
        assert_eq!(code.contains("cart_default_inputs(&it->now.inputs);"), is_declared);
        let start = if is_declared { "start=\"0.004\"" } else { "start=\"0\"" };
        for (_, description) in &fmu.descriptions {
            let push = description.lines().skip_while(|line| !line.contains("name=\"push\"")).take(3);
            let push = push.collect::<String>();
            assert!(push.contains("start="), "{push}, expected {start}");
        }
        let value = if is_declared { "\"value\":4.0" } else { "\"value\":0.0" };
        let tables = text.wasm().unwrap().tables;
        let push = tables.split("\"name\":\"push\"").nth(1).unwrap();
        assert!(push[..200.min(push.len())].contains(value), "{tables}");
    }
}
