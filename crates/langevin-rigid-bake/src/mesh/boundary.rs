//! The boundary of an open surface, loop by loop.

use super::edges::{Side, by_edge};
use super::parts::SignedParts;
use super::vector::{add, norm, scale, sub};

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

    /// Area of the disc of the same perimeter (m²), the most that a plane loop encloses.
    pub(super) fn disc(&self) -> f64 {
        self.perimeter * self.perimeter / (4.0 * std::f64::consts::PI)
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

/// The vertices of a loop in the sense in which its triangles run; nothing where it is not one simple
/// loop of one sense.
pub(super) fn in_order(sides: &[Side]) -> Option<Vec<u32>> {
    let mut steps: Vec<[u32; 2]> = sides.iter().map(Side::run).collect();
    steps.sort_unstable();
    if steps.windows(2).any(|pair| pair[0][0] == pair[1][0]) {
        return None;
    }
    let next = |v: u32| {
        let at = steps.binary_search_by_key(&v, |step| step[0]).ok()?;
        Some(steps[at][1])
    };
    let first = steps.first()?[0];
    let mut order = vec![first];
    while order.len() < steps.len() {
        order.push(next(*order.last()?).filter(|&v| v != first)?);
    }
    (next(*order.last()?)? == first).then_some(order)
}
