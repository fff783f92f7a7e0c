//! Motions under contact that are known in closed form.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::*;
use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::norm;
use langevin_rigid::{Body, Fluid, State};
use langevin_rigid_world::{Obstacle, Shape, World};

#[test]
fn a_ball_bounces_to_the_square_of_its_restitution() {
    let radius = 0.02;
    let ball = Body::sphere(radius, 500.0).unwrap();
    for restitution in [0.0, 0.3, 0.7, 1.0] {
        let kind = kind(&ball, &THIN, DOWN, material(0.3, restitution));
        let mut world = World::new(DOWN);
        world.add_obstacle(ground(material(0.3, 0.0)));
        world.add(kind, at([0.0, 1.0 + radius, 0.0]), noise(0));
        let mut highest: f64 = 0.0;
        let mut rising = false;
        for _ in 0..10_000 {
            world.step(1e-4).unwrap();
            let up = world.state(0).world_velocity()[1];
            if rising && up < 0.0 {
                break;
            }
            rising |= up > 0.0;
            if rising {
                highest = highest.max(world.state(0).position[1] - radius);
            }
        }
        let expected = restitution * restitution;
        assert!(
            (highest - expected).abs() < 4e-3,
            "{restitution}: {highest} m"
        );
    }
}

/// Along the slope: positions of a brick after each of some times, on a plane tilted by `angle`.
fn slide(angle: f64, friction: f64, times: [f64; 2]) -> [f64; 2] {
    let brick = Body::cuboid([0.1, 0.03, 0.06], 500.0).unwrap();
    let kind = kind(&brick, &THIN, DOWN, material(friction, 0.0));
    let (sin, cos) = angle.sin_cos();
    let mut world = World::new(DOWN);
    let slope = Obstacle::half_space([sin, cos, 0.0], 0.0, material(friction, 0.0)).unwrap();
    world.add_obstacle(slope);
    let high = 0.01505;
    world.add(
        kind,
        turned([high * sin, high * cos, 0.0], [0.0, 0.0, -angle]),
        noise(0),
    );
    let mut now = 0.0;
    times.map(|time| {
        run(&mut world, time - now, 1e-3);
        now = time;
        let [x, y, _] = world.state(0).position;
        x * cos - y * sin
    })
}

#[test]
fn a_brick_slides_down_a_steep_slope() {
    let friction = 0.4;
    for angle in [0.5, 0.8] {
        let [_, way] = slide(angle, friction, [0.5, 1.0]);
        let expected = 0.5 * G * (angle.sin() - friction * angle.cos());
        assert!(
            (way / expected - 1.0).abs() < 5e-3,
            "{angle}: {way} m, expected {expected}"
        );
    }
}

#[test]
fn a_brick_stays_on_a_gentle_slope() {
    for angle in [0.1f64, 0.3, 0.37] {
        let [first, second] = slide(angle, 0.4, [0.3, 2.3]);
        let creep = (second - first) / 2.0;
        assert!(creep.abs() < 1e-4, "{angle}: {creep} m/s");
    }
}

#[test]
fn a_ball_and_a_wheel_roll_down_a_slope() {
    let angle: f64 = 0.3;
    let (sin, cos) = angle.sin_cos();
    let radius = 0.03;
    let ball = Body::sphere(radius, 500.0).unwrap();
    // Its axis is x.
    let wheel = Body::cylinder(radius, 0.02, 500.0).unwrap();
    // Corners lose energy where they meet the ground, the less the more there are.
    let (points, corners) = (16000, 400);
    let golden = 2.399963229728653;
    let of_ball: Vec<Vec3> = (0..points)
        .map(|i| {
            let y = 1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(points);
            let (sin, cos) = (golden * f64::from(i)).sin_cos();
            let across = (1.0 - y * y).sqrt();
            [radius * across * cos, radius * y, radius * across * sin]
        })
        .collect();
    let of_wheel: Vec<Vec3> = (0..2 * corners)
        .map(|i| {
            let (sin, cos) =
                (std::f64::consts::TAU * f64::from(i / 2) / f64::from(corners)).sin_cos();
            [
                if i % 2 == 0 { 0.01 } else { -0.01 },
                radius * cos,
                radius * sin,
            ]
        })
        .collect();
    let quarter = std::f64::consts::FRAC_PI_2;
    for (body, points, turn, share) in [
        (ball, of_ball, [0.0; 3], 2.0 / 5.0),
        (wheel, of_wheel, [0.0, quarter, 0.0], 0.5),
    ] {
        let shape = Shape::convex_hull(&points).unwrap();
        let kind = shaped(&body, shape, &THIN, DOWN, material(0.6, 0.0));
        let mut world = World::new(DOWN);
        let slope = Obstacle::half_space([sin, cos, 0.0], 0.0, material(0.6, 0.0)).unwrap();
        world.add_obstacle(slope);
        let high = radius * 1.001;
        world.add(kind, turned([high * sin, high * cos, 0.0], turn), noise(0));
        run(&mut world, 1.0, 2e-4);
        let state = world.state(0);
        let (speed, spin) = (
            norm(state.world_velocity()),
            norm(state.world_angular_velocity()),
        );
        let expected = G * sin / (1.0 + share);
        assert!(
            (speed / expected - 1.0).abs() < 0.03,
            "{share}: {speed} m/s, expected {expected}"
        );
        assert!(
            (spin * radius / speed - 1.0).abs() < 0.02,
            "{share}: slips, {spin} rad/s"
        );
    }
}

#[test]
fn a_push_off_the_centre_turns_a_body_as_its_whole_mass_says() {
    // A heavy ball meets the end of a plate in water, without friction: one impulse along y.
    let plate = Body::plate(0.2, 0.1, 0.01, 600.0).unwrap();
    let ball = Body::sphere(0.02, 3000.0).unwrap();
    let smooth = material(0.0, 0.0);
    let plate = kind(&plate, &Fluid::WATER, [0.0; 3], smooth);
    let ball = kind(&ball, &Fluid::WATER, [0.0; 3], smooth);
    let mut world = World::new([0.0; 3]);
    world.add(plate.clone(), State::default(), noise(0));
    let mut falling = at([0.07, 0.0255, 0.0]);
    falling.velocity = [0.0, -1.0, 0.0];
    world.add(ball.clone(), falling, noise(1));
    run(&mut world, 2e-3, 1e-3);
    let inverse = plate.stepper().inverse_total_mass();
    let light = ball.stepper().inverse_total_mass()[1][1];
    // The nearest corner of the ball may lie a little off its axis.
    let state = world.state(0);
    let impulse = state.velocity[1] / inverse[1][1];
    let arm = state.angular_velocity[2] / (impulse * inverse[5][5]);
    assert!(impulse < 0.0, "they did not meet");
    assert!((arm - 0.07).abs() < 0.003, "{arm} m");
    let expected = -1.0 / (light + inverse[1][1] + arm * arm * inverse[5][5]);
    assert!(
        (impulse / expected - 1.0).abs() < 0.01,
        "{impulse} N s, expected {expected}"
    );
}

#[test]
fn a_shape_of_another_size_touches_there() {
    let half = Shape::cuboid([0.1, 0.1, 0.1]).unwrap().scaled(0.5);
    assert!((half.radius() - 0.05 * 3f64.sqrt()).abs() < 1e-12);
}
