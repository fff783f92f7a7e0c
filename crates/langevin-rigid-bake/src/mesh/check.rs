//! Every check a triangle soup must pass to be a body.

use super::edges::{Side, by_edge, disagree, sorted_sides};
use super::intersect::meetings;
use super::parts::{boxes, components, fans, windings};
use super::vector::{add, bounding_box, cross, dot, norm, scale, sub};
use super::{EdgeSite, MeshError, TriMesh};

/// Twice the area over the square of the longest edge, below which a triangle has no area: ten
/// thousand times the rounding of coordinates a hundred body lengths from the origin.
const DEGENERATE: f64 = 1e-10;
/// Volume over area times bounding-box diagonal, below which a closed surface is flat.
const FLAT: f64 = 1e-10;
/// Share of the volume that may be lost to rounding where parts are far apart.
const LOST: f64 = 1e-3;
/// Greatest deviation of RᵀR from the unit matrix in a transformation.
const ORTHOGONAL: f64 = 1e-9;

/// Checks that the surface is closed and has two sides.
pub(super) fn closed_manifold(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
) -> Result<(), MeshError> {
    well_formed(vertices, triangles)?;
    let sides = sorted_sides(triangles);
    manifold_edges(vertices, &sides)?;
    no_open_edges(vertices, &sides)?;
    oriented(vertices, triangles.len(), &sides)?;
    manifold_vertices(vertices, triangles)
}

/// Checks each triangle by itself, and that none is there twice.
pub(super) fn well_formed(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    if triangles.is_empty() {
        return Err(MeshError::Empty);
    }
    finite(vertices)?;
    indices_in_range(vertices, triangles)?;
    no_degenerate(vertices, triangles)?;
    no_duplicates(triangles)
}

pub(super) fn finite(vertices: &[[f64; 3]]) -> Result<(), MeshError> {
    let mut bad = (0..vertices.len()).filter(|&v| !vertices[v].iter().all(|x| x.is_finite()));
    match bad.next() {
        None => Ok(()),
        Some(vertex) => Err(MeshError::NonFiniteVertex {
            vertex,
            count: 1 + bad.count(),
        }),
    }
}

fn indices_in_range(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    for (triangle, corners) in triangles.iter().enumerate() {
        if let Some(&index) = corners.iter().find(|&&v| v as usize >= vertices.len()) {
            return Err(MeshError::IndexOutOfRange {
                triangle,
                index,
                vertices: vertices.len(),
            });
        }
    }
    Ok(())
}

fn no_degenerate(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let flat = |t: &usize| has_no_area(triangles[*t].map(|v| vertices[v as usize]));
    let mut bad = (0..triangles.len()).filter(flat);
    match bad.next() {
        None => Ok(()),
        Some(triangle) => Err(MeshError::DegenerateTriangle {
            triangle,
            vertices: triangles[triangle],
            count: 1 + bad.count(),
        }),
    }
}

/// A repeated vertex makes the area exactly zero, so this finds it as well.
pub(super) fn has_no_area([a, b, c]: [[f64; 3]; 3]) -> bool {
    let (u, v, w) = (sub(b, a), sub(c, a), sub(c, b));
    let longest_squared = dot(u, u).max(dot(v, v)).max(dot(w, w));
    // Written so that an overflow to infinity or not-a-number counts as degenerate.
    let has_area = norm(cross(u, v)) > DEGENERATE * longest_squared;
    !has_area
}

fn no_duplicates(triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let mut keyed: Vec<([u32; 3], usize)> = triangles.iter().copied().zip(0..).collect();
    for (key, _) in &mut keyed {
        key.sort_unstable();
    }
    keyed.sort_unstable();
    let repeats = keyed.windows(2).filter(|pair| pair[0].0 == pair[1].0);
    let count = repeats.clone().count();
    match repeats.min_by_key(|pair| pair[1].1) {
        None => Ok(()),
        Some(pair) => Err(MeshError::DuplicateTriangle {
            first: pair[0].1,
            second: pair[1].1,
            count,
        }),
    }
}

/// The first edge in triangle order among `bad`, and how many there are.
fn first_site<'a>(
    vertices: &[[f64; 3]],
    bad: impl Iterator<Item = &'a [Side]> + Clone,
) -> Option<(EdgeSite, &'a [Side], usize)> {
    let edge = bad
        .clone()
        .min_by_key(|edge| (edge[0].triangle, edge[0].vertices))?;
    Some((site(vertices, &edge[0]), edge, bad.count()))
}

pub(super) fn site(vertices: &[[f64; 3]], side: &Side) -> EdgeSite {
    let [a, b] = side.vertices.map(|v| vertices[v as usize]);
    EdgeSite {
        vertices: side.vertices,
        triangle: side.triangle,
        position: scale(0.5, add(a, b)),
    }
}

pub(super) fn manifold_edges(vertices: &[[f64; 3]], sides: &[Side]) -> Result<(), MeshError> {
    let bad: Vec<&[Side]> = by_edge(sides).filter(|edge| edge.len() > 2).collect();
    match first_site(vertices, bad.into_iter()) {
        None => Ok(()),
        Some((site, edge, count)) => Err(MeshError::NonManifoldEdge {
            site,
            triangles: edge.len(),
            count,
        }),
    }
}

