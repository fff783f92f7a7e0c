//! The modes of the Langevin loads, in which their linear process comes apart.
//!
//! T^-1 A has the eigenvalues lambda and the eigenbasis V with V^T T V = 1; with q = V^-1 xi each mode
//! relaxes at alpha lambda_i. A body with diagonal tensors has its axes as modes.

use crate::elementary::{SMALL_EXPONENT, polynomial, small_expm1};
use crate::linalg::{Mat6, Vec3, Vec6, dot6, each, lift, lift_matrix, mul, transpose};
use crate::real::Real;

pub(crate) trait Modes<R: Real> {
    /// lambda.
    fn eigenvalues(&self) -> &Vec6<R>;
    /// The largest of them.
    fn fastest(&self) -> R;
    /// q of the velocity xi.
    fn of_velocity(&self, xi: &Vec6<R>) -> Vec6<R>;
    /// q of the momenta T xi.
    fn of_momentum(&self, momentum: &Vec6<R>) -> Vec6<R>;
    fn velocity(&self, modes: &Vec6<R>) -> Vec6<R>;
    /// The linear part of the velocity.
    fn linear(&self, modes: &Vec6<R>) -> Vec3<R>;
    fn momentum(&self, modes: &Vec6<R>) -> Vec6<R>;
    /// xi . A xi: the power of the relaxation at alpha = 1.
    fn relaxed(&self, modes: &Vec6<R>) -> R;
    /// Noise of the modes after a time h at beta^2 h = 1, with s = alpha h, where s lambda is at most
    /// [`SMALL_EXPONENT`].
    fn small_noise(&self, s: R, normals: &[R; 6]) -> Vec6<R>;
    /// The same for any s > 0; `decay` is exp(-s lambda) - 1.
    fn noise(&self, s: R, decay: &Vec6<R>, normals: &[R; 6]) -> Vec6<R>;
}

/// The modes of any body.
#[derive(Debug, Clone)]
pub(crate) struct Eigenmodes<R = f64> {
    /// lambda, ascending, in [0, 1).
    eigenvalues: Vec6<R>,
    /// V and its transpose.
    from_modes: Mat6<R>,
    from_momentum: Mat6<R>,
    /// T V and its transpose, V^-1.
    to_momentum: Mat6<R>,
    to_modes: Mat6<R>,
    factor: NoiseFactor<R>,
}

impl Eigenmodes {
    /// From V and V^-1; `noise` is the diagonal of B at beta = 1.
    pub(crate) fn new(eigenvalues: Vec6, from_modes: Mat6, to_modes: Mat6, noise: &Vec6) -> Self {
        Self {
            eigenvalues,
            from_momentum: transpose(&from_modes),
            from_modes,
            to_momentum: transpose(&to_modes),
            factor: NoiseFactor::new(&eigenvalues, &mul_columns(&to_modes, noise)),
            to_modes,
        }
    }

    /// V.
    #[cfg(test)]
    pub(crate) fn basis(&self) -> &Mat6 {
        &self.from_modes
    }

    /// Covariance of the modes that the noise keeps up at beta^2 = alpha.
    #[cfg(test)]
    pub(crate) fn stationary(&self) -> &Mat6 {
        &self.factor.covariance
    }

    /// The same in the lanes of `like`.
    pub(crate) fn lift<R: Real>(&self, like: R) -> Eigenmodes<R> {
        Eigenmodes {
            eigenvalues: lift(like, &self.eigenvalues),
            from_modes: lift_matrix(like, &self.from_modes),
            from_momentum: lift_matrix(like, &self.from_momentum),
            to_momentum: lift_matrix(like, &self.to_momentum),
            to_modes: lift_matrix(like, &self.to_modes),
            factor: NoiseFactor {
                covariance: lift_matrix(like, &self.factor.covariance),
                reach: like.of(self.factor.reach),
                series: lift_matrix(like, &self.factor.series),
            },
        }
    }
}

