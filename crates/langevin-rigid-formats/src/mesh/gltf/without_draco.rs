//! What stands for the Draco decoder in a build without it.

use super::super::ParseError;

/// A primitive after decoding: there is none.
pub(super) enum Decoded {}

impl Decoded {
    pub(super) fn new(_: &[u8], _: usize, _: usize) -> Result<Decoded, ParseError> {
        Err(ParseError::Unsupported {
            feature: "compression by Draco, in a build without the feature `draco`".to_owned(),
            remedy: "build it with `draco`, or export it without compression",
        })
    }

    pub(super) fn corners(&self) -> Vec<u32> {
        match *self {}
    }

    pub(super) fn attribute(&self, _: u32, _: usize) -> Result<Vec<f32>, ParseError> {
        match *self {}
    }
}
