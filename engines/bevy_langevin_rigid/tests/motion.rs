//! What bodies do in an app.

#![allow(clippy::unwrap_used)]

mod common;

use std::time::Duration;

use bevy_app::{App, FixedUpdate};
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::langevin_rigid::wind::{Wind, WindField};
use bevy_langevin_rigid::langevin_rigid::{Body, Fluid, NoiseStream, Settings, State, Stepper};
use bevy_langevin_rigid::{
    AmbientWind, AngularVelocity, ExternalWrench, Immersed, ImmersionSettings,
    LangevinRigidSystems, LinearVelocity, Quarantined, Stepped,
};
use bevy_math::{Quat, Vec3};
use bevy_time::{Fixed, Time, TimeUpdateStrategy};
use bevy_transform::components::Transform;

use common::{app, at_height, sheet, state, steps};

/// One second of fixed steps.
const SECOND: usize = 64;

fn spawn(app: &mut App, transform: Transform) -> Entity {
    let body = sheet(app);
    let immersed = Immersed::baked(body);
    app.world_mut().spawn((transform, immersed)).id()
}

fn transform(app: &App, entity: Entity) -> Transform {
    *app.world().get::<Transform>(entity).unwrap()
}

fn set<C: Component<Mutability = bevy_ecs::component::Mutable>>(
    app: &mut App,
    entity: Entity,
    change: impl FnOnce(&mut C),
) {
    change(&mut app.world_mut().get_mut::<C>(entity).unwrap());
}

/// The stepper of a sheet in a fluid.
fn stepper(fluid: &Fluid) -> Stepper {
    let body = Body::plate(0.148, 0.105, 1e-4, 750.0).unwrap();
    Stepper::new(&body, fluid, None, &Settings::default()).unwrap()
}

/// Steps the state of the first body that an app would number.
fn step_alone(state: &mut State, stepper: &Stepper, count: usize) {
    let noise = NoiseStream { seed: 0, body: 0 };
    for _ in 0..count {
        stepper.step(state, 1.0 / 64.0, &noise.into()).unwrap();
    }
}

#[test]
fn a_body_moves_as_the_library_alone_moves_it() {
    let mut app = app();
    let entity = spawn(&mut app, at_height(2.0));
    steps(&mut app, SECOND);
    let mut alone = State::default();
    alone.position[1] = 2.0;
    step_alone(&mut alone, &stepper(&Fluid::AIR), SECOND);
    assert_eq!(state(&app, entity), alone);
}

#[test]
fn settings_hold_from_the_next_step() {
    let mut app = app();
    let entity = spawn(&mut app, at_height(2.0));
    steps(&mut app, 4);
    app.world_mut().resource_mut::<ImmersionSettings>().fluid = Fluid::WATER;
    steps(&mut app, SECOND);
    let mut alone = State::default();
    alone.position[1] = 2.0;
    step_alone(&mut alone, &stepper(&Fluid::AIR), 4);
    step_alone(&mut alone, &stepper(&Fluid::WATER), SECOND);
    assert_eq!(state(&app, entity), alone);
}

#[test]
fn a_sheet_falls_slower_than_free_fall() {
    let mut app = app();
    let entity = spawn(&mut app, at_height(100.0));
    steps(&mut app, 2 * SECOND);
    let fallen = 100.0 - transform(&app, entity).translation.y;
    let freely = 0.5 * 9.81 * 4.0;
    assert!(fallen > 0.2 && fallen < 0.3 * freely, "{fallen} m");
}

#[derive(Resource, Default)]
struct Recorded(Vec<Vec<State>>);

fn record(bodies: Query<&Stepped>, mut recorded: ResMut<Recorded>) {
    let states: Vec<State> = bodies.iter().map(|body| *body.state()).collect();
    if !states.is_empty() {
        recorded.0.push(states);
    }
}

/// The states after each fixed step of five sheets in wind, at so many frames a second.
fn recorded_at(hz: u32) -> Vec<Vec<State>> {
    let mut app = app();
    let mut wind = Wind::default();
    wind.add(WindField::Uniform([1.0, 0.0, 0.0])).unwrap();
    app.insert_resource(AmbientWind(wind))
        .insert_resource(TimeUpdateStrategy::ManualDuration(
            Duration::from_secs(1) / hz,
        ))
        .init_resource::<Recorded>()
        .add_systems(FixedUpdate, record.after(LangevinRigidSystems::Write));
    for number in 0..5u8 {
        let turn = Quat::from_rotation_x(0.2 * f32::from(number));
        spawn(&mut app, at_height(5.0).with_rotation(turn));
    }
    while app.world().resource::<Recorded>().0.len() < 200 {
        app.update();
    }
    let mut recorded = std::mem::take(&mut app.world_mut().resource_mut::<Recorded>().0);
    recorded.truncate(200);
    recorded
}

