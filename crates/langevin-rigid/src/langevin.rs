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

use crate::elementary::{SMALL_EXPONENT, expm1, small_expm1};
use crate::linalg::{Mat6, Vec6, dot, each, eigen_generalized, norm, product, split, transpose};
use crate::modes::{Eigenmodes, Modes, mul_columns};
use crate::real::Real;
use crate::symmetry::{General, Symmetry, Tensor};
use crate::turbulence::{Coefficients, PreparedSource};

/// The Langevin part of a body's equations of motion.
#[derive(Debug, Clone)]
pub(crate) struct Langevin<F: Symmetry = General, R: Real = f64> {
    source: PreparedSource<R>,
    /// A (kg, kg m, kg m^2).
    added: F::Tensor<R>,
    /// T^-1 A B at beta = 1.
    kick: F::Tensor<R>,
    /// Power of the noise at beta = 1, half the trace of B A T^-1 A B (kg).
    ///
    /// The turbulence at the body has no other source than what the body loses: where it follows the
    /// body's speed, its noise gives back no more than relaxation or drag have taken. Without that bound
    /// noise would feed motions that nothing resists, the spin of a rod and the slip of a sheet, for ever.
    noise_power: R,
    pub(crate) modes: F::Modes<R>,
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
        let angular = 1.0 / rotation_length;
        let noise = [1.0, 1.0, 1.0, angular, angular, angular];
        let (lambda, from_modes) = eigen_generalized(&added, total)?;
        // Rounding leaves the zero modes of a body of revolution at +-1e-17.
        let eigenvalues = lambda.map(|l| if l < 1e-14 { 0.0 } else { l });
        let to_modes = product(&transpose(&from_modes), total);
        let fraction = product(&mul_columns(&from_modes, &eigenvalues), &to_modes);
        Some(Self {
            source,
            added,
            noise_power: 0.5 * noise_power(&to_modes, &eigenvalues, &noise),
            kick: mul_columns(&fraction, &noise),
            modes: Eigenmodes::new(eigenvalues, from_modes, to_modes, &noise),
        })
    }

    /// The same for a body of shape `G` in the lanes of `like`; `total` is the tensor T.
    pub(crate) fn lift<G: Symmetry, R: Real>(&self, like: R, total: &Mat6) -> Langevin<G, R> {
        Langevin {
            source: self.source.lift(like),
            added: G::tensor(like, &self.added),
            kick: G::tensor(like, &self.kick),
            noise_power: like.of(self.noise_power),
            modes: G::modes(like, &self.modes, &self.added, total, &self.kick),
        }
    }
}

impl<F: Symmetry, R: Real> Langevin<F, R> {
    /// Exact solution over `h` with the coefficients frozen, from six standard normals, in modes.
    #[inline(always)]
    pub(crate) fn step(&self, modes: &Vec6<R>, time: R, h: R, normals: &[R; 6]) -> Vec6<R> {
        let Coefficients { alpha, diffusion } = self.midpoint_coefficients(modes, time, h);
        let s = alpha * h;
        let strength = (diffusion * h).sqrt();
        let small = !s.of(SMALL_EXPONENT).less(s * self.modes.fastest());
        let noise = self.modes.small_noise(s, normals);
        let lambda = self.modes.eigenvalues();
        let near = each(
            s,
            #[inline(always)]
            |i| {
                let decay = small_expm1(-(s * lambda[i]));
                modes[i] + (decay * modes[i] + strength * noise[i])
            },
        );
        if !R::any(!small) {
            return near;
        }
        let far = self.long_step(modes, s, strength, normals);
        each(
            s,
            #[inline(always)]
            |i| R::choose(small, near[i], far[i]),
        )
    }

    /// The same for any s = alpha h > 0, with the noise of strength beta sqrt(h).
    #[inline(always)]
    fn long_step(&self, modes: &Vec6<R>, s: R, strength: R, normals: &[R; 6]) -> Vec6<R> {
        let lambda = self.modes.eigenvalues();
        let decay = each(
            s,
            #[inline(always)]
            |i| expm1(-(s * lambda[i])),
        );
        let noise = self.modes.noise(s, &decay, normals);
        each(
            s,
            #[inline(always)]
            |i| modes[i] + (decay[i] * modes[i] + strength * noise[i]),
        )
    }

