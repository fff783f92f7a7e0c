//! From the fluid to Rapier and back.

use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::entity::Entity;
use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::query::{Has, Or, With, Without};
use bevy_ecs::system::{Commands, Query, Res};
use bevy_langevin_rigid::{Hosted, Quarantined, Stepped};
use bevy_log::error;
use bevy_math::{DVec3, Vec3};
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

use crate::convert;
use crate::handed::Handed;

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
pub(crate) fn host(bodies: Query<(Entity, &RigidBody, &Stepped), New>, mut commands: Commands) {
    for (entity, body, stepped) in &bodies {
        if *body == RigidBody::Dynamic {
            commands
                .entity(entity)
                .try_insert((Hosted::default(), Handed::default()))
                .try_insert_if_new((convert::velocity_of(stepped.state()), RESTING, AHEAD));
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
    ) in &mut bodies
    {
        let asleep = sleeping.sleeping || disabled;
        if hosted.asleep != asleep {
            hosted.asleep = asleep;
        }
        let pose = Pose::from_parts(transform.translation, transform.rotation);
        if !handed.is_added() && handed.pose == pose && handed.velocity == *velocity {
            continue;
        }
        let arm = arm(&stepped, &transform);
        if is_sound(&pose, &velocity) {
            let mut state = *stepped.state();
            (state.position, state.orientation) = convert::centre(&pose, arm);
            state.set_world_velocities(
                velocity.linear.as_dvec3().to_array(),
                velocity.angular.as_dvec3().to_array(),
            );
            stepped.set_state(state);
        } else {
            error!(
                "the body {entity} was given a `Transform` or a `Velocity` with a number that is not finite or a rotation of \
                 no length ({pose:?}, {:?}); it is left as it was",
                *velocity
            );
            // Before Rapier has seen it.
            let pose = convert::pose(stepped.state(), arm);
            (transform.translation, transform.rotation) = (pose.translation, pose.rotation);
            *velocity = convert::velocity_of(stepped.state());
        }
        handed.pose = Pose::from_parts(transform.translation, transform.rotation);
        handed.velocity = *velocity;
    }
}

fn is_sound(pose: &Pose, velocity: &Velocity) -> bool {
    pose.translation.is_finite()
        && pose.rotation.is_finite()
        && pose.rotation.length_squared() > 0.5
        && velocity.linear.is_finite()
        && velocity.angular.is_finite()
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
            set_velocity(body, Velocity::zero());
            *handed = Handed::of(body);
            continue;
        }
        let flight = stepped.flight(dt);
        set_velocity(
            body,
            convert::velocity(flight.velocity(), flight.angular_velocity()),
        );
        if let Some(stepper) = stepped.stepper() {
            let normal = normal(body, &simulation.narrow_phase).as_dvec3().to_array();
            let contact = stepper.contact_mass(stepped.state().orientation, normal);
            let mass = convert::mass(&contact, arm(stepped, transform));
            body.set_additional_mass_properties(mass, false);
        }
        *handed = Handed {
            flies: true,
            ..Handed::of(body)
        };
    }
}

/// Takes what Rapier made of the step.
pub(crate) fn take_back(
    time: Res<Time<Fixed>>,
    mut sets: Query<&mut RapierRigidBodySet>,
    mut bodies: Query<(
        &mut Stepped,
        &mut Handed,
        &Transform,
        &RapierRigidBodyHandle,
        &RapierContextEntityLink,
    )>,
) {
    let dt = time.delta_secs_f64();
    for (mut stepped, mut handed, transform, handle, link) in &mut bodies {
        if !std::mem::take(&mut handed.flies) {
            continue;
        }
        let Ok(mut set) = sets.get_mut(link.0) else {
            continue;
        };
        let Some(body) = set.bodies.get_mut(handle.0) else {
            continue;
        };
        let arm = arm(&stepped, transform);
        let now = Handed::of(body);
        if now.velocity == handed.velocity {
            body.set_position(convert::pose(stepped.state(), arm), false);
        } else {
            let (centre, orientation) = convert::centre(&now.pose, arm);
            let met = stepped.flight(dt).met(
                centre,
                orientation,
                now.velocity.linear.as_dvec3().to_array(),
                now.velocity.angular.as_dvec3().to_array(),
            );
            stepped.set_state(met);
        }
        set_velocity(body, convert::velocity_of(stepped.state()));
        *handed = Handed::of(body);
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

fn set_velocity(body: &mut rapier::dynamics::RigidBody, velocity: Velocity) {
    body.set_linvel(velocity.linear, false);
    body.set_angvel(velocity.angular, false);
}

/// Centre of mass from the origin of the entity's frame, in that frame (m).
fn arm(stepped: &Stepped, transform: &Transform) -> DVec3 {
    transform.scale.as_dvec3() * stepped.centre_of_mass()
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
