//! Between Avian's single precision and our double.

use avian3d::prelude::{AngularVelocity, LinearVelocity, Position, Rotation};
use bevy_langevin_rigid::langevin_rigid::State;
use bevy_math::{DQuat, DVec3};

/// Where the entity's frame is, whose centre of mass is `arm` (m) from its origin.
pub(crate) fn pose(state: &State, arm: DVec3) -> (Position, Rotation) {
    let orientation = DQuat::from_array(state.orientation);
    let origin = DVec3::from(state.position) - orientation * arm;
    (Position(origin.as_vec3()), Rotation(orientation.as_quat()))
}

/// Position and orientation of the centre of mass, for a [`State`].
pub(crate) fn centre(position: Position, rotation: Rotation, arm: DVec3) -> ([f64; 3], [f64; 4]) {
    let orientation = rotation.0.as_dquat().normalize();
    let centre = position.0.as_dvec3() + orientation * arm;
    (centre.to_array(), orientation.to_array())
}

pub(crate) fn velocity(v: [f64; 3]) -> LinearVelocity {
    LinearVelocity(DVec3::from(v).as_vec3())
}

pub(crate) fn spin(omega: [f64; 3]) -> AngularVelocity {
    AngularVelocity(DVec3::from(omega).as_vec3())
}
