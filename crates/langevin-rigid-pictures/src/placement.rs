//! The placement of the body in the world.

use langevin_rigid::linalg::rotation_matrix;

use crate::vector::{Mat3, Vec3, add, mat_vec};
use langevin_rigid_formats::track::Pose;

/// Where the body is at one time: `world = position + rotation * body`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    pub position: Vec3,
    pub rotation: Mat3,
}

impl Placement {
    /// The placement of a pose whose quaternion has unit length.
    pub(super) fn of(pose: Pose) -> Self {
        Self {
            position: pose.position,
            rotation: rotation_matrix(pose.orientation),
        }
    }

    pub(super) fn to_world(self, body_point: Vec3) -> Vec3 {
        add(self.position, mat_vec(&self.rotation, body_point))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_quarter_turn_about_y_takes_x_to_minus_z() {
        let c = 0.5f64.sqrt();
        let turned = Placement::of(Pose {
            time: 0.0,
            position: [2.0, 0.0, 0.0],
            orientation: [0.0, c, 0.0, c],
        });
        let found = turned.to_world([1.0, 0.0, 0.0]);
        for (got, want) in found.iter().zip([2.0, 0.0, -1.0]) {
            assert!((got - want).abs() < 1e-15, "{found:?}");
        }
    }
}
