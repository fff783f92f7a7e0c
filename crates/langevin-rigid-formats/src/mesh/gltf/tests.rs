//! What glTF has beyond plain meshes: each file is put together here, around a box of 2 x 1 x 0.5.

use langevin_rigid_bake::mesh::TriMesh;
use langevin_rigid_bake::shapes::Shape;

use super::super::{MeshFormat, ParseError, RawMesh, parse_mesh};

#[cfg(all(feature = "draco", feature = "meshopt"))]
mod compressed;
mod confined;
#[cfg(all(feature = "draco", feature = "meshopt"))]
mod damaged;
mod features;
mod proportion;

pub(super) const FLOAT: u32 = 5126;
pub(super) const BYTE: u32 = 5120;
pub(super) const UNSIGNED_BYTE: u32 = 5121;
pub(super) const SHORT: u32 = 5122;
pub(super) const UNSIGNED_SHORT: u32 = 5123;

pub(super) fn read(glb: &[u8]) -> Result<RawMesh, ParseError> {
    parse_mesh(glb, MeshFormat::Glb, None, None)
}

pub(super) fn body(glb: &[u8]) -> TriMesh {
    read(glb).unwrap().body().unwrap()
}

pub(super) fn fault(glb: &[u8]) -> String {
    read(glb).unwrap_err().to_string()
}

/// Whether the body fills a box of these corners: it has its volume and is nowhere outside.
pub(super) fn fills(body: &TriMesh, low: [f64; 3], high: [f64; 3], tolerance: f64) -> bool {
    let volume: f64 = (0..3).map(|k| high[k] - low[k]).product();
    let bounds = body.bounding_box();
    (body.volume() / volume - 1.0).abs() < tolerance
        && (0..3).all(|k| (bounds[0][k] - low[k]).abs() < tolerance)
        && (0..3).all(|k| (bounds[1][k] - high[k]).abs() < tolerance)
}

pub(super) fn brick() -> TriMesh {
    Shape::Box {
        size: [2.0, 1.0, 0.5],
    }
    .mesh(12)
    .unwrap()
}

pub(super) fn floats(numbers: &[f64]) -> Vec<u8> {
    let bytes = numbers.iter().flat_map(|&x| (x as f32).to_le_bytes());
    bytes.collect()
}

/// A GLB file in the making.
#[derive(Default, Clone)]
pub(super) struct Maker {
    views: Vec<String>,
    accessors: Vec<String>,
    pub(super) data: Vec<u8>,
}

impl Maker {
    /// A file that begins with the brick's positions (accessor 0) and vertex numbers (1).
    pub(super) fn brick() -> Maker {
        let (brick, mut maker) = (brick(), Maker::default());
        let positions = floats(brick.vertices().as_flattened());
        maker.accessor(&positions, FLOAT, "VEC3", 8, "");
        let corners = brick.triangles().as_flattened();
        let corners: Vec<u8> = corners
            .iter()
            .flat_map(|&v| (v as u16).to_le_bytes())
            .collect();
        maker.accessor(&corners, UNSIGNED_SHORT, "SCALAR", 36, "");
        maker
    }

    /// The number of a view of these bytes.
    pub(super) fn view(&mut self, bytes: &[u8], more: &str) -> usize {
        let (offset, length) = (self.data.len(), bytes.len());
        self.data.extend(bytes);
        self.data.resize(self.data.len().next_multiple_of(4), 0);
        self.view_json(&format!(
            r#""buffer":0,"byteOffset":{offset},"byteLength":{length}{more}"#
        ))
    }

    pub(super) fn view_json(&mut self, json: &str) -> usize {
        self.views.push(format!("{{{json}}}"));
        self.views.len() - 1
    }

    /// The number of an accessor of these bytes.
    pub(super) fn accessor(
        &mut self,
        bytes: &[u8],
        component: u32,
        shape: &str,
        count: usize,
        more: &str,
    ) -> usize {
        let view = self.view(bytes, "");
        self.accessor_json(&format!(
            r#""bufferView":{view},"componentType":{component},"count":{count},"type":"{shape}"{more}"#
        ))
    }

    pub(super) fn accessor_json(&mut self, json: &str) -> usize {
        self.accessors.push(format!("{{{json}}}"));
        self.accessors.len() - 1
    }

    /// The file, with nodes, meshes and the rest of the document as given.
    pub(super) fn glb(&self, rest: &str) -> Vec<u8> {
        glb(&self.json("", rest), &self.data)
    }

    pub(super) fn json(&self, uri: &str, rest: &str) -> String {
        format!(
            r#"{{"asset":{{"version":"2.0"}},"accessors":[{}],"bufferViews":[{}],"buffers":[{{{uri}"byteLength":{}}}],{rest}}}"#,
            self.accessors.join(","),
            self.views.join(","),
            self.data.len(),
        )
    }

    /// The file with one node that shows the brick; both with more properties.
    pub(super) fn shown(&self, node: &str, primitive: &str, mesh: &str) -> Vec<u8> {
        self.glb(&format!(
            r#""nodes":[{{"mesh":0{node}}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1{primitive}}}]{mesh}}}]"#
        ))
    }
}

pub(crate) fn glb(json: &str, data: &[u8]) -> Vec<u8> {
    let mut json = json.as_bytes().to_vec();
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut out = b"glTF\x02\0\0\0".to_vec();
    out.extend((28 + json.len() as u32 + data.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &json[..]), (b"BIN\0", data)] {
        out.extend((chunk.len() as u32).to_le_bytes());
        out.extend(kind);
        out.extend(chunk);
    }
    out
}

#[cfg(not(feature = "meshopt"))]
#[test]
fn without_its_decoder_meshoptimizer_is_refused_by_name() {
    let refused = fault(include_bytes!("../../../tests/data/ball-meshopt.glb"));
    let named = refused.contains("without the feature `meshopt`");
    assert!(named, "{refused}");
}

#[cfg(not(feature = "draco"))]
#[test]
fn without_its_decoder_draco_is_refused_by_name() {
    let refused = fault(include_bytes!(
        "../../../tests/data/ball-draco-edgebreaker.glb"
    ));
    let named = refused.contains("without the feature `draco`");
    assert!(named, "{refused}");
}
