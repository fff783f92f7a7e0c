//! Gusts.

use std::f64::consts::{PI, TAU};

use fearless_simd::{Level, Simd, dispatch};

use super::{Local, WindError, finite, positive};
use crate::elementary::sin_cos_turns;
use crate::lanes::{Doubles, Lanes};
use crate::linalg::{
    Mat3, Vec3, cross, dot, lift, norm, quat_from_rotation_vector, rotation_matrix,
};
use crate::noise::NoiseStream;
use crate::real::Real;

/// Homogeneous isotropic turbulence of von Karman's spectrum.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct GustSettings {
    /// Root mean square of each component of the velocity (m/s): intensity times mean speed.
    pub rms: f64,
    /// Integral length scale along the wind (m): the size of the eddies that hold most of the energy.
    pub length: f64,
    /// Size of the smallest eddies (m); a fiftieth of `length` if none. What is smaller than a body averages out over it.
    pub smallest: Option<f64>,
    /// Velocity that carries the eddies (m/s), world frame: the mean wind.
    pub carried: Vec3,
    /// Which of all such fields.
    pub seed: u64,
}

impl Default for GustSettings {
    fn default() -> Self {
        Self {
            rms: 0.5,
            length: 1.0,
            smallest: None,
            carried: [0.0; 3],
            seed: 0,
        }
    }
}

/// A field of [`GustSettings`], made ready.
///
/// A sum of Fourier modes k with amplitudes across k, so that it has no divergence; random in phase and direction. Each mode
/// moves with what carries the gusts, and changes at the rate of its own eddies, (k^3 E(k))^(1/2) / 2 (Fung, Hunt, Malik &
/// Perkins 1992). The wave numbers are in shells, geometric from the largest to the smallest, and have the energy that von
/// Karman's E(k) ~ k^4 / (1 + (1.339 k L)^2)^(17/6) has there; the four directions in a shell are those of a tetrahedron,
/// which makes the stresses of each field isotropic.
///
/// ```
/// use langevin_rigid::wind::{GustSettings, Gusts};
/// let gusts = Gusts::new(&GustSettings { rms: 0.4, length: 2.0, ..GustSettings::default() })?;
/// assert_eq!(gusts.settings().length, 2.0);
/// # Ok::<(), langevin_rigid::wind::WindError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Gusts {
    settings: GustSettings,
    modes: Box<Modes>,
}

/// One Fourier mode: p cos(phase) + q sin(phase).
struct Mode {
    wave: Vec3,
    frequency: f64,
    p: Vec3,
    q: Vec3,
}

/// All of them, number by number: their sums go over every [`STRIDE`]th mode, then over those, so that one body takes
/// modes in lanes and many take bodies in lanes to the same bits.
#[derive(Debug, Clone, PartialEq)]
struct Modes {
    /// Turns of the phase over a metre.
    turns: [Column; 3],
    /// And over a second.
    turns_per_second: Column,
    /// Wave number (1/m).
    wave: [Column; 3],
    /// Angular frequency (1/s).
    frequency: Column,
    p: [Column; 3],
    q: [Column; 3],
}

type Column = [f64; MODES];

/// Shells of wave numbers, and directions in each.
const SHELLS: usize = 8;
const DIRECTIONS: usize = 4;
const MODES: usize = SHELLS * DIRECTIONS;
/// A multiple of the lanes of every processor.
const STRIDE: usize = 8;
/// The largest eddies, as a wave number times that of the spectrum's bend.
const LARGEST: f64 = 0.15;
/// Wave number of the bend times the integral length: Gamma(1/3) / (pi^(1/2) Gamma(5/6)).
const BEND: f64 = 1.339;
/// Frequency of a mode over that of its eddies.
const UNSTEADINESS: f64 = 0.5;

const NAME: &str = "gusts";

impl Gusts {
    /// Draws the field.
    ///
    /// # Errors
    /// [`WindError`].
    pub fn new(settings: &GustSettings) -> Result<Self, WindError> {
        let GustSettings {
            rms,
            length,
            carried,
            seed,
            ..
        } = *settings;
        finite(NAME, "rms", &[rms])?;
        if rms < 0.0 {
            let (field, name) = (NAME, "rms");
            return Err(WindError::NotPositive {
                field,
                name,
                value: rms,
            });
        }
        positive(NAME, "length", length)?;
        finite(NAME, "carrying velocity", &carried)?;
        let smallest = settings.smallest.unwrap_or(0.02 * length);
        positive(NAME, "smallest", smallest)?;
        if !(1e-4 * length..=length).contains(&smallest) {
            return Err(WindError::Eddies { smallest, length });
        }
        let bend = BEND * length;
        let [low, high] = [LARGEST, TAU * bend / smallest];
        let edge = |shell: usize| low * libm::pow(high / low, shell as f64 / SHELLS as f64);
        let spectrum = Spectrum::new(rms);
        let mut modes = Vec::with_capacity(MODES);
        for shell in 0..SHELLS {
            let [from, to] = [edge(shell), edge(shell + 1)];
            let end = if shell + 1 == SHELLS {
                f64::INFINITY
            } else {
                to
            };
            let start = if shell == 0 { 0.0 } else { from };
            let energy = spectrum.between(start, end);
            let mut dice = Dice::new(seed, shell);
            let turn = dice.rotation();
            for direction in TETRAHEDRON {
                let share = dice.uniform();
                let wave_number = spectrum.quantile(from, to, share) / bend;
                let towards = std::array::from_fn(|i| dot(turn[i], direction));
                let eddies = spectrum.rate(wave_number * bend, bend);
                let frequency = UNSTEADINESS * eddies * dice.normal();
                modes.push(Mode::new(
                    towards,
                    wave_number,
                    energy,
                    frequency,
                    carried,
                    &mut dice,
                ));
            }
        }
        Ok(Self {
            settings: *settings,
            modes: Box::new(Modes::new(&modes)),
        })
    }

