//! Which component is inside which.

use super::vector::{bounding_box, cross, dot, norm, sub};

/// Components that are looked at; scans have debris by the thousand.
const MOST: usize = 16;

/// For each root in `order`, largest first, the place there of the smallest closed component around it.
pub(super) fn containers(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    roots: &[usize],
    order: &[usize],
    closed: &[bool],
) -> Vec<Option<usize>> {
    let few = &order[..order.len().min(MOST)];
    let mut corners = vec![Vec::new(); few.len()];
    for (t, root) in triangles.iter().zip(roots) {
        if few.len() > 1
            && let Some(at) = few.iter().position(|r| r == root)
        {
            corners[at].push(t.map(|v| vertices[v as usize]));
        }
    }
    let holds = |outer: usize, inner: usize| {
        outer != inner && closed[few[outer]] && surrounds(&corners[outer], &corners[inner])
    };
    (0..order.len())
        .map(|inner| {
            let around = 0..if inner < few.len() { few.len() } else { 0 };
            around.rev().find(|&outer| holds(outer, inner))
        })
        .collect()
}

/// Whether a closed surface goes around another: around its box and its first corner.
fn surrounds(outer: &[[[f64; 3]; 3]], inner: &[[[f64; 3]; 3]]) -> bool {
    let Some(&[point, ..]) = inner.first() else {
        return false;
    };
    let [low, high] = bounding_box(outer.as_flattened());
    let [inner_low, inner_high] = bounding_box(inner.as_flattened());
    let boxed = (0..3).all(|k| low[k] < inner_low[k] && inner_high[k] < high[k]);
    boxed && winding_number(outer, point).abs() > 0.5
}

/// How often a closed surface goes around a point (A. van Oosterom, J. Strackee, 1983).
fn winding_number(triangles: &[[[f64; 3]; 3]], point: [f64; 3]) -> f64 {
    let solid_angle = |corners: &[[f64; 3]; 3]| {
        let [a, b, c] = corners.map(|v| sub(v, point));
        let [la, lb, lc] = [a, b, c].map(norm);
        let below = la * lb * lc + dot(a, b) * lc + dot(b, c) * la + dot(c, a) * lb;
        2.0 * libm::atan2(dot(a, cross(b, c)), below)
    };
    let sum: f64 = triangles.iter().map(solid_angle).sum();
    sum / (4.0 * std::f64::consts::PI)
}
