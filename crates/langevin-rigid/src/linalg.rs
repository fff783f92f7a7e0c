//! Small dense algebra on plain arrays: three-vectors, unit quaternions, 6x6 tensors.
//!
//! Every function is straight-line arithmetic in a fixed order, so results have the same bits on
//! every platform. Those on three-vectors also work in SIMD lanes here; [`vector`] has them in `f64`,
//! for other crates too.

pub mod vector;

use crate::elementary::half_angle;
use crate::real::Real;

/// A three-vector.
pub type Vec3<R = f64> = [R; 3];
/// A 3x3 matrix by rows.
pub type Mat3<R = f64> = [[R; 3]; 3];
/// A six-vector, linear part first.
pub type Vec6<R = f64> = [R; 6];
/// A 6x6 matrix by rows, linear part first.
pub type Mat6<R = f64> = [[R; 6]; 6];
/// A unit quaternion `[x, y, z, w]` that turns body vectors into world vectors.
pub type Quat<R = f64> = [R; 4];

#[inline(always)]
pub(crate) fn add<R: Real>(a: Vec3<R>, b: Vec3<R>) -> Vec3<R> {
    [a[0] + b[0], a[1] + b[1], a[2] + b[2]]
}

#[inline(always)]
pub(crate) fn sub<R: Real>(a: Vec3<R>, b: Vec3<R>) -> Vec3<R> {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

#[inline(always)]
pub(crate) fn scale<R: Real>(s: R, a: Vec3<R>) -> Vec3<R> {
    [s * a[0], s * a[1], s * a[2]]
}

/// `a + s b`.
#[inline(always)]
pub(crate) fn add_scaled<R: Real>(a: Vec3<R>, s: R, b: Vec3<R>) -> Vec3<R> {
    [a[0] + s * b[0], a[1] + s * b[1], a[2] + s * b[2]]
}

#[inline(always)]
pub(crate) fn dot<R: Real>(a: Vec3<R>, b: Vec3<R>) -> R {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

#[inline(always)]
pub(crate) fn norm<R: Real>(a: Vec3<R>) -> R {
    dot(a, a).sqrt()
}

#[inline(always)]
pub(crate) fn cross<R: Real>(a: Vec3<R>, b: Vec3<R>) -> Vec3<R> {
    [
        a[1] * b[2] - a[2] * b[1],
        a[2] * b[0] - a[0] * b[2],
        a[0] * b[1] - a[1] * b[0],
    ]
}

#[inline(always)]
pub(crate) fn mat_vec<R: Real>(m: &Mat3<R>, a: Vec3<R>) -> Vec3<R> {
    [dot(m[0], a), dot(m[1], a), dot(m[2], a)]
}

/// The transpose of `m` times `a`.
#[inline(always)]
pub(crate) fn transposed_mat_vec<R: Real>(m: &Mat3<R>, a: Vec3<R>) -> Vec3<R> {
    let column = |j: usize| m[0][j] * a[0] + m[1][j] * a[1] + m[2][j] * a[2];
    [column(0), column(1), column(2)]
}

/// The six-vector of a linear and an angular part.
#[inline(always)]
pub(crate) fn join<R: Real>(linear: Vec3<R>, angular: Vec3<R>) -> Vec6<R> {
    [
        linear[0], linear[1], linear[2], angular[0], angular[1], angular[2],
    ]
}

/// The linear and the angular part of a six-vector.
#[inline(always)]
pub(crate) fn split<R: Real>(a: &Vec6<R>) -> (Vec3<R>, Vec3<R>) {
    ([a[0], a[1], a[2]], [a[3], a[4], a[5]])
}

#[inline(always)]
pub(crate) fn mul<R: Real>(m: &Mat6<R>, a: &Vec6<R>) -> Vec6<R> {
    let row = |i: usize| dot6(&m[i], a);
    [row(0), row(1), row(2), row(3), row(4), row(5)]
}

#[inline(always)]
pub(crate) fn dot6<R: Real>(a: &Vec6<R>, b: &Vec6<R>) -> R {
    (a[0] * b[0] + a[1] * b[1] + a[2] * b[2]) + (a[3] * b[3] + a[4] * b[4] + a[5] * b[5])
}

pub(crate) fn transpose<const N: usize>(m: &[[f64; N]; N]) -> [[f64; N]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| m[j][i]))
}

