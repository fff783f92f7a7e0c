//! Bodies that come from meshes and files, and what the log says of those that do not.

#![allow(clippy::unwrap_used)]

mod common;

use bevy_app::App;
use bevy_asset::{AssetServer, Assets, Handle};
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::langevin_rigid::Body;
use bevy_langevin_rigid::{
    AngularVelocity, BakedBody, BodySource, Immersed, ImmersionSettings, Stepped,
};
use bevy_math::primitives::{Cuboid, Plane3d};
use bevy_math::{DVec3, Quat, Vec3};
use bevy_mesh::{Mesh, Mesh3d, Meshable};
use bevy_transform::components::Transform;

use common::log::{errors, listening};
use common::{app, at_height, joined, state, steps, until};

fn mesh(app: &mut App, mesh: impl Into<Mesh>) -> Mesh3d {
    Mesh3d(app.world_mut().resource_mut::<Assets<Mesh>>().add(mesh))
}

fn baked_bodies(app: &App) -> usize {
    app.world().resource::<Assets<BakedBody>>().len()
}

#[test]
fn a_mesh_is_baked_once_and_its_bodies_join() {
    let _turn = listening();
    let mut app = app();
    let mesh = mesh(&mut app, Cuboid::new(0.2, 0.01, 0.1));
    let bodies: Vec<Entity> = (0..3)
        .map(|_| {
            let bundle = (mesh.clone(), at_height(2.0), Immersed::solid(300.0));
            app.world_mut().spawn(bundle).id()
        })
        .collect();
    until(&mut app, |world| {
        bodies.iter().all(|&body| joined(world, body))
    });
    assert_eq!(baked_bodies(&app), 1);
    steps(&mut app, 64);
    for &body in &bodies {
        let height = state(&app, body).position[1];
        assert!(height < 1.5 && height > -3.0, "{height}");
        assert!(!app.world().get::<Stepped>(body).unwrap().falls_plainly());
    }
    assert!(errors().is_empty(), "{:?}", errors());

    let other = (mesh, at_height(2.0), Immersed::solid(301.0));
    let other = app.world_mut().spawn(other).id();
    until(&mut app, |world| joined(world, other));
    assert_eq!(baked_bodies(&app), 2);
}

#[test]
fn an_open_sheet_is_given_its_thickness() {
    let mut app = app();
    let plane = mesh(&mut app, Plane3d::default().mesh().size(0.148, 0.105));
    let bundle = (plane, at_height(50.0), Immersed::sheet(750.0, 1e-4));
    let entity = app.world_mut().spawn(bundle).id();
    until(&mut app, |world| joined(world, entity));
    steps(&mut app, 128);
    let fallen = 50.0 - state(&app, entity).position[1];
    assert!(fallen > 0.2 && fallen < 6.0, "{fallen}");
}

#[test]
fn a_mesh_away_from_its_origin_turns_about_its_centre_of_mass() {
    let mut app = app();
    let cube = Mesh::from(Cuboid::new(0.1, 0.1, 0.1)).translated_by(Vec3::X);
    let cube = mesh(&mut app, cube);
    let bundle = (
        cube,
        at_height(2.0).with_scale(Vec3::splat(2.0)),
        Immersed::solid(500.0),
    );
    let entity = app.world_mut().spawn(bundle).id();
    until(&mut app, |world| joined(world, entity));
    assert!((state(&app, entity).position[0] - 2.0).abs() < 1e-5);
    app.world_mut()
        .get_mut::<AngularVelocity>(entity)
        .unwrap()
        .0 = Vec3::new(1.0, 2.0, 3.0);
    steps(&mut app, 16);
    let state = state(&app, entity);
    // A frame without overstep draws the step before the last.
    app.update();
    let transform = app.world().get::<Transform>(entity).unwrap();
    let centre = transform.transform_point(Vec3::X).as_dvec3();
    assert!(transform.rotation.angle_between(Quat::IDENTITY) > 0.5);
    assert!((centre - DVec3::from(state.position)).length() < 1e-5);
}

#[test]
fn a_mesh_with_a_hole_is_one_error_and_falls_plainly() {
    let _turn = listening();
    let mut app = app();
    let open = mesh(&mut app, Plane3d::default().mesh().size(0.1, 0.1));
    let bodies: Vec<Entity> = (0..5)
        .map(|_| {
            let bundle = (open.clone(), at_height(20.0), Immersed::solid(500.0));
            app.world_mut().spawn(bundle).id()
        })
        .collect();
    until(&mut app, |world| {
        bodies.iter().all(|&body| joined(world, body))
    });
    let begun = state(&app, bodies[0]);
    steps(&mut app, 64);
    for &body in &bodies {
        let now = state(&app, body);
        let time = now.time;
        assert!((now.position[1] - (20.0 - 0.5 * 9.81 * time * time)).abs() < 1e-9);
        assert_eq!(now.step, begun.step + 64);
    }
    let errors = errors();
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert!(errors[0].contains("cannot be baked"), "{errors:?}");
}

#[test]
fn what_a_body_lacks_is_one_error() {
    let _turn = listening();
    let mut app = app();
    let bare = app.world_mut().spawn(Immersed::solid(500.0)).id();
    let body = common::sheet(&mut app);
    let squashed = at_height(2.0).with_scale(Vec3::new(1.0, 2.0, 1.0));
    let squashed = app
        .world_mut()
        .spawn((squashed, Immersed::baked(body)))
        .id();
    let nowhere = at_height(f32::NAN);
    let nowhere = app
        .world_mut()
        .spawn((nowhere, Immersed::solid(500.0)))
        .id();
    steps(&mut app, 10);
    assert!(joined(app.world(), bare) && joined(app.world(), squashed));
    assert!(!joined(app.world(), nowhere));
    let errors = errors();
    assert_eq!(errors.len(), 3, "{errors:?}");
    for word in ["Mesh3d", "scale", "quarantined"] {
        assert!(errors.iter().any(|error| error.contains(word)), "{word}");
    }
}

