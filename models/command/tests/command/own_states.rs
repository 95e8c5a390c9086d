//! States of a mechanism's own at the command line.

use super::{mbs, text};

/// A pressure that falls to that of its surroundings: p = u + (p₀ − u) exp(−t/T).
const TANK: &str = "Tank { dof = 0; input u [bar]; param p0 = 5 [bar]; param T_ = 1 [s]; state p [bar] = p0;
    der(p) = (u - p)/T_; output same [bar] = p; }";

/// Regression: the squares of such rates are beyond all numbers, and stability was looked for without an end.
#[test]
fn rates_beyond_the_root_of_the_largest_number_are_answered() {
    let folder = tempfile::tempdir().unwrap();
    let motor = "Motor { dof = 1; param r = 1 [ohm]; body rotor (angle = phi) { inertia = 1 [kg*m^2]; } state i [A] = 0;
        der(i) = (1 [V] - r*i - 1 [V*s]*der(phi))/(1 [H]); torque drive on rotor = 1 [N*m/A]*i; }";
    std::fs::write(folder.path().join("motor.mbs"), motor).unwrap();
    for r in ["1e100", "1e155", "1e300"] {
        let output = mbs(folder.path(), &format!("equilibrium motor.mbs --set r={r}"));
        assert!(output.status.success() && text(output.stdout).contains("indifferent"), "{r}");
    }
}

/// Regression: a state was printed in SI units under the name of the unit that it was declared with, in the summary,
/// tables and the start of `explain`; a fit to such a table found 300000 bar for 3 bar.
#[test]
fn values_are_in_declared_units() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("tank.mbs"), TANK).unwrap();
    let printed = |arguments: &str| {
        let output = mbs(folder.path(), arguments);
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        text(output.stdout)
    };
    let summary = printed("simulate tank.mbs --rtol 1e-8 --end 1 --out run.csv");
    let line = |name: &str| summary.lines().find(|line| line.starts_with(name)).unwrap().to_owned();
    // 5/e
    assert!(
        line("p at the end").contains("1.839397") && line("same at the end").contains("1.839397"),
        "{summary}"
    );
    let table = std::fs::read_to_string(folder.path().join("run.csv")).unwrap();
    assert!(table.starts_with("t [s],integral(p) [kg/m/s],p [bar],same [bar]"), "{table:.200}");
    assert!(table.lines().nth(1).unwrap().contains(",5.0,5.0"), "{table:.200}");
    let start = printed("explain tank.mbs");
    assert!(start.lines().any(|line| line.split_whitespace().eq(["p", "5", "5", "0", "bar"])), "{start}");
    // and back: what was written is what is read; Heun's method is off by (h/T)²/6 a time constant, 2e-7
    printed("simulate tank.mbs --set p0=3bar --set T_=0.5s --end 1 --out data.csv");
    let found = mbs(folder.path(), "fit tank.mbs --data data.csv --param p0,T_ --columns p --json");
    let found: serde_json::Value = serde_json::from_slice(&found.stdout).unwrap();
    for (at, truth) in [3.0, 0.5].into_iter().enumerate() {
        let value = found["estimates"][at]["value"].as_f64().unwrap();
        assert!((value / truth - 1.0).abs() < 1e-5, "{found}");
    }
}

/// A charge of a nanocoulomb is as small as the usual absolute tolerance: its run was off by two thirds in silence.
#[test]
fn a_state_that_is_lost_in_the_tolerance_is_doubted() {
    let folder = tempfile::tempdir().unwrap();
    let circuit =
        "Rc { dof = 0; param R = 1 [kohm]; param c = 1 [nF]; state q [C] = 1e-9 [C]; der(q) = -q/c/R; }";
    std::fs::write(folder.path().join("rc.mbs"), circuit).unwrap();
    let run = |options: &str| mbs(folder.path(), &format!("simulate rc.mbs --end 5us --step 1us {options}"));
    let doubted = run("--rtol 1e-6");
    assert_eq!(doubted.status.code(), Some(3));
    let told = text(doubted.stderr);
    assert!(told.contains("the state `q` is at most 1.0e-9 C") && told.contains("--atol 1e-15"), "{told}");
    let good = run("--rtol 1e-9 --atol 1e-15 --json");
    assert!(good.status.success(), "{}", text(good.stderr));
    let json: serde_json::Value = serde_json::from_slice(&good.stdout).unwrap();
    // to 1e-6 of the start, which the message asks for
    let end = json["final"]["q"]["value"].as_f64().unwrap();
    assert!((end / 1e-9 - (-5.0_f64).exp()).abs() < 1e-6, "{end:e}");
    // the tolerance is one of nanocoulombs where they are declared
    let declared = circuit.replace("q [C] = 1e-9 [C]", "q [nC] = 1 [nC]");
    std::fs::write(folder.path().join("rc.mbs"), declared).unwrap();
    let good = run("--rtol 1e-6 --json");
    assert!(good.status.success(), "{}", text(good.stderr));
    let json: serde_json::Value = serde_json::from_slice(&good.stdout).unwrap();
    let end = json["final"]["q"]["value"].as_f64().unwrap();
    assert!((end - (-5.0_f64).exp()).abs() < 1e-6, "{end:e}");
}

#[test]
fn a_state_is_no_parameter() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("tank.mbs"), TANK).unwrap();
    let told = text(mbs(folder.path(), "simulate tank.mbs --set p=1bar").stderr);
    assert!(told.contains("it is a state, and no parameter; give `--from p=1bar`"), "{told}");
}

/// Regression: an equilibrium was looked for from states of 0, and their starts could not be given.
#[test]
fn an_equilibrium_begins_where_states_do() {
    let folder = tempfile::tempdir().unwrap();
    let text_of = "Lorenz { dof = 0; param x0 = 7; param z0 = 30; const s = 1 [1/s]; state x [1] = x0; state y [1] = x0;
        state z [1] = z0; der(x) = 10*s*(y - x); der(y) = s*(x*(28 - z) - y); der(z) = s*(x*y - 8/3*z); }";
    std::fs::write(folder.path().join("lorenz.mbs"), text_of).unwrap();
    for (asked, x) in [("", 8.4852814), ("--set x0=-7", -8.4852814), ("--from x=-7 --from y=-7", -8.4852814)]
    {
        let output = mbs(folder.path(), &format!("equilibrium lorenz.mbs {asked} --json"));
        assert!(output.status.success(), "{}", text(output.stderr));
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        let found = json["states"]["x"]["value"].as_f64().unwrap();
        assert!((found - x).abs() < 1e-7, "{asked}: {json}");
        assert_eq!(json["is_stable"], false);
    }
}

/// The integral of a state is a column of runs alone: a linear system does not have it.
#[test]
fn all_outputs_of_a_mechanism_with_a_state_are_linearized() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("tank.mbs"), TANK).unwrap();
    let found = mbs(folder.path(), "linearize tank.mbs --outputs * --json");
    assert!(found.status.success(), "{}", text(found.stderr));
    assert!(!text(found.stdout).contains("integral"));
}
