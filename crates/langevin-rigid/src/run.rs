//! Running a body until the ground, until a time, or both.

use std::ops::ControlFlow;

use crate::linalg::{Vec3, dot, norm, rotate_back};
use crate::state::State;
use crate::stepper::StepError;

/// When a run ends: whichever comes first.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct StopAt {
    /// Time since release (s).
    pub time: Option<f64>,
    /// Height of the ground, world y (m): ends the run when the lowest point of the body is there.
    pub ground: Option<f64>,
}

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// The time was up.
    Time,
    /// The body touched the ground.
    Ground,
    /// All bodies had come to rest.
    Rest,
    /// The observer asked for it.
    Stopped,
}

/// The points of a body that can touch the ground.
#[derive(Debug, Clone)]
pub struct Hull {
    vertices: Vec<Vec3>,
    radius: f64,
}

impl Hull {
    /// From surface points in the body frame (m).
    pub fn new(vertices: &[Vec3]) -> Self {
        let radius = vertices.iter().map(|v| norm(*v)).fold(0.0, f64::max);
        Self {
            vertices: vertices.to_vec(),
            radius,
        }
    }

    /// World y of the lowest point (m); that of the centre of mass for a hull without points.
    pub fn lowest(&self, state: &State) -> f64 {
        let up = rotate_back(state.orientation, [0.0, 1.0, 0.0]);
        let drop = self
            .vertices
            .iter()
            .map(|v| dot(up, *v))
            .fold(f64::INFINITY, f64::min);
        state.position[1] + if drop.is_finite() { drop } else { 0.0 }
    }

    /// Whether the body reaches down to `height`.
    pub fn touches(&self, state: &State, height: f64) -> bool {
        state.position[1] - self.radius <= height && self.lowest(state) <= height
    }
}

/// Advances `state` by steps of `dt` (s) until `stop`, showing each new state to `observe`.
///
/// `advance` takes one step: [`Stepper::step`](crate::Stepper::step), and whatever else the body meets.
///
/// A run that starts at or below the ground ends at once.
///
/// # Errors
/// [`StepError`], with `state` and all that was observed kept; [`StepError::TimeStep`] where `dt` is not
/// positive.
pub fn run(
    mut advance: impl FnMut(&mut State) -> Result<(), StepError>,
    state: &mut State,
    dt: f64,
    hull: &Hull,
    stop: &StopAt,
    mut observe: impl FnMut(&State) -> ControlFlow<()>,
) -> Result<Ending, StepError> {
    if !(dt > 0.0 && dt.is_finite()) {
        return Err(StepError::TimeStep(dt));
    }
    loop {
        if stop
            .ground
            .is_some_and(|height| hull.touches(state, height))
        {
            return Ok(Ending::Ground);
        }
        // Half a step of slack: times are sums of steps.
        if stop.time.is_some_and(|end| state.time > end - 0.5 * dt) {
            return Ok(Ending::Time);
        }
        advance(state)?;
        if observe(state).is_break() {
            return Ok(Ending::Stopped);
        }
    }
}
