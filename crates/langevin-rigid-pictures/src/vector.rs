//! The run time's algebra of three-vectors, and what drawing needs besides.

pub(super) use langevin_rigid::linalg::vector::{add, cross, dot, mat_vec, norm, scale, sub};
pub(super) use langevin_rigid::linalg::{Mat3, Vec3};

/// The unit vector along `a`, or zero where `a` has no direction.
pub(super) fn normalize(a: Vec3) -> Vec3 {
    let length = norm(a);
    if length > 0.0 {
        scale(1.0 / length, a)
    } else {
        [0.0; 3]
    }
}

/// The product `a b`.
pub(super) fn mul_mat(a: &Mat3, b: &Mat3) -> Mat3 {
    let column = |j: usize| [b[0][j], b[1][j], b[2][j]];
    let columns = [column(0), column(1), column(2)];
    a.map(|row| columns.map(|c| dot(row, c)))
}

pub(super) fn transposed_mat_vec(m: &Mat3, a: Vec3) -> Vec3 {
    std::array::from_fn(|i| m[0][i] * a[0] + m[1][i] * a[1] + m[2][i] * a[2])
}
