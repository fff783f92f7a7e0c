//! Windings that agree, and normals that point outward.

use super::{Options, Soup, Step};
use crate::mesh::body::depths;
use crate::mesh::edges::{by_edge, sorted_sides};
use crate::mesh::parts::{boxes, windings};
use crate::mesh::vector::{add, cross, dot, scale, sub};

/// Turns the fewer triangles of each component that disagree with the more, then closed components whose
/// normals point into the solid. A surface with one side only is left as it is.
pub(super) fn agree(soup: &mut Soup, _: &Options) {
    let sides = sorted_sides(&soup.triangles);
    let (parts, one_sided) = windings(soup.triangles.len(), &sides);
    if one_sided.is_some() {
        return;
    }
    let minority = minority(&parts);
    let turned = soup.turn(&minority);
    soup.did(Step::Turned { triangles: turned });
    let mut closed = vec![true; soup.triangles.len()];
    for edge in by_edge(&sides).filter(|edge| edge.len() == 1) {
        closed[parts[edge[0].triangle as usize].0] = false;
    }
    let roots: Vec<usize> = parts.iter().map(|part| part.0).collect();
    let volumes = signed_volumes(&soup.vertices, &soup.triangles, &roots);
    let depths = depths(&soup.vertices, &soup.triangles, &roots, |root| closed[root]);
    let is_inside_out = |root: usize| (volumes[root] < 0.0) != (depths[root] % 2 == 1);
    let inward: Vec<bool> = roots
        .iter()
        .map(|&root| closed[root] && is_inside_out(root))
        .collect();
    let triangles = soup.turn(&inward);
    soup.did(Step::InsideOut { triangles });
}

impl Soup {
    fn turn(&mut self, which: &[bool]) -> usize {
        for (t, _) in self
            .triangles
            .iter_mut()
            .zip(which)
            .filter(|(_, turn)| **turn)
        {
            t.swap(1, 2);
        }
        which.iter().filter(|turn| **turn).count()
    }
}

/// The triangles that wind as fewer of their component do (of two halves, those unlike its first).
pub(in crate::mesh) fn minority(parts: &[(usize, bool)]) -> Vec<bool> {
    let mut balance = vec![0i64; parts.len()];
    for &(root, opposite) in parts {
        balance[root] += if opposite { 1 } else { -1 };
    }
    let turn = |&(root, opposite): &(usize, bool)| opposite != (balance[root] > 0);
    parts.iter().map(turn).collect()
}

/// Volume under each component (m³), at the number of its first triangle.
///
/// About the middle of its own box: about that of all, what is small and far from there would be lost to rounding.
pub(in crate::mesh) fn signed_volumes(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    roots: &[usize],
) -> Vec<f64> {
    let boxes = boxes(vertices, triangles, roots);
    let mut six_volumes = vec![0.0; triangles.len()];
    for (t, &root) in triangles.iter().zip(roots) {
        let [low, high] = boxes[root];
        let middle = scale(0.5, add(low, high));
        let [a, b, c] = t.map(|v| sub(vertices[v as usize], middle));
        six_volumes[root] += dot(a, cross(b, c));
    }
    six_volumes.into_iter().map(|six| six / 6.0).collect()
}
