//! Synthesis at the command line: values in declared units, pictures, and what is said when nothing can be found.

use std::path::Path;
use std::process::{Command, Stdio};

use super::mbs;

/// A four-bar of joints, in millimetres.
const BARS: &str = "Bars {
    dof = 1;
    param base = 100 [mm] where base > 0;
    param a = 30 [mm] where a > 0;    param b = 80 [mm] where b > 0;    param c = 70 [mm] where c > 0;
    param along = 40 [mm];    param across = 30 [mm];
    body crank   (x1, y1, theta1) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
    body coupler (x2, y2, theta2) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
    body rocker  (x3, y3, theta3) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
    point o on crank = (0, 0);     point pin on crank = (a, 0);
    point o on coupler = (0, 0);   point pin on coupler = (b, 0);    point tip on coupler = (along, across);
    point o on rocker = (0, 0);    point pin on rocker = (c, 0);
    point end on ground = (base, 0);
    revolute pivot (ground, crank.o);
    revolute pin_a (crank.pin, coupler.o);
    revolute pin_b (coupler.pin, rocker.pin);
    revolute other (ground.end, rocker.o);
    start { theta1 = 90 [deg]; guess theta3 = 60 [deg]; }
    output tip_x [mm] = coupler.tip.x;
    output tip_y [mm] = coupler.tip.y;
}";

fn prepared() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("bars.mbs"), BARS).unwrap();
    // the tip of the declared lengths at 0°, 60°, 120°, 180° and 240° of the crank
    let tip = |crank: f64| {
        let (x, y) = (30.0 * crank.cos(), 30.0 * crank.sin());
        let (dx, dy) = (100.0 - x, -y);
        let d = dx.hypot(dy);
        let coupler = dy.atan2(dx) + ((6400.0 + d * d - 4900.0) / (160.0 * d)).acos();
        let (sin, cos) = coupler.sin_cos();
        [x + 40.0 * cos - 30.0 * sin, y + 40.0 * sin + 30.0 * cos]
    };
    let row = |k: i32| {
        let crank = f64::from(60 * k).to_radians();
        let [x, y] = tip(crank);
        format!("{},{x},{y}\n", crank.to_degrees())
    };
    let rows: String = (0..5).map(row).collect();
    let table = format!("theta1 [deg],tip_x [mm],tip_y [mm]\n{rows}");
    std::fs::write(folder.path().join("timed.csv"), table).unwrap();
    folder
}

const SYNTHESIZE: &str =
    "synthesize bars.mbs --param a=10..60,b=40..120,c=40mm..0.12m,along=0..80,across=-60..60 --drive theta1";

#[test]
fn lengths_with_prescribed_timing() {
    let folder = prepared();
    let asked = format!("{SYNTHESIZE} --through timed.csv --plot p.svg --sketch s.svg --out way.csv");
    let output = mbs(folder.path(), &asked);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let table = String::from_utf8(output.stdout).unwrap();
    for part in ["best", "30 mm", "80 mm", "70 mm", "40 mm", "mechanism of", "written: way.csv"] {
        assert!(table.contains(part), "{table}");
    }
    let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
    assert!(read("p.svg").contains("asked for") && read("s.svg").contains("rocker"));
    assert!(
        read("way.csv").starts_with("x1 [m],y1 [m],theta1 [rad],") && read("way.csv").lines().count() > 40
    );

    let json = mbs(folder.path(), &format!("{SYNTHESIZE} --through timed.csv --json"));
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    let best = &json["linkages"][0];
    for (name, length) in [("a", 30.0), ("b", 80.0), ("c", 70.0), ("along", 40.0), ("across", 30.0)] {
        let value = &best["parameters"][name];
        assert!((value["value"].as_f64().unwrap() - length).abs() < 1e-6 && value["unit"] == "mm", "{json}");
    }
    assert_eq!(best["positions"].as_array().unwrap().len(), 5);
}

