//! What a body meets besides its fluid: the walls of a tank, the hand that lets it go.

use crate::linalg::Vec3;
use crate::state::State;

/// A tank of water, below and around the place where a body is let go: there the surface is, over the middle.
///
/// ```
/// use langevin_rigid::{State, Tank};
/// let tank = Tank { size: [0.4, 1.0, 0.4] };
/// let mut state = State { position: [0.3, -0.5, 0.0], velocity: [2.0, -1.0, 0.0], ..State::default() };
/// tank.hold([0.0; 3], &mut state);
/// assert_eq!(state.position, [0.2, -0.5, 0.0]);
/// assert_eq!(state.velocity, [0.0, -1.0, 0.0]);
/// assert_eq!(tank.floor([0.0; 3]), -1.0);
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Tank {
    /// Width along x, depth of the water, width along z (m).
    pub size: Vec3,
}

impl Tank {
    /// World y of the floor (m) for a release at `origin` (m).
    pub fn floor(&self, origin: Vec3) -> f64 {
        origin[1] - self.size[1]
    }

    /// Keeps the centre of mass between the walls around a release at `origin` (m): where it has passed one it stays at
    /// it, and loses the component of its velocity into the wall.
    pub fn hold(&self, origin: Vec3, state: &mut State) {
        for axis in [0, 2] {
            let away = state.position[axis] - origin[axis];
            let half = 0.5 * self.size[axis];
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
}

impl State {
    /// Moves on with its velocity for `dt` (s) without turning, as a body does that is held and carried along.
    pub fn carry(&mut self, dt: f64) {
        let velocity = self.world_velocity();
        for (x, v) in self.position.iter_mut().zip(velocity) {
            *x += v * dt;
        }
        self.time += dt;
        self.step += 1;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linalg::quat_from_rotation_vector;

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
        let close = |a: Vec3, b: Vec3| (0..3).all(|i| (a[i] - b[i]).abs() < 1e-14);
        tank.hold([0.0; 3], &mut state);
        assert_eq!(state.position, [0.2, 0.0, 0.0]);
        assert!(close(state.world_velocity(), [0.0, -1.0, 0.5]));
        assert!(close(state.world_angular_velocity(), [1.0, 2.0, 3.0]));
        // On its way back nothing is taken.
        state.position[0] = 0.3;
        state.set_world_velocities([-2.0, 0.0, 0.0], [0.0; 3]);
        tank.hold([0.0; 3], &mut state);
        assert!(close(state.world_velocity(), [-2.0, 0.0, 0.0]));
    }
}
