//! From the fluid to Avian and back.

use avian3d::math::SymmetricMatrix3;
use avian3d::prelude::{
    AngularVelocity, Collisions, ComputedAngularInertia, ComputedCenterOfMass, ComputedMass,
    CustomVelocityIntegration, LinearVelocity, NoAutoAngularInertia, NoAutoCenterOfMass,
    NoAutoMass, Position, RigidBody, Rotation, SleepThreshold, Sleeping, WakeBody,
};
use bevy_ecs::entity::Entity;
use bevy_ecs::query::{Has, With, Without};
use bevy_ecs::system::{Commands, Query, Res};
use bevy_langevin_rigid::{Handed, Hosted, Sleepers, Stepped};
use bevy_math::Vec3;
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;

use crate::convert;

/// Below this a body is still. Avian's own angular threshold is for bodies of a metre; at 2 rad/s the rim of a leaf moves at a
/// tenth of a metre a second.
const RESTING: SleepThreshold = SleepThreshold {
    linear: 0.15,
    angular: 2.0,
};

/// Bodies of both plugins.
type New = (With<Stepped>, Without<Handed>);

/// Takes bodies in that have joined and are dynamic bodies of Avian.
pub(crate) fn host(bodies: Query<(Entity, &RigidBody), New>, mut commands: Commands) {
    for (entity, body) in &bodies {
        if body.is_dynamic() {
            commands.entity(entity).try_insert((
                Hosted::default(),
                Handed::default(),
                CustomVelocityIntegration,
                NoAutoMass,
                NoAutoAngularInertia,
                NoAutoCenterOfMass,
                RESTING,
            ));
        }
    }
}

/// Wakes bodies that sleep where they would be moved.
pub(crate) fn stir(mut sleepers: Sleepers, mut commands: Commands) {
    for entity in sleepers.stirred() {
        commands.queue(WakeBody(entity));
    }
}

/// Takes what the game has changed since the last step, and lets lie what sleeps.
pub(crate) fn read(
    mut bodies: Query<(
        &mut Stepped,
        &mut Handed,
        &mut Hosted,
        &Transform,
        &Position,
        &Rotation,
        &LinearVelocity,
        &AngularVelocity,
        Has<Sleeping>,
    )>,
) {
    for (mut stepped, mut handed, mut hosted, transform, position, rotation, v, omega, asleep) in
        &mut bodies
    {
        if hosted.asleep != asleep {
            hosted.asleep = asleep;
        }
        let motion = convert::motion(position, rotation, v, omega);
        // Avian has not placed it yet, or the game has lost it.
        if *position == Position::PLACEHOLDER || !motion.is_sound() {
            continue;
        }
        handed.read(&mut stepped, transform, motion);
    }
}

/// Gives Avian the step as velocities, and the mass of the body with the fluid.
pub(crate) fn hand_over(
    time: Res<Time<Fixed>>,
    collisions: Collisions,
    mut bodies: Query<
        (
            Entity,
            &Stepped,
            &mut Handed,
            &Transform,
            (&Position, &Rotation),
            &mut LinearVelocity,
            &mut AngularVelocity,
            &mut ComputedMass,
            &mut ComputedAngularInertia,
            &mut ComputedCenterOfMass,
        ),
        (With<Hosted>, Without<Sleeping>),
    >,
) {
    let dt = time.delta_secs_f64();
    for (
        entity,
        stepped,
        mut handed,
        transform,
        (position, rotation),
        mut v,
        mut omega,
        mut mass,
        mut inertia,
        mut centre,
    ) in &mut bodies
    {
        let now = convert::motion(position, rotation, &v, &omega);
        let (motion, contact) = handed.fly(stepped, now, normal(entity, &collisions), dt);
        (v.0, omega.0) = (motion.velocity, motion.angular_velocity);
        centre.0 = stepped.arm(transform).as_vec3();
        let Some(contact) = contact else {
            continue;
        };
        *mass = ComputedMass::new(contact.mass as f32);
        let [[xx, xy, xz], [_, yy, yz], [_, _, zz]] =
            contact.inertia.map(|row| row.map(|x| x as f32));
        *inertia =
            ComputedAngularInertia::from_tensor(SymmetricMatrix3::new(xx, xy, xz, yy, yz, zz));
    }
}

/// Takes what Avian made of the step; also of bodies that fell asleep in it, whose own components are left alone, since a
/// change would wake them.
pub(crate) fn take_back(
    mut bodies: Query<
        (
            &mut Stepped,
            &mut Handed,
            &Transform,
            &mut Position,
            &mut Rotation,
            &mut LinearVelocity,
            &mut AngularVelocity,
            Has<Sleeping>,
        ),
        With<Hosted>,
    >,
) {
    for (
        mut stepped,
        mut handed,
        transform,
        mut position,
        mut rotation,
        mut v,
        mut omega,
        asleep,
    ) in &mut bodies
    {
        let now = convert::motion(&position, &rotation, &v, &omega);
        let Some(landed) = handed.land(&mut stepped, transform, now) else {
            continue;
        };
        if asleep {
            handed.keep(now);
            continue;
        }
        (position.0, rotation.0) = (landed.translation, landed.rotation);
        (v.0, omega.0) = (landed.velocity, landed.angular_velocity);
    }
}

/// The mean normal of what a body touches, or up.
fn normal(entity: Entity, collisions: &Collisions) -> Vec3 {
    let mut sum = Vec3::ZERO;
    for pair in collisions.collisions_with(entity) {
        let sign = if pair.collider1 == entity { -1.0 } else { 1.0 };
        for manifold in &pair.manifolds {
            sum += sign * manifold.normal;
        }
    }
    sum.try_normalize().unwrap_or(Vec3::Y)
}
