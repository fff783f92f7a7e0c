//! Nodes in space: how far each is from the triangles, and whether the fluid reaches it.

use super::triangle;
use crate::mesh::vector::{add, bounding_box, dot, norm, scale, sub};

/// Nodes between the triangles and the faces of the grid.
const MARGIN: f64 = 3.0;
/// Longest side of a triangle, in distances of nodes, whose box is looked at whole.
const SHORT: f64 = 6.0;
const NONE: u32 = u32::MAX;

pub(super) type Corners = [[f64; 3]; 3];

pub(super) struct Grid<'a> {
    corners: &'a [Corners],
    low: [f64; 3],
    pitch: f64,
    pub(super) counts: [usize; 3],
    /// Distance from the triangles, where they are near (m).
    distance: Vec<f32>,
    /// Which of them is nearest.
    nearest: Vec<u32>,
    reached: Vec<bool>,
}

/// Lowest corner and numbers of nodes.
pub(super) type Lattice = ([f64; 3], [usize; 3]);

impl<'a> Grid<'a> {
    /// How many nodes it takes, and where; nothing without triangles.
    pub(super) fn lattice(corners: &[Corners], pitch: f64) -> Option<(f64, Lattice)> {
        if corners.is_empty() {
            return None;
        }
        let [low, high] = bounding_box(corners.as_flattened());
        let counts = sub(high, low).map(|x| (x / pitch).ceil() + 2.0 * MARGIN + 1.0);
        let from = low.map(|x| x - MARGIN * pitch);
        Some((counts.iter().product(), (from, counts.map(|n| n as usize))))
    }

    pub(super) fn new(
        corners: &'a [Corners],
        pitch: f64,
        offset: f64,
        (low, counts): Lattice,
    ) -> Grid<'a> {
        let nodes = counts.iter().product();
        let mut grid = Grid {
            corners,
            low,
            pitch,
            counts,
            distance: vec![f32::INFINITY; nodes],
            nearest: vec![NONE; nodes],
            reached: vec![false; nodes],
        };
        for (number, triangle) in (0..).zip(corners) {
            grid.approach(number, *triangle, 2.0 * offset);
        }
        grid.flood(offset as f32);
        grid
    }

    pub(super) fn number(&self, [i, j, k]: [usize; 3]) -> usize {
        (k * self.counts[1] + j) * self.counts[0] + i
    }

    pub(super) fn place(&self, at: [usize; 3]) -> [f64; 3] {
        add(self.low, scale(self.pitch, at.map(|n| n as f64)))
    }

    /// Enters the distance of the nodes within `band` of a triangle, a long one in halves.
    fn approach(&mut self, number: u32, triangle: Corners, band: f64) {
        let [a, b, c] = triangle;
        let sides = [[a, b, c], [b, c, a], [c, a, b]];
        let length = |side: &Corners| norm(sub(side[1], side[0]));
        let [p, q, r] = sides.into_iter().fold(sides[0], |longest, side| {
            if length(&side) > length(&longest) {
                side
            } else {
                longest
            }
        });
        if length(&[p, q, r]) > SHORT * self.pitch {
            let middle = scale(0.5, add(p, q));
            self.approach(number, [p, middle, r], band);
            self.approach(number, [middle, q, r], band);
            return;
        }
        let [low, high] = bounding_box(&triangle);
        let first = self.node(low.map(|x| x - band), f64::ceil);
        let last = self.node(high.map(|x| x + band), f64::floor);
        for k in first[2]..=last[2] {
            for j in first[1]..=last[1] {
                for i in first[0]..=last[0] {
                    let place = self.place([i, j, k]);
                    let d = norm(sub(triangle::nearest(place, triangle), place)) as f32;
                    let node = self.number([i, j, k]);
                    if d < self.distance[node] {
                        (self.distance[node], self.nearest[node]) = (d, number);
                    }
                }
            }
        }
    }

    fn node(&self, p: [f64; 3], round: fn(f64) -> f64) -> [usize; 3] {
        std::array::from_fn(|k| {
            let at = round((p[k] - self.low[k]) / self.pitch);
            at.clamp(0.0, (self.counts[k] - 1) as f64) as usize
        })
    }

    /// Lets the fluid in from the first node, along edges of the tetrahedra.
    fn flood(&mut self, offset: f32) {
        let mut front = vec![[0; 3]];
        self.reached[0] = true;
        while let Some(at) = front.pop() {
            for step in STEPS {
                for sign in [1, -1] {
                    let next: [isize; 3] = std::array::from_fn(|k| at[k] as isize + sign * step[k]);
                    if (0..3).any(|k| next[k] < 0 || next[k] >= self.counts[k] as isize) {
                        continue;
                    }
                    let next = next.map(|n| n as usize);
                    let node = self.number(next);
                    if self.distance[node] > offset && !self.reached[node] {
                        self.reached[node] = true;
                        front.push(next);
                    }
                }
            }
        }
    }

    /// Distance less offset where the fluid is, negative where it is not.
    pub(super) fn level(&self, node: usize, offset: f64) -> f64 {
        let beyond = f64::from(self.distance[node]) - offset;
        match self.reached[node] {
            true => beyond.min(offset),
            false => beyond.clamp(-offset, -1e-3 * offset),
        }
    }

    /// Whether the fluid reaches the node nearest to a point.
    pub(super) fn is_reached(&self, p: [f64; 3]) -> bool {
        self.reached[self.number(self.node(p, f64::round))]
    }

    /// Distance of a point from the triangles (m), infinite far from them.
    pub(super) fn distance_of(&self, p: [f64; 3]) -> f64 {
        self.nearest(p).map_or(f64::INFINITY, |q| norm(sub(q, p)))
    }

    /// The point nearest to `p` of the triangles that the nodes around it know.
    pub(super) fn nearest(&self, p: [f64; 3]) -> Option<[f64; 3]> {
        let [i, j, k] = self.node(p, f64::floor);
        let mut best: Option<(f64, [f64; 3])> = None;
        for corner in 0..8 {
            let at = [i + (corner & 1), j + (corner >> 1 & 1), k + (corner >> 2)];
            let at = std::array::from_fn(|k| at[k].min(self.counts[k] - 1));
            let number = self.nearest[self.number(at)];
            let Some(&triangle) = self.corners.get(number as usize) else {
                continue;
            };
            let q = triangle::nearest(p, triangle);
            let to = sub(q, p);
            if best.is_none_or(|(least, _)| dot(to, to) < least) {
                best = Some((dot(to, to), q));
            }
        }
        best.map(|(_, q)| q)
    }
}

/// Edges of the tetrahedra that six of make a cell (H. Freudenthal, 1942), from their lower node.
pub(super) const STEPS: [[isize; 3]; 7] = [
    [1, 0, 0],
    [0, 1, 0],
    [0, 0, 1],
    [1, 1, 0],
    [0, 1, 1],
    [1, 0, 1],
    [1, 1, 1],
];
