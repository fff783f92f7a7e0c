//! Triangles that are there more than once.

use super::{Options, Soup, Step};
use crate::mesh::edges::{by_edge, sorted_sides};
use crate::mesh::parts::SignedParts;

/// Keeps one of several triangles with the same vertices, and none of those that wall off one part of
/// the inside from another.
pub(super) fn drop(soup: &mut Soup, _: &Options) {
    let first = first_copies(&soup.triangles);
    let copies = (0..first.len()).filter(|&t| first[t] != t).count();
    if copies == 0 {
        return;
    }
    let walls = interior_walls(&soup.triangles, &first);
    let before = soup.triangles.len();
    let kept = (0..before).filter(|&t| first[t] == t && !walls[t]);
    soup.triangles = kept.map(|t| soup.triangles[t]).collect();
    soup.did(Step::Duplicates {
        dropped: before - soup.triangles.len(),
        interior: walls.iter().filter(|&&wall| wall).count(),
    });
}

/// For each triangle the first with the same vertices in any order.
pub(in crate::mesh) fn first_copies(triangles: &[[u32; 3]]) -> Vec<usize> {
    let mut keyed: Vec<([u32; 3], usize)> = triangles.iter().copied().zip(0..).collect();
    for (key, _) in &mut keyed {
        key.sort_unstable();
    }
    keyed.sort_unstable();
    let mut first = vec![0; triangles.len()];
    for copies in keyed.chunk_by(|a, b| a.0 == b.0) {
        for copy in copies {
            first[copy.1] = copies[0].1;
        }
    }
    first
}

/// Triangles of doubled patches on whose whole border the surface closes without them: two solids that
/// were set face to face.
fn interior_walls(triangles: &[[u32; 3]], first: &[usize]) -> Vec<bool> {
    let mut doubled = vec![false; triangles.len()];
    for (t, &original) in first.iter().enumerate().filter(|(t, f)| t != *f) {
        (doubled[t], doubled[original]) = (true, true);
    }
    let sides = sorted_sides(triangles);
    let mut patches = SignedParts::new(triangles.len());
    for edge in by_edge(&sides) {
        let members: Vec<usize> = edge.iter().map(|s| s.triangle as usize).collect();
        let members: Vec<usize> = members.into_iter().filter(|&t| doubled[t]).collect();
        for pair in members.windows(2) {
            patches.join(pair[0], pair[1], false);
        }
    }
    let mut closed = vec![None; triangles.len()];
    for edge in by_edge(&sides) {
        let others = edge
            .iter()
            .filter(|s| !doubled[s.triangle as usize])
            .count();
        for side in edge
            .iter()
            .filter(|s| doubled[s.triangle as usize] && others > 0)
        {
            let patch = &mut closed[patches.root(side.triangle as usize).0];
            *patch = Some(patch.unwrap_or(true) && others == 2);
        }
    }
    (0..triangles.len())
        .map(|t| doubled[t] && closed[patches.root(t).0] == Some(true))
        .collect()
}
