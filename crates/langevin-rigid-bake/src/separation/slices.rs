//! Slices of a long body, each with its share of the added mass and the drag.
//!
//! A wing that turns about its root meets the stream at another angle at each distance from it; one
//! load at one point cannot tell. A body much longer than wide is cut across its long axis, and each
//! slice gets what its surface contributes to the integrals of the whole, so that the slices of a
//! straight body in uniform motion add up to the body. Slices overlap: a linear ramp leads from one
//! to the next, which keeps first moments exact on any triangles.

use langevin_rigid::linalg::{Mat3, Vec3, eigen_symmetric};
use langevin_rigid::{MOST_SLICES, Slice};

use super::panels::{Panel, Panels};
use crate::added_mass::AddedMass;
use crate::axes::PrincipalAxes;
use crate::extents::principal_extents;
use crate::mesh::TriMesh;
use crate::mesh::vector::{add, cross, dot, scale, sub};

/// Length over width from which a body is cut.
const LONG: f64 = 2.0;
/// Most slices of a body.
const MOST: usize = MOST_SLICES;

/// The slices of a long body, in the frame of its mesh; none for a body less than twice as long as
/// wide.
///
/// ```
/// use langevin_rigid_bake::added_mass::{Options, added_mass};
/// use langevin_rigid_bake::separation::slices;
/// use langevin_rigid_bake::shapes::Shape;
///
/// let lath = Shape::Box { size: [0.3, 0.002, 0.1] }.mesh(600)?;
/// let added = added_mass(&lath, &Options::default(), &())?;
/// let slices = slices(&lath, &added);
/// assert_eq!(slices.len(), 3);
/// let sum: f64 = slices.iter().map(|p| p.translation[1][1]).sum();
/// assert!((sum / added.tensor[1][1] - 1.0).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn slices(mesh: &TriMesh, added: &AddedMass) -> Vec<Slice> {
    let Some(slicing) = Slicing::of(mesh) else {
        return vec![];
    };
    let panels = Panels::shorter_than(&added.surface, slicing.axis, slicing.pitch);
    let level = panels.mean_potentials();
    (0..slicing.count)
        .map(|k| slicing.slice(k, &panels, &level, added.reference))
        .collect()
}

/// Where the slices are.
struct Slicing {
    /// Unit vector along the body.
    axis: Vec3,
    /// Middle of the first slice along it, and from middle to middle (m).
    first: f64,
    pitch: f64,
    count: usize,
    /// Half the length of the body (m).
    half_length: f64,
}

impl Slicing {
    fn of(mesh: &TriMesh) -> Option<Self> {
        let (axes, half) = principal_extents(mesh);
        let mut sorted = half;
        sorted.sort_by(|a, b| b.total_cmp(a));
        let ratio = sorted[0] / sorted[1];
        if ratio < LONG {
            return None;
        }
        let (_, columns) = eigen_symmetric(&axes.tensor(half));
        let axis: Vec3 = std::array::from_fn(|i| columns[i][2]);
        let heights = mesh.vertices().iter().map(|p| dot(*p, axis));
        let low = heights.clone().fold(f64::INFINITY, f64::min);
        let high = heights.fold(f64::NEG_INFINITY, f64::max);
        let count = (ratio.round() as usize).min(MOST);
        let pitch = (high - low) / count as f64;
        Some(Self {
            axis,
            first: low + 0.5 * pitch,
            pitch,
            count,
            half_length: 0.5 * (high - low),
        })
    }

    /// The share of slice `k` in what is at `x`.
    fn share(&self, k: usize, x: Vec3) -> f64 {
        let last = (self.count - 1) as f64;
        let at = ((dot(x, self.axis) - self.first) / self.pitch).clamp(0.0, last);
        (1.0 - (at - k as f64).abs()).max(0.0)
    }

    fn slice(&self, k: usize, panels: &Panels, level: &[f64; 6], centroid: Vec3) -> Slice {
        let nodes = || {
            panels.0.iter().flat_map(move |panel| {
                (0..3).map(move |n| {
                    let x = panel.middles[n];
                    Node {
                        x,
                        normal: panel.normal,
                        weight: panel.area / 3.0 * self.share(k, x),
                        potentials: std::array::from_fn(|m| panel.potentials[n][m] - level[m]),
                    }
                })
            })
        };
        let translation = positive(&sum(nodes().map(|n| n.translation())));
        let centre = self.centre(nodes(), centroid);
        let lever = sub(centre, centroid);
        let rotation = positive(&sum(nodes().map(|n| n.rotation(centre, lever))));
        let axes = PrincipalAxes::of(&translation);
        let share = |p: &Panel| p.middles.iter().map(|x| self.share(k, *x)).sum::<f64>() / 3.0;
        Slice {
            centre,
            translation,
            rotation,
            drag_area: axes.tensor(axes.along(|e| panels.drag_of(e, share).area())),
            extents: self.extents(&nodes(), &self.corners(k, panels)),
        }
    }

