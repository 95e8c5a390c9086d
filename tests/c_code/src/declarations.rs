//! Declarations in Rust sources, read as text.

use std::path::{Path, PathBuf};
use std::{fs, io};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

/// The declarations in every `mechanism! { … }` of a folder and of those below it, with the names of the
/// files, in their order. Declarations inside of other macros are left out.
///
/// # Errors
/// A file cannot be read.
pub fn declarations(folder: &Path) -> io::Result<Vec<(PathBuf, TokenStream)>> {
    let mut found = Vec::new();
    let mut entries: Vec<PathBuf> =
        fs::read_dir(folder)?.map(|entry| Ok(entry?.path())).collect::<io::Result<_>>()?;
    entries.sort();
    for path in entries {
        if path.is_dir() {
            found.extend(declarations(&path)?);
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            let tokens: TokenStream = fs::read_to_string(&path)?.parse().map_err(no_tokens)?;
            found.extend(in_tokens(tokens).into_iter().map(|declaration| (path.clone(), declaration)));
        }
    }
    Ok(found)
}

fn no_tokens(error: proc_macro2::LexError) -> io::Error {
    io::Error::other(error.to_string())
}

fn in_tokens(tokens: TokenStream) -> Vec<TokenStream> {
    let tokens: Vec<TokenTree> = tokens.into_iter().collect();
    let declaration = |three: &[TokenTree]| match three {
        [TokenTree::Ident(name), TokenTree::Punct(mark), TokenTree::Group(group)]
            if name == "mechanism" && mark.as_char() == '!' && group.delimiter() == Delimiter::Brace =>
        {
            Some(group.stream())
        }
        _ => None,
    };
    tokens.windows(3).filter_map(declaration).collect()
}
