//! Each type is given what C may give it. Small and without a mechanism, so that Miri follows it in no time.

use std::ptr::{null, null_mut};

use super::*;

/// Something that says when it is freed.
struct Bell<'a>(&'a std::cell::Cell<u32>);

impl Handle for Bell<'_> {
    const NAME: &'static str = "bell";
}

impl Drop for Bell<'_> {
    fn drop(&mut self) {
        self.0.set(self.0.get() + 1);
    }
}

fn message<T>(result: Result<T, Failure>) -> (Status, String) {
    result.map_or_else(|failure| (failure.status, failure.message), |_| (Status::Ok, String::new()))
}

#[test]
fn a_handle_is_made_looked_at_changed_and_freed() {
    let (rung, other) = (std::cell::Cell::new(0), std::cell::Cell::new(10));
    let mut handle: *mut Bell<'_> = ptr::dangling_mut();
    let mut place = Out(&raw mut handle, PhantomData).ready("bell").unwrap();
    assert_eq!(place.put_handle(|| Err(Failure::null("x"))).unwrap_err().status, Status::Null);
    assert!(handle.is_null());
    let mut place = Out(&raw mut handle, PhantomData).ready("bell").unwrap();
    place.put_handle(|| Ok(Bell(&rung))).unwrap();
    let look = || Shared(handle, PhantomData).get().unwrap().0.get();
    assert_eq!([look(), look()], [0, 0]);
    Exclusive(handle, PhantomData).get().unwrap().0 = &other;
    assert_eq!(look(), 10);
    Owned(handle).free();
    assert_eq!((rung.get(), other.get()), (0, 11));
    Owned::<Bell<'_>>(null_mut()).free();
    assert_eq!(message(Shared::<Bell<'_>>(null(), PhantomData).get()).1, "`bell` is NULL");
    assert_eq!(message(Exclusive::<Bell<'_>>(null_mut(), PhantomData).get()).0, Status::Null);
}

#[test]
fn texts_are_read_up_to_their_nul() {
    let bytes = *b"kurbel\0behind";
    assert_eq!(Text(bytes.as_ptr().cast(), PhantomData).get("text").unwrap(), "kurbel");
    assert_eq!(Text(c"".as_ptr(), PhantomData).get("text").unwrap(), "");
    assert_eq!(Text(null(), PhantomData).optional("text").unwrap(), None);
    assert_eq!(message(Text(null(), PhantomData).get("text")), (Status::Null, "`text` is NULL".into()));
    let wrong = message(Text(c"ab\xff".as_ptr(), PhantomData).get("text"));
    assert_eq!(wrong, (Status::Utf8, "`text` is no UTF-8 from byte 2 on".into()));
}

#[test]
fn numbers_are_copied_in_and_out_without_alignment() {
    let mut bytes = [0_u8; 33];
    let odd = bytes.as_mut_ptr().wrapping_add(1).cast::<f64>();
    let room = NumbersOut(odd, PhantomData).ready("numbers", 4, 4).unwrap();
    room.put(&[1.0, 2.0, 3.0, 4.0, 5.0]);
    let room = NumbersOut(odd, PhantomData).ready("numbers", 4, 4).unwrap();
    room.put(&[-1.0]);
    let read = Numbers(odd, PhantomData).read("numbers", 4, 4).unwrap();
    assert_eq!((read.as_slice(), bytes[0]), (&[-1.0, 2.0, 3.0, 4.0][..], 0));
    Out(odd, PhantomData).ready("number").unwrap().put(7.0);
    assert_eq!(Numbers(odd, PhantomData).read("numbers", 1, 1).unwrap(), [7.0]);
}

#[test]
fn memory_that_was_never_written_is_a_place() {
    let mut room = [const { std::mem::MaybeUninit::<f64>::uninit() }; 2];
    let pointer = room.as_mut_ptr().cast::<f64>();
    NumbersOut(pointer, PhantomData).ready("numbers", 2, 2).unwrap().put(&[1.0, 2.0]);
    Out(pointer, PhantomData).ready("number").unwrap().put(3.0);
    assert_eq!(Numbers(pointer, PhantomData).read("numbers", 2, 2).unwrap(), [3.0, 2.0]);
}

#[test]
fn wrong_counts_and_null_are_not_touched() {
    let number = 1.0;
    for count in [0, 2, usize::MAX] {
        let (status, text) = message(Numbers(&raw const number, PhantomData).read("numbers", count, 1));
        assert_eq!(
            (status, text),
            (Status::Count, format!("`numbers` has {count} numbers, but there have to be 1"))
        );
        assert_eq!(message(NumbersOut(null_mut(), PhantomData).ready("numbers", count, 1)).0, Status::Count);
    }
    assert_eq!(message(Numbers(null(), PhantomData).read("numbers", 1, 1)).0, Status::Null);
    assert_eq!(message(NumbersOut(null_mut(), PhantomData).ready("numbers", 1, 1)).0, Status::Null);
    assert_eq!(message(Out::<f64>(null_mut(), PhantomData).ready("number")).0, Status::Null);
    // nothing to read or write, and so no need of a place
    assert!(Numbers(null(), PhantomData).read("numbers", 0, 0).unwrap().is_empty());
    NumbersOut(null_mut(), PhantomData).ready("numbers", 0, 0).unwrap().put(&[]);
}
