//! Which component is inside which.

use rstar::primitives::{GeomWithData, Rectangle};
use rstar::{AABB, RTree};

use super::parts;
use super::vector::bounding_box;

/// For each of the `roots`, the closed components around its first corner, by their place among the `roots`.
///
/// `root_of` gives the root, the lowest triangle, of each triangle's component. A component is inside another only if
/// its box is, so that rounding never puts two into each other; surfaces that meet are inside or not, as their first
/// corners happen to be.
pub(super) fn around(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    root_of: &[usize],
    roots: &[usize],
    closed: impl Fn(usize) -> bool,
) -> Vec<Vec<usize>> {
    if roots.len() < 2 {
        return vec![Vec::new(); roots.len()];
    }
    let mut places = vec![usize::MAX; triangles.len()];
    for (place, &root) in roots.iter().enumerate() {
        places[root] = place;
    }
    let corners = |t: usize| triangles[t].map(|v| vertices[v as usize]);
    let shadow = |t: usize| {
        let [low, high] = bounding_box(&corners(t));
        let flat = |p: [f64; 3]| [p[1], p[2]];
        GeomWithData::new(Rectangle::from_corners(flat(low), flat(high)), t)
    };
    let boxes = parts::boxes(vertices, triangles, root_of);
    let holds = |outer: usize, inner: usize| {
        let [outer, inner] = [outer, inner].map(|place| boxes[roots[place]]);
        let ([low, high], [inner_low, inner_high]) = (outer, inner);
        outer != inner && (0..3).all(|i| low[i] <= inner_low[i] && inner_high[i] <= high[i])
    };
    let shadows = (0..triangles.len()).filter(|&t| closed(root_of[t]));
    let tree = RTree::bulk_load(shadows.map(shadow).collect());
    let surrounding = |(place, &root): (usize, &usize)| {
        let point = corners(root)[0];
        let under = tree.locate_in_envelope_intersecting(AABB::from_point([point[1], point[2]]));
        let mut hit: Vec<usize> = under
            .map(|shadow| shadow.data)
            .filter(|&t| places[root_of[t]] != place && is_hit(point, corners(t)))
            .map(|t| places[root_of[t]])
            .collect();
        hit.sort_unstable();
        let odd = hit
            .chunk_by(|a, b| a == b)
            .filter(|hits| hits.len() % 2 == 1);
        odd.map(|hits| hits[0])
            .filter(|&outer| holds(outer, place))
            .collect()
    };
    roots.iter().enumerate().map(surrounding).collect()
}

/// Whether the ray from `point` along x hits a triangle. A ray through an edge or a vertex hits a closed surface
/// as often as one beside it: edges count as half open, the same from both of their triangles.
fn is_hit(point: [f64; 3], corners: [[f64; 3]; 3]) -> bool {
    let [px, py, pz] = point;
    let mut inside = false;
    for k in 0..3 {
        let (mut a, mut b) = (corners[k], corners[(k + 1) % 3]);
        if (a[1], a[2]) > (b[1], b[2]) {
            std::mem::swap(&mut a, &mut b);
        }
        if (a[1] > py) != (b[1] > py) {
            let at = a[2] + (py - a[1]) / (b[1] - a[1]) * (b[2] - a[2]);
            inside ^= at > pz;
        }
    }
    inside && height(corners, [py, pz]).is_some_and(|x| x > px)
}

/// The x of a triangle's plane over a point of the plane x = 0.
fn height([a, b, c]: [[f64; 3]; 3], [y, z]: [f64; 2]) -> Option<f64> {
    let side = |p: [f64; 3], q: [f64; 3]| (p[1] - y) * (q[2] - z) - (p[2] - z) * (q[1] - y);
    let weights = [side(b, c), side(c, a), side(a, b)];
    let sum: f64 = weights.iter().sum();
    let x = (weights[0] * a[0] + weights[1] * b[0] + weights[2] * c[0]) / sum;
    x.is_finite().then_some(x)
}
