//! The `mbs` command as people use it, and what it says when they slip.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::Duration;

fn mbs(folder: &Path, arguments: &str) -> Output {
    let arguments = arguments.split_whitespace();
    Command::new(env!("CARGO_BIN_EXE_mbs")).args(arguments).current_dir(folder).output().unwrap()
}

/// The message of a command that has to fail.
fn refusal(arguments: &str) -> String {
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(folder.path(), arguments);
    assert!(!output.status.success(), "`mbs {arguments}` went through");
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.starts_with("error: "), "{message}");
    assert!(!message.contains("panicked"), "{message}");
    message
}

#[track_caller]
fn refuses(arguments: &str, parts: &[&str]) {
    let message = refusal(arguments);
    for part in parts {
        assert!(message.contains(part), "`mbs {arguments}` says\n{message}without `{part}`");
    }
}

#[test]
fn names_that_do_not_exist() {
    refuses("simulate slider-cranck", &["no mechanism `slider-cranck`", "mean `slider-crank`?", "pendulum"]);
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
    refuses("simulate slider-crank --set l1=7furlong", &["unknown unit `furlong`", "mm"]);
    refuses("simulate slider-crank --set l1=long", &["not a number"]);
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
    refuses("simulate slider-crank --alpha 9000", &["unstable", "held feedback", "deadbeat"]);
    refuses("simulate slider-crank --alpha 2600 --beta 2000 --feedback per-stage", &["per-stage"]);
    refuses("simulate slider-crank --step 1e-9 --end 10s", &["rows would be recorded", "--every"]);
}

#[test]
fn a_rod_that_is_too_short() {
    refuses("simulate slider-crank --set l2=50mm --end 0.3s --out part.csv", &["error: "]);
}

#[test]
fn files_that_cannot_be_written() {
    refuses("simulate slider-crank --end 10ms --out no/such/out.csv", &["cannot write no/such/out.csv"]);
    refuses("simulate slider-crank --end 10ms --plot out.bmp", &["out.bmp", ".svg or .png"]);
    refuses("simulate slider-crank --end 10ms --sketch out.pdf", &["out.pdf", ".svg or .png"]);
    refuses("simulate slider-crank --end 10ms --report no/such/out.html", &["cannot write no/such/out.html"]);
    refuses("paper --json no/such/file.json", &["cannot write no/such/file.json"]);
    refuses("new 7up", &["`7up`", "begins with a letter"]);
}

#[test]
fn a_run_with_everything() {
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(
        folder.path(),
        "simulate slider-crank-free --set omega=300rpm --set l1=70mm --input crank_torque=0.5N*m --step 0.5ms \
         --end 0.1s --alpha 1000 --beta 1500 --feedback per-stage --start consistent --out a.csv --plot a.svg \
         --sketch mechanism.svg --report a.html",
    );
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let report = String::from_utf8(output.stdout).unwrap();
    for part in ["steps", "200", "max ‖Φ‖", "energy change", "x3 at the end"] {
        assert!(report.contains(part), "{report}");
    }
    let csv = std::fs::read_to_string(folder.path().join("a.csv")).unwrap();
    let mut lines = csv.lines();
    let heading = lines.next().unwrap();
    assert!(heading.starts_with("t [s],x1 [m],y1 [m],theta1 [rad]"), "{heading}");
    for part in ["der(theta1) [rad/s]", "lambda(guide) [N]", "violation [SI]"] {
        assert!(heading.contains(part), "{heading}");
    }
    assert_eq!(lines.count(), 201);
    let svg = std::fs::read_to_string(folder.path().join("a.svg")).unwrap();
    assert!(svg.contains("angle (rad)"));
    let sketch = std::fs::read_to_string(folder.path().join("mechanism.svg")).unwrap();
    let page = std::fs::read_to_string(folder.path().join("a.html")).unwrap();
    for body in ["crank", "rod", "slider"] {
        assert!(sketch.contains(body) && page.contains(&format!("\"text\":\"{body}\"")), "{body}");
    }
    for part in ["max ‖Φ‖", "crank speed", "\"kind\":\"lines\""] {
        assert!(page.contains(part), "{part}");
    }
}

#[test]
fn beyond_stability_only_on_request() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = "simulate slider-crank --alpha 2600 --beta 2000 --feedback per-stage --end 5ms";
    assert!(!mbs(folder.path(), arguments).status.success());
    assert!(mbs(folder.path(), &format!("{arguments} --allow-unstable")).status.success());
}

#[test]
fn an_early_end_keeps_what_was_computed() {
    // The paper's Figures 4–7: without feedback its start ends in a singular position.
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(
        folder.path(),
        "simulate slider-crank --start declared --alpha 0 --beta 0 --end 0.2s --out part.csv",
    );
    assert!(!output.status.success());
    let message = String::from_utf8(output.stderr).unwrap();
    assert!(message.contains("ended early") && message.contains("part.csv"), "{message}");
    let rows = std::fs::read_to_string(folder.path().join("part.csv")).unwrap().lines().count();
    assert!((290..310).contains(&rows), "{rows}");
}

