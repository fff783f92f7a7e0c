//! Trees that shed leaves.

#![allow(clippy::unwrap_used)]

mod common;

use std::time::Duration;

use bevy_app::App;
use bevy_asset::Assets;
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::langevin_rigid::{Body, State};
use bevy_langevin_rigid::{
    BakedBody, BodySource, Crown, DropLeaves, Immersed, Leaf, LeafLimit, ShedFrom, Stepped,
};
use bevy_math::Vec3;
use bevy_math::primitives::Plane3d;
use bevy_mesh::{Mesh, Mesh3d, Meshable};
use bevy_time::TimeUpdateStrategy;
use bevy_transform::components::Transform;

use common::log::{errors, listening};
use common::{app, asset, at_height, joined, steps, until};

/// One second of fixed steps.
const SECOND: usize = 64;

fn crown(app: &mut App) -> Crown {
    let leaf = Body::plate(0.08, 0.05, 0.2e-3, 450.0).unwrap();
    let leaf = asset(app, leaf);
    Crown {
        half_extents: Vec3::new(2.0, 1.0, 3.0),
        ..Crown::ball(1.0, Leaf::baked(leaf))
    }
}

fn tree(app: &mut App, place: Transform) -> Entity {
    let crown = crown(app);
    app.world_mut().spawn((crown, place)).id()
}

fn send(app: &mut App, message: DropLeaves) {
    app.world_mut().write_message(message);
}

fn leaves(app: &mut App) -> Vec<Entity> {
    let mut query = app.world_mut().query_filtered::<Entity, With<ShedFrom>>();
    let mut leaves: Vec<Entity> = query.iter(app.world()).collect();
    leaves.sort();
    leaves
}

fn states(app: &mut App) -> Vec<State> {
    let mut query = app.world_mut().query::<(&Immersed, &Stepped)>();
    let bodies = query.iter(app.world());
    let mut states: Vec<_> = bodies
        .map(|(body, stepped)| (body.number, *stepped.state()))
        .collect();
    states.sort_by_key(|(number, _)| *number);
    states.into_iter().map(|(_, state)| state).collect()
}

#[test]
fn leaves_start_at_rest_in_the_crown_and_share_their_body() {
    let mut app = app();
    let place = at_height(20.0).with_scale(Vec3::splat(2.0));
    let tree = tree(&mut app, place);
    send(&mut app, DropLeaves::at_once(tree, 300));
    app.update();
    let leaves = leaves(&mut app);
    assert_eq!(leaves.len(), 300);
    let world = app.world();
    let (mut highest, mut lowest) = (f32::MIN, f32::MAX);
    for &leaf in &leaves {
        let transform = world.get::<Transform>(leaf).unwrap();
        let away = (transform.translation - 20.0 * Vec3::Y) / Vec3::new(4.0, 2.0, 6.0);
        // They have fallen for a step.
        assert!(away.length() < 1.01, "{away}");
        assert_eq!(transform.scale, Vec3::ONE);
        assert_eq!(world.get::<ShedFrom>(leaf), Some(&ShedFrom(tree)));
        assert!(joined(world, leaf));
        let speed = world.get::<Stepped>(leaf).unwrap().state().world_velocity()[1];
        assert!((-0.2..0.0).contains(&speed), "{speed}");
        highest = highest.max(away.y);
        lowest = lowest.min(away.y);
    }
    assert!(highest > 0.8 && lowest < -0.8);
    assert_eq!(world.resource::<Assets<BakedBody>>().len(), 1);
}

#[test]
fn leaves_are_shed_over_the_time_asked_for() {
    let mut app = app();
    let tree = tree(&mut app, at_height(20.0));
    send(
        &mut app,
        DropLeaves::over(tree, 100, Duration::from_secs(2)),
    );
    for (after, expected) in [
        (SECOND / 2, 25),
        (SECOND / 2, 50),
        (SECOND, 100),
        (SECOND, 100),
    ] {
        steps(&mut app, after);
        let count = leaves(&mut app).len();
        assert!(count.abs_diff(expected) <= 1, "{count} {expected}");
    }
    assert_eq!(leaves(&mut app).len(), 100);
}

