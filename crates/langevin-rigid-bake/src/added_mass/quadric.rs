//! Mean squared distance from the planes of triangles, as a quadratic form.

use super::panels::Vec3;
use crate::mesh::vector::{cross, dot, norm, scale, sub};

/// Sums of area, area n n^t, area n p and area p^2 over planes n . x = p.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Quadric {
    area: f64,
    square: [Vec3; 3],
    linear: Vec3,
    constant: f64,
}

impl Quadric {
    /// For each vertex the planes of its triangles, weighted with their areas.
    pub(super) fn of_vertices(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Quadric> {
        let mut quadrics = vec![Quadric::default(); vertices.len()];
        for t in triangles {
            let plane = Quadric::of_plane(t.map(|v| vertices[v as usize]));
            for &v in t {
                quadrics[v as usize].add(&plane);
            }
        }
        quadrics
    }

    fn of_plane([a, b, c]: [Vec3; 3]) -> Quadric {
        let twice = cross(sub(b, a), sub(c, a));
        let area = 0.5 * norm(twice);
        let n = scale(0.5 / area, twice);
        let p = dot(n, a);
        Quadric {
            area,
            square: n.map(|k| scale(area * k, n)),
            linear: scale(area * p, n),
            constant: area * p * p,
        }
    }

    pub(super) fn add(&mut self, other: &Quadric) {
        self.area += other.area;
        self.constant += other.constant;
        for k in 0..3 {
            self.linear[k] += other.linear[k];
            for l in 0..3 {
                self.square[k][l] += other.square[k][l];
            }
        }
    }

    /// Mean squared distance of `x` from the planes.
    pub(super) fn mean_square(&self, x: Vec3) -> f64 {
        let quadratic = dot(x, self.square.map(|row| dot(row, x)));
        ((quadratic - 2.0 * dot(self.linear, x) + self.constant) / self.area).max(0.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn planes_weigh_as_their_areas() {
        // A corner of a box: faces of areas 1, 2, 3 / 2.
        let vertices = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 3.0]];
        let quadrics = Quadric::of_vertices(&vertices, &[[0, 2, 1], [0, 1, 3], [0, 3, 2]]);
        let (xy, zx, yz) = (1.0, 1.5, 3.0);
        let x = [0.1, 0.2, 0.3];
        let want = (yz * 0.01 + zx * 0.04 + xy * 0.09) / (xy + zx + yz);
        assert!((quadrics[0].mean_square(x) - want).abs() < 1e-15);
        assert!((quadrics[1].mean_square(x) - (zx * 0.04 + xy * 0.09) / (xy + zx)).abs() < 1e-15);
    }
}
