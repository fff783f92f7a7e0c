//! Numbers out of buffers.

use super::super::{ParseError, Place};
use super::document::{Accessor, Document};
use super::get;

const UNSIGNED_BYTE: u32 = 5121;
const UNSIGNED_SHORT: u32 = 5123;
const UNSIGNED_INT: u32 = 5125;
const FLOAT: u32 = 5126;

/// The accessors of a document with the buffers they look into.
pub(super) struct Accessors<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a [Vec<u8>],
}

impl Accessors<'_> {
    /// Positions: vectors of three single-precision numbers.
    pub(super) fn positions(&self, index: usize) -> Result<Vec<[f64; 3]>, ParseError> {
        let accessor = get(&self.document.accessors, index, "accessor")?;
        if accessor.shape != "VEC3" || accessor.component_type != FLOAT {
            return Err(ParseError::Unsupported {
                feature: "positions other than vectors of floats".to_owned(),
                remedy: "export it without quantization",
            });
        }
        let float = |b: &[u8]| f64::from(f32::from_le_bytes([b[0], b[1], b[2], b[3]]));
        let items = self.items(index, accessor, 12)?;
        Ok(items
            .map(|b| [float(b), float(&b[4..]), float(&b[8..])])
            .collect())
    }

    /// Vertex numbers: unsigned integers of one, two or four bytes.
    pub(super) fn indices(&self, index: usize) -> Result<Vec<u32>, ParseError> {
        let accessor = get(&self.document.accessors, index, "accessor")?;
        let items = |size| self.items(index, accessor, size);
        match (accessor.shape.as_str(), accessor.component_type) {
            ("SCALAR", UNSIGNED_BYTE) => Ok(items(1)?.map(|b| u32::from(b[0])).collect()),
            ("SCALAR", UNSIGNED_SHORT) => Ok(items(2)?
                .map(|b| u32::from(u16::from_le_bytes([b[0], b[1]])))
                .collect()),
            ("SCALAR", UNSIGNED_INT) => Ok(items(4)?
                .map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]]))
                .collect()),
            (shape, kind) => {
                let reason =
                    format!("accessor {index} of type {shape} {kind} cannot hold vertex numbers");
                Err(ParseError::at(Place::File, reason))
            }
        }
    }

    /// The items of an accessor, `size` bytes each.
    fn items(
        &self,
        index: usize,
        accessor: &Accessor,
        size: usize,
    ) -> Result<impl Iterator<Item = &[u8]>, ParseError> {
        let bad = |reason: &str| ParseError::at(Place::File, format!("accessor {index} {reason}"));
        if accessor.sparse.is_some() {
            let feature = format!("sparse storage (accessor {index})");
            return Err(ParseError::Unsupported {
                feature,
                remedy: "export plain meshes without morph targets",
            });
        }
        let view = accessor
            .buffer_view
            .ok_or_else(|| bad("has no buffer view"))?;
        let view = get(&self.document.buffer_views, view, "buffer view")?;
        let stride = view.byte_stride.unwrap_or(size);
        if stride < size {
            return Err(bad("has items that overlap"));
        }
        let buffer = get(self.buffers, view.buffer, "buffer")?;
        let bytes = slice(buffer, view.byte_offset, view.byte_length)
            .and_then(|view| {
                slice(
                    view,
                    accessor.byte_offset,
                    span(accessor.count, stride, size)?,
                )
            })
            .ok_or_else(|| bad("reaches beyond its buffer"))?;
        // The last item may lack the padding of the others.
        Ok(bytes.chunks(stride).map(move |item| &item[..size]))
    }
}

/// Bytes from the first of `count` items to the end of the last, if that can be a number.
fn span(count: usize, stride: usize, size: usize) -> Option<usize> {
    match count.checked_sub(1) {
        None => Some(0),
        Some(steps) => steps.checked_mul(stride)?.checked_add(size),
    }
}

fn slice(bytes: &[u8], offset: usize, length: usize) -> Option<&[u8]> {
    bytes.get(offset..offset.checked_add(length)?)
}
