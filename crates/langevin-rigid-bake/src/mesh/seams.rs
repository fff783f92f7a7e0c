//! Vertices of the boundary that lie at one place, or nearly so, and are not one.

use rstar::RTree;
use rstar::primitives::GeomWithData;

use super::boundary::open_sides;
use super::check::has_no_area;
use super::edges::{Side, open_edge_count, sorted_sides};
use super::repair::{WELD, is_place};
use super::vector::{bounding_box, norm, sub};
use super::weld::drop_unused;

/// A mesh whose seams [`close_seams`] has closed.
#[derive(Debug, Clone, PartialEq)]
pub struct ClosedSeams {
    /// Vertex positions, those in use.
    pub vertices: Vec<[f64; 3]>,
    /// Vertex numbers of each triangle, in the order they came.
    pub triangles: Vec<[u32; 3]>,
    /// How many vertices became another.
    pub welded: usize,
    /// The longest way any of them went.
    pub distance: f64,
}

/// Welds vertices of open edges within [`WELD`] of the diagonal of the mesh's box, the width of seams that
/// rounding left open.
///
/// Nothing where that closes no edge or leaves a triangle without area that had some.
///
/// ```
/// use langevin_rigid_bake::mesh::close_seams;
///
/// let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1e-7, 0.0], [1.0, 1.0, 0.0]];
/// let closed = close_seams(&vertices, &[[0, 1, 2], [3, 4, 2]]).unwrap();
/// assert_eq!((closed.vertices.len(), closed.welded), (4, 1));
/// assert_eq!(closed.triangles, [[0, 1, 2], [1, 3, 2]]);
/// ```
pub fn close_seams(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Option<ClosedSeams> {
    let used = triangles.as_flattened();
    if !used.iter().all(|&v| is_place(vertices, v)) {
        return None;
    }
    let (vertices, triangles) = drop_unused(vertices.to_vec(), triangles.to_vec());
    let [low, high] = bounding_box(&vertices);
    let open = open_sides(&sorted_sides(&triangles));
    let twins = twins(&vertices, &open, WELD * norm(sub(high, low)));
    let mut number: Vec<u32> = (0..vertices.len() as u32).collect();
    for [kept, gone] in twins.iter().map(|twin| twin.vertices) {
        number[gone as usize] = kept;
    }
    let renumbered = |t: &[u32; 3]| t.map(|v| number[v as usize]);
    let welded: Vec<[u32; 3]> = triangles.iter().map(renumbered).collect();
    let is_flat = |t: &[u32; 3]| has_no_area(t.map(|v| vertices[v as usize]));
    let mut pairs = triangles.iter().zip(&welded);
    let flattens =
        pairs.any(|(before, after)| before != after && is_flat(after) && !is_flat(before));
    if flattens || open_edge_count(&welded) >= open.len() {
        return None;
    }
    let (vertices, triangles) = drop_unused(vertices, welded);
    Some(ClosedSeams {
        vertices,
        triangles,
        welded: twins.len(),
        distance: twins.iter().map(|t| t.distance).fold(0.0, f64::max),
    })
}

/// A vertex and the one it should be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Twin {
    /// The lower number first, which stays.
    pub(super) vertices: [u32; 2],
    /// Their distance (m).
    pub(super) distance: f64,
}

/// Vertices of open edges at most `tolerance` (m) from one with a lower number that has no twin itself.
pub(super) fn twins(vertices: &[[f64; 3]], open: &[Side], tolerance: f64) -> Vec<Twin> {
    let mut rim: Vec<u32> = open.iter().flat_map(|side| side.vertices).collect();
    rim.sort_unstable();
    rim.dedup();
    let place = |&v: &u32| GeomWithData::new(vertices[v as usize], v);
    let tree = RTree::bulk_load(rim.iter().map(place).collect());
    let mut taken = vec![false; vertices.len()];
    let mut twins = Vec::new();
    for &a in &rim {
        if taken[a as usize] {
            continue;
        }
        let here = vertices[a as usize];
        let near = tree.locate_within_distance(here, tolerance * tolerance);
        let mut others: Vec<u32> = near.map(|p| p.data).collect();
        others.retain(|&b| b > a && !taken[b as usize]);
        others.sort_unstable();
        for b in others {
            taken[b as usize] = true;
            let distance = norm(sub(vertices[b as usize], here));
            twins.push(Twin {
                vertices: [a, b],
                distance,
            });
        }
    }
    twins
}