impl<R: Real> Modes<R> for Eigenmodes<R> {
    #[inline(always)]
    fn eigenvalues(&self) -> &Vec6<R> {
        &self.eigenvalues
    }
    #[inline(always)]
    fn fastest(&self) -> R {
        self.eigenvalues[5]
    }
    #[inline(always)]
    fn of_velocity(&self, xi: &Vec6<R>) -> Vec6<R> {
        mul(&self.to_modes, xi)
    }
    #[inline(always)]
    fn of_momentum(&self, momentum: &Vec6<R>) -> Vec6<R> {
        mul(&self.from_momentum, momentum)
    }
    #[inline(always)]
    fn velocity(&self, modes: &Vec6<R>) -> Vec6<R> {
        mul(&self.from_modes, modes)
    }
    #[inline(always)]
    fn linear(&self, modes: &Vec6<R>) -> Vec3<R> {
        let [x, y, z, ..] = &self.from_modes;
        [dot6(x, modes), dot6(y, modes), dot6(z, modes)]
    }
    #[inline(always)]
    fn momentum(&self, modes: &Vec6<R>) -> Vec6<R> {
        mul(&self.to_momentum, modes)
    }
    #[inline(always)]
    fn relaxed(&self, modes: &Vec6<R>) -> R {
        let relaxing = each(
            modes[0],
            #[inline(always)]
            |i| self.eigenvalues[i] * modes[i],
        );
        dot6(modes, &relaxing)
    }
    #[inline(always)]
    fn small_noise(&self, s: R, normals: &[R; 6]) -> Vec6<R> {
        self.factor.small(s, normals)
    }
    #[inline(always)]
    fn noise(&self, s: R, decay: &Vec6<R>, normals: &[R; 6]) -> Vec6<R> {
        self.factor.large(s, decay, normals)
    }
}

/// The axes of a symmetric body: the velocities are the modes.
#[derive(Debug, Clone)]
pub(crate) struct Axes<R = f64> {
    /// lambda = A / T.
    eigenvalues: Vec6<R>,
    fastest: R,
    /// T and its inverse.
    total: Vec6<R>,
    inverse: Vec6<R>,
    /// T^-1 A B at beta = 1.
    kick: Vec6<R>,
}

impl<R: Real> Axes<R> {
    /// From the diagonals of A, T and T^-1 A B.
    pub(crate) fn new(like: R, added: &Vec6, total: &Vec6, kick: &Vec6) -> Self {
        let lambda: Vec6 = std::array::from_fn(|i| added[i] / total[i]);
        Self {
            eigenvalues: lift(like, &lambda),
            fastest: like.of(lambda.into_iter().fold(0.0, f64::max)),
            total: lift(like, total),
            inverse: lift(like, &total.map(|t| 1.0 / t)),
            kick: lift(like, kick),
        }
    }
}

impl<R: Real> Modes<R> for Axes<R> {
    #[inline(always)]
    fn eigenvalues(&self) -> &Vec6<R> {
        &self.eigenvalues
    }
    #[inline(always)]
    fn fastest(&self) -> R {
        self.fastest
    }
    #[inline(always)]
    fn of_velocity(&self, xi: &Vec6<R>) -> Vec6<R> {
        *xi
    }
    #[inline(always)]
    fn of_momentum(&self, momentum: &Vec6<R>) -> Vec6<R> {
        each(
            momentum[0],
            #[inline(always)]
            |i| self.inverse[i] * momentum[i],
        )
    }
    #[inline(always)]
    fn velocity(&self, modes: &Vec6<R>) -> Vec6<R> {
        *modes
    }
    #[inline(always)]
    fn linear(&self, modes: &Vec6<R>) -> Vec3<R> {
        [modes[0], modes[1], modes[2]]
    }
    #[inline(always)]
    fn momentum(&self, modes: &Vec6<R>) -> Vec6<R> {
        each(
            modes[0],
            #[inline(always)]
            |i| self.total[i] * modes[i],
        )
    }
    #[inline(always)]
    fn relaxed(&self, modes: &Vec6<R>) -> R {
        let relaxing = each(
            modes[0],
            #[inline(always)]
            |i| self.eigenvalues[i] * modes[i],
        );
        dot6(&self.momentum(modes), &relaxing)
    }
    #[inline(always)]
    fn small_noise(&self, s: R, normals: &[R; 6]) -> Vec6<R> {
        each(
            s,
            #[inline(always)]
            |i| self.kick[i] * polynomial(s * self.eigenvalues[i], &LASTING) * normals[i],
        )
    }
    #[inline(always)]
    fn noise(&self, s: R, decay: &Vec6<R>, normals: &[R; 6]) -> Vec6<R> {
        each(
            s,
            #[inline(always)]
            |i| {
                let (two, x) = (s.of(2.0), s * self.eigenvalues[i]);
                let lasting = (-(decay[i] * (two + decay[i])) / (two * x)).sqrt();
                let noise = R::choose(s.of(0.0).less(x), lasting, s.of(1.0));
                self.kick[i] * noise * normals[i]
            },
        )
    }
}

/// sqrt((1 - e^(-2 x)) / (2 x)) in powers of x, to 3e-12 up to [`SMALL_EXPONENT`]: what the relaxation
/// leaves of the noise. Interpolated at Chebyshev's nodes.
const LASTING: [f64; 6] = [
    1.0,
    -0.499_999_999_979_196_3,
    0.208_333_325_008_503_1,
    -0.062_499_466_082_255_914,
    0.013_703_261_998_889_943,
    -0.002_232_743_285_038_577_5,
];

