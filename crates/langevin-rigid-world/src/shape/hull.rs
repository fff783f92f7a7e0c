//! One convex hull: its corners for distances, its faces for the area of a contact.

use langevin_rigid::linalg::Vec3;
use parry3d_f64::math::Vector;
use parry3d_f64::shape::{ConvexPolyhedron, SupportMap};

use super::ShapeError;
use super::lanes::Lanes;

/// Corners that stand for the outline of a face where it is cut with another's: a coin needs no more.
pub(crate) const OUTLINE: usize = 12;

/// A convex polyhedron.
#[derive(Debug, Clone)]
pub(crate) struct Hull {
    /// Its corners (m).
    pub(crate) points: Vec<Vector>,
    lanes: Lanes,
    faces: Vec<Face>,
}

/// A flat face.
#[derive(Debug, Clone)]
pub(crate) struct Face {
    /// Outwards.
    pub(crate) normal: Vector,
    /// Some of its corners, counter-clockwise seen from outside (m).
    pub(crate) outline: Vec<Vector>,
}

impl Hull {
    pub(super) fn new(points: &[Vec3]) -> Result<Self, ShapeError> {
        if points.iter().flatten().any(|x| !x.is_finite()) {
            return Err(ShapeError::NotFinite);
        }
        let given: Vec<Vector> = points.iter().copied().map(Vector::from).collect();
        let size = given.iter().map(|p| p.length()).fold(0.0, f64::max);
        let flat = || ShapeError::Flat(points.len());
        if size == 0.0 {
            return Err(flat());
        }
        // In units of its own size, as the tolerances of the library are absolute.
        let unit: Vec<Vector> = given.iter().map(|p| *p / size).collect();
        let polyhedron = ConvexPolyhedron::from_convex_hull(&unit).ok_or_else(flat)?;
        let corners = polyhedron.points();
        let faces = polyhedron.faces().iter().map(|face| {
            let first = face.first_vertex_or_edge as usize;
            let last = first + face.num_vertices_or_edges as usize;
            let around = &polyhedron.vertices_adj_to_face()[first..last];
            let all: Vec<Vector> = around.iter().map(|v| corners[*v as usize] * size).collect();
            Face {
                normal: face.normal,
                outline: outline(&all),
            }
        });
        let faces = faces.collect();
        Ok(Self::of(corners.iter().map(|p| *p * size).collect(), faces))
    }

    /// A triangle, with its front as the only face.
    pub(crate) fn of_triangle(corners: [Vector; 3], normal: Vector) -> Self {
        let front = Face {
            normal,
            outline: corners.to_vec(),
        };
        Self::of(corners.to_vec(), vec![front])
    }

    fn of(points: Vec<Vector>, faces: Vec<Face>) -> Self {
        Self {
            lanes: Lanes::new(&points),
            points,
            faces,
        }
    }

    pub(super) fn scaled(&self, factor: f64) -> Self {
        let face = |face: &Face| Face {
            normal: face.normal,
            outline: face.outline.iter().map(|p| *p * factor).collect(),
        };
        Self::of(
            self.points.iter().map(|p| *p * factor).collect(),
            self.faces.iter().map(face).collect(),
        )
    }

    /// The corner that is farthest along `direction`.
    pub(crate) fn farthest(&self, direction: Vector) -> Vector {
        self.points[self.lanes.farthest(direction)]
    }

    /// The face that looks most along `direction`.
    pub(crate) fn face_towards(&self, direction: Vector) -> &Face {
        let mut best = &self.faces[0];
        let mut most = f64::NEG_INFINITY;
        for face in &self.faces {
            let along = face.normal.dot(direction);
            if along > most {
                (best, most) = (face, along);
            }
        }
        best
    }
}

/// Corners evenly among all of a face's.
fn outline(all: &[Vector]) -> Vec<Vector> {
    let kept = all.len().min(OUTLINE);
    (0..kept).map(|i| all[i * all.len() / kept]).collect()
}

/// A hull in another unit of length.
pub(crate) struct Scaled<'a> {
    pub(crate) hull: &'a Hull,
    pub(crate) factor: f64,
}

impl SupportMap for Scaled<'_> {
    fn local_support_point(&self, direction: Vector) -> Vector {
        self.hull.farthest(direction) * self.factor
    }
}
