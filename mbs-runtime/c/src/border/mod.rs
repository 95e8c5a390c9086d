//! The border to C, with every `unsafe` of this crate.
//!
//! A function of the interface takes its pointers as values of the types below, each as large as the pointer that it
//! is. Nothing in Rust can make such a value: their fields are private, and there is no constructor. They come from a
//! call through the C interface, whose caller has promised the contract of `mbs.h`, to which the proofs refer:
//!
//! 1. a handle is NULL, or was given by this library, is of its type, and was not freed; a run is used by one thread
//!    at a time;
//! 2. a text is NULL, or ends with a NUL character and does not change during the call;
//! 3. an array is NULL, or has room for as many numbers as the count beside it says; what is read holds numbers, and
//!    does not change during the call;
//! 4. a pointer to a result is NULL, or points to memory that may be written.
//!
//! Their lifetime is that of the call: a function is written for every lifetime, so that no reference outlasts it.
//!
//! Results are computed in memory of the library and copied out. So arrays of the caller may overlap, need
//! no alignment, and are never a reference.
#![allow(
    unsafe_code,
    reason = "pointers from C can be used in no other way; the contract of the header is the proof"
)]

use std::ffi::{CStr, c_char};
use std::marker::PhantomData;
use std::ptr;

use crate::status::{Failure, Status};

/// A type that has handles.
pub trait Handle {
    /// The name of the type in messages.
    const NAME: &'static str;
}

/// A handle that is only looked at.
#[repr(transparent)]
pub struct Shared<'a, T>(*const T, PhantomData<&'a T>);

impl<'a, T: Handle> Shared<'a, T> {
    /// The value that the handle stands for.
    ///
    /// # Errors
    /// It is NULL.
    pub fn get(self) -> Result<&'a T, Failure> {
        // SAFETY: By 1 the pointer is NULL, for which there is no reference, or it was made by `Place::put_handle` from
        // a box of this type that was not freed, so it is aligned and points to a value. Nothing changes the value
        // during the call: a mechanism is never borrowed exclusively, and a run by this thread alone, which is here.
        unsafe { self.0.as_ref() }.ok_or_else(|| Failure::null(T::NAME))
    }
}

/// A handle of something that changes.
#[repr(transparent)]
pub struct Exclusive<'a, T>(*mut T, PhantomData<&'a mut T>);

impl<'a, T: Handle> Exclusive<'a, T> {
    /// The value that the handle stands for.
    ///
    /// # Errors
    /// It is NULL.
    pub fn get(self) -> Result<&'a mut T, Failure> {
        // SAFETY: As for `Shared`. The reference is the only one: what is handed over so is used by one thread at a
        // time (1), which is in this call, and no function of the interface takes two handles of one type.
        unsafe { self.0.as_mut() }.ok_or_else(|| Failure::null(T::NAME))
    }
}

/// A handle that is given back.
#[repr(transparent)]
pub struct Owned<T>(*mut T);

impl<T: Handle> Owned<T> {
    /// Frees it; nothing is done for NULL.
    pub fn free(self) {
        if !self.0.is_null() {
            // SAFETY: By 1 the pointer was made by `Place::put_handle` from a box of this type and was not freed, so
            // it is the box's own, and nobody else has it or will use it.
            drop(unsafe { Box::from_raw(self.0) });
        }
    }
}

/// A text.
#[repr(transparent)]
pub struct Text<'a>(*const c_char, PhantomData<&'a c_char>);

impl<'a> Text<'a> {
    /// The text, if one is given; `what` is what messages call it.
    ///
    /// # Errors
    /// It is no UTF-8.
    pub fn optional(self, what: &str) -> Result<Option<&'a str>, Failure> {
        if self.0.is_null() {
            return Ok(None);
        }
        // SAFETY: The pointer is not NULL, so by 2 it points to characters up to a NUL, which do not change while the
        // call lasts.
        let text = unsafe { CStr::from_ptr(self.0) };
        text.to_str().map(Some).map_err(|error| {
            Failure::new(Status::Utf8, format!("`{what}` is no UTF-8 from byte {} on", error.valid_up_to()))
        })
    }

    /// The text.
    ///
    /// # Errors
    /// It is NULL, or no UTF-8.
    pub fn get(self, what: &str) -> Result<&'a str, Failure> {
        self.optional(what)?.ok_or_else(|| Failure::null(what))
    }
}

