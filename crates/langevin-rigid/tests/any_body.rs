//! Bodies without mass, and ten thousand at random from nearly that to lead: all of them move, and as their
//! energy lets them.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use langevin_rigid::linalg::vector::{norm, scale, sub};
use langevin_rigid::linalg::{Vec3, quat_from_rotation_vector};
use langevin_rigid::{
    Body, BodyError, Fluid, GRAVITY, Input, Model, NoiseStream, SeparatedFlow, Settings,
    SetupError, State, Stepper,
};

const HONEY: Fluid = Fluid {
    density: 1400.0,
    viscosity: 7e-3,
    velocity: [0.0; 3],
};
const FRAME: f64 = 1.0 / 60.0;

fn stepper(body: &Body, fluid: &Fluid, model: Model) -> Result<Stepper, SetupError> {
    let settings = Settings {
        model,
        ..Settings::default()
    };
    Stepper::new(body, fluid, None, &settings)
}

#[test]
fn a_body_without_mass_moves_as_one_that_has_hardly_any() {
    for model in [Model::Separated, Model::Consistent, Model::Kirchhoff] {
        let rise = |density: f64| {
            let body = Body::ellipsoid([0.01, 0.02, 0.04], density).unwrap();
            let stepper = stepper(&body, &Fluid::WATER, model).unwrap();
            let mut state = State {
                orientation: quat_from_rotation_vector([0.1, 0.2, 0.3]),
                ..State::default()
            };
            for _ in 0..20 {
                stepper.step(&mut state, FRAME, &Input::default()).unwrap();
            }
            state.position
        };
        let (massless, light) = (rise(0.0), rise(1e-6));
        assert!(massless[1] > 0.05, "{model}: {massless:?}");
        let apart = norm(std::array::from_fn(|i| massless[i] - light[i]));
        assert!(apart < 1e-6, "{model}: {apart}");
    }
}

#[test]
fn what_has_no_inertia_is_refused_with_its_motion() {
    let refused = |body: &Body| {
        let error = stepper(body, &Fluid::WATER, Model::Separated).unwrap_err();
        assert!(matches!(error, SetupError::TotalMass { .. }), "{error}");
        error.to_string()
    };
    let disc = Body::disc(0.01, 0.001, 0.0).unwrap();
    let told = refused(&disc);
    assert!(told.contains("turns about [0.00, 1.00, 0.00]"), "{told}");
    refused(&Body::sphere(0.01, 0.0).unwrap());
    // With its gas it moves.
    let gas = Body::disc(0.01, 0.001, 1.2).unwrap();
    assert!(stepper(&gas, &Fluid::WATER, Model::Separated).is_ok());

    assert!(matches!(
        Body::sphere(0.01, -1.0),
        Err(BodyError::Negative {
            name: "density",
            ..
        })
    ));
    // Only what has no mass may have no inertia.
    let brick = Body::cuboid([0.1, 0.2, 0.3], 500.0).unwrap();
    let with = |mass| brick.with_mass_properties(mass, [0.0; 3], [[0.0; 3]; 3]);
    assert_eq!(with(1.0), Err(BodyError::Inertia));
    assert!(with(0.0).is_ok());
}

/// Numbers of one body.
struct Dice {
    stream: NoiseStream,
    rolled: u64,
}

impl Dice {
    fn of(body: u32) -> Self {
        let stream = NoiseStream { seed: 60, body };
        Self { stream, rolled: 0 }
    }

    fn normals(&mut self) -> Vec3 {
        self.rolled += 1;
        let z = self.stream.normals(self.rolled);
        [z[0], z[1], z[2]]
    }

    fn uniform(&mut self) -> f64 {
        0.5 * (1.0 + libm::erf(self.normals()[0] / std::f64::consts::SQRT_2))
    }

    /// Its logarithm is uniform.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low * libm::pow(high / low, self.uniform())
    }

    fn among(&mut self, count: usize) -> usize {
        (self.uniform() * count as f64) as usize
    }

    /// Any direction, sizes up to `most`.
    fn vector(&mut self, most: f64) -> Vec3 {
        let z = self.normals();
        scale(most * self.uniform() / norm(z), z)
    }

    fn body(&mut self) -> (String, Body) {
        let density = self.between(1e-3, 11_000.0);
        let [a, b, c] = [(); 3].map(|()| self.between(1e-3, 1.0));
        let (kind, body) = match self.among(5) {
            0 => ("ellipsoid", Body::ellipsoid([a, b, c], density)),
            1 => ("disc", Body::disc(a.max(b), a.min(b), density)),
            2 => {
                let mut size = [a, b, c];
                size.sort_by(|a, b| b.total_cmp(a));
                ("plate", Body::plate(size[0], size[1], size[2], density))
            }
            3 => ("cylinder", Body::cylinder(a, b, density)),
            _ => ("cuboid", Body::cuboid([a, b, c], density)),
        };
        (
            format!("{kind} {a:.2e} {b:.2e} {c:.2e} m of {density:.2e} kg/m^3"),
            body.unwrap(),
        )
    }

    fn fluid(&mut self) -> Fluid {
        [Fluid::AIR, Fluid::WATER, HONEY][self.among(3)]
    }

    fn release(&mut self) -> State {
        State {
            orientation: quat_from_rotation_vector(self.normals().map(|z| 2.0 * z)),
            velocity: self.vector(10.0),
            angular_velocity: self.vector(100.0),
            ..State::default()
        }
    }
}

