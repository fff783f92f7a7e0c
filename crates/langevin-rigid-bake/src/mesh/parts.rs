//! What is joined to what: union-find with orientation, and what it makes of triangles.

use super::edges::{Side, by_edge, disagree};
use super::vector::bounding_box;

/// Union-find whose elements also carry a sign relative to their root.
pub(super) struct SignedParts {
    parent: Vec<usize>,
    flipped: Vec<bool>,
}

impl SignedParts {
    pub(super) fn new(n: usize) -> SignedParts {
        SignedParts {
            parent: (0..n).collect(),
            flipped: vec![false; n],
        }
    }

    /// The root of an element and whether their signs differ; halves the path on the way.
    pub(super) fn root(&mut self, mut x: usize) -> (usize, bool) {
        let mut flipped = false;
        while self.parent[x] != x {
            let up = self.parent[x];
            // A root's own flag is never set, so this also holds one step below it.
            self.flipped[x] ^= self.flipped[up];
            self.parent[x] = self.parent[up];
            flipped ^= self.flipped[x];
            x = self.parent[x];
        }
        (x, flipped)
    }

    /// Joins two parts so that `a` and `b` have opposite signs (`opposite`) or the same; `false`
    /// where they are joined already and contradict that.
    pub(super) fn join(&mut self, a: usize, b: usize, opposite: bool) -> bool {
        let (root_a, flip_a) = self.root(a);
        let (root_b, flip_b) = self.root(b);
        let flip = flip_a ^ flip_b ^ opposite;
        if root_a == root_b {
            return !flip;
        }
        let (low, high) = (root_a.min(root_b), root_a.max(root_b));
        self.parent[high] = low;
        self.flipped[high] = flip;
        true
    }
}

/// For each vertex the number of its component, counted in the order of their lowest vertices.
pub(crate) fn vertex_components(
    vertex_count: usize,
    triangles: impl Iterator<Item = [u32; 3]>,
) -> Vec<u32> {
    let mut parts = SignedParts::new(vertex_count);
    for [a, b, c] in triangles.map(|t| t.map(|v| v as usize)) {
        parts.join(a, b, false);
        parts.join(b, c, false);
    }
    let mut numbers = vec![0; vertex_count];
    let mut count = 0;
    for v in 0..vertex_count {
        let root = parts.root(v).0;
        if root == v {
            numbers[v] = count;
            count += 1;
        }
        numbers[v] = numbers[root];
    }
    numbers
}

/// For each triangle the lowest triangle that is reached from it by crossing edges of exactly two.
pub(super) fn components(triangle_count: usize, sides: &[Side]) -> Vec<usize> {
    let mut parts = SignedParts::new(triangle_count);
    for edge in by_edge(sides).filter(|edge| edge.len() == 2) {
        parts.join(edge[0].triangle as usize, edge[1].triangle as usize, false);
    }
    (0..triangle_count).map(|t| parts.root(t).0).collect()
}

/// Lowest and highest corner of the box about each component (m), at the number of its first triangle.
pub(super) fn boxes(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    root_of: &[usize],
) -> Vec<[[f64; 3]; 2]> {
    let mut boxes = vec![bounding_box(&[]); triangles.len()];
    for (t, &root) in triangles.iter().zip(root_of) {
        let [low, high] = bounding_box(&t.map(|v| vertices[v as usize]));
        let [lowest, highest] = &mut boxes[root];
        for k in 0..3 {
            lowest[k] = lowest[k].min(low[k]);
            highest[k] = highest[k].max(high[k]);
        }
    }
    boxes
}

/// For each triangle the lowest one of its component, and whether the two wind in opposite senses; with
/// the first edge at which no choice of windings lets its triangles agree, if there is one.
pub(super) fn windings(
    triangle_count: usize,
    sides: &[Side],
) -> (Vec<(usize, bool)>, Option<Side>) {
    let mut parts = SignedParts::new(triangle_count);
    let mut one_sided = None;
    for edge in by_edge(sides).filter(|edge| edge.len() == 2) {
        let [a, b] = [edge[0].triangle as usize, edge[1].triangle as usize];
        if !parts.join(a, b, disagree(edge)) {
            one_sided = one_sided.or(Some(edge[0]));
        }
    }
    (
        (0..triangle_count).map(|t| parts.root(t)).collect(),
        one_sided,
    )
}

/// For each corner, three to a triangle, the lowest corner of its fan: the corners reached by crossing,
/// at their vertex, the edges whose two sides are `joined`.
pub(super) fn fans<'a>(
    triangles: &[[u32; 3]],
    joined: impl Iterator<Item = [&'a Side; 2]>,
) -> Vec<usize> {
    let corner = |t: u32, v: u32| {
        let place = triangles[t as usize].iter().position(|&w| w == v);
        3 * t as usize + place.unwrap_or(0)
    };
    let mut parts = SignedParts::new(3 * triangles.len());
    for [s, t] in joined {
        for v in s.vertices {
            parts.join(corner(s.triangle, v), corner(t.triangle, v), false);
        }
    }
    (0..3 * triangles.len()).map(|c| parts.root(c).0).collect()
}