    /// What it was made of.
    pub fn settings(&self) -> &GustSettings {
        &self.settings
    }

    /// At one place.
    pub(super) fn alone(&self, position: &Vec3, time: f64) -> Local<f64> {
        dispatch!(Level::new(), simd => self.over_modes::<_, Doubles<_>>(simd, position, time))
    }

    /// At one place, with modes in lanes.
    #[inline(always)]
    fn over_modes<S: Simd, L: Lanes<S, Scalar = f64>>(
        &self,
        simd: S,
        position: &Vec3,
        time: f64,
    ) -> Local<f64> {
        let time = L::splat(simd, time);
        let position = lift(time, position);
        let mut sums = [[0.0; STRIDE]; 15];
        for first in (0..STRIDE).step_by(L::COUNT) {
            let mut sum = Local::none(time);
            for start in (first..MODES).step_by(STRIDE) {
                self.modes.add(
                    &mut sum,
                    &position,
                    time,
                    #[inline(always)]
                    |column| L::load(simd, &column[start..start + L::COUNT]),
                );
            }
            for (value, sums) in sum.numbers().into_iter().zip(&mut sums) {
                value.store(&mut sums[first..first + L::COUNT]);
            }
        }
        Local::of_numbers(sums.map(|sums| sums.into_iter().fold(0.0, |sum, x| sum + x)))
    }

    /// At the places of bodies in lanes.
    #[inline(always)]
    pub(super) fn over_bodies<R: Real>(&self, position: &Vec3<R>, time: R) -> Local<R> {
        let mut total = Local::none(time);
        for first in 0..STRIDE {
            let mut sum = Local::none(time);
            for mode in (first..MODES).step_by(STRIDE) {
                self.modes.add(
                    &mut sum,
                    position,
                    time,
                    #[inline(always)]
                    |column| time.of(column[mode]),
                );
            }
            total.add(&sum);
        }
        total
    }
}

impl Modes {
    fn new(modes: &[Mode]) -> Self {
        let column = |of: &dyn Fn(&Mode) -> f64| -> Column {
            std::array::from_fn(|n| modes.get(n).map_or(0.0, of))
        };
        let columns =
            |of: fn(&Mode) -> Vec3| std::array::from_fn(|i| column(&|mode: &Mode| of(mode)[i]));
        Self {
            turns: columns(|mode| mode.wave.map(|k| k / TAU)),
            turns_per_second: column(&|mode| mode.frequency / TAU),
            wave: columns(|mode| mode.wave),
            frequency: column(&|mode| mode.frequency),
            p: columns(|mode| mode.p),
            q: columns(|mode| mode.q),
        }
    }

    /// Adds the modes that `of` takes out of the columns.
    #[inline(always)]
    fn add<R: Real>(
        &self,
        sum: &mut Local<R>,
        position: &Vec3<R>,
        time: R,
        of: impl Fn(&Column) -> R,
    ) {
        let [x, y, z] = *position;
        let [a, b, c] = &self.turns;
        let phase = of(a) * x + of(b) * y + of(c) * z + of(&self.turns_per_second) * time;
        let (sin, cos) = sin_cos_turns(phase);
        let frequency = of(&self.frequency);
        let wave = [of(&self.wave[0]), of(&self.wave[1]), of(&self.wave[2])];
        for i in 0..3 {
            let (p, q) = (of(&self.p[i]), of(&self.q[i]));
            sum.velocity[i] = sum.velocity[i] + (p * cos + q * sin);
            let slope = q * cos - p * sin;
            sum.rate[i] = sum.rate[i] + slope * frequency;
            for j in 0..3 {
                sum.gradient[i][j] = sum.gradient[i][j] + slope * wave[j];
            }
        }
    }
}

/// Corners of a tetrahedron, of unit length.
const TETRAHEDRON: [Vec3; DIRECTIONS] = {
    const A: f64 = 0.577_350_269_189_625_8;
    [[A, A, A], [A, -A, -A], [-A, A, -A], [-A, -A, A]]
};

