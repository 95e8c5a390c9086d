//! The guard around every function of the interface.
//!
//! It writes exported functions around safe bodies, keeps the error for `mbs_error` (`last`), and makes a
//! status of a panic.

use std::panic::{AssertUnwindSafe, catch_unwind};

use crate::last;
use crate::status::{Failure, Status};

/// The status of what a function does. An error is kept for `mbs_error`, and a panic is one.
///
/// A panic is a mistake of this library. The header has a run or mechanism freed after it, which any value of Rust can
/// be, so that it does not matter in which state it was left.
pub fn guarded(work: impl FnOnce() -> Result<(), Failure>) -> Status {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => Status::Ok,
        Ok(Err(failure)) => last::keep(failure),
        Err(panic) => {
            let text = panic.downcast_ref::<&str>().copied();
            let text = text.or_else(|| panic.downcast_ref::<String>().map(String::as_str));
            let message = format!("a mistake of the library: {}", text.unwrap_or("no words"));
            // what is dropped may panic again, and so on
            if let Err(again) = catch_unwind(AssertUnwindSafe(|| drop(panic))) {
                std::mem::forget(again);
            }
            last::keep(Failure::new(Status::Internal, message))
        }
    }
}

/// Writes functions of the C interface, which `mbs.h` documents. The body of one gives results or a
/// [`Failure`], and cannot be `unsafe`; a panic in it is a status.
macro_rules! export {
    ($(fn $name:ident($($argument:ident: $kind:ty),* $(,)?) $body:block)*) => {$(
        #[doc = concat!("`", stringify!($name), "` of the header.")]
        #[allow(unsafe_code, reason = "the symbol is to have this name; no other library has names with `mbs_`")]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name($($argument: $kind),*) -> std::ffi::c_int {
            #[deny(unsafe_code)]
            fn body($($argument: $kind),*) -> Result<(), $crate::status::Failure> {
                $body
            }
            $crate::guard::guarded(move || body($($argument),*)) as std::ffi::c_int
        }
    )*};
}

/// The same of functions that cannot fail; `else` is what they give if they panic all the same.
macro_rules! export_plain {
    ($(fn $name:ident($($argument:ident: $kind:ty),* $(,)?) -> $result:ty $body:block else $otherwise:expr;)*) => {$(
        #[doc = concat!("`", stringify!($name), "` of the header.")]
        #[allow(unsafe_code, reason = "the symbol is to have this name; no other library has names with `mbs_`")]
        #[unsafe(no_mangle)]
        pub extern "C" fn $name($($argument: $kind),*) -> $result {
            #[deny(unsafe_code)]
            fn body($($argument: $kind),*) -> $result {
                $body
            }
            let mut result = $otherwise;
            $crate::guard::guarded(|| {
                result = body($($argument),*);
                Ok(())
            });
            result
        }
    )*};
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_status() {
        assert_eq!(guarded(|| Ok(())), Status::Ok);
        assert_eq!(guarded(|| panic!("two and {}", "two")), Status::Internal);
        assert_eq!(last::text().to_str(), Ok("a mistake of the library: two and two"));
        assert_eq!(guarded(|| panic!("plain")), Status::Internal);
        assert_eq!(last::text().to_str(), Ok("a mistake of the library: plain"));
        assert_eq!(guarded(|| std::panic::panic_any(1)), Status::Internal);
        assert_eq!(last::text().to_str(), Ok("a mistake of the library: no words"));
    }
}
