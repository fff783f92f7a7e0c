//! Shapes that touch: convex hulls, one for a convex body, several for one that is not.

mod hull;
mod lanes;

use langevin_rigid::Body;
use langevin_rigid::linalg::Vec3;
use parry3d_f64::math::Vector;
use parry3d_f64::transformation::vhacd::{VHACD, VHACDParameters};

pub(crate) use hull::{Face, Hull, OUTLINE, Scaled};

/// The solid that touches others: convex hulls in the body frame.
///
/// ```
/// use langevin_rigid_world::Shape;
/// let brick = Shape::cuboid([0.1, 0.03, 0.05])?;
/// assert!((brick.radius() - (0.1f64.powi(2) + 0.03f64.powi(2) + 0.05f64.powi(2)).sqrt()).abs() < 1e-12);
/// # Ok::<(), langevin_rigid_world::ShapeError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Shape {
    hulls: Vec<Hull>,
    radius: f64,
}

/// Why points make no shape.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ShapeError {
    /// There is no volume between the points.
    #[error(
        "the {0} points enclose no volume, so that nothing can touch them: give at least four that lie in no plane"
    )]
    Flat(usize),
    /// A number is not finite.
    #[error("a point of the shape is not finite")]
    NotFinite,
    /// The body has no surface.
    #[error(
        "the body has no surface that could touch anything: bodies in closed form have none; bake one from a mesh, \
         or give the shape of its contacts apart"
    )]
    NoSurface,
}

/// Cells along the longest side of the grid that a body is decomposed on.
const DECOMPOSITION_CELLS: u32 = 64;
/// How far a part may be from its hull, as a share of the body's volume.
const DECOMPOSITION_CONCAVITY: f64 = 0.02;

impl Shape {
    /// The convex hull of some points (body frame, m).
    ///
    /// # Errors
    /// [`ShapeError`].
    pub fn convex_hull(points: &[Vec3]) -> Result<Self, ShapeError> {
        Ok(Self::of(vec![Hull::new(points)?]))
    }

    /// The convex hull of a body's surface.
    ///
    /// # Errors
    /// [`ShapeError`].
    pub fn of_body(body: &Body) -> Result<Self, ShapeError> {
        match &body.surface.vertices[..] {
            [] => Err(ShapeError::NoSurface),
            vertices => Self::convex_hull(vertices),
        }
    }

    /// Convex parts of a body that is not convex (a cup, a ring, a boat), so that others can enter its hollows.
    ///
    /// The parts stand for the surface to about a sixty-fourth of its length; what is thinner is not found.
    ///
    /// # Errors
    /// [`ShapeError`].
    pub fn decomposed(body: &Body) -> Result<Self, ShapeError> {
        let surface = &body.surface;
        if surface.vertices.is_empty() {
            return Err(ShapeError::NoSurface);
        }
        let points: Vec<Vector> = surface.vertices.iter().copied().map(Vector::from).collect();
        let parameters = VHACDParameters {
            resolution: DECOMPOSITION_CELLS,
            concavity: DECOMPOSITION_CONCAVITY,
            ..VHACDParameters::default()
        };
        let parts = VHACD::decompose(&parameters, &points, &surface.triangles, true);
        let hulls: Vec<Hull> = parts
            .compute_exact_convex_hulls(&points, &surface.triangles)
            .iter()
            .filter_map(|(points, _)| {
                let points: Vec<Vec3> = points.iter().map(|p| p.to_array()).collect();
                Hull::new(&points).ok()
            })
            .collect();
        match hulls.is_empty() {
            true => Self::of_body(body),
            false => Ok(Self::of(hulls)),
        }
    }

    /// A box of these half-extents (m).
    ///
    /// # Errors
    /// [`ShapeError`].
    pub fn cuboid(half_extents: Vec3) -> Result<Self, ShapeError> {
        let corner = |i: usize| {
            std::array::from_fn(|k| half_extents[k] * if i >> k & 1 == 1 { 1.0 } else { -1.0 })
        };
        let corners: [Vec3; 8] = std::array::from_fn(corner);
        Self::convex_hull(&corners)
    }

    fn of(hulls: Vec<Hull>) -> Self {
        let points = hulls.iter().flat_map(|hull| &hull.points);
        let radius = points.map(|p| p.length()).fold(0.0, f64::max);
        Self { hulls, radius }
    }

    /// The same shape so many times as large.
    #[must_use]
    pub fn scaled(&self, factor: f64) -> Self {
        Self {
            hulls: self.hulls.iter().map(|hull| hull.scaled(factor)).collect(),
            radius: factor * self.radius,
        }
    }

    /// Distance of its farthest point from the centre of mass (m).
    pub fn radius(&self) -> f64 {
        self.radius
    }

    pub(crate) fn hulls(&self) -> &[Hull] {
        &self.hulls
    }
}
