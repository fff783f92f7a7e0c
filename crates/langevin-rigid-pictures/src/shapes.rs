//! Shapes for the tests of the picture.

use crate::vector::{Mat3, Vec3, dot, scale, sub};

/// A closed box with the given edge lengths, about the origin.
pub(super) fn plate(size: Vec3) -> (Vec<Vec3>, Vec<[u32; 3]>) {
    let vertices = (0..8)
        .map(|i| std::array::from_fn(|a| if i >> a & 1 == 1 { 0.5 } else { -0.5 } * size[a]))
        .collect();
    let quads = [
        [0, 4, 6, 2],
        [1, 3, 7, 5],
        [0, 1, 5, 4],
        [2, 6, 7, 3],
        [0, 2, 3, 1],
        [4, 5, 7, 6],
    ];
    let triangles = quads
        .iter()
        .flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]])
        .collect();
    (vertices, triangles)
}

/// The points after a half turn about a unit vector.
pub(super) fn turned(points: &[Vec3], about: Vec3) -> Vec<Vec3> {
    let half_turn: Mat3 = std::array::from_fn(|i| {
        let e = std::array::from_fn(|j| if i == j { 1.0 } else { 0.0 });
        sub(scale(2.0 * about[i], about), e)
    });
    points
        .iter()
        .map(|p| half_turn.map(|row| dot(row, *p)))
        .collect()
}
