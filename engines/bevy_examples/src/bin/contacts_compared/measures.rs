//! What is measured of a card that lands.

use bevy_langevin_rigid::langevin_rigid::linalg::vector::{norm, sub};
use bevy_langevin_rigid::langevin_rigid::{State, StepError, Stepper};

use crate::cards;

/// A card whose pose stays as near as this to its last one is at rest (m, rad).
const NEAR: f64 = 0.001;
const NEAR_TURN: f64 = 2.0 * std::f64::consts::PI / 180.0;
/// What two states may differ by where nothing was touched: rounding (m, m/s, rad/s).
const ROUNDING: f64 = 1e-9;

/// How cards are watched.
pub(crate) struct Watch<'a> {
    pub(crate) card: &'a Stepper,
    /// The step (s).
    pub(crate) dt: f64,
    /// Steps between two looks, so that ways and times are told alike of fine and of coarse steps.
    pub(crate) every: usize,
    /// For so many steps from the first touch.
    pub(crate) steps: usize,
}

/// How a card landed.
pub(crate) struct Landing {
    /// Number of the step in which it first touches.
    pub(crate) touch: usize,
    /// Largest difference from a card that meets nothing, before.
    pub(crate) astray: f64,
    /// Time (s) and horizontal way (m) from there to rest.
    pub(crate) seconds: f64,
    pub(crate) metres: f64,
    /// Kinetic energy of card and air after the first touch, over that without it.
    pub(crate) kept: f64,
    /// What later contacts add to it, in the same measure.
    pub(crate) added: f64,
    /// Deepest depth of a corner below the ground (m).
    pub(crate) depth: f64,
    /// How far up the upper face looks in the end: from one to minus one.
    pub(crate) upward: f64,
}

impl Watch<'_> {
    /// Watches a card of this number; `free` is how it falls where there is no ground. None if it does not touch, or the
    /// way is too short.
    pub(crate) fn landing(
        &self,
        number: usize,
        way: &[State],
        free: &[State],
    ) -> Result<Option<Landing>, StepError> {
        let apart: Vec<f64> = way.iter().zip(free).map(|(a, b)| distance(a, b)).collect();
        let Some(touch) = apart.iter().position(|apart| *apart > ROUNDING) else {
            return Ok(None);
        };
        let Some(watched) = way.get(touch..=touch + self.steps) else {
            return Ok(None);
        };
        let (poses, last) = self.until_rest(watched);
        let look = self.every - 1;
        let energy = self.card.kinetic_energy(&free[touch + look]);
        let depths = watched.iter().map(|state| -cards::lowest(state));
        Ok(Some(Landing {
            touch,
            astray: apart[..touch].iter().copied().fold(0.0, f64::max),
            seconds: (poses.len() - 1) as f64 * self.dt * self.every as f64,
            metres: poses.windows(2).map(|pair| aside(&pair[0], &pair[1])).sum(),
            kept: self.card.kinetic_energy(&watched[look]) / energy,
            added: self.added(number, watched)? / energy,
            depth: depths.fold(0.0, f64::max),
            upward: cards::upward(&last),
        }))
    }

    /// The poses from the first touch until the card rests, and the last of all.
    fn until_rest(&self, watched: &[State]) -> (Vec<State>, State) {
        let mut poses: Vec<State> = watched.iter().step_by(self.every).copied().collect();
        let last = poses[poses.len() - 1];
        let moves = |pose: &State| !is_near(pose, &last);
        let rest = poses.iter().rposition(moves).map_or(0, |pose| pose + 1);
        poses.truncate(rest + 1);
        (poses, last)
    }

    /// The sum of what contacts add to the kinetic energy after the first (J).
    fn added(&self, number: usize, watched: &[State]) -> Result<f64, StepError> {
        let mut sum = 0.0;
        for pair in watched.windows(2) {
            let mut free = pair[0];
            self.card.step(&mut free, self.dt, &cards::input(number))?;
            let gain = self.card.kinetic_energy(&pair[1]) - self.card.kinetic_energy(&free);
            sum += gain.max(0.0);
        }
        Ok(sum)
    }
}

/// The largest of the differences of two states in place and velocities; orientations differ with both.
fn distance(a: &State, b: &State) -> f64 {
    let parts = [
        sub(a.position, b.position),
        sub(a.world_velocity(), b.world_velocity()),
        sub(a.world_angular_velocity(), b.world_angular_velocity()),
    ];
    parts.into_iter().map(norm).fold(0.0, f64::max)
}

fn is_near(a: &State, b: &State) -> bool {
    let cosine: f64 = (0..4).map(|i| a.orientation[i] * b.orientation[i]).sum();
    let turn = 2.0 * cosine.abs().min(1.0).acos();
    norm(sub(a.position, b.position)) < NEAR && turn < NEAR_TURN
}

/// Horizontal way between two poses (m).
fn aside(a: &State, b: &State) -> f64 {
    let [x, _, z] = sub(b.position, a.position);
    x.hypot(z)
}
