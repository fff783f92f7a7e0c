//! The model `separated` as the run time has it: no energy from nothing, long bodies broadside.
//!
//! A closure that feeds energy makes light bodies spin up for ever; one that has lost the couple of
//! potential flow lets a long body fall along its axis. Which plates flutter and which tumble is
//! tested where the plates are, with the files.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{distance, ellipsoid};
use langevin_rigid::linalg::{quat_from_rotation_vector, rotate};
use langevin_rigid::{
    Fluid, Input, Model, NoiseStream, SeparatedFlow, Separation, Settings, State, Stepper,
};

fn diagonal(d: [f64; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| if i == j { d[i] } else { 0.0 }))
}

#[test]
fn without_weight_energy_never_grows() {
    let fluid = Fluid {
        density: 1.0,
        viscosity: 1e-6,
        velocity: [0.0; 3],
    };
    let settings = Settings {
        model: Model::Separated,
        gravity: [0.0; 3],
        separated: SeparatedFlow {
            turbulence_intensity: 0.0,
            ..SeparatedFlow::default()
        },
        ..Settings::default()
    };
    // A light disc: I* is 0.01.
    let disc = common::ellipsoid([0.5, 0.025, 0.5], 7.5);
    let stepper = Stepper::new(&disc, &fluid, None, &settings).unwrap();
    for seed in 0..50 {
        let z = NoiseStream { seed, body: 0 }.normals(0);
        let mut state = State {
            velocity: [z[0], z[1], z[2]],
            angular_velocity: [3.0 * z[3], 3.0 * z[4], 3.0 * z[5]],
            ..State::default()
        };
        let mut before = stepper.kinetic_energy(&state);
        for _ in 0..400 {
            stepper.step(&mut state, 2e-3, &Input::default()).unwrap();
            let after = stepper.kinetic_energy(&state);
            assert!(
                after <= before * (1.0 + 1e-6),
                "seed {seed}: {before} -> {after}"
            );
            before = after;
        }
    }
}

#[test]
fn a_long_body_released_along_its_axis_turns_broadside() {
    let mut body = common::ellipsoid([0.04, 0.01, 0.01], 2000.0);
    let pi = std::f64::consts::PI;
    body.separation = Separation {
        drag_area: diagonal([0.1 * pi * 1e-4, 0.7 * pi * 4e-4, 0.7 * pi * 4e-4]),
        extents: diagonal([16e-4, 1e-4, 1e-4]),
        ..Separation::default()
    };
    let settings = Settings {
        model: Model::Separated,
        ..Settings::default()
    };
    let stepper = Stepper::new(&body, &Fluid::WATER, None, &settings).unwrap();
    let mut state = State {
        orientation: quat_from_rotation_vector([0.0, 0.0, 85f64.to_radians()]),
        ..State::default()
    };
    for _ in 0..5000 {
        stepper.step(&mut state, 1e-3, &Input::default()).unwrap();
    }
    let axis = rotate(state.orientation, [1.0, 0.0, 0.0]);
    assert!(
        axis[1].abs() < 0.5,
        "the axis still points along the fall: {axis:?}"
    );
}

#[test]
fn a_body_without_extents_is_refused() {
    let mut body = common::ellipsoid([0.04, 0.01, 0.01], 2000.0);
    body.separation = Separation::default();
    let settings = Settings {
        model: Model::Separated,
        ..Settings::default()
    };
    let error = Stepper::new(&body, &Fluid::WATER, None, &settings).unwrap_err();
    assert!(error.to_string().contains("bake"), "{error}");
}

/// A body with three planes of symmetry has a step of its own.
#[test]
fn a_symmetric_body_moves_like_one_that_hardly_is_not() {
    let symmetric = ellipsoid([0.04, 0.02, 0.01], 1200.0);
    let mut bent = symmetric.clone();
    bent.inertia[0][1] = 2e-6 * bent.inertia[1][1];
    bent.inertia[1][0] = bent.inertia[0][1];
    for model in [Model::Separated, Model::Kirchhoff] {
        let settings = Settings {
            model,
            ..Settings::default()
        };
        let run = |body| {
            let stepper = Stepper::new(body, &Fluid::WATER, None, &settings).unwrap();
            let mut state = State {
                velocity: [0.1, -0.3, 0.2],
                angular_velocity: [3.0, -1.0, 2.0],
                ..State::default()
            };
            for _ in 0..50 {
                let noise = NoiseStream::default();
                stepper.step(&mut state, 2e-3, &noise.into()).unwrap();
            }
            state
        };
        let (a, b) = (run(&symmetric), run(&bent));
        assert!(a != b, "both took the same path through the code");
        assert!(distance(a.position, b.position) < 1e-6, "{model}");
        assert!(distance(a.angular_velocity, b.angular_velocity) < 1e-4);
    }
}
