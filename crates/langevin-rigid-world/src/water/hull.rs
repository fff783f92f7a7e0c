//! Hydrostatics: what of a closed surface is below a plane.

use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::{add, cross, dot, norm, scale, sub};
use langevin_rigid::{Body, BodyError};

use super::surface::Plane;

/// The closed surface of a body, made ready to be cut; body frame, origin at the centre of mass.
///
/// A coarse surface encloses less than the body that it stands for: it is scaled about its centroid to the body's volume, and
/// moved with the centroid to the centre of buoyancy, so that a body wholly in water is lifted as in the equations of motion.
#[derive(Debug, Clone, PartialEq)]
pub struct FloatingHull {
    vertices: Vec<Vec3>,
    triangles: Vec<[u32; 3]>,
    volume: f64,
    centroid: Vec3,
    /// Of a ball about the origin that holds all of it (m).
    radius: f64,
}

/// What of a body is below a plane.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Submerged {
    /// Volume (m^3).
    pub volume: f64,
    /// Centroid of that volume (m), in the frame of the plane; no place in particular if there is none.
    pub centroid: Vec3,
    /// Area of the cut, the waterplane (m^2).
    pub waterplane: f64,
}

/// Why a surface cannot be cut.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum HullError {
    /// The body is impossible.
    #[error(transparent)]
    Body(#[from] BodyError),
    /// There is none.
    #[error(
        "the body has no surface, so the water cannot tell what of it is submerged; bake it from its mesh"
    )]
    NoSurface,
    /// Some edge has more triangles on one side than on the other.
    #[error(
        "the body's surface is not closed, so the water cannot tell what of it is submerged; bake it from a closed mesh"
    )]
    Open,
    /// It encloses no volume, or faces inwards, or encloses another volume than the body has.
    #[error(
        "the body's surface encloses {enclosed:e} m^3 and the body has {volume:e} m^3; bake it from its mesh"
    )]
    Volume {
        /// By the surface (m^3).
        enclosed: f64,
        /// Of the body (m^3).
        volume: f64,
    },
}

/// Share of its volume that a coarse surface may lack or have too much.
const COARSE: f64 = 0.1;
/// Share of the volume that rounding may leave below a plane which only touches the body.
const ROUNDING: f64 = 1e-14;

impl FloatingHull {
    /// The surface of `body`.
    ///
    /// # Errors
    /// [`HullError`].
    pub fn new(body: &Body) -> Result<Self, HullError> {
        body.check()?;
        let surface = &body.surface;
        if surface.triangles.is_empty() {
            return Err(HullError::NoSurface);
        }
        if !closed(&surface.triangles) {
            return Err(HullError::Open);
        }
        let mut hull = Self {
            vertices: surface.vertices.clone(),
            triangles: surface.triangles.clone(),
            volume: 0.0,
            centroid: [0.0; 3],
            radius: 0.0,
        };
        let sum = hull.sum_below(body.centre_of_buoyancy, |_| -1.0);
        let ratio = sum.volume / body.volume;
        if !(1.0 - COARSE..=1.0 + COARSE).contains(&ratio) {
            return Err(HullError::Volume {
                enclosed: sum.volume,
                volume: body.volume,
            });
        }
        let centroid = add(body.centre_of_buoyancy, scale(1.0 / sum.volume, sum.moment));
        let larger = libm::cbrt(1.0 / ratio);
        for v in &mut hull.vertices {
            *v = add(body.centre_of_buoyancy, scale(larger, sub(*v, centroid)));
        }
        hull.volume = body.volume;
        hull.centroid = body.centre_of_buoyancy;
        // Vertices that no triangle has may be anywhere.
        let corners = hull.triangles.iter().flatten();
        hull.radius = corners
            .map(|&v| norm(hull.vertices[v as usize]))
            .fold(0.0, f64::max);
        Ok(hull)
    }

    /// Volume (m^3).
    pub fn volume(&self) -> f64 {
        self.volume
    }

    /// Centroid of the volume (m).
    pub fn centroid(&self) -> Vec3 {
        self.centroid
    }

    /// Radius of a ball about the centre of mass that holds the body (m).
    pub fn radius(&self) -> f64 {
        self.radius
    }

