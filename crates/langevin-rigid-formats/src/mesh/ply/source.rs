//! The numbers of a PLY file one after another, in any encoding.

use super::super::{ParseError, Place};
use super::header::{Encoding, Kind, Scalar};
use super::whole;

/// A place in the body of the file.
pub(super) struct Source<'a> {
    encoding: Encoding,
    bytes: &'a [u8],
    at: usize,
    /// Line of `at`, for text.
    line: usize,
}

impl<'a> Source<'a> {
    /// The body of a file that begins at byte `at` after a header of so many lines.
    pub(super) fn new(encoding: Encoding, bytes: &'a [u8], at: usize, lines: usize) -> Source<'a> {
        Source {
            encoding,
            bytes,
            at,
            line: lines + 1,
        }
    }

    /// An error at the present place.
    pub(super) fn error(&self, reason: String) -> ParseError {
        let place = match self.encoding {
            Encoding::Text => Place::Line(self.line),
            _ => Place::Byte(self.at),
        };
        ParseError::at(place, reason)
    }

    /// The next number.
    pub(super) fn scalar(&mut self, scalar: Scalar) -> Result<f64, ParseError> {
        if self.encoding == Encoding::Text {
            return self.text_number();
        }
        Ok(match scalar {
            Scalar::I8 => f64::from(i8::from_le_bytes(self.take()?)),
            Scalar::U8 => f64::from(u8::from_le_bytes(self.take()?)),
            Scalar::I16 => f64::from(i16::from_le_bytes(self.take()?)),
            Scalar::U16 => f64::from(u16::from_le_bytes(self.take()?)),
            Scalar::I32 => f64::from(i32::from_le_bytes(self.take()?)),
            Scalar::U32 => f64::from(u32::from_le_bytes(self.take()?)),
            Scalar::F32 => f64::from(f32::from_le_bytes(self.take()?)),
            Scalar::F64 => f64::from_le_bytes(self.take()?),
        })
    }

    /// Passes the numbers of a property to `each`: the entries of a list, or the one number.
    pub(super) fn list(&mut self, kind: Kind, mut each: impl FnMut(f64)) -> Result<(), ParseError> {
        let (count, entry) = match kind {
            Kind::Scalar(scalar) => (1, scalar),
            Kind::List(count, entry) => {
                let count = self.scalar(count)?;
                let broken = || self.error(format!("a list cannot have {count} entries"));
                (whole(count).ok_or_else(broken)?, entry)
            }
        };
        for _ in 0..count {
            each(self.scalar(entry)?);
        }
        Ok(())
    }

    /// The next bytes in little-endian order.
    fn take<const N: usize>(&mut self) -> Result<[u8; N], ParseError> {
        let Some(next) = self.bytes[self.at..].first_chunk::<N>() else {
            return Err(self.error("the file ends too early".to_owned()));
        };
        self.at += N;
        let mut bytes = *next;
        if self.encoding == Encoding::BigEndian {
            bytes.reverse();
        }
        Ok(bytes)
    }

    fn text_number(&mut self) -> Result<f64, ParseError> {
        while let Some(b) = self.bytes.get(self.at).filter(|b| b.is_ascii_whitespace()) {
            self.line += usize::from(*b == b'\n');
            self.at += 1;
        }
        let rest = &self.bytes[self.at..];
        let length = rest
            .iter()
            .position(u8::is_ascii_whitespace)
            .unwrap_or(rest.len());
        if length == 0 {
            return Err(self.error("the file ends too early".to_owned()));
        }
        let word = String::from_utf8_lossy(&rest[..length]);
        let number = word
            .parse()
            .map_err(|_| self.error(format!("`{word}` is not a number")))?;
        self.at += length;
        Ok(number)
    }
}
