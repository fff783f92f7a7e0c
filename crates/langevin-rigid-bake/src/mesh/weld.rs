//! Joining and dropping vertices.

use std::collections::BTreeMap;

/// Gives vertices at bitwise equal positions (−0 counted as 0) one number, that of the first.
///
/// Formats that store a vertex per facet or per texture seam (STL, glTF, some PLY) need this
/// before the surface can be seen to be closed. Triangles keep their order; those that lose a
/// corner to the welding and have no area left stay and are reported by
/// [`TriMesh::new`](super::TriMesh::new). Indices out of range are kept as they are.
///
/// ```
/// use langevin_rigid_bake::mesh::weld;
///
/// let (vertices, triangles) = weld(
///     &[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, -0.0, 0.0]],
///     &[[0, 1, 2], [3, 0, 2]],
/// );
/// assert_eq!(vertices.len(), 3);
/// assert_eq!(triangles, [[0, 1, 2], [1, 0, 2]]);
/// ```
pub fn weld(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut first_at = BTreeMap::new();
    let mut kept = Vec::new();
    let mut number = Vec::with_capacity(vertices.len());
    for v in vertices {
        // Adding +0 turns −0 into 0.
        let key = v.map(|x| (x + 0.0).to_bits());
        number.push(*first_at.entry(key).or_insert_with(|| {
            kept.push(*v);
            kept.len() as u32 - 1
        }));
    }
    let renumber = |v: u32| number.get(v as usize).copied().unwrap_or(v);
    let triangles = triangles.iter().map(|t| t.map(renumber)).collect();
    (kept, triangles)
}

/// Drops vertices no triangle uses and renumbers the others in order (indices in range).
pub(super) fn drop_unused(
    vertices: Vec<[f64; 3]>,
    mut triangles: Vec<[u32; 3]>,
) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mut used = vec![false; vertices.len()];
    for &v in triangles.as_flattened() {
        used[v as usize] = true;
    }
    if used.iter().all(|&u| u) {
        return (vertices, triangles);
    }
    let mut kept = Vec::with_capacity(vertices.len());
    let mut number = vec![0u32; vertices.len()];
    for (v, position) in vertices.into_iter().enumerate().filter(|&(v, _)| used[v]) {
        number[v] = kept.len() as u32;
        kept.push(position);
    }
    for v in triangles.as_flattened_mut() {
        *v = number[*v as usize];
    }
    (kept, triangles)
}
