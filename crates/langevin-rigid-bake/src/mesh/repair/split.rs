//! Parts that touch along an edge or in a point are given vertices of their own.

use super::{Options, Soup, Step};
use crate::mesh::edges::{Side, by_edge, sorted_sides};
use crate::mesh::parts::fans;
use crate::mesh::vector::{add, cross, dot, scale, sub};

/// Cuts the surface where more than two triangles meet, if solid and fluid alternate around the edge,
/// and where fans of triangles meet in a vertex.
pub(super) fn split(soup: &mut Soup, _: &Options) {
    let sides = sorted_sides(&soup.triangles);
    let mut edges = 0;
    let mut joined = Vec::new();
    for edge in by_edge(&sides) {
        match wedges(&soup.vertices, &soup.triangles, edge) {
            Some(pairs) => {
                edges += usize::from(edge.len() > 2);
                joined.extend(pairs);
            }
            // Not to be told apart: they stay together, and non-manifold.
            None => joined.extend(edge.windows(2).map(|pair| [&pair[0], &pair[1]])),
        }
    }
    let fans = fans(&soup.triangles, joined.into_iter());
    let vertices = soup.copy_vertices(&fans);
    soup.did(Step::Split { edges, vertices });
}

impl Soup {
    /// A vertex for each fan; how many were added.
    fn copy_vertices(&mut self, fans: &[usize]) -> usize {
        let before = self.vertices.len();
        let mut seen = vec![false; before];
        let mut number = vec![0; fans.len()];
        for (corner, v) in self.triangles.as_flattened_mut().iter_mut().enumerate() {
            let root = fans[corner];
            if root == corner {
                number[root] = *v;
                if std::mem::replace(&mut seen[*v as usize], true) {
                    number[root] = self.vertices.len() as u32;
                    self.vertices.push(self.vertices[*v as usize]);
                }
            }
            *v = number[root];
        }
        self.vertices.len() - before
    }
}

/// The sides of an edge in pairs with the body between the two.
fn wedges<'a>(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    edge: &'a [Side],
) -> Option<Vec<[&'a Side; 2]>> {
    match edge {
        [_] => return Some(Vec::new()),
        [a, b] => return Some(vec![[a, b]]),
        _ => {}
    }
    let mut around: Vec<(f64, &Side)> = edge
        .iter()
        .map(|side| (angle(vertices, triangles, &edge[0], side), side))
        .collect();
    around.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(b.1)));
    // The normal of a side that runs backward points to smaller angles: the body is beyond it.
    let first = around.iter().position(|(_, side)| side.backward)?;
    around.rotate_left(first);
    let pairs = around.chunks(2).map(|pair| match pair {
        [(_, a), (_, b)] if a.backward && !b.backward => Some([*a, *b]),
        _ => None,
    });
    pairs.collect()
}

/// Angle about an edge from the triangle of `first` to that of `side`, against the clock as seen from the
/// edge's higher vertex (rad, from 0 to a turn).
fn angle(vertices: &[[f64; 3]], triangles: &[[u32; 3]], first: &Side, side: &Side) -> f64 {
    let [low, high] = side.vertices.map(|v| vertices[v as usize]);
    let axis = sub(high, low);
    let arm = |side: &Side| {
        let corners = triangles[side.triangle as usize].map(|v| sub(vertices[v as usize], low));
        // The two on the edge have no arm.
        let sum = add(corners[0], add(corners[1], corners[2]));
        sub(sum, scale(dot(sum, axis) / dot(axis, axis), axis))
    };
    let u = arm(first);
    let v = scale(1.0 / dot(axis, axis).sqrt(), cross(axis, u));
    let d = arm(side);
    libm::atan2(dot(d, v), dot(d, u)).rem_euclid(std::f64::consts::TAU)
}
