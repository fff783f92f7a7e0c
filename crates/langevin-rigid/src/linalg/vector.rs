//! Algebra of three-vectors, for programs around the run time.
//!
//! ```
//! use langevin_rigid::linalg::vector::{add, cross, norm, scale, sub};
//!
//! let corners = [[0.0, 0.0, 0.0], [3.0, 0.0, 0.0], [0.0, 4.0, 0.0]];
//! let [a, b, c] = corners;
//! let area = 0.5 * norm(cross(sub(b, a), sub(c, a)));
//! let centroid = scale(1.0 / 3.0, add(add(a, b), c));
//! assert_eq!((area, centroid[0]), (6.0, 1.0));
//! ```

use super::{Mat3, Vec3};

/// The sum `a + b`.
#[inline]
pub fn add(a: Vec3, b: Vec3) -> Vec3 {
    super::add(a, b)
}

/// The difference `a - b`.
#[inline]
pub fn sub(a: Vec3, b: Vec3) -> Vec3 {
    super::sub(a, b)
}

/// The multiple `s a`.
#[inline]
pub fn scale(s: f64, a: Vec3) -> Vec3 {
    super::scale(s, a)
}

/// The scalar product `a . b`, summed from the first component on.
#[inline]
pub fn dot(a: Vec3, b: Vec3) -> f64 {
    super::dot(a, b)
}

/// The vector product `a x b`, right-handed.
#[inline]
pub fn cross(a: Vec3, b: Vec3) -> Vec3 {
    super::cross(a, b)
}

/// The length of `a`; its square must not overflow.
#[inline]
pub fn norm(a: Vec3) -> f64 {
    super::norm(a)
}

/// The product `m a` of a matrix by rows and a vector.
#[inline]
pub fn mat_vec(m: &Mat3, a: Vec3) -> Vec3 {
    super::mat_vec(m, a)
}
