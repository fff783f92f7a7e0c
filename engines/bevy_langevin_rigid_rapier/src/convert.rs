//! Between Rapier's single precision and our double.

use bevy_langevin_rigid::langevin_rigid::{ContactMass, State};
use bevy_math::{DQuat, DVec3, Mat3};
use bevy_rapier3d::dynamics::Velocity;
use bevy_rapier3d::rapier::dynamics::MassProperties;
use bevy_rapier3d::rapier::math::Pose;

/// Where the entity's frame is, whose centre of mass is `arm` (m) from its origin.
pub(crate) fn pose(state: &State, arm: DVec3) -> Pose {
    let orientation = DQuat::from_array(state.orientation);
    let origin = DVec3::from(state.position) - orientation * arm;
    Pose::from_parts(origin.as_vec3(), orientation.as_quat())
}

/// Position and orientation of the centre of mass, for a [`State`].
pub(crate) fn centre(pose: &Pose, arm: DVec3) -> ([f64; 3], [f64; 4]) {
    let orientation = pose.rotation.as_dquat().normalize();
    let centre = pose.translation.as_dvec3() + orientation * arm;
    (centre.to_array(), orientation.to_array())
}

/// Velocity of the centre of mass, as Rapier's is, and angular velocity, both in the world frame.
pub(crate) fn velocity(linear: [f64; 3], angular: [f64; 3]) -> Velocity {
    Velocity {
        linear: DVec3::from(linear).as_vec3(),
        angular: DVec3::from(angular).as_vec3(),
    }
}

/// [`velocity`] of a state.
pub(crate) fn velocity_of(state: &State) -> Velocity {
    velocity(state.world_velocity(), state.world_angular_velocity())
}

pub(crate) fn mass(contact: &ContactMass, arm: DVec3) -> MassProperties {
    // Symmetric: rows are columns.
    let inertia = Mat3::from_cols_array_2d(&contact.inertia.map(|row| row.map(|x| x as f32)));
    MassProperties::with_inertia_matrix(arm.as_vec3(), contact.mass as f32, inertia)
}
