//! How many triangles a file may stand for.
//!
//! A scene can show one mesh over and over: a few kilobytes can stand for any number of triangles.

use super::ParseError;

/// Triangles that any file may have.
const ALWAYS: u64 = 1 << 20;
/// Triangles more for each of its bytes.
const PER_BYTE: u64 = 16;
/// Triangles that no file may have more of.
const MOST: u64 = 1 << 24;

/// Most triangles of a scene in a file of `size` bytes.
pub(super) fn most_triangles(size: u64) -> u64 {
    PER_BYTE
        .saturating_mul(size)
        .saturating_add(ALWAYS)
        .min(MOST)
}

/// The fault of a scene that has more.
pub(super) fn too_many(most: u64, size: u64) -> ParseError {
    ParseError::Unsupported {
        feature: format!(
            "more than {most} triangles (counted once for each node, instance and morph target that \
             shows them) in a file of {size} bytes"
        ),
        remedy: "export fewer copies or a coarser mesh",
    }
}
