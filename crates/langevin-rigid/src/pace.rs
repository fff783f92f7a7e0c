//! How long a step may be: the rates at which a body's motion changes, known before stepping.
//!
//! A step of h is well resolved where h times the fastest rate of the linearized equations is of order
//! one. The loads are homogeneous: of first degree (Stokes) or of second (all else). So the rates of all
//! states follow from those at rest, at unit speed and at unit spin, which are found once a body, in
//! directions all around it. Those of the resistances, which may be as stiff as they like (a thin leaf in
//! honey), are kept apart from the others.

use crate::ambient::STILL;
use crate::kirchhoff::Kirchhoff;
use crate::linalg::{
    Mat3, Mat6, Vec3, Vec6, invert_spd, join, mul, norm, product, scale, split, transpose,
};
use crate::real::Real;
use crate::separated::Closure;

/// Rates (1/s) that grow with speed and spin.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Rates<R = f64> {
    /// At rest (1/s).
    still: R,
    /// Per speed (1/m).
    speed: R,
    /// Per spin (1).
    spin: R,
}

/// What limits the steps of a body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Pace<R = f64> {
    /// Rates of all but the resistances.
    free: Rates<R>,
    /// Rates of the resistances.
    resisted: Rates<R>,
    /// What weight and buoyancy add to the speed in a second (m/s^2), at most.
    gain: R,
    /// A step of the explicit scheme is at most this over the fastest rate.
    explicit: R,
}

/// Weight of the rate at which the impulse's moment passes through a small inertia: without it steps are stable to
/// 3.3 over that rate.
const IMPULSE: f64 = 0.5;
/// The longest step of the explicit scheme over the fastest rate. The scheme of fourth order is stable to 2.8, and with
/// [`IMPULSE`] to 1.65.
pub(crate) const COARSEST: f64 = 1.6;
/// Where the resistances are this many times as fast as the rest and the step, they are taken implicitly.
const STIFF: f64 = 16.0;
/// A part that takes them so, and the rest by the midpoint rule of second order, is at most this over the rate
/// of the rest.
const IMPLICIT: f64 = 0.25;
/// A part is no smaller than the step over this.
pub(crate) const MOST_PARTS: u32 = 256;

/// The next part of a step.
pub(crate) struct Substep<R: Real> {
    /// Its length (s).
    pub(crate) h: R,
    /// Whether the resistances are too stiff for the explicit scheme.
    pub(crate) stiff: R::Mask,
    /// Whether the motion wants a shorter one: it is taken stably, not accurately.
    pub(crate) rough: R::Mask,
}

impl Pace {
    /// The pace of a body with steps of the explicit scheme up to `explicit` over the fastest rate; without a closure nothing
    /// resists.
    pub(crate) fn of(kirchhoff: &Kirchhoff, closure: Option<&Closure>, explicit: f64) -> Self {
        let length = closure.map_or_else(|| gyration(&kirchhoff.total), |c| c.length());
        let probe = Probe {
            kirchhoff,
            closure,
            length,
        };
        let mut free = probe.rates(|xi| spectral_radius(&probe.jacobian(xi)));
        free.speed = free.speed.max(IMPULSE * impulse_rate(&kirchhoff.total));
        Self {
            free,
            resisted: probe.rates(|xi| spectral_radius(&probe.relaxation(xi))),
            gain: kirchhoff.gain(),
            explicit,
        }
    }

    /// The same in the lanes of `like`.
    pub(crate) fn lift<R: Real>(&self, like: R) -> Pace<R> {
        Pace {
            free: self.free.lift(like),
            resisted: self.resisted.lift(like),
            gain: like.of(self.gain),
            explicit: like.of(self.explicit),
        }
    }

    /// The longest step (s) that a body in this motion takes whole, with the explicit scheme.
    pub(crate) fn longest_step(&self, xi: &Vec6) -> f64 {
        let (v, omega) = split(xi);
        let at = |rates: &Rates| rates.at(norm(v), norm(omega));
        self.explicit / at(&self.free).max(at(&self.resisted))
    }
}

