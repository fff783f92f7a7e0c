//! Small holes are filled.

use super::{FILL, Options, SMALL_HOLE, Soup, Step, WIDE_HOLE, area_of, parts};
use crate::mesh::boundary::{loops, open_sides, rings};
use crate::mesh::edges::{Side, of_edge, sorted_sides};
use crate::mesh::parts::components;
use crate::mesh::vector::{add, cross, dot, norm, scale, sub, unit};

/// Width of a crack, in distances within which vertices are welded.
const CRACK: f64 = 100.0;

/// Fills the holes that have few edges and are small in their component.
pub(super) fn fill(soup: &mut Soup, options: &Options) {
    let default = if options.thickness.is_some() { 0 } else { FILL };
    let most = options.fill.unwrap_or(default);
    let share = if options.fill.is_some() {
        WIDE_HOLE
    } else {
        SMALL_HOLE
    };
    let crack = CRACK * soup.weld_distance(options);
    let sides = sorted_sides(&soup.triangles);
    let roots = components(soup.triangles.len(), &sides);
    let areas = parts::areas(&soup.vertices, &soup.triangles, &roots);
    let (mut holes, mut edges) = (0, 0);
    let before = soup.triangles.len();
    for rim in loops(soup.vertices.len(), &open_sides(&sides)) {
        let around = rim.iter().map(|side| areas[roots[side.triangle as usize]]);
        let around = around.fold(0.0, f64::max);
        for ring in rings(&soup.vertices, &rim) {
            if ring.len() <= most && soup.is_small(&ring, share * around, crack) {
                soup.close(&ring, &sides);
                holes += 1;
                edges += ring.len();
            }
        }
    }
    let filled = &soup.triangles[before..];
    let area = |t: &[u32; 3]| area_of(t.map(|v| soup.vertices[v as usize]));
    let step = Step::Filled {
        holes,
        edges,
        triangles: filled.len(),
        area: filled.iter().map(area).sum(),
    };
    soup.did(step);
}

impl Soup {
    /// Whether a disc of a ring's perimeter has less than `most` (m²); a crack has next to no area.
    fn is_small(&self, ring: &[u32], most: f64, crack: f64) -> bool {
        let places: Vec<[f64; 3]> = ring.iter().map(|&v| self.vertices[v as usize]).collect();
        let next = |i: usize| places[(i + 1) % places.len()];
        let perimeter: f64 = (0..places.len())
            .map(|i| norm(sub(next(i), places[i])))
            .sum();
        let disc = perimeter * perimeter / (4.0 * std::f64::consts::PI);
        let twice_area = norm(twice_vector_area(&places));
        disc < most || (twice_area < crack * perimeter && 0.5 * twice_area < most)
    }

    /// Closes a hole along whose rim the triangles run as `order` does.
    fn close(&mut self, order: &[u32], sides: &[Side]) {
        let polygon: Vec<u32> = order.iter().rev().copied().collect();
        let places: Vec<[f64; 3]> = polygon.iter().map(|&v| self.vertices[v as usize]).collect();
        let patch = flat_patch(&places).filter(|patch| fits(patch, &polygon, sides));
        match patch {
            Some(patch) => {
                let numbers = patch.iter().map(|t| t.map(|i| polygon[i as usize]));
                self.triangles.extend(numbers);
            }
            None => self.star(&polygon, &places),
        }
    }

    /// Triangles from the rim to its middle, which is a vertex of its own.
    fn star(&mut self, polygon: &[u32], places: &[[f64; 3]]) {
        let sum = places.iter().fold([0.0; 3], |sum, p| add(sum, *p));
        let middle = self.vertices.len() as u32;
        self.vertices.push(scale(1.0 / places.len() as f64, sum));
        for (i, &from) in polygon.iter().enumerate() {
            self.triangles
                .push([from, polygon[(i + 1) % polygon.len()], middle]);
        }
    }
}

