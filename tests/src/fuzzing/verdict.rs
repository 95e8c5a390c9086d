//! Verdicts on the compiler's answers to inputs.

use std::cell::RefCell;
use std::collections::BTreeSet;
use std::panic;
use std::sync::mpsc;
use std::thread;
use std::time::Duration;

use super::tokens;

/// The stack of rustc's main thread, on which macros run.
const STACK: usize = 8 << 20;

/// How a compilation ended. An overflow of the stack is none of these: it ends
/// the process.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// To Rust.
    Compiled,
    /// Errors in mechanism words.
    Refused,
    /// Not even tokens: rustc would not call the macro.
    NoTokens,
    /// With its place in the source.
    Panicked(String),
    /// An error that says that the compiler itself is at fault.
    Internal(String),
    /// Compiled to what is no Rust.
    WrongCode(String),
    /// Not done within the limit.
    TooSlow,
}

impl Verdict {
    /// True if the compiler is at fault.
    pub fn is_failure(&self) -> bool {
        !matches!(self, Self::Compiled | Self::Refused | Self::NoTokens)
    }
}

thread_local! {
    static PLACE: RefCell<Option<String>> = const { RefCell::new(None) };
}

/// Panics are recorded with their place and not printed; for the whole process.
pub fn record_panics() {
    panic::set_hook(Box::new(|info| {
        let place = info.location().map_or_else(|| "somewhere".to_owned(), ToString::to_string);
        PLACE.with(|slot| *slot.borrow_mut() = Some(place));
    }));
}

/// Compiles in a thread of its own, whose stack is as large as rustc's. A thread
/// that is too slow is left behind.
pub fn judge(text: &str, limit: Duration) -> Verdict {
    let (sender, receiver) = mpsc::channel();
    let text = text.to_owned();
    let work = move || {
        let verdict = panic::catch_unwind(|| compile(&text));
        let place = PLACE.with(|slot| slot.borrow_mut().take()).unwrap_or_default();
        // Nobody listens any more if it was too slow.
        let _ = sender.send(verdict.unwrap_or(Verdict::Panicked(place)));
    };
    if let Err(error) = thread::Builder::new().stack_size(STACK).spawn(work) {
        return Verdict::Internal(format!("no thread: {error}"));
    }
    receiver.recv_timeout(limit).unwrap_or(Verdict::TooSlow)
}

fn compile(text: &str) -> Verdict {
    let Some(tokens) = tokens(text) else { return Verdict::NoTokens };
    match mbs_codegen::compile(tokens) {
        Err(errors) if errors.is_empty() => Verdict::Internal("refused without a word".to_owned()),
        Err(errors) => {
            let internal = errors.iter().find(|error| error.message.starts_with("internal"));
            match internal {
                Some(error) => Verdict::Internal(error.message.clone()),
                None => {
                    errors.to_compile_errors();
                    Verdict::Refused
                }
            }
        }
        Ok(code) => match syn::parse2::<syn::File>(code) {
            Err(error) => Verdict::WrongCode(error.to_string()),
            Ok(file) => match twice(&file) {
                Some(name) => Verdict::WrongCode(format!("`{name}` twice")),
                None => Verdict::Compiled,
            },
        },
    }
}

/// A struct that is defined twice, or one of its fields.
fn twice(file: &syn::File) -> Option<String> {
    let mut structs = BTreeSet::new();
    for item in &file.items {
        let syn::Item::Struct(item) = item else { continue };
        if !structs.insert(item.ident.to_string()) {
            return Some(item.ident.to_string());
        }
        let mut fields = BTreeSet::new();
        for name in item.fields.iter().filter_map(|field| field.ident.as_ref()) {
            if !fields.insert(name.to_string()) {
                return Some(format!("{}.{name}", item.ident));
            }
        }
    }
    None
}
