//! When runs end, and what is said if that is not where they were asked to.

use std::fs;

use super::{mbs, refuses, text};

const GLIDER: &str = "Glider {
    dof = 1;
    param when = 0 [s];
    body block (x) { mass = 1 [kg]; }
    start { t = when; x = 0; der(x) = 1 [m/s]; }
}
";

/// The last value of x, and the messages.
fn end(arguments: &str) -> (f64, String) {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("glider.mbs"), GLIDER).unwrap();
    let output = mbs(folder.path(), &format!("simulate glider.mbs --out run.csv {arguments}"));
    assert!(output.status.success(), "{arguments}: {}", text(output.stderr));
    let table = fs::read_to_string(folder.path().join("run.csv")).unwrap();
    let last = table.lines().last().unwrap();
    (last.split(',').nth(1).unwrap().parse().unwrap(), text(output.stderr))
}

/// Steps that do not end there were rounded to the nearest one without a word.
#[test]
fn steps_that_do_not_end_where_they_should_say_so() {
    let (x, said) = end("--step 0.3s --end 1s");
    assert!((x - 0.9).abs() < 1e-12);
    assert!(said.contains("note: steps of 0.3 s do not end at 1 s: the run ends at 0.9 s"), "{said}");
    // the two times are told apart
    let (_, said) = end("--step 3.3333333ms --end 1s");
    assert!(
        said.contains("steps of 0.0033333333 s do not end at 1 s: the run ends at 0.99999999 s"),
        "{said}"
    );
    let (x, said) = end("--step 0.25s --end 1s");
    assert!((x - 1.0).abs() < 1e-12 && !said.contains("do not end"), "{said}");
    let (x, said) = end("--rtol 1e-6 --step 0.3s --end 1s");
    assert!((x - 1.0).abs() < 1e-12 && !said.contains("do not end"), "{said}");
}

/// With a start behind the usual end there was no run at all.
#[test]
fn a_run_takes_a_second_whenever_it_starts() {
    let (x, _) = end("--set when=3s");
    assert!((x - 1.0).abs() < 1e-9, "{x}");
    let (x, _) = end("--set when=3s --end 3.5s");
    assert!((x - 0.5).abs() < 1e-9, "{x}");
}

/// No step was taken, and it was said to be off by inf %.
#[test]
fn a_run_without_a_step_has_no_error() {
    let output = mbs(std::path::Path::new("."), "simulate pendulum --end 0");
    assert_eq!(output.status.code(), Some(0), "{}", text(output.stderr));
}

/// A share that is set at run time was not judged.
#[test]
fn the_share_of_a_trapezoid_is_a_condition() {
    let folder = tempfile::tempdir().unwrap();
    let text = "Cart { dof = 0; param a = 0.3; body b (x) { mass = 1 [kg]; }
        drive d: x = 1 [m]*trapezoidal(t/(1 [s]), a); }";
    let file = folder.path().join("cart.mbs");
    fs::write(&file, text).unwrap();
    let file = file.display();
    assert!(mbs(folder.path(), &format!("simulate {file} --set a=0.5 --end 1ms")).status.success());
    for share in ["0.7", "-0.2", "0"] {
        refuses(&format!("simulate {file} --set a={share}"), &["a share of its time above 0, at most 1/2"]);
    }
}
