//! Bodies in wind: alone and in lanes, with no allocation, and as physics has it.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::chiral;
use langevin_rigid::linalg::vector::{norm, sub};
use langevin_rigid::wind::{
    GustSettings, Gusts, Jet, Profile, Region, Shear, Table, Vortex, Wind, WindField,
};
use langevin_rigid::{Batch, Body, Fluid, Input, Model, NoiseStream, Settings, State, Stepper};

/// One of each.
fn wind() -> Wind {
    let mut wind = Wind::default();
    wind.add(WindField::Uniform([0.3, 0.0, -0.1])).unwrap();
    wind.add(Shear {
        velocity: [2.0, 0.0, 0.0],
        height: 5.0,
        ground: -3.0,
        profile: Profile::Log { roughness: 0.02 },
    })
    .unwrap();
    wind.add(Shear {
        velocity: [0.0, 0.0, 1.0],
        height: 2.0,
        ground: -1.0,
        profile: Profile::Power { exponent: 0.2 },
    })
    .unwrap();
    let gusts = GustSettings {
        rms: 0.4,
        length: 1.5,
        carried: [2.0, 0.0, 0.0],
        ..GustSettings::default()
    };
    let ball = Region::Sphere {
        centre: [0.0; 3],
        radius: 2.0,
        edge: 1.0,
    };
    wind.add_within(Gusts::new(&gusts).unwrap(), ball).unwrap();
    let slab = Region::Box {
        centre: [0.0; 3],
        size: [4.0, 1.0, 4.0],
        edge: 0.4,
    };
    let vortex = Vortex {
        centre: [0.2, 0.0, 0.1],
        axis: [0.0, 1.0, 0.2],
        circulation: 0.8,
        core: 0.3,
    };
    wind.add_within(vortex, slab).unwrap();
    wind.add(Jet {
        centre: [-1.0, 0.0, 0.0],
        axis: [1.0, 0.1, 0.0],
        speed: 3.0,
        diameter: 0.5,
    })
    .unwrap();
    let velocities = (0..24).map(|n| [0.01 * f64::from(n), 0.0, 0.1]).collect();
    let table = Table::new([-1.0; 3], [1.0; 3], [3, 2, 2], &[0.0, 1.0], velocities).unwrap();
    wind.add_within(table, slab).unwrap();
    wind
}

fn release(body: u32) -> State {
    let z = NoiseStream { seed: 5, body }.normals(0);
    State {
        position: [z[0], 0.5 * z[1], z[2]],
        velocity: [z[3], z[4], z[5]],
        angular_velocity: [z[6], z[7], z[8]],
        ..State::default()
    }
}

#[test]
fn a_body_has_the_same_bits_alone_and_in_a_batch() {
    let (wind, stream, bodies) = (wind(), [0.2, 0.0, 0.1], 21);
    let fluid = Fluid {
        velocity: stream,
        ..Fluid::WATER
    };
    for model in [Model::Separated, Model::Consistent, Model::Kirchhoff] {
        let settings = Settings {
            model,
            ..Settings::default()
        };
        let stepper = Stepper::new(&chiral(), &fluid, None, &settings).unwrap();
        let (seed, dt, apart) = (9, 2e-3, 40.0);
        let mut batch = Batch::<f64>::new(seed);
        let mut alone: Vec<State> = (0..bodies).map(release).collect();
        alone.iter().for_each(|state| batch.push(state));
        for _ in 0..20 {
            stepper.step_batch_in(&mut batch, dt, &wind, apart).unwrap();
            for (body, state) in (0..).zip(&mut alone) {
                let time = state.time + apart * f64::from(body);
                let input = Input {
                    flow: wind.flow(state.position, time, stream),
                    noise: NoiseStream { seed, body },
                    ..Input::default()
                };
                stepper.step(state, dt, &input).unwrap();
            }
        }
        for (body, state) in alone.iter().enumerate() {
            assert_eq!(batch.state(body), Some(*state), "{model}, body {body}");
        }
    }
}

#[test]
fn single_precision_is_near_and_nothing_is_allocated() {
    let wind = wind();
    let stepper = Stepper::new(&chiral(), &Fluid::WATER, None, &Settings::default()).unwrap();
    let (mut single, mut double) = (Batch::<f32>::new(1), Batch::<f64>::new(1));
    for body in 0..21 {
        single.push(&release(body));
        double.push(&release(body));
    }
    let counted = allocation_counter::measure(|| {
        stepper
            .step_batch_in(&mut single, 1e-3, &wind, 0.0)
            .unwrap();
        stepper
            .step_batch_in(&mut double, 1e-3, &wind, 0.0)
            .unwrap();
        std::hint::black_box(wind.flow([0.1, 0.2, 0.3], 0.4, [0.0; 3]));
    });
    assert_eq!(counted.count_total, 0);
    for body in 0..21 {
        let [a, b] = [single.state(body).unwrap(), double.state(body).unwrap()];
        let apart = norm(sub(a.velocity, b.velocity));
        assert!(apart < 1e-4 * (1.0 + norm(b.velocity)), "{body}: {apart}");
    }
}

#[test]
fn a_wind_has_the_same_bits_everywhere() {
    let wind = wind();
    // FNV-1a.
    let mut hash = 0xCBF2_9CE4_8422_2325u64;
    let mut add = |x: f64| {
        for byte in x.to_bits().to_le_bytes() {
            hash = (hash ^ u64::from(byte)).wrapping_mul(0x100_0000_01B3);
        }
    };
    for body in 0..1000 {
        let time = 0.01 * f64::from(body);
        let flow = wind.flow(release(body).position, time, [0.1, 0.2, 0.3]);
        flow.velocity.into_iter().for_each(&mut add);
        flow.gradient.into_iter().flatten().for_each(&mut add);
        flow.acceleration.into_iter().for_each(&mut add);
    }
    assert_eq!(hash, 0x67A1_6490_2676_3DFD, "{hash:#018X}");
}

/// A ball of the fluid's own density, small beside the eddies, is carried by them as the fluid is.
#[test]
fn what_is_as_light_as_the_fluid_goes_with_it() {
    let mut wind = Wind::default();
    let gusts = GustSettings {
        rms: 0.3,
        length: 4.0,
        smallest: Some(0.8),
        ..GustSettings::default()
    };
    wind.add(Gusts::new(&gusts).unwrap()).unwrap();
    let settings = Settings {
        model: Model::Kirchhoff,
        ..Settings::default()
    };
    let ball = Body::sphere(0.01, Fluid::WATER.density).unwrap();
    let stepper = Stepper::new(&ball, &Fluid::WATER, None, &settings).unwrap();
    // Without drag: only the fluid's acceleration moves it.
    let velocity = |state: &State| wind.flow(state.position, state.time, [0.0; 3]).velocity;
    let mut state = State::default();
    state.velocity = velocity(&state);
    let start = state.velocity;
    for _ in 0..2000 {
        let input = Input {
            flow: wind.flow(state.position, state.time, [0.0; 3]),
            ..Input::default()
        };
        stepper.step(&mut state, 1e-3, &input).unwrap();
    }
    let changed = norm(sub(velocity(&state), start));
    let apart = norm(sub(state.world_velocity(), velocity(&state)));
    assert!(apart < 0.01 * changed, "{apart} of {changed} m/s");
}