impl Mode {
    /// One of those of a shell with this energy (m^2/s^2), half the square of the velocity.
    fn new(
        towards: Vec3,
        wave_number: f64,
        energy: f64,
        own: f64,
        carried: Vec3,
        dice: &mut Dice,
    ) -> Self {
        let wave = towards.map(|x| wave_number * x);
        let frequency = own - dot(wave, carried);
        // Two waves across, of equal amplitude, each at a phase of its own.
        let amplitude = (2.0 * energy / DIRECTIONS as f64).sqrt();
        let aside = if towards[0].abs() < 0.6 {
            [1.0, 0.0, 0.0]
        } else {
            [0.0, 1.0, 0.0]
        };
        let first = cross(towards, aside);
        let length = norm(first);
        let first = first.map(|x| x / length);
        let second = cross(towards, first);
        let [a, b] = [dice.angle(), dice.angle()];
        Self {
            wave,
            frequency,
            p: std::array::from_fn(|i| {
                amplitude * (first[i] * libm::cos(a) + second[i] * libm::cos(b))
            }),
            q: std::array::from_fn(|i| {
                -amplitude * (first[i] * libm::sin(a) + second[i] * libm::sin(b))
            }),
        }
    }
}

/// Von Karman's, over the wave number in units of that of its bend; its integral is 3/2 rms^2.
struct Spectrum {
    scale: f64,
}

impl Spectrum {
    fn new(rms: f64) -> Self {
        // B(5/2, 1/3)/2 is the integral of the shape.
        let whole = 0.5 * libm::tgamma(2.5) * libm::tgamma(1.0 / 3.0) / libm::tgamma(17.0 / 6.0);
        Self {
            scale: 1.5 * rms * rms / whole,
        }
    }

    fn at(&self, k: f64) -> f64 {
        self.scale * libm::pow(k, 4.0) * libm::pow(1.0 + k * k, -17.0 / 6.0)
    }

    /// Energy of the wave numbers between two (m^2/s^2).
    fn between(&self, from: f64, to: f64) -> f64 {
        // Below and above what is integrated the spectrum is a power law.
        let (low, high) = (1e-3, 1e4);
        let below = |k: f64| self.scale * libm::pow(k, 5.0) / 5.0;
        let above = |k: f64| 1.5 * self.scale * libm::pow(k, -2.0 / 3.0);
        let mut sum = 0.0;
        if from < low {
            sum += below(low.min(to)) - below(from);
        }
        if to > high {
            sum += above(high.max(from)) - if to.is_finite() { above(to) } else { 0.0 };
        }
        let [a, b] = [from.max(low), to.min(high)];
        if a < b {
            sum += self.middle(a, b);
        }
        sum
    }

    /// Simpson's rule over the logarithm.
    fn middle(&self, from: f64, to: f64) -> f64 {
        const PIECES: u32 = 64;
        let width = libm::log(to / from) / f64::from(2 * PIECES);
        let value = |n: u32| {
            let k = from * libm::exp(width * f64::from(n));
            k * self.at(k)
        };
        let of = |n: u32| value(2 * n) + 4.0 * value(2 * n + 1) + value(2 * n + 2);
        (0..PIECES).map(of).sum::<f64>() * width / 3.0
    }

    /// The wave number below which is this share of the energy between two.
    fn quantile(&self, from: f64, to: f64, share: f64) -> f64 {
        let wanted = share * self.middle(from, to);
        let (mut low, mut high) = (from, to);
        for _ in 0..40 {
            let k = (low * high).sqrt();
            if self.middle(from, k) < wanted {
                low = k;
            } else {
                high = k;
            }
        }
        (low * high).sqrt()
    }

    /// Rate of the eddies of a wave number (1/s), where the bend is at 1/`bend`.
    fn rate(&self, k: f64, bend: f64) -> f64 {
        (k * k * k * self.at(k)).sqrt() / bend
    }
}

/// Random numbers of a shell.
struct Dice {
    normals: Vec<f64>,
}

impl Dice {
    fn new(seed: u64, shell: usize) -> Self {
        // No body has this number.
        let stream = NoiseStream {
            seed,
            body: u32::MAX,
        };
        let steps = 4 * shell as u64..4 * (shell as u64 + 1);
        let normals = steps.flat_map(|step| stream.normals(step)).collect();
        Self { normals }
    }

    fn normal(&mut self) -> f64 {
        self.normals.pop().unwrap_or(0.0)
    }

    fn uniform(&mut self) -> f64 {
        0.5 + self.angle() / TAU
    }

    /// From -pi to pi.
    fn angle(&mut self) -> f64 {
        let (a, b) = (self.normal(), self.normal());
        libm::atan2(a, b).clamp(-PI, PI)
    }

    /// Uniform over all.
    fn rotation(&mut self) -> Mat3 {
        let q = [(); 4].map(|()| self.normal());
        let length = q.iter().map(|x| x * x).sum::<f64>().sqrt();
        if length > 0.0 {
            rotation_matrix(q.map(|x| x / length))
        } else {
            rotation_matrix(quat_from_rotation_vector([0.0; 3]))
        }
    }
}
