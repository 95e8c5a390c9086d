//! The files of an export as a package: built, installed and found by what others use, read by C++, and clean under
//! sanitizers and valgrind.

#![allow(clippy::unwrap_used, clippy::panic, reason = "a test says by panicking what is wrong")]

use std::path::Path;
use std::process::Command;

use c_code::{compilers, is_there};
use mbs_live::{Run, Scalar};
use mbs_runtime::System;
use tempfile::TempDir;

/// With drives and without, with redundant constraints, tables, friction, own states and loops of long programs.
const MECHANISMS: [&str; 7] = [
    "slider-crank",
    "slider-crank-free",
    "cam-follower",
    "double-pendulum",
    "tipper",
    "dc-motor",
    "n-pendulum-40",
];

/// The files of an export in a folder, and what names begin with.
fn exported(name: &str) -> (TempDir, String) {
    let entry = mbs::library().iter().find(|entry| entry.name == name).unwrap();
    let sources = entry.text().c(Scalar::Double).unwrap();
    let folder = TempDir::new().unwrap();
    for file in sources.files() {
        std::fs::write(folder.path().join(&file.name), &file.text).unwrap();
    }
    (folder, sources.prefix)
}

/// Runs a command, which has to succeed, and returns what it prints.
fn run(folder: &Path, line: &str) -> String {
    let output = Command::new("sh").args(["-c", line]).current_dir(folder).output().unwrap();
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(output.status.success(), "`{line}` says\n{said}{}", String::from_utf8_lossy(&output.stdout));
    String::from_utf8(output.stdout).unwrap()
}

const STRICT: &str = "-Wall -Wextra -Werror -pedantic";

/// A program of somebody else, in C and in C++.
fn consumer(prefix: &str) -> String {
    let capitals = prefix.to_uppercase();
    format!(
        "#include <{prefix}.h>\n#include <stdio.h>\n\
         int main() {{\n    struct {prefix}_parameters parameters;\n    struct {prefix} mechanism;\n    \
         struct {prefix}_run run;\n    {prefix}_default_parameters(&parameters);\n    \
         int code = {prefix}_init(&mechanism, &parameters);\n    \
         if (code == {capitals}_OK) {{ code = {prefix}_start(&run, &mechanism, 1e-4); }}\n    \
         for (int k = 0; code == {capitals}_OK && k < 10; k++) {{ code = {prefix}_step(&run); }}\n    \
         printf(\"%d %.17g\\n\", code, (double)run.state.t);\n    return code;\n}}\n"
    )
}

#[test]
fn make_installs_what_pkg_config_finds() {
    if !["make", "pkg-config"].iter().all(|tool| is_there(tool)) {
        return;
    }
    for compiler in compilers() {
        let (folder, prefix) = exported("slider-crank-free");
        let at = folder.path();
        std::fs::write(at.join("mine.c"), consumer(&prefix)).unwrap();
        run(at, &format!("make CC={compiler} CFLAGS='-O2 {STRICT}' install all prefix=$PWD/there"));
        let table = run(at, &format!("./{prefix}_example"));
        assert_eq!(table.lines().count(), 102, "{table}");
        let flags =
            format!("$(PKG_CONFIG_PATH=there/lib/pkgconfig pkg-config --cflags --libs --static {prefix})");
        run(at, &format!("{compiler} {STRICT} -std=c99 mine.c {flags} -o mine"));
        assert_eq!(run(at, "./mine"), "0 0.001\n");
        run(at, "make clean");
        assert!(!at.join(format!("{prefix}_example")).exists());
    }
}

#[test]
fn cmake_installs_what_cmake_finds() {
    if !["cmake", "gcc"].iter().all(|tool| is_there(tool)) {
        return;
    }
    let (folder, prefix) = exported("slider-crank-free");
    let at = folder.path();
    run(at, "cmake -B build . && cmake --build build && cmake --install build --prefix $PWD/there");
    assert_eq!(run(at, &format!("build/{prefix}_example")).lines().count(), 102);
    let other = at.join("other");
    std::fs::create_dir(&other).unwrap();
    std::fs::write(other.join("mine.c"), consumer(&prefix)).unwrap();
    let project = format!(
        "cmake_minimum_required(VERSION 3.13)\nproject(other C)\nfind_package({prefix} CONFIG REQUIRED)\n\
         add_executable(mine mine.c)\ntarget_link_libraries(mine {prefix}::{prefix})\n"
    );
    std::fs::write(other.join("CMakeLists.txt"), project).unwrap();
    run(&other, "cmake -B build -DCMAKE_PREFIX_PATH=$PWD/../there . && cmake --build build");
    assert_eq!(run(&other, "build/mine"), "0 0.001\n");
}

