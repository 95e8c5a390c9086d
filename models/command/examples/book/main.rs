//! Builds the book: `cargo test --release -p mbs --test command book && cargo run --release -p mbs --example book`.
//!
//! It puts together in `target/book` what stands in `models/book`, the pictures that the commands of the chapters
//! made when they were tested, the gallery of the library, and the pages of the crates; mdBook makes
//! `target/book/html` of that. A warning of mdBook and a link that leads nowhere are errors.

mod gallery;
mod links;
mod reference;

use std::error::Error;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

type Outcome<T = ()> = Result<T, Box<dyn Error>>;

/// The folders that the book is made of, and the program that draws.
struct Places {
    /// Of the workspace.
    root: PathBuf,
    /// Where the commands of the chapters left their files.
    made: PathBuf,
    /// Where the book is put together.
    book: PathBuf,
    /// The `mbs` that cargo built.
    mbs: PathBuf,
}

fn main() -> ExitCode {
    match build() {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn build() -> Outcome {
    let places = Places::found()?;
    let chapters = places.book.join("src");
    if places.book.exists() {
        fs::remove_dir_all(&places.book)?;
    }
    copy(&places.root.join("models/book"), &places.book)?;
    for chapter in written(&chapters)? {
        pictures(&chapter, &places.made)?;
        without_patterns(&chapter)?;
    }
    gallery::write(&places, &chapters)?;
    reference::write(&places, &chapters)?;
    highlight(&places.book.join("theme/mbs.js"))?;
    html(&places.book)?;
    links::check(&places.book.join("html"))?;
    println!("written: {}", places.book.join("html/index.html").display());
    Ok(())
}

impl Places {
    fn found() -> Outcome<Self> {
        let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize()?;
        // this program is target/release/examples/book
        let program = std::env::current_exe()?;
        let profile = program.ancestors().nth(2).ok_or("no folder of the profile")?;
        let target = profile.parent().ok_or("no target folder")?;
        let mbs = profile.join("mbs");
        if !mbs.exists() {
            return Err(format!(
                "there is no {}: `cargo test --release -p mbs --test command book` makes it",
                mbs.display()
            )
            .into());
        }
        Ok(Self { root, made: target.join("tmp/book"), book: target.join("book"), mbs })
    }

    /// Runs the `mbs` command, and returns what it prints.
    fn printed(&self, arguments: &[&str]) -> Outcome<String> {
        let ended = Command::new(&self.mbs).args(arguments).output()?;
        if !ended.status.success() {
            let message = String::from_utf8_lossy(&ended.stderr);
            return Err(format!("mbs {} failed: {message}", arguments.join(" ")).into());
        }
        Ok(String::from_utf8(ended.stdout)?)
    }
}

/// Copies a folder with all that is in it.
fn copy(from: &Path, to: &Path) -> Outcome {
    fs::create_dir_all(to)?;
    for entry in fs::read_dir(from)? {
        let path = entry?.path();
        let there = to.join(path.file_name().ok_or("a file has a name")?);
        if path.is_dir() {
            copy(&path, &there)?;
        } else {
            fs::copy(&path, &there)?;
        }
    }
    Ok(())
}

/// The chapters that are written by hand.
fn written(chapters: &Path) -> Outcome<Vec<PathBuf>> {
    let entries = fs::read_dir(chapters)?.map(|entry| entry.map(|entry| entry.path()));
    let is_chapter = |path: &PathBuf| path.extension().is_some_and(|ending| ending == "md");
    Ok(entries.collect::<Result<Vec<_>, _>>()?.into_iter().filter(is_chapter).collect())
}

/// Copies what a chapter shows or offers, `files/NAME`, from where its commands left it.
fn pictures(chapter: &Path, made: &Path) -> Outcome {
    let folder = chapter.with_file_name("files");
    fs::create_dir_all(&folder)?;
    for rest in fs::read_to_string(chapter)?.split("](files/").skip(1) {
        let name = rest.split(')').next().unwrap_or_default();
        fs::copy(made.join(name), folder.join(name)).map_err(|error| {
            let chapter = chapter.display();
            format!(
                "{chapter} shows {name}: {error}; `cargo test --release -p mbs --test command book` makes it"
            )
        })?;
    }
    Ok(())
}

/// Shows the reader dots where the test takes any text, and no words for the test alone.
fn without_patterns(chapter: &Path) -> Outcome {
    let mut is_console = false;
    let mut text = String::new();
    for line in fs::read_to_string(chapter)?.lines() {
        match line.strip_prefix("```") {
            Some(language) => {
                is_console = language.starts_with("console");
                text += line.trim_end_matches(",interrupted");
            }
            None if is_console => text += &line.replace("[..]", "…"),
            None => text += line,
        }
        text.push('\n');
    }
    Ok(fs::write(chapter, text)?)
}

/// Puts the words of the language into the script that colours declarations.
fn highlight(script: &Path) -> Outcome {
    let words: Vec<&str> = mbs_codegen::keywords().iter().map(|keyword| keyword.word).collect();
    fs::write(script, fs::read_to_string(script)?.replace("KEYWORDS", &words.join(" ")))?;
    Ok(())
}

/// Lets mdBook make the pages.
fn html(book: &Path) -> Outcome {
    let ended = Command::new("mdbook").arg("build").arg(book).output().map_err(|error| {
        format!("mdbook: {error}; `cargo install mdbook --no-default-features --features search` installs it")
    })?;
    let said = String::from_utf8_lossy(&ended.stderr);
    if !ended.status.success() || said.contains("WARN") || said.contains("ERROR") {
        return Err(format!("mdbook complains:\n{said}").into());
    }
    Ok(())
}
