//! Tables of files: what is read, and what is answered where that cannot be.
#![allow(clippy::unwrap_used, reason = "a test says by panicking what is wrong")]

use std::fs;
use std::path::Path;

use mbs_live::Text;
use mbs_runtime::equations::{At, Equations};

const DECLARATION: &str = "Block {
    dof = 1;
    const half = 0.5;
    body block (x) { mass = 1 [kg]; }
    table pull(angle) = from \"pull.csv\" linear outside extend;
    force spring on x = pull(60*half*1 [deg]);
}";

/// The force at 30 degrees by a file with these bytes, or the message of the error and its help.
fn force(bytes: &[u8]) -> Result<f64, String> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("pull.csv"), bytes).unwrap();
    found(Text::declaration("block.mbs", DECLARATION).in_folder(folder.path()))
}

fn found(text: Text) -> Result<f64, String> {
    let live = text.compile().map_err(|error| {
        let problem = error.problems().first().unwrap().clone();
        // the name of the file, or the law that takes another unit
        assert!(problem.location.as_ref().is_some_and(|at| at.line == 5 || at.line == 6));
        format!("{}: {}", problem.message, problem.help.unwrap_or_default())
    })?;
    let mut acceleration = [0.0];
    live.accelerations(At { t: 0.0, q: &[0.0], v: &[0.0] }, &[], &[], &mut acceleration);
    Ok(acceleration[0])
}

/// Separators, decimal commas, marks of order, comments, quotes, other units, columns in another order and beside others.
#[test]
fn files_as_programs_write_them() {
    for (text, expected) in [
        ("angle [deg],pull [N]\n0,1\n60,3\n", 2.0),
        ("\u{feff}angle [deg];pull [kN]\r\n0;0,5\r\n60;1,5\r\n", 1000.0),
        ("# measured\npull [N]\tnote\tangle [°]\n1\tx\t0\n\n3,5\ty\t60\n", 2.25),
        ("\"angle [rad]\",\"a, b\",\"pull [N]\"\n\"0\",\"1,2\",4\n1.0471975511965976,,4\n", 4.0),
        (" angle [deg] , pull [N]\n -60 , -2e0 \n 60 , 4 \n", 2.5),
    ] {
        let found = force(text.as_bytes()).unwrap();
        assert!((found - expected).abs() < 1e-12 * expected, "{found} for {expected}");
    }
}

#[test]
fn what_is_no_table_is_answered() {
    for (text, expected) in [
        ("", "has no column `angle`"),
        ("angle [deg],pull [N]\n", "has 0 points"),
        ("angel [deg],pull [N]\n0,1\n1,2\n", "did you mean `angel`?"),
        ("angle [deg],pull [N],pull [kN]\n0,1,2\n1,2,3\n", "two columns `pull`"),
        ("angle [deg],pull [N]\n0,1,5\n1,2,5\n", "line 2 has 3 cells"),
        ("angle [deg],pull [N]\n0,1\n1,\n", "row 2 of its column `pull`"),
        ("angle [deg],pull [N]\n0,nan\n1,2\n", "row 1 of its column `pull`: `nan`"),
        ("angle [deg],pull [foo]\n0,1\n1,2\n", "unknown unit"),
        ("angle [deg],pull [N]\n1,1\n0,2\n", "out of order"),
        ("angle [deg],pull [m]\n0,1\n1,2\n", "a length"),
    ] {
        let found = force(text.as_bytes()).unwrap_err();
        assert!(found.contains(expected), "{found}, not {expected}");
    }
    assert!(force(b"angle,pull\n\xff\xfe,1\n").unwrap_err().contains("cannot be read"));
}

/// A text without a folder reads nothing, and one with a folder nothing outside of it.
#[test]
fn files_are_read_in_the_folder_alone() {
    let text = |file: &str| Text::declaration("block.mbs", DECLARATION.replace("pull.csv", file));
    assert!(found(text("pull.csv")).unwrap_err().contains("no folder"));
    let folder = tempfile::tempdir().unwrap();
    let inside = folder.path().join("inside");
    fs::create_dir(&inside).unwrap();
    for place in [folder.path(), &inside] {
        fs::write(place.join("pull.csv"), "angle [deg],pull [N]\n0,1\n60,3\n").unwrap();
    }
    let read = |folder: &Path, file: &str| found(text(file).in_folder(folder));
    assert_eq!(read(folder.path(), "inside/pull.csv"), Ok(2.0));
    assert_eq!(read(&inside, "./pull.csv"), Ok(2.0));
    let outside = folder.path().join("pull.csv").display().to_string();
    for file in ["../pull.csv", &outside] {
        assert!(read(&inside, file).unwrap_err().contains("not in that folder"));
    }
    assert!(read(folder.path(), "inside").unwrap_err().contains("no file"));
}
