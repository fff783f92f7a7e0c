//! Bisection of triangles that are too long for linear potentials.

use super::AddedMassError;
use super::edges::{Edges, Fold, folds};
use super::flip::{FLAT, flip_flat_edges};
use super::panels::Vec3;
use super::report::Cancel;
use crate::mesh::vector::{add, dot, scale, sub};

/// How bisection ended.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Refined {
    /// Whether no triangle is longer than wished.
    pub(super) complete: bool,
}

/// Squared ratio to its diagonal above which a side of a flat strip is bisected in its place: the
/// diagonal is flipped afterwards, and the strip has no vertices inside.
const STRIP2: f64 = 0.83 * 0.83;

/// Bisects across the longest edge until no triangle is longer than `longest`, or the next round
/// would exceed `limit` triangles. Conforming; old vertices stay first (M.-C. Rivara, 1984). Flat
/// parts are made Delaunay on the way.
pub(super) fn bisect(
    vertices: &mut Vec<Vec3>,
    triangles: &mut Vec<[u32; 3]>,
    longest: f64,
    limit: usize,
    cancel: &Cancel,
) -> Result<Refined, AddedMassError> {
    if Round::new(vertices, triangles, longest).added == 0 {
        return Ok(Refined { complete: true });
    }
    loop {
        flip_flat_edges(vertices, triangles, cancel)?;
        let round = Round::new(vertices, triangles, longest);
        if round.added == 0 {
            return Ok(Refined { complete: true });
        }
        if triangles.len() + round.added > limit {
            return Ok(Refined { complete: false });
        }
        *triangles = round.split(vertices, triangles);
    }
}

/// One round of bisection, each marked edge halved once.
struct Round {
    edges: Edges,
    marked: Vec<bool>,
    /// The side across which each triangle is cut first.
    base: Vec<usize>,
    added: usize,
}

impl Round {
    fn new(vertices: &[Vec3], triangles: &[[u32; 3]], longest: f64) -> Round {
        let edges = Edges::new(triangles);
        // Rounded to single precision equal lengths are equal in any orientation of the mesh; the
        // order of the vertices then decides, for both triangles at the edge alike.
        let length2 = |e: &[u32; 2]| {
            let d = sub(vertices[e[1] as usize], vertices[e[0] as usize]);
            dot(d, d) as f32
        };
        let lengths: Vec<f32> = edges.ends.iter().map(length2).collect();
        let flat: Vec<bool> = folds(&edges, vertices, triangles)
            .iter()
            .map(|f: &Fold| f.turn < FLAT)
            .collect();
        let base: Vec<usize> = edges
            .sides
            .iter()
            .map(|sides| base_side(sides, &lengths, &flat))
            .collect();
        let mut marked = vec![false; edges.ends.len()];
        for (sides, &k) in edges.sides.iter().zip(&base) {
            let too_long = |&e: &u32| f64::from(lengths[e as usize]) > longest * longest;
            marked[sides[k] as usize] |= sides.iter().any(too_long);
        }
        close(&edges, &base, &mut marked);
        let added = edges
            .sides
            .iter()
            .flatten()
            .filter(|&&e| marked[e as usize])
            .count();
        Round {
            edges,
            marked,
            base,
            added,
        }
    }

    fn split(&self, vertices: &mut Vec<Vec3>, triangles: &[[u32; 3]]) -> Vec<[u32; 3]> {
        let mut middle = vec![None; self.marked.len()];
        for (e, ends) in self
            .edges
            .ends
            .iter()
            .enumerate()
            .filter(|(e, _)| self.marked[*e])
        {
            let [a, b] = ends.map(|v| vertices[v as usize]);
            middle[e] = Some(vertices.len() as u32);
            vertices.push(scale(0.5, add(a, b)));
        }
        let mut result = Vec::with_capacity(triangles.len() + self.added);
        for (t, corners) in triangles.iter().enumerate() {
            let k = self.base[t];
            let turned = [0, 1, 2].map(|i| (k + i) % 3);
            let corners = turned.map(|i| corners[i]);
            let middles = turned.map(|i| middle[self.edges.sides[t][i] as usize]);
            split_triangle(corners, middles, &mut result);
        }
        result
    }
}

