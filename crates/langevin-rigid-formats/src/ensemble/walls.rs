//! The walls of a tank.

use langevin_rigid::State;

use crate::scene::Tank;

/// Keeps the centre of mass between the walls around the release at `origin`: a wall takes the
/// velocity into it and gives nothing back.
pub(super) fn hold(tank: &Tank, origin: [f64; 3], state: &mut State) {
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