#[test]
fn settings_that_are_impossible_are_one_error_until_they_are_mended() {
    let _turn = listening();
    let mut app = app();
    let body = common::sheet(&mut app);
    let bodies: Vec<Entity> = (0..3)
        .map(|_| {
            let bundle = (at_height(2.0), Immersed::baked(body.clone()));
            app.world_mut().spawn(bundle).id()
        })
        .collect();
    let set_viscosity = |app: &mut App, viscosity| {
        let mut settings = app.world_mut().resource_mut::<ImmersionSettings>();
        settings.fluid.viscosity = viscosity;
        steps(app, 10);
        let plainly = |&body: &Entity| app.world().get::<Stepped>(body).unwrap().falls_plainly();
        bodies.iter().map(plainly).collect::<Vec<bool>>()
    };
    assert_eq!(set_viscosity(&mut app, 1.5e-5), [false; 3]);
    assert_eq!(set_viscosity(&mut app, -1.0), [true; 3]);
    assert_eq!(set_viscosity(&mut app, 1e-6), [false; 3]);
    let errors = errors();
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert!(errors[0].contains("viscosity"), "{errors:?}");
}

#[test]
fn entities_may_go_while_they_are_baked() {
    let mut app = app();
    let cube = mesh(&mut app, Cuboid::new(0.1, 0.2, 0.3));
    let bundle = || (cube.clone(), at_height(2.0), Immersed::solid(500.0));
    let first = app.world_mut().spawn(bundle()).id();
    app.update();
    app.world_mut().despawn(first);
    steps(&mut app, 3);
    let second = app.world_mut().spawn(bundle()).id();
    until(&mut app, |world| joined(world, second));
    assert_eq!(baked_bodies(&app), 1);
    app.world_mut().entity_mut(second).remove::<Immersed>();
    steps(&mut app, 2);
    assert!(!joined(app.world(), second));
}

#[test]
fn a_mesh_may_go_while_it_is_baked() {
    let mut app = app();
    let cube = mesh(&mut app, Cuboid::new(0.1, 0.2, 0.3));
    let id = cube.id();
    let bundle = (cube, at_height(2.0), Immersed::solid(500.0));
    let entity = app.world_mut().spawn(bundle).id();
    app.update();
    app.world_mut().resource_mut::<Assets<Mesh>>().remove(id);
    steps(&mut app, 10);
    app.world_mut().despawn(entity);
    steps(&mut app, 10);
}

#[test]
fn another_source_makes_another_body() {
    let mut app = app();
    let sheet = common::sheet(&mut app);
    let ball = Body::sphere(0.1, 2000.0).unwrap();
    let ball = app
        .world_mut()
        .resource_mut::<Assets<BakedBody>>()
        .add(ball);
    let entity = app
        .world_mut()
        .spawn((at_height(50.0), Immersed::baked(sheet)))
        .id();
    steps(&mut app, 64);
    let before = state(&app, entity);
    app.world_mut().get_mut::<Immersed>(entity).unwrap().source = BodySource::Baked(ball);
    steps(&mut app, 64);
    let fallen = before.position[1] - state(&app, entity).position[1];
    assert!(fallen > 0.9 * 0.5 * 9.81, "{fallen}");
}

#[test]
fn a_bake_file_is_an_asset_and_a_damaged_one_is_an_error() {
    let _turn = listening();
    let folder = std::env::temp_dir().join(format!("bevy_langevin_rigid-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let body = Body::plate(0.148, 0.105, 1e-4, 750.0).unwrap();
    let baked = BakedBody::from(body);
    let mut bytes = baked.bake.to_bytes();
    std::fs::write(folder.join("sheet.lrbake"), &bytes).unwrap();
    bytes[100] ^= 1;
    std::fs::write(folder.join("damaged.lrbake"), &bytes).unwrap();

    let mut app = App::new();
    app.add_plugins((
        bevy_app::TaskPoolPlugin::default(),
        bevy_time::TimePlugin,
        bevy_asset::AssetPlugin {
            file_path: folder.to_string_lossy().into_owned(),
            ..Default::default()
        },
        bevy_langevin_rigid::LangevinRigidPlugin,
    ))
    .insert_resource(bevy_time::TimeUpdateStrategy::FixedTimesteps(1));
    app.finish();
    app.cleanup();
    let spawn = |app: &mut App, name: &'static str| {
        let handle: Handle<BakedBody> = app.world().resource::<AssetServer>().load(name);
        app.world_mut()
            .spawn((at_height(2.0), Immersed::baked(handle)))
            .id()
    };
    let sheet = spawn(&mut app, "sheet.lrbake");
    let damaged = [
        spawn(&mut app, "damaged.lrbake"),
        spawn(&mut app, "damaged.lrbake"),
    ];
    until(&mut app, |world| {
        joined(world, sheet) && damaged.iter().all(|&body| joined(world, body))
    });
    let plain = |entity| app.world().get::<Stepped>(entity).unwrap().falls_plainly();
    assert!(!plain(sheet) && plain(damaged[0]) && plain(damaged[1]));
    let loaded = app.world().resource::<Assets<BakedBody>>();
    assert_eq!(
        loaded.iter().map(|(_, body)| body).collect::<Vec<_>>(),
        [&baked]
    );
    let errors = errors();
    assert_eq!(errors.len(), 1, "{errors:?}");
    assert!(errors[0].contains("damaged.lrbake"), "{errors:?}");
    std::fs::remove_dir_all(folder).unwrap();
}