    /// What is below `plane`, which is in the body frame too.
    ///
    /// Exact for the polyhedron: its triangles are clipped at the plane, and make tetrahedra with a point of the plane. The
    /// cut itself is in the plane and needs no triangles, as its tetrahedra are flat.
    pub fn below(&self, plane: &Plane) -> Submerged {
        let none = Submerged {
            volume: 0.0,
            centroid: self.centroid,
            waterplane: 0.0,
        };
        if -plane.offset >= self.radius {
            return none;
        }
        let whole = Submerged {
            volume: self.volume,
            ..none
        };
        if plane.offset >= self.radius {
            return whole;
        }
        let above = plane.height(self.centroid);
        let origin = sub(self.centroid, scale(above, plane.normal));
        let sum = self.sum_below(origin, |v| plane.height(v));
        if sum.volume <= ROUNDING * self.volume {
            return none;
        }
        if sum.volume >= (1.0 - ROUNDING) * self.volume {
            return whole;
        }
        Submerged {
            volume: sum.volume,
            centroid: add(origin, scale(1.0 / sum.volume, sum.moment)),
            // All areas of a closed surface cancel.
            waterplane: (-dot(plane.normal, sum.area)).max(0.0),
        }
    }

    /// Sums over the triangles where their height is not positive, with tetrahedra from `origin`.
    fn sum_below(&self, origin: Vec3, height: impl Fn(Vec3) -> f64) -> Sum {
        let mut sum = Sum::default();
        for triangle in &self.triangles {
            let corners = triangle.map(|v| self.vertices[v as usize]);
            let heights = corners.map(&height);
            let corners = corners.map(|v| sub(v, origin));
            let cut = |below: usize, above: usize| {
                crossing(
                    corners[below],
                    heights[below],
                    corners[above],
                    heights[above],
                )
            };
            // The corner that is alone on its side of the plane, and those after it.
            let from = |i: usize| [i, (i + 1) % 3, (i + 2) % 3];
            match heights.map(|h| h <= 0.0) {
                [true, true, true] => sum.add(corners),
                [false, false, false] => {}
                [p, q, r] if usize::from(p) + usize::from(q) + usize::from(r) == 1 => {
                    let [a, b, c] = from(if p {
                        0
                    } else if q {
                        1
                    } else {
                        2
                    });
                    sum.add([corners[a], cut(a, b), cut(a, c)]);
                }
                [p, q, _] => {
                    let [a, b, c] = from(if !p {
                        0
                    } else if !q {
                        1
                    } else {
                        2
                    });
                    let end = cut(c, a);
                    sum.add([corners[b], corners[c], end]);
                    sum.add([corners[b], end, cut(b, a)]);
                }
            }
        }
        sum
    }
}

/// Where an edge from below to above meets the plane: the same bits for both triangles of the edge.
fn crossing(below: Vec3, low: f64, above: Vec3, high: f64) -> Vec3 {
    add(below, scale(low / (low - high), sub(above, below)))
}

/// Volume, first moment of the volume and sum of the vector areas.
#[derive(Default)]
struct Sum {
    volume: f64,
    moment: Vec3,
    area: Vec3,
}

impl Sum {
    fn add(&mut self, [a, b, c]: [Vec3; 3]) {
        let volume = dot(a, cross(b, c)) / 6.0;
        self.volume += volume;
        self.moment = add(self.moment, scale(0.25 * volume, add(add(a, b), c)));
        self.area = add(self.area, scale(0.5, cross(sub(b, a), sub(c, a))));
    }
}

/// Whether every edge is passed as often one way as the other.
fn closed(triangles: &[[u32; 3]]) -> bool {
    let mut edges = Vec::with_capacity(3 * triangles.len());
    for t in triangles {
        for k in 0..3 {
            let (a, b) = (t[k], t[(k + 1) % 3]);
            edges.push((a.min(b), a.max(b), if a < b { 1i32 } else { -1 }));
        }
    }
    edges.sort_unstable();
    edges
        .chunk_by(|p, q| (p.0, p.1) == (q.0, q.1))
        .all(|edge| edge.iter().map(|e| e.2).sum::<i32>() == 0)
}
