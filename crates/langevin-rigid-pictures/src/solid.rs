//! The mesh made ready to draw: shading normals, edges worth a line, and the axis that tells
//! one face of the body from the other.

use std::collections::BTreeMap;

use langevin_rigid::linalg::eigen_symmetric;

use crate::vector::{Mat3, Vec3, add, cross, dot, norm, normalize, scale, sub};
use crate::{PictureError, Subject};

/// Cosine of the angle between faces above which they are shaded as one smooth surface.
const SMOOTH: f64 = 0.77;

/// An edge of the mesh and what is known of the faces beside it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Edge {
    pub ends: [usize; 2],
    /// Faces on either side; the same twice for the border of an open sheet.
    pub faces: [usize; 2],
    /// Drawn whatever the direction it is seen from.
    pub sharp: bool,
}

/// A mesh about the centre of its bounding box, metres, body frame.
#[derive(Clone, Debug)]
pub(super) struct Solid {
    pub centre: Vec3,
    /// Largest distance of a vertex from `centre`.
    pub radius: f64,
    /// Relative to `centre`.
    pub vertices: Vec<Vec3>,
    pub triangles: Vec<[usize; 3]>,
    pub face_normals: Vec<Vec3>,
    /// One normal for each corner of each triangle, averaged over the smooth surface there.
    pub corner_normals: Vec<[Vec3; 3]>,
    pub edges: Vec<Edge>,
    /// Without holes and with normals outward.
    pub closed: bool,
    /// Unit vector along which the body is thinnest.
    pub thin_axis: Vec3,
}

impl Solid {
    pub(super) fn new(subject: &Subject<'_>) -> Result<Self, PictureError> {
        Self::check(subject)?;
        let (vertices, triangles) = weld(subject);
        let triangles = without_slivers(triangles);
        let centre = box_centre(&vertices);
        let vertices: Vec<Vec3> = vertices.iter().map(|v| sub(*v, centre)).collect();
        let area_normals: Vec<Vec3> = triangles
            .iter()
            .map(|t| area_normal(&vertices, *t))
            .collect();
        let face_normals: Vec<Vec3> = area_normals.iter().map(|n| normalize(*n)).collect();
        Ok(Self {
            centre,
            radius: vertices.iter().map(|v| norm(*v)).fold(0.0, f64::max),
            corner_normals: corner_normals(
                vertices.len(),
                &triangles,
                &area_normals,
                &face_normals,
            ),
            edges: edges(&triangles, &face_normals),
            closed: is_closed(&vertices, &triangles),
            thin_axis: thin_axis(&vertices, &triangles, &area_normals),
            vertices,
            triangles,
            face_normals,
        })
    }

    /// Whether a mesh can be drawn.
    pub(super) fn check(subject: &Subject<'_>) -> Result<(), PictureError> {
        if subject.triangles.is_empty() {
            return Err(PictureError::NoTriangles);
        }
        let bad = |v: &[f64; 3]| !v.iter().all(|c| c.abs() < 1e12);
        if let Some(index) = subject.vertices.iter().position(bad) {
            return Err(PictureError::BadVertex { index });
        }
        let vertices = subject.vertices.len();
        let outside = |t: &[u32; 3]| t.iter().any(|&v| v as usize >= vertices);
        match subject.triangles.iter().position(outside) {
            Some(index) => Err(PictureError::BadTriangle { index, vertices }),
            None => Ok(()),
        }
    }
}

/// Vertices used by the triangles, those at one point made one: readers of triangle soups give
/// every triangle its own.
fn weld(subject: &Subject<'_>) -> (Vec<Vec3>, Vec<[usize; 3]>) {
    let mut known = BTreeMap::new();
    let mut vertices = Vec::new();
    let triangles = subject
        .triangles
        .iter()
        .map(|t| {
            t.map(|v| {
                let point = subject.vertices[v as usize];
                // Adding zero turns -0 into +0, which are one point with two bit patterns.
                let key = point.map(|c| (c + 0.0).to_bits());
                *known.entry(key).or_insert_with(|| {
                    vertices.push(point);
                    vertices.len() - 1
                })
            })
        })
        .collect();
    (vertices, triangles)
}

