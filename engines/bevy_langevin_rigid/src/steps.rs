//! The fixed steps: read, step, write.

use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::query::{Added, With, Without};
use bevy_ecs::system::{Local, Query, Res};
use bevy_log::warn;
use bevy_math::Vec3;
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;
use langevin_rigid::{Flow, Input, NoiseStream, Wrench};

use crate::ambient::{AmbientWind, ImmersionSettings};
use crate::components::{
    AngularVelocity, ExternalWrench, Hosted, Immersed, LinearVelocity, Quarantined,
};
use crate::stepped::Stepped;

/// Stops bodies that were given a parent: it moves them from now on.
pub(crate) fn come_to_rest_in_hand(
    mut held: Query<(&mut LinearVelocity, &mut AngularVelocity), (With<Immersed>, Added<ChildOf>)>,
    mut said: Local<bool>,
) {
    for (mut velocity, mut angular_velocity) in &mut held {
        velocity.0 = Vec3::ZERO;
        angular_velocity.0 = Vec3::ZERO;
        if !std::mem::replace(&mut *said, true) {
            warn!(
                "a body that is `Immersed` has a parent: it goes where the parent does, and moves through the fluid once \
                 `ChildOf` is removed (this is said once)"
            );
        }
    }
}

/// Takes what the game has changed since the last step.
pub(crate) fn read(
    mut bodies: Query<
        (&mut Stepped, &Transform, &LinearVelocity, &AngularVelocity),
        (Without<ChildOf>, Without<Quarantined>, Without<Hosted>),
    >,
) {
    for (mut stepped, transform, velocity, angular_velocity) in &mut bodies {
        stepped.follow(transform);
        stepped.accelerate(*velocity, *angular_velocity);
    }
}

/// Steps all bodies, on any number of threads.
pub(crate) fn step(
    time: Res<Time<Fixed>>,
    settings: Res<ImmersionSettings>,
    wind: Res<AmbientWind>,
    mut bodies: Query<
        (&mut Stepped, &Immersed, &ExternalWrench, Option<&Hosted>),
        (Without<ChildOf>, Without<Quarantined>),
    >,
) {
    let dt = time.delta_secs_f64();
    let start = time.elapsed_secs_f64() - dt;
    bodies
        .par_iter_mut()
        .for_each(|(mut stepped, immersed, wrench, hosted)| {
            if stepped.fault.is_some() || hosted.is_some_and(|hosted| hosted.asleep) {
                return;
            }
            let input = Input {
                flow: flow(&wind, &stepped, start, &settings),
                wrench: Wrench {
                    force: wrench.force.as_dvec3().to_array(),
                    torque: wrench.torque.as_dvec3().to_array(),
                },
                noise: NoiseStream {
                    seed: settings.seed,
                    body: immersed.number.unwrap_or(0),
                },
            };
            stepped.step(dt, &input, settings.motion.gravity);
        });
}

fn flow(wind: &AmbientWind, stepped: &Stepped, time: f64, settings: &ImmersionSettings) -> Flow {
    if wind.0.is_empty() {
        return Flow::default();
    }
    let position = stepped.state().position;
    wind.0.flow(position, time, settings.fluid.velocity)
}

/// Writes the velocities after the step.
pub(crate) fn write(
    mut bodies: Query<
        (&mut Stepped, &mut LinearVelocity, &mut AngularVelocity),
        (Without<ChildOf>, Without<Quarantined>),
    >,
) {
    for (mut stepped, mut velocity, mut angular_velocity) in &mut bodies {
        if stepped.fault.is_none() {
            (*velocity, *angular_velocity) = stepped.velocities();
        }
    }
}
