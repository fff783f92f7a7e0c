//! One layer of short elements along the sharp edges, and the exponents of the flow there.

use super::edges::{Edges, Fold, folds};
use super::near::{NearPairs, facing};
use super::panels::{Panels, Vec3};
use crate::mesh::vector::{add, dot, scale, sub};

/// Where an edge that leaves a sharp one is cut.
const CUT: f64 = 0.3;

/// A vertex on the edge from `ends[0]` to `ends[1]`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Inserted {
    pub(super) ends: [u32; 2],
    pub(super) fraction: f64,
}

/// Cuts every mesh edge that leaves a sharp edge of the body; the old vertices stay first and the
/// new ones follow in the order returned.
pub(super) fn insert(vertices: &mut Vec<Vec3>, triangles: &mut Vec<[u32; 3]>) -> Vec<Inserted> {
    let edges = Edges::new(triangles);
    let mut sharp_edge = vec![false; edges.ends.len()];
    let mut sharp_vertex = vec![false; vertices.len()];
    for sharp in folds(&edges, vertices, triangles)
        .iter()
        .filter(|f| f.is_sharp())
    {
        sharp_edge[sharp.edge] = true;
        for v in edges.ends[sharp.edge] {
            sharp_vertex[v as usize] = true;
        }
    }
    let mut inserted = Vec::new();
    let cuts: Vec<Option<u32>> = edges
        .ends
        .iter()
        .zip(&sharp_edge)
        .map(|(&[a, b], &sharp)| {
            let cut = match (sharp, sharp_vertex[a as usize], sharp_vertex[b as usize]) {
                (true, _, _) | (false, false, false) => return None,
                (false, true, true) => Inserted {
                    ends: [a, b],
                    fraction: 0.5,
                },
                (false, true, false) => Inserted {
                    ends: [a, b],
                    fraction: CUT,
                },
                (false, false, true) => Inserted {
                    ends: [b, a],
                    fraction: CUT,
                },
            };
            inserted.push(cut);
            Some((vertices.len() + inserted.len() - 1) as u32)
        })
        .collect();
    for cut in &inserted {
        let [a, b] = cut.ends.map(|v| vertices[v as usize]);
        vertices.push(add(scale(1.0 - cut.fraction, a), scale(cut.fraction, b)));
    }
    let mut result = Vec::with_capacity(triangles.len() * 2);
    for (corners, sides) in triangles.iter().zip(&edges.sides) {
        split(
            *corners,
            sides.map(|e| cuts[e as usize]),
            vertices,
            &mut result,
        );
    }
    *triangles = result;
    inserted
}

/// Cuts a triangle at the points on its sides; side k starts at corner k.
fn split(corners: [u32; 3], cuts: [Option<u32>; 3], vertices: &[Vec3], result: &mut Vec<[u32; 3]>) {
    // Turned so that the sides with a cut come first.
    let count = cuts.iter().flatten().count();
    let first = (0..3).find(|&k| match count {
        1 => cuts[k].is_some(),
        2 => cuts[(k + 2) % 3].is_none(),
        _ => true,
    });
    let k = first.unwrap_or(0);
    let [a, b, c] = [0, 1, 2].map(|i| corners[(k + i) % 3]);
    match [0, 1, 2].map(|i| cuts[(k + i) % 3]) {
        [Some(p), Some(q), Some(r)] => {
            result.extend([[a, p, r], [p, b, q], [r, q, c], [p, q, r]]);
        }
        [Some(p), Some(q), None] => {
            result.push([p, b, q]);
            result.extend(split_quadrilateral([a, p, q, c], vertices));
        }
        [Some(p), _, _] => result.extend([[a, p, c], [p, b, c]]),
        _ => result.push(corners),
    }
}

/// Cuts along the shorter diagonal; equal ones at the lowest vertex.
fn split_quadrilateral(q: [u32; 4], vertices: &[Vec3]) -> [[u32; 3]; 2] {
    let length2 = |a: u32, b: u32| {
        let d = sub(vertices[b as usize], vertices[a as usize]);
        dot(d, d) as f32
    };
    let even = (length2(q[0], q[2]), q[0].min(q[2]));
    let odd = (length2(q[1], q[3]), q[1].min(q[3]));
    if even < odd {
        [[q[0], q[1], q[2]], [q[0], q[2], q[3]]]
    } else {
        [[q[0], q[1], q[3]], [q[1], q[2], q[3]]]
    }
}

/// How the tensor's defect at the sharp edges shrinks where the layer was added: s^(2 lambda), with
/// lambda the mean exponent over the length of the edges.
///
/// The potential grows like the distance to the power lambda = pi / beta off an edge of exterior
/// angle beta; where the body is thinner than the layer is wide the edge acts as that of a sheet,
/// lambda = 1/2. Zero where rounding leaves no edge sharp.
pub(super) fn shrinkage(panels: &Panels, pairs: &NearPairs) -> f64 {
    let corners: Vec<[u32; 3]> = panels.panels.iter().map(|p| p.corners).collect();
    let edges = Edges::new(&corners);
    let (mut weighted, mut total) = (0.0, 0.0);
    for sharp in folds(&edges, &panels.vertices, &corners)
        .iter()
        .filter(|f| f.is_sharp())
    {
        weighted += sharp.length * exponent(sharp, panels, pairs);
        total += sharp.length;
    }
    if total == 0.0 {
        return 0.0;
    }
    libm::pow(CUT, 2.0 * weighted / total)
}

fn exponent(sharp: &Fold, panels: &Panels, pairs: &NearPairs) -> f64 {
    let unresolved = sharp.triangles.iter().any(|&a| {
        let panel = &panels.panels[a];
        let height = 2.0 * panel.area / sharp.length;
        facing(a, &panels.panels, pairs).any(|f| f.through_body && f.gap < height)
    });
    if unresolved {
        0.5
    } else {
        std::f64::consts::PI / (std::f64::consts::PI + sharp.turn)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_tetrahedron_is_all_edges() {
        let mut vertices = vec![[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
        let mut triangles = vec![[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        assert!(insert(&mut vertices, &mut triangles).is_empty());
        assert_eq!(triangles.len(), 4);
    }

    #[test]
    fn triangles_split_into_as_many_as_their_cuts_and_one() {
        let vertices = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0]]
            .into_iter()
            .chain([[0.3, 0.0, 0.0], [0.5, 0.5, 0.0], [0.0, 0.3, 0.0]])
            .collect::<Vec<Vec3>>();
        for mask in 0..8usize {
            let cuts = [0, 1, 2].map(|k| (mask >> k & 1 == 1).then_some(3 + k as u32));
            let mut result = Vec::new();
            split([0, 1, 2], cuts, &vertices, &mut result);
            assert_eq!(result.len(), 1 + mask.count_ones() as usize);
            let area = |t: &[u32; 3]| {
                let [a, b, c] = t.map(|v| vertices[v as usize]);
                0.5 * ((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
            };
            assert!(result.iter().all(|t| area(t) > 0.0));
            assert!((result.iter().map(area).sum::<f64>() - 0.5).abs() < 1e-15);
        }
    }
}
