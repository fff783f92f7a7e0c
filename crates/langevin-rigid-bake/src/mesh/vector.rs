//! The run time's algebra of three-vectors, and what geometry needs besides.

pub(crate) use langevin_rigid::linalg::vector::{add, cross, dot, mat_vec, norm, scale, sub};

/// The unit matrix.
pub(crate) const IDENTITY: [[f64; 3]; 3] = [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];

/// Unit vector along `a` (not a number where `a` is zero).
pub(crate) fn unit(a: [f64; 3]) -> [f64; 3] {
    scale(1.0 / norm(a), a)
}

/// The determinant.
pub(crate) fn det(m: &[[f64; 3]; 3]) -> f64 {
    dot(m[0], cross(m[1], m[2]))
}

/// Lowest and highest corner of the axis-aligned box about the points.
pub(crate) fn bounding_box(points: &[[f64; 3]]) -> [[f64; 3]; 2] {
    let mut bounds = [[f64::INFINITY; 3], [f64::NEG_INFINITY; 3]];
    for p in points {
        for k in 0..3 {
            bounds[0][k] = bounds[0][k].min(p[k]);
            bounds[1][k] = bounds[1][k].max(p[k]);
        }
    }
    bounds
}
