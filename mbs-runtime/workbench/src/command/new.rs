//! `mbs new`: a crate for a mechanism of one's own, ready to run.

use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};

use clap::Args;

use mbs_words::names::KEYWORDS;

use crate::html::filled;
use crate::{Error, say};

/// The files of a new crate and their templates.
const FILES: [(&str, &str); 6] = [
    ("Cargo.toml", include_str!("../../template/Cargo.toml.in")),
    ("README.md", include_str!("../../template/README.md.in")),
    (".gitignore", include_str!("../../template/gitignore.in")),
    ("src/main.rs", include_str!("../../template/main.rs.in")),
    ("src/lib.rs", LIBRARY),
    ("tests/motion.rs", include_str!("../../template/motion.rs.in")),
];

/// The mechanism of a new crate.
const LIBRARY: &str = include_str!("../../template/lib.rs.in");

#[derive(Args)]
#[command(about = "Write a crate for a mechanism of your own, or a declaration, ready to run")]
pub(crate) struct Arguments {
    /// The folder to make; its last part is the crate's name
    #[arg(value_name = "NAME", required_unless_present = "file")]
    path: Option<PathBuf>,
    /// Write a declaration by itself to this file instead, for check, watch and simulate
    #[arg(long, value_name = "FILE.mbs", conflicts_with = "path")]
    file: Option<PathBuf>,
}

impl Arguments {
    pub fn run(&self) -> Result<(), Error> {
        if let Some(path) = &self.file {
            write_declaration(path)?;
            say(format_args!("written: {}", path.display()))?;
            return say(format_args!("next:    mbs watch {}", path.display()));
        }
        let Some(path) = &self.path else { return Ok(()) };
        let name = crate_name(path)?;
        write(path, &name)?;
        say(format_args!("written: {}", path.display()))?;
        say(format_args!("next:    cd {} && cargo run --release", path.display()))
    }
}

/// Crates that the new one needs, or that every program has.
const TAKEN: [&str; 12] = [
    "test",
    "core",
    "std",
    "alloc",
    "proc-macro",
    "mbs-runtime",
    "mbs-workbench",
    "mbs-macro",
    "mbs-codegen",
    "mbs-symbolic",
    "mbs-ensemble",
    "models",
];

/// Folders in which cargo builds.
const FOLDERS: [&str; 4] = ["build", "deps", "examples", "incremental"];

fn crate_name(path: &Path) -> Result<String, Error> {
    let name = path.file_name().and_then(|n| n.to_str()).unwrap_or("").to_owned();
    let reason = if name.is_empty() {
        "a crate needs a name"
    } else if !name.starts_with(|c: char| c.is_ascii_alphabetic()) {
        "the name of a crate begins with a letter"
    } else if !name.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_') {
        "the name of a crate has letters, digits, - and _ only"
    } else if TAKEN.contains(&name.replace('_', "-").as_str()) {
        "a crate of that name exists already"
    } else if FOLDERS.contains(&name.as_str()) {
        "cargo has a folder of that name"
    } else if KEYWORDS.contains(&name.as_str()) {
        "that is a keyword of Rust, which no crate can be called"
    } else {
        return Ok(name);
    };
    Err(Error::Name { name, reason: reason.into() })
}

fn write(folder: &Path, name: &str) -> Result<(), Error> {
    // Never write into a folder that somebody has already.
    if let Some(parent) = folder.parent().filter(|p| !p.as_os_str().is_empty()) {
        fs::create_dir_all(parent).map_err(Error::file("create", parent))?;
    }
    fs::create_dir(folder).map_err(Error::file("create", folder))?;
    for (path, template) in FILES {
        let path = folder.join(path);
        if let Some(parent) = path.parent() {
            fs::create_dir_all(parent).map_err(Error::file("create", parent))?;
        }
        let module = name.replace('-', "_");
        let (runtime, workbench) = (dependency(".."), dependency("."));
        let parts = [("NAME", name), ("MODULE", &module), ("RUNTIME", &runtime), ("WORKBENCH", &workbench)];
        fs::write(&path, filled(template, &parts)).map_err(Error::file("write", &path))?;
    }
    Ok(())
}

