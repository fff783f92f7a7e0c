//! A body whose mass properties change: everything that refers to the centre of mass moves with it.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{chiral, distance};
use langevin_rigid::linalg::vector::{cross, norm, sub};
use langevin_rigid::linalg::{quat_from_rotation_vector, rotate, rotate_back};
use langevin_rigid::{Body, BodyError, Fluid, GRAVITY, Input, Model, Settings, State, Stepper};

const OFFSET: [f64; 3] = [0.004, -0.003, 0.006];

fn moving() -> State {
    State {
        position: [1.0, 2.0, -0.5],
        orientation: quat_from_rotation_vector([0.3, -0.8, 0.5]),
        velocity: [0.3, 0.2, -0.5],
        angular_velocity: [4.0, -7.0, 2.0],
        ..State::default()
    }
}

fn stepper(body: &Body, fluid: &Fluid) -> Stepper {
    let settings = Settings {
        model: Model::Kirchhoff,
        gravity: GRAVITY,
        ..Settings::default()
    };
    Stepper::new(body, fluid, None, &settings).unwrap()
}

fn slender() -> Body {
    Body::ellipsoid([0.05, 0.01, 0.02], 700.0).unwrap()
}

#[test]
fn there_and_back_is_the_identity() {
    for body in [slender(), chiral()] {
        let heavy = body
            .with_mass_properties(2.0 * body.mass, OFFSET, body.inertia)
            .unwrap();
        let back = heavy
            .with_mass_properties(body.mass, OFFSET.map(|x| -x), body.inertia)
            .unwrap();
        assert_eq!(back.mass, body.mass);
        assert!(distance(back.centre_of_buoyancy, body.centre_of_buoyancy) < 1e-17);
        let largest = |m: &[f64]| m.iter().fold(0.0f64, |a, x| a.max(x.abs()));
        let [was, is] = [&body, &back].map(|b| b.added_mass.as_flattened());
        for (i, (a, b)) in was.iter().zip(is).enumerate() {
            assert!((a - b).abs() < 1e-15 * largest(was), "entry {i}: {a} {b}");
        }
        for (a, b) in body.slices.iter().zip(&back.slices) {
            assert!(distance(a.centre, b.centre) < 1e-17);
        }
        for (a, b) in body.surface.vertices.iter().zip(&back.surface.vertices) {
            assert!(distance(*a, *b) < 1e-16);
        }
        assert_eq!(back.separation, body.separation);
    }
    let state = moving();
    let back = state.recentred(OFFSET).recentred(OFFSET.map(|x| -x));
    assert!(distance(back.position, state.position) < 1e-15);
    assert!(distance(back.velocity, state.velocity) < 1e-16);
}

#[test]
fn material_points_keep_their_places_and_velocities() {
    let (body, state) = (slender(), moving());
    let moved = body
        .with_mass_properties(body.mass, OFFSET, body.inertia)
        .unwrap();
    let recentred = state.recentred(OFFSET);
    for (p, q) in body.surface.vertices.iter().zip(&moved.surface.vertices) {
        let place = |state: &State, p: [f64; 3]| {
            let arm = rotate(state.orientation, p);
            [0, 1, 2].map(|i| state.position[i] + arm[i])
        };
        assert!(distance(place(&state, *p), place(&recentred, *q)) < 1e-15);
        let velocity = |state: &State, p: [f64; 3]| {
            let turning = cross(state.angular_velocity, p);
            [0, 1, 2].map(|i| state.velocity[i] + turning[i])
        };
        assert!(distance(velocity(&state, *p), velocity(&recentred, *q)) < 1e-15);
    }
}

/// Energy and impulse of the fluid do not care which point they are told from; the angular impulse shifts
/// by the linear one. What the body adds is known in closed form.
#[test]
fn energy_and_impulses_follow_the_shift_rule() {
    for body in [slender(), chiral()] {
        let moved = body
            .with_mass_properties(body.mass, OFFSET, body.inertia)
            .unwrap();
        let (state, recentred) = (moving(), moving().recentred(OFFSET));
        let dry = |body: &Body, state: &State| {
            let mut alone = body.clone();
            alone.added_mass = [[0.0; 6]; 6];
            let alone = stepper(&alone, &Fluid::WATER);
            let all = stepper(body, &Fluid::WATER);
            (
                all.kinetic_energy(state) - alone.kinetic_energy(state),
                sub(all.linear_impulse(state), alone.linear_impulse(state)),
                sub(all.angular_impulse(state), alone.angular_impulse(state)),
            )
        };
        let (energy, impulse, angular) = dry(&body, &state);
        let (moved_energy, moved_impulse, moved_angular) = dry(&moved, &recentred);
        assert!((moved_energy / energy - 1.0).abs() < 1e-12);
        assert!(distance(moved_impulse, impulse) < 1e-12 * norm(impulse));
        // In the world frame both are about the origin of the world.
        assert!(distance(moved_angular, angular) < 1e-12 * norm(angular));
    }
}

#[test]
fn in_next_to_nothing_the_hull_does_not_matter() {
    let vacuum = Fluid {
        density: 1e-9,
        ..Fluid::AIR
    };
    let body = slender();
    let moved = body
        .with_mass_properties(body.mass, OFFSET, body.inertia)
        .unwrap();
    let [a, b] = [&body, &moved].map(|body| {
        let (stepper, mut state) = (stepper(body, &vacuum), moving());
        for _ in 0..500 {
            stepper.step(&mut state, 1e-3, &Input::default()).unwrap();
        }
        state
    });
    assert!(distance(a.position, b.position) < 1e-9);
    assert!(distance(a.world_angular_velocity(), b.world_angular_velocity()) < 1e-7);
}

/// Cargo that is let go of: told from the new centre of mass the hull goes on where it was.
#[test]
fn a_ballasted_body_rights_itself() {
    let ball = Body::sphere(0.05, 900.0).unwrap();
    let keel = [0.0, -0.01, 0.0];
    let weighted = ball
        .with_mass_properties(ball.mass, keel, ball.inertia)
        .unwrap();
    let stepper = Stepper::new(&weighted, &Fluid::WATER, None, &Settings::default()).unwrap();
    let mut state = State {
        orientation: quat_from_rotation_vector([0.0, 0.0, 1.0]),
        ..State::default()
    };
    let uprightness = |state: &State| rotate_back(state.orientation, [0.0, 1.0, 0.0])[1];
    let mut most = uprightness(&state);
    for _ in 0..2000 {
        stepper.step(&mut state, 1e-3, &Input::default()).unwrap();
        most = most.max(uprightness(&state));
    }
    assert!(most > 0.99, "{most}");
}

#[test]
fn impossible_mass_properties_are_named() {
    let body = slender();
    let with = |mass, centre, inertia| {
        body.with_mass_properties(mass, centre, inertia)
            .unwrap_err()
    };
    let at = [0.0; 3];
    assert!(matches!(
        with(-1.0, at, body.inertia),
        BodyError::Negative { name: "mass", .. }
    ));
    assert_eq!(
        with(1.0, [f64::NAN, 0.0, 0.0], body.inertia),
        BodyError::CentreOfMass
    );
    assert_eq!(with(1.0, at, [[0.0; 3]; 3]), BodyError::Inertia);
}
