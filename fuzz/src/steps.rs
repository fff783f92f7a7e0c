//! From a scene to 300 steps.

use std::sync::{Arc, LazyLock};

use langevin_rigid::linalg::{eigen_symmetric, quat_from_rotation_vector};
use langevin_rigid::{
    Bake, Batch, Body, Fluid, Model, NoiseStream, SPEED_LIMIT, State, StepError, Stepper,
    TurbulenceHistory, TurbulenceSource,
};
use langevin_rigid_bake::body::{BodySpec, bake_body};
use langevin_rigid_bake::shapes::Shape;
use langevin_rigid_scenes::advance::advance;
use langevin_rigid_scenes::baking::Baked;
use langevin_rigid_scenes::prepared::{Prepared, Release};
use langevin_rigid_scenes::scene::Scene;

use crate::numbers::Numbers;

const TIME_STEP: f64 = 1.0 / 60.0;
const STEPS: usize = 300;
/// Steps of a body that is released at an absurd speed, each of them in thousands of parts.
const FAST_STEPS: usize = 10;
/// Steps that are taken in lanes, too.
const BATCHED: usize = 10;

const HONEY: Fluid = Fluid {
    density: 1420.0,
    viscosity: 7e-3,
    velocity: [0.0; 3],
};

/// Lets a body fall under one of the models: every state is finite, and only one that was absurd at release is an error.
pub(crate) fn fall(bytes: &[u8], models: &[Model]) {
    let numbers = &mut Numbers::new(bytes);
    let body = body(numbers);
    let absurd = numbers.below(8) == 7;
    let scene = scene(numbers, models, absurd);
    let bake = Bake {
        body,
        history: Some(history(numbers)),
        error_estimate: 0.0,
        warnings: Vec::new(),
        fingerprint: [0; 32],
    };
    let baked = Baked {
        bake,
        notices: Vec::new(),
        cached: false,
        cache_trouble: None,
    };
    let prepared = Prepared::of(scene, Arc::new(baked)).unwrap();
    let (scene, stepper) = (prepared.scene(), prepared.stepper());
    in_lanes(scene, stepper);
    let release = Release {
        state: scene.release,
        noise: NoiseStream {
            seed: scene.seed,
            body: 0,
        },
    };
    let mut state = release.state;
    for _ in 0..if absurd { FAST_STEPS } else { STEPS } {
        match advance(&prepared, &release, &mut state) {
            Ok(()) => assert!(state.is_finite(), "{state:?}"),
            Err(error) => {
                assert!(
                    absurd && is_absurd(&error, stepper, prepared.body(), &state),
                    "{error}: {state:?} {scene:?}"
                );
                return;
            }
        }
    }
}

/// Bakes the bodies.
pub(crate) fn prepare() {
    LazyLock::force(&BODIES);
}

/// Whether the state is to blame for the error: its energy, all of it in a spin about one axis, would pass a tenth of the limit.
fn is_absurd(error: &StepError, stepper: &Stepper, body: &Body, state: &State) -> bool {
    let ([least, ..], _) = eigen_symmetric(&body.inertia);
    let spin = (2.0 * stepper.kinetic_energy(state) / least).sqrt();
    matches!(error, StepError::State { .. } | StepError::Diverged { .. })
        && state
            .velocity
            .iter()
            .fold(spin, |fastest, v| fastest.max(v.abs()))
            > 0.1 * SPEED_LIMIT
}

/// A body has the same bits alone and in a batch.
fn in_lanes(scene: &Scene, stepper: &Stepper) {
    let mut batch = Batch::<f64>::new(scene.seed);
    batch.push(&scene.release);
    let mut alone = scene.release;
    let noise = NoiseStream {
        seed: scene.seed,
        body: 0,
    };
    for _ in 0..BATCHED {
        let lanes = stepper.step_batch(&mut batch, TIME_STEP);
        let one = stepper.step(&mut alone, TIME_STEP, &noise.into());
        assert_eq!(lanes.map_err(|error| error.first), one);
        // Zeros have a sign.
        assert_eq!(
            format!("{:?}", batch.state(0).unwrap()),
            format!("{alone:?}")
        );
        if one.is_err() {
            return;
        }
    }
}

