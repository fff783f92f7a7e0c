//! What the runs of an ensemble begin with: a pure function of seed and number.

use std::f64::consts::SQRT_2;

use langevin_rigid::linalg::{Quat, Vec3, quat_from_rotation_vector};
use langevin_rigid::{NoiseStream, State};
use serde::{Deserialize, Serialize};

use crate::scene::quantity::{DENSITY, Kind, MASS, POSITIVE, VISCOSITY};
use crate::scene::{Scatter, Scene, Spread};

/// A step that no run ever takes: its normals are free for deviations about the scene's tilt, spin and velocity.
const RELEASE_STEP: u64 = u64::MAX;
/// The first of the steps whose normals are free for all else, counted downwards: one a quantity and attempt.
const FIRST_STEP: u64 = u64::MAX - 16;
/// Quantities that may be drawn.
const QUANTITIES: u64 = 16;
/// Attempts at a possible value. One in two succeeds, as means are possible.
const ATTEMPTS: u64 = 100;

/// What a run begins with.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Draw {
    /// Pose and velocities.
    pub release: State,
    /// Drawn turn from the scene's release about the world's z axis (degrees); zero where it is the scene's deviation about
    /// both horizontal axes.
    pub tilt: f64,
    /// Drawn turn about the vertical after that (degrees).
    pub heading: f64,
    /// What body and fluid are; none where they are the scene's.
    pub change: Option<Change>,
}

/// What is other than the scene's. Of each, none where it is the scene's.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct Change {
    /// Size of the body, as a multiple of the scene's.
    pub size: Option<f64>,
    /// Its mass (kg).
    pub mass: Option<f64>,
    /// Density of the fluid (kg/m^3).
    pub density: Option<f64>,
    /// Kinematic viscosity of the fluid (m^2/s).
    pub viscosity: Option<f64>,
    /// Velocity of the fluid, world frame (m/s).
    pub wind: Option<Vec3>,
}

/// What run `run` of the scene begins with; `mass` is that of the scene's body (kg).
pub fn draw(scene: &Scene, mass: f64, run: u32) -> Draw {
    let scatter = &scene.scatter;
    let draws = Draws {
        stream: stream(scene, run),
    };
    let (release, tilt, heading) = release(scene, &draws);
    let change = scatter.changes_body_or_fluid().then(|| {
        let fluid = draws.one_of(7, &scatter.fluid);
        let fluid = fluid.map(|(_, fluid)| fluid);
        let number = |quantity, spread: &Option<Spread>, own, kind| {
            let spread = spread.as_ref()?;
            Some(draws.value(quantity, spread, [own], Some(kind))[0])
        };
        Change {
            size: number(5, &scatter.size, 1.0, POSITIVE),
            mass: number(6, &scatter.mass, mass, MASS),
            density: number(8, &scatter.fluid_density, scene.fluid.density, DENSITY)
                .or(fluid.map(|fluid| fluid.density)),
            viscosity: number(
                9,
                &scatter.fluid_viscosity,
                scene.fluid.viscosity,
                VISCOSITY,
            )
            .or(fluid.map(|fluid| fluid.viscosity)),
            wind: scatter
                .wind
                .as_ref()
                .map(|wind| draws.value(10, wind, scene.fluid.velocity, None)),
        }
    });
    Draw {
        release,
        tilt,
        heading,
        change,
    }
}

/// The release of run `run`: the scene's, with its scatter.
///
/// A deviation about the scene's tilt turns the body in the world by a rotation vector in the horizontal plane, so that
/// its normal tips about the world's x and z; the velocities are those of the world frame. A pure function of the scene's
/// seed and the run, independent of the noise of the steps.
pub fn scattered_release(scene: &Scene, run: u32) -> State {
    let draws = Draws {
        stream: stream(scene, run),
    };
    release(scene, &draws).0
}

fn stream(scene: &Scene, run: u32) -> NoiseStream {
    NoiseStream {
        seed: scene.seed,
        body: run,
    }
}

