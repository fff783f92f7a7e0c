//! Steppers, made once for all bodies of one shape and size.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::Arc;

use bevy_asset::{AssetEvent, AssetId, AssetServer, Assets, Handle};
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::message::MessageReader;
use bevy_ecs::resource::Resource;
use bevy_ecs::system::{Query, Res, ResMut};
use bevy_log::error;
use langevin_rigid::{SetupError, Stepper};

use crate::ambient::ImmersionSettings;
use crate::baked_body::BakedBody;
use crate::baking::Outcome;
use crate::stepped::{Mover, Stepped};

/// A baked body at a size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shape {
    pub(crate) body: Handle<BakedBody>,
    /// How many times as large as it was baked.
    pub(crate) scale: f32,
}

/// Steppers under the present settings; none where the log has said why there is none.
#[derive(Resource, Default)]
pub(crate) struct Steppers(HashMap<(AssetId<BakedBody>, u32), Option<Arc<Stepper>>>);

impl Steppers {
    /// The stepper of `shape`, made if it is the first of that shape.
    pub(crate) fn stepper(
        &mut self,
        shape: &Shape,
        bodies: &Assets<BakedBody>,
        server: &AssetServer,
        settings: &ImmersionSettings,
    ) -> Outcome<Arc<Stepper>> {
        let entry = match self.0.entry((shape.body.id(), shape.scale.to_bits())) {
            Entry::Occupied(made) => return outcome(made.get()),
            Entry::Vacant(entry) => entry,
        };
        let name = || match server.get_path(&shape.body) {
            Some(path) => format!("the body `{path}`"),
            None => format!("the body {}", shape.body.id()),
        };
        let Some(body) = bodies.get(&shape.body) else {
            if !server.load_state(&shape.body).is_failed() {
                return Outcome::Waiting;
            }
            error!(
                "{} could not be loaded; its entities fall plainly, as in no fluid",
                name()
            );
            entry.insert(None);
            return Outcome::Failed;
        };
        let made = make(body, shape.scale, settings).inspect_err(|error| {
            error!(
                "{} cannot move in this fluid: {error}. Its entities fall plainly, as in no fluid",
                name()
            );
        });
        outcome(entry.insert(made.ok().map(Arc::new)))
    }
}

fn outcome(made: &Option<Arc<Stepper>>) -> Outcome<Arc<Stepper>> {
    match made {
        Some(stepper) => Outcome::Ready(stepper.clone()),
        None => Outcome::Failed,
    }
}

fn make(
    baked: &BakedBody,
    scale: f32,
    settings: &ImmersionSettings,
) -> Result<Stepper, SetupError> {
    let history = baked.bake.history.as_ref();
    let body = baked.bake.body.scaled(scale.into());
    Stepper::new(&body, &settings.fluid, history, &settings.motion)
}

/// Makes all steppers anew where the settings or a baked body have changed, also for the bodies under way.
pub(crate) fn renew(
    settings: Res<ImmersionSettings>,
    mut events: MessageReader<AssetEvent<BakedBody>>,
    bodies: Res<Assets<BakedBody>>,
    server: Res<AssetServer>,
    mut steppers: ResMut<Steppers>,
    mut stepped: Query<&mut Stepped>,
) {
    let mut changed = settings.is_changed();
    for event in events.read() {
        match event {
            AssetEvent::Modified { .. } => changed = true,
            AssetEvent::Removed { id } => steppers.0.retain(|(body, _), _| body != id),
            _ => {}
        }
    }
    if !changed {
        return;
    }
    steppers.0.clear();
    for mut stepped in &mut stepped {
        let Some(shape) = &stepped.shape else {
            continue;
        };
        match steppers.stepper(shape, &bodies, &server, &settings) {
            Outcome::Ready(stepper) => stepped.mover = Mover::Immersed(stepper),
            Outcome::Failed => stepped.mover = Mover::Plain,
            // Its asset was taken away; it goes on as it was.
            Outcome::Waiting => {}
        }
    }
}
