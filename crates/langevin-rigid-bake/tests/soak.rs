//! A thousand bodies at random, baked and stepped: nothing that is not finite leaves the bake, and no body
//! gains energy that nothing gave it.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use langevin_rigid::linalg::{Vec3, quat_from_rotation_vector};
use langevin_rigid::{
    Body, Fluid, GRAVITY, Model, NoiseStream, Settings, State, Stepper, falling_speed,
};
use langevin_rigid_bake::body::{BodySpec, bake_body};
use langevin_rigid_bake::shapes::Shape;
use rayon::prelude::*;

const HONEY: Fluid = Fluid {
    density: 1420.0,
    viscosity: 7e-3,
    velocity: [0.0; 3],
};

/// Numbers of one body, uniform on (0, 1).
struct Dice {
    stream: NoiseStream,
    rolled: u64,
}

impl Dice {
    fn uniform(&mut self) -> f64 {
        self.rolled += 1;
        let normal = self.stream.normals(self.rolled)[0];
        0.5 * (1.0 + libm::erf(normal / std::f64::consts::SQRT_2))
    }

    /// Its logarithm is uniform.
    fn between(&mut self, low: f64, high: f64) -> f64 {
        low * libm::pow(high / low, self.uniform())
    }

    fn among(&mut self, count: usize) -> usize {
        (self.uniform() * count as f64) as usize
    }

    fn normals(&mut self) -> Vec3 {
        self.rolled += 1;
        let z = self.stream.normals(self.rolled);
        [z[0], z[1], z[2]]
    }
}

fn shape(dice: &mut Dice) -> Shape {
    let size = dice.between(1e-3, 0.5);
    let [a, b] = [(); 2].map(|()| size * dice.between(0.05, 1.0));
    let thickness = size * dice.between(0.003, 0.3);
    match dice.among(10) {
        0 => Shape::Ellipsoid {
            semi_axes: [size, a, b],
        },
        1 => Shape::EllipticalPlate {
            semi_axes: [size, a],
            thickness,
        },
        2 => Shape::Disc {
            radius: size,
            thickness,
        },
        3 => Shape::Washer {
            diameter: size,
            inner_diameter: size * 0.6,
            thickness: 0.3 * thickness,
        },
        4 => Shape::Box { size: [size, a, b] },
        5 => Shape::Box {
            size: [size, thickness, a],
        },
        6 => Shape::Cylinder {
            radius: a,
            height: size,
        },
        7 => Shape::Leaf {
            length: size,
            width: 0.5 * size,
            thickness: 0.1 * thickness,
        },
        8 => Shape::Samara {
            length: size,
            width: 0.3 * size,
            thickness: 0.1 * thickness,
        },
        _ => Shape::PaperAirplane {
            side: size,
            thickness: 0.1 * thickness,
        },
    }
}

/// Steps a body for two seconds and says what is wrong with how it moves.
fn fall(body: &Body, fluid: &Fluid, model: Model, start: &State, seed: u64) -> Result<(), String> {
    let settings = Settings {
        model,
        ..Settings::default()
    };
    let stepper = Stepper::new(body, fluid, None, &settings).map_err(|e| e.to_string())?;
    let weight = GRAVITY[1] * (body.mass - fluid.density * body.volume);
    let noise = NoiseStream { seed, body: 0 };
    let (mut state, first) = (*start, stepper.kinetic_energy(start));
    let (mut most, mut given) = (first, 0.0f64);
    for _ in 0..120 {
        stepper
            .step(&mut state, 1.0 / 60.0, &noise.into())
            .map_err(|e| e.to_string())?;
        most = most.max(stepper.kinetic_energy(&state));
        given = given.max(weight * (state.position[1] - start.position[1]));
    }
    // Weight gives what the body has fallen. What turbulence gives it takes from the body's own motion.
    let allowed = match model {
        // A millionth a part is taken for rounding, and there may be 256 parts a step.
        Model::Kirchhoff => 1.05 * (first + given),
        // In the mean the noise gains nothing; a gain of twenty times has at most a chance of one in twenty.
        _ => 20.0 * (first + given),
    };
    let speed = falling_speed(body, fluid, GRAVITY);
    let unit = body.total_mass(fluid.density)[0][0].max(body.total_mass(fluid.density)[1][1])
        * speed
        * speed;
    if most
        <= allowed
            + if model == Model::Consistent {
                5.0 * unit
            } else {
                0.02 * unit
            }
    {
        return Ok(());
    }
    Err(format!(
        "{model}: energy {most:.3e} J of {allowed:.3e} J, {state:?}"
    ))
}

#[test]
fn random_bodies_are_finite_and_move_as_their_energy_lets_them() {
    soak(0..250);
}

#[test]
#[ignore = "three minutes"]
fn a_thousand_more_do_too() {
    soak(250..1250);
}

/// Bakes and drops the random bodies of these numbers.
fn soak(numbers: std::ops::Range<u32>) {
    let failures: Vec<String> = numbers
        .into_par_iter()
        .flat_map_iter(|number| {
            let mut dice = Dice {
                stream: NoiseStream {
                    seed: 2014,
                    body: number,
                },
                rolled: 0,
            };
            let shape = shape(&mut dice);
            let triangles = 64 + dice.among(200);
            let fluid = [Fluid::AIR, Fluid::WATER, HONEY][dice.among(3)];
            let density = dice.between(1.0, 1e4);
            let spec = BodySpec {
                density: Some(density),
                ..BodySpec::default()
            };
            let what = format!(
                "{number}: {shape:?} of {density:.0} kg/m^3 in {} kg/m^3",
                fluid.density
            );
            let (body, _) = match bake_body(&shape.mesh(triangles).unwrap(), &spec, &()) {
                Ok(baked) => baked,
                Err(error) => return vec![format!("{what}: {error}")],
            };
            let mut start = State {
                orientation: quat_from_rotation_vector(dice.normals()),
                ..State::default()
            };
            if dice.among(2) == 0 {
                start.velocity = dice.normals().map(|x| 3.0 * x);
                start.angular_velocity = dice.normals().map(|x| 10.0 * x);
            }
            [Model::Separated, Model::Consistent, Model::Kirchhoff]
                .into_iter()
                .filter_map(|model| fall(&body, &fluid, model, &start, 1).err())
                .map(|error| format!("{what}: {error}"))
                .collect()
        })
        .collect();
    assert!(
        failures.is_empty(),
        "{} fail:\n{}",
        failures.len(),
        failures.join("\n")
    );
}