pub(crate) fn product<const N: usize>(a: &[[f64; N]; N], b: &[[f64; N]; N]) -> [[f64; N]; N] {
    std::array::from_fn(|i| std::array::from_fn(|j| (0..N).map(|k| a[i][k] * b[k][j]).sum()))
}

/// The quaternion product `a b`: first the turn `b`, then `a`.
#[inline(always)]
pub(crate) fn quat_mul<R: Real>(a: Quat<R>, b: Quat<R>) -> Quat<R> {
    [
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
        a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
        a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
    ]
}

#[inline(always)]
pub(crate) fn quat_normalize<R: Real>(q: Quat<R>) -> Quat<R> {
    let size2 = q[0] * q[0] + q[1] * q[1] + q[2] * q[2] + q[3] * q[3];
    let s = size2.of(1.0) / size2.sqrt();
    [q[0] * s, q[1] * s, q[2] * s, q[3] * s]
}

/// The vector `a` of the body frame, in the world frame.
#[inline]
pub fn rotate(q: Quat, a: Vec3) -> Vec3 {
    let u = [q[0], q[1], q[2]];
    let t = scale(2.0, cross(u, a));
    add(add_scaled(a, q[3], t), cross(u, t))
}

/// The vector `a` of the world frame, in the body frame.
#[inline]
pub fn rotate_back(q: Quat, a: Vec3) -> Vec3 {
    rotate([-q[0], -q[1], -q[2], q[3]], a)
}

/// The matrix of a unit quaternion: its columns are the body's axes in the world.
pub fn rotation_matrix(q: Quat) -> Mat3 {
    matrix_of(q)
}

/// [`rotation_matrix`], in lanes.
#[inline(always)]
pub(crate) fn matrix_of<R: Real>([x, y, z, w]: Quat<R>) -> Mat3<R> {
    let one = x.of(1.0);
    let (x2, y2, z2) = (x + x, y + y, z + z);
    let (xx, yy, zz) = (x * x2, y * y2, z * z2);
    let (xy, xz, yz) = (x * y2, x * z2, y * z2);
    let (wx, wy, wz) = (w * x2, w * y2, w * z2);
    [
        [one - (yy + zz), xy - wz, xz + wy],
        [xy + wz, one - (xx + zz), yz - wx],
        [xz - wy, yz + wx, one - (xx + yy)],
    ]
}

/// The quaternion of a rotation vector (axis times angle, rad).
pub fn quat_from_rotation_vector(theta: Vec3) -> Quat {
    turn(theta)
}

/// [`quat_from_rotation_vector`], in lanes.
#[inline(always)]
pub(crate) fn turn<R: Real>(theta: Vec3<R>) -> Quat<R> {
    let (s, c) = half_angle(dot(theta, theta));
    [s * theta[0], s * theta[1], s * theta[2], c]
}

/// `f` of each index. Unlike the library's it is always inlined, with `f`, into code for the
/// processor at hand.
#[inline(always)]
pub(crate) fn each<R: Real, const N: usize>(like: R, f: impl Fn(usize) -> R) -> [R; N] {
    let mut a = [like; N];
    for i in 0..N {
        a[i] = f(i);
    }
    a
}

/// The numbers of a vector or matrix in the lanes of `like`.
pub(crate) fn lift<R: Real, const N: usize>(like: R, a: &[f64; N]) -> [R; N] {
    a.map(|x| like.of(x))
}

/// The same of a matrix.
pub(crate) fn lift_matrix<R: Real, const N: usize, const M: usize>(
    like: R,
    m: &[[f64; N]; M],
) -> [[R; N]; M] {
    m.map(|row| lift(like, &row))
}

