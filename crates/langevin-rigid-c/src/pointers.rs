//! From the pointers of C to references and back: the only reads and writes through them.
//!
//! Each function is called with a pointer that, unless it is refused here, its caller has from C with the promises at the
//! head of the header.

use std::ffi::{CStr, c_char};

use crate::status::Error;

fn check<T>(pointer: *const T, name: &'static str) -> Result<(), Error> {
    if pointer.is_null() {
        return Err(Error::Null(name));
    }
    if !pointer.is_aligned() {
        return Err(Error::Unaligned(name));
    }
    Ok(())
}

/// What is only read.
///
/// # Safety
/// What it points to is alive and not written to while `'a` lasts.
pub(crate) unsafe fn shared<'a, T>(pointer: *const T, name: &'static str) -> Result<&'a T, Error> {
    check(pointer, name)?;
    // SAFETY: it is aligned and not NULL; the rest is promised.
    Ok(unsafe { &*pointer })
}

/// What is written to.
///
/// # Safety
/// What it points to is alive and nobody else's while `'a` lasts.
pub(crate) unsafe fn exclusive<'a, T>(
    pointer: *mut T,
    name: &'static str,
) -> Result<&'a mut T, Error> {
    check(pointer, name)?;
    // SAFETY: it is aligned and not NULL; the rest is promised.
    Ok(unsafe { &mut *pointer })
}

/// Where a result goes that is not there yet.
///
/// # Safety
/// There is room for a `T`.
pub(crate) unsafe fn put<T>(out: *mut T, name: &'static str, value: T) -> Result<(), Error> {
    check(out, name)?;
    // SAFETY: it is aligned and not NULL; the rest is promised. What was there is not read.
    unsafe { out.write(value) };
    Ok(())
}

/// Makes a handle; where that fails, the handle is NULL.
///
/// # Safety
/// There is room for a pointer.
pub(crate) unsafe fn put_new<T>(
    out: *mut *mut T,
    made: impl FnOnce() -> Result<T, Error>,
) -> Result<(), Error> {
    // SAFETY: as promised.
    unsafe { put(out, "out", std::ptr::null_mut()) }?;
    let made = Box::new(made()?);
    // SAFETY: as promised.
    unsafe { put(out, "out", Box::into_raw(made)) }
}

/// Frees a handle; NULL is none.
///
/// # Safety
/// It is NULL or from [`put_new`], and was not freed before.
pub(crate) unsafe fn free<T>(handle: *mut T) {
    if !handle.is_null() {
        // SAFETY: as promised.
        drop(unsafe { Box::from_raw(handle) });
    }
}

fn check_count<T>(pointer: *const T, count: usize, name: &'static str) -> Result<(), Error> {
    check(pointer, name)?;
    if count.saturating_mul(size_of::<T>()) > isize::MAX as usize {
        return Err(Error::Argument {
            name: "the count",
            value: count.to_string(),
            wanted: "how many there are in memory",
        });
    }
    Ok(())
}

/// As many as `count`, to read. NULL will do for none.
///
/// # Safety
/// As [`shared`], for all of them.
pub(crate) unsafe fn shared_many<'a, T>(
    pointer: *const T,
    count: usize,
    name: &'static str,
) -> Result<&'a [T], Error> {
    if count == 0 {
        return Ok(&[]);
    }
    check_count(pointer, count, name)?;
    // SAFETY: it is aligned, not NULL and of a possible size; the rest is promised.
    Ok(unsafe { std::slice::from_raw_parts(pointer, count) })
}

/// As many as `count`, to write to. NULL will do for none.
///
/// # Safety
/// As [`exclusive`], for all of them.
pub(crate) unsafe fn exclusive_many<'a, T>(
    pointer: *mut T,
    count: usize,
    name: &'static str,
) -> Result<&'a mut [T], Error> {
    if count == 0 {
        return Ok(&mut []);
    }
    check_count(pointer, count, name)?;
    // SAFETY: it is aligned, not NULL and of a possible size; the rest is promised.
    Ok(unsafe { std::slice::from_raw_parts_mut(pointer, count) })
}

/// A path, in UTF-8.
///
/// # Safety
/// It ends with a NUL, and is not written to while `'a` lasts.
pub(crate) unsafe fn path<'a>(pointer: *const c_char) -> Result<&'a str, Error> {
    check(pointer, "path")?;
    // SAFETY: it is not NULL; the rest is promised.
    let text = unsafe { CStr::from_ptr(pointer) };
    text.to_str().map_err(|_| Error::Argument {
        name: "the path",
        value: format!("`{}`", text.to_string_lossy()),
        wanted: "in UTF-8",
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_pointer_no_alignment_and_no_such_size_are_refused() {
        let number = 1.0_f64;
        let askew = (&raw const number)
            .cast::<u8>()
            .wrapping_add(1)
            .cast::<f64>();
        // SAFETY: each is refused, or points to `number`.
        unsafe {
            assert!(matches!(
                shared(std::ptr::null::<f64>(), "x"),
                Err(Error::Null("x"))
            ));
            assert!(matches!(shared(askew, "x"), Err(Error::Unaligned("x"))));
            let many = shared_many(&raw const number, usize::MAX / 8, "x");
            assert!(matches!(
                many,
                Err(Error::Argument {
                    name: "the count",
                    ..
                })
            ));
            assert_eq!(shared_many(&raw const number, 1, "x").unwrap(), [1.0]);
            assert!(
                shared_many(std::ptr::null::<f64>(), 0, "x")
                    .unwrap()
                    .is_empty()
            );
            assert!(matches!(
                path(c"\xff".as_ptr()),
                Err(Error::Argument {
                    name: "the path",
                    ..
                })
            ));
        }
    }
}
