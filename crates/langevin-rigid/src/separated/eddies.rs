//! The turbulence in which a body moves: the velocity of the fluid seen, as an Ornstein-Uhlenbeck process.
//!
//! Eqs. (7) to (10) are about a particle of the fluid. Its velocity u' relaxes at the rate alpha of Eq. (9) and is kicked
//! at random; over a step that is solved exactly,
//!
//! ```text
//! u' = sigma z,    z <- e z + sqrt(1 - e^2) N(0, 1),    e = exp(-h / T),
//! ```
//!
//! with sigma^2 = 2/3 k and T = 1/alpha. The state is z, not u': sigma follows the speed at once, so that turbulence of
//! the body's own dies with its motion and feeds nothing. The loads of separated flow see the velocity relative to it.

use std::sync::Arc;

use super::SeparatedFlow;
use crate::body::Body;
use crate::elementary::{exp, expm1};
use crate::kirchhoff::Motion;
use crate::linalg::{Mat3, Vec6, dot, each, norm, split};
use crate::real::Real;
use crate::symmetry::{Block, General, Symmetry};
use crate::turbulence::{LangevinCoefficients, Turbulence, TurbulenceHistory};

/// Reynolds number of the chord below which the wake is laminar (Clift, Grace & Weber 1978, spheres and discs).
const TURBULENT: f64 = 100.0;

/// The turbulence around one body in one fluid.
#[derive(Debug, Clone)]
pub(crate) struct Eddies<F: Symmetry = General, R: Real = f64> {
    /// None in quiet fluid.
    source: Option<Source<F, R>>,
    /// From the fluctuation of the velocity to that of the rotation rate (1/m): an eddy must be as long as the body
    /// to turn it.
    per_length: R,
    /// Independent eddies along the body average out.
    averaged: f64,
}

#[derive(Debug, Clone)]
enum Source<F: Symmetry, R: Real> {
    /// Shed by the body.
    Wake {
        /// I^2 P / S: v times it times v is sigma^2.
        variance: F::Block<R>,
        /// One over the way of a body in the memory of the wake (1/m).
        per_memory: R,
        /// Speed at which the wake becomes turbulent (m/s).
        onset: R,
    },
    /// Precomputed, by the time since release.
    History {
        history: Arc<TurbulenceHistory>,
        c0: f64,
    },
}

impl Eddies {
    /// Turbulence that the body sheds; `strength` is the root of its k over that at birth.
    pub(crate) fn shed(
        body: &Body,
        viscosity: f64,
        strength: f64,
        constants: &SeparatedFlow,
    ) -> Self {
        let [l1, l2, _] = body.half_extents;
        let intensity = strength * constants.turbulence_intensity;
        let factor = intensity * intensity / (std::f64::consts::PI * l1 * l2);
        let variance: Mat3 = body.separation.drag_area.map(|row| row.map(|p| factor * p));
        let loud = intensity > 0.0 && !constants.attached;
        Self::of(
            body,
            loud.then(|| Source::Wake {
                variance,
                per_memory: 1.0 / (constants.turbulence_memory * l2),
                onset: 0.5 * TURBULENT * viscosity / l2,
            }),
        )
    }

    /// The precomputed turbulence.
    pub(crate) fn precomputed(
        body: &Body,
        history: &TurbulenceHistory,
        c0: f64,
        constants: &SeparatedFlow,
    ) -> Self {
        let history = Arc::new(history.clone());
        let loud = !constants.attached;
        Self::of(body, loud.then_some(Source::History { history, c0 }))
    }

    fn of(body: &Body, source: Option<Source<General, f64>>) -> Self {
        Self {
            source,
            per_length: 1.0 / body.half_extents[0],
            averaged: 1.0 / (body.slices.len().max(1) as f64).sqrt(),
        }
    }

    pub(crate) fn lift<G: Symmetry, R: Real>(&self, like: R) -> Eddies<G, R> {
        Eddies {
            source: self.source.as_ref().map(|source| match source {
                Source::Wake {
                    variance,
                    per_memory,
                    onset,
                } => Source::Wake {
                    variance: G::block(like, variance),
                    per_memory: like.of(*per_memory),
                    onset: like.of(*onset),
                },
                Source::History { history, c0 } => Source::History {
                    history: Arc::clone(history),
                    c0: *c0,
                },
            }),
            per_length: like.of(self.per_length),
            averaged: self.averaged,
        }
    }
}

impl<F: Symmetry, R: Real> Eddies<F, R> {
    /// Steps the fluctuation in `motion` over `h`, from six standard normals, and gives velocity and rotation rate of
    /// the fluid seen, world frame.
    #[inline(always)]
    pub(crate) fn step(
        &self,
        motion: &mut Motion<R>,
        time: R,
        h: R,
        normals: &[R; 6],
    ) -> Option<Vec6<R>> {
        let (sigma, rate) = self.strength(&motion.xi, time)?;
        let x = rate * h;
        let (kept, new) = (exp(-x), (-expm1(-(x + x))).sqrt());
        let before = motion.fluctuation;
        motion.fluctuation = each(
            h,
            #[inline(always)]
            |i| kept * before[i] + new * normals[i],
        );
        Some(self.seen(sigma, &motion.fluctuation))
    }

    /// Velocity and rotation rate of the fluid seen in a state, world frame.
    #[inline(always)]
    pub(crate) fn now(&self, motion: &Motion<R>, time: R) -> Option<Vec6<R>> {
        let (sigma, _) = self.strength(&motion.xi, time)?;
        Some(self.seen(sigma, &motion.fluctuation))
    }

    #[inline(always)]
    fn seen(&self, sigma: R, fluctuation: &Vec6<R>) -> Vec6<R> {
        let sigma = sigma * sigma.of(self.averaged);
        let turning = sigma * self.per_length;
        each(
            sigma,
            #[inline(always)]
            |i| fluctuation[i] * if i < 3 { sigma } else { turning },
        )
    }

    /// Standard deviation sigma (m/s) and rate 1/T (1/s) at the velocity `xi` relative to the mean flow.
    #[inline(always)]
    fn strength(&self, xi: &Vec6<R>, time: R) -> Option<(R, R)> {
        let (v, _) = split(xi);
        let zero = time.of(0.0);
        match self.source.as_ref()? {
            Source::Wake {
                variance,
                per_memory,
                onset,
            } => {
                let speed = norm(v);
                let turbulent = onset.less(speed);
                let share = R::choose(turbulent, (speed - *onset) / speed, zero);
                let sigma = dot(v, variance.times(v)).max(zero).sqrt();
                Some((share * sigma, speed * *per_memory))
            }
            Source::History { history, c0 } => {
                let at = |t: f64| {
                    history.at(t).unwrap_or(Turbulence {
                        k: 0.0,
                        epsilon: 0.0,
                    })
                };
                let sigma = time.map(|t| (2.0 / 3.0 * at(t).k).sqrt());
                let rate = time.map(|t| LangevinCoefficients::new(at(t), *c0).alpha);
                Some((sigma, rate))
            }
        }
    }
}
