//! What goes into a step, and the loads that come out.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use common::{chiral, distance, ellipsoid, frozen};
use langevin_rigid::linalg::vector::{add, cross, norm, scale};
use langevin_rigid::linalg::{Vec3, quat_from_rotation_vector};
use langevin_rigid::{
    Batch, Body, Flow, Fluid, Input, Integrator, Model, NoiseStream, Settings, Slice, State,
    StepError, Stepper, TurbulenceSource, Wrench,
};

const WEIGHTLESS: Vec3 = [0.0; 3];

/// Every model with the integrators it has.
fn compositions() -> Vec<(Model, Integrator)> {
    let by_name = |name: &str| name.parse::<Model>().unwrap();
    vec![
        (by_name("separated"), Integrator::Strang),
        (by_name("consistent"), Integrator::Strang),
        (by_name("consistent"), Integrator::RungeKutta4),
        (by_name("kirchhoff"), Integrator::Strang),
        (by_name("kirchhoff"), Integrator::RungeKutta4),
        (by_name("published"), Integrator::RungeKutta4),
        (by_name("published-si"), Integrator::RungeKutta4),
    ]
}

/// Turbulence with this decay rate and next to no noise.
fn quiet(body: &Body, fluid: &Fluid, model: Model, integrator: Integrator) -> Stepper {
    let settings = Settings {
        model,
        integrator,
        turbulence: TurbulenceSource::History,
        ..Settings::default()
    };
    Stepper::new(body, fluid, Some(&frozen(1e-24, 1e-24)), &settings).unwrap()
}

fn kirchhoff(body: &Body, gravity: Vec3) -> Stepper {
    let settings = Settings {
        model: Model::Kirchhoff,
        gravity,
        ..Settings::default()
    };
    Stepper::new(body, &Fluid::WATER, None, &settings).unwrap()
}

/// A body in three slices without any symmetry.
fn sliced() -> Body {
    in_slices(chiral())
}

fn in_slices(mut body: Body) -> Body {
    let third = |m: [[f64; 3]; 3]| m.map(|row| row.map(|x| x / 3.0));
    let block = |k: usize| -> [[f64; 3]; 3] {
        std::array::from_fn(|i| std::array::from_fn(|j| body.added_mass[k + i][k + j]))
    };
    let slices = [-0.03, 0.0, 0.03].map(|z| Slice {
        centre: [0.0, 0.0, z],
        translation: third(block(0)),
        rotation: third(third(block(3))),
        drag_area: third(body.separation.drag_area),
        extents: body.separation.extents,
    });
    body.slices = slices.to_vec();
    body
}

fn tumbling() -> State {
    State {
        position: [0.1, -0.2, 0.3],
        orientation: quat_from_rotation_vector([0.4, -0.8, 0.3]),
        velocity: [0.3, -0.5, 0.2],
        angular_velocity: [1.0, 4.0, -2.0],
        ..State::default()
    }
}

fn windy() -> Input {
    Input {
        flow: Flow {
            velocity: [0.4, 0.1, -0.2],
            gradient: [[0.5, -1.0, 0.2], [2.0, 0.3, -0.7], [0.1, 0.6, -0.8]],
            acceleration: [-0.6, 0.8, 0.5],
        },
        wrench: Wrench {
            force: [0.1, 0.2, -0.3],
            torque: [1e-3, -2e-3, 3e-3],
        },
        noise: NoiseStream { seed: 5, body: 3 },
    }
}

#[test]
fn a_steady_current_is_the_same_from_fluid_and_input() {
    let velocity = [0.4, 0.1, -0.2];
    let moving = Fluid {
        velocity,
        ..Fluid::WATER
    };
    for (model, integrator) in compositions() {
        let settings = Settings {
            model,
            integrator,
            ..Settings::default()
        };
        let [fluid, input] = [moving, Fluid::WATER]
            .map(|fluid| Stepper::new(&chiral(), &fluid, None, &settings).unwrap());
        let (mut a, mut b) = (tumbling(), tumbling());
        let noise = NoiseStream { seed: 1, body: 2 };
        let current = Input {
            flow: Flow::uniform(velocity),
            noise,
            ..Input::default()
        };
        for _ in 0..50 {
            fluid.step(&mut a, 1e-5, &noise.into()).unwrap();
            input.step(&mut b, 1e-5, &current).unwrap();
        }
        assert_eq!(a, b, "{model} {integrator}");
    }
}

