//! Building surfaces whose vertices are found again by their place on some grid.

use std::collections::BTreeMap;

use super::ShapeError;
use crate::mesh::TriMesh;

/// A surface under construction; a place is any triple of numbers that tells vertices apart.
pub(super) struct Builder<P: Fn([usize; 3]) -> [f64; 3]> {
    position: P,
    numbers: BTreeMap<[usize; 3], u32>,
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

impl<P: Fn([usize; 3]) -> [f64; 3]> Builder<P> {
    /// An empty surface; `position` gives the coordinates (m) at a place.
    pub(super) fn new(position: P) -> Self {
        Builder {
            position,
            numbers: BTreeMap::new(),
            vertices: vec![],
            triangles: vec![],
        }
    }

    /// Adds a triangle, its places counter-clockwise seen from outside, or clockwise if `flipped`.
    pub(super) fn triangle(&mut self, places: [[usize; 3]; 3], flipped: bool) {
        let [a, b, c] = places.map(|place| self.vertex(place));
        self.triangles
            .push(if flipped { [a, c, b] } else { [a, b, c] });
    }

    /// Adds a quadrilateral a b c d, split along a c, or along b d if `other_diagonal`.
    pub(super) fn quad(
        &mut self,
        [a, b, c, d]: [[usize; 3]; 4],
        other_diagonal: bool,
        flipped: bool,
    ) {
        let pair = if other_diagonal {
            [[a, b, d], [b, c, d]]
        } else {
            [[a, b, c], [a, c, d]]
        };
        for places in pair {
            self.triangle(places, flipped);
        }
    }

    /// Fills the strip between two rows of places, from the first two to the last two, with
    /// triangles counter-clockwise where `far` lies to the right of `near` (seen along the rows).
    pub(super) fn strip(&mut self, near: &[[usize; 3]], far: &[[usize; 3]], flipped: bool) {
        let (near_steps, far_steps) = (near.len() - 1, far.len() - 1);
        let (mut i, mut j) = (0, 0);
        while i < near_steps || j < far_steps {
            // Advance where the middle of the next step comes first.
            if i == near_steps
                || j < far_steps && (2 * j + 1) * near_steps <= (2 * i + 1) * far_steps
            {
                self.triangle([near[i], far[j], far[j + 1]], flipped);
                j += 1;
            } else {
                self.triangle([near[i], far[j], near[i + 1]], flipped);
                i += 1;
            }
        }
    }

    fn vertex(&mut self, place: [usize; 3]) -> u32 {
        *self.numbers.entry(place).or_insert_with(|| {
            self.vertices.push((self.position)(place));
            self.vertices.len() as u32 - 1
        })
    }

    pub(super) fn finish(self) -> Result<TriMesh, ShapeError> {
        Ok(TriMesh::new(self.vertices, self.triangles)?)
    }
}

/// The value in [`low`, `high`] at which a non-decreasing count comes nearest to `wish` (of two
/// equally near counts, the smaller), by bisection.
pub(super) fn nearest(count: impl Fn(f64) -> usize, low: f64, high: f64, wish: usize) -> f64 {
    let (mut below, mut above) = (low, high);
    for _ in 0..100 {
        let middle = 0.5 * (below + above);
        if count(middle) <= wish {
            below = middle;
        } else {
            above = middle;
        }
    }
    let distance = |x: f64| count(x).abs_diff(wish);
    if distance(above) < distance(below) {
        above
    } else {
        below
    }
}
