//! The Langevin loads.
//!
//! In frozen turbulence each component of a sphere's velocity is an Ornstein-Uhlenbeck process with
//! variance lambda beta^2 / (2 alpha), lambda its added mass over its total mass, at every step size: a
//! splitting that were only approximate would drift away from it at large steps. With turbulence born
//! at the body, drag is quadratic in speed and a falling body finds a terminal speed.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{chiral, ellipsoid, frozen};
use langevin_rigid::linalg::vector::norm;
use langevin_rigid::{
    Body, Fluid, Input, Integrator, LangevinCoefficients, Model, NoiseStream, Settings, State,
    StepError, Stepper, Turbulence, TurbulenceSource, falling_speed,
};

const AIR: Fluid = Fluid {
    density: 1.2,
    viscosity: 1.5e-5,
    velocity: [0.0; 3],
};

fn frozen_settings(integrator: Integrator) -> Settings {
    Settings {
        model: Model::Consistent,
        integrator,
        turbulence: TurbulenceSource::History,
        gravity: [0.0; 3],
        reynolds: Some(1e4),
        ..Settings::default()
    }
}

/// Mean square of a velocity component over many bodies and times, after the transient.
fn variance(stepper: &Stepper, dt: f64, spacing: usize) -> f64 {
    let (bodies, samples) = (40, 400);
    let mut sum = 0.0;
    for body in 0..bodies {
        let noise = NoiseStream { seed: 5, body };
        let mut state = State::default();
        for n in 0..samples + 20 {
            for _ in 0..spacing {
                stepper.step(&mut state, dt, &noise.into()).unwrap();
            }
            if n >= 20 {
                sum += norm(state.velocity).powi(2) / 3.0;
            }
        }
    }
    sum / f64::from(bodies * samples)
}

#[test]
fn a_sphere_in_frozen_turbulence_has_the_stationary_variance_at_every_step() {
    let body = ellipsoid([0.05; 3], 3.0);
    let (k, epsilon) = (0.5, 100.0);
    let c0 = langevin_rigid::kolmogorov_c0(1e4);
    let LangevinCoefficients { alpha, beta } =
        LangevinCoefficients::new(Turbulence { k, epsilon }, c0);
    let fluid = AIR.density * body.added_mass[0][0];
    let lambda = fluid / (fluid + body.mass);
    let wanted = lambda * beta * beta / (2.0 * alpha);
    let stepper = Stepper::new(
        &body,
        &AIR,
        Some(&frozen(k, epsilon)),
        &frozen_settings(Integrator::Strang),
    )
    .unwrap();
    // Samples one relaxation time apart, whatever the step.
    let relaxation = 1.0 / (lambda * alpha);
    for dt in [1e-4, 1e-3, 5e-3, 1.0 / 60.0] {
        let spacing = (relaxation / dt).ceil() as usize;
        let measured = variance(&stepper, dt, spacing);
        // 16,000 samples with correlation exp(-1): about 1.3 % of standard error on 3 components.
        assert!(
            (measured / wanted - 1.0).abs() < 0.04,
            "dt {dt}: {measured} for {wanted}"
        );
    }
}

#[test]
fn euler_maruyama_has_the_same_variance_at_small_steps() {
    let body = ellipsoid([0.05; 3], 3.0);
    let (k, epsilon) = (0.5, 100.0);
    let history = frozen(k, epsilon);
    let measure = |integrator| {
        let stepper =
            Stepper::new(&body, &AIR, Some(&history), &frozen_settings(integrator)).unwrap();
        variance(&stepper, 1e-4, 60)
    };
    let ratio = measure(Integrator::RungeKutta4) / measure(Integrator::Strang);
    assert!((ratio - 1.0).abs() < 0.05, "{ratio}");
}

#[test]
fn without_noise_the_relaxation_is_exact_at_any_step() {
    // chi = 20/s with next to no energy: relaxation without noise.
    let history = frozen(1e-30, 2e-29);
    let body = ellipsoid([0.05; 3], 3.0);
    let settings = frozen_settings(Integrator::Strang);
    let stepper = Stepper::new(&body, &AIR, Some(&history), &settings).unwrap();
    let fluid = AIR.density * body.added_mass[0][0];
    let alpha = (0.5 + 0.75 * langevin_rigid::kolmogorov_c0(1e4)) * 20.0;
    let wanted = 2.0 * libm::exp(-alpha * fluid / (fluid + body.mass) * 0.5);
    for steps in [1, 7, 100] {
        let mut state = State {
            velocity: [2.0, 0.0, 0.0],
            ..State::default()
        };
        for _ in 0..steps {
            stepper
                .step(&mut state, 0.5 / f64::from(steps), &Input::default())
                .unwrap();
        }
        assert!(
            (state.velocity[0] / wanted - 1.0).abs() < 1e-9,
            "{steps} steps"
        );
    }
}

