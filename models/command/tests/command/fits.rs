//! Fits at the command line: values and errors in declared units, the files that are written, and what is
//! said about data that cannot be used.

use std::path::Path;

use super::{mbs, refuses};

/// m ẍ + c ẋ + k x = 20 N from rest: k = 200 N/m, c = 4 N·s/m, m = 2 kg. The fourth decimal is noise.
fn data(folder: &Path) {
    let (delta, nu) = (1.0, 99.0_f64.sqrt());
    let row = |at: i32| {
        let t = 0.02 * f64::from(at);
        let x = 0.1 * (1.0 - (-delta * t).exp() * ((nu * t).cos() + delta / nu * (nu * t).sin()));
        // a sequence without a pattern between −1 and 1
        let noise = (f64::from(at * at) * 12.9898).sin();
        format!("{},{:.6},7\n", 1e3 * t, 1e3 * x + 0.5 * noise)
    };
    let rows: String = (0..=100).map(row).collect();
    std::fs::write(folder.join("run.csv"), format!("t [ms],x [mm],humidity\n{rows}")).unwrap();
}

const FIT: &str = "fit spring-mass-damper --data run.csv --set release=0m --input push=20N";

#[test]
fn values_errors_and_files() {
    let folder = tempfile::tempdir().unwrap();
    data(folder.path());
    let asked = format!("{FIT} --param stiffness=0.6N/mm,damping=12,mass --plot f.svg --out f.csv");
    let output = mbs(folder.path(), &asked);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    let table = String::from_utf8(output.stdout).unwrap();
    for part in [
        "stiffness",
        "N*s/m",
        "95 % interval",
        "600 N/m",
        "Student's t, 98 degrees",
        "columns not used: humidity",
    ] {
        assert!(table.contains(part), "{table}");
    }
    let json = mbs(folder.path(), &format!("{asked} --json --confidence 99%"));
    let json: serde_json::Value = serde_json::from_slice(&json.stdout).unwrap();
    for (at, truth) in [200.0, 4.0, 2.0].into_iter().enumerate() {
        let estimate = &json["estimates"][at];
        let number = |name: &str| estimate[name].as_f64().unwrap();
        assert!((number("value") - truth).abs() < 3.0 * number("standard_error"), "{estimate}");
        assert!(number("standard_error") < 0.02 * truth, "{estimate}");
        let half =
            0.5 * (estimate["interval"][1].as_f64().unwrap() - estimate["interval"][0].as_f64().unwrap());
        // t.ppf(0.995, 98)
        assert!((half / number("standard_error") - 2.6269310957563734).abs() < 1e-6, "{estimate}");
    }
    let csv = std::fs::read_to_string(folder.path().join("f.csv")).unwrap();
    assert!(csv.starts_with("t [s],x [m],fitted(x) [m],residual(x) [m]\n0.0,0.0,"), "{csv}");
    let picture = std::fs::read_to_string(folder.path().join("f.svg")).unwrap();
    assert!(picture.contains("residual of x") && picture.contains("measured"));
}

/// A recording of `simulate` can be fitted, with inputs from a table, which the data may carry.
#[test]
fn a_recording_with_an_input_is_fitted() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    std::fs::write(at("push.csv"), "t [s],push [N]\n0,0\n0.5,40\n0.7,-20\n2,0\n").unwrap();
    let run = "simulate spring-mass-damper --input @push.csv --end 2s --every 20 --out run.csv --columns x,wall_force";
    assert!(mbs(folder.path(), run).status.success());
    let fitted = |arguments: &str| {
        let output = mbs(folder.path(), &format!("fit spring-mass-damper {arguments} --json"));
        assert!(output.status.code() != Some(1), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap()
    };
    let unknowns = "--param stiffness=500,damping=2,mass=3 --start der(x)=0.1";
    let found = fitted(&format!("--data run.csv --input @push.csv {unknowns}"));
    for (estimate, truth) in found["estimates"].as_array().unwrap().iter().zip([200.0, 4.0, 2.0, 0.0]) {
        // the data are those of Heun's method with h = 0.5 ms, off by (ωh)²
        assert!((estimate["value"].as_f64().unwrap() - truth).abs() < 1e-4 * (truth + 1.0), "{estimate}");
    }
    // the same as one table, sampled less often than the input
    let rows = std::fs::read_to_string(at("run.csv")).unwrap();
    let joined: String = rows
        .lines()
        .map(|line| match line.split(',').next().unwrap() {
            "t [s]" => format!("{line},push [N]\n"),
            t => {
                let t: f64 = t.parse().unwrap();
                let push = match t {
                    t if t < 0.5 => 80.0 * t,
                    t if t < 0.7 => 40.0 - 300.0 * (t - 0.5),
                    t => -20.0 + 20.0 / 1.3 * (t - 0.7),
                };
                format!("{line},{push}\n")
            }
        })
        .collect();
    std::fs::write(at("both.csv"), joined).unwrap();
    let found = fitted(&format!("--data both.csv {unknowns} --columns x"));
    assert!((found["estimates"][0]["value"].as_f64().unwrap() - 200.0).abs() < 0.02);
    assert_eq!(found["columns"].as_array().unwrap().len(), 1);
}

