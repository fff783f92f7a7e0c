//! What a call may come to, and what is said of a failure.

use std::cell::RefCell;
use std::ffi::{CString, c_char};
use std::panic::{AssertUnwindSafe, catch_unwind};

use langevin_rigid::wind::WindError;
use langevin_rigid::{BakeError, BodyError, SetupError, StepError};

/// What a call came to. `lr_last_error` says in words what was wrong and how to mend it.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum lr_status {
    /// All is well.
    Ok = 0,
    /// A pointer is NULL that must not be, or not aligned for what it points to.
    Pointer = 1,
    /// A number is not finite or out of its range, a size is too large, or a choice is none.
    Argument = 2,
    /// A file cannot be read.
    File = 3,
    /// The bytes are no bake, or a damaged one.
    Bake = 4,
    /// Body, fluid and settings do not go together.
    Setup = 5,
    /// The state that a step was to start from is impossible.
    State = 6,
    /// The step would have left the state infinite or faster than possible.
    Diverged = 7,
    /// A fault of the library; please report it.
    Internal = 8,
}

/// Why a call failed.
#[derive(Debug, thiserror::Error)]
pub(crate) enum Error {
    #[error("`{0}` is NULL; it must point to what its name says")]
    Null(&'static str),
    #[error(
        "`{0}` is not aligned for what it points to; take the address of a variable of its type"
    )]
    Unaligned(&'static str),
    #[error("{name} is {value}; it must be {wanted}")]
    Argument {
        name: &'static str,
        value: String,
        wanted: &'static str,
    },
    #[error("`{path}` cannot be read: {cause}")]
    File { path: String, cause: std::io::Error },
    #[error("`{path}`: {cause}")]
    BakeFile { path: String, cause: BakeError },
    #[error(transparent)]
    Bake(#[from] BakeError),
    #[error(transparent)]
    Body(#[from] BodyError),
    #[error(transparent)]
    Wind(#[from] WindError),
    #[error(transparent)]
    Setup(#[from] SetupError),
    #[error(transparent)]
    Step(#[from] StepError),
    #[error("state {index} (from 0): {cause}")]
    StepOfMany { index: usize, cause: StepError },
}

impl Error {
    fn status(&self) -> lr_status {
        match self {
            Self::Null(_) | Self::Unaligned(_) => lr_status::Pointer,
            Self::Argument { .. } | Self::Body(_) | Self::Wind(_) => lr_status::Argument,
            Self::File { .. } => lr_status::File,
            Self::BakeFile { .. } | Self::Bake(_) => lr_status::Bake,
            Self::Setup(_) => lr_status::Setup,
            Self::Step(cause) | Self::StepOfMany { cause, .. } => match cause {
                StepError::State { .. } => lr_status::State,
                StepError::Diverged { .. } => lr_status::Diverged,
                _ => lr_status::Argument,
            },
        }
    }
}

thread_local! {
    static LAST: RefCell<CString> = RefCell::default();
}

/// What was wrong with the last call of this thread that failed, in English; empty if none has. The text is the library's and
/// lasts until another call of this thread fails.
#[unsafe(no_mangle)]
pub extern "C" fn lr_last_error() -> *const c_char {
    LAST.with_borrow(|message| message.as_ptr())
}

fn remember(message: &str) {
    // A message may quote a path or a name, and no C text has a NUL within it.
    let message = CString::new(message.replace('\0', "\u{fffd}")).unwrap_or_default();
    LAST.set(message);
}

/// Runs a call: keeps the message of a failure, and lets no panic across the boundary.
pub(crate) fn call(work: impl FnOnce() -> Result<(), Error>) -> lr_status {
    match catch_unwind(AssertUnwindSafe(work)) {
        Ok(Ok(())) => lr_status::Ok,
        Ok(Err(error)) => {
            remember(&error.to_string());
            error.status()
        }
        Err(panic) => {
            let words = panic
                .downcast_ref::<&str>()
                .copied()
                .or_else(|| panic.downcast_ref::<String>().map(String::as_str));
            let words = words.unwrap_or("no message");
            remember(&format!(
                "a fault of the library, please report it: {words}"
            ));
            lr_status::Internal
        }
    }
}

#[cfg(test)]
mod tests {
    use std::ffi::CStr;

    use super::*;

    fn last() -> String {
        // SAFETY: the text lasts until the next failure of this thread.
        let message = unsafe { CStr::from_ptr(lr_last_error()) };
        message.to_str().unwrap().to_owned()
    }

    #[test]
    fn a_panic_becomes_a_status() {
        let number = 7;
        assert_eq!(call(|| panic!("broken")), lr_status::Internal);
        assert!(last().ends_with("broken"));
        assert_eq!(call(|| panic!("broken {number}")), lr_status::Internal);
        assert!(last().ends_with("broken 7"));
    }

    #[test]
    fn each_thread_has_its_own_message() {
        assert_eq!(call(|| Err(Error::Null("body"))), lr_status::Pointer);
        std::thread::scope(|scope| {
            scope.spawn(|| assert_eq!(last(), ""));
        });
        assert!(last().starts_with("`body` is NULL"));
        assert_eq!(call(|| Ok(())), lr_status::Ok);
        assert!(last().starts_with("`body` is NULL"));
    }
}
