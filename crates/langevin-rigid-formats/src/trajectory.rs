//! Trajectories: where the bodies of a run went, as rows of a table.

mod table;

use langevin_rigid::State;
use langevin_rigid::linalg::Vec3;

use crate::track::Pose;
pub use table::{CSV_HEADER, TableError, csv, read_csv, write_csv};

/// Poses and velocities of one body in time order, world frame.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Trajectory {
    /// Number of the body, from 0.
    pub body: u32,
    /// Where it is (s, m; quaternion x, y, z, w).
    pub poses: Vec<Pose>,
    /// Velocity of the centre of mass at each pose (m/s).
    pub velocities: Vec<Vec3>,
    /// Angular velocity at each pose (rad/s).
    pub angular_velocities: Vec<Vec3>,
}

impl Trajectory {
    /// The trajectory through `states` of body number `body`.
    pub fn new(body: u32, states: &[State]) -> Self {
        Self {
            body,
            poses: states.iter().map(pose).collect(),
            velocities: states.iter().map(State::world_velocity).collect(),
            angular_velocities: states.iter().map(State::world_angular_velocity).collect(),
        }
    }

    /// How many poses it has.
    pub fn len(&self) -> usize {
        self.poses.len()
    }

    /// Whether it has no pose.
    pub fn is_empty(&self) -> bool {
        self.poses.is_empty()
    }
}

fn pose(state: &State) -> Pose {
    Pose {
        time: state.time,
        position: state.position,
        orientation: state.orientation,
    }
}