impl<R: Real> Pace<R> {
    /// The part of `left` (s) that comes next, not under `least`; `forced` is what forcing adds to speed and spin in a
    /// second, and the size of the fluid's own gradient.
    #[inline(always)]
    pub(crate) fn part(
        &self,
        xi: &Vec6<R>,
        left: R,
        least: R,
        forced: Option<[R; 3]>,
    ) -> Substep<R> {
        let (v, omega) = split(xi);
        let (mut speed, mut spin) = (norm(v) + self.gain * left, norm(omega));
        if let Some([faster, spun, gradient]) = forced {
            speed = speed + faster * left;
            spin = spin + (spun * left + gradient);
        }
        let (free, resisted) = (self.free.at(speed, spin), self.resisted.at(speed, spin));
        let explicit = self.explicit;
        let long = explicit.less(left * free.max(resisted));
        if !R::any(long) {
            return Substep {
                h: left,
                stiff: long,
                rough: long,
            };
        }
        let others = free.max(explicit / left);
        let fastest = free.max(resisted);
        // Where even the shortest part is too long for the explicit scheme, its errors would be motion: what the
        // resistances hold stays bounded.
        let lost = explicit.less(least * fastest) & left.of(0.0).less(resisted);
        let stiff = long & (lost | (others * left.of(STIFF)).less(resisted));
        let wanted = R::choose(stiff, left.of(IMPLICIT) / free, explicit / fastest);
        Substep {
            h: R::choose(long, wanted.max(least).min(left), left),
            stiff,
            rough: long & wanted.less(least),
        }
    }
}

impl Rates {
    fn lift<R: Real>(&self, like: R) -> Rates<R> {
        Rates {
            still: like.of(self.still),
            speed: like.of(self.speed),
            spin: like.of(self.spin),
        }
    }
}

impl<R: Real> Rates<R> {
    #[inline(always)]
    fn at(&self, speed: R, spin: R) -> R {
        self.still + (self.speed * speed + self.spin * spin)
    }
}

/// How fast, at unit speed, the moment of the linear impulse about where the step began changes beside the inertia of
/// rotation (1/m): the speed over a radius of gyration. The scheme takes the spin from the difference of that moment
/// and the angular impulse, so what it errs by in the one shows in the other, most in bodies lighter than their fluid.
fn impulse_rate(total: &Mat6) -> f64 {
    let block = |k: usize| -> Mat3 {
        std::array::from_fn(|i| std::array::from_fn(|j| total[k + i][k + j]))
    };
    let (linear, angular) = (block(0), block(3));
    let Some(inverse) = invert_spd(&angular) else {
        return 0.0;
    };
    let largest = |e: Vec3| {
        let [x, y, z] = e;
        let arm = [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]];
        let moment = product(&transpose(&arm), &product(&inverse, &arm));
        let rate: Mat3 = product(&linear, &moment);
        let mut m = [[0.0; 6]; 6];
        for i in 0..3 {
            m[i][..3].copy_from_slice(&rate[i]);
        }
        spectral_radius(&m).sqrt()
    };
    directions().map(largest).fold(0.0, f64::max)
}

/// Radius of gyration of the total tensor (m), for a body without extents.
fn gyration(total: &Mat6) -> f64 {
    let trace = |k: usize| total[k][k] + total[k + 1][k + 1] + total[k + 2][k + 2];
    (trace(3) / trace(0)).sqrt()
}

/// The equations to be probed.
struct Probe<'a> {
    kirchhoff: &'a Kirchhoff,
    closure: Option<&'a Closure>,
    /// What makes a spin a speed (m).
    length: f64,
}