#[test]
fn the_list_has_names_units_and_values() {
    let folder = tempfile::tempdir().unwrap();
    let list = String::from_utf8(mbs(folder.path(), "list").stdout).unwrap();
    for part in ["slider-crank-free", "pendulum", "60 mm", "200 rpm", "crank_torque", "drive_torque", "dof"] {
        assert!(list.contains(part), "{list}");
    }
}

/// A name begins its line; what belongs to it is indented.
#[test]
fn every_mechanism_runs_as_it_is_declared() {
    let folder = tempfile::tempdir().unwrap();
    let list = String::from_utf8(mbs(folder.path(), "list").stdout).unwrap();
    let heads = list.lines().skip(2).filter(|line| !line.starts_with(' '));
    let names: Vec<_> = heads.filter_map(|line| line.split_whitespace().next()).collect();
    assert!(names.len() > 20, "{list}");
    for name in names {
        let output = mbs(folder.path(), &format!("simulate {name} --every 1000 --out {name}.csv"));
        assert!(output.status.success(), "{name}: {}", String::from_utf8_lossy(&output.stderr));
        let rows = std::fs::read_to_string(folder.path().join(format!("{name}.csv"))).unwrap();
        assert!(rows.lines().count() > 2, "{name}: {rows}");
    }
}

#[test]
fn drift_has_a_row_per_mechanism() {
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(folder.path(), "drift");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let table = String::from_utf8(output.stdout).unwrap();
    for part in ["max ‖Φ‖", "slider-crank", "andrews-squeezer", "klann"] {
        assert!(table.contains(part), "{table}");
    }
}

#[test]
fn a_new_crate_is_complete_and_never_overwrites() {
    let folder = tempfile::tempdir().unwrap();
    assert!(mbs(folder.path(), "new demo").status.success());
    for file in ["Cargo.toml", "README.md", "src/main.rs", "src/lib.rs", "tests/motion.rs"] {
        assert!(folder.path().join("demo").join(file).is_file(), "{file}");
    }
    let again = mbs(folder.path(), "new demo");
    assert!(!again.status.success());
    assert!(String::from_utf8(again.stderr).unwrap().contains("cannot create demo"));
}

#[test]
fn explain_prints_the_equations() {
    let output = mbs(Path::new("."), "explain slider-crank");
    let text = String::from_utf8(output.stdout).unwrap();
    for expected in [
        "7 coordinates, 7 constraints, 0 degrees of freedom",
        "Φ[crank_x]     = x1 - 1/2*l1*cos(theta1)",
        "∂guide/∂theta2       = l2*cos(theta2)",
        "γ[guide]   = l1*sin(theta1)*der(theta1)^2 + l2*sin(theta2)*der(theta2)^2",
        "Q[y1] = -9.81*m1",
        "lambda(guide), theta2        l2*cos(theta2)  watched",
        "stabilized           49   44   1    2",
    ] {
        assert!(text.contains(expected), "{expected}\n{text}");
    }
}

#[test]
fn explain_writes_latex() {
    let output = mbs(Path::new("."), "explain slider-crank-free --latex");
    let text = String::from_utf8(output.stdout).unwrap();
    for expected in [
        r"\Phi^{\mathrm{crank\_x}} &= x_{1} - \frac{1}{2} l_{1} \, \cos \theta_{1}",
        r"\frac{\partial \Phi_{\mathrm{guide}}}{\partial \theta_{2}} &= l_{2} \, \cos \theta_{2}",
        r"\dot{\theta_{1}}^{2}",
    ] {
        assert!(text.contains(expected), "{expected}\n{text}");
    }
    // what opens closes
    assert_eq!(text.matches(r"\begin").count(), text.matches(r"\end").count());
    assert_eq!(text.matches('{').count(), text.matches('}').count());
    assert_eq!(text.matches(r"\left(").count(), text.matches(r"\right)").count());
    assert_eq!(text.matches('$').count() % 2, 0);
    // and what is no letter of LaTeX does not occur
    assert!(text.is_ascii(), "{text}");
}

fn sweep(folder: &Path, arguments: &str) -> (String, Vec<Vec<String>>) {
    let output = mbs(folder, &format!("sweep {arguments} --out out.csv --plot out.svg"));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let csv = std::fs::read_to_string(folder.join("out.csv")).unwrap();
    let rows = csv.lines().map(|line| line.split(',').map(str::to_owned).collect());
    (String::from_utf8(output.stdout).unwrap(), rows.collect())
}

