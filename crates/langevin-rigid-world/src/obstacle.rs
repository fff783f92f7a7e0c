//! What stands still: ground, walls, boxes, terrain.

use std::collections::HashMap;

use langevin_rigid::linalg::{Quat, Vec3};
use parry3d_f64::bounding_volume::Aabb;
use parry3d_f64::math::{Pose, Rotation, Vector};
use parry3d_f64::partitioning::{Bvh, BvhBuildStrategy};

use crate::material::{Material, MaterialError};
use crate::shape::{Hull, Shape};

/// Something that does not move, and that bodies do not enter.
///
/// ```
/// use langevin_rigid_world::{Material, Obstacle, Shape};
/// let ground = Obstacle::half_space([0.0, 1.0, 0.0], 0.0, Material::default())?;
/// let step = Obstacle::shape(Shape::cuboid([1.0, 0.1, 0.3])?, [0.0, 0.1, 0.0], [0.0, 0.0, 0.0, 1.0], Material::default())?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct Obstacle {
    pub(crate) geometry: Geometry,
    pub(crate) material: Material,
}

#[derive(Debug, Clone)]
pub(crate) enum Geometry {
    /// All points whose component along `normal` is below `offset`.
    HalfSpace { normal: Vector, offset: f64 },
    /// A shape at a pose, with its bounds.
    Shape {
        shape: Shape,
        pose: Pose,
        bounds: Aabb,
    },
    /// Triangles with their front outwards.
    Mesh(Mesh),
}

/// Why there is no such obstacle.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum ObstacleError {
    /// A number is not finite.
    #[error("a number of the obstacle is not finite")]
    NotFinite,
    /// The normal has no direction.
    #[error("the normal of the half-space has no direction: give one of unit length")]
    NoNormal,
    /// The orientation is none.
    #[error("the orientation of the obstacle is no unit quaternion x, y, z, w")]
    NoRotation,
    /// A triangle names a vertex that there is not.
    #[error("triangle {0} of the obstacle names a vertex that there is not")]
    Index(usize),
    /// All triangles are degenerate.
    #[error("the obstacle has no triangle with an area")]
    Empty,
    /// The surface has a border.
    #[error(
        "the obstacle is not closed: the edge between vertices {0} and {1} has one triangle; close the hole, or say \
         that it is a terrain"
    )]
    Open(u32, u32),
    /// Its friction or restitution is impossible.
    #[error(transparent)]
    Material(#[from] MaterialError),
}

impl Obstacle {
    /// Everything below a plane: `normal` (unit, world) points out of it, `offset` (m) is the plane's distance from the
    /// origin along it. Ground at a height y is `([0, 1, 0], y)`.
    ///
    /// # Errors
    /// [`ObstacleError`].
    pub fn half_space(
        normal: Vec3,
        offset: f64,
        material: Material,
    ) -> Result<Self, ObstacleError> {
        if !offset.is_finite() {
            return Err(ObstacleError::NotFinite);
        }
        let normal = Vector::from(normal)
            .try_normalize()
            .ok_or(ObstacleError::NoNormal)?;
        Ok(Self {
            geometry: Geometry::HalfSpace { normal, offset },
            material: material.checked()?,
        })
    }

    /// A shape at a position (m) and orientation (unit quaternion x, y, z, w).
    ///
    /// # Errors
    /// [`ObstacleError`].
    pub fn shape(
        shape: Shape,
        position: Vec3,
        orientation: Quat,
        material: Material,
    ) -> Result<Self, ObstacleError> {
        let pose = pose(position, orientation);
        if !pose.translation.is_finite() {
            return Err(ObstacleError::NotFinite);
        }
        if (pose.rotation.length() - 1.0).abs() > 1e-6 {
            return Err(ObstacleError::NoRotation);
        }
        let points = shape.hulls().iter().flat_map(|hull| &hull.points);
        let bounds = Aabb::from_points(points.map(|p| pose * *p));
        Ok(Self {
            geometry: Geometry::Shape {
                shape,
                pose,
                bounds,
            },
            material: material.checked()?,
        })
    }

    /// A closed surface, its triangles counter-clockwise seen from outside (world frame, m).
    ///
    /// # Errors
    /// [`ObstacleError`]; [`ObstacleError::Open`] names an edge of a hole.
    pub fn mesh(
        vertices: &[Vec3],
        triangles: &[[u32; 3]],
        material: Material,
    ) -> Result<Self, ObstacleError> {
        Self::of_triangles(vertices, triangles, true, material)
    }

