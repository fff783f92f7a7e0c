//! Between Rapier's types and ours.

use bevy_langevin_rigid::Motion;
use bevy_langevin_rigid::langevin_rigid::ContactMass;
use bevy_math::{DVec3, Mat3};
use bevy_rapier3d::dynamics::Velocity;
use bevy_rapier3d::rapier::dynamics::{MassProperties, RigidBody};
use bevy_rapier3d::rapier::math::Pose;
use bevy_transform::components::Transform;

/// How an entity has a body.
pub(crate) fn motion_of_entity(transform: &Transform, velocity: &Velocity) -> Motion {
    Motion {
        translation: transform.translation,
        rotation: transform.rotation,
        velocity: velocity.linear,
        angular_velocity: velocity.angular,
    }
}

/// How Rapier has a body; its velocity is that of the centre of mass.
pub(crate) fn motion(body: &RigidBody) -> Motion {
    let pose = body.position();
    Motion {
        translation: pose.translation,
        rotation: pose.rotation,
        velocity: body.linvel(),
        angular_velocity: body.angvel(),
    }
}

pub(crate) fn pose(motion: &Motion) -> Pose {
    Pose::from_parts(motion.translation, motion.rotation)
}

pub(crate) fn velocity(motion: &Motion) -> Velocity {
    Velocity {
        linear: motion.velocity,
        angular: motion.angular_velocity,
    }
}

pub(crate) fn mass(contact: &ContactMass, arm: DVec3) -> MassProperties {
    // Symmetric: rows are columns.
    let inertia = Mat3::from_cols_array_2d(&contact.inertia.map(|row| row.map(|x| x as f32)));
    MassProperties::with_inertia_matrix(arm.as_vec3(), contact.mass as f32, inertia)
}
