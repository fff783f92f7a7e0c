//! Transforms, drawn once a frame.

use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::query::Without;
use bevy_ecs::system::{Query, Res, ResMut, SystemChangeTick};
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;

use crate::components::{Hosted, Quarantined};
use crate::faults::Faults;
use crate::moving::Moving;
use crate::steps::Ticks;

/// Draws bodies between their last two fixed steps, as far as the frame is.
pub(crate) fn draw(
    time: Res<Time<Fixed>>,
    faults: Res<Faults>,
    mut ticks: ResMut<Ticks>,
    change: SystemChangeTick,
    mut bodies: Query<
        (Moving, &mut Transform),
        (Without<ChildOf>, Without<Hosted>, Without<Quarantined>),
    >,
) {
    let fraction = time.overstep_fraction();
    let (last, this) = (ticks.drawn, change.this_run());
    bodies.par_iter_mut().for_each(|(mut body, mut transform)| {
        if transform.last_changed().is_newer_than(last, this)
            && let Err(fault) = body.follow(&transform)
        {
            faults.tell(body.entity, fault);
            return;
        }
        let part = body.pace.drawn(fraction);
        body.drawn.draw(part, &mut transform);
    });
    ticks.drawn = this;
}
