//! Thickening an open sheet into a closed body.

use super::boundary::open_sides;
use super::edges::{Side, sorted_sides};
use super::vector::{add, cross, dot, norm, scale, sub, unit};
use super::{MeshError, check};

/// Least cosine between a vertex normal and the normals of its triangles: a sharper fold would
/// throw the offset vertex further than ten thicknesses away.
const SHARPEST_FOLD: f64 = 0.05;

/// Vertices and triangles.
type Soup = (Vec<[f64; 3]>, Vec<[u32; 3]>);

/// Vertices and triangles of the body made of the sheet moved to either side, and its rim.
pub(super) fn thicken(
    mut vertices: Vec<[f64; 3]>,
    mut triangles: Vec<[u32; 3]>,
    thickness: f64,
) -> Result<Soup, MeshError> {
    let rim = rim_of_sheet(&vertices, &triangles, thickness)?;
    let offsets = offset_directions(&vertices, &triangles)?;
    let n = vertices.len() as u32;
    let moved = |v: [f64; 3], o: &[f64; 3], half: f64| add(v, scale(half, *o));
    let back: Vec<_> = vertices
        .iter()
        .zip(&offsets)
        .map(|(v, o)| moved(*v, o, -0.5 * thickness))
        .collect();
    for (v, o) in vertices.iter_mut().zip(&offsets) {
        *v = moved(*v, o, 0.5 * thickness);
    }
    vertices.extend(back);
    triangles.extend(back_and_wall(n, &triangles, &rim));
    Ok((vertices, triangles))
}

/// The open edges of a sheet, after every check.
fn rim_of_sheet(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
    thickness: f64,
) -> Result<Vec<Side>, MeshError> {
    if !(thickness > 0.0 && thickness.is_finite()) {
        return Err(MeshError::BadThickness { thickness });
    }
    check::well_formed(vertices, triangles)?;
    let sides = sorted_sides(triangles);
    check::manifold_edges(vertices, &sides)?;
    check::oriented(vertices, triangles.len(), &sides)?;
    check::manifold_vertices(vertices, triangles)?;
    let rim = open_sides(&sides);
    if rim.is_empty() {
        Err(MeshError::ClosedSheet)
    } else {
        Ok(rim)
    }
}

/// The back, reversed, and two triangles per rim edge; the back's vertices follow the front's `n`.
fn back_and_wall(n: u32, front: &[[u32; 3]], rim: &[Side]) -> Vec<[u32; 3]> {
    let back = front.iter().map(|&[a, b, c]| [a + n, c + n, b + n]);
    let wall = rim.iter().flat_map(|side| {
        let [from, to] = side.run();
        // The front runs from → to, so the wall must run to → from.
        [[to, from, from + n], [to, from + n, to + n]]
    });
    back.chain(wall).collect()
}

/// For each vertex the vector along its angle-weighted normal whose component along the normals
/// of its triangles is 1 in the angle-weighted mean.
fn offset_directions(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
) -> Result<Vec<[f64; 3]>, MeshError> {
    let mut weighted = vec![[0.0; 3]; vertices.len()];
    let mut angle_sum = vec![0.0; vertices.len()];
    for t in triangles {
        let corners = t.map(|v| vertices[v as usize]);
        let normal = unit(cross(
            sub(corners[1], corners[0]),
            sub(corners[2], corners[0]),
        ));
        for k in 0..3 {
            let angle = corner_angle(corners[k], corners[(k + 1) % 3], corners[(k + 2) % 3]);
            let v = t[k] as usize;
            weighted[v] = add(weighted[v], scale(angle, normal));
            angle_sum[v] += angle;
        }
    }
    let direction = |v: usize| offset_direction(weighted[v], angle_sum[v]);
    (0..vertices.len())
        .map(|v| {
            let folded = MeshError::FoldedSheet {
                vertex: v as u32,
                position: vertices[v],
            };
            direction(v).ok_or(folded)
        })
        .collect()
}

/// With S = Σ angle · n, the mean of n · S/|S| is |S| / Σ angle, by which the unit normal is
/// divided. Nothing for a vertex on a closed fold; zero for one no triangle uses.
fn offset_direction(weighted: [f64; 3], angle_sum: f64) -> Option<[f64; 3]> {
    if angle_sum == 0.0 {
        return Some([0.0; 3]);
    }
    let length = norm(weighted);
    let cosine = length / angle_sum;
    (cosine > SHARPEST_FOLD).then(|| scale(1.0 / (length * cosine), weighted))
}

/// Angle at `a` of the triangle a b c (rad).
fn corner_angle(a: [f64; 3], b: [f64; 3], c: [f64; 3]) -> f64 {
    let (u, v) = (sub(b, a), sub(c, a));
    libm::atan2(norm(cross(u, v)), dot(u, v))
}
