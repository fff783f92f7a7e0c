//! One step of a scene: the stepper's, and what else the body meets there.

use langevin_rigid::{Input, State, StepError};

use crate::prepared::{Prepared, Release};
use crate::scene::Scene;

/// Advances `state` by the scene's time step.
///
/// While it is [carried](crate::scene::Scene::carried) the body moves with its release velocity and does not turn. The wind
/// and what [steers](crate::scene::Scene::steering) it are as they are where and when the step begins. The walls of a
/// [tank](langevin_rigid::Tank), around the release, hold the centre of mass.
///
/// # Errors
/// Those of [`Stepper::step`](langevin_rigid::Stepper::step), with `state` as it was.
pub fn advance(prepared: &Prepared, release: &Release, state: &mut State) -> Result<(), StepError> {
    let scene = prepared.scene();
    if is_carried(scene, state) {
        state.carry(scene.time_step);
    } else {
        let input = input(prepared, release, state);
        prepared.stepper().step(state, scene.time_step, &input)?;
    }
    if let Some(tank) = &scene.tank {
        tank.hold(release.state.position, state);
    }
    Ok(())
}

/// What a body of the run meets in `state`: the wind where and when it is, what steers it, and its noise.
///
/// While it is [carried](crate::scene::Scene::carried) nothing of it moves the body.
pub fn input(prepared: &Prepared, release: &Release, state: &State) -> Input {
    blown(prepared, release, state, 0.0)
}

/// What a body meets, so much later (s) than by its own time.
pub(crate) fn blown(prepared: &Prepared, release: &Release, state: &State, later: f64) -> Input {
    let (wind, stream) = (prepared.wind(), prepared.scene().fluid.velocity);
    let mut input = Input::with_noise(release.noise);
    if !wind.is_empty() {
        input.flow = wind.flow(state.position, state.time + later, stream);
    }
    if let Some(steering) = &prepared.scene().steering {
        steering.push(state.time, &mut input.wrench);
    }
    input
}

/// Whether the body is not let go yet.
pub(crate) fn is_carried(scene: &Scene, state: &State) -> bool {
    // Half a step of slack: times are sums of steps.
    state.time < scene.carried - 0.5 * scene.time_step
}

#[cfg(test)]
mod tests {
    use langevin_rigid::NoiseStream;

    use super::*;

    #[test]
    fn a_carried_body_moves_on_a_line_until_it_is_let_go() {
        let text = r#"
            fluid.preset = "water"
            body = { shape = "coin", diameter = 0.02, thickness = 0.002, mass = 0.004 }
            run = { time_step = 0.001, duration = 1.0 }
            release = { velocity = [0.1, -0.3, 0.0], tilt = 20.0, carried = 0.05 }
        "#;
        let scene = Scene::parse("coin", "coin.toml", text).unwrap();
        let prepared = Prepared::new(scene, None, &()).unwrap();
        let scene = prepared.scene();
        let release = Release {
            state: scene.release,
            noise: NoiseStream::default(),
        };
        let mut state = release.state;
        for _ in 0..50 {
            advance(&prepared, &release, &mut state).unwrap();
        }
        assert_eq!(state.orientation, scene.release.orientation);
        assert_eq!(state.velocity, scene.release.velocity);
        for (x, wanted) in state.position.into_iter().zip([0.005, -0.015, 0.0]) {
            assert!((x - wanted).abs() < 1e-12, "{x} for {wanted}");
        }
        advance(&prepared, &release, &mut state).unwrap();
        assert_ne!(state.velocity, scene.release.velocity);
    }
}
