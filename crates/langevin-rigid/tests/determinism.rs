//! The same seed gives the same bits: from a checkpoint, beside other bodies on other threads, and
//! against a pinned hash that every platform must meet. A hash that changes means that trajectories
//! of users change: say so in the changelog.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{chiral, ellipsoid, frozen};
use langevin_rigid::{
    Fluid, Integrator, Model, NoiseStream, Settings, State, Stepper, TurbulenceSource,
};

const WATER: Fluid = Fluid {
    density: 1000.0,
    viscosity: 1e-6,
    velocity: [0.05, 0.0, 0.1],
};

fn stepper(integrator: Integrator, turbulence: TurbulenceSource) -> Stepper {
    let settings = Settings {
        model: Model::Consistent,
        integrator,
        turbulence,
        ..Settings::default()
    };
    Stepper::new(&chiral(), &WATER, Some(&frozen(0.02, 0.4)), &settings).unwrap()
}

fn advance(stepper: &Stepper, state: &mut State, noise: NoiseStream, steps: usize) {
    for _ in 0..steps {
        stepper.step(state, 2e-3, &noise.into()).unwrap();
    }
}

fn hash(state: &State) -> u64 {
    let parts = [state.position, state.velocity, state.angular_velocity];
    parts
        .iter()
        .flatten()
        .chain(&state.orientation)
        .fold(0xCBF2_9CE4_8422_2325, |hash, x| {
            (hash ^ x.to_bits()).wrapping_mul(0x0000_0100_0000_01B3)
        })
}

#[test]
fn a_checkpoint_resumes_to_the_same_bits() {
    let stepper = stepper(Integrator::Strang, TurbulenceSource::default());
    let noise = NoiseStream { seed: 42, body: 0 };
    let mut through = State::default();
    advance(&stepper, &mut through, noise, 300);
    let mut first = State::default();
    advance(&stepper, &mut first, noise, 120);
    let mut resumed = first;
    advance(&stepper, &mut resumed, noise, 180);
    assert_eq!(through, resumed);
}

#[test]
fn threads_do_not_change_a_bit() {
    let stepper = stepper(Integrator::Strang, TurbulenceSource::default());
    let alone: Vec<State> = (0..8)
        .map(|body| {
            let mut state = State::default();
            advance(&stepper, &mut state, NoiseStream { seed: 1, body }, 200);
            state
        })
        .collect();
    let mut beside = vec![State::default(); 8];
    std::thread::scope(|scope| {
        for (body, state) in beside.iter_mut().enumerate() {
            let stepper = &stepper;
            let noise = NoiseStream {
                seed: 1,
                body: body as u32,
            };
            scope.spawn(move || advance(stepper, state, noise, 200));
        }
    });
    assert_eq!(alone, beside);
}

#[test]
fn golden_runs() {
    let wake = TurbulenceSource::BodyDriven { wake_age: 16.0 };
    let runs = [
        (
            Integrator::Strang,
            TurbulenceSource::default(),
            0x57D1_080F_F347_2704,
        ),
        (Integrator::Strang, wake, 0xC9B3_7190_B703_F70C),
        (
            Integrator::Strang,
            TurbulenceSource::History,
            0x4EDD_AD44_1670_A6DB,
        ),
        (
            Integrator::RungeKutta4,
            TurbulenceSource::default(),
            0x291A_D177_29EB_C50B,
        ),
    ];
    let mut changed = Vec::new();
    let mut compare = |name: String, state: &State, golden: u64| {
        if hash(state) != golden {
            changed.push(format!("{name}: {:#018X} for {golden:#018X}", hash(state)));
        }
    };
    for (integrator, turbulence, golden) in runs {
        let mut state = State::default();
        advance(
            &stepper(integrator, turbulence),
            &mut state,
            NoiseStream { seed: 7, body: 1 },
            500,
        );
        compare(format!("{integrator} {turbulence}"), &state, golden);
    }
    let symmetric = ellipsoid([0.04, 0.02, 0.01], 1200.0);
    for (model, body, golden) in [
        (Model::Separated, &chiral(), 0x207A_B77D_F98A_5ECB),
        (Model::Separated, &symmetric, 0x1778_2780_5B88_149D),
        (Model::Consistent, &symmetric, 0x20A3_55DE_71D0_2E0E),
    ] {
        let settings = Settings {
            model,
            ..Settings::default()
        };
        let stepper = Stepper::new(body, &Fluid::WATER, None, &settings).unwrap();
        let mut state = State::default();
        advance(&stepper, &mut state, NoiseStream { seed: 7, body: 1 }, 500);
        compare(model.to_string(), &state, golden);
    }
    assert!(changed.is_empty(), "{changed:#?}");
}
