//! Turbulence at the body: the precomputed history, the sources a run samples, and the coefficients
//! of the Langevin equation that follow from it.

use std::sync::Arc;

use crate::real::Real;

/// Model constant of the turbulent viscosity, Eq. (14).
pub const C_MU: f64 = 0.09;

/// Turbulent kinetic energy and its dissipation rate at the body, at equal intervals from release.
///
/// Computed once per scene by the k-epsilon model on a MAC grid (Xie & Miyata 2014, Algorithm 1).
#[derive(Debug, Clone, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct TurbulenceHistory {
    /// Time between two entries (s).
    pub interval: f64,
    /// Inflow speed U0 of the mean flow (m/s).
    pub inflow_speed: f64,
    /// Length l of Eq. (18), the cell size of the grid (m).
    pub length: f64,
    /// Turbulent kinetic energy k (m^2/s^2), entry `i` at time `i * interval`.
    pub k: Vec<f64>,
    /// Dissipation rate epsilon (m^2/s^3), as long as `k`.
    pub epsilon: Vec<f64>,
}

/// What makes a turbulence history impossible.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("the turbulence history's {name} is {value}; it must be {wanted}: bake the scene again")]
pub struct HistoryError {
    /// Name of the quantity.
    pub name: &'static str,
    /// Its value.
    pub value: f64,
    /// What it must be.
    pub wanted: &'static str,
}

impl TurbulenceHistory {
    /// Checks what every source that samples it relies on.
    ///
    /// # Errors
    /// See [`HistoryError`]; the first fault in the order of the fields.
    pub fn check(&self) -> Result<(), HistoryError> {
        let error = |name, value, wanted| {
            Err(HistoryError {
                name,
                value,
                wanted,
            })
        };
        for (name, value) in [
            ("interval", self.interval),
            ("inflow speed", self.inflow_speed),
            ("length", self.length),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return error(name, value, "a positive number");
            }
        }
        let entries = self.k.iter().chain(&self.epsilon);
        if let Some(&value) = entries.into_iter().find(|x| !(**x >= 0.0 && x.is_finite())) {
            return error("k or epsilon", value, "zero or a positive number");
        }
        if self.k.is_empty() || self.k.len() != self.epsilon.len() {
            let count = self.epsilon.len() as f64;
            return error(
                "number of values of epsilon",
                count,
                "that of k, and not zero",
            );
        }
        Ok(())
    }

    /// Turbulence at time `t` (s) after release: linear between entries, the last value held.
    ///
    /// Times before release give the first entry, an empty history none.
    pub fn at(&self, t: f64) -> Option<Turbulence> {
        let last = self.k.len().min(self.epsilon.len()).checked_sub(1)?;
        let place = (t / self.interval).clamp(0.0, last as f64);
        let i = (place as usize).min(last.saturating_sub(1));
        let weight = place - i as f64;
        let between = |x: &[f64]| x[i] + weight * (x[(i + 1).min(last)] - x[i]);
        Some(Turbulence {
            k: between(&self.k),
            epsilon: between(&self.epsilon),
        })
    }

    /// Turbulence of unit speed and unit length after the body has travelled `age` lengths.
    ///
    /// Eqs. (14)-(17) contain no viscosity, so k/U0^2 and chi l/U0 depend on s/l alone.
    pub fn at_age(&self, age: f64) -> Option<Turbulence> {
        let Turbulence { k, epsilon } = self.at(age * self.length / self.inflow_speed)?;
        let u = self.inflow_speed;
        Some(Turbulence {
            k: k / (u * u),
            epsilon: epsilon * self.length / (u * u * u),
        })
    }
}

/// Turbulent kinetic energy and dissipation rate at a point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Turbulence {
    /// Turbulent kinetic energy k (m^2/s^2).
    pub k: f64,
    /// Dissipation rate epsilon (m^2/s^3).
    pub epsilon: f64,
}

impl Turbulence {
    /// Turbulence born at a body of speed `speed` (m/s) and length `length` (m), Eq. (18).
    ///
    /// ```
    /// let t = langevin_rigid::Turbulence::at_birth(2.0, 0.1);
    /// assert_eq!(t.k, 6.0);
    /// ```
    pub fn at_birth(speed: f64, length: f64) -> Self {
        let k = 1.5 * speed * speed;
        Self {
            k,
            epsilon: libm::pow(C_MU, 0.75) * k * k.sqrt() / length,
        }
    }

    /// Turbulent frequency chi = epsilon/k (1/s), zero in fluid at rest.
    pub fn frequency(&self) -> f64 {
        if self.k > 0.0 {
            self.epsilon / self.k
        } else {
            0.0
        }
    }
}

