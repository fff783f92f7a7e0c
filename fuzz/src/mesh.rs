//! Mesh files.

use langevin_rigid_formats::mesh::{LengthUnit, MeshFormat, parse_mesh};

/// Reads a mesh file and looks whether it is a body.
pub(crate) fn read(bytes: &[u8], format: MeshFormat) {
    let _ = MeshFormat::of_content(bytes);
    match parse_mesh(bytes, format, Some(LengthUnit::M), None) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(mesh) => {
            assert!(!mesh.triangles.is_empty());
            for &v in mesh.triangles.as_flattened() {
                let place = mesh.vertices[v as usize];
                assert!(place.iter().all(|x| x.is_finite()), "vertex {v}: {place:?}");
            }
            if let Err(error) = mesh.body() {
                assert!(!error.to_string().is_empty());
            }
        }
    }
}
