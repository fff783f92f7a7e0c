//! Added mass of a body in unbounded potential flow, by boundary elements.
//!
//! The energy of the flow around a moving body is a quadratic form of its six velocity components,
//! half of it the added-mass tensor ([`AddedMass::tensor`]). [`added_mass`] computes it from the
//! surface alone: exterior potentials, linear on each triangle, of the six unit motions solve the
//! symmetric Galerkin form of the hypersingular integral equation (J.-C. Nédélec, 1982)
//!
//! ```text
//! W phi = -(1/2 + K') g,    A = <V g, g> + <(1/2 + K') g, W^-1 (1/2 + K') g>,    g = (n, x × n)
//! ```
//!
//! with V, K', W the single layer, adjoint double layer and hypersingular operators of 1/(4 pi r).
//! Both terms are positive and the error of the potentials enters squared. Along convex edges of
//! the body the mesh gets a layer of short elements, and the tensor is extrapolated from the values
//! with and without it.
//!
//! Up to about 16 000 triangles W is a matrix. Above that, near pairs of triangles are still integrated one by one, but
//! distant clusters of them act on each other through expansions: time and memory grow about as the number of triangles,
//! and the tensor is that of the matrix to 1e-5 of its largest entries.

mod assembly;
mod clusters;
mod coarsen;
mod columns;
mod discretize;
mod edges;
mod expect;
mod far;
mod flip;
mod flow;
mod frame;
mod harmonics;
mod hierarchical;
mod kernel;
mod lanes;
mod layer;
mod load;
mod matrix;
mod near;
mod operator;
mod outcome;
mod panels;
mod precondition;
mod quadric;
mod refine;
mod report;
mod shape_error;
mod solver;
mod sums;

pub use expect::{Expected, Thinnest, expected};
pub use outcome::SMALL_THICKNESS;
pub use report::{AddedMassError, MeshQuality, Warning};
pub use shape_error::ShapeError;

use crate::mesh::TriMesh;
use crate::progress::Progress;
use discretize::Discretized;
use flow::Flow;

/// Choices of [`added_mass`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// A mesh of fewer triangles than this is bisected, into at most four times as many and eight times its own, until its longest edge is that of a mesh of
    /// about this many. Meshes marked smooth are taken as they are.
    pub target_triangles: usize,
    /// Most triangles to solve on, edge layer included. They take some 8 kB each, and some 0.4 ms of
    /// one core.
    pub max_triangles: usize,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            target_triangles: 1000,
            max_triangles: 400_000,
        }
    }
}

/// Added mass of a body and the flow it comes from.
#[derive(Debug, Clone, PartialEq)]
pub struct AddedMass {
    /// Tensor per unit density of the fluid about [`reference`](AddedMass::reference)
    /// ([`langevin_rigid::shift_added_mass`] gives it about other points), in the axes of the mesh, linear components first: m³, m⁴ in the coupling blocks, m⁵. Symmetric to the
    /// bit.
    pub tensor: [[f64; 6]; 6],
    /// The point it refers to: the centroid of the enclosed volume (m).
    pub reference: [f64; 3],
    /// Potentials on the surface.
    pub surface: Surface,
    /// Estimated relative error of the tensor. The translation block is measured against its
    /// largest entry, the rotation block against its largest entry or the moment of inertia of the
    /// displaced fluid, whichever is larger; entries far smaller than these may be off by more.
    pub error_estimate: f64,
    /// The mesh in numbers.
    pub quality: MeshQuality,
    /// What makes the result doubtful; empty if nothing does.
    pub warnings: Vec<Warning>,
}

/// The surface solved on, refined from the one given, with the potentials of the six unit motions.
#[derive(Debug, Clone, PartialEq)]
pub struct Surface {
    /// Vertex positions (m): those of the [wetted](TriMesh::wetted) mesh in their order, then those added.
    pub vertices: Vec<[f64; 3]>,
    /// Vertex indices of each triangle, counter-clockwise seen from outside.
    pub triangles: Vec<[u32; 3]>,
    /// Exterior velocity potential at each vertex for unit velocity along x, y, z (m²/s per m/s)
    /// and unit angular velocity about axes x, y, z through the reference (m²/s per rad/s). Linear
    /// in between. Its constant on each component of the surface is free, since no force or energy depends on
    /// it; here the mean over each is zero.
    pub potentials: Vec<[f64; 6]>,
}

/// Added mass of a closed body in unbounded fluid (method: see the [module](self)). Several surfaces move as
/// one body; those in sealed cavities are out of the fluid's reach and have no part in it.
///
/// ```
/// use langevin_rigid_bake::added_mass::{Options, added_mass};
/// use langevin_rigid_bake::shapes::Shape;
///
/// let cube = Shape::Box { size: [0.1; 3] }.mesh(300)?;
/// let result = added_mass(&cube, &Options::default(), &())?;
/// // 0.6384 of the displaced volume in every direction.
/// assert!((result.tensor[1][1] - 0.6384e-3).abs() < 1e-6);
/// assert!(result.warnings.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
///
/// [`AddedMassError::Cancelled`] when `progress` says so, [`AddedMassError::TooLarge`] for more
/// triangles than `options` allow, [`AddedMassError::Singular`] for a surface that is not that of a
/// body.
pub fn added_mass(
    mesh: &TriMesh,
    options: &Options,
    progress: &dyn Progress,
) -> Result<AddedMass, AddedMassError> {
    let mesh = &*mesh.wetted();
    check_size(mesh.triangles().len(), options)?;
    let body = Discretized::new(mesh, options, progress)?;
    check_size(body.triangles.len(), options)?;
    let flow = Flow::solve(&body, progress)?;
    Ok(flow.outcome(mesh, &body))
}

fn check_size(triangles: usize, options: &Options) -> Result<(), AddedMassError> {
    let limit = options.max_triangles;
    if triangles <= limit {
        return Ok(());
    }
    Err(AddedMassError::TooLarge { triangles, limit })
}
