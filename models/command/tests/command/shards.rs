//! Sweeps in shares: processes that are killed, the same commands again, and one table.

use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

use super::{mbs, parts};

const GRID: &str = "slider-crank --param l1=50mm..80mm:100 --param omega=100rpm..300rpm:400 --end 0.2s";

fn begun(folder: &Path, number: usize) -> Child {
    let line = format!("sweep {GRID} --shard {number}/4 --out part-{number}.csv");
    let mut command = Command::new(env!("CARGO_BIN_EXE_mbs"));
    command.args(line.split_whitespace()).current_dir(folder).stdout(Stdio::null()).stderr(Stdio::null());
    command.spawn().unwrap()
}

fn rows(path: &Path) -> usize {
    fs::read_to_string(path).map_or(0, |text| text.lines().count())
}

fn said(folder: &Path, arguments: &str) -> String {
    let output = mbs(folder, arguments);
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    String::from_utf8(output.stdout).unwrap()
}

/// Of four shares three are killed on their way, two of them twice; the shares then are the table of one run, to
/// the byte.
#[test]
fn killed_shares_go_on_and_are_the_whole() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    for number in [1, 3, 4, 1, 3] {
        let part = at(&format!("part-{number}.csv.part"));
        let before = rows(&part);
        let mut process = begun(folder.path(), number);
        while rows(&part) <= before.max(2) && process.try_wait().unwrap().is_none() {
            thread::sleep(Duration::from_millis(5));
        }
        process.kill().unwrap();
        process.wait().unwrap();
    }
    // two lines of heading, and not all of 10,000 rows
    let kept = rows(&at("part-4.csv.part"));
    assert!((3..10_000).contains(&kept), "{kept}");
    for number in 1..=4 {
        let report = said(folder.path(), &format!("sweep {GRID} --shard {number}/4 --out part-{number}.csv"));
        assert!(report.contains("10000 runs"), "{report}");
        assert_eq!(report.contains("of them earlier"), number != 2, "{report}");
    }
    assert!(parts(folder.path()).is_empty());
    // nothing is done again
    let stamp = fs::metadata(at("part-2.csv")).unwrap().modified().unwrap();
    let again = said(folder.path(), &format!("sweep {GRID} --shard 2/4 --out part-2.csv"));
    assert!(again.contains("complete already"), "{again}");
    assert_eq!(fs::metadata(at("part-2.csv")).unwrap().modified().unwrap(), stamp);
    let merged = "merge part-3.csv part-1.csv part-4.csv part-2.csv --out all.csv";
    assert!(said(folder.path(), merged).contains("40000 runs"));
    said(folder.path(), &format!("sweep {GRID} --out whole.csv"));
    assert!(fs::read(at("all.csv")).unwrap() == fs::read(at("whole.csv")).unwrap());
}

#[test]
fn shares_that_do_not_belong_together_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let at = |name: &str| folder.path().join(name);
    let share = |options: &str, shard: &str, out: &str| {
        said(
            folder.path(),
            &format!(
                "sweep slider-crank --param l1=50mm..80mm:9 --end 10ms {options} --shard {shard} --out {out}"
            ),
        )
    };
    share("", "1/2", "a.csv");
    share("", "2/2", "b.csv");
    share("--set m3=1", "2/2", "other.csv");
    share("", "2/3", "third.csv");
    let refused = |arguments: &str, part: &str| {
        let output = mbs(folder.path(), arguments);
        let message = String::from_utf8(output.stderr).unwrap();
        assert!(!output.status.success() && message.contains(part), "{arguments}: {message}");
    };
    refused("merge a.csv --out all.csv", "missing: 2/2");
    // Regression: the table took the place of the share.
    refused("merge a.csv b.csv --out a.csv", "it is one of the shares");
    refused("merge a.csv b.csv a.csv --out all.csv", "the same share");
    refused("merge a.csv other.csv --out all.csv", "another sweep");
    refused("merge a.csv third.csv --out all.csv", "another sweep");
    fs::write(at("table.csv"), "l1 [mm]\n50\n").unwrap();
    refused("merge a.csv table.csv --out all.csv", "not a share");
    let text = fs::read_to_string(at("b.csv")).unwrap();
    let cut = text.trim_end().rsplit_once('\n').unwrap().0;
    fs::write(at("cut.csv"), format!("{cut}\n")).unwrap();
    refused("merge a.csv cut.csv --out all.csv", "4 of its 5 runs");
    // Regression: a share that was cut inside its last row was merged, and was "complete already".
    let half = &text[..text.len() - 9];
    fs::write(at("cut.csv"), half).unwrap();
    refused("merge a.csv cut.csv --out all.csv", "`cut.csv` cannot be used: row 5: it is cut");
    fs::write(at("cut.csv"), text.replacen("\n80.0,", "\n81.0,", 1)).unwrap();
    refused("merge a.csv cut.csv --out all.csv", "row 5: `l1` is `81.0`, where the sweep has 80.0");
    assert!(!at("all.csv").exists());
    fs::write(at("b.csv"), half).unwrap();
    assert!(share("", "2/2", "b.csv").contains("5 runs, 4 of them earlier"));
    assert_eq!(fs::read_to_string(at("b.csv")).unwrap(), text);
    let line = "sweep slider-crank --param l1=50mm..80mm:9 --end 10ms";
    refused(&format!("{line} --shard 2/2 --out table.csv"), "not this share");
    refused(&format!("{line} --shard 3/2 --out c.csv"), "K/N");
    refused(&format!("{line} --shard 1/2"), "--out");
    for command in [&format!("{line} --shard 1/2"), &line.to_owned(), &"merge a.csv b.csv".to_owned()] {
        refused(&format!("{command} --out a.parquet"), "tables are written as CSV");
    }
    said(folder.path(), "merge b.csv a.csv --out all.csv");
}
