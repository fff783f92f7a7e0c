//! The part of a polyhedron that lies in a box.
//!
//! The polyhedron is a sum of signed tetrahedra. Each is cut by the six planes of the box; what a plane leaves of a
//! tetrahedron is one or three of them, so the moments stay exact.

use super::Moments;
use super::boxes::Corners;
use crate::mesh::TriMesh;
use crate::mesh::vector::{add, bounding_box, cross, dot, scale, sub};

type Tetrahedron = [[f64; 3]; 4];

/// Share of the tetrahedra's volume in a box that rounding may leave where the polyhedron has none.
const ROUNDING: f64 = 1e-12;

/// Moments about `origin` of what a mesh encloses within disjoint boxes; none if that has no volume.
pub(super) fn moments_within(
    mesh: &TriMesh,
    origin: [f64; 3],
    boxes: &[Corners],
) -> Option<Moments> {
    let boxes: Vec<Corners> = boxes
        .iter()
        .map(|corners| corners.map(|corner| sub(corner, origin)))
        .collect();
    let mut sum = Moments::default();
    let mut unsigned = 0.0;
    let mut parts = Vec::new();
    for t in 0..mesh.triangles().len() {
        let [a, b, c] = mesh.corners(t).map(|v| sub(v, origin));
        let sign = dot(a, cross(b, c)).signum();
        let whole = [[0.0; 3], a, b, c];
        for corners in &boxes {
            clip(whole, corners, &mut parts);
            for part in &parts {
                let volume = volume(part);
                unsigned += volume;
                sum.add_tetrahedron(sign * volume, part);
            }
        }
    }
    (sum.volume > ROUNDING * unsigned).then_some(sum)
}

/// Without its sign (m³).
fn volume(&[a, b, c, d]: &Tetrahedron) -> f64 {
    dot(sub(b, a), cross(sub(c, a), sub(d, a))).abs() / 6.0
}

/// Fills `parts` with what of a tetrahedron is in the box.
fn clip(whole: Tetrahedron, corners: &Corners, parts: &mut Vec<Tetrahedron>) {
    parts.clear();
    let [low, high] = bounding_box(&whole);
    if (0..3).any(|k| high[k] <= corners[0][k] || corners[1][k] <= low[k]) {
        return;
    }
    parts.push(whole);
    for k in 0..3 {
        for (corner, (outward, outmost)) in corners.iter().zip([(-1.0, low), (1.0, high)]) {
            let depth = |p: &[f64; 3]| outward * (corner[k] - p[k]);
            if depth(&outmost) >= 0.0 {
                continue;
            }
            *parts = parts.iter().flat_map(|part| cut(part, depth)).collect();
        }
    }
}

/// What of a tetrahedron has no negative depth under a plane.
fn cut(part: &Tetrahedron, depth: impl Fn(&[f64; 3]) -> f64) -> Vec<Tetrahedron> {
    let (inside, outside): (Vec<_>, Vec<_>) = part.iter().partition(|p| depth(p) >= 0.0);
    let between = |p: [f64; 3], q: [f64; 3]| {
        let (p_depth, q_depth) = (depth(&p), depth(&q));
        add(p, scale(p_depth / (p_depth - q_depth), sub(q, p)))
    };
    match (inside.as_slice(), outside.as_slice()) {
        (_, []) => vec![*part],
        (&[a], &[p, q, r]) => vec![[a, between(a, p), between(a, q), between(a, r)]],
        (&[a, b], &[p, q]) => prism(
            [a, between(a, p), between(a, q)],
            [b, between(b, p), between(b, q)],
        ),
        (&[a, b, c], &[p]) => prism([a, b, c], [a, b, c].map(|v| between(v, p))),
        _ => Vec::new(),
    }
}

/// The tetrahedra of a prism with these ends.
fn prism([a, b, c]: [[f64; 3]; 3], [p, q, r]: [[f64; 3]; 3]) -> Vec<Tetrahedron> {
    vec![[a, b, c, r], [a, b, q, r], [a, p, q, r]]
}