#[test]
fn fluid_that_accelerates_pushes_with_displaced_and_added_mass() {
    for density in [10.0, 1000.0, 5000.0] {
        let body = ellipsoid([0.1; 3], density);
        let displaced = Fluid::WATER.density * body.volume;
        let added = Fluid::WATER.density * body.added_mass[0][0];
        let expected = (displaced + added) / (body.mass + added);
        let stepper = kirchhoff(&body, WEIGHTLESS);
        let (h, a) = (1e-2, [0.3, -0.2, 0.5]);
        let mut state = State::default();
        for n in 0..100 {
            let mut input = Input::default();
            input.flow.acceleration = a;
            input.flow.velocity = scale(f64::from(n) * h, a);
            stepper.step(&mut state, h, &input).unwrap();
        }
        let (velocity, position) = (state.world_velocity(), state.position);
        let errors = [
            distance(velocity, scale(expected, a)),
            distance(position, scale(0.5 * expected, a)),
        ];
        assert!(errors.iter().all(|e| *e < 1e-12), "{density}: {errors:?}");
    }
}

#[test]
fn an_accelerating_fluid_is_a_gravity_to_what_floats_in_it() {
    // Seen from a tank that is pushed by a, all falls under g - a.
    let (g, a) = ([0.0, -9.81, 0.0], [3.0, 1.0, -2.0]);
    let body = chiral();
    let (pushed, inclined) = (
        kirchhoff(&body, g),
        kirchhoff(&body, add(g, scale(-1.0, a))),
    );
    let (mut in_world, mut in_tank) = (tumbling(), tumbling());
    let (h, steps) = (1e-3, 200);
    for n in 0..steps {
        let mut input = Input::default();
        input.flow.acceleration = a;
        input.flow.velocity = scale(f64::from(n) * h, a);
        pushed.step(&mut in_world, h, &input).unwrap();
        inclined.step(&mut in_tank, h, &Input::default()).unwrap();
    }
    let t = f64::from(steps) * h;
    let tank = scale(0.5 * t * t, a);
    assert!(distance(in_world.position, add(in_tank.position, tank)) < 1e-12);
    assert!(distance(in_world.angular_velocity, in_tank.angular_velocity) < 1e-11);
}

#[test]
fn a_force_and_a_torque_change_the_impulses_by_their_time() {
    let stepper = kirchhoff(&chiral(), WEIGHTLESS);
    let (force, torque) = ([0.02, -0.01, 0.03], [2e-4, 3e-4, -1e-4]);
    let input = Input {
        wrench: Wrench { force, torque },
        ..Input::default()
    };
    let mut state = tumbling();
    let linear = stepper.linear_impulse(&state);
    let angular = stepper.angular_impulse(&state);
    let (h, steps) = (1e-3, 300);
    let mut moment = [0.0; 3];
    for _ in 0..steps {
        let before = state.position;
        stepper.step(&mut state, h, &input).unwrap();
        let middle = scale(0.5, add(before, state.position));
        moment = add(moment, scale(h, cross(middle, force)));
    }
    let t = f64::from(steps) * h;
    let given = distance(stepper.linear_impulse(&state), add(linear, scale(t, force)));
    assert!(given < 1e-13, "{given}");
    let wanted = add(add(angular, moment), scale(t, torque));
    let error = distance(stepper.angular_impulse(&state), wanted);
    // The moment of the force is a sum by the midpoint rule here.
    assert!(error < 1e-8, "{error}");
}

