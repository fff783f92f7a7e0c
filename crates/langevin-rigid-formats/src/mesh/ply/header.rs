//! The header of a PLY file.

use super::super::{ParseError, Place};

/// How the numbers after the header are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Encoding {
    Text,
    LittleEndian,
    BigEndian,
}

/// A type of number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Scalar {
    I8,
    U8,
    I16,
    U16,
    I32,
    U32,
    I64,
    U64,
    F32,
    F64,
}

/// A property's type: a number, or a list with the types of its count and its entries.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Kind {
    Scalar(Scalar),
    List(Scalar, Scalar),
}

#[derive(Debug)]
pub(super) struct Property {
    pub(super) name: String,
    pub(super) kind: Kind,
}

#[derive(Debug)]
pub(super) struct Element {
    pub(super) name: String,
    pub(super) count: u64,
    pub(super) properties: Vec<Property>,
}

#[derive(Debug)]
pub(super) struct Header {
    pub(super) encoding: Encoding,
    pub(super) elements: Vec<Element>,
    /// Number of lines of the header.
    pub(super) lines: usize,
}

impl Header {
    /// The header and the offset of the first byte after it.
    pub(super) fn parse(bytes: &[u8]) -> Result<(Header, usize), ParseError> {
        let (mut encoding, mut elements) = (None, Vec::new());
        let mut at = 0;
        let mut returns = None;
        for number in 1.. {
            if at == bytes.len() {
                break;
            }
            let (line, ending) = line(&bytes[at..]);
            at += line.len();
            // After a header whose lines end in CR, an LF is the first byte of the body.
            at += if returns == Some(true) {
                ending.len().min(1)
            } else {
                ending.len()
            };
            returns = returns.or(Some(ending == b"\r"));
            let bad = |reason: String| ParseError::at(Place::Line(number), reason);
            let line = String::from_utf8_lossy(line).to_ascii_lowercase();
            let words: Vec<&str> = line.split_ascii_whitespace().collect();
            match words.as_slice() {
                ["ply"] if number == 1 => {}
                _ if number == 1 => return Err(bad("a PLY file begins with `ply`".to_owned())),
                ["end_header"] => {
                    let encoding =
                        encoding.ok_or_else(|| bad("the format line is missing".to_owned()))?;
                    let lines = number;
                    let header = Header {
                        encoding,
                        elements,
                        lines,
                    };
                    return Ok((header, at));
                }
                ["comment" | "obj_info", ..] | [] => {}
                ["format", name, ..] => encoding = Some(format(name).map_err(bad)?),
                words => definition(words, &mut elements).map_err(bad)?,
            }
        }
        Err(ParseError::at(
            Place::Byte(bytes.len()),
            "the file ends before `end_header`",
        ))
    }
}

/// The first line and its end, which is LF, CR LF or CR.
fn line(bytes: &[u8]) -> (&[u8], &[u8]) {
    let is_end = |b: &u8| *b == b'\n' || *b == b'\r';
    let length = bytes.iter().position(is_end).unwrap_or(bytes.len());
    let (line, rest) = bytes.split_at(length);
    let ending = if rest.starts_with(b"\r\n") {
        2
    } else {
        rest.len().min(1)
    };
    (line, &rest[..ending])
}

fn format(name: &str) -> Result<Encoding, String> {
    match name {
        "ascii" => Ok(Encoding::Text),
        "binary_little_endian" => Ok(Encoding::LittleEndian),
        "binary_big_endian" => Ok(Encoding::BigEndian),
        _ => Err(format!("there is no PLY format `{name}`")),
    }
}

/// A line that begins an element or adds a property to the last.
fn definition(words: &[&str], elements: &mut Vec<Element>) -> Result<(), String> {
    let (name, kind) = match *words {
        ["element", name, count] => {
            let count = count
                .parse()
                .map_err(|_| format!("`{count}` is not a number of elements"))?;
            elements.push(Element {
                name: name.to_owned(),
                count,
                properties: vec![],
            });
            return Ok(());
        }
        ["property", "list", count, entry, name] => {
            (name, Kind::List(scalar(count)?, scalar(entry)?))
        }
        ["property", kind, name] => (name, Kind::Scalar(scalar(kind)?)),
        _ => {
            return Err(format!(
                "`{}` does not belong in a PLY header",
                words.join(" ")
            ));
        }
    };
    let element = elements.last_mut().ok_or("a property without an element")?;
    element.properties.push(Property {
        name: name.to_owned(),
        kind,
    });
    Ok(())
}

fn scalar(name: &str) -> Result<Scalar, String> {
    match name {
        "char" | "int8" => Ok(Scalar::I8),
        "uchar" | "uint8" => Ok(Scalar::U8),
        "short" | "int16" => Ok(Scalar::I16),
        "ushort" | "uint16" => Ok(Scalar::U16),
        "int" | "int32" => Ok(Scalar::I32),
        "uint" | "uint32" => Ok(Scalar::U32),
        "int64" | "long" => Ok(Scalar::I64),
        "uint64" | "ulong" => Ok(Scalar::U64),
        "float" | "float32" => Ok(Scalar::F32),
        "double" | "float64" => Ok(Scalar::F64),
        _ => Err(format!("there is no PLY type `{name}`")),
    }
}