/// Leaves out triangles that are a line or a point, such as those about the poles of a globe: they
/// have no normal, and would show as folds. A body of nothing else keeps them, to be seen at all.
fn without_slivers(triangles: Vec<[usize; 3]>) -> Vec<[usize; 3]> {
    let has_area = |[a, b, c]: &[usize; 3]| a != b && b != c && c != a;
    if triangles.iter().any(has_area) {
        triangles.into_iter().filter(has_area).collect()
    } else {
        triangles
    }
}

fn box_centre(vertices: &[Vec3]) -> Vec3 {
    std::array::from_fn(|i| {
        let low = vertices.iter().map(|v| v[i]).fold(f64::INFINITY, f64::min);
        let high = vertices
            .iter()
            .map(|v| v[i])
            .fold(f64::NEG_INFINITY, f64::max);
        0.5 * (low + high)
    })
}

/// Twice the area times the outward normal.
fn area_normal(vertices: &[Vec3], [a, b, c]: [usize; 3]) -> Vec3 {
    cross(sub(vertices[b], vertices[a]), sub(vertices[c], vertices[a]))
}

fn corner_normals(
    vertex_count: usize,
    triangles: &[[usize; 3]],
    area_normals: &[Vec3],
    face_normals: &[Vec3],
) -> Vec<[Vec3; 3]> {
    let mut around = vec![Vec::new(); vertex_count];
    for (face, t) in triangles.iter().enumerate() {
        t.iter().for_each(|&v| around[v].push(face));
    }
    let smooth = |face: usize, vertex: usize| {
        let own = face_normals[face];
        let near = around[vertex]
            .iter()
            .filter(|&&other| dot(own, face_normals[other]) > SMOOTH);
        normalize(near.fold([0.0; 3], |sum, &other| add(sum, area_normals[other])))
    };
    triangles
        .iter()
        .enumerate()
        .map(|(face, t)| t.map(|v| smooth(face, v)))
        .collect()
}

fn edges(triangles: &[[usize; 3]], face_normals: &[Vec3]) -> Vec<Edge> {
    let sides = triangles.iter().enumerate().flat_map(|(face, t)| {
        [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])].map(|(a, b)| ([a.min(b), a.max(b)], face))
    });
    let mut sides: Vec<([usize; 2], usize)> = sides.collect();
    sides.sort_unstable();
    let edge = |same: &[([usize; 2], usize)]| {
        let faces = [same[0].1, same[same.len() - 1].1];
        let folded = dot(face_normals[faces[0]], face_normals[faces[1]]) < SMOOTH;
        Edge {
            ends: same[0].0,
            faces,
            sharp: same.len() != 2 || folded,
        }
    };
    sides.chunk_by(|a, b| a.0 == b.0).map(edge).collect()
}

/// Whether every edge is passed once in each direction, around an inside of positive volume: then
/// only faces turned to the viewer can be seen.
fn is_closed(vertices: &[Vec3], triangles: &[[usize; 3]]) -> bool {
    let around = |t: &[usize; 3]| [[t[0], t[1]], [t[1], t[2]], [t[2], t[0]]];
    let mut there: Vec<[usize; 2]> = triangles.iter().flat_map(around).collect();
    let mut back: Vec<[usize; 2]> = there.iter().map(|[a, b]| [*b, *a]).collect();
    there.sort_unstable();
    back.sort_unstable();
    let volume = |t: &[usize; 3]| dot(vertices[t[0]], cross(vertices[t[1]], vertices[t[2]]));
    there == back
        && there.windows(2).all(|w| w[0] != w[1])
        && triangles.iter().map(volume).sum::<f64>() > 0.0
}