#[test]
fn work_from_outside_is_energy() {
    // A ball is turned at ever higher speed: tau^2 t^2 / (2 I), all of it kept.
    let body = ellipsoid([0.1; 3], 2000.0);
    let stepper = kirchhoff(&body, WEIGHTLESS);
    let mut input = Input::default();
    input.wrench.torque = [0.0, 2.0, 0.0];
    input.wrench.force = [0.0, 0.0, 3.0];
    let mut state = State::default();
    for _ in 0..100 {
        stepper.step(&mut state, 1e-2, &input).unwrap();
    }
    let mass = body.mass + Fluid::WATER.density * body.added_mass[0][0];
    let wanted = 2.0 / body.inertia[0][0] + 4.5 / mass;
    let energy = stepper.kinetic_energy(&state);
    assert!((energy / wanted - 1.0).abs() < 1e-12, "{energy} {wanted}");
}

#[test]
fn a_fluid_that_turns_takes_bodies_along() {
    let turning = Flow::turning([0.0; 3], [0.0, 0.0, 3.0]);
    assert_eq!(turning.rotation_rate(), [0.0, 0.0, 3.0]);
    let input = Input {
        flow: turning,
        ..Input::default()
    };
    let mut ball = ellipsoid([0.01; 3], 1000.0);
    ball.separation.stokes_rotation = [[0.0; 3]; 3];
    for i in 0..3 {
        ball.separation.stokes_rotation[i][i] = 8.0 * std::f64::consts::PI * 0.01f64.powi(3);
    }
    let lath = in_slices(ellipsoid([0.05, 0.004, 0.05], 1200.0));
    let honey = Fluid {
        density: 1400.0,
        viscosity: 5e-3,
        velocity: [0.0; 3],
    };
    for (body, fluid) in [(ball, honey), (lath, Fluid::WATER)] {
        let settings = Settings {
            gravity: WEIGHTLESS,
            turbulence: TurbulenceSource::History,
            ..Settings::default()
        };
        let stepper = Stepper::new(&body, &fluid, Some(&frozen(1e-24, 1e-24)), &settings).unwrap();
        let mut state = State::default();
        for _ in 0..4000 {
            // Where the body is, the fluid is at rest but for its turning.
            let mut input = input;
            input.flow.velocity = state.world_velocity();
            stepper.step(&mut state, 1e-2, &input).unwrap();
        }
        let spin = state.world_angular_velocity();
        assert!((spin[2] / 3.0 - 1.0).abs() < 0.05, "{spin:?}");
    }
}

#[test]
fn slices_see_the_wind_where_they_are() {
    // A wind along x that grows along z pushes the far end of a body that lies along z, and not its middle.
    let body = sliced();
    let stepper = quiet(&body, &Fluid::WATER, Model::Separated, Integrator::Strang);
    let mut input = Input::default();
    input.flow.gradient[0][2] = 20.0;
    let still = stepper.loads(&State::default(), &Input::default()).sum();
    let sheared = stepper.loads(&State::default(), &input);
    assert!(norm(still.torque) < 1e-12);
    // Drag of the ends: along x at z > 0, against it at z < 0: a torque about y.
    assert!(sheared.drag.torque[1] > 1e-4, "{:?}", sheared.drag);
}

#[test]
fn bodies_of_a_batch_have_inputs_of_their_own() {
    for (model, integrator) in compositions() {
        for body in [chiral(), sliced(), ellipsoid([0.02, 0.03, 0.05], 900.0)] {
            let settings = Settings {
                model,
                integrator,
                ..Settings::default()
            };
            let stepper = Stepper::new(&body, &Fluid::WATER, None, &settings).unwrap();
            let inputs = |body: u32, state: &State| {
                let mut input = windy();
                input.noise = NoiseStream { seed: 9, body };
                input.wrench.force[1] = 0.01 * f64::from(body);
                input.flow.velocity[0] = 0.1 * state.position[1];
                if body == 4 {
                    Input::with_noise(input.noise)
                } else {
                    input
                }
            };
            let mut batch = Batch::<f64>::new(9);
            let mut alone = [tumbling(); 21];
            for state in &alone {
                batch.push(state);
            }
            for _ in 0..10 {
                stepper.step_batch_with(&mut batch, 1e-5, inputs).unwrap();
                for (body, state) in (0..).zip(&mut alone) {
                    let input = inputs(body, state);
                    stepper.step(state, 1e-5, &input).unwrap();
                }
            }
            for (body, state) in alone.iter().enumerate() {
                assert_eq!(batch.state(body).as_ref(), Some(state), "{model} {body}");
            }
        }
    }
}

