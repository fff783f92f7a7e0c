//! Contacts: where shapes are close, and the impulses that keep them apart.

pub(crate) mod island;
pub(crate) mod narrow;
mod overlap;
pub(crate) mod solver;

use arrayvec::ArrayVec;
use parry3d_f64::math::Vector;

/// Points of one contact at most.
pub(crate) const MOST_POINTS: usize = 8;

/// Where two hulls are close.
#[derive(Debug, Clone)]
pub(crate) struct Patch {
    /// From the first to the second, world frame.
    pub(crate) normal: Vector,
    /// Its points.
    pub(crate) points: ArrayVec<Point, MOST_POINTS>,
}

/// A pair of points that face each other, world frame (m).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Point {
    pub(crate) on_a: Vector,
    pub(crate) on_b: Vector,
    /// Their distance along the normal, negative inside each other.
    pub(crate) gap: f64,
}
