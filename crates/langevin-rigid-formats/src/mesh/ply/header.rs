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
        for (index, line) in bytes.split_inclusive(|&b| b == b'\n').enumerate() {
            at += line.len();
            let number = index + 1;
            let bad = |reason: String| ParseError::at(Place::Line(number), reason);
            let line = String::from_utf8_lossy(line);
            let words: Vec<&str> = line.split_ascii_whitespace().collect();
            match words.as_slice() {
                ["ply"] if index == 0 => {}
                _ if index == 0 => return Err(bad("a PLY file begins with `ply`".to_owned())),
                ["end_header"] => {
                    let encoding =
                        encoding.ok_or_else(|| bad("the format line is missing".to_owned()))?;
                    return Ok((
                        Header {
                            encoding,
                            elements,
                            lines: number,
                        },
                        at,
                    ));
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
        "float" | "float32" => Ok(Scalar::F32),
        "double" | "float64" => Ok(Scalar::F64),
        _ => Err(format!("there is no PLY type `{name}`")),
    }
}
