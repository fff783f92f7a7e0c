//! Lakes and fans.

#![allow(clippy::unwrap_used)]

mod common;

use bevy_app::App;
use bevy_ecs::prelude::*;
use bevy_langevin_rigid::langevin_rigid::{Body, Fluid, NoiseStream, Settings, State, Stepper};
use bevy_langevin_rigid::langevin_rigid_world::water::{Immersion, WaterSurface};
use bevy_langevin_rigid::{
    Extent, Fan, FluidRegion, Immersed, ImmersionSettings, LinearVelocity, Stepped,
};
use bevy_math::{Quat, Vec3};
use bevy_time::{Fixed, Time};
use bevy_transform::components::Transform;

use common::log::{errors, listening};
use common::{app, asset, at_height, joined, state, steps};

/// One second of fixed steps.
const SECOND: usize = 64;

fn drop_body(app: &mut App, body: &Body, place: impl Bundle) -> Entity {
    let body = asset(app, body.clone());
    app.world_mut().spawn((Immersed::baked(body), place)).id()
}

fn block() -> Body {
    Body::cuboid([0.2, 0.05, 0.1], 600.0).unwrap()
}

fn immersion(body: &Body) -> Immersion {
    let [air, water] = [(&Fluid::AIR, None), (&Fluid::WATER, None)];
    Immersion::new(body, air, water, &Settings::default()).unwrap()
}

fn share(app: &App, entity: Entity, body: &Body, level: f64) -> f64 {
    let surface = WaterSurface::calm(level).unwrap();
    immersion(body).share(&state(app, entity), &surface)
}

#[test]
fn buoyancy_is_that_of_the_displaced_share() {
    let dt = 1e-4;
    for (height, share) in [(0.0, 0.5), (0.0125, 0.25), (-0.0125, 0.75)] {
        let mut app = app();
        app.insert_resource(Time::<Fixed>::from_seconds(dt));
        app.world_mut().spawn(FluidRegion::sea());
        let entity = drop_body(&mut app, &block(), at_height(height));
        app.update();
        let state = state(&app, entity);
        assert!((state.time - dt).abs() < 1e-12);
        let block = block();
        let mass = immersion(&block).total_mass(share)[1][1];
        let force = mass * state.world_velocity()[1] / dt;
        let displaced = share * Fluid::WATER.density + (1.0 - share) * Fluid::AIR.density;
        let wanted = 9.81 * (displaced * block.volume - block.mass);
        assert!(
            (force / wanted - 1.0).abs() < 2e-3,
            "{share}: {force} {wanted}"
        );
    }
}

#[test]
fn a_block_floats_as_deep_as_it_is_heavy() {
    let mut app = app();
    let lake = FluidRegion::lake(Vec3::new(4.0, 2.0, 4.0));
    app.world_mut().spawn((lake, at_height(2.0)));
    let entity = drop_body(&mut app, &block(), at_height(3.2));
    steps(&mut app, 20 * SECOND);
    let share = share(&app, entity, &block(), 3.0);
    assert!(
        (share - 600.0 / Fluid::WATER.density).abs() < 0.01,
        "{share}"
    );
}

#[test]
fn a_coin_crosses_the_surface_as_the_library_alone_lets_it_cross() {
    let coin = Body::disc(0.012, 0.002, 7000.0).unwrap();
    let mut app = app();
    app.world_mut().spawn(FluidRegion::sea());
    let turn = Quat::from_rotation_x(0.3);
    let entity = drop_body(&mut app, &coin, at_height(0.5).with_rotation(turn));
    let mut alone = State::default();
    alone.position[1] = 0.5;
    alone.orientation = turn.as_dquat().normalize().to_array();
    let (immersion, surface) = (immersion(&coin), WaterSurface::calm(0.0).unwrap());
    let noise = NoiseStream { seed: 0, body: 0 };
    for step in 0..2 * SECOND {
        app.update();
        immersion
            .step(&mut alone, 1.0 / 64.0, &noise.into(), &surface)
            .unwrap();
        assert_eq!(state(&app, entity), alone, "{step}");
    }
    assert!(alone.position[1] < -0.3);
}

