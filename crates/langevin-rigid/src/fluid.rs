//! The fluid around the body and what fills the world.

use crate::linalg::Vec3;

/// A homogeneous fluid, at rest or in uniform steady motion.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Fluid {
    /// Density rho_f (kg/m^3).
    pub density: f64,
    /// Kinematic viscosity nu (m^2/s).
    pub viscosity: f64,
    /// Uniform wind or current, world frame (m/s).
    pub velocity: Vec3,
}

impl Fluid {
    /// Air at 20 degrees Celsius and sea level.
    pub const AIR: Self = Self {
        density: 1.204,
        viscosity: 1.516e-5,
        velocity: [0.0; 3],
    };
    /// Fresh water at 20 degrees Celsius.
    pub const WATER: Self = Self {
        density: 998.2,
        viscosity: 1.004e-6,
        velocity: [0.0; 3],
    };
}

/// Standard gravity, downwards in the +Y-up world frame (m/s^2).
pub const GRAVITY: Vec3 = [0.0, -9.81, 0.0];
