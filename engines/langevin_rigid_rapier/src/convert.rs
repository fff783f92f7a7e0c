//! Between Rapier's single precision and our double.

use rapier3d::prelude::{Matrix, Pose, Rotation, Vector};

pub(crate) fn vector(a: [f64; 3]) -> Vector {
    Vector::new(a[0] as f32, a[1] as f32, a[2] as f32)
}

pub(crate) fn array(a: Vector) -> [f64; 3] {
    [f64::from(a.x), f64::from(a.y), f64::from(a.z)]
}

pub(crate) fn rotation(q: [f64; 4]) -> Rotation {
    Rotation::from_xyzw(q[0] as f32, q[1] as f32, q[2] as f32, q[3] as f32)
}

/// Of unit length in double precision.
pub(crate) fn quaternion(q: Rotation) -> [f64; 4] {
    let q = [q.x, q.y, q.z, q.w].map(f64::from);
    let norm = q.iter().map(|x| x * x).sum::<f64>().sqrt();
    q.map(|x| x / norm)
}

pub(crate) fn matrix(m: &[[f64; 3]; 3]) -> Matrix {
    let column = |j: usize| vector([m[0][j], m[1][j], m[2][j]]);
    Matrix::from_cols(column(0), column(1), column(2))
}

/// Where the frame of a body is whose centre of mass, `arm` from that frame's origin, is at `centre`.
pub(crate) fn pose(centre: [f64; 3], orientation: [f64; 4], arm: [f64; 3]) -> Pose {
    let offset = langevin_rigid::linalg::rotate(orientation, arm);
    let origin = [0, 1, 2].map(|i| centre[i] - offset[i]);
    Pose::from_parts(vector(origin), rotation(orientation))
}
