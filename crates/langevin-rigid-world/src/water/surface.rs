//! The surface of deep water, and the motion of the water under it.

use std::f64::consts::TAU;

use langevin_rigid::Flow;
use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::{dot, mat_vec, norm};

/// One long-crested wave of small amplitude (Airy 1845).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Wave {
    /// Height of the crests over the still surface (m).
    pub amplitude: f64,
    /// From crest to crest (m).
    pub wavelength: f64,
    /// Horizontal direction in which it travels, along x and z of the world; of any length but zero.
    pub heading: [f64; 2],
    /// Phase at the world's origin at time zero (rad): a crest is there at 0.
    pub phase: f64,
}

/// The surface of deep water, calm or under a sum of waves, and the motion of the water under it.
///
/// Linear theory of waves in deep water (Airy 1845; Newman, Marine Hydrodynamics, 1977, chapter 6): a wave of length
/// lambda has the wave number k = 2 pi / lambda and the frequency omega = (g k)^(1/2). It is as good as the waves are flat,
/// amplitude times k well below one, and the water is deep, half a wavelength or more. Bodies do not disturb it.
///
/// A pure function of place and time, with the same bits on every platform. World frame, y up.
///
/// ```
/// use langevin_rigid_world::water::{Wave, WaterSurface};
/// let wave = Wave { amplitude: 0.1, wavelength: 6.0, heading: [1.0, 0.0], phase: 0.0 };
/// let surface = WaterSurface::new(0.0, 9.81, &[wave])?;
/// assert_eq!(surface.height(0.0, 0.0, 0.0), 0.1);
/// // Water moves forwards under a crest.
/// assert!(surface.flow([0.0, -0.5, 0.0], 0.0).velocity[0] > 0.0);
/// # Ok::<(), langevin_rigid_world::water::WaterError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct WaterSurface {
    level: f64,
    current: [f64; 2],
    waves: Vec<Wave>,
    /// The same, made ready.
    components: Vec<Component>,
    /// Sum of the amplitudes (m).
    reach: f64,
}

