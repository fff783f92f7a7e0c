//! Collada 1.4 and 1.5: the triangles of the scene, in the pose the file is in.
//!
//! Entities and document types are not expanded, nothing outside the file is read. Every reference, count and
//! number is checked before it is used. Axes stay as they are in the file, whichever points up.

mod controller;
mod document;
mod geometry;
mod placement;
mod scene;
mod source;
#[cfg(test)]
mod tests;
mod xml;

use super::unit::FileUnit;
use super::{ParseError, RawMesh, text};
use document::Document;
use scene::Scene;

/// Reads what the scene shows, in the file's unit of length, and that unit.
pub(super) fn parse(bytes: &[u8]) -> Result<(RawMesh, FileUnit), ParseError> {
    let file = text::decode(bytes);
    let tree = xml::parse(&file.text)?;
    let document = Document::new(&tree, bytes.len() as u64)?;
    let unit = document.unit()?;
    let mut mesh = Scene::read(&document)?.mesh()?;
    mesh.notices.splice(0..0, file.notices);
    mesh.notices.extend(document.notices());
    Ok((mesh, unit))
}
