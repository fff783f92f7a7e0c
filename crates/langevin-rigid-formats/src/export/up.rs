//! Worlds in which another axis points up.

use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

use langevin_rigid::{UnknownName, choose};

use crate::track::Pose;
use crate::trajectory::Trajectory;

/// Which axis of the world points up.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Up {
    /// +Y, as everywhere in this project.
    #[default]
    Y,
    /// +Z: the world turned by a right angle about x, so that what was -z is y.
    Z,
}

impl Up {
    /// A vector of the +Y-up world in this one.
    pub(super) fn vector(self, [x, y, z]: [f64; 3]) -> [f64; 3] {
        match self {
            Self::Y => [x, y, z],
            Self::Z => [x, -z, y],
        }
    }

    /// A body-to-world quaternion of the +Y-up world in this one: the body keeps its axes.
    fn orientation(self, [x, y, z, w]: [f64; 4]) -> [f64; 4] {
        let h = std::f64::consts::FRAC_1_SQRT_2;
        match self {
            Self::Y => [x, y, z, w],
            Self::Z => [h * (x + w), h * (y - z), h * (z + y), h * (w - x)],
        }
    }

    /// A trajectory of the +Y-up world in this one.
    pub(super) fn of(self, trajectory: &Trajectory) -> Cow<'_, Trajectory> {
        match self {
            Self::Y => Cow::Borrowed(trajectory),
            Self::Z => Cow::Owned(self.trajectory(trajectory)),
        }
    }

    fn trajectory(self, given: &Trajectory) -> Trajectory {
        let pose = |pose: &Pose| Pose {
            time: pose.time,
            position: self.vector(pose.position),
            orientation: self.orientation(pose.orientation),
        };
        let vectors = |list: &[[f64; 3]]| list.iter().map(|v| self.vector(*v)).collect();
        Trajectory {
            body: given.body,
            poses: given.poses.iter().map(pose).collect(),
            velocities: vectors(&given.velocities),
            angular_velocities: vectors(&given.angular_velocities),
        }
    }
}

impl fmt::Display for Up {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Y => "y",
            Self::Z => "z",
        })
    }
}

impl FromStr for Up {
    type Err = UnknownName;

    fn from_str(name: &str) -> Result<Self, UnknownName> {
        let choices = [("y", Self::Y), ("z", Self::Z)];
        choose("axis that may point up", &name.to_lowercase(), choices)
    }
}

#[cfg(test)]
mod tests {
    use langevin_rigid::linalg::rotate;

    use super::*;

    #[test]
    fn up_stays_up_and_bodies_turn_with_the_world() {
        assert_eq!(Up::Z.vector([0.0, 1.0, 0.0]), [0.0, 0.0, 1.0]);
        let (q, point) = ([0.1, -0.5, 0.7, 0.5], [0.3, 0.2, -0.9]);
        let turned_after = Up::Z.vector(rotate(q, point));
        let turned_before = rotate(Up::Z.orientation(q), point);
        for (a, b) in turned_after.iter().zip(turned_before) {
            assert!((a - b).abs() < 1e-15, "{turned_after:?} {turned_before:?}");
        }
    }
}
