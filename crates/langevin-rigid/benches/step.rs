//! Wall-clock time of one step, by model and integrator.
#![allow(
    clippy::unwrap_used,
    missing_docs,
    reason = "a benchmark may panic and is nobody's interface"
)]

use criterion::{Criterion, criterion_group, criterion_main};
use langevin_rigid::{Body, Fluid, Integrator, Model, NoiseStream, Settings, State, Stepper};

/// The rubber ellipsoid of Fig. 5 with Lamb's added mass (validated elsewhere; here only its size
/// matters).
fn ellipsoid() -> Body {
    let volume = 3.351e-5;
    let mass = 1200.0 * volume;
    let mut added_mass = [[0.0; 6]; 6];
    for (i, m) in [1.518, 0.398, 0.1266].into_iter().enumerate() {
        added_mass[i][i] = m * volume;
    }
    for (i, m) in [0.581e-4, 3.314e-4, 0.406e-4].into_iter().enumerate() {
        added_mass[3 + i][3 + i] = m * volume;
    }
    let inertia = [
        [mass * 4e-4, 0.0, 0.0],
        [0.0, mass * 3.4e-4, 0.0],
        [0.0, 0.0, mass * 1e-4],
    ];
    Body {
        mass,
        inertia,
        volume,
        centre_of_buoyancy: [0.0; 3],
        added_mass,
        half_extents: [0.04, 0.02, 0.01],
        thickness: 0.02,
        length: 0.08,
        separation: Default::default(),
        slices: vec![],
        surface: langevin_rigid::Surface::default(),
    }
}

fn step(c: &mut Criterion) {
    let body = ellipsoid();
    let cases = [
        ("consistent, strang", Model::Consistent, Integrator::Strang),
        (
            "consistent, rk4",
            Model::Consistent,
            Integrator::RungeKutta4,
        ),
        ("kirchhoff, strang", Model::Kirchhoff, Integrator::Strang),
    ];
    let mut group = c.benchmark_group("step");
    for (name, model, integrator) in cases {
        let settings = Settings {
            model,
            integrator,
            ..Settings::default()
        };
        let stepper = Stepper::new(&body, &Fluid::WATER, None, &settings).unwrap();
        let noise = NoiseStream { seed: 1, body: 0 };
        let mut state = State::default();
        group.bench_function(name, |b| {
            b.iter(|| {
                // A body that has left the tank starts again, so that speeds stay those of a fall.
                if state.step % 1000 == 0 {
                    state = State::default();
                }
                stepper.step(&mut state, 5e-3, &noise.into()).unwrap();
                state.position[1]
            });
        });
    }
    group.finish();
}

criterion_group!(benches, step);
criterion_main!(benches);