impl Probe<'_> {
    /// The largest of `rate` at rest, and what it gains at unit speed and at unit spin.
    fn rates(&self, rate: impl Fn(&Vec6) -> f64) -> Rates {
        let still = rate(&[0.0; 6]);
        let largest = |motion: &dyn Fn(Vec3) -> Vec6| {
            let found = directions().map(|e| rate(&motion(e)));
            found.fold(0.0, f64::max)
        };
        // Viscosity shifts the rates at rest only, whatever the speed that stands for one.
        let speed = largest(&|e| join(e, [0.0; 3]));
        let spin = largest(&|e| join([0.0; 3], scale(1.0 / self.length, e)));
        Rates {
            still,
            speed: (speed - still).max(0.0),
            spin: (spin - still).max(0.0) * self.length,
        }
    }

    /// T^-1 D: what the resistances relax. Those that grow with the speed count twice, as the derivative
    /// of a square.
    fn relaxation(&self, xi: &Vec6) -> Mat6 {
        let Some(closure) = self.closure else {
            return [[0.0; 6]; 6];
        };
        let (still, moving) = (
            closure.resistance(&[0.0; 6], &STILL),
            closure.resistance(xi, &STILL),
        );
        let twice =
            std::array::from_fn(|i| std::array::from_fn(|j| 2.0 * moving[i][j] - still[i][j]));
        product(&self.kirchhoff.inverse, &twice)
    }

    /// Derivative of the acceleration by the velocity, without the resistances.
    fn jacobian(&self, xi: &Vec6) -> Mat6 {
        const STEP: f64 = 1e-4;
        let columns: Mat6 = std::array::from_fn(|j| {
            let size = if j < 3 { STEP } else { STEP / self.length };
            let moved = |by: f64| {
                let mut xi = *xi;
                xi[j] += by;
                self.acceleration(&xi)
            };
            let (there, back) = (moved(size), moved(-size));
            std::array::from_fn(|i| (there[i] - back[i]) / (2.0 * size))
        });
        transpose(&columns)
    }

    fn acceleration(&self, xi: &Vec6) -> Vec6 {
        let mut rate = self.kirchhoff.momentum_rate(xi);
        if let Some((load, _)) = self
            .closure
            .and_then(|closure| closure.resisted_load(xi, &STILL))
        {
            rate = std::array::from_fn(|i| rate[i] + load.force[i]);
        }
        mul(&self.kirchhoff.inverse, &rate)
    }
}

/// Axes, edges and corners of a cube, and the same turned a little: no body has all its sharp ends there.
fn directions() -> impl Iterator<Item = Vec3> {
    const SIGNS: [f64; 3] = [-1.0, 0.0, 1.0];
    let grid = SIGNS.into_iter().flat_map(|x| {
        SIGNS
            .into_iter()
            .flat_map(move |y| SIGNS.map(|z| [x, y, z]))
    });
    grid.filter(|e| norm(*e) > 0.0).flat_map(|[x, y, z]| {
        [[x, y, z], [x + 0.1 * y, y + 0.1 * z, z + 0.1 * x]].map(|e| scale(1.0 / norm(e), e))
    })
}

/// The largest modulus of an eigenvalue, from the size of a high power: at most a fifth too large where
/// the entries differ by a factor of 1e5.
fn spectral_radius(m: &Mat6) -> f64 {
    const SQUARINGS: u32 = 6;
    let (mut power, mut logarithm) = (*m, 0.0);
    for squaring in 0..=SQUARINGS {
        let size = power
            .as_flattened()
            .iter()
            .map(|x| x * x)
            .sum::<f64>()
            .sqrt();
        if size == 0.0 {
            return 0.0;
        }
        logarithm += libm::log(size) / f64::from(1u32 << squaring);
        let unit = power.map(|row| row.map(|x| x / size));
        power = product(&unit, &unit);
    }
    libm::exp(logarithm)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn spectral_radii_of_diagonal_turning_and_lopsided_matrices() {
        let mut m = [[0.0; 6]; 6];
        assert_eq!(spectral_radius(&m), 0.0);
        m[2][2] = -7.0;
        m[3][3] = 2.0;
        assert!((spectral_radius(&m) / 7.0 - 1.0).abs() < 1e-12);
        // A turn whose axes have other units: eigenvalues +-10 i.
        m[0][4] = 1e4;
        m[4][0] = -1e-2;
        assert!((spectral_radius(&m) / 10.0 - 1.0).abs() < 0.25);
    }
}
