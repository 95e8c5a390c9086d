//! Sweeps as Parquet files, in a program that has them built in:
//! `cargo test --release -p mbs --features parquet --test parquet`.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::thread;
use std::time::Duration;

/// Short rods do not reach: some rows have no numbers, but words.
const GRID: &str =
    "slider-crank --param l2=40mm..180mm:300 --param omega=100rpm..300rpm:300 --end 250ms --step 2ms";

fn mbs(folder: &Path, arguments: &str) -> Output {
    let arguments = arguments.split_whitespace();
    Command::new(env!("CARGO_BIN_EXE_mbs")).args(arguments).current_dir(folder).output().unwrap()
}

#[track_caller]
fn ends_with(folder: &Path, arguments: &str, code: i32) -> String {
    let output = mbs(folder, arguments);
    let message = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(code), "`mbs {arguments}` says {message}");
    String::from_utf8(output.stdout).unwrap() + &message
}

/// A table goes into Parquet and back into CSV without a change, with its gaps and their reasons. It has
/// more rows than are compressed together.
#[test]
fn a_table_is_the_same_in_both_forms() {
    let folder = tempfile::tempdir().unwrap();
    let read = |name: &str| fs::read(folder.path().join(name)).unwrap();
    // some runs fail
    ends_with(folder.path(), &format!("sweep {GRID} --out whole.csv"), 3);
    ends_with(folder.path(), &format!("sweep {GRID} --out whole.parquet"), 3);
    ends_with(folder.path(), &format!("sweep {GRID} --shard 1/1 --out share.parquet"), 3);
    ends_with(folder.path(), "merge share.parquet --out back.csv", 0);
    ends_with(folder.path(), "merge share.parquet --out again.parquet", 0);
    assert!(read("back.csv") == read("whole.csv"));
    assert!(read("again.parquet") == read("whole.parquet"));
    let table = String::from_utf8(read("whole.csv")).unwrap();
    assert!(table.lines().filter(|line| line.contains(",,,")).count() > 1000, "gaps");
    assert_eq!(table.lines().count(), 90_001);
    let left = fs::read_dir(folder.path()).unwrap().count();
    assert_eq!(left, 5, "nothing else is left behind");
}

/// A share that is killed goes on; shares of both forms make one table.
#[test]
fn a_killed_share_goes_on() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let share =
        |number: usize, ending: &str| format!("sweep {GRID} --shard {number}/2 --out {number}.{ending}");
    let part = at("1.parquet.part");
    let rows = || fs::read_to_string(&part).map_or(0, |text| text.lines().count());
    let mut process = Command::new(env!("CARGO_BIN_EXE_mbs"))
        .args(share(1, "parquet").split_whitespace())
        .current_dir(folder.path())
        .stderr(Stdio::null())
        .spawn()
        .unwrap();
    while rows() < 3 && process.try_wait().unwrap().is_none() {
        thread::sleep(Duration::from_millis(2));
    }
    process.kill().unwrap();
    process.wait().unwrap();
    let killed = rows();
    assert!((3..45_000).contains(&killed), "{killed}");
    let said = ends_with(folder.path(), &share(1, "parquet"), 3);
    assert!(said.contains("45000 runs") && said.contains("of them earlier"), "{said}");
    let said = ends_with(folder.path(), &share(1, "parquet"), 0);
    assert!(said.contains("complete already"), "{said}");
    ends_with(folder.path(), &share(2, "csv"), 3);
    ends_with(folder.path(), "merge 2.csv 1.parquet --out all.csv", 0);
    ends_with(folder.path(), &format!("sweep {GRID} --out whole.csv"), 3);
    assert!(fs::read(at("all.csv")).unwrap() == fs::read(at("whole.csv")).unwrap());
}

/// A file of Parquet that is cut or changed is told, by its name.
#[test]
fn damaged_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    ends_with(
        folder.path(),
        "sweep slider-crank --param l1=50mm..80mm:9 --end 10ms --shard 1/1 --out a.parquet",
        0,
    );
    let bytes = fs::read(at("a.parquet")).unwrap();
    for length in (4..bytes.len()).step_by(bytes.len() / 40) {
        fs::write(at("cut.parquet"), &bytes[..length]).unwrap();
        let said = ends_with(folder.path(), "merge cut.parquet --out b.csv", 1);
        assert!(said.contains("cut.parquet") && !said.contains("panicked"), "{said}");
    }
    for place in (4..bytes.len()).step_by(bytes.len() / 40) {
        let mut changed = bytes.clone();
        changed[place] ^= 0x55;
        fs::write(at("changed.parquet"), changed).unwrap();
        let output = mbs(folder.path(), "merge changed.parquet --out c.csv");
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(output.status.success() || message.contains("changed.parquet"), "{message}");
        assert!(!message.contains("panicked"), "at {place}: {message}");
    }
}