/// An array of numbers that is read.
#[repr(transparent)]
pub struct Numbers<'a>(*const f64, PhantomData<&'a f64>);

impl Numbers<'_> {
    /// As many numbers as there are to be.
    ///
    /// # Errors
    /// `count`, which the caller says, is not `expected`; it is NULL.
    pub fn read(self, what: &str, count: usize, expected: usize) -> Result<Vec<f64>, Failure> {
        has_count(what, count, expected)?;
        if self.0.is_null() && count > 0 {
            return Err(Failure::null(what));
        }
        // SAFETY: The pointer is not NULL where there is an index, so by 3 there are `count` numbers at it, which do
        // not change now. They are read one by one and need not be aligned. An array in memory is no larger than
        // `isize::MAX` bytes, so that offsets in it are in bounds.
        Ok((0..count).map(|at| unsafe { self.0.add(at).read_unaligned() }).collect())
    }
}

/// An array of numbers that is written.
#[repr(transparent)]
pub struct NumbersOut<'a>(*mut f64, PhantomData<&'a mut f64>);

impl<'a> NumbersOut<'a> {
    /// Room for as many numbers as there are to be.
    ///
    /// # Errors
    /// As [`Numbers::read`].
    pub fn ready(self, what: &str, count: usize, expected: usize) -> Result<Room<'a>, Failure> {
        has_count(what, count, expected)?;
        if self.0.is_null() && count > 0 {
            return Err(Failure::null(what));
        }
        Ok(Room { pointer: self.0, count, call: PhantomData })
    }
}

/// Room in an array of the caller. Its pointer is not NULL unless `count` is 0, and there are `count` numbers at it.
pub struct Room<'a> {
    pointer: *mut f64,
    count: usize,
    call: PhantomData<&'a mut f64>,
}

impl Room<'_> {
    /// Writes the numbers, of which there are as many as there is room for.
    pub fn put(self, numbers: &[f64]) {
        let count = self.count.min(numbers.len());
        if count > 0 {
            let bytes = count * size_of::<f64>();
            // SAFETY: There are `count` numbers to read, which are borrowed. The pointer is not NULL since `count` is
            // not 0, so by 3 there is room for `count` numbers, which is written byte by byte and need not be aligned.
            // No reference to that memory exists, since it is the caller's, and it may overlap other results.
            unsafe { ptr::copy(numbers.as_ptr().cast::<u8>(), self.pointer.cast::<u8>(), bytes) };
        }
    }
}

fn has_count(what: &str, count: usize, expected: usize) -> Result<(), Failure> {
    if count == expected {
        return Ok(());
    }
    let message = format!("`{what}` has {count} numbers, but there have to be {expected}");
    Err(Failure::new(Status::Count, message))
}

/// Where a result goes.
#[repr(transparent)]
pub struct Out<'a, T>(*mut T, PhantomData<&'a mut T>);

impl<'a, T> Out<'a, T> {
    /// The place of the result.
    ///
    /// # Errors
    /// It is NULL.
    pub fn ready(self, what: &str) -> Result<Place<'a, T>, Failure> {
        if self.0.is_null() { Err(Failure::null(what)) } else { Ok(Place(self.0, PhantomData)) }
    }
}

/// The place of a result, which is not NULL.
pub struct Place<'a, T>(*mut T, PhantomData<&'a mut T>);

impl<T: Copy> Place<'_, T> {
    /// Writes the result.
    pub fn put(&mut self, result: T) {
        // SAFETY: The pointer is not NULL, so by 4 it points to memory that may be written. It need not be aligned, and
        // what stands there is not looked at; a result is `Copy`, so there is nothing to drop.
        unsafe { self.0.write_unaligned(result) };
    }
}

impl<T> Place<'_, *mut T> {
    /// Writes a new handle of what is made, or NULL where that fails or panics.
    ///
    /// # Errors
    /// Those of making it.
    pub fn put_handle(&mut self, make: impl FnOnce() -> Result<T, Failure>) -> Result<(), Failure> {
        self.put(ptr::null_mut());
        self.put(Box::into_raw(Box::new(make()?)));
        Ok(())
    }
}

#[cfg(test)]
mod tests;
