//! The triangles as the integrals need them: centred, scaled, in spatial order.

use crate::mesh::parts::vertex_components;
use crate::mesh::vector::{add, bounding_box, cross, dot, norm, scale, sub};

pub(super) type Vec3 = [f64; 3];

/// One flat triangle.
#[derive(Debug, Clone, Copy)]
pub(super) struct Panel {
    pub(super) corners: [u32; 3],
    pub(super) points: [Vec3; 3],
    pub(super) centroid: Vec3,
    pub(super) normal: Vec3,
    pub(super) area: f64,
    /// Square of the longest edge.
    pub(super) longest2: f64,
    /// Mean of xi xi^T over the triangle, xi from the centroid: xx, yy, zz, xy, xz, yz.
    pub(super) spread: [f64; 6],
    /// Surface curl n x grad N of the hat function of each corner.
    pub(super) curls: [Vec3; 3],
}

impl Panel {
    pub(super) fn new(corners: [u32; 3], points: [Vec3; 3]) -> Panel {
        let [a, b, c] = points;
        let twice = cross(sub(b, a), sub(c, a));
        let double_area = norm(twice);
        let edges = [sub(c, b), sub(a, c), sub(b, a)];
        let centroid = scale(1.0 / 3.0, add(add(a, b), c));
        Panel {
            corners,
            points,
            centroid,
            normal: scale(1.0 / double_area, twice),
            area: 0.5 * double_area,
            longest2: edges.iter().fold(0.0, |l, &e| f64::max(l, dot(e, e))),
            spread: spread(points.map(|p| sub(p, centroid))),
            curls: edges.map(|e| scale(-1.0 / double_area, e)),
        }
    }

    /// Whether the point lies over or under the triangle; its border counts.
    pub(super) fn covers(&self, point: Vec3) -> bool {
        (0..3).all(|k| {
            let (from, to) = (self.points[k], self.points[(k + 1) % 3]);
            let part = dot(cross(sub(to, from), sub(point, from)), self.normal);
            part > -1e-6 * self.area
        })
    }

    /// Longest edge over the height above it.
    pub(super) fn aspect(&self) -> f64 {
        self.longest2 / (2.0 * self.area)
    }
}

fn spread(corners: [Vec3; 3]) -> [f64; 6] {
    [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)]
        .map(|(i, j)| corners.iter().map(|p| p[i] * p[j]).sum::<f64>() / 12.0)
}

/// Triangles and vertices along a space-filling curve, so that neighbours in space are neighbours
/// in memory.
#[derive(Debug)]
pub(super) struct Panels {
    pub(super) vertices: Vec<Vec3>,
    pub(super) panels: Vec<Panel>,
    /// The caller's number of each vertex.
    pub(super) vertex_origin: Vec<u32>,
}

impl Panels {
    /// The component of the surface that each vertex is in.
    pub(super) fn components(&self) -> Vec<u32> {
        vertex_components(
            self.vertices.len(),
            self.panels.iter().map(|panel| panel.corners),
        )
    }

    pub(super) fn new(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Panels {
        let vertex_origin = curve_order(vertices);
        let mut rank = vec![0u32; vertices.len()];
        for (new, &old) in vertex_origin.iter().enumerate() {
            rank[old as usize] = new as u32;
        }
        let middles: Vec<Vec3> = triangles
            .iter()
            .map(|t| t.map(|v| vertices[v as usize]))
            .map(|[a, b, c]| scale(1.0 / 3.0, add(add(a, b), c)))
            .collect();
        let panels = curve_order(&middles)
            .into_iter()
            .map(|t| triangles[t as usize])
            .map(|t| Panel::new(t.map(|v| rank[v as usize]), t.map(|v| vertices[v as usize])))
            .collect();
        Panels {
            vertices: vertex_origin
                .iter()
                .map(|&v| vertices[v as usize])
                .collect(),
            panels,
            vertex_origin,
        }
    }
}

/// Indices of the points sorted along a Morton curve of 2^20 cells a side.
fn curve_order(points: &[Vec3]) -> Vec<u32> {
    let [low, high] = bounding_box(points);
    let size = (0..3).fold(f64::MIN_POSITIVE, |s, k| f64::max(s, high[k] - low[k]));
    let cell = |x: f64, k: usize| ((x - low[k]) / size * 1_048_575.0) as u64;
    let mut keys: Vec<(u64, u32)> = points
        .iter()
        .enumerate()
        .map(|(i, p)| {
            let key = (0..3).fold(0, |key, k| key | (spread_bits(cell(p[k], k)) << k));
            (key, i as u32)
        })
        .collect();
    keys.sort_unstable();
    keys.into_iter().map(|(_, i)| i).collect()
}

/// Puts two zero bits between the lowest 21 bits of `x`.
fn spread_bits(x: u64) -> u64 {
    let mut x = x & 0x1f_ffff;
    x = (x | (x << 32)) & 0x1f_0000_0000_ffff;
    x = (x | (x << 16)) & 0x1f_0000_ff00_00ff;
    x = (x | (x << 8)) & 0x100f_00f0_0f00_f00f;
    x = (x | (x << 4)) & 0x10c3_0c30_c30c_30c3;
    (x | (x << 2)) & 0x1249_2492_4924_9249
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn curls_of_a_triangle_sum_to_zero_and_turn_the_gradient() {
        let p = Panel::new(
            [0, 1, 2],
            [[0.0, 0.0, 1.0], [2.0, 0.0, 1.0], [0.5, 3.0, 1.0]],
        );
        let sum = add(add(p.curls[0], p.curls[1]), p.curls[2]);
        assert!(norm(sum) < 1e-15);
        // N of the third corner is y/3: n x grad N = z x (0, 1/3, 0).
        assert!(norm(sub(p.curls[2], [-1.0 / 3.0, 0.0, 0.0])) < 1e-15);
        assert!((p.area - 3.0).abs() < 1e-15);
    }

    #[test]
    fn spread_is_the_second_moment() {
        // Right isosceles legs 1: <xi^2> = 1/18, <xi eta> = -1/36.
        let p = Panel::new([0, 1, 2], [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]);
        assert!((p.spread[0] - 1.0 / 18.0).abs() < 1e-16);
        assert!((p.spread[3] + 1.0 / 36.0).abs() < 1e-16);
    }

    #[test]
    fn order_keeps_every_vertex_once() {
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let p = Panels::new(&vertices, &[[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]);
        let mut origin = p.vertex_origin.clone();
        origin.sort_unstable();
        assert_eq!(origin, [0, 1, 2, 3]);
        for panel in &p.panels {
            for k in 0..3 {
                assert_eq!(p.vertices[panel.corners[k] as usize], panel.points[k]);
            }
        }
    }
}
