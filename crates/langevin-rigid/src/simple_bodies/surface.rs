//! Coarse surfaces to draw and to meet the ground with.

use std::f64::consts::PI;

use crate::body::Surface;
use crate::linalg::Vec3;

/// Sides of the polygon that a circle is drawn as; every axis has a vertex.
const SIDES: u32 = 32;
/// Steps from pole to pole of an ellipsoid.
const STEPS: u32 = 16;

/// The ellipsoid's: meridians and parallels about z, vertices on the body.
pub(super) fn ellipsoid(semi_axes: Vec3) -> Surface {
    let profile = (0..=STEPS).map(|n| {
        let (sin, cos) = libm::sincos(PI * f64::from(n) / f64::from(STEPS));
        match n {
            0 => [-1.0, 0.0],
            STEPS => [1.0, 0.0],
            _ => [-cos, sin],
        }
    });
    let mut surface = revolved(&profile.collect::<Vec<_>>(), 2);
    for v in &mut surface.vertices {
        *v = std::array::from_fn(|i| semi_axes[i] * v[i]);
    }
    surface
}

/// The cylinder's, along `axis`; vertices on the body.
pub(super) fn cylinder(radius: f64, half_length: f64, axis: usize) -> Surface {
    let (r, h) = (radius, half_length);
    revolved(&[[-h, 0.0], [-h, r], [h, r], [h, 0.0]], axis)
}

/// The box's twelve triangles.
pub(super) fn cuboid(half: Vec3) -> Surface {
    let corner = |n: u32| -> Vec3 {
        std::array::from_fn(|i| if n >> i & 1 == 1 { half[i] } else { -half[i] })
    };
    let mut triangles = Vec::with_capacity(12);
    for axis in 0..3 {
        let [up, u, v] = [axis, (axis + 1) % 3, (axis + 2) % 3].map(|i| 1u32 << i);
        triangles.extend([[up, up + u, up + u + v], [up, up + u + v, up + v]]);
        triangles.extend([[0, u + v, u], [0, v, u + v]]);
    }
    Surface {
        vertices: (0..8).map(corner).collect(),
        triangles,
        ..Surface::default()
    }
}

/// A surface of revolution about `axis`: `profile` has heights, ascending, and radii, the first and the
/// last zero.
fn revolved(profile: &[[f64; 2]], axis: usize) -> Surface {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    let point = |[height, radius]: [f64; 2], k: u32| {
        let (sin, cos) = side(k);
        let mut p = [0.0; 3];
        (p[axis], p[u], p[v]) = (height, radius * cos, radius * sin);
        p
    };
    let rings = &profile[1..profile.len() - 1];
    let mut vertices = vec![point(profile[0], 0)];
    vertices.extend(
        rings
            .iter()
            .flat_map(|at| (0..SIDES).map(|k| point(*at, k))),
    );
    vertices.push(point(profile[profile.len() - 1], 0));
    let (count, last) = (rings.len() as u32, vertices.len() as u32 - 1);
    let vertex = |ring: u32, k: u32| 1 + ring * SIDES + k % SIDES;
    let mut triangles = Vec::new();
    for k in 0..SIDES {
        triangles.push([0, vertex(0, k + 1), vertex(0, k)]);
        for ring in 1..count {
            let [a, b] = [vertex(ring - 1, k), vertex(ring - 1, k + 1)];
            let [c, d] = [vertex(ring, k + 1), vertex(ring, k)];
            triangles.extend([[a, b, c], [a, c, d]]);
        }
        triangles.push([last, vertex(count - 1, k), vertex(count - 1, k + 1)]);
    }
    Surface {
        vertices,
        triangles,
        ..Surface::default()
    }
}

/// Sine and cosine of the `k`th side's angle, exact on the axes.
fn side(k: u32) -> (f64, f64) {
    let (quarter, rest) = (4 * k / SIDES, 4 * k % SIDES);
    match rest {
        0 => [(0.0, 1.0), (1.0, 0.0), (0.0, -1.0), (-1.0, 0.0)][quarter as usize],
        _ => libm::sincos(2.0 * PI * f64::from(k) / f64::from(SIDES)),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::{cross, dot};

    fn volume(surface: &Surface) -> f64 {
        let volume = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| surface.vertices[v as usize]);
            dot(a, cross(b, c)) / 6.0
        };
        surface.triangles.iter().map(volume).sum()
    }

    #[test]
    fn surfaces_are_closed_and_face_outwards() {
        for (surface, wanted) in [
            (ellipsoid([1.0, 2.0, 3.0]), 8.0 * PI),
            (cylinder(2.0, 0.5, 1), 4.0 * PI),
            (cuboid([0.5, 1.0, 2.0]), 8.0),
        ] {
            let found = volume(&surface);
            assert!((found / wanted - 1.0).abs() < 0.03, "{found} for {wanted}");
            let mut edges = std::collections::BTreeMap::new();
            for t in &surface.triangles {
                for k in 0..3 {
                    let (a, b) = (t[k], t[(k + 1) % 3]);
                    *edges.entry((a.min(b), a.max(b))).or_insert(0) += if a < b { 1 } else { -1 };
                }
            }
            assert!(edges.values().all(|n| *n == 0));
        }
    }

    #[test]
    fn surfaces_reach_as_far_as_the_bodies() {
        let reach =
            |surface: &Surface, i: usize| surface.vertices.iter().map(|v| v[i]).fold(0.0, f64::max);
        let body = ellipsoid([1.0, 2.0, 3.0]);
        assert_eq!([0, 1, 2].map(|i| reach(&body, i)), [1.0, 2.0, 3.0]);
        let body = cylinder(2.0, 0.5, 1);
        assert_eq!([0, 1, 2].map(|i| reach(&body, i)), [2.0, 0.5, 2.0]);
    }
}