#[test]
fn cpp_reads_the_header_and_the_source() {
    for (c, cpp) in [("gcc", "g++"), ("clang", "clang++")] {
        if ![c, cpp].iter().all(|tool| is_there(tool)) {
            continue;
        }
        for name in MECHANISMS.into_iter().step_by(paths::STRIDE) {
            let (folder, prefix) = exported(name);
            let at = folder.path();
            std::fs::write(at.join("mine.cpp"), consumer(&prefix)).unwrap();
            run(at, &format!("{c} -std=c99 {STRICT} -c {prefix}.c -o c.o"));
            run(at, &format!("{cpp} -std=c++17 {STRICT} -I. mine.cpp c.o -lm -o mine"));
            assert_eq!(run(at, "./mine"), "0 0.001\n");
            // `= {0}` is how C clears a struct, on which C++ compilers remark
            let flags = format!("-std=c++17 {STRICT} -Wno-missing-field-initializers -Wno-missing-braces");
            run(at, &format!("{cpp} {flags} -x c++ -c {prefix}.c -o cpp.o"));
        }
    }
}

#[test]
fn sanitizers_find_nothing() {
    // those of clang where it is there, else of gcc: both are the same library
    if let Some(compiler) = compilers().pop() {
        for name in MECHANISMS.into_iter().step_by(paths::STRIDE) {
            let (folder, prefix) = exported(name);
            let flags = "-std=c99 -g -O1 -fsanitize=address,undefined -fno-sanitize-recover=all";
            run(folder.path(), &format!("{compiler} {flags} {prefix}.c main.c -lm -o checked"));
            run(folder.path(), "./checked");
        }
    }
}

#[test]
fn valgrind_finds_nothing() {
    if !["valgrind", "gcc"].iter().all(|tool| is_there(tool)) {
        return;
    }
    for name in MECHANISMS.into_iter().step_by(paths::STRIDE) {
        let (folder, prefix) = exported(name);
        run(folder.path(), &format!("gcc -std=c99 -g -O1 {prefix}.c main.c -lm -o plain"));
        run(folder.path(), "valgrind --quiet --error-exitcode=9 --leak-check=full ./plain");
    }
}

/// The loop of `models/examples/embed.c`, in Rust.
fn controlled() -> String {
    const STEP: f64 = 0.5e-3;
    let target = 250.0 * std::f64::consts::PI / 30.0;
    let entry = mbs::library().iter().find(|entry| entry.name == "slider-crank-free").unwrap();
    let mut plant = Run::builder(&entry.text().compile().unwrap(), STEP).build().unwrap();
    let (mut sum, mut rows) = (0.0, String::new());
    for tick in 0..=2000 {
        let (mut q, mut v) = ([0.0; 7], [0.0; 7]);
        plant.state(&mut q, &mut v);
        let error = target - v[2];
        let next = sum + error * STEP;
        let wanted = 4.0 * error + 40.0 * next;
        if wanted.abs() < 20.0 {
            sum = next;
        }
        let torque = wanted.clamp(-20.0, 20.0);
        plant.set_inputs(&[torque]);
        if tick % 200 == 0 {
            rows += &format!("{:?} {:?} {torque:?}\n", plant.time(), v[2]);
        }
        plant.step().unwrap();
    }
    rows
}

#[test]
fn a_controlled_plant_is_that_of_rust() {
    let numbers = |rows: &str| -> Vec<f64> { rows.split_whitespace().map(|x| x.parse().unwrap()).collect() };
    let expected = controlled();
    assert_eq!(expected.lines().count(), 11);
    for compiler in compilers() {
        let (folder, prefix) = exported("slider-crank-free");
        let program = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../models/examples/embed.c");
        std::fs::copy(program, folder.path().join("embed.c")).unwrap();
        let flags = format!("-std=c99 -O2 -ffp-contract=off {STRICT}");
        run(folder.path(), &format!("{compiler} {flags} embed.c {prefix}.c -lm -o embed"));
        // to the bit
        assert_eq!(numbers(&run(folder.path(), "./embed")), numbers(&expected));
    }
}
