//! The few operations on 3-vectors and 3 x 3 matrices that drawing needs.

pub(super) type Vec3 = [f64; 3];
/// Rows of a 3 x 3 matrix.
pub(super) type Mat3 = [Vec3; 3];

pub(super) fn add(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

pub(super) fn sub(a: Vec3, b: Vec3) -> Vec3 {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub(super) fn scale(s: f64, a: Vec3) -> Vec3 {
    [s * a[0], s * a[1], s * a[2]]
}

pub(super) fn dot(a: Vec3, b: Vec3) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

pub(super) fn cross(a: Vec3, b: Vec3) -> Vec3 {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

pub(super) fn norm(a: Vec3) -> f64 {
    dot(a, a).sqrt()
}

/// The unit vector along `a`, or zero where `a` has no direction.
pub(super) fn normalize(a: Vec3) -> Vec3 {
    let length = norm(a);
    if length > 0.0 {
        scale(1.0 / length, a)
    } else {
        [0.0; 3]
    }
}

pub(super) fn mul_vec(m: &Mat3, v: Vec3) -> Vec3 {
    [dot(m[0], v), dot(m[1], v), dot(m[2], v)]
}

pub(super) fn mul_mat(a: &Mat3, b: &Mat3) -> Mat3 {
    let column = |j: usize| [b[0][j], b[1][j], b[2][j]];
    let columns = [column(0), column(1), column(2)];
    a.map(|row| columns.map(|c| dot(row, c)))
}
