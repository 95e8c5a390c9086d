//! Writes the page of the editor: the compiler of mechanisms as WebAssembly, the library as examples.

use std::error::Error;
use std::path::{Path, PathBuf};
use std::process::{self, ExitCode};
use std::{env, fs};

use clap::{Arg, Command, value_parser};
use mbs_workbench::html::{escaped_json, filled};
use mbs_workbench::number::significant;
use mbs_workbench::{Settings, Sources, packed, source_hash};
use serde_json::{Value, json};

const PAGE: &str = include_str!("page/editor.html");
const STYLE: &str = include_str!("page/editor.css");
const WORKER: &str = include_str!("page/worker.js");
const SCRIPTS: [&str; 3] =
    [include_str!("page/compiler.js"), include_str!("page/text.js"), include_str!("page/editor.js")];

/// The handler of errors in the page's script: it shows that this browser cannot run the page.
const FAILED: &str = "(error) => {
  document.getElementById(\"state\").textContent = `This browser cannot run the editor: ${error.message}`;
  throw error;
}";

/// The target of the compiler, and its stack: the compiler descends into groups and formulas by recursion.
const TARGET: &str = "wasm32-wasip1";
const STACK: u32 = 16 << 20;

fn main() -> ExitCode {
    let out = Arg::new("out").long("out").value_name("FILE.html").required(true).help("The file to write");
    let command = Command::new("editor")
        .about("Write the editor of mechanisms as one HTML file, which works offline")
        .arg(out.value_parser(value_parser!(PathBuf)));
    let matches = command.get_matches();
    let out = matches.get_one::<PathBuf>("out").cloned().unwrap_or_default();
    match write(&out) {
        Ok(()) => {
            println!("written: {}", out.display());
            ExitCode::SUCCESS
        }
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn write(out: &Path) -> Result<(), Box<dyn Error>> {
    let page = page(&compiler()?)?;
    fs::write(out, page).map_err(|error| format!("cannot write {}: {error}", out.display()).into())
}

/// The compiler of mechanisms as WebAssembly, made by cargo where it is not there as it should be.
fn compiler() -> Result<Vec<u8>, Box<dyn Error>> {
    let package = Path::new(env!("CARGO_MANIFEST_DIR"));
    // apart from other builds, which have other profiles
    let folder = env::var_os("CARGO_TARGET_DIR").map_or_else(|| package.join("../../target"), PathBuf::from);
    let folder = folder.join("editor");
    let stack = format!("target.{TARGET}.rustflags=[\"-C\", \"link-arg=-zstack-size={STACK}\"]");
    let ended = process::Command::new(env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
        .current_dir(package)
        .args(["build", "--profile", "editor", "--bin", "compiler", "--target", TARGET, "--config", &stack])
        .arg("--target-dir")
        .arg(&folder)
        .status()
        .map_err(|error| format!("cargo cannot be run: {error}"))?;
    if !ended.success() {
        let help = format!("if the target is missing, `rustup target add {TARGET}` installs it");
        return Err(format!("the compiler cannot be built for {TARGET}; {help}").into());
    }
    let module = folder.join(TARGET).join("editor/compiler.wasm");
    fs::read(&module).map_err(|error| format!("cannot read {}: {error}", module.display()).into())
}

/// The page, whose policy of content allows its own script and style, and those of the pages of mechanisms.
fn page(compiler: &[u8]) -> Result<String, Box<dyn Error>> {
    let script = format!("(async () => {{\n{}\n}})().catch({FAILED});", SCRIPTS.join("\n"));
    let pages = mbs_live::RUN_SCRIPTS.map(Sources::of_pages);
    let scripts = pages.each_ref().map(|page| source_hash(&page.script)).join(" ");
    let policy = format!(
        "default-src 'none'; script-src {} {scripts} 'wasm-unsafe-eval'; style-src {} {}; worker-src blob:",
        source_hash(&script),
        source_hash(STYLE),
        source_hash(&pages[0].style)
    );
    let parts = [
        ("POLICY", policy),
        ("STYLE", STYLE.to_owned()),
        ("LIBRARY", escaped_json(&library()?)),
        ("KEYWORDS", escaped_json(&keywords())),
        ("COMPILER", escaped_json(&Value::String(packed(compiler)?))),
        ("WORKER", WORKER.to_owned()),
        ("SCRIPT", script),
    ];
    Ok(filled(PAGE, &parts.each_ref().map(|(name, part)| (*name, part.as_str()))))
}

/// The mechanisms of the library, with times where they have their own.
fn library() -> Result<Value, mbs_live::Error> {
    let usual = Settings::default();
    let time = |own: f64, usual: f64| {
        if own == usual { String::new() } else { format!("{} ms", significant(1e3 * own, 6)) }
    };
    let entry = |entry: &mbs::Entry| {
        let own = entry.defaults();
        let (step, end) = (time(own.step, usual.step), time(own.end, usual.end));
        Ok(json!({ "name": entry.name, "text": entry.text().written()?, "step": step, "end": end }))
    };
    mbs::library().iter().map(entry).collect()
}

/// The words that begin statements, to be coloured and explained.
fn keywords() -> Value {
    mbs_codegen::keywords()
        .into_iter()
        .map(|keyword| json!({ "word": keyword.word, "form": keyword.form, "meaning": keyword.meaning }))
        .collect()
}
