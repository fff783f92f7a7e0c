//! glTF 2.0: the triangles of the default scene.
//!
//! Only what geometry needs is read. Every index, offset and length in the file is checked before
//! it is used, which the `gltf` crate leaves to its caller.

mod accessor;
mod buffer;
mod document;
mod node;

use std::path::Path;

use super::{ParseError, Place, RawMesh};
use accessor::Accessors;
use document::{Document, Primitive};
use node::Transform;

/// Most triangles taken from one scene, whose nodes can show one mesh over and over.
const MOST_TRIANGLES: usize = 1 << 24;

/// Reads a JSON file, with the binary chunk of a GLB file if there is one.
pub(super) fn parse(
    json: &[u8],
    chunk: Option<&[u8]>,
    folder: Option<&Path>,
) -> Result<RawMesh, ParseError> {
    let document: Document = serde_json::from_slice(json)
        .map_err(|error| ParseError::at(Place::Line(error.line()), error.to_string()))?;
    document.check()?;
    let buffers = buffer::load(&document, chunk, folder)?;
    let accessors = Accessors {
        document: &document,
        buffers: &buffers,
    };
    let mut mesh = RawMesh::default();
    for (index, transform) in node::placed_meshes(&document)? {
        let source = get(&document.meshes, index, "mesh")?;
        for (number, primitive) in source.primitives.iter().enumerate() {
            check_mode(primitive, index, number)?;
            add_primitive(&mut mesh, primitive, &accessors, &transform)?;
        }
    }
    Ok(mesh)
}

/// Reads a binary file: a header and two chunks, JSON and buffer.
pub(super) fn parse_glb(bytes: &[u8], folder: Option<&Path>) -> Result<RawMesh, ParseError> {
    let word = |at: usize| {
        let bytes = bytes.get(at..)?.first_chunk::<4>()?;
        Some(u32::from_le_bytes(*bytes))
    };
    if !bytes.starts_with(b"glTF") || word(4) != Some(2) {
        return Err(ParseError::at(
            Place::Byte(0),
            "this is not the header of a GLB file, version 2",
        ));
    }
    let chunk = |at: usize, kind: &[u8]| {
        let length = word(at)? as usize;
        let body = (bytes.get(at + 4..at + 8)? == kind).then_some(at + 8)?;
        bytes.get(body..body.checked_add(length)?)
    };
    let broken = || ParseError::at(Place::Byte(12), "the JSON chunk is missing or cut short");
    let json = chunk(12, b"JSON").ok_or_else(broken)?;
    parse(json, chunk(20 + json.len(), b"BIN\0"), folder)
}

/// The element of a list the file refers to by number.
fn get<'a, T>(list: &'a [T], index: usize, what: &str) -> Result<&'a T, ParseError> {
    let missing = || ParseError::at(Place::File, format!("there is no {what} {index}"));
    list.get(index).ok_or_else(missing)
}

fn check_mode(primitive: &Primitive, mesh: usize, number: usize) -> Result<(), ParseError> {
    let kind = match primitive.mode {
        4..=6 => return Ok(()),
        0 => "points",
        1..=3 => "lines",
        mode => {
            return Err(ParseError::at(
                Place::File,
                format!("there is no primitive mode {mode}"),
            ));
        }
    };
    Err(ParseError::UnsupportedPrimitive {
        mesh,
        primitive: number,
        kind,
    })
}

fn add_primitive(
    mesh: &mut RawMesh,
    primitive: &Primitive,
    accessors: &Accessors<'_>,
    transform: &Transform,
) -> Result<(), ParseError> {
    let Some(position) = primitive.attributes.position else {
        return Ok(());
    };
    let positions = accessors.positions(position)?;
    let count = positions.len() as u32;
    let corners = match primitive.indices {
        Some(indices) => accessors.indices(indices)?,
        None => (0..count).collect(),
    };
    if let Some(v) = corners.iter().find(|&&v| v >= count) {
        return Err(ParseError::at(
            Place::File,
            format!("a triangle has vertex {v}, there are {count}"),
        ));
    }
    let triangles = triangles(&corners, primitive.mode);
    if mesh.triangles.len() + triangles.len() > MOST_TRIANGLES
        || mesh.vertices.len() + positions.len() > 3 * MOST_TRIANGLES
    {
        let feature = format!("more than {MOST_TRIANGLES} triangles");
        return Err(ParseError::Unsupported {
            feature,
            remedy: "export a coarser mesh",
        });
    }
    let first = mesh.vertices.len() as u32;
    let turned = transform.mirrors();
    mesh.triangles
        .extend(triangles.into_iter().map(|[a, b, c]| {
            if turned {
                [first + a, first + c, first + b]
            } else {
                [first + a, first + b, first + c]
            }
        }));
    mesh.vertices
        .extend(positions.into_iter().map(|p| transform.apply(p)));
    Ok(())
}

/// Triangles of a list (mode 4), strip (5) or fan (6) of corners.
fn triangles(corners: &[u32], mode: u32) -> Vec<[u32; 3]> {
    match mode {
        4 => corners.as_chunks::<3>().0.to_vec(),
        5 => {
            let wound = |(i, w): (usize, &[u32])| {
                if i % 2 == 0 {
                    [w[0], w[1], w[2]]
                } else {
                    [w[0], w[2], w[1]]
                }
            };
            corners.windows(3).enumerate().map(wound).collect()
        }
        _ => super::fan(corners).collect(),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strips_wind_alternately_and_fans_share_a_corner() {
        assert_eq!(triangles(&[5, 6, 7, 8, 9, 10], 4), [[5, 6, 7], [8, 9, 10]]);
        assert_eq!(
            triangles(&[5, 6, 7, 8, 9], 5),
            [[5, 6, 7], [6, 8, 7], [7, 8, 9]]
        );
        assert_eq!(triangles(&[5, 6, 7, 8], 6), [[5, 6, 7], [5, 7, 8]]);
    }
}
