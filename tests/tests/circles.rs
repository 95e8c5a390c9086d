//! Files of a crate see each other one way: no circle of imports has more than three of them.
//!
//! An import is a path that begins with `crate`, `super`, `self`, a child of the file, or a name that such a path gave
//! it. It is followed through re-exports to the file that has the thing. A parent that declares its children (`mod`) or
//! hands them on (`pub use`) does not see them by that. Tests of a file are left out.

#![allow(clippy::expect_used, clippy::panic, reason = "helpers of tests")]

use std::collections::{BTreeMap, BTreeSet};
use std::fs;
use std::path::{Path, PathBuf};

/// Files in a circle, at most.
const MOST: usize = 3;

type Module = Vec<String>;

struct File {
    code: String,
    children: BTreeSet<String>,
    uses: Vec<Use>,
}

/// `use a::b as name;`
#[derive(Debug)]
struct Use {
    path: Vec<String>,
    name: String,
    is_handed_on: bool,
}

type Crate = BTreeMap<Module, File>;

#[test]
fn no_circle_of_imports_has_more_than_three_files() {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let (mut files, mut imports, mut wrong) = (0, 0, Vec::new());
    for member in members(&root) {
        let source = root.join(&member).join("src");
        let Some(file) =
            ["lib.rs", "main.rs"].map(|name| source.join(name)).into_iter().find(|file| file.is_file())
        else {
            continue;
        };
        let mut all = Crate::new();
        load(&file, &source, Vec::new(), &mut all);
        let edges = edges(&all);
        files += all.len();
        imports += edges.values().map(BTreeSet::len).sum::<usize>();
        for circle in circles(&edges).into_iter().filter(|circle| circle.len() > MOST) {
            let names: Vec<String> = circle.iter().map(|module| module.join("::")).collect();
            wrong.push(format!("{member}: {}", names.join(", ")));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    assert!(files > 500 && imports > 1000, "{files} files, {imports} imports");
}

/// The folders of the workspace's crates.
fn members(root: &Path) -> Vec<String> {
    let text = fs::read_to_string(root.join("Cargo.toml")).expect("a manifest");
    let list = text.split("members = [").nth(1).and_then(|rest| rest.split(']').next()).expect("members");
    list.split('"').skip(1).step_by(2).map(str::to_owned).collect()
}

/// Reads a file and its children, which stand in `folder`.
fn load(file: &Path, folder: &Path, module: Module, all: &mut Crate) {
    let code = code(&fs::read_to_string(file).expect("a text"));
    let (uses, code) = uses(&code);
    let mut children = BTreeSet::new();
    for piece in code.split(';') {
        let words = piece.rsplit(['}', '{', ']']).next().unwrap_or(piece).split_whitespace();
        let words: Vec<&str> = words.collect();
        let [.., "mod", child] = words.as_slice() else { continue };
        let places: [PathBuf; 2] = [folder.join(format!("{child}.rs")), folder.join(child).join("mod.rs")];
        let Some(place) = places.iter().find(|place| place.is_file()) else { continue };
        children.insert((*child).to_owned());
        let inner = module.iter().cloned().chain([(*child).to_owned()]).collect();
        load(place, &folder.join(child), inner, all);
    }
    all.insert(module, File { code, children, uses });
}

/// The code of a file: no tests, no comments, no strings.
fn code(text: &str) -> String {
    let tests =
        ["#[cfg(test)]\nmod ", "#[cfg(test)]\npub(super) mod ", "#[cfg(all(test, feature = \"std\"))]\nmod "];
    let end = tests.iter().filter_map(|tests| text.find(tests)).min().unwrap_or(text.len());
    let (mut rest, mut code) = (&text[..end], String::new());
    while let Some(letter) = rest.chars().next() {
        let to =
            |end: &str, from: usize| rest[from..].find(end).map_or(rest.len(), |at| from + at + end.len());
        let skipped = if rest.starts_with("//") {
            to("\n", 0)
        } else if rest.starts_with("/*") {
            to("*/", 0)
        } else if let Some(length) = literal(rest) {
            length
        } else {
            code.push(letter);
            letter.len_utf8()
        };
        if skipped > letter.len_utf8() {
            code.push('\n');
        }
        rest = &rest[skipped..];
    }
    code
}

/// The length of the string or the letter that a text begins with.
fn literal(text: &str) -> Option<usize> {
    let inner = text.strip_prefix('b').unwrap_or(text);
    let before = text.len() - inner.len();
    if let Some(raw) = inner.strip_prefix('r') {
        let hashes = raw.len() - raw.trim_start_matches('#').len();
        let body = raw[hashes..].strip_prefix('"')?;
        let end = format!("\"{}", "#".repeat(hashes));
        return Some(before + 2 + hashes + body.find(&end)? + end.len());
    }
    let mut letters = inner.char_indices();
    match letters.next()? {
        (_, '"') => {
            while let Some((at, letter)) = letters.next() {
                match letter {
                    '"' => return Some(before + at + 1),
                    '\\' => drop(letters.next()),
                    _ => {}
                }
            }
            None
        }
        // the quote of a lifetime has no partner
        (_, '\'') if letters.next()?.1 == '\\' => Some(before + 3 + inner.get(3..)?.find('\'')? + 1),
        (_, '\'') => letters.next().filter(|(_, letter)| *letter == '\'').map(|(at, _)| before + at + 1),
        _ => None,
    }
}

/// The `use` statements of some code, and the code without them.
fn uses(code: &str) -> (Vec<Use>, String) {
    let (mut uses, mut others) = (Vec::new(), String::new());
    for piece in code.split_inclusive(';') {
        let begins = |line: &str| {
            let (visibility, rest) = line.trim_start().split_once("use ")?;
            let is_visibility = visibility.is_empty() || visibility.starts_with("pub");
            (is_visibility && visibility.len() < 20).then(|| (!visibility.is_empty(), rest.to_owned()))
        };
        let mut at = 0;
        let starts = piece.split_inclusive('\n').filter_map(|line| {
            let start = at;
            at += line.len();
            begins(line).map(|(is_handed_on, _)| (start, is_handed_on))
        });
        match starts.last() {
            Some((start, is_handed_on)) => {
                let tree = piece[start..].split_once("use ").map_or("", |(_, tree)| tree);
                branches(tree.trim_end_matches(';'), &[], is_handed_on, &mut uses);
                others.push_str(&piece[..start]);
            }
            None => others.push_str(piece),
        }
    }
    (uses, others)
}

/// The paths of a tree such as `a::{b, c::{self, d as e}}`.
fn branches(tree: &str, before: &[String], is_handed_on: bool, uses: &mut Vec<Use>) {
    let segments = |text: &str| -> Vec<String> {
        let words = text.split("::").map(str::trim).filter(|word| !word.is_empty());
        before.iter().cloned().chain(words.map(str::to_owned)).collect()
    };
    let tree = tree.trim();
    if let Some((stem, inner)) = tree.split_once('{') {
        let inner = inner.trim_end().strip_suffix('}').unwrap_or(inner);
        let (mut depth, mut start) = (0, 0);
        for (at, letter) in inner.char_indices().chain([(inner.len(), ',')]) {
            match letter {
                '{' => depth += 1,
                '}' => depth -= 1,
                ',' if depth == 0 => {
                    branches(&inner[start..at], &segments(stem), is_handed_on, uses);
                    start = inner.len().min(at + 1);
                }
                _ => {}
            }
        }
        return;
    }
    let (path, alias) =
        tree.split_once(" as ").map_or((tree, None), |(path, alias)| (path, Some(alias.trim())));
    let mut path = segments(path);
    path.pop_if(|last| last == "self" && !before.is_empty());
    let Some(name) = alias.map(str::to_owned).or_else(|| path.last().cloned()) else { return };
    if !tree.is_empty() {
        uses.push(Use { path, name, is_handed_on });
    }
}

/// The files that each file sees.
fn edges(all: &Crate) -> BTreeMap<&Module, BTreeSet<&Module>> {
    let seen = |(module, file): (&'_ Module, &'_ File)| -> BTreeSet<Module> {
        let imported = file.uses.iter().filter(|of| !of.is_handed_on).map(|of| of.path.clone());
        let paths = imported.chain(paths(&file.code));
        paths.filter_map(|path| found(all, module, &path, 0)).filter(|other| other != module).collect()
    };
    let key = |module: Module| all.get_key_value(&module).map(|(module, _)| module);
    all.iter()
        .map(|(module, file)| (module, seen((module, file)).into_iter().filter_map(key).collect()))
        .collect()
}

/// The paths of more than one word in some code.
fn paths(code: &str) -> impl Iterator<Item = Vec<String>> {
    let words = code.split(|letter: char| !(letter.is_alphanumeric() || "_:".contains(letter)));
    let path = |word: &str| word.trim_matches(':').split("::").map(str::to_owned).collect::<Vec<_>>();
    words.map(path).filter(|path| path.len() > 1)
}

/// The file in which a path of another file ends, through re-exports.
fn found(all: &Crate, module: &Module, path: &[String], depth: usize) -> Option<Module> {
    let file = all.get(module).filter(|_| depth < 8)?;
    let (first, mut rest) = path.split_first()?;
    let mut place = module.clone();
    match first.as_str() {
        "crate" => place.clear(),
        "self" => {}
        "super" => drop(place.pop()),
        _ if file.children.contains(first) => rest = path,
        _ => {
            let of = file
                .uses
                .iter()
                .find(|of| of.name == *first && of.path != path && of.path != [first.clone()])?;
            let longer: Vec<String> = of.path.iter().chain(rest).cloned().collect();
            return found(all, module, &longer, depth + 1);
        }
    }
    while let Some(("super", others)) = rest.split_first().map(|(first, others)| (first.as_str(), others)) {
        (_, rest) = (place.pop(), others);
    }
    while let Some((child, others)) =
        rest.split_first().filter(|(child, _)| all[&place].children.contains(*child))
    {
        place.push(child.clone());
        rest = others;
    }
    let handed = rest.first().and_then(|name| {
        let is_itself = |of: &Use| place == *module && of.path == path;
        let of = all[&place].uses.iter().find(|of| of.name == *name && !is_itself(of))?;
        let longer: Vec<String> = of.path.iter().chain(&rest[1..]).cloned().collect();
        found(all, &place, &longer, depth + 1)
    });
    handed.or(Some(place))
}

/// The sets of files that see each other, directly or through others.
fn circles<'m>(edges: &BTreeMap<&'m Module, BTreeSet<&'m Module>>) -> BTreeSet<BTreeSet<&'m Module>> {
    let reach = |from: &'m Module| -> BTreeSet<&'m Module> {
        let (mut reached, mut next) = (BTreeSet::new(), vec![from]);
        while let Some(module) = next.pop() {
            next.extend(edges[module].iter().copied().filter(|other| reached.insert(*other)));
        }
        reached
    };
    let reached: BTreeMap<&Module, _> = edges.keys().map(|module| (*module, reach(module))).collect();
    let circle = |module: &&'m Module| -> BTreeSet<&'m Module> {
        reached[module].iter().copied().filter(|other| reached[other].contains(module)).collect()
    };
    edges.keys().map(circle).filter(|circle| !circle.is_empty()).collect()
}

#[test]
fn code_has_no_strings_comments_letters_and_tests() {
    let text = "use a; // use b;\nlet x = (\"use c; \\\" x\", r#\"use d;\"#, 'e', b'\\'', '\\n', &'f ());\n#[cfg(test)]\nmod tests { use g; }";
    let code = code(text);
    assert!(code.contains("use a") && code.contains("'f"), "{code}");
    assert!(!["b;", "c;", "d;", "'e'", "\\", "g;"].iter().any(|part| code.contains(part)), "{code}");
}

#[test]
fn trees_have_their_paths() {
    let (uses, code) =
        uses("pub use a::{b, c::{self, d as e}};\nfn f() {\n    use super::x::Y;\n    Y::z();\n}");
    let text: Vec<String> =
        uses.iter().map(|of| format!("{} {} {}", of.path.join("::"), of.name, of.is_handed_on)).collect();
    assert_eq!(text, ["a::b b true", "a::c c true", "a::c::d e true", "super::x::Y Y false"]);
    assert_eq!(paths(&code).collect::<Vec<_>>(), [["Y", "z"]]);
}
