//! Bodies far from the viewer.

#![allow(clippy::unwrap_used)]

mod common;

use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::langevin_rigid::wind::{Region, Wind, WindField};
use bevy_langevin_rigid::langevin_rigid::{
    Body, Fluid, Input, NoiseStream, Settings, State, Stepper, Wrench,
};
use bevy_langevin_rigid::{
    AmbientWind, ExternalWrench, FluidRegion, Immersed, LevelOfDetail, LinearVelocity, Quarantined,
    Stepped,
};
use bevy_math::{Quat, Vec3};
use bevy_transform::components::Transform;

use common::{app, asset, at_height, sheet, state, steps};

/// One second of fixed steps.
const SECOND: usize = 64;
const DT: f64 = 1.0 / 64.0;

/// An app whose viewer is at the origin.
fn viewed() -> (App, Entity) {
    let mut app = app();
    let viewer = app.world_mut().spawn(Transform::default()).id();
    app.insert_resource(LevelOfDetail {
        viewer: Some(viewer),
        distances: [100.0, 500.0],
    });
    (app, viewer)
}

/// A sheet so far from the viewer, with its number.
fn spawn(app: &mut App, away: f32, number: u32) -> Entity {
    let body = sheet(app);
    let turn = Quat::from_rotation_x(0.1 + 0.05 * number as f32);
    let place = Transform::from_xyz(away, 0.0, 0.0).with_rotation(turn);
    let immersed = Immersed::baked(body).numbered(number);
    app.world_mut().spawn((immersed, place)).id()
}

fn drawn(app: &App, entity: Entity) -> Vec3 {
    app.world().get::<Transform>(entity).unwrap().translation
}

#[test]
fn far_bodies_take_fewer_steps_through_the_same_time() {
    let (mut app, _) = viewed();
    for (away, longest) in [(50.0, 1), (300.0, 2), (900.0, 4)] {
        for number in 0..4 {
            let entity = spawn(&mut app, away, number);
            steps(&mut app, SECOND);
            let state = state(&app, entity);
            let taken = SECOND as u64 / longest;
            assert!(
                (taken..=taken + 1).contains(&state.step),
                "{away}: {}",
                state.step
            );
            let ahead = state.time - 1.0;
            assert!((0.0..=3.0 * DT + 1e-9).contains(&ahead), "{away}: {ahead}");
        }
    }
}

#[test]
fn far_bodies_are_drawn_as_smoothly_and_as_late_as_near_ones() {
    let (mut app, _) = viewed();
    let ball = Body::sphere(0.02, 800.0).unwrap();
    let ball = asset(&mut app, ball);
    let balls = [10.0, 300.0, 900.0].map(|away| {
        let place = Transform::from_xyz(away, 0.0, 0.0);
        let thrown = LinearVelocity(Vec3::new(0.0, 0.0, 4.0));
        let bundle = (Immersed::baked(ball.clone()), place, thrown);
        app.world_mut().spawn(bundle).id()
    });
    // The first frame draws where they start.
    app.update();
    let mut last = 0.0;
    for _ in 0..SECOND {
        app.update();
        let [near, middle, far] = balls.map(|ball| drawn(&app, ball));
        for other in [middle, far] {
            // Between the ends of a step a line is drawn: g dt^2 / 8 = 5 mm for four.
            assert!((other.y - near.y).abs() < 8e-3, "{near} {other}");
            assert!((other.z - near.z).abs() < 8e-3, "{near} {other}");
        }
        assert!(far.z > last, "{far}");
        last = far.z;
    }
    assert!(last > 3.0 && drawn(&app, balls[0]).y < -3.0);
}

#[test]
fn a_far_body_that_is_moved_at_every_step_falls_no_faster() {
    let (mut app, _) = viewed();
    let ball = Body::sphere(0.02, 2000.0).unwrap();
    let immersed = Immersed::baked(asset(&mut app, ball));
    let place = Transform::from_xyz(900.0, 0.0, 0.0);
    let entity = app.world_mut().spawn((immersed, place)).id();
    steps(&mut app, 1);
    for _ in 0..SECOND / 4 {
        let mut transform = app.world_mut().get_mut::<Transform>(entity).unwrap();
        transform.translation.x += 0.1;
        steps(&mut app, 1);
    }
    // Its state is at most three fixed steps ahead; drag takes little.
    let fall = -state(&app, entity).world_velocity()[1];
    let least = 9.81 * (SECOND / 4) as f64 * DT;
    assert!(
        (0.95 * least..least + 9.81 * 4.0 * DT).contains(&fall),
        "{fall}"
    );
}

