//! What a tensor solved on one surface says of the body of another, near it.
//!
//! Moving the surface outwards by d changes the tensor by II (u_i . u_j - w_i . w_j) d dS to first order,
//! with u the slip velocity seen from the body and w the body's own (J. Hadamard's variation; for a
//! sphere it gives d(A + V)/da = 6 pi a^2, as it must).

use rayon::prelude::*;

use super::AddedMass;
use crate::mass_properties::MassProperties;
use crate::mesh::TriMesh;
use crate::mesh::vector::{add, bounding_box, cross, dot, norm, scale, sub};

type Vec3 = [f64; 3];

/// Triangles that a search for the nearest passes over together.
const GROUP: usize = 32;

/// How another surface differs from the one solved on.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ShapeError {
    /// Largest distance of a vertex of the other surface (m).
    pub deviation: f64,
    /// What the distances may change the tensor by, relative as
    /// [`AddedMass::error_estimate`]: no signs cancel in it.
    pub estimate: f64,
}

impl AddedMass {
    /// How far the tensor may be from that of `body`, a mesh close to the one it was solved on, as the
    /// fine one of a [proxy](TriMesh::proxy) is.
    pub fn shape_error(&self, body: &TriMesh) -> ShapeError {
        let body = &*body.wetted();
        let slips = self.slips();
        let search = Search::new(&slips);
        let areas = vertex_areas(body);
        let weighted: Vec<(f64, [f64; 6])> = body
            .vertices()
            .par_iter()
            .zip(&areas)
            .with_min_len(64)
            .map(|(&x, &area)| {
                let (distance, slip) = search.nearest(x);
                let change = slip.change(sub(x, self.reference));
                (distance, change.map(|c| c.abs() * area * distance))
            })
            .collect();
        let inertia = MassProperties::of(body, 1.0).map_or([[0.0; 3]; 3], |m| m.inertia);
        let deviation = weighted.iter().fold(0.0, |most, w| f64::max(most, w.0));
        let estimate = (0..6).fold(0.0, |most, i| {
            let change: f64 = weighted.iter().map(|w| w.1[i]).sum();
            let block = i / 3 * 3;
            let largest = (block..block + 3).fold(0.0, |l, k| {
                let displaced = if block == 3 {
                    inertia[k - 3][k - 3]
                } else {
                    0.0
                };
                f64::max(l, self.tensor[k][k].max(displaced))
            });
            f64::max(most, change / largest)
        });
        ShapeError {
            deviation,
            estimate,
        }
    }

    fn slips(&self) -> Vec<Slip> {
        let surface = &self.surface;
        let slip = |t: &[u32; 3]| {
            let points = t.map(|v| surface.vertices[v as usize]);
            let potentials = t.map(|v| surface.potentials[v as usize]);
            Slip::new(points, &potentials, self.reference)
        };
        surface.triangles.iter().map(slip).collect()
    }
}

/// A triangle of the surface and the squared slip velocity of each unit motion on it.
struct Slip {
    points: [Vec3; 3],
    squared: [f64; 6],
}

impl Slip {
    fn new(points: [Vec3; 3], potentials: &[[f64; 6]; 3], reference: Vec3) -> Slip {
        let [a, b, c] = points;
        let twice = cross(sub(b, a), sub(c, a));
        let normal = scale(1.0 / norm(twice), twice);
        let middle = sub(scale(1.0 / 3.0, add(add(a, b), c)), reference);
        let opposite = [sub(c, b), sub(a, c), sub(b, a)];
        let squared = std::array::from_fn(|i| {
            let gradient = (0..3).fold([0.0; 3], |sum, k| {
                let hat = scale(1.0 / norm(twice), cross(normal, opposite[k]));
                add(sum, scale(potentials[k][i], hat))
            });
            let own = rigid(i, middle);
            let along = sub(own, scale(dot(own, normal), normal));
            let slip = sub(gradient, along);
            dot(slip, slip)
        });
        Slip { points, squared }
    }

    /// u . u - w . w of each unit motion, at `x` from the reference.
    fn change(&self, x: Vec3) -> [f64; 6] {
        std::array::from_fn(|i| {
            let own = rigid(i, x);
            self.squared[i] - dot(own, own)
        })
    }
}

/// Velocity of unit motion `i` at `x` from the reference.
fn rigid(i: usize, x: Vec3) -> Vec3 {
    let axis: Vec3 = std::array::from_fn(|k| f64::from(k == i % 3));
    if i < 3 { axis } else { cross(axis, x) }
}

/// A third of the area of its triangles for each vertex.
fn vertex_areas(mesh: &TriMesh) -> Vec<f64> {
    let mut areas = vec![0.0; mesh.vertices().len()];
    for t in mesh.triangles() {
        let [a, b, c] = t.map(|v| mesh.vertices()[v as usize]);
        let third = norm(cross(sub(b, a), sub(c, a))) / 6.0;
        for &v in t {
            areas[v as usize] += third;
        }
    }
    areas
}

