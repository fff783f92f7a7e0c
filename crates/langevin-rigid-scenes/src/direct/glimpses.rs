//! What is kept of a fall to judge it by.

use langevin_rigid::State;
use langevin_rigid::linalg::vector::{add, scale, sub};
use langevin_rigid::linalg::{Vec3, rotate};

use crate::ensemble::{SAMPLES_PER_SECOND, thin_axis};
use crate::lanes::Watch;
use crate::prepared::Prepared;

/// A body at a moment.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Glimpse {
    /// Time since the release (s).
    pub(super) time: f64,
    /// Centre of mass, world frame (m).
    pub(super) position: Vec3,
    /// Thin axis, world frame.
    pub(super) axis: Vec3,
    /// How far the body has turned about the vertical (rad).
    pub(super) heading: f64,
}

/// A body about every sixtieth of a second.
pub(super) struct Glimpses {
    pub(super) seen: Vec<Glimpse>,
    /// Body frame; its largest component is positive, so that +Y is up for plates.
    axis: Vec3,
    heading: f64,
}

impl Glimpses {
    pub(super) fn new(prepared: &Prepared, release: &State) -> Self {
        let axis = thin_axis(prepared.body());
        let largest = axis.into_iter().max_by(|a, b| a.abs().total_cmp(&b.abs()));
        let mut glimpses = Self {
            seen: Vec::new(),
            axis: scale(1f64.copysign(largest.unwrap_or(1.0)), axis),
            heading: 0.0,
        };
        glimpses.seen.push(glimpses.of(release));
        glimpses
    }

    pub(super) fn of(&self, state: &State) -> Glimpse {
        Glimpse {
            time: state.time,
            position: state.position,
            axis: rotate(state.orientation, self.axis),
            heading: self.heading,
        }
    }
}

impl Watch for Glimpses {
    fn see(&mut self, before: &State, after: &State) {
        self.heading += (after.time - before.time) * after.world_angular_velocity()[1];
        let due = self.seen.len() as f64 / f64::from(SAMPLES_PER_SECOND);
        if after.time >= due {
            self.seen.push(self.of(after));
        }
    }
}

/// Where the body was at a time, on the line between two glimpses.
pub(super) fn position_at(glimpses: &[Glimpse], time: f64) -> Vec3 {
    let next = glimpses.partition_point(|glimpse| glimpse.time <= time);
    match (glimpses.get(next.wrapping_sub(1)), glimpses.get(next)) {
        (Some(from), Some(to)) => {
            let part = (time - from.time) / (to.time - from.time);
            add(from.position, scale(part, sub(to.position, from.position)))
        }
        (Some(only), None) | (None, Some(only)) => only.position,
        (None, None) => [0.0; 3],
    }
}