#[test]
fn the_frame_rate_changes_no_bit() {
    let at_sixty = recorded_at(60);
    let [first, second] = [&at_sixty[199][0], &at_sixty[199][1]];
    assert_ne!(first.position, second.position);
    for hz in [30, 144] {
        assert_eq!(recorded_at(hz), at_sixty, "{hz} Hz");
    }
}

#[test]
fn another_seed_is_another_fall() {
    let fall = |seed| {
        let mut app = app();
        app.world_mut().resource_mut::<ImmersionSettings>().seed = seed;
        let entity = spawn(&mut app, at_height(2.0));
        steps(&mut app, SECOND);
        state(&app, entity).position
    };
    assert_eq!(fall(3), fall(3));
    assert_ne!(fall(3), fall(4));
}

#[test]
fn bodies_are_drawn_between_the_last_two_steps() {
    let mut app = app();
    let entity = spawn(&mut app, at_height(2.0));
    steps(&mut app, SECOND / 4);
    let before = state(&app, entity).position[1];
    let step = app.world().resource::<Time<Fixed>>().timestep();
    let quarter = TimeUpdateStrategy::ManualDuration(step + step / 4);
    app.insert_resource(quarter).update();
    let after = state(&app, entity).position[1];
    let drawn = f64::from(transform(&app, entity).translation.y);
    let wanted = before + 0.25 * (after - before);
    assert!((after - before).abs() > 1e-3, "{before} {after}");
    assert!((drawn - wanted).abs() < 1e-6, "{drawn} {wanted}");
}

#[test]
fn a_wrench_pushes_and_turns() {
    let mut app = app();
    let pushed = spawn(&mut app, at_height(2.0));
    let left = spawn(&mut app, at_height(2.0));
    // Ten times the weight of the sheet, along its edge.
    set::<ExternalWrench>(&mut app, pushed, |wrench| wrench.force.x = 0.114);
    steps(&mut app, 8);
    let speed = |entity| app.world().get::<LinearVelocity>(entity).unwrap().0.x;
    assert!(speed(pushed) > 1.0 && speed(left).abs() < 0.1);

    set::<ExternalWrench>(&mut app, pushed, |wrench| wrench.torque.y = 1e-3);
    steps(&mut app, 8);
    let spin = app.world().get::<AngularVelocity>(pushed).unwrap().0.y;
    assert!(spin > 1.0, "{spin}");
}

#[test]
fn what_the_game_sets_holds() {
    let mut app = app();
    let entity = spawn(&mut app, at_height(2.0));
    steps(&mut app, 10);
    set::<Transform>(&mut app, entity, |transform| {
        transform.translation = Vec3::new(5.0, 3.0, 1.0);
    });
    set::<LinearVelocity>(&mut app, entity, |velocity| velocity.0 = 2.0 * Vec3::X);
    app.update();
    let [x, y, z] = state(&app, entity).position;
    assert!((x - 5.0 - 2.0 / 64.0).abs() < 0.01, "{x}");
    assert!((y - 3.0).abs() < 0.01 && (z - 1.0).abs() < 0.01);
    // Not drawn on the way there.
    assert!(transform(&app, entity).translation.x >= 5.0);
}

#[test]
fn a_rotation_of_the_game_keeps_the_velocity_in_the_world() {
    let mut app = app();
    let entity = spawn(&mut app, at_height(2.0));
    set::<LinearVelocity>(&mut app, entity, |velocity| velocity.0 = Vec3::X);
    steps(&mut app, 2);
    set::<Transform>(&mut app, entity, |transform| {
        transform.rotation = Quat::from_rotation_y(1.5);
    });
    app.update();
    let [x, _, z] = state(&app, entity).world_velocity();
    assert!(x > 0.9 && z.abs() < 0.1, "{x} {z}");
}

#[test]
fn a_larger_body_of_the_same_shape_falls_faster() {
    let mut app = app();
    let small = spawn(&mut app, at_height(50.0));
    let large = spawn(&mut app, at_height(50.0).with_scale(Vec3::splat(20.0)));
    steps(&mut app, 2 * SECOND);
    assert!(state(&app, large).position[1] < state(&app, small).position[1] - 1.0);
}

