//! Binaries of functional mock-up units, compiled by the C compilers of this machine.

use std::path::Path;
use std::process::{Command, Stdio};

use mbs_live::FmiVersion;

use super::Fmu;
use crate::Error;

/// A platform that a binary is for.
struct Platform {
    /// For people.
    name: &'static str,
    /// True if this program runs on it, so that the compiler of the machine compiles for it.
    is_here: bool,
    /// Compilers of other machines that compile for it.
    cross: &'static [&'static str],
    /// The folders of its binaries, of FMI 2.0 if it names one, and of FMI 3.0.
    folders: (Option<&'static str>, &'static str),
    ending: &'static str,
    flags: &'static [&'static str],
}

const fn is(os: &str, arch: &str) -> bool {
    is_equal(std::env::consts::OS, os) && is_equal(std::env::consts::ARCH, arch)
}

const fn is_equal(a: &str, b: &str) -> bool {
    let (a, b) = (a.as_bytes(), b.as_bytes());
    let mut at = 0;
    while at < a.len() && at < b.len() {
        if a[at] != b[at] {
            return false;
        }
        at += 1;
    }
    a.len() == b.len()
}

const UNIX: &[&str] = &["-fPIC", "-fvisibility=hidden"];

const PLATFORMS: [Platform; 5] = [
    Platform {
        name: "Linux on x86-64",
        is_here: is("linux", "x86_64"),
        cross: &["x86_64-linux-gnu-gcc"],
        folders: (Some("linux64"), "x86_64-linux"),
        ending: ".so",
        flags: UNIX,
    },
    Platform {
        name: "Linux on 64-bit ARM",
        is_here: is("linux", "aarch64"),
        cross: &["aarch64-linux-gnu-gcc"],
        folders: (None, "aarch64-linux"),
        ending: ".so",
        flags: UNIX,
    },
    Platform {
        name: "Windows on x86-64",
        is_here: is("windows", "x86_64"),
        cross: &["x86_64-w64-mingw32-gcc"],
        folders: (Some("win64"), "x86_64-windows"),
        ending: ".dll",
        flags: &["-static-libgcc"],
    },
    Platform {
        name: "macOS on x86-64",
        is_here: is("macos", "x86_64"),
        cross: &[],
        folders: (Some("darwin64"), "x86_64-darwin"),
        ending: ".dylib",
        flags: UNIX,
    },
    Platform {
        name: "macOS on 64-bit ARM",
        is_here: is("macos", "aarch64"),
        cross: &[],
        folders: (None, "aarch64-darwin"),
        ending: ".dylib",
        flags: UNIX,
    },
];

/// Products and sums stay apart, so that the bits are those of other runs.
const FLAGS: [&str; 4] = ["-std=c99", "-O2", "-ffp-contract=off", "-shared"];

/// A shared library with the functions of the standard.
#[derive(Clone)]
pub struct Binary {
    platform: &'static Platform,
    pub(super) bytes: Vec<u8>,
}

impl std::fmt::Debug for Binary {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Binary for {}, {} bytes", self.platform.name, self.bytes.len())
    }
}

impl Binary {
    /// The platform, for people: `Linux on x86-64`.
    pub fn platform(&self) -> &'static str {
        self.platform.name
    }

    /// Its folder in an archive, if the version of the standard names one.
    pub(super) fn folder(&self, version: FmiVersion) -> Option<&'static str> {
        match version {
            FmiVersion::V2 => self.platform.folders.0,
            FmiVersion::V3 => Some(self.platform.folders.1),
        }
    }

    pub(super) fn ending(&self) -> &'static str {
        self.platform.ending
    }
}

/// Compiles an FMU for this machine, by the compiler that the variable `CC` names, or by `cc`,
/// `gcc` or `clang`, and for every other platform that a cross compiler is installed for. There is
/// none of a platform without a compiler.
///
/// # Errors
/// [`Error::Compiler`] with what a compiler says; [`Error::File`] of the folder where it works.
pub fn binaries(fmu: &Fmu) -> Result<Vec<Binary>, Error> {
    let folder = tempfile::tempdir().map_err(Error::file("create", &std::env::temp_dir()))?;
    for (name, text) in fmu.sources() {
        let path = folder.path().join(name);
        std::fs::write(&path, text).map_err(Error::file("write", &path))?;
    }
    let code: Vec<&str> = fmu.sources().map(|(name, _)| name).filter(|name| name.ends_with(".c")).collect();
    let mut binaries = Vec::new();
    for platform in &PLATFORMS {
        if let Some(compiler) = compiler(platform) {
            binaries.push(binary(platform, &compiler, folder.path(), &code)?);
        }
    }
    Ok(binaries)
}

/// The first compiler for a platform that is there. One that was named is taken as it is.
fn compiler(platform: &Platform) -> Option<String> {
    let named = std::env::var("CC").ok().filter(|named| platform.is_here && !named.is_empty());
    let here: &[&str] = if platform.is_here { &["cc", "gcc", "clang"] } else { &[] };
    let others = here.iter().chain(platform.cross).map(|name| (*name).to_owned());
    named.or_else(|| others.into_iter().find(|name| is_there(name)))
}

fn is_there(compiler: &str) -> bool {
    let mut command = Command::new(compiler);
    command.arg("--version").stdin(Stdio::null()).stdout(Stdio::null()).stderr(Stdio::null());
    command.status().is_ok_and(|status| status.success())
}

fn binary(
    platform: &'static Platform,
    compiler: &str,
    folder: &Path,
    code: &[&str],
) -> Result<Binary, Error> {
    let failed = |reason: String| Error::Compiler { compiler: compiler.to_owned(), reason };
    let name = format!("binary{}", platform.ending);
    let mut command = Command::new(compiler);
    command.args(FLAGS).args(platform.flags).args(code).args(["-o", &name, "-lm"]).current_dir(folder);
    let output = command.stdin(Stdio::null()).output().map_err(|error| failed(error.to_string()))?;
    if !output.status.success() {
        return Err(failed(String::from_utf8_lossy(&output.stderr).trim().to_owned()));
    }
    let path = folder.join(name);
    let bytes = std::fs::read(&path).map_err(Error::file("read", &path))?;
    Ok(Binary { platform, bytes })
}
