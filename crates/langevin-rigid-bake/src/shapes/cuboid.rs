//! Boxes on a grid of near-square cells.

use super::builder::{Builder, nearest};
use super::{ShapeError, enough, positive};
use crate::mesh::TriMesh;

const NAME: &str = "box";

pub(super) fn mesh(size: [f64; 3], triangles: usize) -> Result<TriMesh, ShapeError> {
    for (edge, name) in size
        .into_iter()
        .zip(["size along x", "size along y", "size along z"])
    {
        positive(NAME, name, edge)?;
    }
    enough(NAME, triangles, 12)?;
    let cells = cells(size, triangles);
    let mut surface = Builder::new(|place: [usize; 3]| {
        // Exactly antisymmetric about the middle.
        let offset = |k: usize| (2 * place[k]) as f64 - cells[k] as f64;
        [0, 1, 2].map(|k| size[k] * offset(k) / (2 * cells[k]) as f64)
    });
    for axis in 0..3 {
        add_faces(&mut surface, cells, axis);
    }
    surface.finish()
}

/// Numbers of cells along the edges, all from one number of cells along the longest.
fn cells(size: [f64; 3], triangles: usize) -> [usize; 3] {
    let longest = size[0].max(size[1]).max(size[2]);
    let at = |n: f64| size.map(|edge| ((edge / longest * n).round() as usize).max(1));
    let count = |n: f64| {
        let [l, m, n] = at(n);
        4 * (l * m + m * n + n * l)
    };
    at(nearest(count, 1.0, triangles as f64, triangles))
}

/// Adds both faces across `axis`, with the same triangles seen through the body.
///
/// Diagonals run from the nearest corner of the face towards its middle, so that no triangle has
/// all its corners on edges of the box, and the mesh has the symmetry of the box where the
/// numbers of cells are even.
fn add_faces<P: Fn([usize; 3]) -> [f64; 3]>(
    surface: &mut Builder<P>,
    cells: [usize; 3],
    axis: usize,
) {
    let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
    for i in 0..cells[u] {
        for j in 0..cells[v] {
            let falling = (2 * i < cells[u]) != (2 * j < cells[v]);
            for high in [false, true] {
                let corner = |(di, dj): (usize, usize)| {
                    let mut place = [0; 3];
                    place[axis] = if high { cells[axis] } else { 0 };
                    place[u] = i + di;
                    place[v] = j + dj;
                    place
                };
                let corners = [(0, 0), (1, 0), (1, 1), (0, 1)].map(corner);
                surface.quad(corners, falling, !high);
            }
        }
    }
}
