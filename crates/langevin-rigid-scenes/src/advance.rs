//! One step of a scene: the stepper's, and what else the body meets there.

use langevin_rigid::{State, StepError, Stepper};

use crate::prepared::Release;
use crate::scene::{Scene, Tank};

/// Advances `state` by the scene's time step.
///
/// While it is [carried](Scene::carried) the body moves with its release velocity and does not turn.
/// The walls of a tank, around the release, hold the centre of mass: where it would pass one it stays at it, and loses the
/// component of its velocity into the wall.
///
/// # Errors
/// Those of [`Stepper::step`], with `state` as it was.
pub fn advance(
    scene: &Scene,
    stepper: &Stepper,
    release: &Release,
    state: &mut State,
) -> Result<(), StepError> {
    if is_carried(scene, state) {
        carry(state, scene.time_step);
    } else {
        stepper.step(state, scene.time_step, &release.noise.into())?;
    }
    if let Some(tank) = &scene.tank {
        hold(tank, release.state.position, state);
    }
    Ok(())
}

/// Whether the body is not let go yet.
pub(crate) fn is_carried(scene: &Scene, state: &State) -> bool {
    // Half a step of slack: times are sums of steps.
    state.time < scene.carried - 0.5 * scene.time_step
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
pub(crate) fn hold(tank: &Tank, origin: [f64; 3], state: &mut State) {
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

#[cfg(test)]
mod tests {
    use langevin_rigid::NoiseStream;
    use langevin_rigid::linalg::quat_from_rotation_vector;

    use super::*;
    use crate::baking;

    #[test]
    fn a_wall_takes_only_the_velocity_into_it() {
        let mut state = State {
            position: [0.3, 0.0, 0.0],
            orientation: quat_from_rotation_vector([0.3, 0.4, 0.5]),
            ..State::default()
        };
        state.set_world_velocities([2.0, -1.0, 0.5], [1.0, 2.0, 3.0]);
        let tank = Tank {
            size: [0.4, 1.0, 0.4],
        };
        let close = |a: [f64; 3], b: [f64; 3]| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-14);
        hold(&tank, [0.0; 3], &mut state);
        assert_eq!(state.position, [0.2, 0.0, 0.0]);
        assert!(close(state.world_velocity(), [0.0, -1.0, 0.5]));
        assert!(close(state.world_angular_velocity(), [1.0, 2.0, 3.0]));
        // On its way back nothing is taken.
        state.position[0] = 0.3;
        state.set_world_velocities([-2.0, 0.0, 0.0], [0.0; 3]);
        hold(&tank, [0.0; 3], &mut state);
        assert!(close(state.world_velocity(), [-2.0, 0.0, 0.0]));
    }

    #[test]
    fn a_carried_body_moves_on_a_line_until_it_is_let_go() {
        let text = r#"
            fluid.preset = "water"
            body = { shape = "coin", diameter = 0.02, thickness = 0.002, mass = 0.004 }
            run = { time_step = 0.001, duration = 1.0 }
            release = { velocity = [0.1, -0.3, 0.0], tilt = 20.0, carried = 0.05 }
        "#;
        let scene = Scene::parse("coin", "coin.toml", text).unwrap();
        let bake = baking::bake_scene(&scene, None, &()).unwrap().bake;
        let stepper = baking::stepper(&scene, &bake).unwrap();
        let release = Release {
            state: scene.release,
            noise: NoiseStream::default(),
        };
        let mut state = release.state;
        for _ in 0..50 {
            advance(&scene, &stepper, &release, &mut state).unwrap();
        }
        assert_eq!(state.orientation, scene.release.orientation);
        assert_eq!(state.velocity, scene.release.velocity);
        for (x, wanted) in state.position.into_iter().zip([0.005, -0.015, 0.0]) {
            assert!((x - wanted).abs() < 1e-12, "{x} for {wanted}");
        }
        advance(&scene, &stepper, &release, &mut state).unwrap();
        assert_ne!(state.velocity, scene.release.velocity);
    }
}
