//! Free fall of a body that could not be made.

use bevy_math::DQuat;
use langevin_rigid::State;
use langevin_rigid::linalg::{Vec3, quat_from_rotation_vector};

/// Advances `state` by `dt` (s) under gravity alone (m/s^2), turning about its axis as it does.
pub(crate) fn fall(state: &mut State, gravity: Vec3, dt: f64) {
    let velocity = state.world_velocity();
    let spin = state.world_angular_velocity();
    let turn = DQuat::from_array(quat_from_rotation_vector(spin.map(|w| dt * w)));
    let orientation = turn * DQuat::from_array(state.orientation);
    state.orientation = orientation.normalize().to_array();
    for i in 0..3 {
        state.position[i] += dt * (velocity[i] + 0.5 * dt * gravity[i]);
    }
    let velocity = std::array::from_fn(|i| velocity[i] + dt * gravity[i]);
    state.set_world_velocities(velocity, spin);
    state.time += dt;
    state.step = state.step.wrapping_add(1);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_throw_is_a_parabola_and_keeps_its_spin() {
        let mut state = State::default();
        state.set_world_velocities([1.0, 2.0, 0.0], [0.0, 0.0, 3.0]);
        for _ in 0..64 {
            fall(&mut state, [0.0, -9.81, 0.0], 1.0 / 64.0);
        }
        let [x, y, _] = state.position;
        assert!((x - 1.0).abs() < 1e-12 && (y - (2.0 - 0.5 * 9.81)).abs() < 1e-12);
        assert!((state.world_angular_velocity()[2] - 3.0).abs() < 1e-12);
        // Three radians about z.
        assert!((state.orientation[2] - 1.5_f64.sin()).abs() < 1e-12);
    }
}