static BODIES: LazyLock<Vec<Body>> = LazyLock::new(|| {
    let thickness = 1e-3;
    let shapes = [
        Shape::Ellipsoid {
            semi_axes: [0.01; 3],
        },
        Shape::Ellipsoid {
            semi_axes: [0.01, 0.02, 0.04],
        },
        Shape::Box {
            size: [0.1, 0.05, 1e-4],
        },
        Shape::Box {
            size: [1.0, 0.02, 0.02],
        },
        Shape::Box { size: [1e-3; 3] },
        Shape::Disc {
            radius: 0.02,
            thickness,
        },
        Shape::Washer {
            diameter: 0.02,
            inner_diameter: 0.012,
            thickness,
        },
        Shape::Cylinder {
            radius: 2e-3,
            height: 0.1,
        },
        Shape::PaperAirplane {
            side: 0.2,
            thickness: 1e-4,
        },
        Shape::Leaf {
            length: 0.08,
            width: 0.05,
            thickness: 3e-4,
        },
        Shape::Feather {
            length: 0.1,
            width: 0.02,
            thickness,
        },
        Shape::Samara {
            length: 0.035,
            width: 0.011,
            thickness: 3e-4,
        },
    ];
    let spec = BodySpec {
        density: Some(1.0),
        ..BodySpec::default()
    };
    let baked = |shape: Shape| bake_body(&shape.mesh(100).unwrap(), &spec, &()).unwrap().0;
    shapes.map(baked).to_vec()
});

/// One of the bodies, of any density.
fn body(numbers: &mut Numbers) -> Body {
    let mut body = BODIES[numbers.below(BODIES.len())].clone();
    let density = numbers.between(1.0, 1e4);
    body.mass *= density;
    body.inertia = body.inertia.map(|row| row.map(|x| density * x));
    body
}

fn fluid(numbers: &mut Numbers) -> Fluid {
    let fluid = match numbers.below(4) {
        0 => Fluid::AIR,
        1 => Fluid::WATER,
        2 => HONEY,
        _ => Fluid {
            density: numbers.between(0.01, 2e4),
            viscosity: numbers.between(1e-7, 1.0),
            velocity: [0.0; 3],
        },
    };
    let velocity = match numbers.below(4) {
        0 => numbers.vector(20.0),
        _ => [0.0; 3],
    };
    Fluid { velocity, ..fluid }
}

fn release(numbers: &mut Numbers, absurd: bool) -> State {
    let orientation = quat_from_rotation_vector(numbers.vector(3.0));
    let faster = if absurd {
        numbers.between(1.0, 1e9)
    } else {
        1.0
    };
    let (velocity, angular_velocity) = match numbers.below(4) {
        0 => ([0.0; 3], [0.0; 3]),
        _ => (numbers.vector(20.0), numbers.vector(100.0)),
    };
    State {
        orientation,
        velocity: velocity.map(|v| faster * v),
        angular_velocity: angular_velocity.map(|w| faster * w),
        ..State::default()
    }
}

fn scene(numbers: &mut Numbers, models: &[Model], absurd: bool) -> Scene {
    let text = r#"
        fluid.preset = "air"
        run = { time_step = 0.01, duration = 1.0 }
        body = { shape = "box", size = [0.1, 0.1, 0.1], density = 100.0 }
    "#;
    let mut scene = Scene::parse("fuzz", "fuzz.toml", text).unwrap();
    scene.time_step = TIME_STEP;
    scene.seed = numbers.any();
    scene.settings.model = numbers.among(models);
    scene.settings.turbulence = match numbers.below(4) {
        0 => TurbulenceSource::History,
        1 => TurbulenceSource::BodyDriven {
            wake_age: 30.0 * numbers.unit(),
        },
        _ => TurbulenceSource::default(),
    };
    scene.fluid = fluid(numbers);
    scene.release = release(numbers, absurd);
    scene
}

/// Turbulence that decays, as that of a grid does.
fn history(numbers: &mut Numbers) -> TurbulenceHistory {
    let (k, epsilon) = (numbers.between(1e-6, 10.0), numbers.between(1e-6, 1e3));
    let decay = |x: f64| (0..20).map(|i| x / f64::from(1 + i)).collect();
    TurbulenceHistory {
        interval: 0.1,
        inflow_speed: numbers.between(0.1, 10.0),
        length: numbers.between(1e-3, 0.1),
        k: decay(k),
        epsilon: decay(epsilon),
    }
}
