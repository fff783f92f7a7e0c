//! What `hashes.mjs` calls.
#![allow(
    unsafe_code,
    unreachable_pub,
    reason = "exported names are unsafe attributes, and of a private module"
)]

use std::sync::LazyLock;

use crate::{Line, lines};

/// Empty if a case failed.
static LINES: LazyLock<Vec<Line>> = LazyLock::new(|| lines().unwrap_or_default());

/// Number of lines.
#[unsafe(no_mangle)]
pub extern "C" fn count() -> usize {
    LINES.len()
}

/// The hash of a line, zero if there is none.
#[unsafe(no_mangle)]
pub extern "C" fn hash(line: usize) -> u64 {
    LINES.get(line).map_or(0, |line| line.hash)
}
