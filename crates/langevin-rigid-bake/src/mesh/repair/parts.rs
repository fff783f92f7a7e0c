//! One component of several.

use super::{Options, Soup, Step, area_of};
use crate::mesh::edges::sorted_sides;
use crate::mesh::parts::components;
use crate::mesh::weld::drop_unused;

/// Keeps the component of the largest surface, if asked to.
pub(super) fn keep_largest(soup: &mut Soup, options: &Options) {
    if !options.largest || soup.triangles.is_empty() {
        return;
    }
    let roots = components(soup.triangles.len(), &sorted_sides(&soup.triangles));
    let areas = areas(&soup.vertices, &soup.triangles, &roots);
    // Of equals the first.
    let largest = (0..areas.len())
        .rev()
        .max_by(|&a, &b| areas[a].total_cmp(&areas[b]));
    let dropped = (0..roots.len()).filter(|&t| roots[t] == t).count() - 1;
    let before = soup.triangles.len();
    let kept = (0..before).filter(|&t| Some(roots[t]) == largest);
    let kept = kept.map(|t| soup.triangles[t]).collect();
    (soup.vertices, soup.triangles) = drop_unused(std::mem::take(&mut soup.vertices), kept);
    let triangles = before - soup.triangles.len();
    let area = areas.iter().sum::<f64>() - largest.map_or(0.0, |root| areas[root]);
    soup.did(Step::Components {
        dropped,
        triangles,
        area,
    });
}

/// Area of each component (m²), at the number of its first triangle.
pub(in crate::mesh) fn areas(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    roots: &[usize],
) -> Vec<f64> {
    let mut areas = vec![0.0; triangles.len()];
    for (t, &root) in triangles.iter().zip(roots) {
        areas[root] += area_of(t.map(|v| vertices[v as usize]));
    }
    areas
}
