//! Water with a surface, calm or in waves: bodies fall in, float, drift and come out again.
//!
//! A [`WaterSurface`] says where the surface is and how the water under it moves. A [`FloatingHull`] says exactly what of
//! a body is below it. An [`Immersion`] is a body made ready to step between the two fluids:
//!
//! ```
//! use langevin_rigid::{Body, Fluid, Input, Settings, State};
//! use langevin_rigid_world::water::{Immersion, WaterSurface};
//! // A block of wood, let go above water.
//! let block = Body::cuboid([0.2, 0.05, 0.1], 600.0)?;
//! let immersion = Immersion::new(&block, (&Fluid::AIR, None), (&Fluid::WATER, None), &Settings::default())?;
//! let water = WaterSurface::calm(0.0)?;
//! let mut state = State { position: [0.0, 0.1, 0.0], ..State::default() };
//! for _ in 0..4000 {
//!     immersion.step(&mut state, 5e-3, &Input::default(), &water)?;
//! }
//! // It floats, six tenths of it in the water.
//! assert!((immersion.share(&state, &water) - 0.6).abs() < 0.01);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod hull;
mod immersion;
mod radiation;
mod rungs;
mod sea;
mod surface;

pub use hull::{FloatingHull, HullError, Submerged};
pub use immersion::{Immersion, ImmersionError};
pub use sea::Sea;
pub use surface::{Plane, WaterError, WaterSurface, Wave};

#[cfg(test)]
mod tests;
