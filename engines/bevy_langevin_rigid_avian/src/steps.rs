//! From the fluid to Avian and back.

use avian3d::math::SymmetricMatrix3;
use avian3d::prelude::{
    AngularVelocity, Collisions, ComputedAngularInertia, ComputedCenterOfMass, ComputedMass,
    CustomVelocityIntegration, LinearVelocity, NoAutoAngularInertia, NoAutoCenterOfMass,
    NoAutoMass, Position, RigidBody, Rotation, SleepThreshold, Sleeping,
};
use bevy_ecs::entity::Entity;
use bevy_ecs::query::{Has, With, Without};
use bevy_ecs::system::{Commands, Query, Res};
use bevy_langevin_rigid::langevin_rigid::FreeFlight;
use bevy_langevin_rigid::{Hosted, Stepped};
use bevy_math::{DVec3, Vec3};
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;

use crate::convert;
use crate::handed::Handed;

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
    for (
        mut stepped,
        mut handed,
        mut hosted,
        transform,
        position,
        rotation,
        velocity,
        spin,
        asleep,
    ) in &mut bodies
    {
        if hosted.asleep != asleep {
            hosted.asleep = asleep;
        }
        if !handed.is_moved(position, rotation, velocity, spin) {
            continue;
        }
        let finite = position.0.is_finite()
            && rotation.0.is_finite()
            && velocity.0.is_finite()
            && spin.0.is_finite();
        // Avian has not placed it yet, or the game has lost it.
        if !finite || *position == Position::PLACEHOLDER || rotation.0.length_squared() < 0.5 {
            continue;
        }
        let mut state = *stepped.state();
        (state.position, state.orientation) =
            convert::centre(*position, *rotation, arm(&stepped, transform));
        state.set_world_velocities(
            velocity.0.as_dvec3().to_array(),
            spin.0.as_dvec3().to_array(),
        );
        stepped.set_state(state);
        *handed = Handed {
            position: *position,
            rotation: *rotation,
            velocity: *velocity,
            spin: *spin,
            flies: false,
        };
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
        mut v,
        mut omega,
        mut mass,
        mut inertia,
        mut centre,
    ) in &mut bodies
    {
        let flight = stepped.flight(dt);
        *v = convert::velocity(flight.velocity());
        *omega = convert::spin(flight.angular_velocity());
        (handed.velocity, handed.spin, handed.flies) = (*v, *omega, true);
        centre.0 = arm(stepped, transform).as_vec3();
        let Some(stepper) = stepped.stepper() else {
            continue;
        };
        let normal = normal(entity, &collisions).as_dvec3().to_array();
        let contact = stepper.contact_mass(stepped.state().orientation, normal);
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
    time: Res<Time<Fixed>>,
) {
    let dt = time.delta_secs_f64();
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
        if !std::mem::take(&mut handed.flies) {
            continue;
        }
        let arm = arm(&stepped, transform);
        if handed.is_accelerated(&v, &omega) {
            let met = met(&stepped.flight(dt), arm, *position, *rotation, *v, *omega);
            stepped.set_state(met);
        } else if !asleep {
            (*position, *rotation) = convert::pose(stepped.state(), arm);
        }
        if !asleep {
            let state = stepped.state();
            *v = convert::velocity(state.world_velocity());
            *omega = convert::spin(state.world_angular_velocity());
        }
        *handed = Handed {
            position: *position,
            rotation: *rotation,
            velocity: *v,
            spin: *omega,
            flies: false,
        };
    }
}

fn met(
    flight: &FreeFlight,
    arm: DVec3,
    position: Position,
    rotation: Rotation,
    v: LinearVelocity,
    omega: AngularVelocity,
) -> bevy_langevin_rigid::langevin_rigid::State {
    let (centre, orientation) = convert::centre(position, rotation, arm);
    flight.met(
        centre,
        orientation,
        v.0.as_dvec3().to_array(),
        omega.0.as_dvec3().to_array(),
    )
}

/// Centre of mass from the origin of the entity's frame, in that frame (m).
fn arm(stepped: &Stepped, transform: &Transform) -> DVec3 {
    transform.scale.as_dvec3() * stepped.centre_of_mass()
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
