//! Crates with one chain each, compiled by cargo as a user does it.

use std::error::Error;
use std::fs;
use std::path::Path;
use std::process::Command;
use std::time::Instant;

use crate::Chain;

const MANIFEST: &str = r#"[package]
name = "chain"
version = "0.0.0"
edition = "2024"

[dependencies]
mbs-runtime = { path = "RUNTIME" }

[workspace]
"#;

/// The manifest that `mbs new` writes.
const TEMPLATE: &str = include_str!("../../../mbs-runtime/workbench/template/Cargo.toml.in");

const MAIN: &str = r#"//! A chain that falls.

mbs_runtime::mechanism! { DECLARATION }

fn main() -> Result<(), mbs_runtime::Error> {
    let mut chain = mbs_runtime::Simulation::new(Chain::<f64>::declared(), 1e-4)?;
    chain.advance_to(1e-3)?;
    println!("{:?}", chain.state().q);
    Ok(())
}
"#;

/// Prints seconds and the memory of the largest process of `cargo build --release`,
/// what the crate depends on being compiled already: by cargo's defaults, with which the
/// compiler of mechanisms itself is not optimised, and with that optimised.
pub fn print<'a>(chains: impl Iterator<Item = &'a Chain> + Clone) -> Result<(), Box<dyn Error>> {
    let folder = tempfile::tempdir()?;
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let runtime = root.join("mbs-runtime").canonicalize()?;
    fs::create_dir(folder.path().join("src"))?;
    let manifest = MANIFEST.replace("RUNTIME", &runtime.to_string_lossy());
    // the versions of this workspace, so that nothing has to be fetched
    fs::copy(root.join("Cargo.lock"), folder.path().join("Cargo.lock"))?;
    let main = folder.path().join("src/main.rs");
    let (_, profile) =
        TEMPLATE.split_once("[profile.release.package]").ok_or("no profile in the template")?;
    let (levels, _) = profile.split_once("\n\n").ok_or("no end of the profile in the template")?;
    let optimised = format!("\n[profile.release.package]{levels}\n");
    for (what, profile) in [("cargo's defaults", ""), ("macro optimised", &*optimised)] {
        fs::write(folder.path().join("Cargo.toml"), format!("{manifest}{profile}"))?;
        fs::write(&main, "fn main() {}")?;
        let (seconds, _) = build(folder.path())?;
        println!("\ncargo build --release, {what}: {seconds:.0} s for what it depends on, then");
        println!("{:14} {:>8} {:>12}", "", "s", "peak MB");
        for chain in chains.clone() {
            fs::write(&main, MAIN.replace("DECLARATION", chain.text))?;
            let (seconds, memory) = build(folder.path())?;
            let memory = memory.map_or("not measured".into(), |kilobytes| (kilobytes / 1000).to_string());
            println!("{:14} {seconds:8.1} {memory:>12}", format!("{} {}", chain.name, chain.n));
        }
    }
    Ok(())
}

/// Seconds, and kilobytes of the largest process if `/usr/bin/time` is there.
fn build(folder: &Path) -> Result<(f64, Option<u64>), Box<dyn Error>> {
    const TIME: &str = "/usr/bin/time";
    let is_measured = Path::new(TIME).exists();
    let cargo = env!("CARGO");
    let mut command = if is_measured { Command::new(TIME) } else { Command::new(cargo) };
    if is_measured {
        command.args(["-f", "peak %M", cargo]);
    }
    command.args(["build", "--release", "--offline"]);
    // the crate's own folder for all that is compiled
    command.current_dir(folder).env_remove("CARGO_TARGET_DIR").env_remove("CARGO_BUILD_TARGET_DIR");
    let start = Instant::now();
    let output = command.output()?;
    let seconds = start.elapsed().as_secs_f64();
    let messages = String::from_utf8_lossy(&output.stderr);
    if !output.status.success() {
        return Err(messages.into());
    }
    let peak = messages.lines().rev().find_map(|line| line.strip_prefix("peak ")?.trim().parse().ok());
    Ok((seconds, peak))
}
