//! From the fluid to Rapier and back.

use bevy_ecs::entity::Entity;
use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::query::{Has, Or, With, Without};
use bevy_ecs::system::{Commands, Query, Res};
use bevy_langevin_rigid::{Handed, Hosted, Motion, Quarantined, Sleepers, Stepped};
use bevy_log::error;
use bevy_math::Vec3;
use bevy_rapier3d::dynamics::{
    RapierRigidBodyHandle, RigidBody, RigidBodyDisabled, Sleeping, SoftCcd, Velocity,
};
use bevy_rapier3d::plugin::context::{
    RapierContextColliders, RapierContextEntityLink, RapierContextSimulation, RapierRigidBodySet,
};
use bevy_rapier3d::rapier;
use bevy_rapier3d::rapier::geometry::{ColliderSet, NarrowPhase};
use bevy_rapier3d::rapier::math::Pose;
use bevy_time::{Fixed, Time};
use bevy_transform::components::{GlobalTransform, Transform};
use bevy_transform_interpolation::prelude::TransformInterpolation;
use bevy_transform_interpolation::{RotationEasingState, TranslationEasingState};

use crate::convert;

/// Below this a body is still. Rapier's own thresholds are for bodies of a metre, which do not rock on a rim of a millimetre.
const RESTING: Sleeping = Sleeping {
    normalized_linear_threshold: 0.15,
    angular_threshold: 2.0,
    sleeping: false,
};

/// How far ahead contacts are looked for: what a leaf that falls at 3 m/s moves in a step, so that nothing thin is passed.
const AHEAD: SoftCcd = SoftCcd { prediction: 0.05 };

/// Bodies of both plugins.
type New = (With<Stepped>, Without<Handed>);

/// Lets go of bodies that have left one of the plugins.
pub(crate) fn release(
    bodies: Query<(Entity, Option<&RigidBody>, Has<Stepped>), With<Handed>>,
    mut commands: Commands,
) {
    for (entity, body, stepped) in &bodies {
        if !stepped || body != Some(&RigidBody::Dynamic) {
            commands.entity(entity).try_remove::<(Hosted, Handed)>();
        }
    }
}

/// Takes bodies in that have joined and are dynamic bodies of Rapier.
pub(crate) fn host(
    bodies: Query<(Entity, &RigidBody, &Stepped, &Transform), New>,
    mut commands: Commands,
) {
    for (entity, body, stepped, transform) in &bodies {
        if *body == RigidBody::Dynamic {
            let velocity = convert::velocity(&Motion::of(stepped, transform));
            commands
                .entity(entity)
                .try_insert((Hosted::default(), Handed::default()))
                .try_insert_if_new((velocity, RESTING, AHEAD, TransformInterpolation));
        }
    }
}

/// Wakes bodies that sleep where they would be moved.
pub(crate) fn stir(mut sleepers: Sleepers, mut bodies: Query<&mut Sleeping>) {
    for entity in sleepers.stirred() {
        if let Ok(mut sleeping) = bodies.get_mut(entity) {
            sleeping.sleeping = false;
        }
    }
}

/// Takes what the game has changed since the last step, and lets lie what sleeps.
pub(crate) fn read(
    mut bodies: Query<
        (
            Entity,
            &mut Stepped,
            &mut Handed,
            &mut Hosted,
            &mut Transform,
            &mut Velocity,
            &Sleeping,
            Has<RigidBodyDisabled>,
            Option<(&mut TranslationEasingState, &mut RotationEasingState)>,
        ),
        Without<ChildOf>,
    >,
) {
    for (
        entity,
        mut stepped,
        mut handed,
        mut hosted,
        mut transform,
        mut velocity,
        sleeping,
        disabled,
        drawn,
    ) in &mut bodies
    {
        let asleep = sleeping.sleeping || disabled;
        if hosted.asleep != asleep {
            hosted.asleep = asleep;
        }
        let motion = convert::motion_of_entity(&transform, &velocity);
        if motion.is_sound() {
            handed.read(&mut stepped, &transform, motion);
            continue;
        }
        error!(
            "the body {entity} was given a `Transform` or a `Velocity` with a number that is not finite or a rotation of no \
             length ({motion:?}); it is left as it was"
        );
        // Before Rapier has seen it.
        let motion = Motion::of(&stepped, &transform);
        (transform.translation, transform.rotation) = (motion.translation, motion.rotation);
        *velocity = convert::velocity(&motion);
        handed.keep(motion);
        if let Some((mut translation, mut rotation)) = drawn {
            (translation.start, rotation.start) = (None, None);
        }
    }
}