/// Triangles in groups, to look for the nearest one.
struct Search<'a> {
    slips: &'a [Slip],
    bounds: Vec<[Vec3; 2]>,
}

impl<'a> Search<'a> {
    fn new(slips: &'a [Slip]) -> Search<'a> {
        let bounds = slips.chunks(GROUP).map(|group| {
            let points: Vec<Vec3> = group.iter().flat_map(|s| s.points).collect();
            bounding_box(&points)
        });
        Search {
            slips,
            bounds: bounds.collect(),
        }
    }

    fn nearest(&self, x: Vec3) -> (f64, &Slip) {
        let mut best = (f64::INFINITY, &self.slips[0]);
        let mut groups: Vec<(f64, usize)> = self
            .bounds
            .iter()
            .enumerate()
            .map(|(g, [low, high])| {
                let out: Vec3 =
                    std::array::from_fn(|k| (low[k] - x[k]).max(x[k] - high[k]).max(0.0));
                (dot(out, out), g)
            })
            .collect();
        groups.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        for (least2, group) in groups {
            if least2 > best.0 * best.0 {
                break;
            }
            for slip in self.slips[group * GROUP..].iter().take(GROUP) {
                let distance = distance(x, &slip.points);
                if distance < best.0 {
                    best = (distance, slip);
                }
            }
        }
        best
    }
}

/// Distance of a point from a triangle.
fn distance(x: Vec3, [a, b, c]: &[Vec3; 3]) -> f64 {
    let normal = cross(sub(*b, *a), sub(*c, *a));
    let inside = [(a, b), (b, c), (c, a)]
        .iter()
        .all(|(p, q)| dot(cross(sub(**q, **p), sub(x, **p)), normal) >= 0.0);
    if inside {
        return (dot(sub(x, *a), normal) / norm(normal)).abs();
    }
    [(a, b), (b, c), (c, a)]
        .iter()
        .fold(f64::INFINITY, |least, (p, q)| {
            let (edge, from) = (sub(**q, **p), sub(x, **p));
            let along = (dot(from, edge) / dot(edge, edge)).clamp(0.0, 1.0);
            least.min(norm(sub(from, scale(along, edge))))
        })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::added_mass::{Options, added_mass};
    use crate::shapes::Shape;

    #[test]
    fn a_point_is_as_far_as_the_nearest_part_of_a_triangle() {
        let t = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]];
        assert_eq!(distance([0.2, 0.2, 0.5], &t), 0.5);
        assert_eq!(distance([0.5, -2.0, 0.0], &t), 2.0);
        assert_eq!(distance([-3.0, -4.0, 0.0], &t), 5.0);
    }

    #[test]
    fn a_larger_sphere_has_more_added_mass_by_the_variation() {
        let sphere = |radius: f64| {
            let shape = Shape::Ellipsoid {
                semi_axes: [radius; 3],
            };
            shape.mesh(5120).unwrap()
        };
        let result = added_mass(&sphere(1.0), &Options::default(), &()).unwrap();
        let error = result.shape_error(&sphere(1.001));
        assert!((error.deviation / 0.001 - 1.0).abs() < 0.01, "{error:?}");
        // A grows by 0.3 %; without signs the integral of |9/4 sin^2 - 1| is that of its value times
        // some 1.3.
        assert!((0.003..0.006).contains(&error.estimate), "{error:?}");
    }

    #[cfg(feature = "meshopt")]
    #[test]
    fn the_estimate_of_a_proxy_bounds_its_error() {
        let shapes = [
            Shape::Ellipsoid {
                semi_axes: [0.01, 0.02, 0.04],
            },
            Shape::Ellipsoid {
                semi_axes: [0.05, 0.02, 0.004],
            },
            Shape::Cylinder {
                radius: 0.02,
                height: 0.1,
            },
        ];
        for shape in shapes {
            let fine = shape.mesh(5120).unwrap();
            let truth = added_mass(&fine, &Options::default(), &()).unwrap().tensor;
            for triangles in [300, 1000] {
                let proxy = fine.proxy(triangles).unwrap();
                let result = added_mass(&proxy, &Options::default(), &()).unwrap();
                let estimate = result.shape_error(&fine).estimate + result.error_estimate;
                for i in 0..6 {
                    let block = i / 3 * 3;
                    let largest = (block..block + 3).fold(0.0, |l, k| f64::max(l, truth[k][k]));
                    let error = (result.tensor[i][i] - truth[i][i]).abs() / largest;
                    assert!(
                        error < estimate,
                        "{shape:?}, {triangles}, {i}: {error:e} of {estimate:e}"
                    );
                }
                assert!(estimate < 0.2, "{shape:?}, {triangles}: {estimate}");
            }
        }
    }
}
