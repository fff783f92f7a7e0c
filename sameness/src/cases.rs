//! Every body in every fluid under every model, alone and in batches of either precision.

use std::error::Error;

use langevin_rigid::{
    Batch, Fluid, Model, NoiseStream, Precision, Settings, State, StepError, Stepper,
};

use crate::Line;
use crate::bodies::bodies;
use crate::fnv::Fnv;

const SEED: u64 = 11;
/// No multiple of any number of lanes.
const BATCH: usize = 5;
const STEPS: usize = 300;
/// Steps from one hashed state to the next.
const STRIDE: usize = 10;

/// A line for each body, fluid, model, time step and way of stepping.
pub(crate) fn lines() -> Result<Vec<Line>, Box<dyn Error>> {
    let mut lines = Vec::new();
    for (name, stepper) in steppers()? {
        for (seconds, dt) in [("1/60", 1.0 / 60.0), ("0.002", 2e-3)] {
            for (way, hash) in [
                ("alone", alone(&stepper, dt)?),
                ("f64", batch::<f64>(&stepper, dt)?),
                ("f32", batch::<f32>(&stepper, dt)?),
            ] {
                let name = format!("{name} {seconds} {way}");
                lines.push(Line { name, hash });
            }
        }
    }
    Ok(lines)
}

fn steppers() -> Result<Vec<(String, Stepper)>, Box<dyn Error>> {
    let honey = Fluid {
        density: 1420.0,
        viscosity: 7e-3,
        velocity: [0.0; 3],
    };
    let water = Fluid {
        velocity: [0.3, 0.0, -0.1],
        ..Fluid::WATER
    };
    let fluids = [("air", Fluid::AIR), ("water", water), ("honey", honey)];
    let mut steppers = Vec::new();
    for density in [3.0, 2700.0] {
        for (shape, body) in bodies(density) {
            for (place, fluid) in &fluids {
                for model in [Model::Separated, Model::Consistent, Model::Kirchhoff] {
                    let settings = Settings {
                        model,
                        ..Settings::default()
                    };
                    let name = format!("{model} {shape} {density} {place}");
                    let stepper = Stepper::new(&body, fluid, None, &settings)
                        .map_err(|error| format!("{name}: {error}"))?;
                    steppers.push((name, stepper));
                }
            }
        }
    }
    Ok(steppers)
}

/// Each its own, from rest up.
fn release(body: usize) -> State {
    let x = body as f64;
    State {
        position: [0.1 * x, 1.0, -0.2 * x],
        orientation: [0.5, -0.5, 0.5, 0.5],
        velocity: [0.1 * x, -0.05 * x, 0.02 * x],
        angular_velocity: [0.5 * x, 0.7 * x, -2.0 * x],
        ..State::default()
    }
}

fn alone(stepper: &Stepper, dt: f64) -> Result<u64, StepError> {
    let noise = NoiseStream {
        seed: SEED,
        body: 1,
    };
    let (mut state, mut hash) = (release(1), Fnv::default());
    for _ in 0..STEPS / STRIDE {
        for _ in 0..STRIDE {
            stepper.step(&mut state, dt, &noise.into())?;
        }
        hash.state(&state);
    }
    Ok(hash.0)
}

fn batch<P: Precision>(stepper: &Stepper, dt: f64) -> Result<u64, Box<dyn Error>> {
    let (mut batch, mut hash) = (Batch::<P>::new(SEED), Fnv::default());
    (0..BATCH).for_each(|body| batch.push(&release(body)));
    for _ in 0..STEPS / STRIDE {
        for _ in 0..STRIDE {
            stepper.step_batch(&mut batch, dt)?;
        }
        (0..BATCH)
            .filter_map(|body| batch.state(body))
            .for_each(|state| hash.state(&state));
    }
    Ok(hash.0)
}
