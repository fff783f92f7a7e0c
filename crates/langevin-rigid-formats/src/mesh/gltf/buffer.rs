//! Buffers: in the file, embedded as base64, or in files beside it.

use std::path::Path;

use super::super::ParseError;
use super::document::{Buffer, Document};

/// The bytes of every buffer, at least as many as the document says.
pub(super) fn load(
    document: &Document,
    chunk: Option<&[u8]>,
    folder: Option<&Path>,
) -> Result<Vec<Vec<u8>>, ParseError> {
    document
        .buffers
        .iter()
        .map(|buffer| load_one(buffer, chunk, folder))
        .collect()
}

fn load_one(
    buffer: &Buffer,
    chunk: Option<&[u8]>,
    folder: Option<&Path>,
) -> Result<Vec<u8>, ParseError> {
    let uri = buffer.uri.as_deref();
    let error = |reason: String| ParseError::Buffer {
        uri: shortened(uri),
        reason,
    };
    let bytes = match uri {
        None => chunk
            .ok_or_else(|| error("there is no binary chunk".to_owned()))?
            .to_vec(),
        Some(uri) => match uri.strip_prefix("data:") {
            Some(data) => {
                embedded(data).ok_or_else(|| error("its base64 text is broken".to_owned()))?
            }
            None => beside(uri, folder).map_err(error)?,
        },
    };
    if bytes.len() < buffer.byte_length {
        return Err(error(format!(
            "{} bytes instead of {}",
            bytes.len(),
            buffer.byte_length
        )));
    }
    Ok(bytes)
}

fn shortened(uri: Option<&str>) -> String {
    uri.map_or("(binary chunk)".to_owned(), |uri| {
        uri.chars().take(60).collect()
    })
}

/// The data of `[<media type>];base64,<text>`.
fn embedded(data: &str) -> Option<Vec<u8>> {
    let (kind, text) = data.split_once(',')?;
    kind.ends_with(";base64").then(|| base64(text)).flatten()
}

/// A file named relative to the folder, with percent-encoded characters.
fn beside(uri: &str, folder: Option<&Path>) -> Result<Vec<u8>, String> {
    let folder = folder.ok_or("the folder of the file is not known")?;
    let name = percent_decoded(uri).ok_or("its name is broken")?;
    if name.contains("://") || Path::new(&name).is_absolute() {
        return Err("only names relative to the file are read".to_owned());
    }
    std::fs::read(folder.join(name)).map_err(|error| error.to_string())
}

fn percent_decoded(uri: &str) -> Option<String> {
    let mut bytes = Vec::with_capacity(uri.len());
    let mut rest = uri.as_bytes();
    while let Some((&first, tail)) = rest.split_first() {
        if first == b'%' {
            let hex = std::str::from_utf8(tail.get(..2)?).ok()?;
            bytes.push(u8::from_str_radix(hex, 16).ok()?);
            rest = &tail[2..];
        } else {
            bytes.push(first);
            rest = tail;
        }
    }
    String::from_utf8(bytes).ok()
}

/// Decodes base64 (RFC 4648, section 4), the padding optional.
fn base64(text: &str) -> Option<Vec<u8>> {
    let text = text.trim_end_matches('=').as_bytes();
    let mut bytes = Vec::with_capacity(text.len() / 4 * 3 + 2);
    for group in text.chunks(4) {
        let mut bits = 0u32;
        for &letter in group {
            bits = bits << 6 | sextet(letter)?;
        }
        // A group of 2, 3, 4 letters holds 1, 2, 3 bytes, from the top of its 24 bits.
        let held = group.len().checked_sub(1).filter(|&n| n > 0)?;
        bits <<= 6 * (4 - group.len());
        bytes.extend_from_slice(&bits.to_be_bytes()[1..=held]);
    }
    Some(bytes)
}

fn sextet(letter: u8) -> Option<u32> {
    let value = match letter {
        b'A'..=b'Z' => letter - b'A',
        b'a'..=b'z' => letter - b'a' + 26,
        b'0'..=b'9' => letter - b'0' + 52,
        b'+' => 62,
        b'/' => 63,
        _ => return None,
    };
    Some(u32::from(value))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn base64_decodes_the_test_vectors_of_rfc_4648() {
        for (text, bytes) in [
            ("", ""),
            ("Zg==", "f"),
            ("Zm8=", "fo"),
            ("Zm9v", "foo"),
            ("Zm9vYg==", "foob"),
            ("Zm9vYmE=", "fooba"),
            ("Zm9vYmFy", "foobar"),
            ("Zm9vYg", "foob"),
        ] {
            assert_eq!(base64(text).as_deref(), Some(bytes.as_bytes()), "{text}");
        }
        assert_eq!(base64("Z"), None);
        assert_eq!(base64("Zm9*"), None);
    }

    #[test]
    fn names_are_percent_decoded() {
        assert_eq!(
            percent_decoded("a%20b%C3%A9.bin").as_deref(),
            Some("a bé.bin")
        );
        assert_eq!(percent_decoded("a%2"), None);
        assert_eq!(percent_decoded("a%zz"), None);
    }
}