#[test]
fn coins_end_at_their_terminal_speed_in_water() {
    let coin = Body::disc(0.012, 0.002, 7000.0).unwrap();
    let mut app = app();
    app.world_mut().spawn(FluidRegion::sea());
    let body = asset(&mut app, coin.clone());
    let dropped: Vec<Entity> = (0..32)
        .map(|number| {
            let coin = Immersed::baked(body.clone()).numbered(number);
            app.world_mut().spawn((coin, at_height(1.0))).id()
        })
        .collect();
    let stepper = Stepper::new(&coin, &Fluid::WATER, None, &Settings::default()).unwrap();
    let mut in_water = [State::default(); 32];
    // Coins flutter, each at a speed of its own: means over all of them and ten seconds.
    let mut depths = [[0.0; 2]; 2];
    for depth in &mut depths {
        steps(&mut app, 10 * SECOND);
        for (state, body) in in_water.iter_mut().zip(0..) {
            let noise = NoiseStream { seed: 1, body };
            for _ in 0..10 * SECOND {
                stepper.step(state, 1.0 / 64.0, &noise.into()).unwrap();
            }
        }
        let heights = dropped.iter().map(|&coin| state(&app, coin).position[1]);
        let alone = in_water.iter().map(|state| state.position[1]);
        *depth = [heights.sum(), alone.sum()];
    }
    let [dropped, in_water] = [0, 1].map(|i| (depths[0][i] - depths[1][i]) / 320.0);
    assert!(in_water > 0.1);
    assert!(
        (dropped / in_water - 1.0).abs() < 0.05,
        "{dropped} {in_water}"
    );
}

#[test]
fn a_leaf_comes_to_rest_on_the_water() {
    let leaf = Body::plate(0.08, 0.05, 0.2e-3, 450.0).unwrap();
    let mut app = app();
    app.world_mut().spawn(FluidRegion::sea());
    let entity = drop_body(&mut app, &leaf, at_height(0.5));
    steps(&mut app, 10 * SECOND);
    let state = state(&app, entity);
    assert!(state.position[1].abs() < 2e-3, "{:?}", state.position);
    let share = share(&app, entity, &leaf, 0.0);
    assert!(
        (share - 450.0 / Fluid::WATER.density).abs() < 0.05,
        "{share}"
    );
}

#[test]
fn a_current_carries_what_floats() {
    let mut app = app();
    let fluid = Fluid {
        velocity: [0.4, 0.0, -0.2],
        ..Fluid::WATER
    };
    let river = FluidRegion {
        fluid,
        ..FluidRegion::sea()
    };
    app.world_mut().spawn(river);
    let entity = drop_body(&mut app, &block(), at_height(0.0));
    steps(&mut app, 20 * SECOND);
    let [x, _, z] = state(&app, entity).world_velocity();
    assert!((x - 0.4).abs() < 0.05 && (z + 0.2).abs() < 0.05, "{x} {z}");
}

#[test]
fn beside_a_lake_and_under_it_there_is_no_water() {
    let mut app = app();
    let lake = FluidRegion::lake(Vec3::new(2.0, 1.0, 6.0));
    // Turned: long along x.
    let turn = Quat::from_rotation_y(std::f32::consts::FRAC_PI_2);
    app.world_mut()
        .spawn((lake, at_height(0.0).with_rotation(turn)));
    let inside = drop_body(&mut app, &block(), Transform::from_xyz(2.5, 0.0, 0.0));
    let beside = drop_body(&mut app, &block(), Transform::from_xyz(0.0, 0.0, 1.5));
    let under = drop_body(&mut app, &block(), at_height(-0.6));
    steps(&mut app, SECOND / 4);
    let speed = |entity| state(&app, entity).world_velocity()[1];
    assert!(speed(inside) > 0.1, "{}", speed(inside));
    assert!(speed(beside) < -1.5 && speed(under) < -1.5);
}

#[test]
fn of_two_lakes_the_higher_one_holds() {
    let mut app = app();
    app.world_mut().spawn((FluidRegion::sea(), at_height(-5.0)));
    let pool = FluidRegion::lake(Vec3::ONE);
    let pool = app.world_mut().spawn((pool, at_height(2.5))).id();
    let entity = drop_body(&mut app, &block(), at_height(3.1));
    steps(&mut app, 20 * SECOND);
    assert!((state(&app, entity).position[1] - 3.0).abs() < 0.05);
    app.world_mut().despawn(pool);
    steps(&mut app, 20 * SECOND);
    assert!((state(&app, entity).position[1] + 5.0).abs() < 0.05);
}

#[test]
fn a_body_that_water_comes_over_keeps_its_momentum() {
    let ball = Body::sphere(0.1, Fluid::WATER.density).unwrap();
    let mut app = app();
    app.insert_resource(Time::<Fixed>::from_seconds(1e-4));
    let velocity = LinearVelocity(3.0 * Vec3::X);
    let entity = drop_body(&mut app, &ball, (at_height(-5.0), velocity));
    app.update();
    let before = state(&app, entity).world_velocity()[0];
    app.world_mut().spawn(FluidRegion::sea());
    app.update();
    let after = state(&app, entity).world_velocity()[0];
    // Water adds half its own mass.
    assert!(
        (after / before - 2.0 / 3.0).abs() < 0.01,
        "{before} {after}"
    );

    let put = Transform::from_xyz(1.0, -5.0, 0.0);
    *app.world_mut().get_mut::<Transform>(entity).unwrap() = put;
    app.world_mut().get_mut::<LinearVelocity>(entity).unwrap().0 = 3.0 * Vec3::X;
    app.update();
    let put = state(&app, entity).world_velocity()[0];
    assert!((put / 3.0 - 1.0).abs() < 0.01, "{put}");
}

