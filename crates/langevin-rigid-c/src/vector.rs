//! Vectors, orientations and matrices.

use langevin_rigid::linalg::{Mat3, Quat, Vec3};

/// A vector.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct lr_vec3 {
    /// Along x.
    pub x: f64,
    /// Along y.
    pub y: f64,
    /// Along z.
    pub z: f64,
}

/// An orientation: a unit quaternion that turns vectors of the body into vectors of the world. The scalar part is last.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct lr_quat {
    /// Sine of half the angle times the axis, along x.
    pub x: f64,
    /// The same along y.
    pub y: f64,
    /// The same along z.
    pub z: f64,
    /// Cosine of half the angle.
    pub w: f64,
}

/// A matrix, by rows.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct lr_mat3 {
    /// First row.
    pub x: lr_vec3,
    /// Second row.
    pub y: lr_vec3,
    /// Third row.
    pub z: lr_vec3,
}

impl From<Vec3> for lr_vec3 {
    fn from([x, y, z]: Vec3) -> Self {
        Self { x, y, z }
    }
}

impl From<lr_vec3> for Vec3 {
    fn from(v: lr_vec3) -> Self {
        [v.x, v.y, v.z]
    }
}

impl From<Quat> for lr_quat {
    fn from([x, y, z, w]: Quat) -> Self {
        Self { x, y, z, w }
    }
}

impl From<lr_quat> for Quat {
    fn from(q: lr_quat) -> Self {
        [q.x, q.y, q.z, q.w]
    }
}

impl From<Mat3> for lr_mat3 {
    fn from([x, y, z]: Mat3) -> Self {
        Self {
            x: x.into(),
            y: y.into(),
            z: z.into(),
        }
    }
}

impl From<lr_mat3> for Mat3 {
    fn from(m: lr_mat3) -> Self {
        [m.x.into(), m.y.into(), m.z.into()]
    }
}
