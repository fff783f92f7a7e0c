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