/// Lower Cholesky factor of a symmetric positive definite matrix; `None` if it is not.
pub(crate) fn cholesky<const N: usize>(m: &[[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let mut l = [[0.0; N]; N];
    for j in 0..N {
        let pivot = m[j][j] - (0..j).map(|k| l[j][k] * l[j][k]).sum::<f64>();
        if !(pivot > 0.0 && pivot.is_finite()) {
            return None;
        }
        l[j][j] = pivot.sqrt();
        for i in j + 1..N {
            let dot: f64 = (0..j).map(|k| l[i][k] * l[j][k]).sum();
            l[i][j] = (m[i][j] - dot) / l[j][j];
        }
    }
    Some(l)
}

/// The solution x of `m x = b` for a symmetric positive definite matrix, by its factors L D L^T.
#[inline(always)]
pub(crate) fn solve_spd<R: Real>(m: &Mat6<R>, b: &Vec6<R>) -> Vec6<R> {
    // Below the diagonal L, on it 1 / D.
    let mut f = *m;
    for j in 0..6 {
        let mut pivot = m[j][j];
        for k in 0..j {
            // L_jk D_k was kept above the diagonal.
            pivot = pivot - f[j][k] * f[k][j];
        }
        f[j][j] = pivot.of(1.0) / pivot;
        for i in j + 1..6 {
            let mut entry = m[i][j];
            for k in 0..j {
                entry = entry - f[i][k] * f[k][j];
            }
            f[j][i] = entry;
            f[i][j] = entry * f[j][j];
        }
    }
    let mut x = *b;
    for i in 0..6 {
        for k in 0..i {
            x[i] = x[i] - f[i][k] * x[k];
        }
    }
    for i in (0..6).rev() {
        x[i] = x[i] * f[i][i];
        for k in i + 1..6 {
            x[i] = x[i] - f[k][i] * x[k];
        }
    }
    x
}

/// Inverse of a lower triangular matrix.
fn invert_lower<const N: usize>(l: &[[f64; N]; N]) -> [[f64; N]; N] {
    let mut inverse = [[0.0; N]; N];
    for j in 0..N {
        inverse[j][j] = 1.0 / l[j][j];
        for i in j + 1..N {
            let dot: f64 = (j..i).map(|k| l[i][k] * inverse[k][j]).sum();
            inverse[i][j] = -dot / l[i][i];
        }
    }
    inverse
}

/// Inverse of a symmetric positive definite matrix; `None` if it is not.
pub fn invert_spd<const N: usize>(m: &[[f64; N]; N]) -> Option<[[f64; N]; N]> {
    let inverse = invert_lower(&cholesky(m)?);
    Some(product(&transpose(&inverse), &inverse))
}

/// Eigenvalues (ascending) and orthonormal eigenvectors (columns) of a symmetric matrix, by cyclic
/// Jacobi rotations.
pub fn eigen_symmetric<const N: usize>(m: &[[f64; N]; N]) -> ([f64; N], [[f64; N]; N]) {
    let mut a = *m;
    let mut v: [[f64; N]; N] = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(i == j)));
    let scale: f64 = a.iter().flatten().map(|x| x * x).sum::<f64>();
    for _sweep in 0..32 {
        let off: f64 = (0..N)
            .map(|i| (0..i).map(|j| a[i][j] * a[i][j]).sum::<f64>())
            .sum();
        if off <= 1e-32 * scale {
            break;
        }
        for p in 0..N {
            for q in p + 1..N {
                jacobi_rotate(&mut a, &mut v, p, q);
            }
        }
    }
    let mut order: [usize; N] = std::array::from_fn(|i| i);
    order.sort_by(|&i, &j| a[i][i].total_cmp(&a[j][j]));
    (
        order.map(|i| a[i][i]),
        std::array::from_fn(|i| std::array::from_fn(|j| v[i][order[j]])),
    )
}

/// One Jacobi rotation that annihilates `a[p][q]`.
fn jacobi_rotate<const N: usize>(a: &mut [[f64; N]; N], v: &mut [[f64; N]; N], p: usize, q: usize) {
    if a[p][q].abs() <= 1e-17 * (a[p][p].abs() + a[q][q].abs()) {
        return;
    }
    let tau = (a[q][q] - a[p][p]) / (2.0 * a[p][q]);
    let t = tau.signum() / (tau.abs() + (1.0 + tau * tau).sqrt());
    let c = 1.0 / (1.0 + t * t).sqrt();
    let s = t * c;
    for k in 0..N {
        let (x, y) = (a[k][p], a[k][q]);
        a[k][p] = c * x - s * y;
        a[k][q] = s * x + c * y;
    }
    for k in 0..N {
        let (x, y) = (a[p][k], a[q][k]);
        a[p][k] = c * x - s * y;
        a[q][k] = s * x + c * y;
    }
    for row in v.iter_mut() {
        let (x, y) = (row[p], row[q]);
        row[p] = c * x - s * y;
        row[q] = s * x + c * y;
    }
}

