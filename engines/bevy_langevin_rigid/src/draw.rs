//! Transforms, drawn once a frame.

use bevy_ecs::hierarchy::ChildOf;
use bevy_ecs::query::Without;
use bevy_ecs::system::{Query, Res};
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;

use crate::components::{Hosted, Quarantined};
use crate::stepped::Stepped;

/// Draws bodies between their last two fixed steps, as far as the frame is.
pub(crate) fn draw(
    time: Res<Time<Fixed>>,
    mut bodies: Query<
        (&mut Stepped, &mut Transform),
        (Without<ChildOf>, Without<Hosted>, Without<Quarantined>),
    >,
) {
    let fraction = time.overstep_fraction_f64();
    bodies
        .par_iter_mut()
        .for_each(|(mut stepped, mut transform)| {
            stepped.follow(&transform);
            if stepped.fault.is_none() {
                stepped.draw(fraction, &mut transform);
            }
        });
}
