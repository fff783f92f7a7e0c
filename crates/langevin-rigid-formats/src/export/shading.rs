//! How a surface is shown: its colour, and normals that are smooth where it bends and sharp at its edges.

use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::{add, cross, dot, norm, sub};

/// Colour of bodies, linear: that of dry leaves.
pub(super) const COLOUR: [f64; 3] = [0.55, 0.42, 0.16];

/// Cosine of the largest angle between facets that are shaded as one surface: 30 degrees.
const SMOOTH: f64 = 0.866_025_403_784_438_6;

/// The unit normal at each corner of each triangle: the mean of the facets around the vertex that bend away
/// from this one by less than 30 degrees, weighted by area.
pub(super) fn corner_normals(vertices: &[Vec3], triangles: &[[u32; 3]]) -> Vec<[Vec3; 3]> {
    let areas: Vec<Vec3> = triangles.iter().map(|t| area(vertices, t)).collect();
    let around = around(vertices.len(), triangles);
    triangles
        .iter()
        .zip(&areas)
        .map(|(corners, own)| {
            corners.map(|v| {
                let near = around[v as usize].iter().map(|&t| areas[t as usize]);
                let alike = near.filter(|other| cosine(*own, *other) > SMOOTH);
                unit(alike.fold([0.0; 3], add)).unwrap_or([0.0, 1.0, 0.0])
            })
        })
        .collect()
}

/// The triangles at each vertex.
fn around(vertices: usize, triangles: &[[u32; 3]]) -> Vec<Vec<u32>> {
    let mut around = vec![Vec::new(); vertices];
    for (number, corners) in (0u32..).zip(triangles) {
        for &v in corners {
            around[v as usize].push(number);
        }
    }
    around
}

/// Twice the area times the normal.
fn area(vertices: &[Vec3], corners: &[u32; 3]) -> Vec3 {
    let [a, b, c] = corners.map(|v| vertices[v as usize]);
    cross(sub(b, a), sub(c, a))
}

fn cosine(a: Vec3, b: Vec3) -> f64 {
    dot(a, b) / (dot(a, a) * dot(b, b)).sqrt()
}

fn unit(a: Vec3) -> Option<Vec3> {
    let length = norm(a);
    (length > 0.0).then(|| a.map(|x| x / length))
}

#[cfg(test)]
mod tests {
    use langevin_rigid_bake::shapes::Shape;

    use super::*;

    #[test]
    fn a_box_is_flat_and_a_ball_is_round() {
        let brick = Shape::Box {
            size: [1.0, 2.0, 3.0],
        };
        let brick = brick.mesh(48).unwrap();
        for normal in corner_normals(brick.vertices(), brick.triangles()).as_flattened() {
            let largest = normal.iter().fold(0.0f64, |l, x| l.max(x.abs()));
            assert!((largest - 1.0).abs() < 1e-12, "{normal:?}");
        }
        let ball = Shape::Ellipsoid {
            semi_axes: [1.0; 3],
        };
        let ball = ball.mesh(1280).unwrap();
        let normals = corner_normals(ball.vertices(), ball.triangles());
        for (corners, normals) in ball.triangles().iter().zip(&normals) {
            for (v, normal) in corners.iter().zip(normals) {
                assert!(cosine(*normal, ball.vertices()[*v as usize]) > 0.9999);
            }
        }
    }
}
