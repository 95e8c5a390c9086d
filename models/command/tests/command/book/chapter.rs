//! A chapter as text: its fenced blocks, and the commands in them.

use std::ops::Range;

/// A fenced block of a chapter.
pub struct Block<'a> {
    /// The word behind the opening fence: `console`, `mbs`, `python`.
    pub language: &'a str,
    /// The file that the line above names, `**pendulum.mbs**`.
    pub file: Option<&'a str>,
    /// The text between the fences.
    pub text: &'a str,
    /// The place of that text in the chapter, in bytes.
    pub range: Range<usize>,
}

/// The blocks of a chapter, from its top to its end.
pub fn blocks(chapter: &str) -> Vec<Block<'_>> {
    let mut found = Vec::new();
    let mut caption = None;
    let mut open: Option<(&str, Option<&str>, usize)> = None;
    let mut position = 0;
    for line in chapter.split_inclusive('\n') {
        let trimmed = line.trim_end();
        match open {
            Some((language, file, begin)) if trimmed == "```" => {
                let range = begin..position;
                found.push(Block { language, file, text: &chapter[range.clone()], range });
                open = None;
            }
            Some(_) => {}
            None => match trimmed.strip_prefix("```") {
                Some(language) => open = Some((language, caption.take(), position + line.len())),
                // a caption stays one over empty lines
                None if trimmed.is_empty() => {}
                None => caption = trimmed.strip_prefix("**").and_then(|rest| rest.strip_suffix("**")),
            },
        }
        position += line.len();
    }
    assert!(open.is_none(), "a block has no end");
    found
}

/// A command of a `console` block, and what stands below it.
pub struct Shown {
    pub command: String,
    pub output: String,
}

/// The commands of a `console` block: a line with `$ ` begins one, which goes on in the next line behind a `\`.
pub fn commands(block: &str) -> Vec<Shown> {
    let mut found: Vec<Shown> = Vec::new();
    for line in block.split_inclusive('\n') {
        match (line.strip_prefix("$ "), found.last_mut()) {
            (Some(command), _) => found.push(Shown { command: command.to_owned(), output: String::new() }),
            (None, Some(last)) if last.output.is_empty() && last.command.ends_with("\\\n") => {
                last.command.push_str(line);
            }
            (None, Some(last)) => last.output.push_str(line),
            (None, None) => panic!("a console block begins with `$ `: {line}"),
        }
    }
    found
}

#[test]
fn blocks_have_the_file_that_stands_above_them() {
    let chapter =
        "Save this as:\n\n**a.mbs**\n\n```mbs\nA {}\n```\n\n```console\n$ one \\\n  two\nout\n$ three\n```\n";
    let found = blocks(chapter);
    assert_eq!((found[0].language, found[0].file, found[0].text), ("mbs", Some("a.mbs"), "A {}\n"));
    assert_eq!((found[1].language, found[1].file), ("console", None));
    let shown = commands(found[1].text);
    assert_eq!((shown[0].command.as_str(), shown[0].output.as_str()), ("one \\\n  two\n", "out\n"));
    assert_eq!((shown[1].command.as_str(), shown[1].output.as_str()), ("three\n", ""));
}