#[test]
fn a_region_is_where_its_parent_is_now() {
    let mut app = app();
    let world = app.world_mut();
    let ship = world.spawn(at_height(0.0)).id();
    let tank = FluidRegion::lake(Vec3::ONE);
    world.spawn((tank, at_height(0.0), ChildOf(ship)));
    let entity = drop_body(&mut app, &block(), Transform::from_xyz(10.0, 0.0, 0.0));
    steps(&mut app, 4);
    assert!(state(&app, entity).world_velocity()[1] < -0.5);
    app.world_mut()
        .get_mut::<Transform>(ship)
        .unwrap()
        .translation
        .x = 10.0;
    steps(&mut app, SECOND / 4);
    assert!(state(&app, entity).world_velocity()[1] > 0.1);
}

#[test]
fn regions_and_fans_that_cannot_be_are_one_error_each() {
    let _turn = listening();
    let mut app = app();
    let tilted = at_height(0.0).with_rotation(Quat::from_rotation_x(0.1));
    let lake = |change: fn(&mut FluidRegion)| {
        let mut lake = FluidRegion::lake(Vec3::splat(8.0));
        change(&mut lake);
        lake
    };
    let unchanged = |_: &mut FluidRegion| {};
    let mut regions = vec![
        (lake(unchanged), tilted),
        (lake(unchanged), at_height(f32::NAN)),
        (lake(unchanged), at_height(0.0).with_scale(Vec3::ZERO)),
        (lake(|lake| lake.fluid.density = f64::NAN), at_height(0.0)),
        (lake(|lake| lake.fluid.viscosity = 0.0), at_height(0.0)),
        (lake(|lake| lake.fluid.velocity[1] = 1.0), at_height(0.0)),
        (
            lake(|lake| lake.fluid.velocity[0] = f64::INFINITY),
            at_height(0.0),
        ),
        (
            lake(|lake| lake.extent = Extent::Box(Vec3::new(1.0, -1.0, 1.0))),
            at_height(0.0),
        ),
    ];
    let words = [
        "tilted",
        "not finite",
        "size",
        "density",
        "viscosity",
        "horizontal",
        "finite",
        "size",
    ];
    let expected = regions.len();
    for region in regions.drain(..) {
        app.world_mut().spawn(region);
    }
    let fan = Fan {
        speed: 1.0,
        diameter: -1.0,
    };
    let fan = app.world_mut().spawn(fan).id();
    let entity = drop_body(&mut app, &block(), at_height(0.0));
    steps(&mut app, 32);
    assert!(state(&app, entity).world_velocity()[1] < -4.0);
    {
        let errors = errors();
        assert_eq!(errors.len(), expected + 1, "{errors:#?}");
        for word in words {
            assert!(
                errors.iter().any(|error| error.contains(word)),
                "{word}: {errors:#?}"
            );
        }
    }
    // Mended and broken again is told again.
    app.world_mut().get_mut::<Fan>(fan).unwrap().diameter = 1.0;
    app.update();
    app.world_mut().get_mut::<Fan>(fan).unwrap().diameter = f32::NAN;
    app.update();
    assert_eq!(errors().len(), expected + 2, "{:#?}", errors());
}

#[test]
fn a_fluid_that_a_body_cannot_enter_is_one_error_and_not_there() {
    let _turn = listening();
    let mut app = app();
    let helium = Fluid {
        density: 0.17,
        ..Fluid::AIR
    };
    let balloon = FluidRegion {
        fluid: helium,
        ..FluidRegion::sea()
    };
    app.world_mut().spawn(balloon);
    let body = asset(&mut app, block());
    let bodies: Vec<Entity> = (0..5)
        .map(|_| app.world_mut().spawn(Immersed::baked(body.clone())).id())
        .collect();
    steps(&mut app, 32);
    for &body in &bodies {
        assert!(joined(app.world(), body));
        assert!(!app.world().get::<Stepped>(body).unwrap().falls_plainly());
        assert!(state(&app, body).world_velocity()[1] < -4.0);
    }
    assert_eq!(errors().len(), 1, "{:?}", errors());
    assert!(errors()[0].contains("denser"), "{:?}", errors());

    // With gravity askew there is no level.
    let mut settings = app.world_mut().resource_mut::<ImmersionSettings>();
    settings.motion.gravity = [1.0, -9.0, 0.0];
    steps(&mut app, 8);
    assert_eq!(errors().len(), 2, "{:?}", errors());
    assert!(errors()[1].contains("gravity"), "{:?}", errors());
}
