//! Edges collapsed by meshoptimizer, until what is left is a body.

use super::ProxyError;
use crate::mesh::intersect::meetings;
use crate::mesh::vector::{add, bounding_box, scale, sub};
use crate::mesh::{MeshError, TriMesh, repair};

/// See [`TriMesh::proxy`]; `fine` has more than `triangles`.
pub(super) fn simplified(fine: &TriMesh, triangles: usize) -> Result<TriMesh, ProxyError> {
    let mut wanted = triangles;
    let mut kept = Kept::new(fine);
    let body = loop {
        let simplified = kept.collapsed(wanted);
        let count = simplified.len();
        let meet = meetings(&fine.vertices, &simplified);
        if !meet.is_empty() && count < fine.triangles.len() {
            kept.keep_around(meet.iter().map(|meeting| simplified[meeting.triangles[0]]));
            continue;
        }
        match closed_or_mended(&fine.vertices, simplified) {
            Ok(body) => break body,
            Err(error) if count >= fine.triangles.len() / 2 => {
                return Err(ProxyError::NoBody {
                    triangles: count,
                    error,
                });
            }
            // Thin parts fall together; finer triangles may spare them.
            Err(_) => wanted += wanted.div_ceil(2),
        }
    };
    // About any point; a point inside moves the surface least.
    let [low, high] = bounding_box(&body.vertices);
    let centre = scale(0.5, add(low, high));
    let factor = libm::cbrt(fine.volume() / body.volume());
    let restored = |&v: &[f64; 3]| add(centre, scale(factor, sub(v, centre)));
    Ok(TriMesh {
        vertices: body.vertices.iter().map(restored).collect(),
        smooth: fine.smooth,
        ..body
    })
}

/// The body, after what collapsed to nothing is taken out if need be.
fn closed_or_mended(vertices: &[[f64; 3]], triangles: Vec<[u32; 3]>) -> Result<TriMesh, MeshError> {
    TriMesh::closed(vertices.to_vec(), triangles.clone()).or_else(|_| {
        let (vertices, triangles) = repair::without_remnants(vertices.to_vec(), triangles);
        TriMesh::closed(vertices, triangles)
    })
}

/// The vertices of a body that must be kept so that no part of its surface passes through another.
struct Kept<'a> {
    body: &'a TriMesh,
    /// In single precision, which has room for what is left after centring.
    positions: Vec<[f32; 3]>,
    kept: Vec<bool>,
    /// Rings of neighbours to keep next.
    rings: usize,
}

impl Kept<'_> {
    fn new(body: &TriMesh) -> Kept<'_> {
        let [low, high] = bounding_box(&body.vertices);
        let size = (0..3).fold(f64::MIN_POSITIVE, |s, k| f64::max(s, high[k] - low[k]));
        let positions = body.vertices.iter();
        Kept {
            body,
            positions: positions
                .map(|v| std::array::from_fn(|k| ((v[k] - low[k]) / size) as f32))
                .collect(),
            kept: vec![false; body.vertices.len()],
            rings: 2,
        }
    }

    /// Triangles over some of the vertices, about `wanted` of them.
    fn collapsed(&self, wanted: usize) -> Vec<[u32; 3]> {
        let kept = meshopt::simplify_with_locks_decoder(
            self.body.triangles.as_flattened(),
            &self.positions,
            &self.kept,
            3 * wanted,
            f32::MAX,
            meshopt::SimplifyOptions::Regularize,
            None,
        );
        kept.as_chunks().0.to_vec()
    }

    /// Keeps what is around the corners of some triangles, farther each time.
    fn keep_around(&mut self, triangles: impl Iterator<Item = [u32; 3]>) {
        for v in triangles.flatten() {
            self.kept[v as usize] = true;
        }
        for _ in 0..self.rings {
            let before = self.kept.clone();
            for t in &self.body.triangles {
                if t.iter().any(|&v| before[v as usize]) {
                    t.iter().for_each(|&v| self.kept[v as usize] = true);
                }
            }
        }
        self.rings *= 2;
    }
}
