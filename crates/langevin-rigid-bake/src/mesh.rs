//! Closed, oriented triangle meshes.

/// A closed, consistently oriented, connected triangle mesh with outward normals (metres).
#[derive(Debug, Clone, PartialEq)]
pub struct TriMesh {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl TriMesh {
    /// Vertex positions (m).
    pub fn vertices(&self) -> &[[f64; 3]] {
        &self.vertices
    }

    /// Vertex indices of each triangle, counter-clockwise seen from outside.
    pub fn triangles(&self) -> &[[u32; 3]] {
        &self.triangles
    }
}

/// Why a mesh is not a body.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum MeshError {}
