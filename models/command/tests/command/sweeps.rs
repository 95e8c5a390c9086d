//! Sweeps, and what they leave in the table and the picture.

use std::path::Path;

use super::{mbs, parts, refuses};

/// Runs a sweep, which has to end with this code. Returns what it prints, on both streams, and its rows.
fn sweep_ending(code: i32, folder: &Path, arguments: &str) -> (String, Vec<Vec<String>>) {
    let mut output = mbs(folder, &format!("sweep {arguments} --out out.csv --plot out.svg"));
    assert_eq!(output.status.code(), Some(code), "{}", String::from_utf8_lossy(&output.stderr));
    output.stdout.extend(output.stderr);
    let csv = std::fs::read_to_string(folder.join("out.csv")).unwrap();
    let rows = csv.lines().map(|line| line.split(',').map(str::to_owned).collect());
    (String::from_utf8(output.stdout).unwrap(), rows.collect())
}

pub fn sweep(folder: &Path, arguments: &str) -> (String, Vec<Vec<String>>) {
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
