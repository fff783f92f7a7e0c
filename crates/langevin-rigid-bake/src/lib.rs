//! Precomputation of Langevin Rigid: what is done once per body or scene.

pub mod added_mass;
pub mod body;
pub mod mass_properties;
pub mod mesh;
pub mod progress;
pub mod shapes;
pub mod turbulence;

pub use mesh::{MeshError, TriMesh};