/// Cholesky factor of the noise covariance of the modes after a time h, at beta^2 h = 1.
///
/// The covariance is lambda_i lambda_j C_ij (1 - exp(-s (lambda_i + lambda_j))) / (s (lambda_i + lambda_j))
/// with C = V^T T B B^T T V at beta = 1 and s = alpha h. Modes without added mass have no noise.
#[derive(Debug, Clone)]
struct NoiseFactor<R = f64> {
    /// lambda_i lambda_j C_ij / (lambda_i + lambda_j).
    covariance: Mat6<R>,
    /// From s to [-1, 1] over the small exponents.
    reach: R,
    /// The lower triangle of the factor, by rows, in powers of that.
    series: [[R; TERMS]; 21],
}

/// Terms of the factor's series: its error, relative to the diagonal, is under 1e-12.
const TERMS: usize = 7;

impl NoiseFactor {
    /// `noise` is V^T T B at beta = 1.
    fn new(eigenvalues: &Vec6, noise: &Mat6) -> Self {
        let covariance = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let (li, lj) = (eigenvalues[i], eigenvalues[j]);
                let c = dot6(&noise[i], &noise[j]);
                if li * lj > 0.0 {
                    li * lj * c / (li + lj)
                } else {
                    0.0
                }
            })
        });
        let fastest = eigenvalues[5].max(f64::MIN_POSITIVE);
        let mut factor = Self {
            covariance,
            reach: 2.0 * fastest / SMALL_EXPONENT,
            series: [[0.0; TERMS]; 21],
        };
        // Interpolation at Chebyshev's nodes.
        let nodes: [f64; TERMS] = std::array::from_fn(|k| {
            libm::cos(std::f64::consts::PI * (k as f64 + 0.5) / TERMS as f64)
        });
        let values = nodes.map(|t| {
            let s = (t + 1.0) / factor.reach;
            let decay = eigenvalues.map(|l| small_expm1(-(s * l)));
            factor.cholesky(s, &decay)
        });
        for (entry, (i, j)) in lower().enumerate() {
            factor.series[entry] = interpolate(&nodes, &values.map(|v| v[i][j]));
        }
        factor
    }
}

impl<R: Real> NoiseFactor<R> {
    /// The factor times `normals` where s lambda is at most [`SMALL_EXPONENT`].
    #[inline(always)]
    fn small(&self, s: R, normals: &[R; 6]) -> Vec6<R> {
        let t = s * self.reach - s.of(1.0);
        let mut noise = [s.of(0.0); 6];
        for i in 0..6 {
            for j in 0..=i {
                let c = &self.series[i * (i + 1) / 2 + j];
                let mut factor = c[TERMS - 1];
                for k in (0..TERMS - 1).rev() {
                    factor = factor * t + c[k];
                }
                noise[i] = noise[i] + factor * normals[j];
            }
        }
        noise
    }

    /// The same for any s > 0; `decay` is exp(-s lambda) - 1.
    #[inline(always)]
    fn large(&self, s: R, decay: &Vec6<R>, normals: &[R; 6]) -> Vec6<R> {
        let factor = self.cholesky(s, decay);
        let mut noise = [s.of(0.0); 6];
        for (i, j) in lower() {
            noise[i] = noise[i] + factor[i][j] * normals[j];
        }
        noise
    }

    #[inline(always)]
    fn cholesky(&self, s: R, decay: &Vec6<R>) -> Mat6<R> {
        let zero = s.of(0.0);
        let mut factor = [[zero; 6]; 6];
        for j in 0..6 {
            let own = self.variance(s, decay, j, j);
            for i in j..6 {
                let known = (0..j).fold(zero, |sum, k| sum + factor[i][k] * factor[j][k]);
                factor[i][j] = self.variance(s, decay, i, j) - known;
            }
            let pivot = factor[j][j];
            // A zero mode, or what rounding leaves of a singular covariance.
            let regular = (own * s.of(R::NEGLIGIBLE)).less(pivot);
            let inverse = R::choose(regular, s.of(1.0) / pivot.sqrt(), zero);
            for row in &mut factor[j..] {
                row[j] = row[j] * inverse;
            }
        }
        factor
    }

    #[inline(always)]
    fn variance(&self, s: R, decay: &Vec6<R>, i: usize, j: usize) -> R {
        let lost = -(decay[i] + decay[j] + decay[i] * decay[j]);
        self.covariance[i][j] * lost / s
    }
}

