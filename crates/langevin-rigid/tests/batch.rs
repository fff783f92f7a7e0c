//! A body of a batch has the bits it has alone, whatever is beside it; single precision stays near.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{chiral, ellipsoid, frozen};
use langevin_rigid::{
    Batch, Fluid, Integrator, Model, NoiseStream, Precision, Settings, State, Stepper,
    TurbulenceSource,
};

/// Enough for a full pack and a part of one.
const BODIES: usize = 21;

/// Name, stepper and time step.
fn steppers() -> Vec<(&'static str, Stepper, f64)> {
    let history = frozen(0.02, 0.4);
    let still = Fluid::WATER;
    let stream = Fluid {
        velocity: [0.05, 0.0, 0.1],
        ..still
    };
    let (general, symmetric) = (chiral(), ellipsoid([0.1, 0.05, 0.02], 1200.0));
    [
        ("consistent", "strang", "body-driven", still, &general),
        ("consistent", "strang", "body-driven", stream, &general),
        ("consistent", "strang", "history", still, &general),
        ("consistent", "rk4", "body-driven", still, &general),
        ("kirchhoff", "strang", "body-driven", stream, &general),
        ("separated", "strang", "body-driven", stream, &general),
        ("consistent", "strang", "body-driven", still, &symmetric),
        ("consistent", "strang", "history", stream, &symmetric),
        ("kirchhoff", "strang", "body-driven", still, &symmetric),
        ("separated", "strang", "body-driven", still, &symmetric),
    ]
    .map(|(model, integrator, turbulence, fluid, body)| {
        let settings = Settings {
            model: model.parse::<Model>().unwrap(),
            integrator: integrator.parse::<Integrator>().unwrap(),
            turbulence: turbulence.parse::<TurbulenceSource>().unwrap(),
            ..Settings::default()
        };
        let stepper = Stepper::new(body, &fluid, Some(&history), &settings).unwrap();
        // The explicit scheme is stable only where the turbulence is slower than the step.
        let dt = if integrator == "rk4" { 1e-4 } else { 4e-3 };
        (model, stepper, dt)
    })
    .to_vec()
}

/// Each its own: at rest, slow, fast enough for steps in parts, at different times.
fn release(body: usize) -> State {
    let x = body as f64;
    let mut state = State {
        time: 0.01 * x,
        step: (1 << 32) - 2 + body as u64,
        position: [0.1 * x, 1.0, -0.2 * x],
        orientation: [0.5, -0.5, 0.5, 0.5],
        ..State::default()
    };
    if !body.is_multiple_of(3) {
        state.velocity = [0.1 * x, -0.05 * x, 0.2];
        state.angular_velocity = [0.5 * x, 2.0, -2.0 * x];
    }
    state
}

fn batch<P: Precision>() -> Batch<P> {
    let mut batch = Batch::new(5);
    for body in 0..BODIES {
        batch.push(&release(body));
    }
    batch
}

#[test]
fn a_body_has_the_same_bits_alone_and_in_a_batch() {
    for (model, stepper, dt) in steppers() {
        let mut batch = batch::<f64>();
        for _ in 0..40 {
            stepper.step_batch(&mut batch, dt).unwrap();
        }
        for body in 0..BODIES {
            let mut alone = release(body);
            let noise = NoiseStream {
                seed: 5,
                body: body as u32,
            };
            for _ in 0..40 {
                stepper.step(&mut alone, dt, &noise.into()).unwrap();
            }
            assert_eq!(batch.state(body), Some(alone), "{model}, body {body}");
        }
    }
}

#[test]
fn packs_step_alone_as_together() {
    let (_, stepper, _) = &steppers()[0];
    let (mut together, mut apart) = (batch::<f64>(), batch::<f64>());
    stepper.step_batch(&mut together, 4e-3).unwrap();
    std::thread::scope(|scope| {
        for pack in apart.packs_mut().chunks_mut(1) {
            scope.spawn(move || stepper.step_packs(pack, 4e-3).unwrap());
        }
    });
    assert_eq!(together, apart);
}

#[test]
fn who_diverges_is_named_and_left_alone() {
    let (_, stepper, _) = &steppers()[0];
    let mut batch = batch::<f64>();
    let lost = [2, 17];
    for body in lost {
        let mut state = release(body);
        state.velocity[1] = f64::NAN;
        assert!(batch.set(body, &state));
    }
    let before = batch.clone();
    let error = stepper.step_batch(&mut batch, 4e-3).unwrap_err();
    assert_eq!(error.bodies, lost.map(|body| body as u32));
    assert!(error.to_string().starts_with(
        "2 of the bodies could not take a step, the first is body 2: a number of the state"
    ));
    for body in 0..BODIES {
        let steps = batch.state(body).unwrap().step - before.state(body).unwrap().step;
        assert_eq!(steps, u64::from(!lost.contains(&body)));
    }
}

#[test]
fn there_is_no_body_beyond_the_last() {
    let mut batch = batch::<f64>();
    assert_eq!(batch.state(BODIES), None);
    assert!(!batch.set(BODIES, &State::default()));
    assert_eq!(batch.len(), BODIES);
}

#[test]
fn single_precision_errs_by_a_few_roundings_a_step() {
    for (model, stepper, dt) in steppers() {
        let (mut double, mut single) = (batch::<f64>(), batch::<f32>());
        stepper.step_batch(&mut double, dt).unwrap();
        stepper.step_batch(&mut single, dt).unwrap();
        for body in 0..BODIES {
            let (d, s) = (double.state(body).unwrap(), single.state(body).unwrap());
            let scale = |v: [f64; 3]| 1.0 + v.iter().fold(0.0f64, |m, x| m.max(x.abs()));
            for (d, s) in [
                (d.velocity, s.velocity),
                (d.angular_velocity, s.angular_velocity),
                (d.position, s.position),
            ] {
                for i in 0..3 {
                    let error = (s[i] - d[i]).abs() / scale(d);
                    assert!(error < 1e-5, "{model}, body {body}: {error:e}");
                }
            }
        }
    }
}

#[test]
fn bodies_come_and_go_with_their_numbers() {
    let (_, stepper, dt) = &steppers()[0];
    let mut batch = Batch::<f64>::new(5);
    let mut alone: Vec<(u32, State)> = Vec::new();
    for number in [7, 3, 40] {
        batch.push_numbered(number, &release(number as usize));
        alone.push((number, release(number as usize)));
    }
    for body in 0..BODIES {
        batch.push_numbered(100 + body as u32, &release(body));
        alone.push((100 + body as u32, release(body)));
    }
    for place in [1, 0, alone.len() - 3, 5, 5] {
        assert_eq!(batch.swap_remove(place), Some(alone.swap_remove(place).1));
        stepper.step_batch(&mut batch, *dt).unwrap();
        for (body, state) in &mut alone {
            let noise = NoiseStream {
                seed: 5,
                body: *body,
            };
            stepper.step(state, *dt, &noise.into()).unwrap();
        }
    }
    assert_eq!(batch.len(), alone.len());
    for (place, (_, state)) in alone.iter().enumerate() {
        assert_eq!(batch.state(place).as_ref(), Some(state));
    }
    assert_eq!(batch.swap_remove(alone.len()), None);
    while !batch.is_empty() {
        batch.swap_remove(0).unwrap();
    }
    assert_eq!(batch.len(), 0);
}
