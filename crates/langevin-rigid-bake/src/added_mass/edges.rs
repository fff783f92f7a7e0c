//! Edges of a triangle mesh: which triangles they join and how sharply.

use super::panels::Vec3;
use crate::mesh::vector::{cross, dot, norm, sub, unit};

/// Angle between the normals beyond which an edge is one of the body rather than of the mesh. Off
/// the angles of regular prisms, so that rounding never decides.
pub(super) const SHARP: f64 = 31.0 * std::f64::consts::PI / 180.0;

/// Every undirected edge once, and the edge of each triangle's sides (side k starts at corner k).
pub(super) struct Edges {
    /// Ends, the lower vertex first; sorted.
    pub(super) ends: Vec<[u32; 2]>,
    pub(super) sides: Vec<[u32; 3]>,
}

impl Edges {
    pub(super) fn new(triangles: &[[u32; 3]]) -> Edges {
        let mut keyed: Vec<([u32; 2], u32)> = triangles
            .iter()
            .enumerate()
            .flat_map(|(t, c)| (0..3).map(move |k| (ordered(c[k], c[(k + 1) % 3]), t * 3 + k)))
            .map(|(ends, side)| (ends, side as u32))
            .collect();
        keyed.sort_unstable();
        let mut edges = Edges {
            ends: Vec::new(),
            sides: vec![[0; 3]; triangles.len()],
        };
        for (ends, side) in keyed {
            if edges.ends.last() != Some(&ends) {
                edges.ends.push(ends);
            }
            let (t, k) = (side as usize / 3, side as usize % 3);
            edges.sides[t][k] = edges.ends.len() as u32 - 1;
        }
        edges
    }

    /// The two triangles of each edge of a closed mesh.
    pub(super) fn triangles(&self) -> Vec<[u32; 2]> {
        // The later of the two overwrites the second entry.
        let mut of = vec![None; self.ends.len()];
        for (t, sides) in self.sides.iter().enumerate() {
            for &e in sides {
                let first = of[e as usize].map_or(t as u32, |[first, _]: [u32; 2]| first);
                of[e as usize] = Some([first, t as u32]);
            }
        }
        of.into_iter().flatten().collect()
    }
}

pub(super) fn ordered(a: u32, b: u32) -> [u32; 2] {
    if a < b { [a, b] } else { [b, a] }
}

/// A mesh edge as the fold between its two triangles.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Fold {
    /// Its number in [`Edges`].
    pub(super) edge: usize,
    /// The triangles it joins.
    pub(super) triangles: [usize; 2],
    /// Angle between their normals (rad).
    pub(super) turn: f64,
    pub(super) convex: bool,
    pub(super) length: f64,
}

impl Fold {
    /// Whether this is a convex edge of the body rather than of the mesh.
    pub(super) fn is_sharp(&self) -> bool {
        self.convex && self.turn > SHARP
    }
}

/// The fold at every edge of a closed mesh.
pub(super) fn folds(edges: &Edges, vertices: &[Vec3], triangles: &[[u32; 3]]) -> Vec<Fold> {
    let faces: Vec<[Vec3; 2]> = triangles
        .iter()
        .map(|t| t.map(|v| vertices[v as usize]))
        .map(|[a, b, c]| {
            [
                std::array::from_fn(|k| (a[k] + b[k] + c[k]) / 3.0),
                face_normal(a, b, c),
            ]
        })
        .collect();
    let measure = |(edge, pair): (usize, [u32; 2])| {
        let [s, t] = pair.map(|t| t as usize);
        let ([c1, n1], [c2, n2]) = (faces[s], faces[t]);
        let [from, to] = edges.ends[edge].map(|v| vertices[v as usize]);
        Fold {
            edge,
            triangles: [s, t],
            turn: libm::atan2(norm(cross(n1, n2)), dot(n1, n2)),
            convex: dot(sub(c2, c1), sub(n1, n2)) < 0.0,
            length: norm(sub(to, from)),
        }
    };
    edges
        .triangles()
        .into_iter()
        .enumerate()
        .map(measure)
        .collect()
}

fn face_normal(a: Vec3, b: Vec3, c: Vec3) -> Vec3 {
    unit(cross(sub(b, a), sub(c, a)))
}