#[test]
fn loads_add_up_to_the_change_of_the_impulse() {
    let current = Fluid {
        velocity: [0.05, -0.1, 0.2],
        ..Fluid::WATER
    };
    for (model, integrator) in compositions() {
        for body in [ellipsoid([0.02, 0.03, 0.05], 900.0), chiral(), sliced()] {
            // The printed equations know no coupling of translation and rotation.
            if matches!(model, Model::Published(_)) && body.added_mass[0][1] != 0.0 {
                continue;
            }
            let stepper = quiet(&body, &current, model, integrator);
            for input in [Input::default(), windy()] {
                let start = tumbling();
                let loads = stepper.loads(&start, &input).sum();
                let error = |h: f64| {
                    let mut end = start;
                    stepper.step(&mut end, h, &input).unwrap();
                    let [before, after] =
                        [start, end].map(|state| impulses(&stepper, &state, &input));
                    let rate = |k: usize| scale(1.0 / h, add(after[k], scale(-1.0, before[k])));
                    [
                        distance(rate(0), loads.force),
                        distance(rate(1), loads.torque),
                    ]
                };
                let (coarse, fine) = (error(2e-5), error(1e-5));
                for (k, size) in [(0, norm(loads.force)), (1, norm(loads.torque))] {
                    let what = format!("{model} {integrator} {k}: {coarse:?} {fine:?} of {size}");
                    assert!(fine[k] < 0.02 * size, "{what}");
                    assert!(fine[k] < 0.6 * coarse[k] || fine[k] < 1e-9, "{what}");
                }
            }
        }
    }
}

/// Linear impulse, and angular impulse about the centre of mass, in the frame that moves with the fluid of `input`.
fn impulses(stepper: &Stepper, state: &State, input: &Input) -> [Vec3; 2] {
    let mut seen = *state;
    let velocity = add(state.world_velocity(), scale(-1.0, input.flow.velocity));
    seen.set_world_velocities(velocity, state.world_angular_velocity());
    let linear = stepper.linear_impulse(&seen);
    let angular = stepper.angular_impulse(&seen);
    let about_mass = add(angular, scale(-1.0, cross(state.position, linear)));
    [linear, about_mass]
}

#[test]
fn what_acts_has_its_name() {
    let stepper = quiet(
        &chiral(),
        &Fluid::WATER,
        Model::Separated,
        Integrator::Strang,
    );
    let loads = stepper.loads(&tumbling(), &windy());
    assert_eq!(loads.outside, windy().wrench);
    for (cause, wrench) in loads.causes() {
        let acts = norm(wrench.force) + norm(wrench.torque) > 0.0;
        assert_eq!(
            acts,
            cause != "turbulence" && cause != "friction",
            "{cause}"
        );
    }
}

#[test]
fn an_input_that_is_no_number_is_told() {
    let stepper = kirchhoff(&chiral(), WEIGHTLESS);
    let spoilers: [fn(&mut Input); 5] = [
        |input| input.flow.velocity[0] = f64::NAN,
        |input| input.flow.gradient[1][2] = f64::INFINITY,
        |input| input.flow.acceleration[2] = f64::NEG_INFINITY,
        |input| input.wrench.force[1] = f64::NAN,
        |input| input.wrench.torque[0] = f64::NAN,
    ];
    for spoil in spoilers {
        let mut input = windy();
        spoil(&mut input);
        let mut state = tumbling();
        let told = stepper.step(&mut state, 1e-3, &input);
        assert_eq!(told, Err(StepError::Input { step: 0 }));
        assert_eq!(state, tumbling());
        let mut batch = Batch::<f64>::new(1);
        for _ in 0..3 {
            batch.push(&tumbling());
        }
        let inputs = |body, _: &State| if body == 1 { input } else { windy() };
        let error = stepper
            .step_batch_with(&mut batch, 1e-3, inputs)
            .unwrap_err();
        assert_eq!(
            (error.bodies, error.first),
            (vec![1], StepError::Input { step: 0 })
        );
        assert_eq!(batch.state(2).unwrap().step, 1);
    }
}
