//! Buffers and the views of them: in the file, embedded as base64, in files beside it, or compressed.

use std::borrow::Cow;
use std::cell::{Cell, OnceCell};
use std::path::Path;

use super::super::{ParseError, Place};
use super::document::{Buffer, BufferView, Document, Meshopt};
#[cfg(feature = "meshopt")]
use super::meshopt::decompress;
use super::{get, resource, shortened};

/// Bytes that may be made of compressed and sparse data of any size.
const ALWAYS_MADE: usize = 1 << 26;
/// Bytes more for each byte read.
const MOST_GROWTH: usize = 256;

/// The buffers of a document, each read when it is first used.
pub(super) struct Buffers<'a> {
    document: &'a Document,
    chunk: Option<&'a [u8]>,
    folder: Option<&'a Path>,
    buffers: Vec<OnceCell<Cow<'a, [u8]>>>,
    decompressed: Vec<OnceCell<Vec<u8>>>,
    /// Bytes of buffers in use, and bytes made of them.
    read: Cell<usize>,
    made: Cell<usize>,
}

impl<'a> Buffers<'a> {
    pub(super) fn new(
        document: &'a Document,
        chunk: Option<&'a [u8]>,
        folder: Option<&'a Path>,
    ) -> Buffers<'a> {
        Buffers {
            document,
            chunk,
            folder,
            buffers: vec![OnceCell::new(); document.buffers.len()],
            decompressed: vec![OnceCell::new(); document.buffer_views.len()],
            read: Cell::new(0),
            made: Cell::new(0),
        }
    }

    /// Bytes of the buffers used so far.
    pub(super) fn size(&self) -> usize {
        self.read.get()
    }

    /// The bytes of a view, and the view.
    pub(super) fn view(&self, index: usize) -> Result<(&[u8], &'a BufferView), ParseError> {
        let view = get(&self.document.buffer_views, index, "buffer view")?;
        let bytes = match view.meshopt() {
            Some(packed) => once(&self.decompressed[index], || self.decompress(packed))?,
            None => self.part(view.buffer, view.byte_offset, view.byte_length)?,
        };
        Ok((bytes, view))
    }

    fn decompress(&self, packed: &Meshopt) -> Result<Vec<u8>, ParseError> {
        let bytes = self.part(packed.buffer, packed.byte_offset, packed.byte_length)?;
        self.charge(packed.count.checked_mul(packed.byte_stride))?;
        decompress(bytes, packed)
    }

    /// Counts bytes that will be made, refusing more than the bytes read account for.
    pub(super) fn charge(&self, bytes: Option<usize>) -> Result<(), ParseError> {
        let most = MOST_GROWTH
            .saturating_mul(self.size())
            .saturating_add(ALWAYS_MADE);
        let made = bytes.and_then(|bytes| self.made.get().checked_add(bytes));
        let made = made.filter(|&made| made <= most).ok_or_else(|| {
            ParseError::at(
                Place::File,
                "its compressed or sparse data grow out of proportion",
            )
        })?;
        self.made.set(made);
        Ok(())
    }

    fn part(&self, index: usize, offset: usize, length: usize) -> Result<&[u8], ParseError> {
        let buffer = get(&self.document.buffers, index, "buffer")?;
        let bytes = once(&self.buffers[index], || self.load(index, buffer))?;
        slice(bytes, offset, length).ok_or_else(|| {
            let reason = format!("a buffer view reaches beyond buffer {index}");
            ParseError::at(Place::File, reason)
        })
    }

    fn load(&self, index: usize, buffer: &Buffer) -> Result<Cow<'a, [u8]>, ParseError> {
        let uri = buffer.uri.as_deref();
        let error = |reason: String| ParseError::Buffer {
            uri: shortened(uri),
            reason,
        };
        let bytes = match uri {
            None => {
                let chunk = self.chunk.filter(|_| index == 0);
                Cow::Borrowed(chunk.ok_or_else(|| error("there is no binary chunk".to_owned()))?)
            }
            Some(uri) => {
                let bytes = resource(uri, Some(buffer.byte_length), self.folder);
                Cow::Owned(bytes.map_err(error)?)
            }
        };
        if bytes.len() < buffer.byte_length {
            let reason = format!("{} bytes instead of {}", bytes.len(), buffer.byte_length);
            return Err(error(reason));
        }
        self.read.set(self.read.get().saturating_add(bytes.len()));
        Ok(bytes)
    }
}

/// The decoders are left out of this build.
#[cfg(not(feature = "meshopt"))]
fn decompress(_: &[u8], _: &Meshopt) -> Result<Vec<u8>, ParseError> {
    Err(ParseError::Unsupported {
        feature: "compression by meshoptimizer, in a build without the feature `meshopt`"
            .to_owned(),
        remedy: "build it with `meshopt`, or export it without compression",
    })
}

fn once<T>(
    cell: &OnceCell<T>,
    make: impl FnOnce() -> Result<T, ParseError>,
) -> Result<&T, ParseError> {
    match cell.get() {
        Some(value) => Ok(value),
        None => {
            let value = make()?;
            Ok(cell.get_or_init(|| value))
        }
    }
}

pub(super) fn slice(bytes: &[u8], offset: usize, length: usize) -> Option<&[u8]> {
    bytes.get(offset..offset.checked_add(length)?)
}
