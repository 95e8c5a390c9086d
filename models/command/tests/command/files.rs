//! Files that are left on the disk, whatever happens.

use std::path::PathBuf;
use std::process::{Command, Stdio};
use std::time::Duration;

use super::{mbs, parts, refuses, text};

#[test]
fn files_that_cannot_be_written() {
    refuses("simulate slider-crank --end 10ms --out no/such/out.csv", &["cannot write no/such/out.csv"]);
    refuses("simulate slider-crank --end 10ms --plot out.bmp", &["out.bmp", ".svg or .png"]);
    refuses("simulate slider-crank --end 10ms --sketch out.pdf", &["out.pdf", ".svg or .png"]);
    refuses("new 7up", &["`7up`", "begins with a letter"]);
    refuses("new fn", &["`fn`", "keyword of Rust"]);
    refuses("new self", &["`self`", "keyword of Rust"]);
}

/// A run of hours is not begun for a page that nobody can write, and leaves no table.
#[test]
fn outputs_are_checked_before_the_work() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("folder")).unwrap();
    for (command, place) in [
        ("simulate slider-crank --end 1e5s --out run.csv --report no/such.html", "no/such.html"),
        ("simulate slider-crank --end 1e5s --plot no/such.svg", "no/such.svg"),
        ("sweep pendulum --param length=1m..2m:1000000 --plot no/such.svg", "no/such.svg"),
        ("modes dc-motor --sketch no/such.svg", "no/such.svg"),
        ("equilibrium pendulum --sketch no/such.svg", "no/such.svg"),
        ("simulate pendulum --end 1e5s --out folder", "folder"),
        ("paper --json no/such.json", "no/such.json"),
    ] {
        let output = mbs(folder.path(), command);
        let message = text(output.stderr);
        assert!(!output.status.success() && message.contains(&format!("cannot write {place}")), "{message}");
    }
    assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 1);
}

/// Regression: `--out` with the name of the declaration, of a table or of the data wrote over it.
#[test]
fn what_is_read_is_not_written_over() {
    let folder = tempfile::tempdir().unwrap();
    let block = "Block { dof = 1; param k = 1 [N/m]; input f [N]; body b (y) { mass = 1 [kg]; }
        table pull(y) = from \"pull.csv\" linear outside extend;
        force all on y = f - k*y - pull(y); start { y = 0.5 [m]; } }";
    let files = [
        ("block.mbs", block),
        ("pull.csv", "y [m],pull [N]\n0,0\n1,2\n"),
        ("push.csv", "t [s],f [N]\n0,0\n1,2\n"),
        ("motion.csv", "t [s],y [m]\n0,0\n0.5,0.1\n1,0.3\n"),
    ];
    for (name, text) in files {
        std::fs::write(folder.path().join(name), text).unwrap();
    }
    for (command, file) in [
        ("simulate block.mbs --out block.mbs", "block.mbs"),
        ("simulate block.mbs --json --out ./block.mbs", "block.mbs"),
        ("simulate block.mbs --out pull.csv", "pull.csv"),
        ("simulate block.mbs --input f=@push.csv --out push.csv", "push.csv"),
        ("sweep block.mbs --param k=1..2:2 --out block.mbs", "block.mbs"),
        ("inverse block.mbs --motion motion.csv --out motion.csv", "motion.csv"),
        ("fit block.mbs --data motion.csv --param k --out motion.csv", "motion.csv"),
        ("bode block.mbs --out block.mbs", "block.mbs"),
        ("export page block.mbs --out block.mbs", "block.mbs"),
    ] {
        let output = mbs(folder.path(), command);
        let message = text(output.stderr);
        assert!(message.contains(file) && message.contains("it is read here"), "{command}: {message}");
    }
    for (name, text) in files {
        assert_eq!(std::fs::read_to_string(folder.path().join(name)).unwrap(), text);
    }
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

/// Regression: `watch` went on until its run was made, `sweep` for a thousand steps, `fit` to the end of a run.
#[cfg(unix)]
#[test]
fn an_interrupt_ends_what_keeps_nothing_at_once() {
    use std::os::unix::process::ExitStatusExt;
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("swing.mbs"), SWING).unwrap();
    std::fs::write(folder.path().join("swing.csv"), "t [s],phi [rad]\n0,0.1\n600,0.05\n1200,0.02\n1900,0\n")
        .unwrap();
    for arguments in [
        "watch swing.mbs --end 1000000000s",
        "simulate swing.mbs --end 100000s --every 1000000 --out run.csv",
        "sweep swing.mbs --param l=1m..2m:3 --end 1000000000s",
        "sweep pendulum --param length=1m..2m:3 --end 1000000000s",
        "fit swing.mbs --data swing.csv --param l",
        "inverse swing.mbs --move phi=0deg..90deg --over 1s --samples 1000000 --out inverse.csv",
        "travel swing.mbs --along phi=0deg..90deg --samples 1000000 --out travel.csv",
    ] {
        let mut command = Command::new(env!("CARGO_BIN_EXE_mbs"));
        let command = command.args(arguments.split_whitespace()).current_dir(folder.path());
        let mut running = command.stdout(Stdio::null()).stderr(Stdio::null()).spawn().unwrap();
        std::thread::sleep(Duration::from_millis(300));
        assert!(running.try_wait().unwrap().is_none(), "`{arguments}` ended by itself");
        let interrupt = format!("kill -INT {}", running.id());
        assert!(Command::new("sh").args(["-c", &interrupt]).status().unwrap().success());
        let ended = (0..3000).find_map(|_| {
            std::thread::sleep(Duration::from_millis(10));
            running.try_wait().unwrap()
        });
        if ended.is_none() {
            running.kill().unwrap();
        }
        let ended = ended.map(|status| (status.code(), status.signal()));
        assert!(matches!(ended, Some((Some(130), _) | (_, Some(2)))), "`{arguments}`: {ended:?}");
    }
}

#[cfg(unix)]
const SWING: &str = "Swing {
    dof = 1;
    param l = 1 [m];
    gravity = (0, -9.81) [m/s^2];
    body rod (x, y, phi) { mass = 1 [kg]; inertia = 1 [kg*m^2]; }
    point end on rod = (l, 0);
    revolute pivot (rod.end, ground);
    start { phi = 0.1 [rad]; }
}
";

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
    let full = shell("mbs equilibrium pendulum > /dev/full");
    assert_eq!(full.status.code(), Some(1));
    assert!(text(full.stderr).contains("error: cannot write to standard output: No space left"));
    assert!(!shell("mbs equilibrium --help > /dev/full").status.success());
    // The reader of a pipe may go: 128 + SIGPIPE, and not a word.
    let closed = shell("mbs equilibrium pendulum | true; exit ${PIPESTATUS[0]}");
    let early = shell("(sleep 0.5; mbs equilibrium pendulum) | true; exit ${PIPESTATUS[0]}");
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
