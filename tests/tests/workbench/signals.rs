//! Inputs from a table: their units, what they do in runs, and tables that are none.
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

/// ẋ after 1 s: half of 500 N, and 2 kN where nothing is said.
#[test]
fn values_have_the_units_of_their_headings() {
    for (text, expected) in [("t [ms], push [N]\n0, 0\n1000, 500\n", 0.25), ("t,push\n0,2", 2.0)] {
        let signals = Some(read(text).unwrap());
        let settings = Settings { end: 1.0, step: 1e-3, signals, ..Settings::default() };
        let run = model::of::<Cart>().simulate(&settings, &mut |_, _| ()).unwrap();
        let speed = *run.column("der(x)").unwrap().values.last().unwrap();
        assert!((speed - expected).abs() < 1e-12, "{text}: {speed}");
    }
}

#[test]
fn words_that_are_none() {
    let message = |text, words| read(text).unwrap().led(words).unwrap_err().to_string();
    let line = "t,push\n0,1\n1,2";
    assert!(message(line, "cubc").contains("no way from instant to instant `cubc`, did you mean `cubic`?"));
    assert!(
        message(line, "cubic hold").contains("`cubic hold` cannot be used: write"),
        "{}",
        message(line, "cubic hold")
    );
    assert!(
        message(line, "outside").contains("`outside` cannot be used: write"),
        "{}",
        message(line, "outside")
    );
    assert!(message(line, "outside halt").contains("no rule for what is outside `halt`"));
    assert!(message(line, "outside periodic").contains("by `outside periodic` no curve leads"));
    assert!(read(line).unwrap().led("").is_ok() && read(line).unwrap().led("outside extend").is_ok());
}

#[test]
fn tables_that_are_none() {
    let message = |text| read(text).unwrap_err().to_string();
    assert!(message("t,pull\n0,1").contains("no input `pull`, did you mean `push`?"));
    assert!(message("t,push\n0,1\n0,2").contains("line 3: time = `0`: time has to rise"));
    assert!(message("t,push\n0,x").contains("line 2: push = `x`"), "{}", message("t,push\n0,x"));
    assert!(message("t,push [mm]\n0,1").contains("a length [m] was given"));
    assert!(message("t,push\n").contains("a row"));
    assert!(message("t,push\n0,").contains("line 2: push = ``: it needs a value"));
    assert!(message("t,push,push\n0,1,2").contains("two columns"));
}
