//! Preconditioned conjugate gradients for the six motions at once.

use super::AddedMassError;
use super::operator::Operator;
use super::operator::Six;
use super::precondition::Preconditioner;
use super::report::Cancel;

/// Relative residual to reach; the tensor's error is its square.
pub(super) const TOLERANCE: f64 = 1e-6;
const MAX_ITERATIONS: usize = 1000;
/// Iterations within which the residual must halve: the solve has stalled where it does not.
const PATIENCE: usize = 150;
/// A right-hand side smaller than this share of the largest is zero but for rounding.
const NEGLIGIBLE: f64 = 1e-6;

/// x of W x = f.
pub(super) struct Solution {
    pub(super) x: Vec<Six>,
    /// f - W x, evaluated anew.
    pub(super) residual: Vec<Six>,
    /// Largest relative residual of the six.
    pub(super) relative: f64,
    pub(super) iterations: usize,
}

impl Solution {
    /// f^t W^-1 f, the error of x entering squared.
    pub(super) fn energy(&self, f: &[Six]) -> [Six; 6] {
        // f.x + x.f - x.W x with W x = f - r is x.f + x.r.
        let mut energy = [[0.0; 6]; 6];
        for ((x, f), r) in self.x.iter().zip(f).zip(&self.residual) {
            for i in 0..6 {
                for j in 0..6 {
                    energy[i][j] += x[i] * (f[j] + r[j]);
                }
            }
        }
        std::array::from_fn(|i| std::array::from_fn(|j| 0.5 * (energy[i][j] + energy[j][i])))
    }
}

/// Solves from `start`; constants, which W maps to zero, are kept out of the residual.
pub(super) fn solve(
    w: &dyn Operator,
    f: &[Six],
    start: Vec<Six>,
    preconditioner: &Preconditioner,
    cancel: &Cancel,
) -> Result<Solution, AddedMassError> {
    let scale = scales(f);
    let mut x = start;
    let mut residual = residual(w, f, &x);
    let first = relative(&residual, &scale);
    let mut direction = vec![[0.0; 6]; f.len()];
    let mut previous = [f64::INFINITY; 6];
    let mut iterations = 0;
    let mut halved = (first, 0);
    while relative(&residual, &scale) > TOLERANCE && iterations < MAX_ITERATIONS {
        cancel.check()?;
        let worst = relative(&residual, &scale);
        if worst < 0.5 * halved.0 {
            halved = (worst, iterations);
        } else if iterations - halved.1 > PATIENCE {
            break;
        }
        cancel.report(libm::log(first / worst) / libm::log(first / TOLERANCE));
        let active: [bool; 6] = std::array::from_fn(|c| norm(&residual, c) > TOLERANCE * scale[c]);
        let z = preconditioner.apply(&residual);
        let rho = dots(&residual, &z);
        let beta: Six = std::array::from_fn(|c| if active[c] { rho[c] / previous[c] } else { 0.0 });
        update(&mut direction, &z, |c, p, z| z + beta[c] * p);
        let image = w.product(&direction);
        let curvature = dots(&direction, &image);
        let alpha = steps(&rho, &curvature, &active, iterations)?;
        update(&mut x, &direction, |c, x, p| x + alpha[c] * p);
        update(&mut residual, &image, |c, r, q| r - alpha[c] * q);
        without_mean(&mut residual);
        previous = std::array::from_fn(|c| if active[c] { rho[c] } else { f64::INFINITY });
        iterations += 1;
    }
    let residual = self::residual(w, f, &x);
    let relative = relative(&residual, &scale);
    Ok(Solution {
        x,
        residual,
        relative,
        iterations,
    })
}

/// Step lengths; a direction of no or negative energy means W is not what it must be.
fn steps(
    rho: &Six,
    curvature: &Six,
    active: &[bool; 6],
    iterations: usize,
) -> Result<Six, AddedMassError> {
    let mut alpha = [0.0; 6];
    for c in (0..6).filter(|&c| active[c]) {
        let usable = rho[c] > 0.0 && curvature[c] > 0.0 && (rho[c] / curvature[c]).is_finite();
        if !usable {
            return Err(AddedMassError::Singular {
                iteration: iterations,
                energy: curvature[c],
            });
        }
        alpha[c] = rho[c] / curvature[c];
    }
    Ok(alpha)
}

fn residual(w: &dyn Operator, f: &[Six], x: &[Six]) -> Vec<Six> {
    let mut residual = f.to_vec();
    update(&mut residual, &w.product(x), |_, f, wx| f - wx);
    without_mean(&mut residual);
    residual
}

/// Size of each right-hand side, none negligible.
fn scales(f: &[Six]) -> Six {
    let norms: Six = std::array::from_fn(|c| norm(f, c));
    let largest = norms.iter().fold(f64::MIN_POSITIVE, |a, &b| a.max(b));
    norms.map(|n| n.max(NEGLIGIBLE * largest))
}

fn relative(residual: &[Six], scale: &Six) -> f64 {
    (0..6).fold(0.0, |worst, c| {
        f64::max(worst, norm(residual, c) / scale[c])
    })
}

fn norm(v: &[Six], c: usize) -> f64 {
    v.iter().map(|v| v[c] * v[c]).sum::<f64>().sqrt()
}

fn dots(a: &[Six], b: &[Six]) -> Six {
    let mut sums = [0.0; 6];
    for (a, b) in a.iter().zip(b) {
        for c in 0..6 {
            sums[c] += a[c] * b[c];
        }
    }
    sums
}

fn update(a: &mut [Six], b: &[Six], f: impl Fn(usize, f64, f64) -> f64) {
    for (a, b) in a.iter_mut().zip(b) {
        for c in 0..6 {
            a[c] = f(c, a[c], b[c]);
        }
    }
}

fn without_mean(v: &mut [Six]) {
    let mut mean = [0.0; 6];
    for row in v.iter() {
        for c in 0..6 {
            mean[c] += row[c];
        }
    }
    let n = v.len() as f64;
    for row in v.iter_mut() {
        for c in 0..6 {
            row[c] -= mean[c] / n;
        }
    }
}