/// Triangles of a polygon as seen along its vector area, each vertex used and each side once; nothing
/// where it crosses itself.
fn flat_patch(places: &[[f64; 3]]) -> Option<Vec<[u32; 3]>> {
    let n = places.len() as u32;
    let mut corners = Vec::new();
    earcut::Earcut::new().earcut(projected(places), &[], &mut corners);
    let (triangles, _) = corners.as_chunks::<3>();
    let mut patch: Vec<[u32; 3]> = triangles.to_vec();
    for t in &mut patch {
        // A triangle of a simple polygon has its corners in the polygon's order.
        t.sort_unstable();
    }
    let missed = missed_corners(&patch, n);
    patch.extend(missed);
    (patch.len() as u32 == n - 2 && covers(&patch, n)).then_some(patch)
}

fn twice_vector_area(places: &[[f64; 3]]) -> [f64; 3] {
    let arm = |p: [f64; 3]| sub(p, places[0]);
    let area = places.windows(2).map(|w| cross(arm(w[0]), arm(w[1])));
    area.fold([0.0; 3], add)
}

/// The polygon in the plane across its vector area.
fn projected(places: &[[f64; 3]]) -> Vec<[f64; 2]> {
    let from = places[0];
    let arms: Vec<[f64; 3]> = places.iter().map(|p| sub(*p, from)).collect();
    let normal = twice_vector_area(places);
    let least = (0..3).min_by(|&i, &j| normal[i].abs().total_cmp(&normal[j].abs()));
    let mut axis = [0.0; 3];
    axis[least.unwrap_or(0)] = 1.0;
    let u = cross(axis, normal);
    if norm(u) == 0.0 {
        return Vec::new();
    }
    let u = unit(u);
    let v = unit(cross(normal, u));
    arms.iter().map(|a| [dot(*a, u), dot(*a, v)]).collect()
}

/// Triangles without area to the corners that were left out because they lie on a line: where the patch
/// runs from i to j and the polygon by way of others, those in between. The flips that follow give them
/// area.
fn missed_corners(patch: &[[u32; 3]], n: u32) -> Vec<[u32; 3]> {
    let fan = |i: u32, j: u32| (i + 1..j).map(move |k| [i, k, k + 1]);
    if patch.is_empty() {
        return fan(0, n - 1).collect();
    }
    let runs = directed(patch);
    let border = runs
        .iter()
        .filter(|[i, j]| runs.binary_search(&[*j, *i]).is_err());
    let skipped = border.map(|&[i, j]| [i, if j < i { j + n } else { j }]);
    let triangles = skipped.flat_map(|[i, j]| fan(i, j));
    triangles.map(|t| t.map(|v| v % n)).collect()
}

fn directed(patch: &[[u32; 3]]) -> Vec<[u32; 2]> {
    let sides = |&[a, b, c]: &[u32; 3]| [[a, b], [b, c], [c, a]];
    let mut runs: Vec<[u32; 2]> = patch.iter().flat_map(sides).collect();
    runs.sort_unstable();
    runs
}

/// Whether every side of the polygon is one of the patch, and every other side is there both ways.
fn covers(patch: &[[u32; 3]], n: u32) -> bool {
    let runs = directed(patch);
    let simple = runs.windows(2).all(|pair| pair[0] != pair[1]);
    let has = |from, to| runs.binary_search(&[from, to]).is_ok();
    let inner = |&[i, j]: &[u32; 2]| j == (i + 1) % n || has(j, i);
    simple && (0..n).all(|i| has(i, (i + 1) % n)) && runs.iter().all(inner)
}

/// Whether no diagonal of the patch is an edge already.
fn fits(patch: &[[u32; 3]], polygon: &[u32], sides: &[Side]) -> bool {
    let n = polygon.len() as u32;
    directed(patch).iter().all(|&[i, j]| {
        let [a, b] = [i, j].map(|i| polygon[i as usize]);
        let rim = j == (i + 1) % n || i == (j + 1) % n;
        rim || of_edge(sides, [a.min(b), a.max(b)]).is_empty()
    })
}
