//! Chapters that stand elsewhere: the pages of the crates, which rustdoc shows too, and the help of the commands.

use std::fmt::Write;
use std::fs;
use std::path::Path;

use crate::{Outcome, Places};

/// A page of a crate as a chapter.
struct Page {
    chapter: &'static str,
    title: &'static str,
    source: &'static str,
    /// How other pages name it.
    names: &'static [&'static str],
    /// The pictures that rustdoc shows below it.
    pictures: &'static [&'static str],
}

#[rustfmt::skip]
const PAGES: &[Page] = &[
    Page { chapter: "language.md", title: "The language", source: "mbs-runtime/src/language.md",
        names: &["crate::language"], pictures: &[] },
    Page { chapter: "methods.md", title: "Methods of integration", source: "mbs-runtime/src/methods.md",
        names: &["crate::methods"], pictures: &["precision.svg", "energy.svg", "stiff.svg"] },
    Page { chapter: "gradients.md", title: "Gradients", source: "mbs-runtime/src/gradients.md",
        names: &["crate::gradients", "mbs_runtime::gradients"], pictures: &["gradients.svg"] },
    Page { chapter: "equilibria.md", title: "Equilibria", source: "mbs-runtime/analysis/README.md",
        names: &[], pictures: &["src/flap.svg"] },
    Page { chapter: "linear.md", title: "Linear systems", source: "mbs-runtime/analysis/src/linear.md",
        names: &["src/linear.md"], pictures: &["car.svg"] },
    Page { chapter: "prescribed.md", title: "Prescribed motions", source: "mbs-runtime/analysis/src/prescribed.md",
        names: &["src/prescribed.md"], pictures: &["tailgate.svg"] },
    Page { chapter: "identification.md", title: "Identification",
        source: "mbs-runtime/analysis/src/fit/identification.md",
        names: &["src/fit/identification.md"], pictures: &["identification.svg"] },
    Page { chapter: "linkages.md", title: "Synthesis", source: "mbs-runtime/analysis/src/synthesis/linkages.md",
        names: &["src/synthesis/linkages.md"], pictures: &["linkages.svg"] },
    Page { chapter: "libmbs.md", title: "The C library", source: "mbs-runtime/c/README.md",
        names: &["mbs-runtime/c/README.md"], pictures: &[] },
    Page { chapter: "ode_crates.md", title: "Solvers of other crates", source: "mbs-runtime/analysis/src/ode_crates.md",
        names: &["src/ode_crates.md"], pictures: &[] },
];

/// Writes the chapters.
pub fn write(places: &Places, chapters: &Path) -> Outcome {
    for page in PAGES {
        let source = places.root.join(page.source);
        let mut text = format!("# {}\n\n{}", page.title, chapter(&fs::read_to_string(&source)?));
        for picture in page.pictures {
            let from = source.with_file_name("").join(picture);
            let name = from.file_name().ok_or("a picture has a name")?.to_string_lossy().into_owned();
            fs::copy(&from, chapters.join("files").join(&name))?;
            write!(text, "\n![{}](files/{name})\n", name.trim_end_matches(".svg"))?;
        }
        fs::write(chapters.join(page.chapter), text)?;
    }
    fs::write(chapters.join("commands.md"), commands(places)?)?;
    Ok(())
}

/// True if a page begins with the title of a README.
fn is_title(page: &str) -> bool {
    page.starts_with("# mbs") || page.starts_with("# Mechanisms for C")
}

/// A page of rustdoc as a chapter: its headings below the title, its code with a language and without the lines that
/// rustdoc hides, its links inside the book.
fn chapter(page: &str) -> String {
    let (mut text, mut prose) = (String::new(), String::new());
    let mut fence: Option<bool> = None;
    // the title of a README is that of the chapter
    for line in page.lines().skip_while(|line| is_title(line) || line.is_empty()) {
        match (fence, line.strip_prefix("```")) {
            (None, Some(language)) => {
                text += &linked(&std::mem::take(&mut prose));
                let is_rust = language.is_empty() || language.starts_with("rust");
                fence = Some(is_rust);
                text += if is_rust { "```rust\n" } else { line };
                text += if is_rust { "" } else { "\n" };
            }
            (Some(_), Some(_)) => {
                fence = None;
                text += "```\n";
            }
            (Some(is_rust), None) if !(is_rust && (line == "#" || line.starts_with("# "))) => {
                text += line;
                text += "\n";
            }
            (Some(_), None) => {}
            (None, None) => {
                prose += if line.starts_with('#') && !is_title(page) { "#" } else { "" };
                prose += line;
                prose += "\n";
            }
        }
    }
    text + &linked(&prose)
}

/// A text whose links lead into the book; those to items of the crates are their words alone.
fn linked(prose: &str) -> String {
    let mut text = String::new();
    let mut rest = prose;
    while let Some((before, behind)) = rest.split_once("](") {
        text += before;
        let Some((target, after)) = behind.split_once(')') else { break };
        match place(target) {
            Some(place) => write!(text, "]({place})").unwrap_or_default(),
            None => {
                if let Some(open) = opened(&text) {
                    text.remove(open);
                }
            }
        }
        rest = after;
    }
    text + rest
}

/// Where a link of a page leads in the book, if it does.
fn place(target: &str) -> Option<String> {
    if target.starts_with("https:") || target.starts_with('#') {
        return Some(target.to_owned());
    }
    let (name, heading) = target
        .split_once('#')
        .map_or((target, String::new()), |(name, heading)| (name, format!("#{heading}")));
    let page = PAGES.iter().find(|page| page.names.contains(&name))?;
    Some(format!("{}{heading}", page.chapter))
}

/// Where the bracket stands that the end of a text closes.
fn opened(text: &str) -> Option<usize> {
    let mut depth = 0;
    text.char_indices().rev().find_map(|(at, letter)| match letter {
        ']' => {
            depth += 1;
            None
        }
        '[' if depth == 0 => Some(at),
        '[' => {
            depth -= 1;
            None
        }
        _ => None,
    })
}

/// The help of all commands.
fn commands(places: &Places) -> Outcome<String> {
    let mut text = "# All commands\n\nThis is what `mbs COMMAND --help` prints.\n".to_owned();
    for command in names(&places.printed(&["--help"])?) {
        let help = places.printed(&[&command, "--help"])?;
        write!(text, "\n## mbs {command}\n\n```text\n{help}```\n")?;
        for inner in names(&help) {
            let help = places.printed(&[&command, &inner, "--help"])?;
            write!(text, "\n### mbs {command} {inner}\n\n```text\n{help}```\n")?;
        }
    }
    Ok(text)
}

/// The commands that a help lists, but for `help`.
fn names(help: &str) -> Vec<String> {
    let listed =
        help.lines().skip_while(|line| *line != "Commands:").skip(1).take_while(|line| !line.is_empty());
    let words = listed.filter_map(|line| line.split_whitespace().next());
    words.filter(|word| *word != "help").map(str::to_owned).collect()
}
