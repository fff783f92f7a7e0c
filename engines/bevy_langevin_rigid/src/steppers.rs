//! Steppers and crossings, made once for all bodies of one shape and size.

use std::collections::HashMap;
use std::collections::hash_map::Entry;
use std::sync::{Arc, OnceLock};

use bevy_asset::{AssetEvent, AssetId, AssetServer, Assets, Handle};
use bevy_ecs::change_detection::DetectChanges;
use bevy_ecs::message::MessageReader;
use bevy_ecs::resource::Resource;
use bevy_ecs::system::{Query, Res, ResMut};
use bevy_log::error;
use bevy_math::DVec3;
use langevin_rigid::{Bake, Fluid, Settings, SetupError, Stepper};
use langevin_rigid_world::water::Immersion;

use crate::ambient::ImmersionSettings;
use crate::baked_body::BakedBody;
use crate::baking::Outcome;
use crate::regions::{Region, Surroundings};
use crate::stepped::{Mover, Stepped};

/// A baked body at a size.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Shape {
    pub(crate) body: Handle<BakedBody>,
    /// How many times as large as it was baked.
    pub(crate) scale: f32,
}

/// The largest [`Settings::longest_part`] that is stable.
const COARSE: f64 = 1.6;

/// How a body of one shape and size moves: in the fluid around all, and through the surfaces of regions.
#[derive(Debug)]
pub(crate) struct Mobility {
    /// In the fluid around all.
    pub(crate) open: Stepper,
    /// Of a ball about the centre of mass that holds the body (m).
    pub(crate) radius: f64,
    /// What the log calls it.
    name: String,
    settings: ImmersionSettings,
    /// What it is made of, and how many times as large.
    bake: Arc<Bake>,
    scale: f64,
    /// In the fluid around all, in as long parts as are stable; made when the first body is far away.
    coarse: OnceLock<Option<Stepper>>,
    /// Made when the first body comes near: most bodies meet no water.
    crossings: Vec<(Fluid, OnceLock<Option<Arc<Immersion>>>)>,
}

impl Mobility {
    fn new(
        bake: &Arc<Bake>,
        scale: f32,
        settings: &ImmersionSettings,
        fluids: &[Fluid],
        name: String,
    ) -> Result<Self, SetupError> {
        let scale = f64::from(scale);
        let body = bake.body.scaled(scale);
        let distance = |vertex: &[f64; 3]| DVec3::from(*vertex).length();
        Ok(Self {
            radius: body
                .surface
                .vertices
                .iter()
                .map(distance)
                .fold(0.0, f64::max),
            open: Stepper::new(
                &body,
                &settings.fluid,
                bake.history.as_ref(),
                &settings.motion,
            )?,
            name,
            settings: *settings,
            bake: bake.clone(),
            scale,
            coarse: OnceLock::new(),
            crossings: fluids
                .iter()
                .map(|fluid| (*fluid, OnceLock::new()))
                .collect(),
        })
    }

    /// The body made ready to cross the surface of `region`; none where it cannot, of which the log has said why.
    pub(crate) fn crossing(&self, region: &Region) -> Option<&Arc<Immersion>> {
        let mut known = self.crossings.iter();
        let (fluid, crossing) = known.find(|(fluid, _)| *fluid == region.fluid)?;
        crossing.get_or_init(|| self.immersion(fluid)).as_ref()
    }

    /// In the fluid around all, for bodies far away.
    pub(crate) fn coarse(&self) -> &Stepper {
        let made = self.coarse.get_or_init(|| {
            let motion = Settings {
                longest_part: COARSE.max(self.settings.motion.longest_part),
                ..self.settings.motion
            };
            let body = self.bake.body.scaled(self.scale);
            let history = self.bake.history.as_ref();
            Stepper::new(&body, &self.settings.fluid, history, &motion).ok()
        });
        // With settings that are as good as those of the other, it is always made.
        made.as_ref().unwrap_or(&self.open)
    }

    fn immersion(&self, fluid: &Fluid) -> Option<Arc<Immersion>> {
        let history = self.bake.history.as_ref();
        let body = self.bake.body.scaled(self.scale);
        let ambient = &self.settings.fluid;
        let motion = &self.settings.motion;
        Immersion::new(&body, (ambient, history), (fluid, history), motion)
            .inspect_err(|error| {
                error!(
                    "{} cannot enter a fluid region of {} kg/m^3: {error}. Its entities pass through as if it were not there",
                    self.name, fluid.density
                );
            })
            .ok()
            .map(Arc::new)
    }
}

/// Mobilities under the present settings; none where the log has said why there is none.
#[derive(Resource, Default)]
pub(crate) struct Steppers {
    made: HashMap<(AssetId<BakedBody>, u32), Option<Arc<Mobility>>>,
    /// What they are made of, once for all sizes.
    bakes: HashMap<AssetId<BakedBody>, Arc<Bake>>,
    /// The fluids that they can enter.
    fluids: Vec<Fluid>,
}

impl Steppers {
    /// The mobility of `shape`, made if it is the first of that shape.
    pub(crate) fn mobility(
        &mut self,
        shape: &Shape,
        bodies: &Assets<BakedBody>,
        server: &AssetServer,
        settings: &ImmersionSettings,
    ) -> Outcome<Arc<Mobility>> {
        let entry = match self.made.entry((shape.body.id(), shape.scale.to_bits())) {
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
        let bake = self.bakes.entry(shape.body.id());
        let bake = bake.or_insert_with(|| Arc::new(body.bake.clone()));
        let made = Mobility::new(bake, shape.scale, settings, &self.fluids, name()).inspect_err(
            |error| {
                error!(
                    "{} cannot move in this fluid: {error}. Its entities fall plainly, as in no fluid",
                    name()
                );
            },
        );
        outcome(entry.insert(made.ok().map(Arc::new)))
    }
}

fn outcome(made: &Option<Arc<Mobility>>) -> Outcome<Arc<Mobility>> {
    match made {
        Some(mobility) => Outcome::Ready(mobility.clone()),
        None => Outcome::Failed,
    }
}

/// Makes all mobilities anew where the settings, a baked body or the fluids of the regions have changed, also for the bodies
/// under way.
pub(crate) fn renew(
    settings: Res<ImmersionSettings>,
    around: Res<Surroundings>,
    mut events: MessageReader<AssetEvent<BakedBody>>,
    bodies: Res<Assets<BakedBody>>,
    server: Res<AssetServer>,
    mut steppers: ResMut<Steppers>,
    mut stepped: Query<&mut Stepped>,
) {
    let mut changed = settings.is_changed() || around.fluids != steppers.fluids;
    for event in events.read() {
        match event {
            AssetEvent::Modified { .. } => changed = true,
            AssetEvent::Removed { id } => {
                steppers.made.retain(|(body, _), _| body != id);
                steppers.bakes.remove(id);
            }
            _ => {}
        }
    }
    if !changed {
        return;
    }
    steppers.made.clear();
    steppers.bakes.clear();
    steppers.fluids.clone_from(&around.fluids);
    for mut stepped in &mut stepped {
        let Some(shape) = stepped.shape.as_deref() else {
            continue;
        };
        match steppers.mobility(shape, &bodies, &server, &settings) {
            Outcome::Ready(mobility) => stepped.mover = Mover::Immersed(mobility),
            Outcome::Failed => stepped.mover = Mover::Plain,
            // Its asset was taken away; it goes on as it was.
            Outcome::Waiting => {}
        }
    }
}
