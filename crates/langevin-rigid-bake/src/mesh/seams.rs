//! Vertices of the boundary that lie at one place, or nearly so, and are not one.

use rstar::RTree;
use rstar::primitives::GeomWithData;

use super::edges::Side;
use super::vector::{norm, sub};

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