/// Steps a body at random and says what is wrong with how it moves.
fn fall(number: u32) -> Option<String> {
    let mut dice = Dice::of(number);
    let (what, body) = dice.body();
    let (fluid, start) = (dice.fluid(), dice.release());
    let what = format!("{number}: {what} in {} kg/m^3", fluid.density);
    let stepper = stepper(&body, &fluid, Model::Separated).unwrap();
    let weight = GRAVITY[1] * (body.mass - fluid.density * body.volume);
    let first = stepper.kinetic_energy(&start);
    let noise = NoiseStream {
        seed: 61,
        body: number,
    };
    let mut state = start;
    // A second of every twentieth, a fifth of it of the others.
    for _ in 0..if number.is_multiple_of(20) { 60 } else { 12 } {
        if let Err(error) = stepper.step(&mut state, FRAME, &noise.into()) {
            return Some(format!("{what}: {error}"));
        }
        // Weight gives what the body has fallen. What turbulence gives it takes from the body's own motion.
        let given = (weight * state.position[1]).max(0.0);
        let gain = stepper.kinetic_energy(&state) / (first + given);
        if gain > 1.01 {
            return Some(format!("{what}: {gain} of its energy at {} s", state.time));
        }
    }
    None
}

#[test]
fn ten_thousand_bodies_move_as_their_energy_lets_them() {
    const BODIES: u32 = 10_000;
    let workers = std::thread::available_parallelism().map_or(1, |n| n.get());
    let failures: Vec<String> = std::thread::scope(|scope| {
        let falls = |first: usize| {
            move || -> Vec<String> {
                (first as u32..BODIES)
                    .step_by(workers)
                    .filter_map(fall)
                    .collect()
            }
        };
        let threads: Vec<_> = (0..workers)
            .map(|first| scope.spawn(falls(first)))
            .collect();
        threads
            .into_iter()
            .flat_map(|t| t.join().unwrap())
            .collect()
    });
    assert!(
        failures.is_empty(),
        "{} fail:\n{}",
        failures.len(),
        failures.join("\n")
    );
}

/// What a body at random is, its mean speed over the last four of eight seconds without turbulence in steps of a
/// frame over `parts`, and how far its speed is from that at most, as a share.
fn settled(number: u32, parts: u32) -> (String, f64, f64) {
    let mut dice = Dice::of(number);
    let (what, body) = dice.body();
    let (fluid, mut state) = (dice.fluid(), dice.release());
    let settings = Settings {
        separated: SeparatedFlow {
            turbulence_intensity: 0.0,
            ..SeparatedFlow::default()
        },
        ..Settings::default()
    };
    let stepper = Stepper::new(&body, &fluid, None, &settings).unwrap();
    let step = FRAME / f64::from(parts);
    let mut fall_for = |steps: u32| -> Vec<State> {
        let mut next = |_| {
            stepper.step(&mut state, step, &Input::default()).unwrap();
            state
        };
        (0..steps * parts).map(&mut next).collect()
    };
    let middle = *fall_for(240).last().unwrap();
    let late = fall_for(240);
    let end = late.last().unwrap();
    let mean = norm(sub(end.position, middle.position)) / (end.time - middle.time);
    let off = late.iter().map(|s| (norm(s.velocity) / mean - 1.0).abs());
    let what = format!("{number}: {what} in {} kg/m^3", fluid.density);
    (what, mean, off.fold(0.0, f64::max))
}

#[test]
fn what_falls_steadily_does_so_at_the_step_of_a_frame() {
    let mut steady = 0;
    for number in 20_000..20_080 {
        let (what, fine, off) = settled(number, 10);
        if off < 0.01 {
            steady += 1;
            let (_, coarse, _) = settled(number, 1);
            assert!(
                (coarse / fine - 1.0).abs() < 0.1,
                "{what}: {coarse} m/s, {fine} m/s at a tenth of the step"
            );
        }
    }
    assert!(steady >= 15, "{steady}");
}
