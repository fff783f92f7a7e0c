//! What was linked.

use std::ffi::{CStr, c_char};

/// Version of this interface: it changes when a struct or a function does so that programs must be compiled again.
pub const LR_ABI_VERSION: u32 = 1;

const VERSION: &CStr =
    match CStr::from_bytes_with_nul(concat!(env!("CARGO_PKG_VERSION"), "\0").as_bytes()) {
        Ok(version) => version,
        Err(_) => panic!("the version has a NUL in it"),
    };

/// Version of the library, such as "0.1.0". The text is the library's and lasts.
#[unsafe(no_mangle)]
pub extern "C" fn lr_version() -> *const c_char {
    VERSION.as_ptr()
}

/// `LR_ABI_VERSION` of the library that was linked: a program that loads it compares this with the one of its header.
#[unsafe(no_mangle)]
pub extern "C" fn lr_abi_version() -> u32 {
    LR_ABI_VERSION
}
