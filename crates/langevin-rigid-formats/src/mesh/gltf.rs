//! glTF 2.0: the triangles of the default scene, in the pose the file is in.
//!
//! Only what geometry needs is read. Every index, offset and length in the file is checked before
//! it is used, which the `gltf` crate leaves to its caller.

mod accessor;
mod base64;
mod beside;
mod buffer;
mod document;
#[cfg_attr(not(feature = "draco"), path = "gltf/without_draco.rs")]
mod draco;
mod expected;
mod instancing;
#[cfg(feature = "meshopt")]
mod meshopt;
mod node;
mod skin;
mod surface;
#[cfg(test)]
pub(crate) mod tests;
mod version;

use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

use super::transform::Transform;
use super::{ParseError, Place, RawMesh};
use accessor::Accessors;
use buffer::Buffers;
use document::Document;
use instancing::Instances;
use node::{Shown, World};
use skin::Skins;
use surface::Surface;

/// Reads a JSON file, with the binary chunk of a GLB file if there is one.
pub(super) fn parse(
    json: &[u8],
    chunk: Option<&[u8]>,
    folder: Option<&Path>,
) -> Result<RawMesh, ParseError> {
    let document: Document =
        serde_json::from_slice(json).map_err(|error| version::fault(json, &error))?;
    document.check()?;
    let buffers = Buffers::new(&document, chunk, folder);
    let accessors = Accessors {
        document: &document,
        buffers: &buffers,
    };
    let world = World::new(&document)?;
    expected::check(&world, &accessors, json.len())?;
    let surfaces = surfaces(&world, &accessors)?;
    let skins = Skins::new(&accessors, &world);
    let mut mesh = RawMesh {
        notices: passed_over(&world, &document),
        ..RawMesh::default()
    };
    for shown in &world.shown {
        show(&mut mesh, shown, &surfaces[&shown.mesh], &accessors, &skins)?;
    }
    Ok(mesh)
}

/// Reads a binary file.
pub(super) fn parse_glb(bytes: &[u8], folder: Option<&Path>) -> Result<RawMesh, ParseError> {
    let (json, chunk) = chunks(bytes)?;
    parse(json, chunk, folder)
}

/// Checks that a file has triangles to show, all of them sound and none with a skin; gives the nodes at the top of its scene, below
/// which is a tree.
pub(crate) fn check(
    json: &[u8],
    chunk: Option<&[u8]>,
    folder: Option<&Path>,
) -> Result<Vec<usize>, ParseError> {
    let document: Document =
        serde_json::from_slice(json).map_err(|error| version::fault(json, &error))?;
    if document.nodes.iter().any(|node| node.skin.is_some()) {
        return Err(ParseError::Unsupported {
            feature: "a skin".to_owned(),
            remedy: "apply the armature to the mesh, and export it again without one",
        });
    }
    if parse(json, chunk, folder)?.triangles.is_empty() {
        return Err(ParseError::NoTriangles);
    }
    document.roots()
}

/// The bytes that a document names: embedded as base64, or the first of a file in the folder, all by default.
pub(crate) fn resource(
    uri: &str,
    length: Option<usize>,
    folder: Option<&Path>,
) -> Result<Vec<u8>, String> {
    match uri.strip_prefix("data:") {
        Some(data) => base64::embedded(data).ok_or_else(|| "its base64 text is broken".to_owned()),
        None => beside::read(uri, length, folder),
    }
}

/// The address of a buffer or an image, short enough for a message.
pub(crate) fn shortened(uri: Option<&str>) -> String {
    uri.map_or("(binary chunk)".to_owned(), |uri| {
        uri.chars().take(60).collect()
    })
}

