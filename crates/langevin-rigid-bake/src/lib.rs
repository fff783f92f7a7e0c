//! Precomputation of Langevin Rigid: from a triangle mesh to a body that can be stepped.
//!
//! What depends only on the shape of a body is computed once and kept, as a bake. A tool, an asset pipeline or an editor
//! links this crate; a game links `langevin-rigid` and reads the bake. Spheres, ellipsoids, discs, plates, cylinders and
//! boxes need no bake: the run time makes them itself.
//!
//! It is useful without the run time, too: it checks and mends meshes, and computes the mass properties and the 6x6
//! added-mass tensor of any closed body.
//!
//! ```
//! use langevin_rigid::{Bake, Fluid, NoiseStream, Settings, State, Stepper};
//! use langevin_rigid_bake::body::{BodySpec, bake_body};
//! use langevin_rigid_bake::shapes::Shape;
//!
//! // Once: a coin with a hole, 5 g.
//! let coin = Shape::Coin { diameter: 0.022, thickness: 1.6e-3, hole: 0.005 };
//! let spec = BodySpec { mass: Some(5e-3), ..BodySpec::default() };
//! let (body, added_mass) = bake_body(&coin.mesh(300)?, &spec, &())?;
//! assert!(added_mass.error_estimate < 0.01);
//! let bake = Bake {
//!     body,
//!     history: None,
//!     error_estimate: added_mass.error_estimate,
//!     warnings: added_mass.warnings.iter().map(ToString::to_string).collect(),
//!     fingerprint: [0; 32],
//! };
//! let file = bake.to_bytes();
//!
//! // In the game: two seconds in water.
//! let coin = Bake::from_bytes(&file)?.body;
//! let stepper = Stepper::new(&coin, &Fluid::WATER, None, &Settings::default())?;
//! let mut state = State::default();
//! let noise = NoiseStream { seed: 1, body: 0 };
//! for _ in 0..120 {
//!     stepper.step(&mut state, 1.0 / 60.0, &noise.into())?;
//! }
//! assert!(state.position[1] < -0.3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # From a mesh to a bake
//!
//! 1. A [`TriMesh`] is closed, oriented and does not intersect itself. [`TriMesh::new`] accepts no other;
//!    [`TriMesh::from_sheet`] gives an open sheet a thickness; [`shapes`] makes leaves, coins, maple seeds and others;
//!    the crate `langevin-rigid-formats` reads files.
//! 2. [`mesh::survey()`] lists what is wrong with a mesh that is refused, and [`mesh::repair()`] mends it; where nothing
//!    else helps it [wraps](mesh::Options::wrap) the mesh; [`check::check`] finds the repair. [`TriMesh::proxy`] simplifies a
//!    mesh that is too fine.
//! 3. [`body::bake_body`] does the rest: mass properties, added mass, drag areas and slices for separated flow.
//! 4. [`turbulence::turbulence_history`] adds the turbulence that the body meets, for the turbulence sources that sample it.
//!
//! # Modules
//!
//! - [`mesh`]: closed triangle meshes; what is wrong with others, and what mends them.
//! - [`shapes`]: parametric bodies.
//! - [`mass_properties`]: volume, mass, centre of mass and inertia, exactly.
//! - [`added_mass`]: the tensor by boundary elements, with an estimate of its error, and a forecast of its cost.
//! - [`separation`]: the tensors and slices that the closure for separated flow needs.
//! - [`extents`]: characteristic sizes.
//! - [`turbulence`]: the k-epsilon model on a MAC grid.
//! - [`body`]: all of it for one body.
//! - [`check`](mod@check): all of what is to know of a mesh before that, and the repair that mends it.
//! - [`progress`]: how a long computation reports its progress, and how it is cancelled.
//!
//! # Conventions
//!
//! - SI units throughout. The frame is that of the mesh, triangles are counter-clockwise as seen from outside.
//! - A baked body keeps the axes of the mesh and has its origin at the centre of mass. Generated bodies have their centroid
//!   at the origin, their long axes along x and their thin axis along y.
//! - Added mass is per unit density of the fluid, linear part first: m^3, m^4 and m^5. [`added_mass::added_mass`] gives it
//!   about the centroid, a baked body about its centre of mass; [`langevin_rigid::shift_added_mass`] goes from one to the other.
//! - Errors say what is wrong, where, and what to do. What makes a result doubtful but does not prevent it is listed in
//!   the [warnings](added_mass::AddedMass::warnings).
//! - Work runs on the threads of `rayon`. A result has the same bits on any number of them.
//! - A long computation takes a [`Progress`](progress::Progress) and ends soon after that cancels; `&()` ignores reports
//!   and never cancels.
//!
//! # Features
//!
//! `meshopt`, on by default: [`TriMesh::proxy`] uses meshoptimizer, which needs a C++ compiler. Without the feature the
//! crate builds for `wasm32-unknown-unknown`, and meshes are not simplified.

pub mod added_mass;
mod axes;
pub mod body;
pub mod check;
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
