//! Bodies that cannot go on, until they are quarantined.

use std::sync::Mutex;

use bevy_ecs::entity::Entity;
use bevy_ecs::resource::Resource;

/// Bodies in which a step has found a fault since they were last quarantined, by any thread.
#[derive(Resource, Debug, Default)]
pub(crate) struct Faults(Mutex<Vec<(Entity, String)>>);

impl Faults {
    /// `body` cannot go on, for this reason.
    pub(crate) fn tell(&self, body: Entity, fault: String) {
        // A list is as good as before, whoever panicked beside it.
        let mut faults = self
            .0
            .lock()
            .unwrap_or_else(|poisoned| poisoned.into_inner());
        faults.push((body, fault));
    }

    /// All of them by entity, each with what was told of it first.
    pub(crate) fn take(&mut self) -> Vec<(Entity, String)> {
        let faults = self
            .0
            .get_mut()
            .unwrap_or_else(|poisoned| poisoned.into_inner());
        let mut faults = std::mem::take(faults);
        faults.sort_by_key(|(body, _)| *body);
        faults.dedup_by_key(|(body, _)| *body);
        faults
    }
}