/// The axis of least spread of the surface: a body axis where one is as thin as any (preferring
/// y, then z, then x), otherwise the principal axis with its largest component positive.
fn thin_axis(vertices: &[Vec3], triangles: &[[usize; 3]], area_normals: &[Vec3]) -> Vec3 {
    let spread = surface_spread(vertices, triangles, area_normals);
    let ([least, ..], axes) = eigen_symmetric(&spread);
    let principal = axes.map(|row| row[0]);
    let tolerance = 1.05 * least + 1e-6 * (spread[0][0] + spread[1][1] + spread[2][2]);
    for i in [1, 2, 0] {
        if spread[i][i] <= tolerance {
            return std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 });
        }
    }
    let largest = principal
        .into_iter()
        .fold(0.0, |m: f64, c| if c.abs() > m.abs() { c } else { m });
    scale(largest.signum(), principal)
}

/// Second moments of the surface about its centroid, per area.
fn surface_spread(vertices: &[Vec3], triangles: &[[usize; 3]], area_normals: &[Vec3]) -> Mat3 {
    let areas: Vec<f64> = area_normals.iter().map(|n| norm(*n)).collect();
    let total: f64 = areas.iter().sum();
    let corners = |t: &[usize; 3]| t.map(|v| vertices[v]);
    let sum = |[a, b, c]: [Vec3; 3]| add(add(a, b), c);
    let mean = triangles.iter().zip(&areas).fold([0.0; 3], |s, (t, area)| {
        add(s, scale(area / (3.0 * total), sum(corners(t))))
    });
    let mut spread = [[0.0; 3]; 3];
    for (t, area) in triangles.iter().zip(&areas) {
        let [a, b, c] = corners(t).map(|v| sub(v, mean));
        // The integral of x x^T over a triangle is its area / 12 times the sum of these four.
        for d in [a, b, c, sum([a, b, c])] {
            for i in 0..3 {
                spread[i] = add(spread[i], scale(area / (12.0 * total) * d[i], d));
            }
        }
    }
    spread
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::{plate, turned};

    fn solid(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Solid {
        Solid::new(&Subject {
            vertices,
            triangles,
        })
        .unwrap()
    }

    #[test]
    fn the_thin_axis_of_a_plate_follows_the_plate() {
        let (vertices, triangles) = plate([0.08, 0.002, 0.04]);
        assert_eq!(solid(&vertices, &triangles).thin_axis, [0.0, 1.0, 0.0]);
        let half_turn_about = [0.6, 0.8, 0.0];
        let oblique = turned(&vertices, half_turn_about);
        let axis = solid(&oblique, &triangles).thin_axis;
        // y under a half turn about k is 2 (k.y) k - y.
        let want = [2.0 * 0.8 * 0.6, 2.0 * 0.8 * 0.8 - 1.0, 0.0];
        assert!(dot(axis, want).abs() > 1.0 - 1e-9, "{axis:?} {want:?}");
    }

    #[test]
    fn a_box_of_loose_triangles_has_twelve_sharp_edges() {
        let (vertices, mut triangles) = plate([1.0, 1.0, 1.0]);
        triangles.push([0, 0, 5]);
        let soup: Vec<Vec3> = triangles
            .iter()
            .flatten()
            .map(|&v| vertices[v as usize])
            .collect();
        let loose: Vec<[u32; 3]> = (0..triangles.len() as u32)
            .map(|t| [3 * t, 3 * t + 1, 3 * t + 2])
            .collect();
        let solid = solid(&soup, &loose);
        assert_eq!(solid.vertices.len(), 8);
        assert_eq!(solid.edges.iter().filter(|e| e.sharp).count(), 12);
        assert!(solid.closed);
        assert!((solid.radius - 0.75f64.sqrt()).abs() < 1e-15);
    }

    #[test]
    fn a_box_without_lid_or_inside_out_is_not_closed() {
        let (vertices, triangles) = plate([1.0, 1.0, 1.0]);
        assert!(!solid(&vertices, &triangles[1..]).closed);
        let inward: Vec<[u32; 3]> = triangles.iter().map(|[a, b, c]| [*a, *c, *b]).collect();
        assert!(!solid(&vertices, &inward).closed);
        let mut one_turned = triangles;
        one_turned[3].reverse();
        assert!(!solid(&vertices, &one_turned).closed);
    }
}
