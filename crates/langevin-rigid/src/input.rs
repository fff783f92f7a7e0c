//! What a step takes in besides the state: the fluid around the body, and what acts on it from outside.

use crate::linalg::{Mat3, Vec3};
use crate::noise::NoiseStream;
use crate::real::Real;

/// What acts on a body over one step. The default is fluid at rest, no wrench, and the first noise stream of seed 0.
///
/// ```
/// use langevin_rigid::{Body, Flow, Fluid, Input, Settings, State, Stepper, Wrench};
/// let disc = Body::disc(0.05, 0.001, 500.0)?;
/// let stepper = Stepper::new(&disc, &Fluid::AIR, None, &Settings::default())?;
/// let mut state = State::default();
/// for step in 0..100 {
///     let wind = 0.5 * (0.1 * f64::from(step)).sin();
///     let input = Input {
///         flow: Flow::uniform([wind, 0.0, 0.0]),
///         wrench: Wrench { force: [0.0, 0.01, 0.0], ..Wrench::default() },
///         ..Input::default()
///     };
///     stepper.step(&mut state, 1e-2, &input)?;
/// }
/// assert!(state.position[0] != 0.0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Input {
    /// The undisturbed fluid at the body.
    pub flow: Flow,
    /// What else acts on the body: contacts, strings, thrusters.
    pub wrench: Wrench,
    /// The noise of the body.
    pub noise: NoiseStream,
}

/// The fluid around a body as it would be without it, on top of [`Fluid::velocity`](crate::Fluid::velocity).
///
/// The fluid pushes with (rho V + A) Du/Dt where it accelerates, so a wind that changes in time must say so in
/// `acceleration`: a velocity that jumps from one step to the next passes by the added mass.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Flow {
    /// Velocity u at the centre of mass, world frame (m/s).
    pub velocity: Vec3,
    /// `gradient[i][j]` is du_i/dx_j at the centre of mass, world frame (1/s).
    ///
    /// Half its curl is the rate at which the fluid turns, relative to which a spin is resisted; the slices of a long
    /// body see u at their own centres. The added mass answers to the velocity alone.
    pub gradient: Mat3,
    /// Material acceleration Du/Dt at the centre of mass, world frame (m/s^2).
    pub acceleration: Vec3,
}

/// A force and a torque.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[cfg_attr(feature = "serde", serde(default, deny_unknown_fields))]
pub struct Wrench {
    /// Force, world frame (N).
    pub force: Vec3,
    /// Torque about the centre of mass, world frame (N m).
    pub torque: Vec3,
}

impl Input {
    /// Fluid at rest, no wrench, and this noise.
    pub fn with_noise(noise: NoiseStream) -> Self {
        Self {
            noise,
            ..Self::default()
        }
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        let Flow {
            velocity,
            gradient: [x, y, z],
            acceleration,
        } = self.flow;
        let Wrench { force, torque } = self.wrench;
        [velocity, x, y, z, acceleration, force, torque]
            .as_flattened()
            .iter()
            .all(|x| x.is_finite())
    }
}

impl From<NoiseStream> for Input {
    fn from(noise: NoiseStream) -> Self {
        Self::with_noise(noise)
    }
}

impl Flow {
    /// The same velocity everywhere (m/s), world frame.
    pub fn uniform(velocity: Vec3) -> Self {
        Self {
            velocity,
            ..Self::default()
        }
    }

    /// A fluid that turns like a rigid body: `velocity` at the centre of mass (m/s), `rotation_rate` (rad/s), world frame.
    pub fn turning(velocity: Vec3, rotation_rate: Vec3) -> Self {
        let [x, y, z] = rotation_rate;
        Self {
            velocity,
            gradient: [[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]],
            acceleration: [0.0; 3],
        }
    }

    /// Rate at which the fluid turns, half its vorticity, world frame (rad/s).
    pub fn rotation_rate(&self) -> Vec3 {
        rotation_rate(&self.gradient)
    }
}

/// Half the curl of a field with this gradient.
#[inline(always)]
pub(crate) fn rotation_rate<R: Real>(gradient: &Mat3<R>) -> Vec3<R> {
    let half = gradient[0][0].of(0.5);
    [
        half * (gradient[2][1] - gradient[1][2]),
        half * (gradient[0][2] - gradient[2][0]),
        half * (gradient[1][0] - gradient[0][1]),
    ]
}

/// An [`Input`] without its noise, of one body or of the bodies in lanes.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Forcing<R = f64> {
    pub(crate) velocity: Vec3<R>,
    /// None where the fluid neither turns nor strains, which spares a step much arithmetic.
    pub(crate) gradient: Option<Mat3<R>>,
    pub(crate) acceleration: Vec3<R>,
    pub(crate) force: Vec3<R>,
    pub(crate) torque: Vec3<R>,
}

impl Forcing {
    /// None where nothing acts, for the same bits as without an input.
    pub(crate) fn of(input: &Input) -> Option<Self> {
        let Input { flow, wrench, .. } = input;
        let acts = *flow != Flow::default() || *wrench != Wrench::default();
        acts.then(|| Self {
            velocity: flow.velocity,
            gradient: (flow.gradient != Mat3::default()).then_some(flow.gradient),
            acceleration: flow.acceleration,
            force: wrench.force,
            torque: wrench.torque,
        })
    }
}