/// Splits a binary file, a header and two chunks: JSON, and the buffer if there is one.
pub(crate) fn chunks(bytes: &[u8]) -> Result<(&[u8], Option<&[u8]>), ParseError> {
    let word = |at: usize| {
        let bytes = bytes.get(at..)?.first_chunk::<4>()?;
        Some(u32::from_le_bytes(*bytes))
    };
    match word(4).filter(|_| bytes.starts_with(b"glTF")) {
        Some(2) => {}
        Some(1) => return Err(version::first_version()),
        _ => {
            return Err(ParseError::at(
                Place::Byte(0),
                "this is not the header of a GLB file, version 2",
            ));
        }
    }
    let chunk = |at: usize, kind: &[u8]| {
        let length = word(at)? as usize;
        let body = (bytes.get(at + 4..at + 8)? == kind).then_some(at + 8)?;
        bytes.get(body..body.checked_add(length)?)
    };
    let broken = || ParseError::at(Place::Byte(12), "the JSON chunk is missing or cut short");
    let json = chunk(12, b"JSON").ok_or_else(broken)?;
    Ok((json, chunk(20 + json.len(), b"BIN\0")))
}

/// The element of a list the file refers to by number.
fn get<'a, T>(list: &'a [T], index: usize, what: &str) -> Result<&'a T, ParseError> {
    let missing = || ParseError::at(Place::File, format!("there is no {what} {index}"));
    list.get(index).ok_or_else(missing)
}

/// The surfaces of each mesh that is shown, each read once.
fn surfaces<'a>(
    world: &World<'a>,
    accessors: &Accessors<'a>,
) -> Result<BTreeMap<usize, Vec<Surface<'a>>>, ParseError> {
    let skinned = world.shown.iter().filter(|s| s.node.skin.is_some());
    let skinned: BTreeSet<usize> = skinned.map(|s| s.mesh).collect();
    let of_mesh = |index| {
        let mesh = get(&accessors.document.meshes, index, "mesh")?;
        let drawn = mesh.primitives.iter().filter(|p| p.mode >= 4);
        let read = |p| Surface::read(p, accessors, skinned.contains(&index)).transpose();
        let surfaces: Result<_, ParseError> = drawn.filter_map(read).collect();
        Ok((index, surfaces?))
    };
    world.meshes().into_iter().map(of_mesh).collect()
}

/// A sentence for each kind of primitive that is shown and has no surface.
fn passed_over(world: &World<'_>, document: &Document) -> Vec<String> {
    let meshes = world.meshes();
    let shown = |modes: &[u32]| {
        let mut primitives = meshes.iter().flat_map(|&m| &document.meshes[m].primitives);
        primitives.any(|p| modes.contains(&p.mode))
    };
    [("points", &[0][..]), ("lines", &[1, 2, 3])]
        .into_iter()
        .filter(|(_, modes)| shown(modes))
        .map(|(kind, _)| format!("the {kind} in it were passed over: they enclose nothing"))
        .collect()
}

/// Adds what a node shows.
fn show(
    mesh: &mut RawMesh,
    shown: &Shown<'_>,
    surfaces: &[Surface<'_>],
    accessors: &Accessors<'_>,
    skins: &Skins<'_>,
) -> Result<(), ParseError> {
    let document = accessors.document;
    let weights = shown.node.weights.as_ref();
    let weights = weights.unwrap_or(&document.meshes[shown.mesh].weights);
    let instances = Instances::of(shown.node, accessors)?;
    for surface in surfaces {
        let positions = surface.positions(weights);
        // A skin takes the place of the node's own transform.
        if let Some(skin) = shown.node.skin {
            let maps = skin::blended(surface, skins.joints(skin)?)?;
            let placed = positions.iter().zip(&maps).map(|(&p, map)| map.apply(p));
            let mirrored = maps.first().is_some_and(Transform::mirrors);
            mesh.append(placed, &surface.triangles, mirrored);
            continue;
        }
        for k in 0..instances.count {
            let map = shown.transform.after(&instances.transform(k));
            let placed = positions.iter().map(|&p| map.apply(p));
            mesh.append(placed, &surface.triangles, map.mirrors());
        }
    }
    Ok(())
}