/// Relaxation rate and diffusion coefficient of the Langevin equation (7).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LangevinCoefficients {
    /// Relaxation rate alpha (1/s).
    pub alpha: f64,
    /// Diffusion coefficient beta (m/s^(3/2)).
    pub beta: f64,
}

impl LangevinCoefficients {
    /// Eq. (9): alpha = (1/2 + 3/4 C0) chi, beta = sqrt(C0 epsilon).
    pub fn new(turbulence: Turbulence, c0: f64) -> Self {
        Self {
            alpha: (0.5 + 0.75 * c0) * turbulence.frequency(),
            beta: (c0 * turbulence.epsilon).sqrt(),
        }
    }
}

/// Kolmogorov coefficient C0 at a Reynolds number, Eq. (10).
///
/// ```
/// assert!((langevin_rigid::kolmogorov_c0(1e4) - 6.4968).abs() < 1e-4);
/// ```
pub fn kolmogorov_c0(reynolds: f64) -> f64 {
    6.5 * libm::pow(1.0 + 140.0 * libm::pow(reynolds, -4.0 / 3.0), -0.75)
}

/// Where a run takes its turbulence from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TurbulenceSource {
    /// Born at the body, all along its way: Eq. (18) with the body's present speed relative to the
    /// fluid in place of U0.
    BodyDriven {
        /// Distance travelled since birth, in lengths l, at which the decaying turbulence is
        /// sampled: 0 for turbulence at birth.
        wake_age: f64,
    },
    /// The precomputed history, by the time since release (the paper's way).
    History,
}

impl TurbulenceSource {
    /// Whether it samples a precomputed history, which is that of one body in one fluid.
    pub fn needs_history(self) -> bool {
        match self {
            Self::History => true,
            Self::BodyDriven { wake_age } => wake_age > 0.0,
        }
    }
}

impl Default for TurbulenceSource {
    fn default() -> Self {
        Self::BodyDriven { wake_age: 0.0 }
    }
}

/// A source made ready: turns speed and time into Langevin coefficients.
#[derive(Debug, Clone)]
pub(crate) enum PreparedSource<R = f64> {
    BodyDriven {
        /// alpha at unit speed (1/m).
        alpha: R,
        /// beta^2 at unit speed (1/m, times the cube of a speed).
        diffusion: R,
        /// Speed up to which beta follows the body's (m/s).
        most: R,
    },
    History {
        history: Arc<TurbulenceHistory>,
        c0: f64,
    },
}

/// alpha (1/s) and beta^2 (m^2/s^3), one or one per lane.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Coefficients<R = f64> {
    pub(crate) alpha: R,
    pub(crate) diffusion: R,
}

impl PreparedSource {
    /// `None` where the source needs a history and there is none.
    pub(crate) fn new(
        source: TurbulenceSource,
        history: Option<&TurbulenceHistory>,
        length: f64,
        c0: f64,
    ) -> Option<Self> {
        match source {
            TurbulenceSource::BodyDriven { wake_age } => {
                let unit = if wake_age > 0.0 {
                    history?.at_age(wake_age)?
                } else {
                    Turbulence::at_birth(1.0, 1.0)
                };
                let at_length = Turbulence {
                    k: unit.k,
                    epsilon: unit.epsilon / length,
                };
                let LangevinCoefficients { alpha, beta } = LangevinCoefficients::new(at_length, c0);
                Some(Self::BodyDriven {
                    alpha,
                    diffusion: beta * beta,
                    most: f64::INFINITY,
                })
            }
            TurbulenceSource::History => {
                let history = Arc::new(history.filter(|h| h.at(0.0).is_some())?.clone());
                Some(Self::History { history, c0 })
            }
        }
    }

    /// The same source whose fluctuations are born at no more than `speed` (m/s).
    ///
    /// Eq. (18) takes k from the mean speed of the body. The present speed stands for it, but contains the
    /// fluctuations; without a bound they feed on themselves, and a body as light as its fluid runs away.
    pub(crate) fn with_mean_speed(self, speed: f64) -> Self {
        match self {
            Self::BodyDriven {
                alpha, diffusion, ..
            } => Self::BodyDriven {
                alpha,
                diffusion,
                most: speed,
            },
            history @ Self::History { .. } => history,
        }
    }

    /// The same in the lanes of `like`.
    pub(crate) fn lift<R: Real>(&self, like: R) -> PreparedSource<R> {
        match self {
            Self::BodyDriven {
                alpha,
                diffusion,
                most,
            } => PreparedSource::BodyDriven {
                alpha: like.of(*alpha),
                diffusion: like.of(*diffusion),
                most: like.of(*most),
            },
            Self::History { history, c0 } => PreparedSource::History {
                history: Arc::clone(history),
                c0: *c0,
            },
        }
    }
}

