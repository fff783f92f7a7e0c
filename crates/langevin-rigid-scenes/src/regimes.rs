//! The regimes of falling plates: what the model `separated` does, and what experiments found.
//!
//! A grid of discs and strips over Reynolds number and dimensionless inertia I* is released at several tilts; each fall
//! is classified by itself, and each point of the grid compared with the published map.

mod fall;
mod map;
mod plates;
mod published;
mod survey;

pub use fall::{Case, Run, run};
pub use map::regime_map;
pub use plates::{Plate, broadside_speed, stepper};
pub use published::{Boundary, Measured, Published, UNCERTAINTY};
pub use survey::{Agreement, Point, REYNOLDS, TILTS, cases, csv, inertia_ratios, points};
