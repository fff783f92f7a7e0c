//! A step allocates nothing, under any model: a game calls it for every body in every frame.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{chiral, frozen};
use langevin_rigid::{Batch, Flow, Fluid, Input, Integrator, Model, Settings, State, Stepper};

#[test]
fn a_step_allocates_nothing() {
    let history = frozen(0.02, 0.4);
    for (model, integrator) in [
        ("consistent", Integrator::Strang),
        ("consistent", Integrator::RungeKutta4),
        ("kirchhoff", Integrator::Strang),
        ("published", Integrator::RungeKutta4),
        ("separated", Integrator::Strang),
    ] {
        for turbulence in ["body-driven", "wake-age=16", "history"] {
            let settings = Settings {
                model: model.parse::<Model>().unwrap(),
                integrator,
                turbulence: turbulence.parse().unwrap(),
                ..Settings::default()
            };
            let stepper =
                Stepper::new(&chiral(), &Fluid::WATER, Some(&history), &settings).unwrap();
            let mut state = State::default();
            let counted = allocation_counter::measure(|| {
                for _ in 0..10 {
                    stepper.step(&mut state, 1e-5, &Input::default()).unwrap();
                }
            });
            assert_eq!(counted.count_total, 0, "{model} {turbulence}");

            let mut batch = Batch::<f64>::new(1);
            for _ in 0..40 {
                batch.push(&State::default());
            }
            let wind = |_, state: &State| Input {
                flow: Flow::turning(state.velocity, [0.0, 1.0, 0.0]),
                ..Input::default()
            };
            let counted = allocation_counter::measure(|| {
                stepper.step_batch(&mut batch, 1e-5).unwrap();
                stepper.step_batch_with(&mut batch, 1e-5, wind).unwrap();
            });
            assert_eq!(counted.count_total, 0, "{model} {turbulence}, a batch");
        }
    }
}