    /// The part of `left` over which body-driven coefficients and the attitude stay about the same
    /// (s), but not under `least`.
    ///
    /// Noise that grows faster than the speed feeds on itself where a frozen coefficient outlives it.
    #[inline(always)]
    pub(crate) fn part(&self, xi: &Vec6<R>, time: R, left: R, least: R) -> R {
        if !self.source.follows_speed() {
            return left;
        }
        let (v, omega) = split(xi);
        let alpha = self.source.coefficients(norm(v), time).alpha;
        let relaxation = alpha * self.modes.fastest();
        let spin2 = dot(omega, omega);
        let (most, turn) = (left.of(MOST_RELAXATION), left.of(MOST_TURN));
        let exceeds = most.less(relaxation * left) | (turn * turn).less(spin2 * (left * left));
        if !R::any(exceeds) {
            return left;
        }
        let wanted = (most / relaxation).min(turn / spin2.sqrt());
        R::choose(exceeds, wanted.max(least).min(left), left)
    }

    /// alpha in the middle of a step, where the speed has dropped; beta at its start (Ito), within what the
    /// relaxation takes.
    #[inline(always)]
    fn midpoint_coefficients(&self, modes: &Vec6<R>, time: R, h: R) -> Coefficients<R> {
        let v = self.modes.linear(modes);
        let v2 = dot(v, v);
        let mut c = self.source.coefficients(v2.sqrt(), time);
        if self.source.follows_speed() {
            let lambda = self.modes.eigenvalues();
            let relaxing = each(
                h,
                #[inline(always)]
                |i| lambda[i] * modes[i],
            );
            let zero = h.of(0.0);
            let lost = dot(v, self.modes.linear(&relaxing)).max(zero) * c.alpha * (h * h.of(0.5));
            let moving = zero.less(v2);
            // In a step too long for its rate relaxation takes no more than there is.
            let rate = c.alpha.min(h.of(0.5) / h);
            let taken = rate * self.modes.relaxed(modes);
            c.diffusion = c.diffusion.min(taken / self.noise_power);
            c.alpha = R::choose(moving, c.alpha * v2 / (v2 + lost), zero);
        }
        c
    }

    /// The generalized force of the relaxation, -alpha A xi.
    pub(crate) fn relaxation(&self, xi: &Vec6<R>, time: R) -> Vec6<R> {
        let alpha = self.source.coefficients(norm(split(xi).0), time).alpha;
        let momentum = self.added.times(xi);
        each(time, |i| -(alpha * momentum[i]))
    }

    /// The Euler-Maruyama change of the velocity over `h`, T^-1 A B dW, with the coefficients of the
    /// velocity `xi`.
    #[inline(always)]
    pub(crate) fn kick(&self, xi: &Vec6<R>, time: R, h: R, normals: &[R; 6]) -> Vec6<R> {
        let diffusion = self.source.coefficients(norm(split(xi).0), time).diffusion;
        let strength = (diffusion * h).sqrt();
        let kick = self.kick.times(normals);
        each(
            h,
            #[inline(always)]
            |i| strength * kick[i],
        )
    }
}

/// The trace of B A T^-1 A B: the square of lambda V^-1 B.
fn noise_power(to_modes: &Mat6, eigenvalues: &Vec6, noise: &Vec6) -> f64 {
    let entry = |i: usize, j: usize| eigenvalues[i] * to_modes[i][j] * noise[j];
    let entries = (0..6).flat_map(|i| (0..6).map(move |j| (i, j)));
    entries.map(|(i, j)| entry(i, j) * entry(i, j)).sum()
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
            let modes = langevin.modes.of_velocity(&xi);
            langevin.modes.velocity(&langevin.step(&modes, time, h, &z))
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
            std::array::from_fn(|j| beta2 * langevin.modes.stationary()[i][j] / alpha)
        });
        let v = langevin.modes.basis();
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
        let alpha = source.coefficients(1.0, 0.0).alpha;
        let langevin = fluid_particle(source);
        // v' = -alpha v^2 gives v = v0 / (1 + alpha v0 t).
        let error = |steps: u32| {
            let mut xi = [2.0, 0.0, 0.0, 0.0, 0.0, 0.0];
            for _ in 0..steps {
                let modes = langevin.modes.of_velocity(&xi);
                let h = 0.05 / f64::from(steps);
                xi = langevin
                    .modes
                    .velocity(&langevin.step(&modes, 0.0, h, &[0.0; 6]));
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
        let modes = sphere.modes.of_velocity(&[1.0, 0.0, 0.0, 0.3, -0.2, 0.1]);
        let modes = sphere.step(&modes, 0.0, 0.01, &[1.0, -1.0, 0.5, 2.0, 1.0, -3.0]);
        let xi = sphere.modes.velocity(&modes);
        for (spin, before) in xi[3..].iter().zip([0.3, -0.2, 0.1]) {
            assert!((spin - before).abs() < 1e-15);
        }
        assert!(xi[0] < 1.5 && xi[1] != 0.0);
    }
}
