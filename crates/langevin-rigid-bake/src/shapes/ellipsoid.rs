//! Ellipsoids: subdivided icosahedra.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use super::{ShapeError, enough, positive};
use crate::mesh::TriMesh;
use crate::mesh::vector::{add, cross, dot, scale, unit};

const NAME: &str = "ellipsoid";

pub(super) fn mesh(semi_axes: [f64; 3], triangles: usize) -> Result<TriMesh, ShapeError> {
    for (axis, name) in semi_axes
        .into_iter()
        .zip(["semi-axis a", "semi-axis b", "semi-axis c"])
    {
        positive(NAME, name, axis)?;
    }
    enough(NAME, triangles, 20)?;
    let mut sphere = icosahedron();
    for factor in prime_factors(frequency(triangles)) {
        sphere = sphere.subdivided(factor);
    }
    let stretch = |v: &[f64; 3]| [0, 1, 2].map(|k| semi_axes[k] * v[k]);
    let vertices = sphere.vertices.iter().map(stretch).collect();
    let exact = 4.0 / 3.0 * PI * semi_axes[0] * semi_axes[1] * semi_axes[2];
    let mesh = TriMesh::new(vertices, sphere.triangles)?.scaled_to_volume(exact)?;
    Ok(mesh.with_smooth(true))
}

/// The f whose 20 f² is nearest to `triangles`.
fn frequency(triangles: usize) -> usize {
    let below = ((triangles / 20) as f64).sqrt() as usize;
    let distance = |f: &usize| (20 * f * f).abs_diff(triangles);
    (below.max(1)..=below + 1).min_by_key(distance).unwrap_or(1)
}

fn prime_factors(mut n: usize) -> Vec<usize> {
    let mut factors = Vec::new();
    let mut p = 2;
    while n > 1 {
        while n.is_multiple_of(p) {
            factors.push(p);
            n /= p;
        }
        p += 1;
    }
    factors
}

/// A triangulated unit sphere.
struct Sphere {
    vertices: Vec<[f64; 3]>,
    triangles: Vec<[u32; 3]>,
}

/// The regular icosahedron with vertices at the cyclic permutations of (0, ±1, ±golden ratio).
fn icosahedron() -> Sphere {
    let golden = 0.5 * (1.0 + 5f64.sqrt());
    let mut vertices = Vec::new();
    for k in 0..3 {
        for (s, t) in [(1.0, 1.0), (1.0, -1.0), (-1.0, 1.0), (-1.0, -1.0)] {
            let mut v = [0.0; 3];
            v[(k + 1) % 3] = s;
            v[(k + 2) % 3] = t * golden;
            vertices.push(unit(v));
        }
    }
    Sphere {
        triangles: faces(&vertices),
        vertices,
    }
}

/// The triples of neighbouring vertices of the unit icosahedron, counter-clockwise from outside.
fn faces(vertices: &[[f64; 3]]) -> Vec<[u32; 3]> {
    // Neighbours have the scalar product 1/√5, others −1/√5 or −1.
    let near = |a: usize, b: usize| dot(vertices[a], vertices[b]) > 0.0;
    let n = vertices.len();
    let mut faces = Vec::new();
    for (a, b, c) in
        (0..n).flat_map(|a| (a + 1..n).flat_map(move |b| (b + 1..n).map(move |c| (a, b, c))))
    {
        if near(a, b) && near(b, c) && near(c, a) {
            let outward = dot(vertices[a], cross(vertices[b], vertices[c])) > 0.0;
            let [a, b, c] = [a, b, c].map(|v| v as u32);
            faces.push(if outward { [a, b, c] } else { [a, c, b] });
        }
    }
    faces
}

impl Sphere {
    /// Each triangle in `n`² by equal division of its sides, new vertices put on the sphere.
    fn subdivided(self, n: usize) -> Sphere {
        let mut fine = Sphere {
            vertices: self.vertices,
            triangles: Vec::new(),
        };
        let mut on_edge = BTreeMap::new();
        for corners in self.triangles {
            let grid = fine.grid(corners, n, &mut on_edge);
            for i in 0..n {
                for j in 0..=i {
                    fine.triangles
                        .push([grid[i][j], grid[i + 1][j], grid[i + 1][j + 1]]);
                    if j < i {
                        fine.triangles
                            .push([grid[i][j], grid[i + 1][j + 1], grid[i][j + 1]]);
                    }
                }
            }
        }
        fine
    }

    /// Vertex numbers of a divided triangle: row i has i + 1 of them, from corner a down to b c.
    fn grid(
        &mut self,
        [a, b, c]: [u32; 3],
        n: usize,
        on_edge: &mut BTreeMap<[u32; 3], u32>,
    ) -> Vec<Vec<u32>> {
        let mut vertex = |i: usize, j: usize| {
            let weights = [n - i, i - j, j];
            let corners = [a, b, c];
            match weights.map(|w| w == 0) {
                [true, true, _] => c,
                [true, _, true] => b,
                [_, true, true] => a,
                [false, false, false] => self.push_between(corners, weights),
                side => {
                    let [p, q]: [usize; 2] = match side {
                        [true, ..] => [1, 2],
                        [_, true, _] => [0, 2],
                        _ => [0, 1],
                    };
                    let (p, q) = if corners[p] < corners[q] {
                        (p, q)
                    } else {
                        (q, p)
                    };
                    let key = [corners[p], corners[q], weights[q] as u32];
                    *on_edge
                        .entry(key)
                        .or_insert_with(|| self.push_between(corners, weights))
                }
            }
        };
        (0..=n)
            .map(|i| (0..=i).map(|j| vertex(i, j)).collect())
            .collect()
    }

    fn push_between(&mut self, corners: [u32; 3], weights: [usize; 3]) -> u32 {
        let mut sum = [0.0; 3];
        for (corner, weight) in corners.into_iter().zip(weights) {
            sum = add(sum, scale(weight as f64, self.vertices[corner as usize]));
        }
        self.vertices.push(unit(sum));
        self.vertices.len() as u32 - 1
    }
}
