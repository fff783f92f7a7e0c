//! What a command will take, told and checked before it begins.

use anyhow::Result;
use langevin_rigid::Body;
use langevin_rigid_formats::budget::{self, Need};
use langevin_rigid_scenes::baking::characteristic_speed;
use langevin_rigid_scenes::prepared::STATE_MEMORY;
use langevin_rigid_scenes::scene::Scene;

use crate::say;

/// What takes more is told.
const WORTH_A_WORD: Need = Need {
    bytes: 1_000_000_000,
    steps: 1_000_000_000,
};

/// Memory of a frame of a body in an animation.
const FRAME: usize = 80;

/// Refuses what cannot be, and tells what will take long. `what` names the options.
pub(crate) fn check(need: Need, what: &str) -> Result<()> {
    budget::check(need, what)?;
    if need.bytes > WORTH_A_WORD.bytes || need.steps > WORTH_A_WORD.steps {
        say::note(format!("{what} will take about {need} of memory"));
    }
    Ok(())
}

/// About how long a body of the scene falls (s); zero if there is no telling.
pub(crate) fn seconds(scene: &Scene, body: &Body) -> f64 {
    let release = scene.release.position[1];
    let floor = scene.tank.map(|tank| tank.floor(scene.release.position));
    let way = match (scene.stop.ground, floor) {
        (Some(ground), Some(floor)) => Some(release - ground.max(floor)),
        (ground, floor) => ground.or(floor).map(|height| release - height),
    };
    let by_way = way.map_or(f64::INFINITY, |way| way / characteristic_speed(scene, body));
    let seconds = by_way.min(scene.stop.time.unwrap_or(f64::INFINITY));
    if seconds.is_finite() { seconds } else { 0.0 }
}

/// What it takes to keep so many bodies for so long (s), in so many frames a second if they are animated.
pub(crate) fn kept(bodies: u32, seconds: f64, time_step: f64, fps: Option<f64>) -> Need {
    let bodies = f64::from(bodies);
    let steps = bodies * (seconds / time_step).ceil().max(1.0);
    let frames = bodies * seconds * fps.unwrap_or(0.0);
    Need::new(steps * STATE_MEMORY as f64 + frames * FRAME as f64, steps)
}
