//! The folder in which the chapters are read, and what their blocks do there.

use std::ops::Range;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};
use std::{env, fs};

use snapbox::{Assert, Data, IntoData};

use super::chapter::{Block, Shown, commands};

/// Stands between the outputs of the blocks of a program in Python.
const BETWEEN: &str = "\u{1e}";

/// An empty folder for what the chapters make.
pub fn emptied() -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("book");
    if path.exists() {
        fs::remove_dir_all(&path).unwrap();
    }
    fs::create_dir_all(&path).unwrap();
    path
}

/// A chapter, and the folder in which its commands are run.
pub struct Reading<'a> {
    pub chapter: &'a str,
    pub path: &'a Path,
}

impl Reading<'_> {
    /// Does what the blocks say. Gives what was printed, by where the chapter shows it, and says what differs.
    pub fn read(&self, blocks: &[Block<'_>], wrong: &mut Vec<String>) -> Vec<(Range<usize>, String)> {
        let mut printed = Vec::new();
        for block in blocks {
            if let Some(file) = block.file {
                fs::write(self.path.join(file), block.text).unwrap();
            }
            if block.language.starts_with("console") {
                let is_interrupted = block.language.ends_with(",interrupted");
                let Some(text) = self.console(&commands(block.text), is_interrupted, wrong) else {
                    println!("{}: the rest is skipped", self.chapter);
                    break;
                };
                printed.push((block.range.clone(), text));
            }
        }
        self.python(blocks, wrong, &mut printed);
        printed.sort_by_key(|(range, _)| range.start);
        printed
    }

    /// Runs the commands of a console, and returns what it shows. `None` where a program is not on this
    /// machine.
    fn console(&self, shown: &[Shown], is_interrupted: bool, wrong: &mut Vec<String>) -> Option<String> {
        let mut text = String::new();
        for Shown { command, output } in shown {
            let needed = [command.split_whitespace().next()?, if is_interrupted { "timeout" } else { "sh" }];
            for program in needed {
                if !self.shell(&format!("command -v {program}"), false).status.success() {
                    println!("{}: there is no `{program}`", self.chapter);
                    return None;
                }
            }
            let ended = self.shell(command, is_interrupted);
            let actual = String::from_utf8(ended.stdout).unwrap();
            // a command that fails or warns says so where the reader sees it
            let is_good = ended.status.success() || is_interrupted;
            if !is_good && !["error", "warning", "Error"].iter().any(|word| output.contains(word)) {
                wrong.push(format!("{}: `{}` failed:\n{actual}", self.chapter, command.trim_end()));
            }
            text += &format!("$ {command}{}", self.compared(command, &actual, output, wrong));
        }
        Some(text)
    }

    fn shell(&self, command: &str, is_interrupted: bool) -> Output {
        let mbs = Path::new(env!("CARGO_BIN_EXE_mbs")).parent().unwrap();
        let others = env::var_os("PATH").unwrap_or_default();
        let path = env::join_paths([mbs.to_owned()].into_iter().chain(env::split_paths(&others))).unwrap();
        let mut shell = if is_interrupted {
            let mut timeout = Command::new("timeout");
            timeout.args(["--signal=INT", "2", "sh"]);
            timeout
        } else {
            Command::new("sh")
        };
        // one stream, as a terminal has it
        let command = format!("exec 2>&1; {command}");
        shell
            .args(["-c", &command])
            .current_dir(self.path)
            .env("PATH", path)
            .env("LC_ALL", "C")
            .output()
            .unwrap()
    }

    /// Runs the blocks of Python as one program.
    fn python(
        &self,
        blocks: &[Block<'_>],
        wrong: &mut Vec<String>,
        printed: &mut Vec<(Range<usize>, String)>,
    ) {
        let programs: Vec<&Block<'_>> = blocks.iter().filter(|block| block.language == "python").collect();
        if programs.is_empty() {
            return;
        }
        let Some(python) = env::var_os("BOOK_PYTHON") else {
            println!("{}: BOOK_PYTHON names no interpreter, its Python is skipped", self.chapter);
            return;
        };
        let between = "\nprint('\\x1e', end='')\n";
        let program = programs.iter().map(|block| block.text).collect::<Vec<_>>().join(between);
        fs::write(self.path.join("chapter.py"), program).unwrap();
        let ended = Command::new(python).arg("chapter.py").current_dir(self.path).output().unwrap();
        let (out, err) = (String::from_utf8_lossy(&ended.stdout), String::from_utf8_lossy(&ended.stderr));
        if !ended.status.success() {
            wrong.push(format!("{}: Python fails:\n{out}{err}", self.chapter));
        }
        for (block, actual) in programs.iter().zip(out.split(BETWEEN)) {
            // what it prints stands in the next block
            let next = blocks.iter().find(|other| other.range.start > block.range.start);
            let expected = next.filter(|next| next.language == "text");
            let text =
                self.compared("a block of Python", actual, expected.map_or("", |next| next.text), wrong);
            if let Some(next) = expected {
                printed.push((next.range.clone(), text));
            }
        }
    }

    /// The text that is to stand in the chapter: the present one, if that is right.
    fn compared(&self, what: &str, actual: &str, expected: &str, wrong: &mut Vec<String>) -> String {
        let name = format!("{}: `{}`", self.chapter, what.trim_end());
        let plain = |text: &str| -> Data { text.to_owned().into_data() };
        match Assert::new().normalize_paths(false).try_eq(Some(&name), plain(actual), plain(expected)) {
            Ok(()) => expected.to_owned(),
            Err(error) => {
                wrong.push(error.to_string());
                actual.to_owned()
            }
        }
    }
}
