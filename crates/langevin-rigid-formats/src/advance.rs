//! One step of a scene: the stepper's, and what else the body meets there.

use langevin_rigid::{NoiseStream, State, StepError, Stepper};

use crate::scene::{Scene, Tank};

/// Advances `state` by the scene's time step.
///
/// While it is [carried](Scene::carried) the body moves with its release velocity and does not turn.
/// The walls of a tank hold the centre of mass: where it would pass one it stays at it, and loses the
/// component of its velocity into the wall.
///
/// # Errors
/// Those of [`Stepper::step`], with `state` as it was.
pub fn advance(
    scene: &Scene,
    stepper: &Stepper,
    state: &mut State,
    noise: &NoiseStream,
) -> Result<(), StepError> {
    let dt = scene.time_step;
    // Half a step of slack: times are sums of steps.
    if state.time < scene.carried - 0.5 * dt {
        carry(state, dt);
    } else {
        stepper.step(state, dt, noise)?;
    }
    if let Some(tank) = &scene.tank {
        hold(tank, scene.release.position, state);
    }
    Ok(())
}

fn carry(state: &mut State, dt: f64) {
    let velocity = state.world_velocity();
    for (x, v) in state.position.iter_mut().zip(velocity) {
        *x += v * dt;
    }
    state.time += dt;
    state.step += 1;
}

/// Keeps the centre of mass between the walls around the release at `origin`.
fn hold(tank: &Tank, origin: [f64; 3], state: &mut State) {
    for axis in [0, 2] {
        let away = state.position[axis] - origin[axis];
        let half = 0.5 * tank.size[axis];
        if away.abs() <= half {
            continue;
        }
        state.position[axis] = origin[axis] + half.copysign(away);
        let (mut velocity, spin) = (state.world_velocity(), state.world_angular_velocity());
        if velocity[axis] * away > 0.0 {
            velocity[axis] = 0.0;
            state.set_world_velocities(velocity, spin);
        }
    }
}
