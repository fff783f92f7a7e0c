//! Exchange of diagonals where two triangles lie in one plane, which leaves the surface as it is.

use std::collections::BTreeSet;

use super::AddedMassError;
use super::edges::{Edges, Fold, folds, ordered};
use super::panels::Vec3;
use super::report::Cancel;
use crate::mesh::vector::{cross, dot, norm, sub};

/// Angle between normals up to which triangles count as one plane: the noise of coordinates in
/// single precision on small triangles.
pub(super) const FLAT: f64 = 1e-4;
/// How far beyond two right angles the opposite angles must sum, as a sum of cotangents.
const GAIN: f64 = 1e-3;
const MAX_SWEEPS: usize = 100;

/// Makes the triangulation of every flat part a Delaunay one (C. Lawson, 1977).
pub(super) fn flip_flat_edges(
    vertices: &[Vec3],
    triangles: &mut [[u32; 3]],
    cancel: &Cancel,
) -> Result<(), AddedMassError> {
    for _ in 0..MAX_SWEEPS {
        cancel.check()?;
        if !sweep(vertices, triangles) {
            break;
        }
    }
    Ok(())
}

/// Flips edges no two of which share a triangle; whether there were any.
fn sweep(vertices: &[Vec3], triangles: &mut [[u32; 3]]) -> bool {
    let edges = Edges::new(triangles);
    let mut touched = vec![false; triangles.len()];
    let mut created = BTreeSet::new();
    for fold in folds(&edges, vertices, triangles) {
        let [s, t] = fold.triangles;
        if fold.turn > FLAT || touched[s] || touched[t] {
            continue;
        }
        let Some(flipped) = flip(&fold, &edges, vertices, triangles) else {
            continue;
        };
        let diagonal = ordered(flipped[0][1], flipped[0][2]);
        if edges.ends.binary_search(&diagonal).is_err() && created.insert(diagonal) {
            (touched[s], touched[t]) = (true, true);
            (triangles[s], triangles[t]) = (flipped[0], flipped[1]);
        }
    }
    !created.is_empty()
}

/// The two triangles with the other diagonal, which is the second side of the first, where that is
/// better.
fn flip(
    fold: &Fold,
    edges: &Edges,
    vertices: &[Vec3],
    triangles: &[[u32; 3]],
) -> Option<[[u32; 3]; 2]> {
    let [s, t] = fold.triangles;
    let turned = |t: usize| {
        let k = (0..3).find(|&k| edges.sides[t][k] as usize == fold.edge)?;
        Some([0, 1, 2].map(|i| triangles[t][(k + i) % 3]))
    };
    // s is (a, b, c), t is (b, a, d).
    let ([a, b, c], [_, _, d]) = (turned(s)?, turned(t)?);
    let [pa, pb, pc, pd] = [a, b, c, d].map(|v| vertices[v as usize]);
    let normal = cross(sub(pb, pa), sub(pc, pa));
    let positive = |p: Vec3, q: Vec3, r: Vec3| dot(cross(sub(q, p), sub(r, p)), normal) > 0.0;
    let convex = positive(pa, pd, pc) && positive(pb, pc, pd);
    let better = cotangent(pa, pc, pb) + cotangent(pa, pd, pb) < -GAIN;
    (convex && better).then_some([[a, d, c], [b, c, d]])
}

/// Cotangent of the angle at `q` between `p` and `r`.
fn cotangent(p: Vec3, q: Vec3, r: Vec3) -> f64 {
    let (u, v) = (sub(p, q), sub(r, q));
    dot(u, v) / norm(cross(u, v))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_kite_gets_its_short_diagonal_and_a_ridge_keeps_its_edge() {
        let mut vertices = vec![
            [-3.0, 0.0, 0.0],
            [3.0, 0.0, 0.0],
            [0.0, 1.0, 0.0],
            [0.0, -1.0, 0.0],
        ];
        let flat = [[0, 1, 2], [1, 0, 3]];
        // The back of the kite, so that the surface is closed.
        vertices.push([0.0, 0.0, -1.0]);
        let back = [[0, 2, 4], [2, 1, 4], [1, 3, 4], [3, 0, 4]];
        let mut triangles: Vec<[u32; 3]> = flat.into_iter().chain(back).collect();
        let cancel = Cancel::new(&(), "mesh", 1);
        flip_flat_edges(&vertices, &mut triangles, &cancel).unwrap();
        assert_eq!(triangles[..2], [[0, 3, 2], [1, 2, 3]]);
        assert_eq!(triangles[2..], back);
        let mut ridge: Vec<[u32; 3]> = flat.into_iter().chain(back).collect();
        vertices[2][2] = -0.01;
        flip_flat_edges(&vertices, &mut ridge, &cancel).unwrap();
        assert_eq!(ridge[..2], flat);
    }
}
