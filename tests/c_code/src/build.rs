//! C compilers, and the programs that they make.

use std::fmt;
use std::io::{self, Write};
use std::process::{Command, Stdio};

use mbs_codegen::targets::CSources;
use tempfile::TempDir;

/// Flags with which the printed code compiles without a warning.
pub const WARNINGS: [&str; 7] =
    ["-std=c99", "-Wall", "-Wextra", "-Wconversion", "-Wdouble-promotion", "-Werror", "-pedantic"];

/// Why there is no result.
#[derive(Debug)]
pub enum Fault {
    /// A file or a process.
    Io(io::Error),
    /// Messages of a compiler.
    Compiler(String),
    /// The output of a program in the place of numbers.
    Program(String),
}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Io(error) => write!(f, "{error}"),
            Self::Compiler(text) | Self::Program(text) => f.write_str(text),
        }
    }
}

impl std::error::Error for Fault {}

impl From<io::Error> for Fault {
    fn from(error: io::Error) -> Self {
        Self::Io(error)
    }
}

/// Those of gcc and clang that are on this machine; where there is none, a test says so.
pub fn compilers() -> Vec<&'static str> {
    ["gcc", "clang"].into_iter().filter(|compiler| is_there(compiler)).collect()
}

/// True if a compiler is on this machine; a test says where it is not.
pub fn is_there(compiler: &str) -> bool {
    let version = Command::new(compiler).arg("--version").stdout(Stdio::null()).status();
    let is_there = version.is_ok_and(|status| status.success());
    if !is_there {
        eprintln!("skipped: `{compiler}` is not on this machine");
    }
    is_there
}

/// Compiles source and example without a warning.
///
/// # Errors
/// [`Fault::Compiler`] with its warnings.
pub fn compile(sources: &CSources, compiler: &str, flags: &[&str]) -> Result<(), Fault> {
    let folder = TempDir::new()?;
    for file in sources.files() {
        std::fs::write(folder.path().join(&file.name), &file.text)?;
    }
    let mut command = Command::new(compiler);
    command.args(WARNINGS).args(flags).args(["-c", &sources.source.name, &sources.example.name]);
    run_compiler(command.current_dir(&folder))
}

fn run_compiler(command: &mut Command) -> Result<(), Fault> {
    let result = command.output()?;
    if result.status.success() {
        return Ok(());
    }
    Err(Fault::Compiler(String::from_utf8_lossy(&result.stderr).into_owned()))
}

/// A program that runs a mechanism.
#[derive(Debug)]
pub struct Built {
    folder: TempDir,
}

/// How a mechanism is run.
#[derive(Clone, Debug, PartialEq)]
pub struct Choice<'a> {
    /// The step in s.
    pub step: f64,
    /// How many steps.
    pub steps: usize,
    /// One line is given in so many steps, and one at the start.
    pub every: usize,
    /// α, β in 1/s, and whether they are held over a step; the deadbeat gains of the step, held,
    /// for `None`.
    pub feedback: Option<(f64, f64, bool)>,
    /// The inputs.
    pub inputs: &'a [f64],
    /// t, q and v to start from; the declared start for `None`.
    pub start: Option<&'a [f64]>,
}

/// Builds a program in which products and sums stay apart, so that its bits are those of others.
///
/// # Errors
/// [`Fault::Compiler`] with its errors.
pub fn build(sources: &CSources, compiler: &str, optimization: &str) -> Result<Built, Fault> {
    build_around(sources, include_str!("probe.c"), compiler, optimization)
}

/// The same with a program of one's own around the mechanism, in which `NAME` and `CAPS` stand for
/// what its names begin with.
///
/// # Errors
/// [`Fault::Compiler`] with its errors.
pub fn build_around(
    sources: &CSources,
    main: &str,
    compiler: &str,
    optimization: &str,
) -> Result<Built, Fault> {
    let folder = TempDir::new()?;
    for file in [&sources.header, &sources.source] {
        std::fs::write(folder.path().join(&file.name), &file.text)?;
    }
    let main = main.replace("NAME", &sources.prefix).replace("CAPS", &sources.prefix.to_uppercase());
    std::fs::write(folder.path().join("probe.c"), main)?;
    let mut command = Command::new(compiler);
    command.args(["-std=c99", optimization, "-ffp-contract=off"]);
    command.args([&sources.source.name, "probe.c", "-lm", "-o", "probe"]);
    run_compiler(command.current_dir(&folder))?;
    Ok(Built { folder })
}

impl Built {
    /// Runs the program without any input, and returns what it prints.
    ///
    /// # Errors
    /// [`Fault::Program`] with what it says if it fails.
    pub fn output(&self) -> Result<String, Fault> {
        let result = Command::new(self.folder.path().join("probe")).output()?;
        if result.status.success() {
            return Ok(String::from_utf8_lossy(&result.stdout).into_owned());
        }
        Err(Fault::Program(String::from_utf8_lossy(&result.stderr).into_owned()))
    }

    /// Runs the mechanism: a line each for the start and for every so-manieth state, of t, q, v, q̈,
    /// λ and the outputs.
    ///
    /// # Errors
    /// [`Fault::Program`] with the error that ended the run.
    pub fn run(&self, choice: &Choice<'_>) -> Result<Vec<Vec<f64>>, Fault> {
        let Choice { step, steps, every, feedback, inputs, start } = choice;
        let (alpha, beta, is_held) = match feedback {
            Some((alpha, beta, is_held)) => (*alpha, *beta, i32::from(*is_held)),
            None => (0.0, 0.0, -1),
        };
        let mut given = format!("{step:?} {steps} {every} {alpha:?} {beta:?} {is_held}");
        let numbers = |numbers: &[f64]| numbers.iter().map(|x| format!(" {x:?}")).collect::<String>();
        given += &numbers(inputs);
        given += if start.is_some() { " 1" } else { " 0" };
        given += &start.map_or_else(String::new, numbers);
        let mut process = Command::new(self.folder.path().join("probe"))
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .spawn()?;
        if let Some(mut input) = process.stdin.take() {
            input.write_all(given.as_bytes())?;
        }
        let result = process.wait_with_output()?;
        let text = String::from_utf8_lossy(&result.stdout).into_owned();
        let bits = |word: &str| u64::from_str_radix(word, 16).map(f64::from_bits);
        let line = |line: &str| line.split_whitespace().map(bits).collect::<Result<Vec<f64>, _>>();
        let lines: Result<Vec<_>, _> = text.lines().map(line).collect();
        lines.map_err(|_| Fault::Program(text.lines().last().unwrap_or_default().to_owned()))
    }
}
