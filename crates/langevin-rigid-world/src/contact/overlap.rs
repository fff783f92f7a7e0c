//! The area that two convex polygons share.

use arrayvec::ArrayVec;
use parry3d_f64::math::Vec2;

use crate::shape::OUTLINE;

/// Corners of a convex polygon; of an intersection there are as many as of both outlines at most.
pub(super) type Polygon = ArrayVec<Vec2, { 2 * OUTLINE }>;

/// The corners of the intersection of two convex polygons, both counter-clockwise (Sutherland and Hodgman 1974).
pub(super) fn overlap(subject: &Polygon, clip: &Polygon) -> Polygon {
    let mut kept = subject.clone();
    let mut next = Polygon::new();
    for (i, &from) in clip.iter().enumerate() {
        let along = clip[(i + 1) % clip.len()] - from;
        let side = |p: Vec2| along.perp_dot(p - from);
        next.clear();
        for (k, &here) in kept.iter().enumerate() {
            let before = kept[(k + kept.len() - 1) % kept.len()];
            let (was, is) = (side(before), side(here));
            if (was < 0.0) != (is < 0.0) {
                next.push(before + (here - before) * (was / (was - is)));
            }
            if is >= 0.0 {
                next.push(here);
            }
        }
        std::mem::swap(&mut kept, &mut next);
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn squares_share_a_square() {
        let square = |x: f64| {
            Polygon::from_iter([[x, 0.0], [x + 1.0, 0.0], [x + 1.0, 1.0], [x, 1.0]].map(Vec2::from))
        };
        let area = |p: &Polygon| {
            let next = |i: usize| p[(i + 1) % p.len()];
            0.5 * (0..p.len()).map(|i| p[i].perp_dot(next(i))).sum::<f64>()
        };
        let shared = overlap(&square(0.0), &square(0.25));
        assert!((area(&shared) - 0.75).abs() < 1e-12, "{shared:?}");
        assert!(overlap(&square(0.0), &square(2.0)).is_empty());
    }
}