#[test]
fn a_fit_in_doubt_warns() {
    let folder = tempfile::tempdir().unwrap();
    data(folder.path());
    let warned = |arguments: &str, part: &str| {
        let output = mbs(folder.path(), &format!("{FIT} {arguments}"));
        let message = String::from_utf8_lossy(&output.stderr);
        assert!(output.status.code() == Some(3) && message.contains(part), "{message}");
    };
    warned("--param stiffness --bounds stiffness=205..300 --set stiffness=210", "ended at its bound 205 N/m");
    warned("--param stiffness --set damping=40", "not independent noise");
    warned("--param stiffness,damping --sigma x=10mm", "the given standard deviations");
}

#[test]
fn what_cannot_be_fitted() {
    let folder = tempfile::tempdir().unwrap();
    data(folder.path());
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
    let fit = |arguments: &str, parts: &[&str]| says(folder.path(), &format!("{FIT} {arguments}"), parts);
    fit("", &["nothing is to be found", "--param"]);
    fit("--param stif", &["no parameter `stif`", "stiffness"]);
    fit("--param stiffness --start y", &["no start value `y`", "der(x)"]);
    fit("--param stiffness --columns wall_force", &["run.csv has no column `wall_force`", "x, humidity"]);
    fit("--param stiffness --columns humidity", &["no column that can be compared", "wall_force"]);
    fit("--param stiffness,stiffness", &["`stiffness` is looked for twice"]);
    fit("--param stiffness=3m", &["stiffness", "length"]);
    fit("--param stiffness --bounds stiffness=300..", &["from 200 N/m", "300 N/m", "--bounds"]);
    fit("--param stiffness --bounds mass=1..2", &["`mass`", "stiffness"]);
    fit("--param stiffness --bounds stiffness=3", &["not a range"]);
    fit("--param stiffness --sigma y=1mm", &["no compared column `y`"]);
    fit("--param stiffness --sigma x=0mm", &["standard deviation of `x`"]);
    fit("--param stiffness --confidence 95", &["confidence", "95%"]);
    // k alone has an influence at rest; the length of the spring without force has none here
    fit("--param stiffness,free_length", &["do not determine `free_length`", "do not depend on it"]);
    let free = "fit spring-mass-damper --data run.csv --set release=0.1m --param stiffness,damping,mass";
    says(folder.path(), free, &["do not determine", "together"]);
    for (text, parts) in [
        ("t [s],x [mm]\n0,1\n1,NaN\n2,3\n", ["bad.csv, line 3: x", "leave the cell empty"]),
        ("t [s],x [mm]\n0,1\n1,2\n1,3\n", ["bad.csv, line 4: time", "has to rise"]),
        ("t [s],x [kg]\n0,1\n1,2\n", ["bad.csv, line 2: x", "a mass"]),
        ("t [s],x [mm]\n0,1\n1,two\n", ["bad.csv, line 3: x", "not a number"]),
        ("t [s],x [mm]\n0,1\n", ["1 samples do not determine 1", "more samples"]),
        ("t [s],x [mm]\n-1,1\n1,2\n", ["measured at -1 s", "starts at 0 s"]),
        ("x [mm]\n1\n", ["bad.csv", "a column for time"]),
        ("t [s],x [mm]\n0,1\n1,1e155\n2,3\n", ["bad.csv, line 3: x", "out of all measure"]),
        // hung
        ("t [s],x [mm]\n0,1\n1,1\n1e9,2\n", ["until 1000000000 s", "unit of their heading"]),
    ] {
        std::fs::write(folder.path().join("bad.csv"), text).unwrap();
        says(folder.path(), "fit spring-mass-damper --data bad.csv --param stiffness", &parts);
    }
    refuses("fit spring-mass-damper --data none.csv --param mass", &["none.csv"]);
    #[cfg(target_os = "linux")]
    refuses("fit spring-mass-damper --data /dev/zero --param mass", &["/dev/zero: it is longer than 64 MiB"]);
}

/// A log that begins at 646 s was compared with runs that begin at 0 s; here it has decimal commas too.
#[test]
fn a_log_with_a_clock_of_its_own() {
    let folder = tempfile::tempdir().unwrap();
    data(folder.path());
    let rows = std::fs::read_to_string(folder.path().join("run.csv")).unwrap();
    let later = |line: &str| {
        let cells: Vec<f64> = line.split(',').map(|cell| cell.parse().unwrap()).collect();
        format!("{:.3};{:.6};7\n", 646.0 + 1e-3 * cells[0], cells[1]).replace('.', ",")
    };
    let rows: String = rows.lines().skip(1).map(later).collect();
    let log = format!("% rig 7\nTime;x;humidity\ns;mm;\n{rows}");
    std::fs::write(folder.path().join("log.csv"), log).unwrap();
    let estimates = |data: &str| {
        let fit = FIT.replace("run.csv", data);
        let output = mbs(folder.path(), &format!("{fit} --param stiffness=0.6N/mm,damping=12,mass --json"));
        assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
        serde_json::from_slice::<serde_json::Value>(&output.stdout).unwrap()
    };
    let (own, shifted) = (estimates("run.csv"), estimates("log.csv"));
    assert_eq!((&own["start_time"], &shifted["start_time"]), (&serde_json::Value::Null, &646.0.into()));
    for at in 0..3 {
        let value = |found: &serde_json::Value| found["estimates"][at]["value"].as_f64().unwrap();
        // times of the log are rounded to 1e-13 s
        assert!((value(&own) / value(&shifted) - 1.0).abs() < 1e-6, "{} {}", value(&own), value(&shifted));
    }
    let output =
        mbs(folder.path(), &format!("{} --param stiffness,damping", FIT.replace("run.csv", "log.csv")));
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(text.contains("the data begin at 646 s on a clock of their own"), "{text}");
}