impl<R: Real> PreparedSource<R> {
    /// Coefficients at the speed relative to the fluid (m/s) and `time` since release (s).
    #[inline(always)]
    pub(crate) fn coefficients(&self, speed: R, time: R) -> Coefficients<R> {
        match self {
            // k grows with U^2 and epsilon with U^3.
            Self::BodyDriven {
                alpha,
                diffusion,
                most,
            } => {
                let mean = speed.min(*most);
                Coefficients {
                    alpha: *alpha * speed,
                    diffusion: *diffusion * mean * (mean * mean),
                }
            }
            Self::History { history, c0 } => {
                let calm = Turbulence {
                    k: 0.0,
                    epsilon: 0.0,
                };
                let at = |t: f64| LangevinCoefficients::new(history.at(t).unwrap_or(calm), *c0);
                Coefficients {
                    alpha: time.map(|t| at(t).alpha),
                    diffusion: time.map(|t| at(t).beta * at(t).beta),
                }
            }
        }
    }

    /// Whether the coefficients follow the body's speed.
    #[inline(always)]
    pub(crate) fn follows_speed(&self) -> bool {
        matches!(self, Self::BodyDriven { .. })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn history() -> TurbulenceHistory {
        TurbulenceHistory {
            interval: 0.5,
            inflow_speed: 2.0,
            length: 0.1,
            k: vec![6.0, 4.0, 3.0],
            epsilon: vec![8.0, 2.0, 1.0],
        }
    }

    #[test]
    fn history_is_linear_between_entries_and_held_at_its_ends() {
        let h = history();
        assert_eq!(
            h.at(0.25),
            Some(Turbulence {
                k: 5.0,
                epsilon: 5.0
            })
        );
        assert_eq!(
            h.at(-1.0),
            Some(Turbulence {
                k: 6.0,
                epsilon: 8.0
            })
        );
        assert_eq!(
            h.at(9.0),
            Some(Turbulence {
                k: 3.0,
                epsilon: 1.0
            })
        );
        assert_eq!(h.at(f64::INFINITY), h.at(9.0));
        let one = TurbulenceHistory {
            k: vec![2.0],
            epsilon: vec![3.0],
            ..history()
        };
        assert_eq!(
            one.at(0.7),
            Some(Turbulence {
                k: 2.0,
                epsilon: 3.0
            })
        );
        let none = TurbulenceHistory {
            k: vec![],
            epsilon: vec![],
            ..history()
        };
        assert_eq!(none.at(0.0), None);
    }

    #[test]
    fn age_scales_speed_and_length_out() {
        // 10 lengths at 2 m/s with l = 0.1 m is half a second.
        let t = history().at_age(10.0).unwrap();
        assert_eq!((t.k, t.epsilon), (1.0, 2.0 * 0.1 / 8.0));
    }

    #[test]
    fn kolmogorov_coefficient_meets_its_table() {
        for (re, c0) in [
            (100.0, 5.334),
            (1e3, 6.4326),
            (3.8e3, 6.4885),
            (1e4, 6.4968),
        ] {
            assert!(
                (kolmogorov_c0(re) - c0).abs() < 1e-4 * 6.5,
                "{re}: {}",
                kolmogorov_c0(re)
            );
        }
    }

    #[test]
    fn body_driven_coefficients_follow_from_the_turbulence_at_birth() {
        let source = TurbulenceSource::default();
        let prepared = PreparedSource::new(source, None, 0.02, 6.4).unwrap();
        let c = prepared.coefficients(1.0, 3.0);
        let wanted = LangevinCoefficients::new(Turbulence::at_birth(1.0, 0.02), 6.4);
        assert!((c.alpha / wanted.alpha - 1.0).abs() < 1e-14);
        assert!((c.diffusion.sqrt() / wanted.beta - 1.0).abs() < 1e-14);
        let rest = prepared.coefficients(0.0, 0.0);
        assert_eq!((rest.alpha, rest.diffusion), (0.0, 0.0));
    }

    #[test]
    fn sources_that_need_a_history_say_so() {
        assert!(PreparedSource::new(TurbulenceSource::History, None, 1.0, 6.0).is_none());
        let aged = TurbulenceSource::BodyDriven { wake_age: 16.0 };
        assert!(PreparedSource::new(aged, None, 1.0, 6.0).is_none());
        assert!(PreparedSource::new(aged, Some(&history()), 1.0, 6.0).is_some());
    }
}