#[test]
fn a_tree_that_moves_sheds_where_it_is() {
    let mut app = app();
    let tree = tree(&mut app, at_height(20.0));
    let cart = app.world_mut().spawn(Transform::default()).id();
    app.world_mut().entity_mut(cart).add_child(tree);
    send(&mut app, DropLeaves::over(tree, 60, Duration::from_secs(1)));
    steps(&mut app, SECOND / 2);
    let before = leaves(&mut app);
    app.world_mut()
        .get_mut::<Transform>(cart)
        .unwrap()
        .translation
        .x = 100.0;
    steps(&mut app, SECOND);
    let all = leaves(&mut app);
    assert_eq!(all.len(), 60);
    for leaf in all {
        let x = app.world().get::<Transform>(leaf).unwrap().translation.x;
        assert_eq!(x < 50.0, before.contains(&leaf), "{x}");
    }
}

/// The states after two seconds of a tree that has shed thirty leaves over one, at so many frames a second.
fn shed_at(hz: u32, seed: u64) -> Vec<State> {
    let mut app = app();
    app.insert_resource(TimeUpdateStrategy::ManualDuration(
        Duration::from_secs(1) / hz,
    ));
    let tree = tree(&mut app, at_height(20.0));
    app.world_mut().get_mut::<Crown>(tree).unwrap().seed = seed;
    send(&mut app, DropLeaves::over(tree, 30, Duration::from_secs(1)));
    loop {
        app.update();
        let states = states(&mut app);
        if states.first().is_some_and(|state| state.step == 128) {
            return states;
        }
        assert!(states.first().is_none_or(|state| state.step < 128));
    }
}

#[test]
fn the_same_seed_sheds_alike_at_any_frame_rate() {
    let at_sixty_four = shed_at(64, 0);
    assert_eq!(at_sixty_four.len(), 30);
    for hz in [70, 150] {
        assert_eq!(shed_at(hz, 0), at_sixty_four, "{hz} Hz");
    }
    assert_ne!(shed_at(64, 1), at_sixty_four);
}

#[test]
fn a_tree_sheds_other_leaves_the_second_time() {
    let mut app = app();
    let tree = tree(&mut app, at_height(20.0));
    send(&mut app, DropLeaves::at_once(tree, 20));
    app.update();
    let first = states(&mut app);
    for leaf in leaves(&mut app) {
        app.world_mut().despawn(leaf);
    }
    send(&mut app, DropLeaves::at_once(tree, 20));
    app.update();
    let second = states(&mut app);
    assert_eq!((first.len(), second.len()), (20, 20));
    for (a, b) in first.iter().zip(&second) {
        assert_ne!(a.position, b.position);
    }
}

#[test]
fn leaves_of_a_mesh_share_its_bake() {
    let mut app = app();
    let sheet = Plane3d::default().mesh().size(0.08, 0.05);
    let mesh = app.world_mut().resource_mut::<Assets<Mesh>>().add(sheet);
    let crown = Crown::ball(2.0, Leaf::sheet(mesh.clone(), 450.0, 2e-4).scaled(0.5));
    let tree = app.world_mut().spawn((crown, at_height(9.0))).id();
    send(&mut app, DropLeaves::at_once(tree, 50));
    app.update();
    let leaves = leaves(&mut app);
    assert_eq!(leaves.len(), 50);
    until(&mut app, |world| {
        leaves.iter().all(|&leaf| joined(world, leaf))
    });
    for leaf in leaves {
        let world = app.world();
        assert_eq!(world.get::<Mesh3d>(leaf), Some(&Mesh3d(mesh.clone())));
        assert_eq!(
            world.get::<Transform>(leaf).unwrap().scale,
            Vec3::splat(0.5)
        );
    }
    assert_eq!(app.world().resource::<Assets<BakedBody>>().len(), 1);
}