/// Writes a declaration by itself, never over a file that somebody has already.
fn write_declaration(path: &Path) -> Result<(), Error> {
    if path.extension().is_none_or(|ending| ending != "mbs") {
        let reason = "a file with a declaration ends in .mbs".into();
        return Err(Error::Name { name: path.display().to_string(), reason });
    }
    let file = fs::OpenOptions::new().write(true).create_new(true).open(path);
    let written = file.and_then(|mut file| file.write_all(declaration().as_bytes()));
    written.map_err(Error::file("create", path))
}

/// The declaration of the new crate: the text between the braces of `mechanism!`.
fn declaration() -> String {
    let lines = LIBRARY.lines().skip_while(|line| *line != "mechanism! {").skip(1);
    let lines = lines.take_while(|line| *line != "}");
    lines.map(|line| line.strip_prefix("    ").unwrap_or(line).to_owned() + "\n").collect()
}

/// Where the new crate finds ours: in the checkout that this program was built
/// from while it is there, else by version.
fn dependency(relative: &str) -> String {
    let version = env!("CARGO_PKG_VERSION");
    let workbench = Path::new(env!("CARGO_MANIFEST_DIR"));
    let root = if relative == ".." { workbench.parent() } else { Some(workbench) };
    match root.filter(|r| r.join("Cargo.toml").is_file()).and_then(Path::to_str) {
        // A literal string, so that backslashes of Windows paths stay.
        Some(path) => format!("{{ version = \"{version}\", path = '{path}' }}"),
        None => format!("\"{version}\""),
    }
}

#[cfg(all(test, feature = "live"))]
#[path = "../../template/lib.rs.in"]
mod template;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_complete_crate_is_written_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("my-rocker");
        write(&path, &crate_name(&path).unwrap()).unwrap();
        for (file, _) in FILES {
            let text = fs::read_to_string(path.join(file)).unwrap();
            assert!(!text.contains("@"), "{file} has an unfilled place");
        }
        let main = fs::read_to_string(path.join("src/main.rs")).unwrap();
        assert!(main.contains("my_rocker::"));
        let again = write(&path, "my-rocker").unwrap_err().to_string();
        assert!(again.contains("cannot create") && again.contains("exists"), "{again}");
    }

    /// It is the text of the crate's mechanism, and not written over another one.
    #[cfg(feature = "live")]
    #[test]
    fn a_declaration_is_written_once() {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("my.mbs");
        write_declaration(&path).unwrap();
        let stepper = mbs_live::Text::read(&path).unwrap().compile().unwrap();
        assert_eq!(stepper.declared_info(), <template::Stepper as mbs_runtime::Mechanism>::INFO);
        let again = write_declaration(&path).unwrap_err().to_string();
        assert!(again.contains("cannot create") && again.contains("exists"), "{again}");
        assert!(write_declaration(Path::new("my.txt")).unwrap_err().to_string().contains("ends in .mbs"));
    }

    #[test]
    fn names_that_are_none() {
        for name in ["7up", "a b", "über", "test", "", "mbs_runtime", "build"] {
            assert!(crate_name(Path::new(name)).is_err(), "{name}");
        }
    }

    /// They wrote crates that cannot be compiled.
    #[test]
    fn keywords_are_no_names() {
        for name in ["fn", "self", "gen", "yield", "type"] {
            let refused = crate_name(Path::new(name)).unwrap_err().to_string();
            assert_eq!(
                refused,
                format!("`{name}` cannot be used: that is a keyword of Rust, which no crate can be called")
            );
        }
        assert_eq!(crate_name(Path::new("fn-key")).unwrap(), "fn-key");
    }
}
