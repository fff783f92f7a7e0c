//! The fixed steps: read, then step.

use bevy_ecs::batching::BatchingStrategy;
use bevy_ecs::change_detection::{DetectChanges, Mut, Ref, Tick};
use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::query::{Added, QueryData, With, Without};
use bevy_ecs::resource::Resource;
use bevy_ecs::system::{Local, Query, Res, ResMut, SystemChangeTick};
use bevy_log::warn;
use bevy_math::Vec3;
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;

use crate::ambient::ImmersionSettings;
use crate::components::{
    AngularVelocity, ExternalWrench, Hosted, Immersed, LinearVelocity, Quarantined,
};
use crate::crowd::{Crowd, Due, FixedStep};
use crate::detail::View;
use crate::faults::Faults;
use crate::moving::Moving;
use crate::regions::Surroundings;

/// Tasks that a thread takes, so that one which is done early can take more.
const TASKS: usize = 8;

/// When the plugin itself last wrote; what has changed since, the game has changed.
#[derive(Resource, Debug)]
pub(crate) struct Ticks {
    /// `Transform`s.
    pub(crate) drawn: Tick,
    /// Velocities.
    stepped: Tick,
}

impl Default for Ticks {
    fn default() -> Self {
        Self {
            drawn: Tick::new(0),
            stepped: Tick::new(0),
        }
    }
}

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
    ticks: Res<Ticks>,
    change: SystemChangeTick,
    faults: Res<Faults>,
    mut bodies: Query<
        (
            Moving,
            Ref<Transform>,
            Ref<LinearVelocity>,
            Ref<AngularVelocity>,
        ),
        (Without<ChildOf>, Without<Quarantined>, Without<Hosted>),
    >,
) {
    let newer = |tick: Tick, than| tick.is_newer_than(than, change.this_run());
    bodies
        .par_iter_mut()
        .for_each(|(mut body, transform, velocity, angular_velocity)| {
            let moved = newer(transform.last_changed(), ticks.drawn);
            let accelerated = newer(velocity.last_changed(), ticks.stepped)
                || newer(angular_velocity.last_changed(), ticks.stepped);
            let mut taken = Ok(());
            if moved {
                taken = body.follow(&transform);
            }
            if accelerated && taken.is_ok() {
                taken = body.accelerate(*velocity, *angular_velocity);
            }
            if let Err(fault) = taken {
                faults.tell(body.entity, fault);
            }
        });
}

/// A body that may step.
type Stepping = (
    Moving,
    &'static Immersed,
    &'static ExternalWrench,
    &'static mut LinearVelocity,
    &'static mut AngularVelocity,
    Option<&'static Hosted>,
);
type SteppingItem<'w, 's> = <Stepping as QueryData>::Item<'w, 's>;

/// Steps all bodies that are due, on any number of threads, and writes their velocities.
pub(crate) fn step(
    time: Res<Time<Fixed>>,
    settings: Res<ImmersionSettings>,
    around: Res<Surroundings>,
    view: View,
    faults: Res<Faults>,
    mut ticks: ResMut<Ticks>,
    change: SystemChangeTick,
    mut count: Local<u32>,
    mut bodies: Query<Stepping, (Without<ChildOf>, Without<Quarantined>)>,
) {
    let dt = time.delta_secs_f64();
    let fixed = FixedStep {
        start: time.elapsed_secs_f64() - dt,
        dt,
        settings: &settings,
        around: &around,
        faults: &faults,
        spans: view.spans(),
    };
    bodies
        .par_iter_mut()
        .batching_strategy(BatchingStrategy::new().batches_per_thread(TASKS))
        .for_each_init(
            || Crowd::new(&fixed),
            |crowd, body| {
                if let Some(due) = due(&fixed, *count, body) {
                    crowd.add(due);
                }
            },
        );
    *count = count.wrapping_add(1);
    ticks.stepped = change.this_run();
}

/// The body, if it takes a step at the fixed step with this number.
fn due<'w>(
    fixed: &FixedStep,
    number: u32,
    (mut body, immersed, wrench, mut velocity, mut angular_velocity, hosted): SteppingItem<'w, '_>,
) -> Option<Due<'w>> {
    if hosted.is_some_and(|hosted| hosted.asleep) {
        if !std::mem::replace(&mut body.pace.rests, true) {
            (*velocity, *angular_velocity) = body.stepped.velocities();
        }
        return None;
    }
    let pushed = *wrench != ExternalWrench::default();
    if !body.pace.is_due() {
        if !pushed {
            body.pace.pass();
            return None;
        }
        body.stop();
    }
    let own = immersed.number.unwrap_or(0);
    let span = match &fixed.spans {
        // What a physics engine hosts, it moves at every step.
        Some(spans) if !pushed && hosted.is_none() => {
            spans.of(body.stepped.state().position, own, number)
        }
        _ => 1,
    };
    Some(Due {
        entity: body.entity,
        stepped: body.stepped.into_inner(),
        pace: body.pace.into_inner(),
        drawn: body.drawn.into_inner(),
        velocity: Mut::into_inner(velocity),
        angular_velocity: Mut::into_inner(angular_velocity),
        number: own,
        wrench: *wrench,
        span,
        hosted: hosted.is_some(),
    })
}