#[test]
fn relaxation_never_feeds_energy_even_with_full_coupling() {
    let body = chiral();
    let water = Fluid {
        density: 1000.0,
        viscosity: 1e-6,
        velocity: [0.0; 3],
    };
    let history = frozen(1e-24, 1e-22);
    let stepper = Stepper::new(
        &body,
        &water,
        Some(&history),
        &frozen_settings(Integrator::Strang),
    )
    .unwrap();
    let mut state = State {
        velocity: [0.3, -0.2, 0.4],
        angular_velocity: [3.0, 5.0, -2.0],
        ..State::default()
    };
    let mut before = stepper.kinetic_energy(&state);
    for _ in 0..500 {
        stepper.step(&mut state, 1e-3, &Input::default()).unwrap();
        let after = stepper.kinetic_energy(&state);
        assert!(after <= before * (1.0 + 1e-9), "{before} -> {after}");
        before = after;
    }
}

/// The sheet of Fig. 3 as a flat ellipsoid.
fn sheet() -> Body {
    let mut body = ellipsoid([0.04, 5e-5, 0.01], 800.0);
    body.thickness = 1e-4;
    body
}

#[test]
fn a_sheet_finds_a_terminal_speed_of_the_order_of_u0() {
    let body = sheet();
    let u0 = falling_speed(&body, &AIR, langevin_rigid::GRAVITY);
    assert!((u0 - 0.81).abs() < 0.01, "{u0}");
    let settings = Settings {
        model: Model::Consistent,
        ..Settings::default()
    };
    let stepper = Stepper::new(&body, &AIR, None, &settings).unwrap();
    for seed in 0..6 {
        let noise = NoiseStream { seed, body: 0 };
        let mut state = State::default();
        let mut fallen = [0.0; 2];
        for n in 0..1000 {
            if n == 500 {
                fallen[0] = state.position[1];
            }
            stepper.step(&mut state, 5e-3, &noise.into()).unwrap();
        }
        fallen[1] = state.position[1];
        let speed = (fallen[0] - fallen[1]) / 2.5;
        assert!(
            speed > 0.5 * u0 && speed < 2.0 * u0,
            "seed {seed}: {speed} m/s"
        );
    }
}

#[test]
fn the_printed_equations_diverge_and_say_so() {
    let body = sheet();
    for name in ["published", "published-si"] {
        let settings = Settings {
            model: name.parse().unwrap(),
            integrator: Integrator::RungeKutta4,
            turbulence_length: Some(0.01),
            ..Settings::default()
        };
        let stepper = Stepper::new(&body, &AIR, None, &settings).unwrap();
        let mut state = State {
            velocity: [0.0, -0.4, 0.0],
            ..State::default()
        };
        let error = (0..400).find_map(|_| stepper.step(&mut state, 5e-3, &Input::default()).err());
        let Some(StepError::Diverged { time, model, .. }) = error else {
            panic!("{name} did not diverge")
        };
        assert_eq!(
            (time, model),
            (state.time, settings.model),
            "the last good state is kept"
        );
        assert!(state.is_finite());
    }
}

#[test]
fn the_printed_equations_need_the_printed_scheme() {
    let settings = Settings {
        model: "published".parse().unwrap(),
        ..Settings::default()
    };
    let error = Stepper::new(&sheet(), &AIR, None, &settings).unwrap_err();
    assert!(error.to_string().contains("rk4"));
}

#[test]
fn a_missing_history_and_impossible_numbers_are_named() {
    let body = sheet();
    let refuse = |fluid: &Fluid, settings: &Settings| {
        Stepper::new(&body, fluid, None, settings)
            .unwrap_err()
            .to_string()
    };
    let history = Settings {
        turbulence: TurbulenceSource::History,
        ..Settings::default()
    };
    assert!(refuse(&AIR, &history).contains("history"));
    let thin = Fluid {
        density: 0.0,
        ..AIR
    };
    assert!(refuse(&thin, &Settings::default()).contains("density is 0"));
    let gravity = Settings {
        gravity: [0.0, f64::NAN, 0.0],
        ..Settings::default()
    };
    assert!(refuse(&AIR, &gravity).contains("gravity"));
}

#[test]
fn kirchhoff_draws_no_noise() {
    let settings = Settings {
        model: Model::Kirchhoff,
        ..Settings::default()
    };
    let stepper = Stepper::new(&sheet(), &AIR, None, &settings).unwrap();
    let end = |seed| {
        let mut state = State {
            angular_velocity: [0.1, 0.2, 0.3],
            ..State::default()
        };
        for _ in 0..50 {
            stepper
                .step(&mut state, 1e-3, &NoiseStream { seed, body: 0 }.into())
                .unwrap();
        }
        state
    };
    assert_eq!(end(1), end(2));
}

/// Fluctuations that grow faster than the speed must not feed on themselves over a long step: with
/// coefficients frozen over 20 ms half of these bodies would be at 1e6 m/s before 20 s.
#[test]
fn a_body_in_its_own_turbulence_never_runs_away() {
    let body = ellipsoid([0.01, 0.02, 0.04], 1200.0);
    let settings = Settings {
        model: Model::Consistent,
        ..Settings::default()
    };
    let stepper = Stepper::new(&body, &Fluid::WATER, None, &settings).unwrap();
    for seed in 0..60 {
        let noise = NoiseStream { seed, body: 0 };
        let mut state = State::default();
        for _ in 0..1000 {
            stepper.step(&mut state, 0.02, &noise.into()).unwrap();
        }
    }
}
