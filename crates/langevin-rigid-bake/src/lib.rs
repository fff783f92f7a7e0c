//! Precomputation of Langevin Rigid: what is done once per body or scene.

pub mod added_mass;
mod axes;
pub mod body;
pub mod extents;
pub mod mass_properties;
pub mod mesh;
pub mod progress;
pub mod separation;
pub mod shapes;
pub mod turbulence;

pub use mesh::{MeshError, TriMesh};

/// Hash of the version, of the sources of this crate and, in the workspace, of the run time: code of another hash may
/// bake another body of the same mesh.
pub const SOURCES: &str = env!("LANGEVIN_RIGID_SOURCES");
