//! The numbers of a PLY file one after another, in any encoding.

use super::super::text::Numbers;
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
    numbers: Numbers,
    /// Whether every row of an element is a line of its own.
    by_line: bool,
    /// Values at the ends of lines that belong to no property.
    extra: usize,
}

impl<'a> Source<'a> {
    /// The body of a file that begins at byte `at` after a header of so many lines.
    pub(super) fn new(encoding: Encoding, bytes: &'a [u8], at: usize, lines: usize) -> Source<'a> {
        Source {
            encoding,
            bytes,
            at,
            line: lines + 1,
            numbers: Numbers::default(),
            by_line: false,
            extra: 0,
        }
    }

    /// The same for text with a row a line.
    pub(super) fn by_line(self) -> Source<'a> {
        Source {
            by_line: true,
            ..self
        }
    }

    /// The present place.
    pub(super) fn place(&self) -> Place {
        match self.encoding {
            Encoding::Text => Place::Line(self.line),
            _ => Place::Byte(self.at),
        }
    }

    /// An error at the present place.
    pub(super) fn error(&self, reason: String) -> ParseError {
        ParseError::at(self.place(), reason)
    }

    /// How far in the file.
    pub(super) fn position(&self) -> usize {
        self.at
    }

    /// Values passed over at the ends of lines.
    pub(super) fn extra(&self) -> usize {
        self.extra
    }

    /// What was tolerated in numbers.
    pub(super) fn notice(self) -> Option<String> {
        self.numbers.notice()
    }

    /// Goes to the line of the next row.
    pub(super) fn begin_row(&mut self) {
        if self.by_line {
            self.skip_space(true);
        }
    }

    /// Passes over what is left of a row's line.
    pub(super) fn end_row(&mut self) {
        while self.by_line && self.skip_space(false) {
            self.at += self.word_length();
            self.extra += 1;
        }
    }

    /// Whether there is nothing more.
    pub(super) fn is_at_end(&mut self) -> bool {
        match self.encoding {
            Encoding::Text => !self.skip_space(true),
            _ => self.at == self.bytes.len(),
        }
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
            Scalar::I64 => i64::from_le_bytes(self.take()?) as f64,
            Scalar::U64 => u64::from_le_bytes(self.take()?) as f64,
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
        if !self.skip_space(!self.by_line) {
            let reason = if self.at < self.bytes.len() {
                "the line has fewer values than its element has properties"
            } else {
                "the file ends too early"
            };
            return Err(self.error(reason.to_owned()));
        }
        let length = self.word_length();
        let word = String::from_utf8_lossy(&self.bytes[self.at..self.at + length]);
        let number = self.numbers.any(&word);
        let number = number.map_err(|reason| self.error(reason))?;
        self.at += length;
        Ok(number)
    }

    /// Goes to the next word, of this line or any; whether there is one.
    fn skip_space(&mut self, any_line: bool) -> bool {
        while let Some(&b) = self.bytes.get(self.at) {
            let ends_line = b == b'\n' || b == b'\r';
            if !b.is_ascii_whitespace() {
                return true;
            }
            if ends_line && !any_line {
                return false;
            }
            let first_of_two = b == b'\r' && self.bytes.get(self.at + 1) == Some(&b'\n');
            self.line += usize::from(ends_line && !first_of_two);
            self.at += 1;
        }
        false
    }

    fn word_length(&self) -> usize {
        let rest = &self.bytes[self.at..];
        let end = rest.iter().position(u8::is_ascii_whitespace);
        end.unwrap_or(rest.len())
    }
}
