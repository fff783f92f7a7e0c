//! What a body is immersed in.

use langevin_rigid::Fluid;

use crate::vector::lr_vec3;

/// A homogeneous fluid, at rest or in uniform steady motion.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct lr_fluid {
    /// Density (kg/m^3).
    pub density: f64,
    /// Kinematic viscosity (m^2/s).
    pub viscosity: f64,
    /// Uniform wind or current, world frame (m/s).
    pub velocity: lr_vec3,
}

/// Air at 20 degrees Celsius and sea level, at rest.
#[unsafe(no_mangle)]
pub extern "C" fn lr_fluid_air() -> lr_fluid {
    Fluid::AIR.into()
}

/// Fresh water at 20 degrees Celsius, at rest.
#[unsafe(no_mangle)]
pub extern "C" fn lr_fluid_water() -> lr_fluid {
    Fluid::WATER.into()
}

impl From<Fluid> for lr_fluid {
    fn from(fluid: Fluid) -> Self {
        Self {
            density: fluid.density,
            viscosity: fluid.viscosity,
            velocity: fluid.velocity.into(),
        }
    }
}

impl From<lr_fluid> for Fluid {
    fn from(fluid: lr_fluid) -> Self {
        Self {
            density: fluid.density,
            viscosity: fluid.viscosity,
            velocity: fluid.velocity.into(),
        }
    }
}
