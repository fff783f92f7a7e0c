//! Checks of an inertia tensor given by hand.

use super::MassError;

/// Relative tolerance for symmetry and for the triangle inequality, which flat bodies meet with
/// equality.
const TOLERANCE: f64 = 1e-9;

/// An inertia tensor about a centre of mass (kg m²) made exactly symmetric, if a body can have it.
///
/// ```
/// use langevin_rigid_bake::mass_properties::check_inertia;
///
/// let disc = [[1.0, 0.0, 0.0], [0.0, 2.0, 0.0], [0.0, 0.0, 1.0]];
/// assert_eq!(check_inertia(disc)?, disc);
/// assert!(check_inertia([[1.0, 0.0, 0.0], [0.0, 3.0, 0.0], [0.0, 0.0, 1.0]]).is_err());
/// # Ok::<(), langevin_rigid_bake::mass_properties::MassError>(())
/// ```
///
/// # Errors
///
/// A [`MassError`] where the tensor is not finite, not symmetric to 1e-9 of its largest entry, not
/// positive definite, or has a principal moment above the sum of the other two, which no distribution of
/// mass has.
pub fn check_inertia(inertia: [[f64; 3]; 3]) -> Result<[[f64; 3]; 3], MassError> {
    if !inertia.as_flattened().iter().all(|x| x.is_finite()) {
        return Err(MassError::NotFinite {
            quantity: "inertia",
        });
    }
    let inertia = symmetrized(inertia)?;
    let moments = principal_moments(inertia);
    // Entries near the largest there are make moments that are not numbers.
    let positive = moments[0] > 0.0;
    if !positive {
        return Err(MassError::NotPositiveDefinite { moments });
    }
    if moments[2] > (moments[0] + moments[1]) * (1.0 + TOLERANCE) {
        return Err(MassError::TriangleInequality { moments });
    }
    Ok(inertia)
}

fn symmetrized(m: [[f64; 3]; 3]) -> Result<[[f64; 3]; 3], MassError> {
    let largest = m.as_flattened().iter().fold(0.0f64, |a, x| a.max(x.abs()));
    for (row, column) in [(0, 1), (0, 2), (1, 2)] {
        let (upper, lower) = (m[row][column], m[column][row]);
        if (upper - lower).abs() > TOLERANCE * largest {
            return Err(MassError::NotSymmetric {
                row,
                column,
                upper,
                lower,
            });
        }
    }
    Ok([0, 1, 2].map(|i| [0, 1, 2].map(|j| 0.5 * (m[i][j] + m[j][i]))))
}

/// Eigenvalues of a symmetric 3×3 matrix, ascending, by cyclic Jacobi rotations.
///
/// ```
/// use langevin_rigid_bake::mass_properties::principal_moments;
///
/// let moments = principal_moments([[2.0, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 0.0, 5.0]]);
/// for (got, expected) in moments.into_iter().zip([1.0, 3.0, 5.0]) {
///     assert!((got - expected).abs() < 1e-14);
/// }
/// ```
pub fn principal_moments(mut m: [[f64; 3]; 3]) -> [f64; 3] {
    // Convergence is quadratic: six sweeps reach rounding, ten are certain.
    for _ in 0..10 {
        for (p, q) in [(0, 1), (0, 2), (1, 2)] {
            rotate(&mut m, p, q);
        }
    }
    let mut moments = [m[0][0], m[1][1], m[2][2]];
    moments.sort_unstable_by(f64::total_cmp);
    moments
}

/// The Jacobi rotation that makes entry (p, q) zero (Golub & Van Loan, section 8.5).
fn rotate(m: &mut [[f64; 3]; 3], p: usize, q: usize) {
    if m[p][q] == 0.0 {
        return;
    }
    let theta = (m[q][q] - m[p][p]) / (2.0 * m[p][q]);
    let t = 1f64.copysign(theta) / (theta.abs() + libm::hypot(theta, 1.0));
    let cos = 1.0 / (1.0 + t * t).sqrt();
    let sin = t * cos;
    for k in 0..3 {
        let (a, b) = (m[k][p], m[k][q]);
        m[k][p] = cos * a - sin * b;
        m[k][q] = sin * a + cos * b;
    }
    for k in 0..3 {
        let (a, b) = (m[p][k], m[q][k]);
        m[p][k] = cos * a - sin * b;
        m[q][k] = sin * a + cos * b;
    }
}