    /// Corners of the panels that have a share in the slice.
    fn corners(&self, k: usize, panels: &Panels) -> impl Iterator<Item = Vec3> + Clone {
        let shares = move |p: &&Panel| p.middles.iter().any(|x| self.share(k, *x) > 0.0);
        panels.0.iter().filter(shares).flat_map(|panel| {
            let [ab, bc, ca] = panel.middles;
            [
                sub(add(ab, ca), bc),
                sub(add(ab, bc), ca),
                sub(add(bc, ca), ab),
            ]
        })
    }

    /// Centre of the slice's added mass: along the body where the mass is, across it where the
    /// surface is; never outside the slice, where opposite shares of a small mass might put it.
    fn centre(&self, nodes: impl Iterator<Item = Node>, centroid: Vec3) -> Vec3 {
        let (mut mass, mut first, mut area, mut middle) = (0.0, 0.0, 0.0, [0.0; 3]);
        for n in nodes {
            let a = n.translation();
            let m = a[0][0] + a[1][1] + a[2][2];
            mass += m;
            first += m * dot(sub(n.x, centroid), self.axis);
            area += n.weight;
            middle = add(middle, scale(n.weight, n.x));
        }
        let middle = scale(1.0 / area, middle);
        if mass <= 0.0 {
            return middle;
        }
        let along = first / mass - dot(sub(middle, centroid), self.axis);
        add(
            middle,
            scale(along.clamp(-self.pitch, self.pitch), self.axis),
        )
    }

    /// Squared half-extents: along the body the body's, across it the chord from the second moments of the surface,
    /// which for a plate are a third of it. The two faces of a plate have the whole square of its thickness: that
    /// comes from the chord, as one width of the slice is to the other.
    fn extents(
        &self,
        nodes: &(impl Iterator<Item = Node> + Clone),
        corners: &(impl Iterator<Item = Vec3> + Clone),
    ) -> Mat3 {
        let total: f64 = nodes.clone().map(|n| n.weight).sum();
        let middle = nodes
            .clone()
            .fold([0.0; 3], |m, n| add(m, scale(n.weight / total, n.x)));
        let across = |x: Vec3| {
            let d = sub(x, middle);
            sub(d, scale(dot(d, self.axis), self.axis))
        };
        let moments = sum(nodes.clone().map(|n| {
            let d = across(n.x);
            outer(3.0 * n.weight / total, d, d)
        }));
        let ([_, thick, chord], axes) = eigen_symmetric(&moments);
        let direction = |k: usize| -> Vec3 { std::array::from_fn(|i| axes[i][k]) };
        let width = |e: Vec3| {
            let places = corners.clone().map(|x| dot(across(x), e));
            let (low, high) = places.fold((f64::MAX, f64::MIN), |(l, h), x| (l.min(x), h.max(x)));
            high - low
        };
        let ratio = width(direction(1)) / width(direction(2));
        let excess = (thick - chord * ratio * ratio).max(0.0);
        let along = outer(self.half_length * self.half_length, self.axis, self.axis);
        sum([moments, along, outer(-excess, direction(1), direction(1))].into_iter())
    }
}

/// A quadrature node of the surface, with its weight in a slice.
struct Node {
    x: Vec3,
    normal: Vec3,
    weight: f64,
    potentials: [f64; 6],
}

impl Node {
    /// -phi_j n_i dS.
    fn translation(&self) -> Mat3 {
        let [x, y, z, ..] = self.potentials;
        outer(-self.weight, self.normal, [x, y, z])
    }

    /// The same for rotations about `centre`, which are those about the centroid less the
    /// translation of the `lever` between the two.
    fn rotation(&self, centre: Vec3, lever: Vec3) -> Mat3 {
        let [x, y, z, rx, ry, rz] = self.potentials;
        // (e_j x lever) . phi = (lever x phi)_j
        let carried = cross(lever, [x, y, z]);
        let about = sub([rx, ry, rz], carried);
        outer(-self.weight, cross(sub(self.x, centre), self.normal), about)
    }
}

impl Panels {
    fn mean_potentials(&self) -> [f64; 6] {
        let total: f64 = self.0.iter().map(|p| p.area).sum();
        std::array::from_fn(|k| {
            let mean = |p: &Panel| p.area / 3.0 * p.potentials.iter().map(|v| v[k]).sum::<f64>();
            self.0.iter().map(mean).sum::<f64>() / total
        })
    }
}

fn outer(s: f64, a: Vec3, b: Vec3) -> Mat3 {
    a.map(|x| b.map(|y| s * x * y))
}

fn sum(terms: impl Iterator<Item = Mat3>) -> Mat3 {
    terms.fold([[0.0; 3]; 3], |s, t| {
        std::array::from_fn(|i| std::array::from_fn(|j| s[i][j] + t[i][j]))
    })
}

/// The symmetric part, without what rounding and neighbours leave below zero.
fn positive(m: &Mat3) -> Mat3 {
    let symmetric: Mat3 =
        std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (m[i][j] + m[j][i])));
    let (values, columns) = eigen_symmetric(&symmetric);
    sum((0..3).map(|k| {
        let axis: Vec3 = std::array::from_fn(|i| columns[i][k]);
        outer(values[k].max(0.0), axis, axis)
    }))
}
