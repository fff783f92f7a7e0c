//! Bodies that sleep in a physics engine, where the fluid or a wrench would move them.

use bevy_ecs::entity::Entity;
use bevy_ecs::system::{Local, Query, SystemParam};

use crate::components::{ExternalWrench, Hosted};
use crate::loads::BodyLoads;
use crate::stepped::Stepped;

/// Fixed steps between two looks at a sleeping body.
const LOOKS: u32 = 8;

/// The bodies that an engine lets sleep ([`Hosted::asleep`]); for the engine's side, which wakes those that are
/// [stirred](Self::stirred).
#[derive(SystemParam)]
pub struct Sleepers<'w, 's> {
    bodies: Query<
        'w,
        's,
        (
            Entity,
            &'static Stepped,
            &'static ExternalWrench,
            &'static Hosted,
        ),
    >,
    loads: BodyLoads<'w>,
    step: Local<'s, u32>,
}

impl Sleepers<'_, '_> {
    /// Those that [would be moved](BodyLoads::stirs). Asked once a step, it looks at each body at every eighth.
    pub fn stirred(&mut self) -> impl Iterator<Item = Entity> {
        *self.step = (*self.step + 1) % LOOKS;
        let (loads, step) = (&self.loads, *self.step);
        (step..)
            .zip(&self.bodies)
            .filter(move |(number, (_, body, wrench, hosted))| {
                hosted.asleep && number.is_multiple_of(LOOKS) && loads.stirs(body, wrench)
            })
            .map(|(_, (entity, ..))| entity)
    }
}
