//! Triangles without area: what they join stays joined.

use std::collections::BTreeSet;

use super::{Options, Soup, Step};
use crate::mesh::check::has_no_area;
use crate::mesh::edges::{Side, of_edge, sorted_sides};
use crate::mesh::vector::{norm, sub};

/// Rounds of flips, each of which brings a triangle without area one edge nearer to one that has some.
const ROUNDS: usize = 100;

/// Collapses those with a short side, flips the longest side of the others, drops what cannot be flipped.
pub(super) fn resolve(soup: &mut Soup, options: &Options) {
    let before = soup.triangles.len();
    drop_folded(&mut soup.triangles);
    let dropped = before - soup.triangles.len();
    let short = short_sides(soup, soup.weld_distance(options));
    let collapsed = short.len();
    soup.merge(short.into_iter());
    drop_folded(&mut soup.triangles);
    let flipped = flip_all(soup);
    let before = soup.triangles.len();
    let (vertices, triangles) = (&soup.vertices, &mut soup.triangles);
    triangles.retain(|&t| !has_no_area(t.map(|v| vertices[v as usize])));
    let dropped = dropped + before - soup.triangles.len();
    soup.did(Step::Degenerate {
        dropped,
        collapsed,
        flipped,
    });
}

fn drop_folded(triangles: &mut Vec<[u32; 3]>) {
    triangles.retain(|[a, b, c]| a != b && b != c && c != a);
}

fn without_area(soup: &Soup) -> impl Iterator<Item = usize> {
    let place = |t: usize| soup.triangles[t].map(|v| soup.vertices[v as usize]);
    (0..soup.triangles.len()).filter(move |&t| has_no_area(place(t)))
}

/// Sides up to `tolerance` long of triangles without area.
fn short_sides(soup: &Soup, tolerance: f64) -> Vec<[u32; 2]> {
    let sides = |t: usize| {
        let [a, b, c] = soup.triangles[t];
        [[a, b], [b, c], [c, a]]
    };
    without_area(soup)
        .flat_map(sides)
        .filter(|&side| soup.length(side) <= tolerance)
        .collect()
}

impl Soup {
    fn length(&self, [a, b]: [u32; 2]) -> f64 {
        norm(sub(self.vertices[b as usize], self.vertices[a as usize]))
    }
}

fn flip_all(soup: &mut Soup) -> usize {
    let mut flipped = 0;
    for _ in 0..ROUNDS {
        let flat: Vec<usize> = without_area(soup).collect();
        if flat.is_empty() {
            break;
        }
        let mut round = Round::new(soup);
        let count = flat.into_iter().filter(|&t| round.flip(t)).count();
        if count == 0 {
            break;
        }
        flipped += count;
    }
    flipped
}

/// Flips that do not touch each other, so that the sides stay those at its beginning.
struct Round<'a> {
    soup: &'a mut Soup,
    sides: Vec<Side>,
    touched: Vec<bool>,
    made: BTreeSet<[u32; 2]>,
}

impl Round<'_> {
    fn new(soup: &mut Soup) -> Round<'_> {
        Round {
            sides: sorted_sides(&soup.triangles),
            touched: vec![false; soup.triangles.len()],
            made: BTreeSet::new(),
            soup,
        }
    }

    /// Lets the triangle beyond the longest side of `t` be cut in two by the vertex on that side.
    fn flip(&mut self, t: usize) -> bool {
        let (base, tip) = longest_side(self.soup, t);
        let Some(other) = neighbour(&self.sides, base, t) else {
            return false;
        };
        let corners = self.soup.triangles[other];
        let turn = (0..3).find(|&k| !base.contains(&corners[k])).unwrap_or(0);
        let [apex, from, to] = [0, 1, 2].map(|k| corners[(turn + k) % 3]);
        let cut = [apex.min(tip), apex.max(tip)];
        let free = apex != tip && !self.touched[t] && !self.touched[other];
        if !free || !of_edge(&self.sides, cut).is_empty() || !self.made.insert(cut) {
            return false;
        }
        (self.touched[t], self.touched[other]) = (true, true);
        self.soup.triangles[t] = [from, tip, apex];
        self.soup.triangles[other] = [tip, to, apex];
        true
    }
}

/// The longest side of a triangle, the lower vertex first, and the vertex opposite.
fn longest_side(soup: &Soup, t: usize) -> ([u32; 2], u32) {
    let corners = soup.triangles[t];
    let side = |k: usize| [corners[k], corners[(k + 1) % 3]];
    let longest = (0..3).max_by(|&i, &j| soup.length(side(i)).total_cmp(&soup.length(side(j))));
    let k = longest.unwrap_or(0);
    let [a, b] = side(k);
    ([a.min(b), a.max(b)], corners[(k + 2) % 3])
}

/// The only other triangle at an edge.
fn neighbour(sides: &[Side], edge: [u32; 2], t: usize) -> Option<usize> {
    match of_edge(sides, edge) {
        [a, b] if a.triangle as usize == t => Some(b.triangle as usize),
        [a, b] if b.triangle as usize == t => Some(a.triangle as usize),
        _ => None,
    }
}
