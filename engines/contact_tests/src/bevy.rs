//! Engines that are plugins of Bevy: an app without a window, and cards in it.

use std::marker::PhantomData;

use bevy_app::{App, TaskPoolPlugin};
use bevy_asset::{AssetPlugin, Assets};
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::{
    AmbientWind, BakedBody, ExternalWrench, Immersed, LangevinRigidPlugin, Stepped,
};
use bevy_math::{DQuat, DVec3, Vec3};
use bevy_mesh::MeshPlugin;
use bevy_time::{TimePlugin, TimeUpdateStrategy};
use bevy_transform::TransformPlugin;
use bevy_transform::components::Transform;
use langevin_rigid::State;
use langevin_rigid::wind::{Wind, WindField};

use crate::{Engine, SIZE, Seen, card};

/// The fixed step (s), Bevy's.
pub const DT: f64 = 1.0 / 64.0;

/// What solves contacts.
pub trait Solver {
    /// An app with its plugins, as of [`app`].
    fn app() -> App;
    /// A box of these sides (m) that moves, as the solver has it.
    fn moving_box(sides: Vec3) -> impl Bundle;
    /// A box of these sides (m) that stays where it is.
    fn fixed_box(sides: Vec3) -> impl Bundle;
    /// Where it has a body (m).
    fn place(world: &World, body: Entity) -> Vec3;
    /// Whether it lets a body sleep.
    fn is_asleep(world: &World, body: Entity) -> bool;
}

/// An app that takes one fixed step a frame from its second frame on; `plug` adds the solver and ours for it.
pub fn app(plug: impl FnOnce(&mut App)) -> App {
    let mut app = App::new();
    app.add_plugins((
        TaskPoolPlugin::default(),
        TimePlugin,
        TransformPlugin,
        AssetPlugin::default(),
        MeshPlugin,
        LangevinRigidPlugin,
    ))
    .insert_resource(TimeUpdateStrategy::FixedTimesteps(1));
    plug(&mut app);
    app.finish();
    app.cleanup();
    app.update();
    app
}

/// Spawns a card.
pub fn drop_card<S: Solver>(app: &mut App, transform: Transform) -> Entity {
    let mut bodies = app.world_mut().resource_mut::<Assets<BakedBody>>();
    let immersed = Immersed::baked(bodies.add(card()));
    let sides = Vec3::from_array(SIZE.map(|size| size as f32));
    let card = (transform, immersed, S::moving_box(sides));
    app.world_mut().spawn(card).id()
}

/// Spawns ground: a box, its upper face at height zero.
pub fn ground<S: Solver>(app: &mut App) {
    let place = Transform::from_xyz(0.0, -1.0, 0.0);
    let ground = S::fixed_box(Vec3::new(100.0, 2.0, 100.0));
    app.world_mut().spawn((place, ground));
}

/// Takes fixed steps.
pub fn steps(app: &mut App, count: usize) {
    for _ in 0..count {
        app.update();
    }
}

/// The state of a body in the fluid; of one that took a step.
pub fn state(world: &World, body: Entity) -> State {
    *world.get::<Stepped>(body).unwrap().state()
}

/// A world of an engine in Bevy.
pub struct InBevy<S>(App, PhantomData<S>);

impl<S: Solver> InBevy<S> {
    /// With ground.
    #[allow(clippy::new_without_default, reason = "of tests")]
    pub fn new() -> Self {
        let mut app = S::app();
        ground::<S>(&mut app);
        Self(app, PhantomData)
    }
}

impl<S: Solver> Engine for InBevy<S> {
    type Card = Entity;
    const DT: f64 = DT;

    fn release(&mut self, pose: &State) -> Entity {
        let position = DVec3::from(pose.position).as_vec3();
        let turn = DQuat::from_array(pose.orientation).as_quat();
        let pose = Transform::from_translation(position).with_rotation(turn);
        drop_card::<S>(&mut self.0, pose)
    }

    fn blow(&mut self, wind: [f64; 3]) {
        let mut blowing = Wind::default();
        blowing.add(WindField::Uniform(wind)).unwrap();
        self.0.insert_resource(AmbientWind(blowing));
    }

    fn twist(&mut self, card: Entity, torque: [f64; 3]) {
        let torque = DVec3::from(torque).as_vec3();
        let wrench = self.0.world_mut().get_mut::<ExternalWrench>(card);
        wrench.unwrap().torque = torque;
    }

    fn step(&mut self) {
        steps(&mut self.0, 1);
    }

    fn seen(&self, card: Entity) -> Seen {
        let world = self.0.world();
        Seen {
            state: state(world, card),
            place: S::place(world, card).as_dvec3().to_array(),
            asleep: S::is_asleep(world, card),
        }
    }
}
