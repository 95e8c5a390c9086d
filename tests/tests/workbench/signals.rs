//! Runs follow the inputs of a table.
#![allow(clippy::unwrap_used, reason = "a test says by panicking what is wrong")]

use mbs_runtime::Mechanism;
use mbs_workbench::{Error, Settings, Signals, model};

mbs_runtime::mechanism! {
    /// A cart that is pushed.
    pub Cart {
        dof = 1;
        input push [kN];
        body cart (x) { mass = 1000 [kg]; }
        force f on cart = (push, 0);
        start { x = 0; }
    }
}

fn read(text: &str) -> Result<Signals, Error> {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("in.csv");
    std::fs::write(&path, text).unwrap();
    Signals::read(&path, <Cart as Mechanism>::INFO)
}

/// ẋ(2 s) = (½ · 500 N · 1 s + 500 N · 1 s)/1000 kg: Heun's method has the mean of a line.
#[test]
fn a_run_follows_them() {
    let signals = read("t,push [N]\n0,0\n1,500\n2,500").unwrap();
    let settings = Settings { end: 2.0, step: 1e-3, signals: Some(signals), ..Settings::default() };
    let run = model::of::<Cart>().simulate(&settings, &mut |_, _| ()).unwrap();
    let speed = *run.column("der(x)").unwrap().values.last().unwrap();
    assert!((speed - 0.75).abs() < 1e-12, "{speed}");
}

/// Of 500 N for a quarter of every second the mean is 125 N.
#[test]
fn words_lead_them() {
    let pulses = "t,push [N]\n0,500\n0.25,0\n1,500";
    let signals = read(pulses).unwrap().led("step outside periodic").unwrap();
    let tolerances = Some(mbs_runtime::Tolerances::default());
    let settings =
        Settings { end: 4.0, step: 4.0, tolerances, signals: Some(signals), ..Settings::default() };
    let run = model::of::<Cart>().simulate(&settings, &mut |_, _| ()).unwrap();
    let speed = *run.column("der(x)").unwrap().values.last().unwrap();
    assert!((speed - 0.5).abs() < 1e-12, "{speed}");
    assert!(run.summary.effort.unwrap().rejected == 0, "{:?}", run.summary.effort);
}
