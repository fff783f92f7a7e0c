//! The boundary of an open surface, loop by loop.

use std::collections::BTreeMap;

use super::edges::{Side, by_edge};
use super::parts::SignedParts;
use super::vector::{add, dot, norm, scale, sub};

/// A hole in a surface, or the rim of a sheet: open edges that hang together.
#[derive(Debug, Clone, PartialEq)]
pub struct Hole {
    /// Number of its edges.
    pub edges: usize,
    /// Their length (m).
    pub perimeter: f64,
    /// Mean of the middles of its edges (m).
    pub centre: [f64; 3],
}

impl Hole {
    pub(super) fn new(vertices: &[[f64; 3]], sides: &[Side]) -> Hole {
        let ends = |s: &Side| s.vertices.map(|v| vertices[v as usize]);
        let lengths = sides.iter().map(|s| {
            let [a, b] = ends(s);
            norm(sub(b, a))
        });
        let middles = sides.iter().map(|s| {
            let [a, b] = ends(s);
            scale(0.5, add(a, b))
        });
        Hole {
            edges: sides.len(),
            perimeter: lengths.sum(),
            centre: scale(1.0 / sides.len() as f64, middles.fold([0.0; 3], add)),
        }
    }
}

/// The open edges of the triangles.
pub(super) fn open_sides(sides: &[Side]) -> Vec<Side> {
    let open = by_edge(sides).filter(|edge| edge.len() == 1);
    open.map(|edge| edge[0]).collect()
}

/// Open edges grouped by the vertices they share, in the order of their lowest edge.
pub(super) fn loops(vertex_count: usize, open: &[Side]) -> Vec<Vec<Side>> {
    let mut parts = SignedParts::new(vertex_count);
    for side in open {
        let [a, b] = side.vertices.map(|v| v as usize);
        parts.join(a, b, false);
    }
    let mut rooted: Vec<(usize, Side)> = open
        .iter()
        .map(|side| (parts.root(side.vertices[0] as usize).0, *side))
        .collect();
    rooted.sort_unstable();
    rooted
        .chunk_by(|a, b| a.0 == b.0)
        .map(|group| group.iter().map(|(_, side)| *side).collect())
        .collect()
}

/// The simple rings that open edges which hang together are made of, as their triangles run; where several
/// meet in a vertex, the narrowest gap is gone around first. Edges that belong to no ring are left out.
pub(super) fn rings(vertices: &[[f64; 3]], sides: &[Side]) -> Vec<Vec<u32>> {
    let mut onward: BTreeMap<u32, Vec<u32>> = BTreeMap::new();
    for [from, to] in sides.iter().map(Side::run) {
        onward.entry(from).or_default().push(to);
    }
    let mut rings = Vec::new();
    while let Some((&first, _)) = onward.iter().find(|(_, to)| !to.is_empty()) {
        let mut path = vec![first];
        while let Some(to) = step(vertices, &path, &mut onward) {
            match path.iter().position(|&v| v == to) {
                Some(at) => {
                    rings.push(path.split_off(at));
                    path.push(to);
                }
                None => path.push(to),
            }
        }
        onward.retain(|_, to| !to.is_empty());
    }
    rings.retain(|ring| ring.len() > 2);
    rings
}

/// Takes the way on from the end of a path that turns back the most.
fn step(vertices: &[[f64; 3]], path: &[u32], onward: &mut BTreeMap<u32, Vec<u32>>) -> Option<u32> {
    let place = |v: u32| vertices[v as usize];
    let here = *path.last()?;
    let ways = onward.get_mut(&here)?;
    let onwards = |to: u32| match path.iter().rev().nth(1) {
        Some(&before) => {
            let (come, go) = (sub(place(here), place(before)), sub(place(to), place(here)));
            dot(come, go) / (norm(come) * norm(go))
        }
        None => 0.0,
    };
    let best = (0..ways.len()).min_by(|&i, &j| onwards(ways[i]).total_cmp(&onwards(ways[j])))?;
    Some(ways.remove(best))
}