#[test]
fn a_body_takes_short_steps_again_where_the_viewer_comes_near() {
    let (mut app, viewer) = viewed();
    let entity = spawn(&mut app, 900.0, 0);
    steps(&mut app, SECOND / 2);
    let before = state(&app, entity).step;
    app.world_mut()
        .get_mut::<Transform>(viewer)
        .unwrap()
        .translation
        .x = 900.0;
    steps(&mut app, SECOND);
    let taken = state(&app, entity).step - before;
    assert!((60..=64).contains(&taken), "{taken}");
    let ahead = state(&app, entity).time - 1.5;
    assert!(ahead.abs() < 1e-9, "{ahead}");
}

/// The state of sheet 7 among others after a second.
fn among(others: u32, away: f32) -> State {
    let (mut app, _) = viewed();
    let mut wind = Wind::default();
    let region = Region::Sphere {
        centre: [f64::from(away), 0.0, 0.0],
        radius: 3.0,
        edge: 1.0,
    };
    wind.add_within(WindField::Uniform([1.0, 0.5, 0.0]), region)
        .unwrap();
    app.insert_resource(AmbientWind(wind));
    // Some of them out of the wind.
    for number in (0..others).map(|number| number + 8) {
        spawn(&mut app, away + (number % 7) as f32, number);
    }
    let entity = spawn(&mut app, away, 7);
    for number in (0..others).map(|number| number + 1000) {
        spawn(&mut app, away - (number % 5) as f32, number);
    }
    steps(&mut app, SECOND);
    state(&app, entity)
}

#[test]
fn the_bits_of_a_body_do_not_depend_on_the_others() {
    for away in [50.0, 300.0, 900.0] {
        let alone = among(0, away);
        assert!(alone.position[0] > f64::from(away) + 0.1);
        for others in [1, 30, 300] {
            assert_eq!(among(others, away), alone, "{others} at {away} m");
        }
    }
}

#[test]
fn near_bodies_move_in_lanes_as_the_library_moves_each_alone() {
    let (mut app, _) = viewed();
    let mut wind = Wind::default();
    let region = Region::Box {
        centre: [10.0, 0.0, 0.0],
        size: [6.0, 6.0, 6.0],
        edge: 1.0,
    };
    wind.add_within(WindField::Uniform([0.0, 2.0, 1.0]), region)
        .unwrap();
    app.insert_resource(AmbientWind(wind.clone()));
    let body = Body::plate(0.148, 0.105, 1e-4, 750.0).unwrap();
    let stepper = Stepper::new(&body, &Fluid::AIR, None, &Settings::default()).unwrap();
    let bodies: Vec<Entity> = (0..50)
        .map(|number| {
            let entity = spawn(&mut app, 5.0 + 0.2 * number as f32, number);
            if number % 3 == 0 {
                let force = Vec3::new(0.01, 0.0, 0.0);
                let mut wrench = app.world_mut().get_mut::<ExternalWrench>(entity).unwrap();
                wrench.force = force;
            }
            entity
        })
        .collect();
    let first = app
        .world()
        .resource::<bevy_time::Time<bevy_time::Fixed>>()
        .elapsed_secs_f64();
    app.update();
    let mut alone: Vec<State> = (0..50u32)
        .map(|number| {
            let turn = Quat::from_rotation_x(0.1 + 0.05 * number as f32);
            let mut state = State::default();
            state.position[0] = f64::from(5.0 + 0.2 * number as f32);
            state.orientation = turn.as_dquat().normalize().to_array();
            state
        })
        .collect();
    for step in 0..SECOND {
        for (number, state) in alone.iter_mut().enumerate() {
            let time = first + DT * step as f64;
            let force = if number % 3 == 0 {
                f64::from(0.01_f32)
            } else {
                0.0
            };
            let input = Input {
                flow: wind.flow(state.position, time, [0.0; 3]),
                wrench: Wrench {
                    force: [force, 0.0, 0.0],
                    ..Wrench::default()
                },
                noise: NoiseStream {
                    seed: 0,
                    body: number as u32,
                },
            };
            stepper.step(state, DT, &input).unwrap();
        }
        for (number, &entity) in bodies.iter().enumerate() {
            assert_eq!(state(&app, entity), alone[number], "{number} after {step}");
        }
        app.update();
    }
}

