//! The tree of an XML file, for a time and memory that its length accounts for.

use roxmltree::{Document, Error};

use super::super::{ParseError, Place};

/// Most attributes of an element: each is compared with all the others.
const MOST_ATTRIBUTES: usize = 1000;
/// Most declarations of namespaces: elements are given all of those around them.
const MOST_NAMESPACES: usize = 1000;

/// Parses a file without a document type, so without entities of its own.
pub(super) fn parse(text: &str) -> Result<Document<'_>, ParseError> {
    if text.matches("xmlns:").count() > MOST_NAMESPACES {
        return Err(unusual("namespaces"));
    }
    if text.split('<').any(|tag| attributes(tag) > MOST_ATTRIBUTES) {
        return Err(unusual("attributes in one element"));
    }
    Document::parse(text).map_err(|error| match error {
        Error::DtdDetected => ParseError::Unsupported {
            feature: "a document type (`<!DOCTYPE ...>`)".to_owned(),
            remedy: "remove it: Collada has none",
        },
        error => ParseError::at(Place::Line(error.pos().row as usize), error.to_string()),
    })
}

/// Attributes of what follows a `<`, up to its `>`.
fn attributes(tag: &str) -> usize {
    if tag.starts_with(['!', '?', '/']) {
        return 0;
    }
    let mut quote = None;
    let mut found = 0;
    for byte in tag.bytes() {
        match (quote, byte) {
            (None, b'>') => break,
            (None, b'=') => found += 1,
            (None, b'"' | b'\'') => quote = Some(byte),
            (Some(open), _) if open == byte => quote = None,
            _ => {}
        }
    }
    found
}

fn unusual(what: &str) -> ParseError {
    ParseError::Unsupported {
        feature: format!("more than 1000 {what}"),
        remedy: "export it again with another program",
    }
}