/// Bodies that the fluid does not move: held by a parent, or in quarantine.
type Held = Or<(With<ChildOf>, With<Quarantined>)>;

/// Gives Rapier the step as velocities, and the mass of the body with the fluid.
pub(crate) fn hand_over(
    time: Res<Time<Fixed>>,
    mut contexts: Query<(
        &RapierContextSimulation,
        &mut RapierContextColliders,
        &mut RapierRigidBodySet,
    )>,
    mut bodies: Query<(
        Entity,
        &Stepped,
        &mut Handed,
        &Hosted,
        &Transform,
        &RapierRigidBodyHandle,
        &RapierContextEntityLink,
    )>,
    held: Query<Option<&ChildOf>, Held>,
    places: Query<&GlobalTransform>,
) {
    let dt = time.delta_secs_f64();
    for (entity, stepped, mut handed, hosted, transform, handle, link) in &mut bodies {
        if hosted.asleep {
            continue;
        }
        let Ok((simulation, mut colliders, mut set)) = contexts.get_mut(link.0) else {
            continue;
        };
        let Some(body) = set.bodies.get_mut(handle.0) else {
            continue;
        };
        leave_alone(body, &mut colliders.colliders);
        if let Ok(parent) = held.get(entity) {
            // Where its `Transform` has it now: Rapier knows of a new parent only after transforms are propagated.
            if let Some(place) = parent.and_then(|of| places.get(of.parent()).ok()) {
                let place = place.mul_transform(*transform).compute_transform();
                let pose = Pose::from_parts(place.translation, place.rotation);
                body.set_position(pose, false);
            }
            let at_rest = Motion {
                velocity: Vec3::ZERO,
                angular_velocity: Vec3::ZERO,
                ..convert::motion(body)
            };
            set_velocity(body, &at_rest);
            handed.keep(at_rest);
            continue;
        }
        let normal = normal(body, &simulation.narrow_phase);
        let (motion, contact) = handed.fly(stepped, convert::motion(body), normal, dt);
        set_velocity(body, &motion);
        if let Some(contact) = contact {
            let mass = convert::mass(&contact, stepped.arm(transform));
            body.set_additional_mass_properties(mass, false);
        }
    }
}

/// Takes what Rapier made of the step.
pub(crate) fn take_back(
    mut sets: Query<&mut RapierRigidBodySet>,
    mut bodies: Query<(
        &mut Stepped,
        &mut Handed,
        &Transform,
        &RapierRigidBodyHandle,
        &RapierContextEntityLink,
    )>,
) {
    for (mut stepped, mut handed, transform, handle, link) in &mut bodies {
        let Ok(mut set) = sets.get_mut(link.0) else {
            continue;
        };
        let Some(body) = set.bodies.get_mut(handle.0) else {
            continue;
        };
        let now = convert::motion(body);
        let Some(landed) = handed.land(&mut stepped, transform, now) else {
            continue;
        };
        if convert::pose(&landed) != *body.position() {
            body.set_position(convert::pose(&landed), false);
        }
        set_velocity(body, &landed);
        handed.keep(convert::motion(body));
    }
}

/// What Rapier itself would do with a body, and the fluid does.
fn leave_alone(body: &mut rapier::dynamics::RigidBody, colliders: &mut ColliderSet) {
    for collider in body.colliders() {
        if let Some(collider) = colliders.get_mut(*collider).filter(|c| c.mass() != 0.0) {
            collider.set_density(0.0);
        }
    }
    body.reset_forces(false);
    body.reset_torques(false);
    body.set_gravity_scale(0.0, false);
    body.set_linear_damping(0.0);
    body.set_angular_damping(0.0);
    body.enable_gyroscopic_forces(false);
    // A body that tumbles may turn further in a step than Rapier would let it.
    body.set_allow_fast_rotation(true);
}

fn set_velocity(body: &mut rapier::dynamics::RigidBody, motion: &Motion) {
    body.set_linvel(motion.velocity, false);
    body.set_angvel(motion.angular_velocity, false);
}

/// The mean normal of what a body touches, or up.
fn normal(body: &rapier::dynamics::RigidBody, narrow_phase: &NarrowPhase) -> Vec3 {
    let mut sum = Vec3::ZERO;
    for collider in body.colliders() {
        for pair in narrow_phase.contact_pairs_with(*collider) {
            let sign = if pair.collider1 == *collider {
                -1.0
            } else {
                1.0
            };
            for manifold in &pair.manifolds {
                if !manifold.data.solver_contacts.is_empty() {
                    sum += sign * manifold.data.normal;
                }
            }
        }
    }
    sum.try_normalize().unwrap_or(Vec3::Y)
}
