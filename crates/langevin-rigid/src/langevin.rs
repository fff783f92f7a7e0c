//! The generalized Langevin loads, acting through the added mass.
//!
//! The fluid that carries the turbulence is the fluid that the body sets in motion, so the Langevin
//! acceleration of Eqs. (7) and (9) acts on the added-mass tensor A:
//!
//! ```text
//! T dxi = A (-alpha xi dt + B dW),    B = diag(beta, beta, beta, beta/L, beta/L, beta/L)
//! ```
//!
//! with xi relative to the fluid. T^-1 A has six eigenvalues in [0, 1) and an eigenbasis V with
//! V^T T V = 1; in q = V^-1 xi this is a linear Ornstein-Uhlenbeck process, solved exactly.

use crate::linalg::{Mat6, Vec6, dot, eigen_generalized, mul, norm, product, split, transpose};
use crate::turbulence::{LangevinCoefficients, PreparedSource};

/// The Langevin part of a body's equations of motion.
#[derive(Debug, Clone)]
pub(crate) struct Langevin {
    pub(crate) source: PreparedSource,
    /// A (kg, kg m, kg m^2).
    added: Mat6,
    /// 1 / L^2 on the angular entries: B B^T at beta = 1.
    diffusion: Vec6,
    /// T^-1 A.
    fraction: Mat6,
    /// lambda, ascending, in [0, 1).
    eigenvalues: Vec6,
    /// V^-1 = V^T T.
    to_modes: Mat6,
    /// V.
    from_modes: Mat6,
    /// lambda_i lambda_j C_ij, C = V^T T B B^T T V at beta = 1.
    covariance: Mat6,
}

/// Share of the speed that may relax, and angle (radians) that the body may turn by, in a step.
const MOST_RELAXATION: f64 = 0.25;
const MOST_TURN: f64 = 1.0;

impl Langevin {
    /// `None` if the total tensor is not positive definite.
    pub(crate) fn new(
        added: Mat6,
        total: &Mat6,
        rotation_length: f64,
        source: PreparedSource,
    ) -> Option<Self> {
        let angular = 1.0 / (rotation_length * rotation_length);
        let diffusion = [1.0, 1.0, 1.0, angular, angular, angular];
        let (lambda, from_modes) = eigen_generalized(&added, total)?;
        // Rounding leaves the zero modes of a body of revolution at +-1e-17.
        let eigenvalues = lambda.map(|l| if l < 1e-14 { 0.0 } else { l });
        let to_modes = product(&transpose(&from_modes), total);
        let covariance = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let c: f64 = (0..6)
                    .map(|k| to_modes[i][k] * diffusion[k] * to_modes[j][k])
                    .sum();
                eigenvalues[i] * eigenvalues[j] * c
            })
        });
        let spread = mul_columns(&from_modes, &eigenvalues);
        Some(Self {
            source,
            added,
            diffusion,
            fraction: product(&spread, &to_modes),
            eigenvalues,
            to_modes,
            from_modes,
            covariance,
        })
    }

    /// Exact solution over `h` with the coefficients frozen, from six standard normals.
    pub(crate) fn step(&self, xi: &mut Vec6, time: f64, h: f64, normals: &[f64; 6]) {
        let LangevinCoefficients { alpha, beta } = self.midpoint_coefficients(xi, time, h);
        let decay = self.eigenvalues.map(|l| libm::expm1(-alpha * l * h));
        let factor = self.noise_factor(&decay, alpha, h);
        let mut modes = mul(&self.to_modes, xi);
        for i in 0..6 {
            let noise: f64 = (0..=i).map(|j| factor[i][j] * normals[j]).sum();
            modes[i] += decay[i] * modes[i] + beta * noise;
        }
        *xi = mul(&self.from_modes, &modes);
    }

    /// The step over which body-driven coefficients and the attitude stay about the same (s).
    ///
    /// Noise that grows faster than the speed feeds on itself where a frozen coefficient outlives it.
    pub(crate) fn longest_step(&self, xi: &Vec6, time: f64) -> f64 {
        if !self.source.follows_speed() {
            return f64::INFINITY;
        }
        let (v, omega) = split(xi);
        let relaxation = self.source.coefficients(v, time).alpha * self.eigenvalues[5];
        (MOST_RELAXATION / relaxation).min(MOST_TURN / norm(omega))
    }

    /// alpha in the middle of a step, where the speed has dropped; beta at its start (Ito).
    fn midpoint_coefficients(&self, xi: &Vec6, time: f64, h: f64) -> LangevinCoefficients {
        let (v, _) = split(xi);
        let mut c = self.source.coefficients(v, time);
        if self.source.follows_speed() && c.alpha > 0.0 {
            let (slowing, _) = split(&mul(&self.fraction, xi));
            let rate = (c.alpha * dot(v, slowing) / dot(v, v)).max(0.0);
            c.alpha /= 1.0 + 0.5 * h * rate;
        }
        c
    }

    /// Cholesky factor of the noise covariance of the modes over `h` at beta = 1,
    /// lambda_i lambda_j C_ij (1 - exp(-alpha (lambda_i + lambda_j) h)) / (alpha (lambda_i + lambda_j)).
    ///
    /// `decay` is exp(-alpha lambda h) - 1. Modes without added mass have no noise.
    fn noise_factor(&self, decay: &Vec6, alpha: f64, h: f64) -> Mat6 {
        let mut factor = [[0.0; 6]; 6];
        for j in 0..6 {
            for i in j..6 {
                let rate = alpha * (self.eigenvalues[i] + self.eigenvalues[j]);
                let lost = -(decay[i] + decay[j] + decay[i] * decay[j]);
                let duration = if rate > 0.0 { lost / rate } else { h };
                let known: f64 = (0..j).map(|k| factor[i][k] * factor[j][k]).sum();
                factor[i][j] = self.covariance[i][j] * duration - known;
            }
            let pivot = factor[j][j];
            // A zero mode, or what rounding leaves of a singular covariance.
            let inverse = if pivot > 1e-14 * self.covariance[j][j] * h {
                1.0 / pivot.sqrt()
            } else {
                0.0
            };
            for row in &mut factor[j..] {
                row[j] *= inverse;
            }
        }
        factor
    }

    /// The generalized force of the relaxation, -alpha A xi.
    pub(crate) fn relaxation(&self, xi: &Vec6, time: f64) -> Vec6 {
        let (v, _) = split(xi);
        let alpha = self.source.coefficients(v, time).alpha;
        mul(&self.added, xi).map(|force| -alpha * force)
    }

    /// The Euler-Maruyama impulse over `h`, A B dW.
    pub(crate) fn kick(&self, xi: &Vec6, time: f64, h: f64, normals: &[f64; 6]) -> Vec6 {
        let (v, _) = split(xi);
        let beta = self.source.coefficients(v, time).beta;
        let dw = std::array::from_fn(|i| beta * (self.diffusion[i] * h).sqrt() * normals[i]);
        mul(&self.added, &dw)
    }
}

