//! The regimes of falling plates: what the model `separated` does, and what experiments found.
//!
//! A grid of discs and strips over Reynolds number and dimensionless inertia I* is dropped from
//! several tilts; each fall is classified by itself, and each point of the grid compared with the
//! published map.

mod map;
mod plates;
mod published;
mod survey;

pub use map::regime_map;
pub use plates::{Plate, terminal_speed};
pub use published::{Boundary, Measured, Published, UNCERTAINTY};
pub use survey::{
    Agreement, Case, Point, REYNOLDS, Run, TILTS, cases, csv, inertia_ratios, points, run,
};