#[test]
fn what_cannot_be_synthesized() {
    let folder = prepared();
    #[track_caller]
    fn says(folder: &Path, arguments: &str, parts: &[&str]) {
        let output = mbs(folder, arguments);
        let message = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(1), "{message}");
        assert!(message.starts_with("error: ") && !message.contains("panicked"), "{message}");
        for part in parts {
            assert!(message.contains(part), "`{arguments}` says\n{message}without `{part}`");
        }
    }
    let all = |arguments: &str, parts: &[&str]| says(folder.path(), arguments, parts);
    let timed = "synthesize bars.mbs --through timed.csv";
    all(&format!("{timed} --param a"), &["param = `a`", "NAME=LOW..HIGH"]);
    all(&format!("{timed} --param a=30"), &["param = `a=30`", "NAME=LOW..HIGH"]);
    all(&format!("{timed} --param a=60..10"), &["smaller"]);
    all(&format!("{timed} --param a=1kg..2kg"), &["a", "mass"]);
    all(&format!("{timed} --param length=1..2"), &["no parameter `length`", "across"]);
    all(&format!("{timed} --param a=10..60 --drive phi"), &["no coordinate `phi`", "theta1"]);
    all(&format!("{timed} --param a=10..60 --tolerance 0mm"), &["tolerance", "above 0"]);
    all(&format!("{timed} --param a=10..60,a=10..60"), &["`a` is looked for twice"]);
    // lengths that cannot reach
    all(
        &format!("{timed} --param a=10..12 --starts 128"),
        &["no mechanism was found", "of 128 starts", "misses a value by", "--tolerance"],
    );
    // the points in another order
    let table = std::fs::read_to_string(folder.path().join("timed.csv")).unwrap();
    let untimed = |order: [usize; 5]| -> String {
        let rows: Vec<&str> = table.lines().map(|line| line.split_once(',').unwrap().1).collect();
        order.iter().fold(format!("{}\n", rows[0]), |text, row| text + rows[row + 1] + "\n")
    };
    std::fs::write(folder.path().join("mixed.csv"), untimed([0, 2, 1, 3, 4])).unwrap();
    all(
        "synthesize bars.mbs --through mixed.csv --param a=29.9999..30.0001,b=79.9999..80.0001 --starts 128",
        &["no mechanism was found", "refused", "pass them in another order"],
    );
    std::fs::write(folder.path().join("bad.csv"), "tip_x [mm],nose\n1,2\n").unwrap();
    all("synthesize bars.mbs --through bad.csv --param a=10..60", &["no coordinate or output `nose`"]);
    std::fs::write(folder.path().join("bad.csv"), "tip_x [mm]\n1\ntwo\n").unwrap();
    all(
        "synthesize bars.mbs --through bad.csv --param a=10..60",
        &["bad.csv, line 3: tip_x", "not a number"],
    );
    std::fs::write(folder.path().join("bad.csv"), "tip_x [mm]\n1\n").unwrap();
    all("synthesize bars.mbs --through bad.csv --param a=10..60", &["1 positions cannot be passed"]);
    std::fs::write(folder.path().join("p.csv"), "p_x [mm]\n1\n2\n").unwrap();
    all(
        "synthesize four-bar --through p.csv --param along=1..2",
        &["0 degrees of freedom", "take the drive away"],
    );
}

/// True if a process has a handler for Ctrl-C by now.
#[cfg(target_os = "linux")]
fn catches_interrupts(process: u32) -> bool {
    let status = std::fs::read_to_string(format!("/proc/{process}/status")).unwrap();
    let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:")).unwrap().trim();
    // SIGINT is the second bit
    u64::from_str_radix(caught, 16).unwrap() & 2 != 0
}

/// A function that no such bars generate would be looked for from many starts; Ctrl-C ends that with what is known.
#[cfg(target_os = "linux")]
#[test]
fn an_interrupted_search_says_what_it_found() {
    let folder = prepared();
    let rows: String = (0..9).map(|k| format!("{},{}\n", 40 * k, if k % 2 == 0 { 1 } else { 90 })).collect();
    std::fs::write(folder.path().join("comb.csv"), format!("theta1 [deg],tip_x [mm]\n{rows}")).unwrap();
    let line = format!("{SYNTHESIZE} --through comb.csv --starts 100000000");
    let mut command = Command::new(env!("CARGO_BIN_EXE_mbs"));
    let command = command.args(line.split_whitespace()).current_dir(folder.path());
    let running = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    while !catches_interrupts(running.id()) {
        std::thread::sleep(std::time::Duration::from_millis(10));
    }
    let interrupt = format!("kill -INT {}", running.id());
    assert!(Command::new("sh").args(["-c", &interrupt]).status().unwrap().success());
    let output = running.wait_with_output().unwrap();
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(130), "{message}");
    assert!(message.contains("interrupted after") && message.contains("found nothing"), "{message}");
}