#[test]
fn far_leaves_fall_as_fast_as_near_ones() {
    let fallen = |away: f32| {
        let (mut app, _) = viewed();
        let bodies: Vec<Entity> = (0..200)
            .map(|number| spawn(&mut app, away, number))
            .collect();
        steps(&mut app, 4 * SECOND);
        let depths = bodies.iter().map(|&body| -f64::from(drawn(&app, body).y));
        depths.sum::<f64>() / 200.0
    };
    let near = fallen(50.0);
    for away in [300.0, 900.0] {
        let far = fallen(away);
        assert!((far / near - 1.0).abs() < 0.1, "{near} {far}");
    }
}

#[test]
fn what_the_game_does_to_a_far_body_is_done_at_the_next_step() {
    let far = || {
        let (mut app, _) = viewed();
        let entity = spawn(&mut app, 900.0, 2);
        steps(&mut app, SECOND / 2 + 1);
        (app, entity)
    };
    for more in 0..4 {
        let (mut app, entity) = far();
        steps(&mut app, more);
        let mut wrench = app.world_mut().get_mut::<ExternalWrench>(entity).unwrap();
        wrench.force.z = 1.0;
        steps(&mut app, 4);
        let pushed = state(&app, entity);
        assert!(pushed.world_velocity()[2] > 1.0, "{pushed:?}");
        // It is not ahead any more.
        let since = (33 + more + 4) as f64 * DT;
        assert!(
            (pushed.time - since).abs() < 1e-9,
            "{} {since}",
            pushed.time
        );

        let (mut app, entity) = far();
        steps(&mut app, more);
        app.world_mut().get_mut::<LinearVelocity>(entity).unwrap().0 = Vec3::Z;
        let before = drawn(&app, entity);
        steps(&mut app, 2);
        let moved = drawn(&app, entity) - before;
        assert!(moved.z > 0.01, "{moved}");

        let (mut app, entity) = far();
        steps(&mut app, more);
        app.world_mut()
            .get_mut::<Transform>(entity)
            .unwrap()
            .translation
            .y = 77.0;
        for _ in 0..3 {
            app.update();
            let y = drawn(&app, entity).y;
            assert!((y - 77.0).abs() < 0.2, "{y}");
        }
    }
}

#[test]
fn without_a_viewer_all_bodies_are_near() {
    let lost: [fn(&mut App, Entity); 3] = [
        |app, _| app.world_mut().resource_mut::<LevelOfDetail>().viewer = None,
        |app, viewer| {
            app.world_mut().despawn(viewer);
        },
        |app, viewer| {
            app.world_mut()
                .get_mut::<Transform>(viewer)
                .unwrap()
                .translation
                .x = f32::NAN;
        },
    ];
    for lose in lost {
        let (mut app, viewer) = viewed();
        lose(&mut app, viewer);
        let entity = spawn(&mut app, 900.0, 0);
        steps(&mut app, SECOND);
        assert_eq!(state(&app, entity).step, SECOND as u64);
    }
}

#[test]
fn a_far_block_floats() {
    let (mut app, _) = viewed();
    app.world_mut().spawn((FluidRegion::sea(), at_height(-0.5)));
    let block = asset(&mut app, Body::cuboid([0.2, 0.05, 0.1], 600.0).unwrap());
    let place = Transform::from_xyz(900.0, 0.0, 0.0);
    let entity = app.world_mut().spawn((Immersed::baked(block), place)).id();
    steps(&mut app, 20 * SECOND);
    assert!((state(&app, entity).position[1] + 0.505).abs() < 3e-3);
}

#[test]
fn a_far_body_that_cannot_go_on_is_quarantined_alone() {
    let (mut app, _) = viewed();
    let mut storm = Wind::default();
    let region = Region::Sphere {
        centre: [1000.0, 0.0, 0.0],
        radius: 10.0,
        edge: 1.0,
    };
    let beyond = WindField::Uniform([1e200, 0.0, 0.0]);
    storm.add_within(beyond, region).unwrap();
    let [sound, broken] = [900.0, 1000.0].map(|away| spawn(&mut app, away, 0));
    steps(&mut app, 8);
    app.insert_resource(AmbientWind(storm));
    steps(&mut app, 8);
    let world = app.world();
    assert!(world.get::<Quarantined>(broken).is_some());
    assert!(world.get::<Quarantined>(sound).is_none());
    assert_eq!(world.get::<Stepped>(sound).unwrap().state().step, 4);
}