    /// A surface that need not be closed, seen from the side where its triangles are counter-clockwise: nothing is held
    /// back that comes from behind.
    ///
    /// # Errors
    /// [`ObstacleError`].
    pub fn terrain(
        vertices: &[Vec3],
        triangles: &[[u32; 3]],
        material: Material,
    ) -> Result<Self, ObstacleError> {
        Self::of_triangles(vertices, triangles, false, material)
    }

    fn of_triangles(
        vertices: &[Vec3],
        triangles: &[[u32; 3]],
        closed: bool,
        material: Material,
    ) -> Result<Self, ObstacleError> {
        Ok(Self {
            geometry: Geometry::Mesh(Mesh::new(vertices, triangles, closed)?),
            material: material.checked()?,
        })
    }

    /// The box around it, unless it has no end.
    pub(crate) fn bounds(&self) -> Option<Aabb> {
        match &self.geometry {
            Geometry::HalfSpace { .. } => None,
            Geometry::Shape { bounds, .. } => Some(*bounds),
            Geometry::Mesh(mesh) => Some(mesh.tree.root_aabb()),
        }
    }
}

/// Triangles in a tree of boxes.
#[derive(Debug, Clone)]
pub(crate) struct Mesh {
    pub(crate) triangles: Vec<Triangle>,
    pub(crate) tree: Bvh,
}

/// A triangle of an obstacle.
#[derive(Debug, Clone)]
pub(crate) struct Triangle {
    pub(crate) corners: [Vector; 3],
    pub(crate) normal: Vector,
    /// Whether the surface bends away at the edge from corner k to the next, so that the edge itself can be met.
    pub(crate) ridges: [bool; 3],
}

impl Mesh {
    fn new(vertices: &[Vec3], given: &[[u32; 3]], closed: bool) -> Result<Self, ObstacleError> {
        if vertices.iter().flatten().any(|x| !x.is_finite()) {
            return Err(ObstacleError::NotFinite);
        }
        let mut triangles = Vec::with_capacity(given.len());
        // The triangle on the left of each directed edge.
        let mut left: HashMap<(u32, u32), usize> = HashMap::new();
        let mut indices = Vec::with_capacity(given.len());
        for (number, triangle) in given.iter().enumerate() {
            let corner = |k: usize| {
                let vertex = vertices.get(triangle[k] as usize);
                vertex
                    .map(|v| Vector::from(*v))
                    .ok_or(ObstacleError::Index(number))
            };
            let corners = [corner(0)?, corner(1)?, corner(2)?];
            let across = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
            let Some(normal) = across.try_normalize() else {
                continue;
            };
            for k in 0..3 {
                left.insert((triangle[k], triangle[(k + 1) % 3]), triangles.len());
            }
            indices.push(*triangle);
            triangles.push(Triangle {
                corners,
                normal,
                ridges: [true; 3],
            });
        }
        if triangles.is_empty() {
            return Err(ObstacleError::Empty);
        }
        for (number, triangle) in indices.iter().enumerate() {
            for k in 0..3 {
                let (a, b) = (triangle[k], triangle[(k + 1) % 3]);
                match left.get(&(b, a)) {
                    Some(&other) => {
                        let (here, there) = (&triangles[number], &triangles[other]);
                        let middle = there.corners.iter().sum::<Vector>() / 3.0;
                        let size = (here.corners[1] - here.corners[0]).length();
                        let drop = here.normal.dot(middle - here.corners[k]);
                        triangles[number].ridges[k] = drop < -1e-3 * size;
                    }
                    None if closed => return Err(ObstacleError::Open(a, b)),
                    None => {}
                }
            }
        }
        let boxes: Vec<Aabb> = triangles
            .iter()
            .map(|triangle| Aabb::from_points(triangle.corners))
            .collect();
        Ok(Self {
            tree: Bvh::from_leaves(BvhBuildStrategy::Binned, &boxes),
            triangles,
        })
    }
}

impl Triangle {
    /// The same as a hull.
    pub(crate) fn hull(&self) -> Hull {
        Hull::of_triangle(self.corners, self.normal)
    }
}

/// A pose of parry's.
pub(crate) fn pose(position: Vec3, [x, y, z, w]: Quat) -> Pose {
    Pose::from_parts(Vector::from(position), Rotation::from_xyzw(x, y, z, w))
}
