//! The fall of a body that meets what stands in its way, until it lies still.

use langevin_rigid::State;
use langevin_rigid::linalg::{Vec3, rotate};
use serde::{Deserialize, Serialize};

use super::fall::{APART, Drawn, Fall, FallEnding, Watched, relative};
use crate::lanes::Watch;
use crate::prepared::Prepared;
use crate::scene::MAX_STEPS;
use crate::together::Surroundings;

/// How near the ground is touched, in radii of the body: contacts keep a smaller gap.
const TOUCH: f64 = 2e-3;

/// Where and how a body came to rest.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Lying {
    /// When (s).
    pub time: f64,
    /// Where its centre of mass is, in the coordinates of [`Fall::end`] (m).
    pub place: [f64; 3],
    /// The world's up in its thin axis: 1 face up, -1 face down, 0 on its edge.
    pub up: f64,
}

/// A run in the world of the scene.
pub(super) fn fall_in_world(
    prepared: &Prepared,
    surroundings: &Surroundings,
    thin_axis: Vec3,
    drawn: &Drawn,
) -> Fall {
    let scene = prepared.scene();
    let mut state = drawn.draw.release;
    let mut watch = Watched::new(scene, thin_axis, &state);
    while state.time < scene.carried - 0.5 * scene.time_step {
        let before = state;
        state.carry(scene.time_step);
        watch.see(&before, &state);
    }
    let kind = surroundings.own_kind();
    let slack = TOUCH * kind.shape().radius();
    let mut world = surroundings.world().clone();
    let apart = APART * f64::from(drawn.run);
    world.set_time(apart + state.time);
    let body = world.add(kind, state, drawn.noise(scene));
    // By its own clock.
    let own = |world: &langevin_rigid_world::World| State {
        time: world.state(body).time - apart,
        ..*world.state(body)
    };
    let mut landed = None;
    let ending = loop {
        let before = own(&world);
        let late = |end: f64| before.time > end - 0.5 * scene.time_step;
        if scene.stop.time.is_some_and(late) || before.step >= MAX_STEPS {
            break FallEnding::Time;
        }
        if world.is_still(body) {
            break FallEnding::Rest;
        }
        if let Err(error) = world.step(scene.time_step) {
            break FallEnding::Diverged(error.error.to_string());
        }
        let state = own(&world);
        if landed.is_none() {
            watch.see(&before, &state);
            let touches = |y: f64| prepared.hull().touches(&state, y + slack);
            landed = scene.stop.ground.is_some_and(touches).then_some(state);
        }
    };
    let last = own(&world);
    let lying = matches!(ending, FallEnding::Rest).then(|| Lying {
        time: last.time,
        place: relative(last.position, scene.release.position),
        up: rotate(last.orientation, thin_axis)[1],
    });
    let ending = match (&landed, ending) {
        (_, FallEnding::Diverged(words)) => FallEnding::Diverged(words),
        (Some(_), _) => FallEnding::Ground,
        (None, ending) => ending,
    };
    Fall {
        lying,
        ..watch.ended(drawn, &landed.unwrap_or(last), ending)
    }
}
