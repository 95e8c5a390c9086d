//! The `mbs` command as people use it, and what it says when they slip.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use std::path::{Path, PathBuf};
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

/// Files that are not finished.
fn parts(folder: &Path) -> Vec<PathBuf> {
    let files = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.filter(|path| path.extension().is_some_and(|ending| ending == "part")).collect()
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
    refuses("new fn", &["`fn`", "keyword of Rust"]);
    refuses("new self", &["`self`", "keyword of Rust"]);
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

/// What a sweep prints, on both streams, and its rows. It has to end with this code.
fn sweep_ending(code: i32, folder: &Path, arguments: &str) -> (String, Vec<Vec<String>>) {
    let mut output = mbs(folder, &format!("sweep {arguments} --out out.csv --plot out.svg"));
    assert_eq!(output.status.code(), Some(code), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout.extend(output.stderr);
    let csv = std::fs::read_to_string(folder.join("out.csv")).unwrap();
    let rows = csv.lines().map(|line| line.split(',').map(str::to_owned).collect());
    (String::from_utf8(output.stdout).unwrap(), rows.collect())
}

fn sweep(folder: &Path, arguments: &str) -> (String, Vec<Vec<String>>) {
    sweep_ending(0, folder, arguments)
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
    assert!(parts(folder.path()).is_empty());
}

/// A rod that is not longer than the crank gets stuck.
#[test]
fn a_sweep_with_gaps() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = "slider-crank --param l2=40mm..140mm:6 --end 0.3s --show max";
    let (report, rows) = sweep_ending(3, folder.path(), arguments);
    assert!(report.contains("warning: 2 of 6 runs failed, the first one at l2 = 40 mm: "), "{report}");
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
        // rows are written in pieces of some kilobytes
        let is_filled = |part: &PathBuf| std::fs::metadata(part).is_ok_and(|file| file.len() > 0);
        while !parts(folder.path()).iter().any(is_filled) {
            std::thread::sleep(Duration::from_millis(10));
        }
        let interrupt = format!("kill -INT {}", running.id());
        assert!(Command::new("sh").args(["-c", &interrupt]).status().unwrap().success());
        let output = running.wait_with_output().unwrap();

        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(130), "{message}");
        let part = parts(folder.path()).pop().unwrap();
        let rows = std::fs::read_to_string(&part).unwrap().lines().count() - 1;
        let part = part.file_name().unwrap().to_str().unwrap();
        assert!(part.starts_with("out.csv."), "{part}");
        let told = format!("error: interrupted after {rows} of 500000 runs; their rows are in {part}\n");
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

fn text(bytes: Vec<u8>) -> String {
    String::from_utf8(bytes).unwrap()
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

/// Values were in the declared unit over axes in SI units.
#[test]
fn the_unit_of_a_picture_is_that_of_its_values() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let run = "simulate chebyshev --end 0.1s --out a.csv --plot a.svg --report a.html --columns p_x";
    assert!(mbs(folder.path(), run).status.success());
    let csv = file("a.csv");
    let mut lines = csv.lines();
    assert_eq!(lines.next().unwrap(), "t [s],p_x [mm]");
    let first: f64 = lines.next().unwrap().split(',').nth(1).unwrap().parse().unwrap();
    assert!((first - 80.0).abs() < 1e-3, "{first}");
    assert!(file("a.svg").contains("p x (mm)"));
    let page = file("a.html");
    let begin = page.find("id=\"data\">").unwrap() + 10;
    let data = &page[begin..begin + page[begin..].find("</script>").unwrap()];
    let plots: serde_json::Value = serde_json::from_str(data).unwrap();
    let curve = plots.as_array().unwrap().iter().find(|plot| plot["kind"] == "lines").unwrap();
    assert_eq!(curve["y"]["label"], "p x (mm)");
    assert!((curve["series"][0]["y"][0].as_f64().unwrap() - first).abs() < 1e-3);
    let readout = &plots[0]["readouts"][0];
    assert_eq!((&readout["name"], &readout["unit"]), (&"p x".into(), &"mm".into()));
    // A sweep over one parameter, and over two.
    let (_, rows) = sweep(folder.path(), "chebyshev --param crank_length=30..50:3 --output p_x --end 0.5s");
    assert!(rows[0].contains(&"max p_x [mm]".to_owned()), "{:?}", rows[0]);
    assert!(file("out.svg").contains("peak p x (mm)") && file("out.svg").contains("crank length (mm)"));
    let two = "chebyshev --param crank_length=30..50:3 --param omega=30..60:2 --output p_x --end 0.5s";
    sweep(folder.path(), two);
    for part in ["peak p x (mm)", "crank length (mm)", "omega (rpm)"] {
        assert!(file("out.svg").contains(part), "{part}");
    }
}

#[test]
fn doubtful_numbers_end_with_a_warning() {
    let folder = tempfile::tempdir().unwrap();
    let output = mbs(folder.path(), "simulate slider-crank --step 20ms --end 4s --out a.csv");
    assert_eq!(output.status.code(), Some(3));
    let warning = text(output.stderr);
    assert!(
        warning.starts_with("warning: the constraint `") && warning.contains("try a smaller --step"),
        "{warning}"
    );
    assert!(folder.path().join("a.csv").exists() && text(output.stdout).contains("written: a.csv"));
}

#[test]
fn options_that_contradict_each_other() {
    refuses("simulate slider-crank --set l1=60 --set l1=70", &["`l1`", "set twice"]);
    refuses("simulate slider-crank --plot a.svg --sketch a.svg", &["`a.svg`", "two options write to it"]);
    refuses("simulate slider-crank --step 1ms --step 2ms", &["'--step", "cannot be used multiple times"]);
    refuses("sweep slider-crank --param l1=50..60:2 --set l1=70", &["`l1`", "set with --set and swept"]);
    refuses("sweep slider-crank --param l1=50..60:2 --output x3 --output x3", &["`x3`", "named twice"]);
    refuses("simulate slider-crank --compare l1=50,60 --set l1=70", &["`l1`", "set as well as compared"]);
    refuses("simulate slider-crank --compare l1=1,2,3,4,5,6,7,8", &["7 values", "sweep"]);
    refuses("simulate slider-crank --compare l1=50,60 --report a.html", &["--report", "cannot be used"]);
    refuses("simulate slider-crank --columns z*", &["no column `z*`", "theta1"]);
}

/// Two sweeps with one name mixed their rows, since both wrote `out.csv.part`.
#[test]
fn two_sweeps_with_one_name_do_not_mix() {
    let folder = tempfile::tempdir().unwrap();
    let start = |range: &str| {
        let arguments = format!("sweep pendulum --param length={range}:400 --end 0.5s --out out.csv");
        let mut command = Command::new(env!("CARGO_BIN_EXE_mbs"));
        command.args(arguments.split_whitespace()).current_dir(folder.path()).stdout(Stdio::null());
        command.spawn().unwrap()
    };
    let mut both = [start("1..2"), start("3..4")];
    assert!(both.iter_mut().all(|sweep| sweep.wait().unwrap().success()));
    let csv = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
    let lengths = csv.lines().skip(1).map(|line| line.split(',').next().unwrap().parse::<f64>().unwrap());
    let lengths: Vec<_> = lengths.collect();
    assert_eq!(lengths.len(), 400);
    assert!(lengths.is_sorted() && lengths[399] - lengths[0] == 1.0, "{lengths:?}");
    assert!(parts(folder.path()).is_empty());
}

#[cfg(target_os = "linux")]
#[test]
fn outputs_that_are_no_plain_files() {
    let folder = tempfile::tempdir().unwrap();
    let shell = |script: &str| {
        let script = format!("mbs() {{ {} \"$@\"; }}\n{script}", env!("CARGO_BIN_EXE_mbs"));
        Command::new("bash").args(["-c", &script]).current_dir(folder.path()).output().unwrap()
    };
    let full = shell("mbs list > /dev/full");
    assert_eq!(full.status.code(), Some(1));
    assert!(text(full.stderr).contains("error: cannot write to standard output: No space left"));
    assert!(!shell("mbs list --help > /dev/full").status.success());
    // The reader of a pipe may go: 128 + SIGPIPE, and not a word.
    let closed = shell("mbs list | true; exit ${PIPESTATUS[0]}");
    let early = shell("(sleep 0.5; mbs list) | true; exit ${PIPESTATUS[0]}");
    assert_eq!((early.status.code(), early.stderr), (Some(141), Vec::new()));
    assert!(matches!(closed.status.code(), Some(0 | 141)));
    // A FIFO is written through and stays one.
    let run = "mbs simulate pendulum --end 10ms --columns x --out";
    let fifo =
        shell(&format!("mkfifo pipe && (cat pipe > copy &) && {run} pipe && sleep 0.2 && test -p pipe"));
    assert!(fifo.status.success(), "{}", text(fifo.stderr));
    let copy = std::fs::read_to_string(folder.path().join("copy")).unwrap();
    assert!(copy.starts_with("t [s],x [m]\n") && copy.lines().count() == 22, "{copy}");
    // A link goes on to point to its file.
    let link =
        shell(&format!("ln -s real.csv link.csv && {run} link.csv && test -L link.csv && test -f real.csv"));
    assert!(link.status.success(), "{}", text(link.stderr));
    let device = shell(&format!("{run} /dev/full"));
    assert_eq!(device.status.code(), Some(1));
    // To standard output, whatever that is.
    let through = shell(&format!("{run} /dev/stdout | head -1"));
    assert!(text(through.stdout).starts_with("t [s],x [m]"));
}

/// A disk that is full leaves no empty file under the final name.
#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_leaves_nothing() {
    let folder = tempfile::tempdir().unwrap();
    // Files may have 4 kB here.
    let script = format!(
        "ulimit -f 4; trap '' XFSZ; {} simulate slider-crank --out out.csv",
        env!("CARGO_BIN_EXE_mbs")
    );
    let output = Command::new("bash").args(["-c", &script]).current_dir(folder.path()).output().unwrap();
    assert_eq!(output.status.code(), Some(1));
    assert!(text(output.stderr).contains("error: cannot write out.csv: File too large"));
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn columns_and_runs_of_ones_choice() {
    let folder = tempfile::tempdir().unwrap();
    let file = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    let run = |arguments: &str| {
        let output = mbs(folder.path(), &format!("simulate slider-crank --end 0.1s {arguments}"));
        assert!(output.status.success(), "{}", text(output.stderr));
        text(output.stdout)
    };
    let report = run("--columns x?,drive* --x theta1 --out a.csv --plot a.svg");
    assert!(file("a.csv").starts_with("theta1 [rad],x1 [m],x2 [m],x3 [m],drive_torque [N*m]\n"));
    assert!(report.contains("x3 at the end") && !report.contains("y1 at the end"), "{report}");
    let svg = file("a.svg");
    assert!(svg.contains("theta1 (rad)") && svg.contains("position (m)") && !svg.contains("time (s)"));
    let report = run("--compare omega=100,200 --columns x3 --out b.csv --plot b.svg");
    for part in ["omega = 100 rpm", "omega = 200 rpm"] {
        assert!(report.contains(part) && file("b.svg").contains(part), "{part}");
    }
    let csv = file("b.csv");
    assert!(csv.starts_with("omega [rpm],t [s],x3 [m]\n100.0,0.0,"), "{csv}");
    assert_eq!(csv.lines().count(), 1 + 2 * 201);
}

#[test]
fn what_scripts_read() {
    let folder = tempfile::tempdir().unwrap();
    let json = |arguments: &str| -> serde_json::Value {
        serde_json::from_slice(&mbs(folder.path(), arguments).stdout).unwrap()
    };
    let list = json("list --json");
    let crank = list.as_array().unwrap().iter().find(|model| model["name"] == "slider-crank").unwrap();
    assert_eq!(
        (&crank["parameters"][0]["name"], &crank["parameters"][0]["unit"]),
        (&"l1".into(), &"mm".into())
    );
    let run = json("simulate slider-crank --set omega=300 --end 0.1s --json --out a.csv");
    assert_eq!(run["given"]["omega"], serde_json::json!({ "value": 300.0, "unit": "rpm" }));
    assert_eq!((&run["steps"], &run["error"], &run["files"][0]), (&200.into(), &().into(), &"a.csv".into()));
    assert!(
        run["final"]["theta1"]["value"].as_f64().unwrap() > 3.0 && run["warnings"] == serde_json::json!([])
    );
    let sweep = json("sweep slider-crank --param l1=50..60:2 --end 0.1s --json");
    assert_eq!((&sweep["runs"], &sweep["failed"]), (&2.into(), &0.into()));
    assert!(sweep["quantities"]["drive_torque"]["largest"]["at"]["l1"]["unit"] == "mm", "{sweep}");
}

#[test]
fn inputs_from_a_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("in.csv"), "t [s],crank_torque [N*mm]\n0,0\n0.1,500\n").unwrap();
    let run =
        |arguments: &str| mbs(folder.path(), &format!("simulate slider-crank-free --end 0.1s {arguments}"));
    let end = |arguments: &str| {
        let output = run(&format!("--json {arguments}"));
        assert!(output.status.success(), "{}", text(output.stderr));
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        json["final"]["theta1"]["value"].as_f64().unwrap()
    };
    let (none, rising, constant) = (end(""), end("--input @in.csv"), end("--input crank_torque=0.5"));
    assert!(none < rising && rising < constant, "{none} {rising} {constant}");
    let twice = run("--input @in.csv --input crank_torque=1");
    assert!(text(twice.stderr).contains("set to a value and read from a file"));
}

#[test]
fn completions_know_the_mechanisms() {
    let script = text(mbs(Path::new("."), "completions bash").stdout);
    for part in ["--compare", "slider-crank-free", "complete"] {
        assert!(script.contains(part), "{part}");
    }
}
