//! Linear systems, their modes and their responses at the command line.

use std::f64::consts::TAU;

use super::{mbs, refuses};

/// k = 200 N/m, m = 2 kg, c = 4 N·s/m.
const OSCILLATOR: &str = "spring-mass-damper";

fn json(folder: &std::path::Path, arguments: &str) -> serde_json::Value {
    let output = mbs(folder, &format!("{arguments} --json"));
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&output.stdout).unwrap()
}

fn words(folder: &std::path::Path, arguments: &str) -> String {
    let output = mbs(folder, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

#[track_caller]
fn near(found: &serde_json::Value, expected: f64) {
    let found = found.as_f64().unwrap();
    assert!((found - expected).abs() <= 1e-9 * (1.0 + expected.abs()), "{found} and not {expected}");
}

#[test]
fn a_linear_system_with_names_and_units() {
    let folder = tempfile::tempdir().unwrap();
    let found =
        json(folder.path(), &format!("linearize {OSCILLATOR} --outputs x,wall_force --parameters mass"));
    assert_eq!((&found["states"][1]["name"], &found["states"][1]["unit"]), (&"der(x)".into(), &"m/s".into()));
    assert_eq!((&found["inputs"][1]["name"], &found["inputs"][1]["unit"]), (&"mass".into(), &"kg".into()));
    near(&found["A"][1][0], -100.0);
    near(&found["A"][1][1], -2.0);
    near(&found["B"][1][0], 0.5);
    near(&found["C"][1][0], -200.0);
    assert_eq!(found["about"], "a stable equilibrium");

    // at rest elsewhere, and in motion, it is no equilibrium
    let away = json(folder.path(), &format!("linearize {OSCILLATOR} --here --from x=30mm"));
    near(&away["rate"][1], -3.0);
    let moving = json(folder.path(), "linearize four-bar-free --after 0.1s");
    assert_eq!((&moving["about"], &moving["t_s"]), (&"the motion at t = 0.1 s".into(), &0.1.into()));
    near(&moving["rate"][0], moving["states"][1]["value"].as_f64().unwrap());
    let table = words(folder.path(), &format!("linearize {OSCILLATOR} --input push=10N"));
    for part in ["A (SI, rad)", "d/dt der(x)", "−100", "0.05"] {
        assert!(table.contains(part), "{table}");
    }
}

#[test]
fn files_of_a_linear_system() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    words(folder.path(), &format!("linearize {OSCILLATOR} --out s.npz --step-response s.svg"));
    words(folder.path(), &format!("linearize {OSCILLATOR} --out s.json --step-response s.csv --end 2s"));
    // a ZIP archive with a stored array each
    let npz = std::fs::read(at("s.npz")).unwrap();
    assert_eq!(&npz[..4], b"PK\x03\x04");
    let header = b"\x93NUMPY\x01\x00";
    assert_eq!(npz.windows(header.len()).filter(|bytes| bytes == header).count(), 14);
    let found: serde_json::Value = serde_json::from_slice(&std::fs::read(at("s.json")).unwrap()).unwrap();
    near(&found["A"][1][0], -100.0);
    assert!(std::fs::read_to_string(at("s.svg")).unwrap().contains("wall force per push"));
    let csv = std::fs::read_to_string(at("s.csv")).unwrap();
    assert!(csv.starts_with("t [s],wall_force per push [N/N],loss per push [W/N]\n0.0,0.0,0.0\n"), "{csv}");
    assert_eq!(csv.lines().count(), 1002);
    assert!(csv.lines().next_back().unwrap().starts_with("2.0,-"));
}

/// ω = √(k/m) = 10 rad/s, ζ = c/(2√(km)) = 0.1.
#[test]
fn modes_and_their_sensitivities() {
    let folder = tempfile::tempdir().unwrap();
    let found = json(folder.path(), &format!("modes {OSCILLATOR} --sensitivity stiffness,damp*"));
    let mode = &found["modes"][0];
    near(&mode["natural_frequency_rad_s"], 10.0);
    near(&mode["damping_ratio"], 0.1);
    near(&mode["frequency_Hz"], 10.0 * 0.99_f64.sqrt() / TAU);
    near(&mode["sensitivities"]["stiffness"]["natural_frequency_rad_s"], 10.0 / 400.0);
    near(&mode["sensitivities"]["damping"]["damping_ratio"], 0.1 / 4.0);
    assert_eq!(mode["sensitivities"]["stiffness"]["per"], "N/m");

    let table = words(folder.path(), "modes double-pendulum --sketch modes.svg --report modes.html");
    for part in ["0.6032376", "1.618019", "angle2", "written: modes.html"] {
        assert!(table.contains(part), "{table}");
    }
    let page = std::fs::read_to_string(folder.path().join("modes.html")).unwrap();
    assert!(page.contains("mode 2: 1.618 Hz") && page.matches("class=\"animation\"").count() == 2);
    assert!(std::fs::read_to_string(folder.path().join("modes.svg")).unwrap().contains("mode 1: 0.6032 Hz"));
    // a declaration that hangs free, and one that is about to fall
    let table = words(folder.path(), "modes cart-pendulum");
    for part in ["rigid-body mode", "divergence", "overdamped", "an unstable equilibrium"] {
        assert!(table.contains(part), "{table}");
    }
}

#[test]
fn a_frequency_response() {
    let folder = tempfile::tempdir().unwrap();
    let table = words(
        folder.path(),
        &format!("bode {OSCILLATOR} --outputs x --plot b.svg --out b.csv --range 0.1Hz..10Hz"),
    );
    // 1/(k 2ζ√(1 − ζ²)) at ω √(1 − 2ζ²)
    for part in ["x per push", "0.025126", "1.5756 Hz", "m/N"] {
        assert!(table.contains(part), "{table}");
    }
    let csv = std::fs::read_to_string(folder.path().join("b.csv")).unwrap();
    assert!(csv.starts_with("frequency [Hz],|x per push| [m/N],phase(x per push) [deg]\n0.1,"), "{csv}");
    for line in csv.lines().skip(1) {
        let numbers: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        let omega = TAU * numbers[0];
        let size = 1.0 / (200.0 - 2.0 * omega * omega).hypot(4.0 * omega);
        assert!((numbers[1] - size).abs() < 1e-9 * size, "{line}");
        let phase = -(4.0 * omega).atan2(200.0 - 2.0 * omega * omega).to_degrees();
        assert!((numbers[2] - phase).abs() < 1e-6, "{line}");
    }
    assert!(std::fs::read_to_string(folder.path().join("b.svg")).unwrap().contains("−90"));
    let free = words(folder.path(), "bode cart-pendulum --outputs theta --from theta=170deg");
    assert!(free.contains("∞ (undamped)"), "{free}");
}

/// Friction that changes its sign, and a stop that is touched: the result is given with a warning.
#[test]
fn what_is_not_smooth_is_doubted() {
    let folder = tempfile::tempdir().unwrap();
    let bumper =
        "Bumper { dof = 1; body block (x) { mass = 1 [kg]; } force wall on x = -50 [N/m]*(x + abs(x)); }";
    std::fs::write(folder.path().join("bumper.mbs"), bumper).unwrap();
    let output = mbs(folder.path(), "linearize bumper.mbs --here");
    assert_eq!(output.status.code(), Some(3));
    assert!(String::from_utf8_lossy(&output.stderr).contains("not smooth"), "{output:?}");
}

#[test]
fn what_cannot_be_asked() {
    refuses("linearize slider-crank", &["no degree of freedom", "SliderCrank"]);
    refuses(&format!("linearize {OSCILLATOR} --inputs pusch"), &["no input `pusch`", "did you mean `push`"]);
    refuses(&format!("linearize {OSCILLATOR} --outputs wall"), &["no output `wall`", "wall_force"]);
    refuses(&format!("linearize {OSCILLATOR} --parameters stif"), &["no parameter `stif`", "stiffness"]);
    refuses(&format!("linearize {OSCILLATOR} --out s.txt"), &["s.txt", ".json or .npz"]);
    refuses(
        &format!("linearize {OSCILLATOR} --step-response s.svg --end 0s"),
        &["end of a step response", "above 0"],
    );
    refuses(&format!("linearize {OSCILLATOR} --input @in.csv"), &["--input @FILE", "constants"]);
    refuses(&format!("linearize {OSCILLATOR} --after -1s"), &["after", "0 or later"]);
    refuses(
        "linearize double-pendulum --states angle1",
        &["`angle1` cannot be the states", "2 degrees of freedom"],
    );
    refuses(&format!("modes {OSCILLATOR} --sensitivity k"), &["no parameter `k`"]);
    refuses(&format!("modes {OSCILLATOR} --here --sensitivity mass"), &["--sensitivity", "--here"]);
    refuses("modes slider-crank", &["no degree of freedom"]);
    refuses("modes geared-motor", &["no equilibrium", "--here", "--after"]);
    refuses("bode double-pendulum", &["no inputs", "--parameters"]);
    for (range, part) in
        [("0Hz..5Hz", "above 0"), ("-1..5", "above 0"), ("5..1", "smaller"), ("1m..2m", "length")]
    {
        refuses(&format!("bode {OSCILLATOR} --range {range}"), &["range", part]);
    }
}

/// A parameter at its limit is varied towards what it may be; and clocks, which do not act here, do not ask for steps.
/// Regression: both ended in errors that name a value which nobody gave.
#[test]
fn parameters_at_their_limits() {
    let folder = tempfile::tempdir().unwrap();
    let limited = "Limited { dof = 1; param k = 10 [N/m] where k <= 10 [N/m]; body b (x) { mass = 1 [kg]; }
        force f on x = 2 [N] - k*x - 1 [N*s/m]*der(x); }";
    let clocked = "Clocked { dof = 1; param T = 10 [ms]; body b (x) { mass = 1 [kg]; } memory u [N] = 0;
        every T { set u = 1 [N]; } force f on x = u - 5 [N/m]*x; }";
    for (text, parameter, expected) in [(limited, "k", -0.2), (clocked, "T", 0.0)] {
        std::fs::write(folder.path().join("text.mbs"), text).unwrap();
        let found = json(folder.path(), &format!("linearize text.mbs --parameters {parameter}"));
        let column = found["B"][1].as_array().unwrap().last().unwrap().as_f64().unwrap();
        assert!((column - expected).abs() < 1e-9, "{parameter}: {found}");
        let output = mbs(folder.path(), "modes text.mbs --sensitivity *");
        assert!(output.status.success(), "{parameter}: {}", String::from_utf8_lossy(&output.stderr));
    }
}
