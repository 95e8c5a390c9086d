//! Answers of the command to people who slip.

use super::sweeps::sweep;
use super::{mbs, refusal, refuses, text};

#[test]
fn names_that_do_not_exist() {
    refuses("simulate slider-cranck", &["no mechanism `slider-cranck`", "mean `slider-crank`?"]);
    // a long list would hide the nearest, and is there where none is near
    assert!(!refusal("simulate slider-cranck").contains("metronome"));
    refuses("simulate xyz", &["no mechanism `xyz`", "slider-crank, ", "metronome"]);
    refuses("simulate slider-crank --set omgea=3", &["no parameter `omgea`", "mean `omega`?", "l1, l2, m1"]);
    refuses("simulate slider-crank --input torque=1", &["no input `torque`", "no input at all"]);
    refuses("simulate slider-crank-free --input crank_torqe=1", &["mean `crank_torque`?"]);
    refuses("simulat slider-crank", &["'simulate'"]);
    refuses("simulate slider-crank --feedback sometimes", &["held, per-stage"]);
    refuses("simulate slider-crank --set l1", &["name=value"]);
}

#[test]
fn units_and_numbers() {
    refuses("simulate slider-crank --set omega=3mm", &["a length [m] was given", "omega is a rate [1/s]"]);
    refuses(
        "simulate slider-crank --set l1=7furlong",
        &["unknown unit `furlong`", "a length [m] may be in m, mm"],
    );
    refuses("simulate slider-crank --set m1=7lbs", &["unknown unit `lbs`; did you mean `lb`? a mass [kg]"]);
    // Regression: three hundred digits
    refuses(
        "simulate slider-crank --set m1=-1e300",
        &["`mass of crank` is -1e300, but it must not be negative"],
    );
    refuses("simulate slider-crank --set l1=long", &["not a number"]);
    // Regression: the minus sign of what this program prints was no number.
    refuses("simulate slider-crank --set m1=−1kg", &["mass of crank", "-1", "negative"]);
    refuses("simulate slider-crank --set l1=NaN", &["l1", "has to be finite"]);
    refuses("simulate slider-crank --step 0.5kg", &["a mass [kg] was given", "step is a time [s]"]);
    refuses("simulate slider-crank-free --input crank_torque=2N", &["a force [N] was given"]);
}

#[test]
fn values_out_of_bounds() {
    refuses("simulate slider-crank --set m1=-1kg", &["mass of crank", "-1", "negative"]);
    refuses("simulate slider-crank --set l1=0mm", &["`l1`", "0"]);
    refuses("simulate slider-crank --step 0", &["the step is 0 s", "positive"]);
    refuses("simulate slider-crank --step -1ms", &["the step is -0.001 s"]);
    refuses("simulate slider-crank --end -1s", &["the end time is -1 s"]);
    refuses("simulate slider-crank --alpha -5", &["the gain alpha is -5"]);
    refuses("simulate slider-crank --alpha 9000", &["unstable", "held feedback", "leave both out"]);
    refuses("simulate slider-crank --alpha 2600 --beta 2000 --feedback per-stage", &["per-stage"]);
    refuses("simulate slider-crank --step 1e-9 --end 10s", &["rows would be recorded", "--every"]);
}

#[test]
fn a_rod_that_is_too_short() {
    refuses("simulate slider-crank --set l2=50mm --end 0.3s --out part.csv", &["error: "]);
}

#[test]
fn sweeps_that_are_asked_wrongly() {
    refuses("sweep slider-crank --param l2=30mm", &["not a range", "l2=LOW..HIGH:COUNT"]);
    refuses("sweep slider-crank --param l2=30mm..50mm", &["how many values"]);
    refuses("sweep slider-crank --param l2=30mm..50mm:x", &["`x` is not a number of values"]);
    refuses("sweep slider-crank --param l2=50mm..30mm:3", &["first value has to be smaller"]);
    refuses("sweep slider-crank --param l2=3kg..4kg:3", &["a mass [kg] was given"]);
    refuses("sweep slider-crank --param l2=1mm..4mm:1", &["two values at least"]);
    refuses("sweep slider-crank --param rod=1mm..4mm:3", &["no parameter `rod`", "l1, l2"]);
    refuses("sweep slider-crank --param l2=1mm..4mm:3 --param l2=1mm..4mm:3", &["`l2`", "swept twice"]);
    refuses(
        "sweep slider-crank --param l2=1mm..2mm:9999 --param l1=1mm..2mm:99999",
        &["at most 100000000 runs"],
    );
    refuses(
        "sweep slider-crank --param l2=1mm..4mm:3 --output torqe",
        &["no output `torqe`", "drive_torque"],
    );
    refuses("sweep slider-crank --param l2=1mm..4mm:3 --plot a.pdf", &["a.pdf", ".svg or .png"]);
    refuses("sweep slider-crank --param l2=1mm..4mm:3 --out no/such/a.csv", &["cannot write no/such/a.csv"]);
}

/// `--set k=60` meant SI although the list shows mm and rpm.
#[test]
fn a_bare_number_has_the_unit_of_the_list() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &str| text(mbs(folder.path(), &format!("simulate {arguments}")).stdout);
    let bare = run("slider-crank --set l1=70 --set omega=300 --end 0.1");
    assert_eq!(bare, run("slider-crank --set l1=70mm --set omega=300rpm --end 100ms"));
    let line = |name: &str| bare.lines().find(|line| line.starts_with(name)).unwrap().to_owned();
    assert!(line("l1, as set").ends_with("mm") && line("omega, as set").ends_with("rpm"), "{bare}");
    let (_, rows) = sweep(folder.path(), "slider-crank --param l1=50..80:2 --end 0.1");
    assert_eq!((rows[0][0].as_str(), rows[1][0].as_str(), rows[2][0].as_str()), ("l1 [mm]", "50.0", "80.0"));
    refuses(
        "simulate slider-crank --set inertia_factor=30deg",
        &["inertia_factor is a number without a unit"],
    );
}

#[test]
fn options_that_contradict_each_other() {
    refuses("simulate slider-crank --set l1=60 --set l1=70", &["`l1`", "set twice"]);
    refuses("simulate slider-crank --plot a.svg --sketch a.svg", &["`a.svg`", "two options write to it"]);
    refuses("simulate slider-crank --step 1ms --step 2ms", &["'--step", "cannot be used multiple times"]);
    refuses("sweep slider-crank --param l1=50..60:2 --set l1=70", &["`l1`", "set with --set and swept"]);
    refuses("sweep slider-crank --param l1=50..60:2 --output x3 --output x3", &["`x3`", "named twice"]);
    refuses("simulate slider-crank --compare l1=50,60 --set l1=70", &["`l1`", "set as well as compared"]);
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("torque.csv");
    std::fs::write(&file, "t,crank_torque [N*m]\n0,1\n1,1\n").unwrap();
    refuses(
        &format!("simulate slider-crank-free --compare crank_torque=1,2 --input @{}", file.display()),
        &["`crank_torque`", "given over time as well as compared"],
    );
    refuses("simulate slider-crank --compare l1=1,2,3,4,5,6,7,8", &["7 values", "sweep"]);
    refuses("simulate slider-crank --compare l1=50,60 --report a.html", &["--report", "cannot be used"]);
    refuses("simulate slider-crank --columns z*", &["no column `z*`", "theta1"]);
}