/// The columns of `m` times the entries of `s`.
fn mul_columns(m: &Mat6, s: &Vec6) -> Mat6 {
    std::array::from_fn(|i| std::array::from_fn(|j| m[i][j] * s[j]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::turbulence::{TurbulenceHistory, TurbulenceSource, kolmogorov_c0};

    const C0: f64 = 6.5;

    fn spd(seed: usize) -> Mat6 {
        let b: Mat6 = std::array::from_fn(|i| {
            std::array::from_fn(|j| libm::sin((7 * i + 3 * j + seed) as f64) + f64::from(i == j))
        });
        product(&transpose(&b), &b)
    }

    fn history(entries: usize, entry: impl Fn(f64) -> (f64, f64)) -> PreparedSource {
        let interval = 1e-3;
        let (k, epsilon) = (0..entries).map(|i| entry(i as f64 * interval)).unzip();
        let history = TurbulenceHistory {
            interval,
            inflow_speed: 1.0,
            length: 1.0,
            k,
            epsilon,
        };
        PreparedSource::new(TurbulenceSource::History, Some(&history), 1.0, C0).unwrap()
    }

    fn frozen(k: f64, epsilon: f64) -> PreparedSource {
        history(1, |_| (k, epsilon))
    }

    /// The covariance after a step: the step is linear in xi and in the normals.
    fn propagate(langevin: &Langevin, covariance: &Mat6, time: f64, h: f64) -> Mat6 {
        let unit = |i: usize| -> Vec6 { std::array::from_fn(|j| f64::from(i == j)) };
        let column = |xi: Vec6, z: Vec6| {
            let mut xi = xi;
            langevin.step(&mut xi, time, h, &z);
            xi
        };
        let decay = transpose(&std::array::from_fn(|i| column(unit(i), [0.0; 6])));
        let noise = transpose(&std::array::from_fn(|i| column([0.0; 6], unit(i))));
        let kept = product(&product(&decay, covariance), &transpose(&decay));
        let added = product(&noise, &transpose(&noise));
        std::array::from_fn(|i| std::array::from_fn(|j| kept[i][j] + added[i][j]))
    }

    fn assert_close(a: &Mat6, b: &Mat6, tolerance: f64) {
        let size = b.iter().flatten().fold(0.0f64, |m, x| m.max(x.abs()));
        for (x, y) in a.iter().flatten().zip(b.iter().flatten()) {
            assert!((x - y).abs() <= tolerance * size, "{x} for {y}");
        }
    }

    fn general() -> Langevin {
        let added = spd(1);
        let body = spd(2);
        let total = std::array::from_fn(|i| std::array::from_fn(|j| added[i][j] + body[i][j]));
        Langevin::new(added, &total, 0.5, frozen(2.0, 30.0)).unwrap()
    }

    #[test]
    fn one_step_is_two_half_steps() {
        let langevin = general();
        let start = spd(3);
        for h in [1e-4, 1e-2, 1.0 / 60.0] {
            let once = propagate(&langevin, &start, 0.0, h);
            let half = propagate(&langevin, &start, 0.0, 0.5 * h);
            let twice = propagate(&langevin, &half, 0.0, 0.5 * h);
            assert_close(&once, &twice, 1e-12);
        }
    }

    #[test]
    fn the_stationary_covariance_is_that_of_the_process() {
        let langevin = general();
        let alpha = (0.5 + 0.75 * C0) * 15.0;
        let beta2 = C0 * 30.0;
        let in_modes: Mat6 = std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let rate = alpha * (langevin.eigenvalues[i] + langevin.eigenvalues[j]);
                beta2 * langevin.covariance[i][j] / rate
            })
        });
        let v = &langevin.from_modes;
        let stationary = product(&product(v, &in_modes), &transpose(v));
        for h in [1e-4, 5e-3, 1.0 / 60.0] {
            assert_close(
                &propagate(&langevin, &stationary, 0.0, h),
                &stationary,
                1e-12,
            );
        }
    }

    /// A particle that is all fluid: T = A, lambda = 1.
    fn fluid_particle(source: PreparedSource) -> Langevin {
        let one = std::array::from_fn(|i| std::array::from_fn(|j| f64::from(i == j)));
        Langevin::new(one, &one, 1.0, source).unwrap()
    }

    #[test]
    fn a_fluid_particle_has_the_variance_and_structure_function_of_the_model() {
        let (k, epsilon) = (2.0, 30.0);
        let particle = fluid_particle(frozen(k, epsilon));
        let settled = propagate(&particle, &[[0.0; 6]; 6], 0.0, 10.0);
        assert!((settled[0][0] / (C0 * k / (1.0 + 1.5 * C0)) - 1.0).abs() < 1e-12);
        assert!((settled[0][0] / k - 0.6047).abs() < 1e-4);
        let lag = 1e-8;
        let early = propagate(&particle, &[[0.0; 6]; 6], 0.0, lag);
        assert!((early[0][0] / (C0 * epsilon * lag) - 1.0).abs() < 1e-5);
    }

    #[test]
    fn in_decaying_turbulence_the_variance_follows_the_energy() {
        // Decay without production: both closed forms with C2 = 1.92.
        let (k0, chi0, c2) = (1.0, 7.5, 1.92);
        let k = |t: f64| k0 * libm::pow(1.0 + (c2 - 1.0) * chi0 * t, -1.0 / (c2 - 1.0));
        let chi = |t: f64| chi0 / (1.0 + (c2 - 1.0) * chi0 * t);
        let particle = fluid_particle(history(1001, |t| (k(t), k(t) * chi(t))));
        let h = 1e-3;
        let mut covariance: Mat6 =
            std::array::from_fn(|i| std::array::from_fn(|j| f64::from(i == j) * 2.0 / 3.0 * k0));
        for n in 0..1000 {
            covariance = propagate(&particle, &covariance, f64::from(n) * h, h);
        }
        let wanted = 2.0 / 3.0 * k(1.0);
        assert!(
            (covariance[0][0] / wanted - 1.0).abs() < 0.01,
            "{} {wanted}",
            covariance[0][0]
        );
    }

    #[test]
    fn speed_dependent_drag_is_of_second_order() {
        let source = TurbulenceSource::default();
        let source = PreparedSource::new(source, None, 0.1, kolmogorov_c0(1e4)).unwrap();
        let alpha = source.coefficients([1.0, 0.0, 0.0], 0.0).alpha;
        let langevin = fluid_particle(source);
        // v' = -alpha v^2 gives v = v0 / (1 + alpha v0 t).
        let error = |steps: u32| {
            let mut xi = [2.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            for _ in 0..steps {
                langevin.step(&mut xi, 0.0, 0.05 / f64::from(steps), &[0.0; 6]);
            }
            (xi[0] - 2.0 / (1.0 + 2.0 * alpha * 0.05)).abs()
        };
        let order = (error(8) / error(16)).log2();
        assert!(
            order > 1.8 && error(16) < 2e-3,
            "order {order}, error {}",
            error(16)
        );
    }

    #[test]
    fn a_mode_without_added_mass_is_left_alone() {
        let mut added = [[0.0; 6]; 6];
        let mut total = [[0.0; 6]; 6];
        for i in 0..6 {
            total[i][i] = 2.0;
            added[i][i] = f64::from(i < 3);
        }
        let sphere = Langevin::new(added, &total, 1.0, frozen(1.0, 10.0)).unwrap();
        let mut xi = [1.0, 0.0, 0.0, 0.3, -0.2, 0.1];
        sphere.step(&mut xi, 0.0, 0.01, &[1.0, -1.0, 0.5, 2.0, 1.0, -3.0]);
        for (spin, before) in xi[3..].iter().zip([0.3, -0.2, 0.1]) {
            assert!((spin - before).abs() < 1e-15);
        }
        assert!(xi[0] < 1.5 && xi[1] != 0.0);
    }
}
