//! Winds that are somewhere.

#![allow(clippy::unwrap_used)]

mod common;

use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::langevin_rigid::wind::{Jet, Profile, Region, Shear, Vortex, WindField};
use bevy_langevin_rigid::{Fan, Immersed, LocalWind};
use bevy_math::{Quat, Vec3};
use bevy_transform::components::Transform;

use common::log::{errors, listening};
use common::{app, at_height, sheet, state, steps};

/// One second of fixed steps.
const SECOND: usize = 64;

#[test]
fn a_fan_blows_forwards() {
    let blown = |turn: Quat| {
        let mut app = app();
        let fan = Fan {
            speed: 4.0,
            diameter: 0.5,
        };
        app.world_mut()
            .spawn((fan, at_height(0.0).with_rotation(turn)));
        let ahead = 0.5 * (turn * Vec3::NEG_Z);
        let body = sheet(&mut app);
        let place = Transform::from_translation(ahead);
        let entity = app.world_mut().spawn((Immersed::baked(body), place)).id();
        steps(&mut app, SECOND / 2);
        Vec3::from_array(state(&app, entity).world_velocity().map(|v| v as f32))
            .dot(ahead.normalize())
    };
    for turn in [
        Quat::IDENTITY,
        Quat::from_rotation_y(1.0),
        Quat::from_rotation_y(-2.5),
    ] {
        let along = blown(turn);
        assert!(along > 0.5, "{turn}: {along}");
    }
}

/// Velocity of a sheet that was let go at `place`, after a moment (m/s).
fn blown(app: &mut App, place: Vec3) -> Vec3 {
    let body = sheet(app);
    let place = Transform::from_translation(place);
    // All go through the same turbulence.
    let immersed = Immersed::baked(body).numbered(0);
    let entity = app.world_mut().spawn((immersed, place)).id();
    steps(app, 8);
    let velocity = state(app, entity).world_velocity();
    app.world_mut().despawn(entity);
    Vec3::from_array(velocity.map(|v| v as f32))
}

#[test]
fn a_local_wind_blows_in_its_region_and_goes_with_its_entity() {
    let mut app = app();
    let draught = LocalWind {
        field: WindField::Uniform([8.0, 0.0, 0.0]),
        region: Some(Region::Sphere {
            centre: [-1.0, 0.0, 0.0],
            radius: 1.0,
            edge: 0.1,
        }),
    };
    let car = app
        .world_mut()
        .spawn(Transform::from_xyz(20.0, 0.0, 0.0))
        .id();
    app.world_mut().spawn((draught, ChildOf(car)));
    let still = blown(&mut app, Vec3::new(40.0, 0.0, 0.0));
    assert!(blown(&mut app, Vec3::new(19.0, 0.0, 0.0)).x > still.x + 0.02);
    assert_eq!(blown(&mut app, Vec3::new(21.0, 0.0, 0.0)).x, still.x);
    app.world_mut()
        .get_mut::<Transform>(car)
        .unwrap()
        .translation
        .x = 22.0;
    assert_eq!(blown(&mut app, Vec3::new(19.0, 0.0, 0.0)).x, still.x);
    assert!(blown(&mut app, Vec3::new(21.0, 0.0, 0.0)).x > still.x + 0.02);
}

#[test]
fn places_of_a_field_are_relative_to_its_entity() {
    let speed_at = |field: WindField, entity: Vec3, place: Vec3| {
        let mut app = app();
        let place_of = Transform::from_translation(entity);
        app.world_mut().spawn((
            LocalWind {
                field,
                region: None,
            },
            place_of,
        ));
        blown(&mut app, place)
    };
    let jet = Jet {
        centre: [0.0, 1.0, 0.0],
        axis: [1.0, 0.0, 0.0],
        speed: 6.0,
        diameter: 0.5,
    };
    let vortex = Vortex {
        centre: [0.0, 1.0, 0.0],
        axis: [0.0, 0.0, 1.0],
        circulation: 6.0,
        core: 0.4,
    };
    let shear = Shear {
        velocity: [3.0, 0.0, 0.0],
        height: 2.0,
        ground: -0.5,
        profile: Profile::Log { roughness: 0.03 },
    };
    for field in [jet.into(), vortex.into(), WindField::from(shear)] {
        let here = Vec3::new(0.5, 1.25, 0.0);
        let away = Vec3::new(16.0, 4.0, -8.0);
        let at_origin = speed_at(field.clone(), Vec3::ZERO, here);
        let moved = speed_at(field.clone(), away, here + away);
        assert!(
            at_origin.distance(moved) < 1e-5,
            "{field:?}: {at_origin} {moved}"
        );
        let still = speed_at(WindField::Uniform([0.0; 3]), Vec3::ZERO, here);
        assert!(at_origin.distance(still) > 1e-2, "{field:?}");
    }
}

#[test]
fn a_local_wind_that_cannot_be_is_one_error_until_it_is_mended() {
    let _turn = listening();
    let mut app = app();
    let broken = LocalWind {
        field: WindField::Uniform([f64::NAN, 0.0, 0.0]),
        region: None,
    };
    let wind = app.world_mut().spawn(broken).id();
    // An entity may have both, and each its fault.
    let fan = Fan {
        speed: 1.0,
        diameter: 0.0,
    };
    app.world_mut().entity_mut(wind).insert(fan);
    steps(&mut app, SECOND);
    assert_eq!(errors().len(), 2, "{:#?}", errors());
    assert!(
        errors()
            .iter()
            .any(|error| error.contains("the local wind"))
    );
    let mended = WindField::Uniform([8.0, 0.0, 0.0]);
    app.world_mut().get_mut::<LocalWind>(wind).unwrap().field = mended;
    assert!(blown(&mut app, Vec3::ZERO).x > 0.02);
    assert_eq!(errors().len(), 2);
}
