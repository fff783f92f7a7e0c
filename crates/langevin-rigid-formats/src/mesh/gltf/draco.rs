//! Primitives compressed by Draco (KHR_draco_mesh_compression).
//!
//! The decoder is the `draco-core` crate: safe Rust that bounds what it makes by what it is told.

use draco_core::{DecodeLimits, DecoderBuffer, MeshDecoder};

use super::super::{ParseError, Place};

/// Most bytes of attributes of a vertex: as many as the common ones together, twice.
const MOST_VERTEX_BYTES: usize = 256;

/// A primitive after decoding.
pub(super) struct Decoded {
    mesh: draco_core::Mesh,
}

impl Decoded {
    /// Decodes what its accessors say is this many corners and vertices.
    pub(super) fn new(
        bytes: &[u8],
        corners: usize,
        vertices: usize,
    ) -> Result<Decoded, ParseError> {
        let limits = DecodeLimits::default()
            .with_max_faces(corners as u64 / 3)
            .with_max_points(vertices as u64)
            .with_max_decoded_bytes(vertices.saturating_mul(MOST_VERTEX_BYTES) as u64);
        let mut mesh = draco_core::Mesh::new();
        let mut buffer = DecoderBuffer::new(bytes).with_limits(limits);
        MeshDecoder::new()
            .decode(&mut buffer, &mut mesh)
            .map_err(|error| broken(&error.to_string()))?;
        if mesh.num_points() != vertices || 3 * mesh.num_faces() != corners {
            return Err(broken("their size is not that of the accessors"));
        }
        Ok(Decoded { mesh })
    }

    /// Vertex numbers of the triangles' corners.
    pub(super) fn corners(&self) -> Vec<u32> {
        let faces = self.mesh.faces().as_flattened();
        faces.iter().map(|point| point.0).collect()
    }

    /// The numbers of an attribute, as many for each vertex as `width`.
    pub(super) fn attribute(&self, id: u32, width: usize) -> Result<Vec<f32>, ParseError> {
        let attribute = self.mesh.attribute_by_unique_id(id);
        let attribute = attribute.filter(|a| usize::from(a.num_components()) == width);
        let attribute = attribute
            .ok_or_else(|| broken(&format!("there is no attribute {id} of {width} numbers")))?;
        Ok(attribute.read_f32s(self.mesh.num_points(), width))
    }
}

fn broken(reason: &str) -> ParseError {
    ParseError::at(
        Place::File,
        format!("the Draco data of a primitive are broken: {reason}"),
    )
}
