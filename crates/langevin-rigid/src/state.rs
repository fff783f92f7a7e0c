//! The state of one body.

use crate::linalg::{Quat, Vec3, Vec6, add, cross, rotate, rotate_back};

/// Pose and velocities of a body at a time.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct State {
    /// Time since release (s).
    pub time: f64,
    /// Steps taken since release; selects the noise of the next one.
    pub step: u64,
    /// Position x of the centre of mass, world frame (m).
    pub position: Vec3,
    /// Orientation as a unit quaternion `[x, y, z, w]`, body to world.
    pub orientation: Quat,
    /// Velocity v of the centre of mass, body frame (m/s).
    pub velocity: Vec3,
    /// Angular velocity omega, body frame (rad/s).
    pub angular_velocity: Vec3,
    /// Turbulence that the body sees under [`Model::Separated`](crate::Model::Separated), world frame: velocity and
    /// rotation rate of the fluid in units of their standard deviations.
    #[cfg_attr(feature = "serde", serde(default))]
    pub fluctuation: Vec6,
}

impl Default for State {
    /// At rest at the origin, body axes along the world's.
    fn default() -> Self {
        Self {
            time: 0.0,
            step: 0,
            position: [0.0; 3],
            orientation: [0.0, 0.0, 0.0, 1.0],
            velocity: [0.0; 3],
            angular_velocity: [0.0; 3],
            fluctuation: [0.0; 6],
        }
    }
}

impl State {
    /// Velocity of the centre of mass, world frame (m/s).
    #[inline]
    pub fn world_velocity(&self) -> Vec3 {
        rotate(self.orientation, self.velocity)
    }

    /// Angular velocity, world frame (rad/s).
    #[inline]
    pub fn world_angular_velocity(&self) -> Vec3 {
        rotate(self.orientation, self.angular_velocity)
    }

    /// Sets both velocities from the world frame (m/s, rad/s).
    #[inline]
    pub fn set_world_velocities(&mut self, velocity: Vec3, angular_velocity: Vec3) {
        self.velocity = rotate_back(self.orientation, velocity);
        self.angular_velocity = rotate_back(self.orientation, angular_velocity);
    }

    /// The same motion of the same material points, told from a centre of mass that lies by `offset`
    /// (body frame, m) from this one.
    ///
    /// For a body whose [mass properties change](crate::Body::with_mass_properties) under way.
    #[must_use]
    pub fn recentred(self, offset: Vec3) -> Self {
        Self {
            position: add(self.position, rotate(self.orientation, offset)),
            velocity: add(self.velocity, cross(self.angular_velocity, offset)),
            ..self
        }
    }

    /// Whether every number is finite.
    pub fn is_finite(&self) -> bool {
        let parts = [self.position, self.velocity, self.angular_velocity];
        self.time.is_finite()
            && parts
                .iter()
                .flatten()
                .chain(&self.orientation)
                .chain(&self.fluctuation)
                .all(|x| x.is_finite())
    }
}
