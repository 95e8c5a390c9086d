//! The last failure of each thread.

use std::cell::RefCell;
use std::ffi::{CStr, CString, c_char};

use crate::status::{Failure, Status};

/// A problem of a text that was not compiled, `mbs_problem` of the header.
#[derive(Clone, Copy, Debug)]
#[repr(C)]
pub struct Problem {
    /// The problem, in words.
    pub message: *const c_char,
    /// How to mend it, or nothing.
    pub help: *const c_char,
    /// The line from 1, or 0.
    pub line: usize,
    /// The column from 1, or 0.
    pub column: usize,
    /// How many characters.
    pub length: usize,
}

/// The last failure, with texts that C can read.
struct Last {
    text: CString,
    problems: Vec<Texts>,
}

struct Texts {
    message: CString,
    help: CString,
    place: [usize; 3],
}

thread_local! {
    static LAST: RefCell<Option<Last>> = const { RefCell::new(None) };
}

/// A text for C, which cannot contain a NUL.
pub fn c_text(text: &str) -> CString {
    CString::new(text.replace('\0', "?")).unwrap_or_default()
}

/// Keeps a failure; its status.
pub fn keep(failure: Failure) -> Status {
    let Failure { status, message, problems } = failure;
    let texts = |problem: &mbs_live::Problem| Texts {
        message: c_text(&problem.message),
        help: c_text(problem.help.as_deref().unwrap_or_default()),
        place: problem.location.as_ref().map_or([0; 3], |at| [at.line, at.column, at.length]),
    };
    let last = Last { text: c_text(&message), problems: problems.iter().map(texts).collect() };
    // a thread that ends has nobody to ask
    let _ = LAST.try_with(|kept| kept.replace(Some(last)));
    status
}

/// The answer of `ask` about the last failure; `None` if there was none.
fn seen<T>(ask: impl FnOnce(&Last) -> T) -> Option<T> {
    LAST.try_with(|kept| kept.borrow().as_ref().map(ask)).ok().flatten()
}

/// The text of the last failure, which stays until the next.
pub fn pointer() -> *const c_char {
    seen(|last| last.text.as_ptr()).unwrap_or(c"".as_ptr())
}

/// The text of the last failure.
#[cfg(test)]
pub fn text() -> CString {
    seen(|last| last.text.clone()).unwrap_or_default()
}

/// How many problems it has.
pub fn problem_count() -> usize {
    seen(|last| last.problems.len()).unwrap_or(0)
}

/// One of its problems.
pub fn problem(index: usize) -> Option<Problem> {
    let problem = |texts: &Texts| {
        let Texts { message, help, place: [line, column, length] } = texts;
        let text = |text: &CStr| text.as_ptr();
        Problem { message: text(message), help: text(help), line: *line, column: *column, length: *length }
    };
    seen(|last| last.problems.get(index).map(problem)).flatten()
}
