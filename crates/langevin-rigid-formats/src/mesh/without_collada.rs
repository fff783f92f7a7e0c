//! What stands for the reader of Collada in a build without it.

use super::unit::FileUnit;
use super::{ParseError, RawMesh};

/// Refuses the file.
pub(super) fn parse(_: &[u8]) -> Result<(RawMesh, FileUnit), ParseError> {
    Err(ParseError::Unsupported {
        feature: "Collada, in a build without the feature `collada`".to_owned(),
        remedy: "build it with `collada`, or export glTF (.glb), OBJ or STL",
    })
}