#[test]
fn a_held_body_rests_and_is_let_go_where_it_is() {
    let mut app = app();
    let entity = spawn(&mut app, at_height(2.0));
    steps(&mut app, SECOND);
    let hand = app.world_mut().spawn(at_height(7.0)).id();
    app.world_mut().entity_mut(hand).add_child(entity);
    set::<Transform>(&mut app, entity, |transform| {
        *transform = Transform::IDENTITY;
    });
    steps(&mut app, SECOND);
    assert_eq!(transform(&app, entity), Transform::IDENTITY);
    app.world_mut().entity_mut(entity).remove::<ChildOf>();
    set::<Transform>(&mut app, entity, |transform| *transform = at_height(7.0));
    app.update();
    let state = state(&app, entity);
    assert!((state.position[1] - 7.0).abs() < 0.01);
    assert!(state.world_velocity()[1].abs() < 0.2);
}

#[test]
fn a_body_that_is_not_a_number_is_quarantined_and_can_go_on() {
    let break_and_mend = |damage: fn(&mut App, Entity), mend: fn(&mut App, Entity)| {
        let mut app = app();
        let sound = spawn(&mut app, at_height(3.0));
        let entity = spawn(&mut app, at_height(2.0));
        steps(&mut app, SECOND);
        let last = transform(&app, entity);
        damage(&mut app, entity);
        steps(&mut app, 4);
        let world = app.world();
        assert!(world.get::<Quarantined>(entity).is_some());
        assert!(world.get::<Quarantined>(sound).is_none());
        let now = transform(&app, entity);
        assert_eq!(
            (now.translation, now.rotation),
            (last.translation, last.rotation)
        );
        mend(&mut app, entity);
        app.world_mut().entity_mut(entity).remove::<Quarantined>();
        steps(&mut app, SECOND);
        assert!(app.world().get::<Quarantined>(entity).is_none());
        assert!(transform(&app, entity).translation.y < last.translation.y);
    };
    let nothing = |_: &mut App, _| {};
    break_and_mend(
        |app, entity| set::<Transform>(app, entity, |t| t.translation.x = f32::NAN),
        nothing,
    );
    break_and_mend(
        |app, entity| set::<Transform>(app, entity, |t| t.rotation = Quat::from_array([0.0; 4])),
        nothing,
    );
    break_and_mend(
        |app, entity| set::<Transform>(app, entity, |t| t.scale.y = f32::INFINITY),
        |app, entity| set::<Transform>(app, entity, |t| t.scale = Vec3::ONE),
    );
    break_and_mend(
        |app, entity| set::<LinearVelocity>(app, entity, |v| v.0.z = f32::INFINITY),
        nothing,
    );
    break_and_mend(
        |app, entity| set::<ExternalWrench>(app, entity, |w| w.torque.x = f32::NAN),
        |app, entity| set::<ExternalWrench>(app, entity, |w| *w = ExternalWrench::default()),
    );
}

#[test]
fn a_thousand_bodies_stay_finite() {
    let mut app = app();
    let body = sheet(&mut app);
    let entities: Vec<Entity> = (0..1000u16)
        .map(|i| {
            let i = f32::from(i);
            let turn = Quat::from_rotation_x(0.01 * i) * Quat::from_rotation_z(0.1 * i);
            let spin = AngularVelocity(Vec3::new(0.0, 0.0, 0.05 * i));
            let place = at_height(10.0).with_rotation(turn);
            let world = app.world_mut();
            world
                .spawn((place, spin, Immersed::baked(body.clone())))
                .id()
        })
        .collect();
    steps(&mut app, 200);
    for entity in entities {
        assert_eq!(state(&app, entity).step, 200);
        assert!(transform(&app, entity).is_finite());
        assert!(app.world().get::<Quarantined>(entity).is_none());
    }
}

#[test]
fn numbers_are_given_in_the_order_of_spawning() {
    let mut app = app();
    let body = sheet(&mut app);
    let mut number = |immersed: Immersed| {
        let entity = app.world_mut().spawn(immersed).id();
        app.world().get::<Immersed>(entity).unwrap().number
    };
    assert_eq!(number(Immersed::baked(body.clone())), Some(0));
    assert_eq!(number(Immersed::baked(body.clone()).numbered(9)), Some(9));
    assert_eq!(number(Immersed::baked(body)), Some(1));
}
