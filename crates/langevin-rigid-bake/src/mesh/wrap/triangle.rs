//! The point of a triangle nearest to another.

use crate::mesh::vector::{add, cross, dot, scale, sub};

/// The point of the triangle a b c nearest to `p`.
pub(super) fn nearest(p: [f64; 3], corners: [[f64; 3]; 3]) -> [f64; 3] {
    let [a, b, c] = corners;
    let normal = cross(sub(b, a), sub(c, a));
    let square = dot(normal, normal);
    let beside = |k: usize| {
        let (from, to) = (corners[k], corners[(k + 1) % 3]);
        dot(cross(normal, sub(to, from)), sub(p, from)) < 0.0
    };
    if square > 0.0 && !(0..3).any(beside) {
        return sub(p, scale(dot(normal, sub(p, a)) / square, normal));
    }
    let on_side = |k: usize| on_segment(p, corners[k], corners[(k + 1) % 3]);
    let distance2 = |q: &[f64; 3]| dot(sub(*q, p), sub(*q, p));
    [on_side(1), on_side(2)]
        .into_iter()
        .fold(on_side(0), |best, q| {
            if distance2(&q) < distance2(&best) {
                q
            } else {
                best
            }
        })
}

fn on_segment(p: [f64; 3], a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    let along = sub(b, a);
    let square = dot(along, along);
    let at = if square > 0.0 {
        dot(sub(p, a), along) / square
    } else {
        0.0
    };
    add(a, scale(at.clamp(0.0, 1.0), along))
}
