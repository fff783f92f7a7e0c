//! A wind sea as a sum of waves.

use std::f64::consts::{PI, TAU};

use super::surface::{WaterError, WaterSurface, Wave, direction, nonnegative, positive};

/// A sea raised by wind: the statistics of its waves.
///
/// The spectrum is S(f) ~ f^-5 exp(-5/4 (f_p/f)^4) gamma^r with r = exp(-(f/f_p - 1)^2 / (2 s^2)), s = 0.07 below the peak
/// frequency and 0.09 above (Hasselmann et al. 1973); that of Pierson & Moskowitz (1964) for gamma = 1. Directions spread
/// about the heading as cos^(2 n) of half the angle between (Longuet-Higgins et al. 1963).
///
/// ```
/// use langevin_rigid_world::water::{Sea, WaterSurface};
/// let sea = Sea { significant_height: 0.3, peak_period: 2.5, ..Sea::default() };
/// let surface = WaterSurface::sea(0.0, 9.81, &sea)?;
/// assert!(surface.height(3.0, 1.0, 20.0).abs() < surface.reach());
/// # Ok::<(), langevin_rigid_world::water::WaterError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sea {
    /// Significant height H_s: four standard deviations of the surface (m).
    pub significant_height: f64,
    /// Period of the waves that have most of the energy (s).
    pub peak_period: f64,
    /// Peak enhancement gamma: 1 for a fully developed sea, 3.3 for one that grows (JONSWAP).
    pub peak_enhancement: f64,
    /// Main horizontal direction in which the waves travel, along x and z of the world.
    pub heading: [f64; 2],
    /// Exponent n of the spreading: about 10 for wind waves, 0 for waves from everywhere; long crests if none.
    pub spreading: Option<f64>,
    /// Number of waves in the sum.
    pub components: u32,
    /// Which of all such seas.
    pub seed: u64,
}

impl Default for Sea {
    fn default() -> Self {
        Self {
            significant_height: 0.5,
            peak_period: 3.0,
            peak_enhancement: 3.3,
            heading: [1.0, 0.0],
            spreading: Some(10.0),
            components: 32,
            seed: 0,
        }
    }
}

/// Frequencies of the spectrum, in units of the peak's: below and above is less than a hundredth of the energy.
const FREQUENCIES: [f64; 2] = [0.4, 5.0];
/// Intervals of the integrals over frequency and over angle.
const INTERVALS: u32 = 4096;

impl WaterSurface {
    /// A sea about a still surface at the height `level` (world y, m), under a gravity of this magnitude (m/s^2).
    ///
    /// Its waves have equal amplitudes: each stands for an equal share of the energy, with a frequency out of that share, so
    /// that the sum does not repeat.
    ///
    /// # Errors
    /// [`WaterError`], which names the number that is out of range.
    pub fn sea(level: f64, gravity: f64, sea: &Sea) -> Result<Self, WaterError> {
        nonnegative("the significant height", sea.significant_height)?;
        positive("the peak period", sea.peak_period)?;
        positive("the peak enhancement", sea.peak_enhancement)?;
        nonnegative("the spreading", sea.spreading.unwrap_or(0.0))?;
        positive("gravity", gravity)?;
        if sea.components == 0 {
            return Err(WaterError::NoComponents);
        }
        let main = direction(sea.heading)?;
        let count = f64::from(sea.components);
        let amplitude = 0.25 * sea.significant_height * (2.0 / count).sqrt();
        let [from, to] = FREQUENCIES;
        let energy = Distribution::new(from, to, |f| spectrum(f, sea.peak_enhancement));
        let angles = sea
            .spreading
            .map(|n| Distribution::new(-PI, PI, |a| libm::pow(libm::cos(0.5 * a).abs(), 2.0 * n)));
        let mut dice = Dice(sea.seed);
        let mut waves = Vec::with_capacity(sea.components as usize);
        for number in 0..sea.components {
            let frequency = energy.quantile((f64::from(number) + dice.roll()) / count);
            let angular = TAU / sea.peak_period * frequency;
            let angle = angles.as_ref().map_or(0.0, |a| a.quantile(dice.roll()));
            let (sin, cos) = libm::sincos(angle);
            waves.push(Wave {
                amplitude,
                wavelength: TAU * gravity / (angular * angular),
                heading: [cos * main[0] - sin * main[1], sin * main[0] + cos * main[1]],
                phase: TAU * dice.roll(),
            });
        }
        Self::new(level, gravity, &waves)
    }
}

/// Density of the energy over the frequency in units of the peak's, to a factor.
fn spectrum(f: f64, enhancement: f64) -> f64 {
    let width = if f < 1.0 { 0.07 } else { 0.09 };
    let away = (f - 1.0) / width;
    let peak = libm::exp(-0.5 * away * away);
    libm::pow(f, -5.0) * libm::exp(-1.25 * libm::pow(f, -4.0)) * libm::pow(enhancement, peak)
}

/// A density over an interval, integrated.
struct Distribution {
    from: f64,
    step: f64,
    /// The integral up to each point, the last one 1.
    below: Vec<f64>,
}

impl Distribution {
    fn new(from: f64, to: f64, density: impl Fn(f64) -> f64) -> Self {
        let step = (to - from) / f64::from(INTERVALS);
        let mut sum = 0.0;
        let mut below = vec![0.0];
        for n in 0..INTERVALS {
            sum += density(from + (f64::from(n) + 0.5) * step);
            below.push(sum);
        }
        for share in &mut below {
            *share /= sum;
        }
        Self { from, step, below }
    }

    /// Where the share `share` of the whole is below.
    fn quantile(&self, share: f64) -> f64 {
        let above = self.below.partition_point(|&b| b <= share);
        let n = above.clamp(1, self.below.len() - 1) - 1;
        let [low, high] = [self.below[n], self.below[n + 1]];
        let within = if high > low {
            (share - low) / (high - low)
        } else {
            0.0
        };
        self.from + (n as f64 + within) * self.step
    }
}

/// Uniform deviates (SplitMix64, Steele et al. 2014).
struct Dice(u64);

impl Dice {
    /// In [0, 1).
    fn roll(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        z ^= z >> 31;
        (z >> 11) as f64 * (1.0 / (1u64 << 53) as f64)
    }
}