#[test]
fn nonsense_is_one_line_in_the_log() {
    let _turn = listening();
    let mut app = app();
    let with = |app: &mut App, change: fn(&mut Crown, &mut Transform)| {
        let (mut crown, mut place) = (crown(app), at_height(20.0));
        change(&mut crown, &mut place);
        app.world_mut().spawn((crown, place)).id()
    };
    let gone = with(&mut app, |_, _| {});
    app.world_mut().despawn(gone);
    let bare = app.world_mut().spawn(at_height(0.0)).id();
    let cases = [
        (gone, 5, "gone"),
        (bare, 5, "Crown"),
        (with(&mut app, |_, _| {}), 0, "none"),
        (
            with(&mut app, |_, place| place.scale = Vec3::ZERO),
            5,
            "scaled to nothing",
        ),
        (
            with(&mut app, |_, place| place.scale.y = 0.0),
            5,
            "scaled to nothing",
        ),
        (
            with(&mut app, |_, place| place.translation.x = f32::NAN),
            5,
            "not finite",
        ),
        (
            with(&mut app, |_, place| place.scale.x = f32::INFINITY),
            5,
            "not finite",
        ),
        (
            with(&mut app, |crown, _| crown.half_extents.x = -1.0),
            5,
            "half-extents",
        ),
        (
            with(&mut app, |crown, _| crown.centre.x = f32::NAN),
            5,
            "half-extents",
        ),
        (
            with(&mut app, |crown, _| crown.leaf.scale = 0.0),
            5,
            "scale",
        ),
        (
            with(&mut app, |crown, _| {
                crown.leaf.source = BodySource::Mesh {
                    density: 450.0,
                    thickness: None,
                };
            }),
            5,
            "mesh",
        ),
    ];
    for (tree, count, word) in cases {
        errors().clear();
        for _ in 0..3 {
            send(&mut app, DropLeaves::at_once(tree, count));
            steps(&mut app, 2);
        }
        let errors = errors();
        assert_eq!(errors.len(), 1, "{word}: {errors:?}");
        assert!(errors[0].contains(word), "{word}: {errors:?}");
    }
    assert!(leaves(&mut app).is_empty());
}

#[test]
fn there_are_no_more_leaves_than_the_limit() {
    let _turn = listening();
    let mut app = app();
    app.insert_resource(LeafLimit(40));
    let tree = tree(&mut app, at_height(20.0));
    send(
        &mut app,
        DropLeaves::over(tree, 30, Duration::from_secs(3600)),
    );
    app.update();
    assert!(errors().is_empty(), "{:?}", errors());
    send(&mut app, DropLeaves::at_once(tree, u32::MAX));
    app.update();
    let shed = leaves(&mut app);
    assert!((10..=11).contains(&shed.len()), "{}", shed.len());
    assert_eq!(errors().len(), 1, "{:?}", errors());
    assert!(
        errors()[0].contains("4294967295") && errors()[0].contains("sheds 10"),
        "{:?}",
        errors()
    );
    // One that goes makes room for one.
    app.world_mut().despawn(shed[0]);
    send(&mut app, DropLeaves::at_once(tree, 2));
    app.update();
    assert_eq!(leaves(&mut app).len(), shed.len());
}

#[test]
fn a_tree_that_goes_while_it_sheds_is_one_line() {
    let _turn = listening();
    let mut app = app();
    let tree = tree(&mut app, at_height(20.0));
    send(
        &mut app,
        DropLeaves::over(tree, 100, Duration::from_secs(2)),
    );
    steps(&mut app, SECOND);
    app.world_mut().despawn(tree);
    steps(&mut app, 2 * SECOND);
    let count = leaves(&mut app).len();
    assert!(count.abs_diff(50) <= 1, "{count}");
    assert_eq!(errors().len(), 1, "{:?}", errors());
    assert!(errors()[0].contains("gone"), "{:?}", errors());
}
