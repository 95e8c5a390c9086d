//! Work and code grow about with what is declared: parts that stand in several places are
//! one part. Lengths of C code are compared rather than times, which depend on the
//! machine; without a bound on either these declarations took minutes or all memory.
#![allow(clippy::expect_used, reason = "helpers of tests")]

use std::fmt::Write;
use std::time::{Duration, Instant};

use mbs_codegen::targets::{Scalar, c};

/// The length of the C code of a valid declaration. Its instructions stand in the order in which they were found.
fn length(declaration: &str) -> usize {
    let tokens = declaration.parse().expect("tokens");
    let start = Instant::now();
    let compiled = mbs_codegen::analyse(tokens).expect("a valid declaration");
    let code = c(&compiled, Scalar::Double).expect("it is printed");
    // a tenth of that on any machine; what grows exponentially takes hours
    assert!(start.elapsed() < Duration::from_secs(30), "{:?}", start.elapsed());
    code.source.text.len()
}

/// Twice as much is declared: the code is at most `factor` times as long.
fn assert_grows_at_most(factor: f64, declaration: impl Fn(usize) -> String, size: usize) {
    let [small, large] = [size, 2 * size].map(|size| length(&declaration(size)));
    assert!(large as f64 <= factor * small as f64, "{small} became {large}");
}

/// a_k = f(a_{k−1}), and where the last one stands.
fn tower(levels: usize, next: &str, used: &str) -> String {
    let mut text = String::from(
        "Tower { dof = 1; param p = 0.5; body a (x, y) { mass = 1 [kg]; } let a0 = p + x/(1 [m]);",
    );
    for level in 1..=levels {
        let (last, before) = (format!("a{}", level - 1), format!("a{}", level.max(2) - 2));
        let formula = next.replace("LAST", &last).replace("BEFORE", &before);
        let _ = write!(text, "let a{level} = {formula};");
    }
    text + &used.replace("LAST", &format!("a{levels}")) + "}"
}

const NEXT: &str = "LAST*cos(LAST) + sin(LAST)";

#[test]
fn a_tower_of_definitions_in_a_constraint_stays_a_graph() {
    let in_constraint = "constraint c: y = LAST*(1 [m]);";
    assert_grows_at_most(3.0, |levels| tower(levels, NEXT, in_constraint), 30);
}

#[test]
fn towers_of_sums_and_products_stay_graphs() {
    let in_constraint = "constraint c: y = LAST*(1 [m]);";
    for next in [
        "LAST*cos(LAST)",
        "LAST + sin(LAST)",
        "cos(LAST)*cos(BEFORE) + sin(LAST)*sin(BEFORE)",
        "1/(2 + LAST*BEFORE)",
        "(LAST + BEFORE)*(2*LAST - BEFORE)",
    ] {
        // a definition that has grown long is one value, so that sums of all levels below stay apart
        assert_grows_at_most(2.3, |levels| tower(levels, next, in_constraint), 60);
    }
}

#[test]
fn a_tower_in_a_force_and_an_output_stays_a_graph() {
    let elsewhere = "constraint c: y = 0 [m]; force f on x = LAST*(1 [N]); output o = der(LAST);";
    assert_grows_at_most(3.0, |levels| tower(levels, NEXT, elsewhere), 30);
}

/// Each prefix of a sum was a sum of its own: 20,000 terms took 43 s and 6 GB.
#[test]
fn a_long_sum_is_one_sum() {
    let sum = |terms: usize| {
        let mut text = String::from("Sum { dof = 1; body b (x) { mass = 1 [kg]; }");
        (0..terms).for_each(|at| {
            let _ = write!(text, "param p{at} = {at};");
        });
        let terms: Vec<_> = (0..terms).map(|at| format!("p{at}")).collect();
        text + &format!("output o = {}; }}", terms.join(" + "))
    };
    assert_grows_at_most(2.2, sum, 2000);
}

/// A product of n factors has a second derivative of n² terms of n factors, written out.
#[test]
fn derivatives_of_a_long_product_are_as_long_as_the_product() {
    let product = |factors: usize| {
        let mut text = format!("Product {{ dof = {factors};");
        (0..factors).for_each(|at| {
            let _ = write!(text, "body b{at} (angle = x{at}) {{ inertia = 1 [kg*m^2]; }}");
        });
        let sines: Vec<_> = (0..factors).map(|at| format!("sin(x{at})")).collect();
        text + &format!("output o [1/s^2] = der(der({})); }}", sines.join("*"))
    };
    assert_grows_at_most(2.5, product, 39);
}

/// Names were looked for one after the other in lists of all bodies, outputs, and forces.
#[test]
fn many_bodies_of_a_loop_are_declared_in_order() {
    let bodies = |count: usize| {
        format!(
            "Many {{ dof = {count}; for i in 1..={count} {{ body b[i] (x[i]) {{ mass = 1 [kg]; }}
                force f[i] on x[i] = 1 [N]; start {{ x[i] = i*1 [m]; }} output o[i] = x[i]; }} }}"
        )
    };
    assert_grows_at_most(2.5, bodies, 2000);
}
