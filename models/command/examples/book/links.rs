//! Links of the built book: a file or a heading that is not there is an error.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Component, Path, PathBuf};

use crate::Outcome;

/// Looks at every page that mdBook wrote.
pub fn check(book: &Path) -> Outcome {
    let mut pages = BTreeMap::new();
    for entry in fs::read_dir(book)? {
        let path = entry?.path();
        if path.extension().is_some_and(|ending| ending == "html") {
            pages.insert(path.clone(), fs::read_to_string(path)?);
        }
    }
    let mut dead = Vec::new();
    let mut count = 0;
    for (page, text) in &pages {
        for link in links(text) {
            count += 1;
            if !leads_somewhere(page, link, &pages) {
                dead.push(format!("{}: {link}", page.display()));
            }
        }
    }
    println!("{} pages, {count} links", pages.len());
    if dead.is_empty() { Ok(()) } else { Err(format!("links lead nowhere:\n{}", dead.join("\n")).into()) }
}

/// The links of a page to places in the book.
fn links(page: &str) -> impl Iterator<Item = &str> {
    let begins = [" href=\"", " src=\"", " srcset=\""];
    let all = begins.into_iter().flat_map(|begin| page.split(begin).skip(1));
    all.filter_map(|rest| rest.split('"').next())
        .filter(|link| !["https:", "http:", "data:"].iter().any(|outside| link.starts_with(outside)))
}

fn leads_somewhere(page: &Path, link: &str, pages: &BTreeMap<PathBuf, String>) -> bool {
    let (file, heading) = link.split_once('#').map_or((link, None), |(file, heading)| (file, Some(heading)));
    let folder = page.parent().unwrap_or(page);
    let target = if file.is_empty() { page.to_owned() } else { resolved(&folder.join(file)) };
    match heading {
        None | Some("") => target.is_file() || target.join("index.html").is_file(),
        Some(heading) => pages.get(&target).is_some_and(|text| text.contains(&format!("id=\"{heading}\""))),
    }
}

/// A path without `..`.
fn resolved(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut found, component| {
        match component {
            Component::ParentDir => _ = found.pop(),
            Component::CurDir => {}
            other => found.push(other),
        }
        found
    })
}