/// The longest side; a diagonal in a plane yields to an edge of the plane nearly as long.
fn base_side(sides: &[u32; 3], lengths: &[f32], flat: &[bool]) -> usize {
    let length2 = |k: usize| lengths[sides[k] as usize];
    let longest = |candidates: &mut dyn Iterator<Item = usize>| {
        candidates.max_by(|&i, &j| {
            length2(i)
                .total_cmp(&length2(j))
                .then(sides[i].cmp(&sides[j]))
        })
    };
    let first = longest(&mut (0..3)).unwrap_or(0);
    let border = longest(&mut (0..3).filter(|&k| !flat[sides[k] as usize]));
    match border {
        Some(k) if f64::from(length2(k)) > STRIP2 * f64::from(length2(first)) => k,
        _ => first,
    }
}

/// A triangle with any marked side is cut across its base first.
fn close(edges: &Edges, base: &[usize], marked: &mut [bool]) {
    let triangles = edges.triangles();
    let mut new: Vec<usize> = (0..marked.len()).filter(|&e| marked[e]).collect();
    while let Some(e) = new.pop() {
        for t in triangles[e].map(|t| t as usize) {
            let base = edges.sides[t][base[t]] as usize;
            if !marked[base] {
                marked[base] = true;
                new.push(base);
            }
        }
    }
}

/// Cuts triangle (a, b, c), side ab first, at the middles of its marked sides.
fn split_triangle(corners: [u32; 3], middles: [Option<u32>; 3], result: &mut Vec<[u32; 3]>) {
    let [a, b, c] = corners;
    let Some(m) = middles[0] else {
        result.push(corners);
        return;
    };
    match middles[2] {
        Some(q) => result.extend([[a, m, q], [q, m, c]]),
        None => result.push([a, m, c]),
    }
    match middles[1] {
        Some(p) => result.extend([[m, b, p], [m, p, c]]),
        None => result.push([m, b, c]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::mesh::vector::{cross, norm};

    fn tetrahedron() -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 5.0]];
        (vertices, vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]])
    }

    fn surface_area(vertices: &[Vec3], triangles: &[[u32; 3]]) -> f64 {
        let area = |t: &[u32; 3]| {
            let [a, b, c] = t.map(|v| vertices[v as usize]);
            0.5 * norm(cross(sub(b, a), sub(c, a)))
        };
        triangles.iter().map(area).sum()
    }

    #[test]
    fn bisection_is_conforming_and_keeps_the_surface() {
        let (mut vertices, mut triangles) = tetrahedron();
        let area = surface_area(&vertices, &triangles);
        let cancel = Cancel::new(&(), "mesh", 1);
        let refined = bisect(&mut vertices, &mut triangles, 0.31, 100_000, &cancel);
        assert!(refined.unwrap().complete);
        assert!((surface_area(&vertices, &triangles) - area).abs() < 1e-12 * area);
        let edges = Edges::new(&triangles);
        // Euler's relation for a closed surface of genus zero.
        assert_eq!(vertices.len() + triangles.len(), edges.ends.len() + 2);
        for e in &edges.ends {
            let d = sub(vertices[e[0] as usize], vertices[e[1] as usize]);
            assert!(norm(d) <= 0.31 * (1.0 + 1e-6));
        }
        assert_eq!(vertices[3], [0.0, 0.0, 5.0]);
    }

    #[test]
    fn bisection_stops_at_the_limit() {
        let (mut vertices, mut triangles) = tetrahedron();
        let cancel = Cancel::new(&(), "mesh", 1);
        let refined = bisect(&mut vertices, &mut triangles, 0.01, 500, &cancel);
        assert!(!refined.unwrap().complete);
        assert!(triangles.len() <= 500 && triangles.len() > 100);
    }
}