/// Rows and columns of a lower triangle, by rows.
#[inline(always)]
fn lower() -> impl Iterator<Item = (usize, usize)> {
    (0..6).flat_map(|i| (0..=i).map(move |j| (i, j)))
}

/// Coefficients, by rising powers, of the polynomial through `values` at `nodes`.
fn interpolate(nodes: &[f64; TERMS], values: &[f64; TERMS]) -> [f64; TERMS] {
    let mut divided = *values;
    for order in 1..TERMS {
        for k in (order..TERMS).rev() {
            divided[k] = (divided[k] - divided[k - 1]) / (nodes[k] - nodes[k - order]);
        }
    }
    // Newton's form multiplied out from its innermost factor.
    let mut sum = [0.0; TERMS];
    for k in (0..TERMS).rev() {
        for power in (0..TERMS).rev() {
            let below = if power > 0 { sum[power - 1] } else { 0.0 };
            sum[power] = below - nodes[k] * sum[power];
        }
        sum[0] += divided[k];
    }
    sum
}

/// The columns of `m` times the entries of `s`.
pub(crate) fn mul_columns(m: &Mat6, s: &Vec6) -> Mat6 {
    std::array::from_fn(|i| std::array::from_fn(|j| m[i][j] * s[j]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::{eigen_generalized, norm, product};

    const NORMALS: [f64; 6] = [0.3, -1.2, 0.7, 2.0, -0.4, 1.1];

    fn spd(seed: usize) -> Mat6 {
        let b: Mat6 = std::array::from_fn(|i| {
            std::array::from_fn(|j| libm::sin((7 * i + 3 * j + seed) as f64) + f64::from(i == j))
        });
        product(&transpose(&b), &b)
    }

    /// The noise by the series against that in closed form.
    fn compare(modes: &impl Modes<f64>, bound: f64) {
        for share in [1e-6, 0.1, 0.37, 0.5, 0.9, 1.0] {
            let s = share * SMALL_EXPONENT / modes.fastest();
            let decay = modes.eigenvalues().map(|l| libm::expm1(-s * l));
            let series = modes.small_noise(s, &NORMALS);
            let direct = modes.noise(s, &decay, &NORMALS);
            let size = norm([direct[3], direct[4], direct[5]]);
            for i in 0..6 {
                let error = (series[i] - direct[i]).abs() / size;
                assert!(error < bound, "{share}, {i}: {error:e}");
            }
        }
    }

    #[test]
    fn the_series_of_the_noise_are_good_to_their_bound() {
        let (added, body) = (spd(1), spd(2));
        let total = std::array::from_fn(|i| std::array::from_fn(|j| added[i][j] + body[i][j]));
        let (lambda, v) = eigen_generalized(&added, &total).unwrap();
        let to_modes = product(&transpose(&v), &total);
        let noise = [1.0, 1.0, 1.0, 2.0, 2.0, 2.0];
        compare(&Eigenmodes::new(lambda, v, to_modes, &noise), 1e-12);
        let added = [0.1, 0.5, 2.0, 0.0, 1.0, 3.0];
        let axes = Axes::new(1.0, &added, &added.map(|a| a + 1.0), &[0.5; 6]);
        compare(&axes, 3e-12);
    }

    #[test]
    fn axes_are_the_modes_of_a_diagonal_tensor() {
        let added = [0.1, 0.5, 2.0, 0.2, 1.0, 3.0];
        let noise = [1.0, 1.0, 1.0, 2.0, 2.0, 2.0];
        let diagonal = |d: &Vec6| -> Mat6 {
            std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
        };
        let total = added.map(|a| a + 1.0);
        let (lambda, v) = eigen_generalized(&diagonal(&added), &diagonal(&total)).unwrap();
        let to_modes = product(&transpose(&v), &diagonal(&total));
        let general = Eigenmodes::new(lambda, v, to_modes, &noise);
        let kick = std::array::from_fn(|i| added[i] / total[i] * noise[i]);
        let axes = Axes::new(1.0, &added, &total, &kick);
        // The variance of each velocity after s, which does not depend on how modes are numbered.
        let variance = |modes: &dyn Modes<f64>, i: usize| -> f64 {
            let unit = |k: usize| std::array::from_fn(|j| f64::from(j == k));
            let noise = |k| modes.velocity(&modes.small_noise(0.1, &unit(k)))[i];
            (0..6).map(|k| noise(k) * noise(k)).sum()
        };
        for i in 0..6 {
            let ratio = variance(&axes, i) / variance(&general, i);
            assert!((ratio - 1.0).abs() < 1e-11, "{i}: {ratio}");
        }
    }
}
