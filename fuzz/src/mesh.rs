//! Mesh files.

use langevin_rigid_formats::mesh::{LengthUnit, MeshFormat, parse_mesh};
use langevin_rigid_formats::visual::Visual;

/// Reads a mesh file and looks whether it is a body.
pub(crate) fn read(bytes: &[u8], format: MeshFormat) {
    let _ = MeshFormat::of_content(bytes);
    if let (MeshFormat::Gltf | MeshFormat::Glb, Err(error)) = (format, Visual::parse(bytes, None)) {
        assert!(!error.to_string().is_empty());
    }
    let mesh = match parse_mesh(bytes, format, Some(LengthUnit::M), None) {
        Err(error) => return assert!(!error.to_string().is_empty()),
        Ok(mesh) => mesh,
    };
    assert!(!mesh.triangles.is_empty());
    let count = mesh.vertices.len();
    let mut corners = mesh.triangles.as_flattened().iter();
    assert!(corners.all(|&v| (v as usize) < count));
    match mesh.body() {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(body) => assert!(body.volume() > 0.0 && body.volume().is_finite()),
    }
}
