//! The fixed steps: read, step, write.

use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::query::{Added, With, Without};
use bevy_ecs::system::{Local, Query, Res};
use bevy_log::warn;
use bevy_math::Vec3;
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;

use crate::ambient::ImmersionSettings;
use crate::components::{
    AngularVelocity, ExternalWrench, Hosted, Immersed, LinearVelocity, Quarantined,
};
use crate::crowd::{self, Due, FixedStep};
use crate::detail::View;
use crate::regions::Surroundings;
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
    bodies
        .par_iter_mut()
        .for_each(|(mut stepped, transform, velocity, angular_velocity)| {
            stepped.follow(transform);
            stepped.accelerate(*velocity, *angular_velocity);
        });
}

/// Steps all bodies that are due, on any number of threads.
pub(crate) fn step(
    time: Res<Time<Fixed>>,
    settings: Res<ImmersionSettings>,
    around: Res<Surroundings>,
    view: View,
    mut count: Local<u32>,
    mut bodies: Query<
        (&mut Stepped, &Immersed, &ExternalWrench, Option<&Hosted>),
        (Without<ChildOf>, Without<Quarantined>),
    >,
) {
    let dt = time.delta_secs_f64();
    let spans = view.spans();
    let mut due = Vec::new();
    for (mut stepped, immersed, wrench, hosted) in &mut bodies {
        if stepped.fault.is_some() || hosted.is_some_and(|hosted| hosted.asleep) {
            continue;
        }
        let pushed = *wrench != ExternalWrench::default();
        if !stepped.is_due() {
            if !pushed {
                stepped.pass();
                continue;
            }
            stepped.stop();
        }
        let number = immersed.number.unwrap_or(0);
        let position = stepped.state().position;
        let span = match &spans {
            // What a physics engine hosts, it moves at every step.
            Some(spans) if !pushed && hosted.is_none() => spans.of(position, number, *count),
            _ => 1,
        };
        due.push(Due {
            stepped,
            number,
            wrench: *wrench,
            span,
        });
    }
    let fixed = FixedStep {
        start: time.elapsed_secs_f64() - dt,
        dt,
        settings: &settings,
        around: &around,
    };
    crowd::step(due, &fixed);
    *count = count.wrapping_add(1);
}

/// Writes the velocities after the step.
pub(crate) fn write(
    mut bodies: Query<
        (&mut Stepped, &mut LinearVelocity, &mut AngularVelocity),
        (Without<ChildOf>, Without<Quarantined>),
    >,
) {
    bodies
        .par_iter_mut()
        .for_each(|(mut stepped, mut velocity, mut angular_velocity)| {
            if stepped.fault.is_none() {
                (*velocity, *angular_velocity) = stepped.velocities();
            }
        });
}
