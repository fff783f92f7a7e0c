//! The fluid around all bodies.

use bevy_ecs::resource::Resource;
use langevin_rigid::wind::Wind;
use langevin_rigid::{Fluid, Settings};

/// What all bodies are immersed in, and how they move; a resource.
///
/// The default is air at 20 degrees Celsius under standard gravity. It may be changed at any time, and holds from the
/// next step.
///
/// ```
/// use bevy_langevin_rigid::ImmersionSettings;
/// use bevy_langevin_rigid::langevin_rigid::{Fluid, Model, Settings};
/// let under_water = ImmersionSettings {
///     fluid: Fluid::WATER,
///     motion: Settings { model: Model::Kirchhoff, gravity: [0.0, -1.62, 0.0], ..Settings::default() },
///     seed: 7,
/// };
/// ```
#[derive(Resource, Debug, Clone, Copy, PartialEq)]
pub struct ImmersionSettings {
    /// The fluid.
    pub fluid: Fluid,
    /// Model, gravity (world frame, m/s^2), integrator and source of turbulence.
    pub motion: Settings,
    /// Seed of the noise of all bodies; each has a stream of its own, by [`Immersed::number`](crate::Immersed::number).
    pub seed: u64,
}

impl Default for ImmersionSettings {
    fn default() -> Self {
        Self {
            fluid: Fluid::AIR,
            motion: Settings::default(),
            seed: 0,
        }
    }
}

/// Wind or current that varies in space and time, on top of [`Fluid::velocity`]; a resource, without wind by default.
///
/// Its clock is that of `Time<Fixed>`.
///
/// ```
/// use bevy_langevin_rigid::AmbientWind;
/// use bevy_langevin_rigid::langevin_rigid::wind::{Wind, WindField};
/// let mut wind = Wind::default();
/// wind.add(WindField::Uniform([1.0, 0.0, 0.0]))?;
/// let resource = AmbientWind(wind);
/// # Ok::<(), bevy_langevin_rigid::langevin_rigid::wind::WindError>(())
/// ```
#[derive(Resource, Debug, Clone, PartialEq, Default)]
pub struct AmbientWind(pub Wind);