/// The crank turns by ωt exactly, one and a half turns at 300 rpm.
#[test]
fn a_sweep_over_two_parameters() {
    let folder = tempfile::tempdir().unwrap();
    let grid = "slider-crank --param omega=100rpm..300rpm:3 --param l1=50mm..60mm:2 --end 0.3s";
    let (report, rows) = sweep(folder.path(), &format!("{grid} --output theta1 --output drive_torque"));
    assert_eq!(
        rows[0][..5],
        ["omega [rpm]", "l1 [mm]", "min theta1 [rad]", "max theta1 [rad]", "final theta1 [rad]"]
    );
    assert_eq!(rows.len(), 7);
    let number = |row: usize, column: usize| rows[row][column].parse::<f64>().unwrap();
    for (row, (rpm, crank)) in
        [(100.0, 50.0), (200.0, 50.0), (300.0, 50.0), (100.0, 60.0)].into_iter().enumerate()
    {
        assert!((number(row + 1, 0) - rpm).abs() < 1e-9 && (number(row + 1, 1) - crank).abs() < 1e-9);
        let angle = rpm * std::f64::consts::TAU / 60.0 * 0.3;
        assert!((number(row + 1, 4) - angle).abs() < 1e-9 && number(row + 1, 2).abs() < 1e-9);
        assert_eq!(rows[row + 1].last().unwrap(), "");
    }
    for part in ["largest peak", "drive_torque", "l1 = 60 mm, omega", "written: out.csv"] {
        let part = part.replace("l1 = 60 mm, omega", "omega = 300 rpm, l1 = 60 mm");
        assert!(report.contains(&part), "{report}");
    }
    let svg = std::fs::read_to_string(folder.path().join("out.svg")).unwrap();
    assert!(svg.contains("peak drive torque") && svg.contains("omega (rpm)"));
    assert!(!folder.path().join("out.csv.part").exists());
}

/// A rod that is not longer than the crank gets stuck.
#[test]
fn a_sweep_with_gaps() {
    let folder = tempfile::tempdir().unwrap();
    let (report, rows) = sweep(folder.path(), "slider-crank --param l2=40mm..140mm:6 --end 0.3s --show max");
    assert!(report.contains("note: 2 of 6 runs failed, the first one at l2 = 40 mm: "), "{report}");
    assert_eq!(rows[1][1..4], ["", "", ""]);
    assert!(!rows[1][4].is_empty() && rows[3][4].is_empty() && !rows[3][1].is_empty(), "{rows:?}");
    refuses("sweep slider-crank --param l2=30mm..40mm:3 --end 0.3s", &["3 of 3 runs failed", "l2 = 30 mm"]);
}

/// With and without lanes; the digits of a run do not depend on its neighbours.
#[test]
fn sweeps_of_mechanisms_with_and_without_lanes() {
    let folder = tempfile::tempdir().unwrap();
    let (_, rows) = sweep(folder.path(), "pendulum --param length=0.5m..1m:3 --end 0.5s");
    assert_eq!(rows.len(), 4);
    let (_, rows) = sweep(folder.path(), "slider-crank --param l1=50mm..60mm:3 --end 0.1s --output x3");
    let (_, one) = sweep(folder.path(), "slider-crank --param l1=55mm..60mm:2 --end 0.1s --output x3");
    assert_eq!(rows[2], one[1]);
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

/// In lanes and one by one: Ctrl-C keeps the rows of finished runs.
#[cfg(unix)]
#[test]
fn an_interrupted_sweep_keeps_what_is_finished() {
    for sweep in ["slider-crank --param l1=50mm..60mm:500000", "pendulum --param length=1m..2m:500000"] {
        let folder = tempfile::tempdir().unwrap();
        let arguments = format!("sweep {sweep} --out out.csv");
        let running = Command::new(env!("CARGO_BIN_EXE_mbs"))
            .args(arguments.split_whitespace())
            .current_dir(folder.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let part = folder.path().join("out.csv.part");
        // rows are written in pieces of some kilobytes
        while !std::fs::metadata(&part).is_ok_and(|file| file.len() > 0) {
            std::thread::sleep(Duration::from_millis(10));
        }
        let interrupt = format!("kill -INT {}", running.id());
        assert!(Command::new("sh").args(["-c", &interrupt]).status().unwrap().success());
        let output = running.wait_with_output().unwrap();

        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(130), "{message}");
        let rows = std::fs::read_to_string(&part).unwrap().lines().count() - 1;
        let told =
            format!("error: interrupted after {rows} of 500000 runs; their rows are in out.csv.part\n");
        assert!(message.ends_with(&told) && rows > 0, "{message}, {rows} rows");
        assert!(String::from_utf8(output.stdout).unwrap().contains("smallest peak"));
        assert!(!folder.path().join("out.csv").exists());
    }
}

#[test]
fn long_lists_are_shortened() {
    let folder = tempfile::tempdir().unwrap();
    let run = |arguments: &str| {
        let output = mbs(folder.path(), &format!("simulate n-pendulum-10 --end 1ms {arguments}"));
        String::from_utf8(output.stdout).unwrap()
    };
    let (short, all) = (run("--out run.csv"), run("--all"));
    let parts =
        ["x_1 at the end", "theta_1 at the end", "theta_10 at the end", "der(x_1)", "hook_force at the end"];
    for part in parts {
        assert!(short.contains(part) && all.contains(part), "{part}: {short}");
    }
    assert_eq!(short.matches("… 24 more, with --all").count(), 2, "{short}");
    assert!(!short.contains("x_5") && all.contains("x_5 at the end") && !all.contains('…'), "{all}");
    let heading = std::fs::read_to_string(folder.path().join("run.csv")).unwrap();
    assert!(heading.lines().next().unwrap().contains("der(theta_5)"), "{heading}");
}
