//! Checks of an inertia tensor given by hand.

use langevin_rigid::linalg::eigen_symmetric;

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
    let tolerance = TOLERANCE * largest(&m);
    for (row, column) in [(0, 1), (0, 2), (1, 2)] {
        let (upper, lower) = (m[row][column], m[column][row]);
        if (upper - lower).abs() > tolerance {
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

/// Eigenvalues of a symmetric 3×3 matrix, ascending.
///
/// ```
/// use langevin_rigid_bake::mass_properties::principal_moments;
///
/// let moments = principal_moments([[2.0, 1.0, 0.0], [1.0, 2.0, 0.0], [0.0, 0.0, 5.0]]);
/// for (got, expected) in moments.into_iter().zip([1.0, 3.0, 5.0]) {
///     assert!((got - expected).abs() < 1e-14);
/// }
/// ```
pub fn principal_moments(m: [[f64; 3]; 3]) -> [f64; 3] {
    // Squares of entries near the ends of the range overflow or vanish.
    let size = largest(&m).max(f64::MIN_POSITIVE);
    let (moments, _) = eigen_symmetric(&m.map(|row| row.map(|x| x / size)));
    moments.map(|x| x * size)
}

/// Size of the largest entry.
fn largest(m: &[[f64; 3]; 3]) -> f64 {
    m.as_flattened().iter().fold(0.0, |a, x| a.max(x.abs()))
}