/// What is wrong with waves.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WaterError {
    /// A number is not finite.
    #[error("{name} of the water must be finite, not {value}")]
    NotFinite {
        /// What it is.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number is not positive.
    #[error("{name} of the water must be a positive number, not {value}")]
    NotPositive {
        /// What it is.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number is negative.
    #[error("{name} of the water must be zero or a positive number, not {value}")]
    Negative {
        /// What it is.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// Waves travel nowhere.
    #[error("the heading of the waves has no length")]
    NoHeading,
    /// A sea of no waves.
    #[error("a sea needs one wave at least")]
    NoComponents,
}

/// A wave made ready.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Component {
    amplitude: f64,
    /// Wave vector along x and z (1/m), and its length.
    wave: [f64; 2],
    number: f64,
    /// Angular frequency (1/s).
    frequency: f64,
    phase: f64,
}

impl WaterSurface {
    /// Water at rest, its surface at the height `level` (world y, m).
    ///
    /// # Errors
    /// [`WaterError::NotFinite`].
    pub fn calm(level: f64) -> Result<Self, WaterError> {
        Self::new(level, 1.0, &[])
    }

    /// The sum of `waves` about a still surface at the height `level` (world y, m), under a gravity of this
    /// magnitude (m/s^2), that of the [`Settings`](langevin_rigid::Settings) of the bodies in it.
    ///
    /// # Errors
    /// [`WaterError`], which names the number that is out of range.
    pub fn new(level: f64, gravity: f64, waves: &[Wave]) -> Result<Self, WaterError> {
        finite("the level", level)?;
        positive("gravity", gravity)?;
        let mut waves = waves.to_vec();
        for wave in &mut waves {
            wave.check()?;
            wave.heading = direction(wave.heading)?;
        }
        Ok(Self {
            level,
            current: [0.0; 2],
            reach: waves.iter().map(|wave| wave.amplitude).sum(),
            components: waves.iter().map(|w| Component::new(w, gravity)).collect(),
            waves,
        })
    }

    /// The same water flowing at a uniform horizontal velocity (m/s, along x and z), which carries its waves along.
    ///
    /// # Errors
    /// [`WaterError::NotFinite`].
    pub fn with_current(mut self, current: [f64; 2]) -> Result<Self, WaterError> {
        for u in current {
            finite("the current", u)?;
        }
        self.current = current;
        Ok(self)
    }

    /// World y of the still surface (m).
    pub fn level(&self) -> f64 {
        self.level
    }

    /// The waves, their headings of unit length.
    pub fn waves(&self) -> &[Wave] {
        &self.waves
    }

    /// How far the surface may be above or below its level (m): the sum of the amplitudes.
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// World y of the surface (m) at the horizontal place (x, z) (m) and `time` (s).
    pub fn height(&self, x: f64, z: f64, time: f64) -> f64 {
        let mut height = self.level;
        for wave in &self.components {
            height += wave.amplitude * self.sin_cos(wave, x, z, time).1;
        }
        height
    }

    /// Upward unit normal of the surface over (x, z) (m) at `time` (s).
    pub fn normal(&self, x: f64, z: f64, time: f64) -> Vec3 {
        self.tangent(x, z, time).normal
    }

    /// The plane that touches the surface over (x, z) (m) at `time` (s).
    pub fn tangent(&self, x: f64, z: f64, time: f64) -> Plane {
        let mut height = self.level;
        let mut slope = [0.0; 2];
        for wave in &self.components {
            let (sin, cos) = self.sin_cos(wave, x, z, time);
            height += wave.amplitude * cos;
            for i in 0..2 {
                slope[i] -= wave.amplitude * wave.wave[i] * sin;
            }
        }
        let steep = [-slope[0], 1.0, -slope[1]];
        let length = norm(steep);
        let normal = steep.map(|x| x / length);
        Plane {
            normal,
            offset: dot(normal, [x, height, z]),
        }
    }

    /// The water at `position` (m) and `time` (s), current and waves: velocity, its gradient and the material
    /// acceleration Du/Dt.
    ///
    /// Above the still level, where linear theory says nothing, all three are those at the level.
    pub fn flow(&self, position: Vec3, time: f64) -> Flow {
        let [x, y, z] = position;
        let depth = (y - self.level).min(0.0);
        let mut flow = Flow::default();
        // The velocity's rate of change at a place that moves with the current.
        let mut rate = [0.0; 3];
        for wave in &self.components {
            let (sin, cos) = self.sin_cos(wave, x, z, time);
            // Of the potential a omega / k e^(k y) sin: its derivatives.
            let speed = wave.amplitude * wave.frequency * libm::exp(wave.number * depth);
            let [a, b] = wave.wave.map(|k| k / wave.number);
            let velocity = [speed * a * cos, speed * sin, speed * b * cos];
            let turned = [speed * a * sin, -speed * cos, speed * b * sin];
            let along = [wave.wave[0], wave.number, wave.wave[1]];
            for i in 0..3 {
                flow.velocity[i] += velocity[i];
                rate[i] += wave.frequency * turned[i];
                flow.gradient[i][0] -= along[0] * turned[i];
                flow.gradient[i][1] += along[1] * velocity[i];
                flow.gradient[i][2] -= along[2] * turned[i];
            }
        }
        let carried = mat_vec(&flow.gradient, flow.velocity);
        flow.acceleration = std::array::from_fn(|i| rate[i] + carried[i]);
        flow.velocity[0] += self.current[0];
        flow.velocity[2] += self.current[1];
        flow
    }

    /// Sine and cosine of the phase of a wave.
    fn sin_cos(&self, wave: &Component, x: f64, z: f64, time: f64) -> (f64, f64) {
        let [u, w] = self.current;
        let along = wave.wave[0] * (x - u * time) + wave.wave[1] * (z - w * time);
        libm::sincos(along - wave.frequency * time + wave.phase)
    }
}

impl Wave {
    fn check(&self) -> Result<(), WaterError> {
        nonnegative("the amplitude of a wave", self.amplitude)?;
        positive("the length of a wave", self.wavelength)?;
        finite("the phase of a wave", self.phase)
    }
}

impl Component {
    fn new(wave: &Wave, gravity: f64) -> Self {
        let number = TAU / wave.wavelength;
        Self {
            amplitude: wave.amplitude,
            wave: wave.heading.map(|x| number * x),
            number,
            frequency: (gravity * number).sqrt(),
            phase: wave.phase,
        }
    }
}

/// A plane with an outside: its points have `normal . x = offset`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    /// Unit normal, out of the water.
    pub normal: Vec3,
    /// Distance of the plane from the origin along `normal` (m).
    pub offset: f64,
}

impl Plane {
    /// How far a point is above the plane (m).
    pub fn height(&self, point: Vec3) -> f64 {
        dot(self.normal, point) - self.offset
    }
}

/// The unit vector of a heading.
pub(super) fn direction(heading: [f64; 2]) -> Result<[f64; 2], WaterError> {
    for x in heading {
        finite("the heading of the waves", x)?;
    }
    let length = norm([heading[0], heading[1], 0.0]);
    if !(length > 0.0 && length.is_finite()) {
        return Err(WaterError::NoHeading);
    }
    Ok(heading.map(|x| x / length))
}

pub(super) fn finite(name: &'static str, value: f64) -> Result<(), WaterError> {
    match value.is_finite() {
        true => Ok(()),
        false => Err(WaterError::NotFinite { name, value }),
    }
}

pub(super) fn positive(name: &'static str, value: f64) -> Result<(), WaterError> {
    match value > 0.0 && value.is_finite() {
        true => Ok(()),
        false => Err(WaterError::NotPositive { name, value }),
    }
}

pub(super) fn nonnegative(name: &'static str, value: f64) -> Result<(), WaterError> {
    match value >= 0.0 && value.is_finite() {
        true => Ok(()),
        false => Err(WaterError::Negative { name, value }),
    }
}
