//! The library in programs of C and C++: warnings, sanitizers, valgrind, digits, and what the README shows.
#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

mod support;

use std::ffi::OsStr;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use mbs_live::{Run, Text};
use mbs_runtime::System;
use support::{LIBRARY, file, rust_bits};
use tempfile::TempDir;

const README: &str = include_str!("../README.md");
const PROGRAM: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/c/program.c");
const INCLUDE: &str = concat!("-I", env!("CARGO_MANIFEST_DIR"), "/include");
const WARNINGS: [&str; 4] = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"];
const SANITIZERS: [&str; 2] = ["-fsanitize=address,undefined", "-fno-sanitize-recover=all"];

/// Compilers of C and C++, with the language that they are told to read.
const COMPILERS: [(&str, &str); 4] =
    [("gcc", "-std=c99"), ("clang", "-std=c99"), ("g++", "-std=c++17"), ("clang++", "-std=c++17")];

/// The step and the steps of every run.
const STEP: f64 = 1e-4;
const STEPS: u64 = 300;

/// True if a tool is on this machine; a test says where it is not.
fn is_there(tool: &str) -> bool {
    let version = Command::new(tool).arg("--version").stdout(Stdio::null()).stderr(Stdio::null()).status();
    let is_there = cfg!(target_os = "linux") && version.is_ok_and(|status| status.success());
    if !is_there {
        eprintln!("skipped: `{tool}` is not on this machine");
    }
    is_there
}

/// Where cargo put the libraries that it made for this test.
fn libraries() -> PathBuf {
    let test = std::env::current_exe().expect("a test");
    test.parent().expect("a folder").to_owned()
}

/// Runs a command that has to succeed; returns the text that it prints.
fn output<S: AsRef<OsStr>>(command: &mut Command, arguments: impl IntoIterator<Item = S>) -> String {
    let command = command.args(arguments).env("LD_LIBRARY_PATH", libraries());
    let output = command.output().expect("a process");
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "{command:?} says\n{said}{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8(output.stdout).expect("UTF-8")
}

/// Compiles a program with the shared library.
fn build(folder: &TempDir, compiler: &str, flags: &[&str], source: &Path) -> PathBuf {
    let program = folder.path().join("program");
    let mut command = Command::new(compiler);
    let is_cpp = compiler.ends_with("++");
    command
        .args(WARNINGS)
        .args(flags)
        .arg(INCLUDE)
        .args(is_cpp.then_some(["-x", "c++"]).into_iter().flatten());
    command.arg(source).args(is_cpp.then_some(["-x", "none"]).into_iter().flatten());
    output(
        command.arg("-L").arg(libraries()),
        [OsStr::new("-lmbs"), "-lm".as_ref(), "-o".as_ref(), program.as_os_str()],
    );
    program
}

/// The arguments of the program: a step, steps and the files of the library.
fn arguments() -> Vec<String> {
    let files = LIBRARY.iter().map(|name| file(name).to_str().expect("UTF-8").to_owned());
    [STEP.to_string(), STEPS.to_string()].into_iter().chain(files).collect()
}

/// The lines that the program has to print: the numbers of runs in Rust, to the bit.
fn expected() -> String {
    let line = |name: &&str| {
        let live =
            Text::read(&file(name)).expect("a text").compile().unwrap_or_else(|error| panic!("{error}"));
        let inputs = vec![0.5; live.declared_info().inputs.len()];
        let mut builder = Run::builder(&live, STEP).inputs(&inputs);
        if let Some(feedback) = live.declared_feedback() {
            builder = builder.gains([feedback.alpha, feedback.beta]);
        }
        let mut run = builder.build().expect("a start");
        run.advance(STEPS).expect("steps");
        rust_bits(&run).iter().map(|bits| format!("{bits:x} ")).collect::<String>() + "\n"
    };
    LIBRARY.iter().map(line).collect()
}

#[test]
fn c_and_cpp_print_the_digits_of_rust() {
    let expected = expected();
    for (compiler, language) in COMPILERS {
        if is_there(compiler) {
            let folder = TempDir::new().expect("a folder");
            let program = build(&folder, compiler, &[language, "-O1"], Path::new(PROGRAM));
            assert_eq!(output(&mut Command::new(program), arguments()), expected, "{compiler}");
        }
    }
}

#[test]
fn sanitizers_find_nothing() {
    for (compiler, language) in &COMPILERS[..2] {
        if is_there(compiler) {
            let folder = TempDir::new().expect("a folder");
            let flags = [&[*language, "-g", "-O1"], &SANITIZERS[..]].concat();
            let program = build(&folder, compiler, &flags, Path::new(PROGRAM));
            assert_eq!(output(&mut Command::new(program), arguments()), expected(), "{compiler}");
        }
    }
}

#[test]
#[ignore = "compiles texts under valgrind for seconds; .ci/run asks for it"]
fn valgrind_finds_nothing() {
    if !["valgrind", "gcc"].iter().all(|tool| is_there(tool)) {
        return;
    }
    let folder = TempDir::new().expect("a folder");
    let program = build(&folder, "gcc", &["-std=c99", "-g", "-O1"], Path::new(PROGRAM));
    let mut command = Command::new("valgrind");
    // Rust keeps the handle of a thread by a pointer into it, which valgrind says may be a leak
    command.args([
        "--quiet",
        "--error-exitcode=9",
        "--leak-check=full",
        "--errors-for-leak-kinds=definite,indirect",
    ]);
    command.arg("--show-leak-kinds=definite,indirect").arg(program);
    // the first ones are enough for a program that is slowed down
    let few = arguments().into_iter().take(5);
    let lines = output(&mut command, few);
    assert!(expected().starts_with(&lines) && lines.lines().count() == 3);
}

/// The block of the README that begins so, in this language, and what stands behind it as its output.
fn shown(language: &str, begin: &str) -> (String, String) {
    let fence = format!("```{language}\n");
    let mut blocks = README.split(&fence).skip(1);
    let block = blocks.find(|block| block.starts_with(begin)).expect("it is shown");
    let (code, rest) = block.split_once("```").expect("an end");
    let printed = rest.split("```text\n").nth(1).and_then(|rest| rest.split("```").next());
    (code.to_owned(), printed.expect("its output").to_owned())
}

#[test]
fn the_example_of_the_readme_prints_what_it_says() {
    if !is_there("gcc") {
        return;
    }
    let (code, printed) = shown("c", "#include <mbs.h>");
    let folder = TempDir::new().expect("a folder");
    let source = folder.path().join("pendulum.c");
    std::fs::write(&source, code).expect("a file");
    let program = build(&folder, "gcc", &["-std=c99"], &source);
    assert_eq!(output(&mut Command::new(program), [""; 0]), printed);
    // and with the static library
    let program = folder.path().join("alone");
    let mut command = Command::new("gcc");
    command.arg(INCLUDE).arg(source).arg(libraries().join("libmbs.a")).args([
        "-lm",
        "-lpthread",
        "-ldl",
        "-o",
    ]);
    output(&mut command, [&program]);
    assert_eq!(output(&mut Command::new(program), [""; 0]), printed);
}

#[test]
fn python_calls_it_as_the_readme_does() {
    if !is_there("python3") {
        return;
    }
    let (code, printed) = shown("python", "import ctypes");
    let folder = TempDir::new().expect("a folder");
    std::fs::copy(file("pendulum"), folder.path().join("pendulum.rs")).expect("a file");
    let mut command = Command::new("python3");
    assert_eq!(output(command.current_dir(&folder), ["-c", &code]), printed);
}
