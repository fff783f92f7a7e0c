//! What the log has said of entities, so that it is said once.

use std::collections::HashMap;

use bevy_ecs::entity::Entity;
use bevy_log::error;

/// The last fault of each entity.
#[derive(Default)]
pub(crate) struct Said(HashMap<Entity, String>);

impl Said {
    /// Says what is wrong with an entity, once.
    pub(crate) fn tell(&mut self, entity: Entity, what: &str, fault: &str) {
        if self.is_new(entity, fault) {
            error!("{what} {entity} cannot be: {fault}. It is left out until this is mended");
        }
    }

    /// Whether this fault of an entity is another than its last one, as which it is kept.
    pub(crate) fn is_new(&mut self, entity: Entity, fault: &str) -> bool {
        let new = self.0.get(&entity).is_none_or(|last| last != fault);
        if new {
            self.0.insert(entity, fault.to_owned());
        }
        new
    }

    /// Forgets the fault of an entity that has none any more.
    pub(crate) fn is_sound(&mut self, entity: Entity) {
        self.0.remove(&entity);
    }
}