/// Solves `A V = T V diag(lambda)` with `V^T T V = 1` for symmetric `A` and positive definite `T`.
///
/// Returns the eigenvalues (ascending) and `V`; `None` if `T` is not positive definite.
pub(crate) fn eigen_generalized<const N: usize>(
    a: &[[f64; N]; N],
    t: &[[f64; N]; N],
) -> Option<([f64; N], [[f64; N]; N])> {
    let l_inverse = invert_lower(&cholesky(t)?);
    let reduced = product(&product(&l_inverse, a), &transpose(&l_inverse));
    let symmetric: [[f64; N]; N] =
        std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (reduced[i][j] + reduced[j][i])));
    let (lambda, u) = eigen_symmetric(&symmetric);
    Some((lambda, product(&transpose(&l_inverse), &u)))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spd() -> Mat6 {
        let b: Mat6 = std::array::from_fn(|i| {
            std::array::from_fn(|j| libm::sin((3 * i + 7 * j + 1) as f64) + f64::from(i == j) * 3.0)
        });
        product(&transpose(&b), &b)
    }

    #[test]
    fn inverse_times_matrix_is_one() {
        let m = spd();
        let one = product(&invert_spd(&m).unwrap(), &m);
        for i in 0..6 {
            for j in 0..6 {
                assert!((one[i][j] - f64::from(i == j)).abs() < 1e-12);
            }
        }
    }

    #[test]
    fn a_solved_system_gives_its_right_side() {
        let (m, b) = (spd(), [1.0, -2.0, 3.0, 0.5, -1.0, 4.0]);
        let back = mul(&m, &solve_spd(&m, &b));
        for i in 0..6 {
            assert!((back[i] - b[i]).abs() < 1e-12);
        }
    }

    #[test]
    fn generalized_eigenvectors_diagonalize_both() {
        let t = spd();
        let a: Mat6 = std::array::from_fn(|i| std::array::from_fn(|j| t[5 - i][5 - j]));
        let (lambda, v) = eigen_generalized(&a, &t).unwrap();
        let vt = transpose(&v);
        let (tv, av) = (
            product(&product(&vt, &t), &v),
            product(&product(&vt, &a), &v),
        );
        for i in 0..6 {
            for j in 0..6 {
                assert!((tv[i][j] - f64::from(i == j)).abs() < 1e-12);
                assert!((av[i][j] - f64::from(i == j) * lambda[i]).abs() < 1e-12 * lambda[5]);
            }
        }
    }

    #[test]
    fn not_positive_definite_is_none() {
        assert!(cholesky(&[[1.0, 2.0], [2.0, 1.0]]).is_none());
        assert!(cholesky(&[[f64::NAN]]).is_none());
    }

    #[test]
    fn rotation_vector_series_meets_the_closed_form() {
        for angle in [0.0, 1e-9, 0.3, 0.999, 1.001, 3.0] {
            let q = quat_from_rotation_vector([0.0, angle, 0.0]);
            assert!((q[1] - libm::sin(angle / 2.0)).abs() < 1e-15);
            assert!((q[3] - libm::cos(angle / 2.0)).abs() < 1e-15);
        }
    }

    #[test]
    fn rotate_turns_x_about_y_into_minus_z() {
        let q = quat_from_rotation_vector([0.0, std::f64::consts::FRAC_PI_2, 0.0]);
        let r = rotate(q, [1.0, 0.0, 0.0]);
        assert!((r[2] + 1.0).abs() < 1e-15 && r[0].abs() < 1e-15);
        let by_matrix = mat_vec(&rotation_matrix(q), [1.0, 0.0, 0.0]);
        assert!(norm(sub(by_matrix, r)) < 1e-15);
        let back = rotate_back(q, r);
        assert!((back[0] - 1.0).abs() < 1e-15);
    }
}