fn no_open_edges(vertices: &[[f64; 3]], sides: &[Side]) -> Result<(), MeshError> {
    let bad: Vec<&[Side]> = by_edge(sides).filter(|edge| edge.len() == 1).collect();
    match first_site(vertices, bad.into_iter()) {
        None => Ok(()),
        Some((site, _, count)) => Err(MeshError::OpenEdges { site, count }),
    }
}

/// Checks that neighbours wind alike (edges with at most two triangles).
pub(super) fn oriented(
    vertices: &[[f64; 3]],
    triangle_count: usize,
    sides: &[Side],
) -> Result<(), MeshError> {
    let bad: Vec<&[Side]> = by_edge(sides).filter(|edge| disagree(edge)).collect();
    let Some((site, _, count)) = first_site(vertices, bad.into_iter()) else {
        return Ok(());
    };
    match windings(triangle_count, sides).1 {
        Some(side) => Err(MeshError::NotOrientable {
            site: self::site(vertices, &side),
        }),
        None => Err(MeshError::InconsistentOrientation { site, count }),
    }
}

/// Checks that the triangles at each vertex form one fan: all are reached from one by crossing
/// edges at that vertex (edges with at most two triangles).
pub(super) fn manifold_vertices(
    vertices: &[[f64; 3]],
    triangles: &[[u32; 3]],
) -> Result<(), MeshError> {
    // Fans in excess of one at a vertex are pinches.
    let sides = sorted_sides(triangles);
    let pairs = by_edge(&sides).filter(|edge| edge.len() == 2);
    let fans = fans(triangles, pairs.map(|edge| [&edge[0], &edge[1]]));
    let mut fan_count = vec![0u32; vertices.len()];
    for (c, &v) in triangles.as_flattened().iter().enumerate() {
        fan_count[v as usize] += u32::from(fans[c] == c);
    }
    let mut bad = (0u32..).zip(&fan_count).filter(|&(_, &n)| n > 1);
    match bad.next() {
        None => Ok(()),
        Some((vertex, _)) => Err(MeshError::NonManifoldVertex {
            vertex,
            position: vertices[vertex as usize],
            count: 1 + bad.count(),
        }),
    }
}

/// Checks that each component encloses something.
pub(super) fn volumes(mesh: &TriMesh, root_of: &[usize], volumes: &[f64]) -> Result<(), MeshError> {
    let mut areas = vec![0.0; volumes.len()];
    for (t, &root) in root_of.iter().enumerate() {
        areas[root] += mesh.area(t);
    }
    let boxes = boxes(&mesh.vertices, &mesh.triangles, root_of);
    let size = |root: usize| sub(boxes[root][1], boxes[root][0]);
    let is_flat = |&root: &usize| {
        let encloses = volumes[root].abs() > FLAT * areas[root] * norm(size(root));
        root_of[root] == root && !encloses
    };
    match (0..volumes.len()).find(is_flat) {
        None => Ok(()),
        Some(root) => Err(MeshError::ZeroVolume {
            volume: volumes[root],
            size: size(root),
        }),
    }
}

/// Checks that `displaced`, the sum over the parts (m³), is what integrals over all of the surface give.
pub(super) fn resolved(mesh: &TriMesh, displaced: f64) -> Result<(), MeshError> {
    let found = mesh.volume();
    if (found - displaced).abs() <= LOST * displaced {
        return Ok(());
    }
    let [low, high] = mesh.bounding_box();
    Err(MeshError::PartsFarApart {
        volume: displaced,
        found,
        size: sub(high, low),
    })
}

/// Checks that no triangles pass through each other or lie on each other.
pub(super) fn apart(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Result<(), MeshError> {
    let meetings = meetings(vertices, triangles);
    let Some(first) = meetings.first() else {
        return Ok(());
    };
    let [a, b] = first.triangles;
    let roots = components(triangles.len(), &sorted_sides(triangles));
    let (count, position) = (meetings.len(), first.position);
    Err(if roots[a] == roots[b] {
        MeshError::SelfIntersection {
            triangles: [a, b],
            position,
            count,
        }
    } else {
        MeshError::PartsMeet {
            wrap: fitting_wrap(bounding_box(vertices)),
            triangles: [a, b],
            position,
            count,
        }
    })
}

/// A size of a wrap that fits a body of some box (m): two digits of a fiftieth of its diagonal.
pub fn fitting_wrap([low, high]: [[f64; 3]; 2]) -> f64 {
    let size = 0.02 * norm(sub(high, low));
    format!("{size:.1e}").parse().unwrap_or(size)
}

/// Checks the parts of a similarity transformation.
pub(super) fn transform(
    rotation: &[[f64; 3]; 3],
    translation: [f64; 3],
    scale: f64,
) -> Result<(), MeshError> {
    let bad = |reason| Err(MeshError::BadTransform { reason });
    if !(scale > 0.0 && scale.is_finite()) {
        return bad("the scale must be positive and finite");
    }
    if !translation.iter().all(|x| x.is_finite()) {
        return bad("the translation must be finite");
    }
    let orthogonal = (0..3).all(|i| {
        (0..3).all(|j| {
            let expected = f64::from(u8::from(i == j));
            (dot(rotation[i], rotation[j]) - expected).abs() < ORTHOGONAL
        })
    });
    if orthogonal {
        Ok(())
    } else {
        bad("the rotation must be an orthogonal matrix")
    }
}
