//! Instructions per step under callgrind, compared with recorded ones: they do
//! not depend on the load of the machine, so a few per cent are a change.

use std::collections::BTreeMap;
use std::path::Path;
use std::process::Command;
use std::{env, fs, io};

use crate::kernels::{Kernel, Method};

/// Other versions of rustc order instructions differently, other versions and
/// variants of the C library have other sines.
const TOLERANCE: f64 = 0.10;

/// The first argument of a process that runs one kernel under callgrind.
pub const RUN: &str = "--run-kernel";

const FEW: u32 = 200;
const MANY: u32 = 1200;

/// Runs a kernel in a child process: its name and steps follow [`RUN`].
pub fn run_child(arguments: &[String]) -> bool {
    let [name, steps] = arguments else { return false };
    let (Some(kernel), Ok(steps)) = (Kernel::all().into_iter().find(|k| k.name() == *name), steps.parse())
    else {
        return false;
    };
    std::hint::black_box(kernel.run(steps));
    true
}

/// Prints the counts; `false` if one has left its recorded value.
/// BLESS=1 records them anew.
pub fn check() -> bool {
    if !has_valgrind() {
        println!("instruction counts: skipped, valgrind is not installed");
        return true;
    }
    let compiled = Kernel::all().into_iter().filter(|kernel| kernel.method != Method::Dense);
    let counts: Result<BTreeMap<String, u64>, String> =
        compiled.map(|kernel| Ok((kernel.name(), count(&kernel)?))).collect();
    let counts = match counts {
        Ok(counts) => counts,
        Err(message) => {
            println!("instruction counts: skipped, {message}");
            return true;
        }
    };
    compare(&counts)
}

fn has_valgrind() -> bool {
    Command::new("valgrind").arg("--version").output().is_ok_and(|output| output.status.success())
}

/// Two runs of different length: what start-up costs drops out.
fn count(kernel: &Kernel) -> Result<u64, String> {
    Ok((collected(kernel, MANY)? - collected(kernel, FEW)?) / u64::from(MANY - FEW))
}

fn collected(kernel: &Kernel, steps: u32) -> Result<u64, String> {
    let program = env::current_exe().map_err(|error| error.to_string())?;
    let output = Command::new("valgrind")
        .args(["--tool=callgrind", "--callgrind-out-file=/dev/null"])
        .arg(program)
        .args([RUN, &kernel.name(), &steps.to_string()])
        .output()
        .map_err(|error| error.to_string())?;
    let log = String::from_utf8_lossy(&output.stderr);
    let collected = log.lines().find_map(|line| line.split_once("Collected : "));
    collected
        .filter(|_| output.status.success())
        .and_then(|(_, number)| number.trim().parse().ok())
        .ok_or_else(|| {
            let instructions = "is it built for instructions that valgrind does not know?";
            format!("callgrind could not run {}; {instructions}", kernel.name())
        })
}

fn compare(counts: &BTreeMap<String, u64>) -> bool {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/step/instructions.txt");
    if env::var_os("BLESS").is_some_and(|bless| bless == "1") {
        return match record(&path, counts) {
            Ok(()) => true,
            Err(error) => {
                println!("{}: {error}", path.display());
                false
            }
        };
    }
    let recorded = fs::read_to_string(&path).unwrap_or_default();
    let recorded: BTreeMap<&str, u64> = recorded
        .lines()
        .filter_map(|line| line.split_once(": ").and_then(|(name, count)| Some((name, count.parse().ok()?))))
        .collect();
    println!("instructions per Heun step (callgrind), recorded ones in brackets");
    let mut is_good = true;
    for (name, count) in counts {
        let verdict = match recorded.get(name.as_str()) {
            Some(&expected) if (*count as f64 / expected as f64 - 1.0).abs() <= TOLERANCE => {
                format!("[{expected}]")
            }
            Some(&expected) => {
                is_good = false;
                format!("[{expected}] CHANGED by more than {:.0} %", 100.0 * TOLERANCE)
            }
            None => {
                is_good = false;
                "NOT RECORDED".to_owned()
            }
        };
        println!("{name:44} {count:6} {verdict}");
    }
    if !is_good {
        println!("look at the change; if it is right, record it with BLESS=1");
    }
    is_good
}

fn record(path: &Path, counts: &BTreeMap<String, u64>) -> io::Result<()> {
    let lines: Vec<String> = counts.iter().map(|(name, count)| format!("{name}: {count}\n")).collect();
    println!("{}", lines.concat());
    fs::write(path, lines.concat())
}
