//! What acts on bodies, by cause.

use bevy_ecs::system::{Res, SystemParam};
use bevy_time::{Fixed, Time};
use langevin_rigid::Loads;

use crate::ambient::ImmersionSettings;
use crate::components::ExternalWrench;
use crate::medium::Medium;
use crate::regions::Surroundings;
use crate::stepped::{Mover, Stepped};

/// The loads on bodies by cause, for systems that show or sound them.
///
/// ```
/// use bevy_ecs::prelude::*;
/// use bevy_langevin_rigid::{BodyLoads, ExternalWrench, Stepped};
/// fn rustle(bodies: Query<(&Stepped, &ExternalWrench)>, loads: BodyLoads) {
///     for (body, wrench) in &bodies {
///         if let Some(loads) = loads.of(body, wrench) {
///             let _drag = loads.drag.force;
///         }
///     }
/// }
/// ```
#[derive(SystemParam)]
pub struct BodyLoads<'w> {
    settings: Res<'w, ImmersionSettings>,
    around: Res<'w, Surroundings>,
    time: Res<'w, Time<Fixed>>,
}

impl BodyLoads<'_> {
    /// Whether a body that lies still would be moved, by [`Loads::STIRRING`] of its weight in the fluid.
    pub fn stirs(&self, body: &Stepped, wrench: &ExternalWrench) -> bool {
        if self.is_calm(body, wrench) {
            return false;
        }
        let pushed = body.stepper().zip(self.of(body, wrench));
        pushed.is_some_and(|(stepper, loads)| stepper.push_to_weight(&loads) > Loads::STIRRING)
    }

    /// Whether a body is in the fluid around all with no wind there, and nothing pushes it.
    fn is_calm(&self, body: &Stepped, wrench: &ExternalWrench) -> bool {
        let open = !matches!(body.medium, Medium::Region(..));
        let still = self.around.wind.is_empty() && self.settings.fluid.velocity == [0.0; 3];
        open && still && *wrench == ExternalWrench::default()
    }

    /// Those on a body in its [state](Stepped::state); none on one that falls plainly.
    ///
    /// On a body that crosses the surface of a [`FluidRegion`](crate::FluidRegion) they are those in the two fluids, by
    /// the share of its volume that is in each: exact for forces of weight and buoyancy, an estimate of all else.
    pub fn of(&self, body: &Stepped, wrench: &ExternalWrench) -> Option<Loads> {
        let Mover::Immersed(mobility) = &body.mover else {
            return None;
        };
        let state = body.state();
        let now = self.time.elapsed_secs_f64();
        let stream = self.settings.fluid.velocity;
        let mut input = self.around.input(state.position, now, stream, wrench);
        let open = mobility.open.loads(state, &input);
        let Medium::Region(immersion, surface) = &body.medium else {
            return Some(open);
        };
        input.flow = surface.flow(state.position, state.time);
        let under = immersion.in_water().loads(state, &input);
        Some(open.mixed(&under, immersion.share(state, surface)))
    }
}
