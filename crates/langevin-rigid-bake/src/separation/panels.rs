//! The surface as flat panels with the gradients of the three potentials of translation.

use langevin_rigid::linalg::Vec3;

use crate::added_mass::Surface;
use crate::mesh::vector::{add, cross, dot, norm, scale, sub};

/// A triangle of the surface.
pub(super) struct Panel {
    /// Outward unit normal.
    pub(super) normal: Vec3,
    /// Area (m^2).
    pub(super) area: f64,
    /// Middles of the three edges (m): exact nodes for second moments.
    pub(super) middles: [Vec3; 3],
    /// Surface gradients of the potentials of unit velocity along x, y, z.
    gradients: [Vec3; 3],
    /// Potentials of the six unit motions at `middles` (m, m^2).
    pub(super) potentials: [[f64; 6]; 3],
}

/// All triangles that have an area.
pub(super) struct Panels(pub(super) Vec<Panel>);

/// A corner of a panel: where it is, and the potentials there.
type Corner = (Vec3, [f64; 6]);

impl Panels {
    pub(super) fn of(surface: &Surface) -> Panels {
        Panels(corners(surface).filter_map(Panel::of).collect())
    }

    /// The same with panels that reach no further than `longest` (m) along the unit vector `axis`.
    pub(super) fn shorter_than(surface: &Surface, axis: Vec3, longest: f64) -> Panels {
        let pieces = corners(surface).flat_map(|triangle| {
            let heights = triangle.map(|corner| dot(corner.0, axis));
            let high = heights.iter().copied().fold(f64::NEG_INFINITY, f64::max);
            let low = heights.iter().copied().fold(f64::INFINITY, f64::min);
            divided(triangle, ((high - low) / longest).ceil().max(1.0) as u32)
        });
        Panels(pieces.filter_map(Panel::of).collect())
    }
}

fn corners(surface: &Surface) -> impl Iterator<Item = [Corner; 3]> {
    let corner = |v: u32| {
        let v = v as usize;
        (surface.vertices[v], surface.potentials[v])
    };
    surface.triangles.iter().map(move |t| t.map(corner))
}

/// A triangle cut into n^2 equal ones.
fn divided([a, b, c]: [Corner; 3], n: u32) -> impl Iterator<Item = [Corner; 3]> {
    let at = move |i: u32, j: u32| -> Corner {
        let [u, v] = [i, j].map(|k| f64::from(k) / f64::from(n));
        let between = |a: f64, b: f64, c: f64| a + (u * (b - a) + v * (c - a));
        (
            std::array::from_fn(|k| between(a.0[k], b.0[k], c.0[k])),
            std::array::from_fn(|k| between(a.1[k], b.1[k], c.1[k])),
        )
    };
    (0..n).flat_map(move |i| {
        (0..n - i).flat_map(move |j| {
            let upright = [at(i, j), at(i + 1, j), at(i, j + 1)];
            let turned = (i + j + 1 < n).then(|| [at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)]);
            std::iter::once(upright).chain(turned)
        })
    })
}

impl Panel {
    /// `None` where there is no area.
    fn of(corners: [Corner; 3]) -> Option<Panel> {
        let [a, b, c] = corners.map(|corner| corner.0);
        let twice = cross(sub(b, a), sub(c, a));
        let size = norm(twice);
        if size == 0.0 || !size.is_finite() {
            return None;
        }
        let normal = scale(1.0 / size, twice);
        let hats = [sub(c, b), sub(a, c), sub(b, a)].map(|e| scale(1.0 / size, cross(normal, e)));
        let gradient = |k: usize| {
            let terms = [0, 1, 2].map(|i| scale(corners[i].1[k], hats[i]));
            add(add(terms[0], terms[1]), terms[2])
        };
        Some(Panel {
            normal,
            area: 0.5 * size,
            middles: [[a, b], [b, c], [c, a]].map(|[p, q]| scale(0.5, add(p, q))),
            gradients: [gradient(0), gradient(1), gradient(2)],
            potentials: [[0, 1], [1, 2], [2, 0]].map(|pair| {
                let [p, q] = pair.map(|i: usize| corners[i].1);
                std::array::from_fn(|k| 0.5 * (p[k] + q[k]))
            }),
        })
    }

    /// Squared speed of the fluid along the surface, relative to a body that moves along the unit
    /// vector `direction`, with the potential taken `share` times.
    pub(super) fn squared_slip(&self, direction: Vec3, share: f64) -> f64 {
        let [x, y, z] = self.gradients;
        let gradient = add(
            add(scale(direction[0], x), scale(direction[1], y)),
            scale(direction[2], z),
        );
        let tangential = sub(direction, scale(dot(direction, self.normal), self.normal));
        let slip = sub(scale(share, gradient), tangential);
        dot(slip, slip)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pieces_of_a_triangle_cover_it_and_keep_its_potentials() {
        let corner = |x: Vec3| (x, [x[0], 2.0 * x[1], 1.0, 0.0, x[0] + x[1], -3.0]);
        let triangle = [[0.0, 0.0, 0.0], [3.0, 0.5, 0.0], [1.0, 2.0, 1.0]].map(corner);
        let whole = Panel::of(triangle).unwrap();
        let pieces: Vec<Panel> = divided(triangle, 5).filter_map(Panel::of).collect();
        assert_eq!(pieces.len(), 25);
        let area: f64 = pieces.iter().map(|p| p.area).sum();
        assert!((area / whole.area - 1.0).abs() < 1e-14);
        for piece in &pieces {
            assert!((dot(piece.normal, whole.normal) - 1.0).abs() < 1e-14);
            for (x, potentials) in piece.middles.iter().zip(&piece.potentials) {
                for (found, wanted) in potentials.iter().zip(corner(*x).1) {
                    assert!((found - wanted).abs() < 1e-14);
                }
            }
        }
    }
}
