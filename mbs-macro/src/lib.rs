//! The `mechanism!` macro. Use it through `mbs-runtime`, which re-exports it;
//! the compiler itself is the ordinary library `mbs-codegen`.

use std::path::{Path, PathBuf};

use proc_macro::{Span, TokenStream};

/// Declares a mechanism and generates its solver.
///
/// The language is described in the documentation of `mbs-runtime`.
#[proc_macro]
pub fn mechanism(declaration: TokenStream) -> TokenStream {
    let mut files = Vec::new();
    let mut read = |name: &str| {
        let path = folder().join(name);
        let text = std::fs::read_to_string(&path).map_err(|error| format!("{error} ({})", path.display()))?;
        files.push(path);
        Ok(text)
    };
    let mut expanded = mbs_codegen::expand(declaration.into(), &mut read);
    // so that rustc compiles anew when a file changes
    for path in files.iter().filter_map(|path| std::fs::canonicalize(path).ok()) {
        let path = path.to_string_lossy();
        expanded.extend(quote::quote!(
            const _: &[u8] = ::core::include_bytes!(#path);
        ));
    }
    expanded.into()
}

/// The folder of the file that calls the macro; where nobody knows it, that of the crate.
fn folder() -> PathBuf {
    let file = Span::call_site().local_file();
    let folder = file.as_deref().and_then(Path::parent).map(Path::to_path_buf);
    folder.or_else(|| std::env::var_os("CARGO_MANIFEST_DIR").map(PathBuf::from)).unwrap_or_default()
}
