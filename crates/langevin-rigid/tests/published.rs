//! What the printed equations (11) and (12) do when they are taken to the letter.
//!
//! The reading `published` exists to study them, so these tests pin their faults: with the printed
//! cross term energy is not conserved without loads; with forces that contain no mass the result
//! depends on the system of units and blows up at the paper's own step; without a relaxation the
//! angular velocity is a random walk. If one of these tests fails, the reading has been "repaired" and
//! is no longer the paper's.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{ellipsoid, frozen};
use langevin_rigid::linalg::vector::norm;
use langevin_rigid::{
    Body, Fluid, Input, Integrator, Model, NoiseStream, Settings, State, StepError, Stepper,
    Turbulence, TurbulenceSource, falling_speed,
};

const AIR: Fluid = Fluid {
    density: 1.2,
    viscosity: 1.5e-5,
    velocity: [0.0; 3],
};
const WATER: Fluid = Fluid {
    density: 1000.0,
    viscosity: 1e-6,
    velocity: [0.0; 3],
};

fn settings(model: &str, gravity: [f64; 3]) -> Settings {
    Settings {
        model: model.parse().unwrap(),
        integrator: Integrator::RungeKutta4,
        turbulence: TurbulenceSource::History,
        gravity,
        reynolds: Some(1e4),
        ..Settings::default()
    }
}

/// The sheet of Fig. 3 as a flat ellipsoid.
fn sheet() -> Body {
    Body {
        thickness: 1e-4,
        ..ellipsoid([0.04, 5e-5, 0.01], 800.0)
    }
}

#[test]
fn the_printed_cross_term_does_not_conserve_energy() {
    let body = ellipsoid([0.01, 0.02, 0.04], 1100.0);
    // No turbulence: alpha = beta = 0.
    let calm = frozen(1.0, 0.0);
    let drift = |model: &str| {
        let stepper = Stepper::new(&body, &WATER, Some(&calm), &settings(model, [0.0; 3])).unwrap();
        let mut state = State {
            velocity: [0.3, 0.1, -0.2],
            angular_velocity: [2.0, -3.0, 1.0],
            ..State::default()
        };
        let before = stepper.kinetic_energy(&state);
        for _ in 0..1000 {
            stepper.step(&mut state, 1e-3, &Input::default()).unwrap();
        }
        (stepper.kinetic_energy(&state) / before - 1.0).abs()
    };
    println!(
        "energy drift in 1 s: published {:.3}, kirchhoff {:.1e}",
        drift("published"),
        drift("kirchhoff")
    );
    assert!(drift("published") > 0.05);
    assert!(drift("kirchhoff") < 1e-6);
}

/// When the sheet's state diverges (s), if it does within two seconds.
fn divergence(model: &str, dt: f64) -> Option<f64> {
    let body = sheet();
    let at_birth = Turbulence::at_birth(falling_speed(&body, &AIR, langevin_rigid::GRAVITY), 0.01);
    let history = frozen(at_birth.k, at_birth.epsilon);
    let settings = settings(model, langevin_rigid::GRAVITY);
    let stepper = Stepper::new(&body, &AIR, Some(&history), &settings).unwrap();
    let mut state = State::default();
    (0..(2.0 / dt) as u32).find_map(|_| match stepper.step(&mut state, dt, &Input::default()) {
        Err(StepError::Diverged { time, .. }) => Some(time),
        Err(error) => panic!("{error}"),
        Ok(()) => None,
    })
}

#[test]
fn the_printed_equations_blow_up_at_the_papers_step_in_any_units() {
    let (cgs, si) = (
        divergence("published", 5e-3),
        divergence("published-si", 5e-3),
    );
    println!("the sheet at 5 ms diverges after: CGS {cgs:?} s, SI {si:?} s");
    assert!(cgs.unwrap() < 0.1 && si.unwrap() < 0.1);
    assert_eq!(divergence("consistent", 5e-3), None);
}

#[test]
fn the_printed_spin_is_a_random_walk() {
    let body = ellipsoid([0.05; 3], 3.0);
    let history = frozen(0.5, 10.0);
    let spin = |model: Model, time: f64| {
        let settings = Settings {
            model,
            ..settings("published", [0.0; 3])
        };
        let stepper = Stepper::new(&body, &AIR, Some(&history), &settings).unwrap();
        let bodies = 200;
        let mean_square: f64 = (0..bodies)
            .map(|body| {
                let noise = NoiseStream { seed: 1, body };
                let mut state = State::default();
                for _ in 0..(time / 1e-3) as u32 {
                    stepper.step(&mut state, 1e-3, &noise.into()).unwrap();
                }
                norm(state.angular_velocity).powi(2) / f64::from(bodies)
            })
            .sum();
        mean_square.sqrt()
    };
    let published: Model = "published".parse().unwrap();
    let growth = spin(published, 0.4) / spin(published, 0.1);
    println!(
        "rms spin: {} rad/s after 0.4 s, {growth} times that after 0.1 s",
        spin(published, 0.4)
    );
    // Four times the time, twice the spin.
    assert!((growth - 2.0).abs() < 0.25, "{growth}");
}