/// The release, its tilt and its heading.
fn release(scene: &Scene, draws: &Draws) -> (State, f64, f64) {
    let Scatter {
        height,
        tilt,
        heading,
        velocity,
        spin,
        ..
    } = &scene.scatter;
    let mut state = scene.release;
    if scene.scatter.is_none() {
        return (state, 0.0, 0.0);
    }
    let [a, b, sx, sy, sz, vx, vy, vz, ..] = draws.stream.normals(RELEASE_STEP);
    if let Some(height) = height {
        state.position[1] = draws.value(0, height, [state.position[1]], None)[0];
    }
    let mut turn = |vector: Vec3| {
        state.orientation = product(quat_from_rotation_vector(vector), state.orientation);
    };
    let tilt = match tilt {
        None => 0.0,
        Some(Spread::About(deviation)) => {
            let deviation = deviation.to_radians();
            turn([deviation * a, 0.0, deviation * b]);
            0.0
        }
        Some(spread) => {
            let [tilt] = draws.value(1, spread, [0.0], None);
            turn([0.0, 0.0, tilt.to_radians()]);
            tilt
        }
    };
    let heading = heading.as_ref().map_or(0.0, |spread| {
        let [heading] = draws.value(2, spread, [0.0], None);
        turn([0.0, heading.to_radians(), 0.0]);
        heading
    });
    let drawn = |quantity, spread: &Option<Spread<3>>, own: Vec3, normals| match spread {
        None => own,
        Some(Spread::About(deviation)) => about(own, *deviation, normals),
        Some(spread) => draws.value(quantity, spread, own, None),
    };
    state.set_world_velocities(
        drawn(3, velocity, scene.release.world_velocity(), [vx, vy, vz]),
        drawn(
            4,
            spin,
            scene.release.world_angular_velocity(),
            [sx, sy, sz],
        ),
    );
    (state, tilt, heading)
}

/// The draws of one run; quantities are numbered from 0.
struct Draws {
    stream: NoiseStream,
}

impl Draws {
    /// A value of a quantity whose own value in the scene is `own`; one of the kind, if given.
    fn value<const N: usize>(
        &self,
        quantity: u64,
        spread: &Spread<N>,
        own: [f64; N],
        kind: Option<Kind>,
    ) -> [f64; N] {
        let possible =
            |value: &[f64; N]| kind.is_none_or(|kind| value.iter().all(|x| kind.includes(*x)));
        let mut attempts = (0..ATTEMPTS).map(|attempt| {
            let normals = self.normals(quantity, attempt);
            match spread {
                Spread::About(deviation) => about(own, *deviation, normals),
                Spread::Normal(mean, deviation) => {
                    std::array::from_fn(|i| mean[i] + deviation[i] * normals[i])
                }
                Spread::Uniform(least, most) => std::array::from_fn(|i| {
                    (least[i] + (most[i] - least[i]) * uniform(normals[i])).min(most[i])
                }),
                Spread::Values(values) => values[index(normals[0], values.len())],
            }
        });
        attempts.find(possible).unwrap_or(own)
    }

    fn one_of<T: Copy>(&self, quantity: u64, choices: &[T]) -> Option<T> {
        let [normal] = self.normals(quantity, 0);
        choices.get(index(normal, choices.len().max(1))).copied()
    }

    fn normals<const N: usize>(&self, quantity: u64, attempt: u64) -> [f64; N] {
        let normals = self
            .stream
            .normals(FIRST_STEP - (QUANTITIES * attempt + quantity));
        std::array::from_fn(|i| normals[i])
    }
}

fn about<const N: usize>(own: [f64; N], deviation: f64, normals: [f64; N]) -> [f64; N] {
    std::array::from_fn(|i| own[i] + deviation * normals[i])
}

/// One of so many as a normal number says, each as likely as any other.
fn index(normal: f64, count: usize) -> usize {
    ((uniform(normal) * count as f64) as usize).min(count - 1)
}

/// The share of normal numbers that are smaller.
pub(crate) fn uniform(normal: f64) -> f64 {
    0.5 * libm::erfc(-normal / SQRT_2)
}

/// The turn `b`, then `a`.
pub(crate) fn product(a: Quat, b: Quat) -> Quat {
    [
        a[3] * b[0] + a[0] * b[3] + a[1] * b[2] - a[2] * b[1],
        a[3] * b[1] - a[0] * b[2] + a[1] * b[3] + a[2] * b[0],
        a[3] * b[2] + a[0] * b[1] - a[1] * b[0] + a[2] * b[3],
        a[3] * b[3] - a[0] * b[0] - a[1] * b[1] - a[2] * b[2],
    ]
}

#[cfg(test)]
mod tests;
