//! The releases and forces that are searched, as numbers between -1 and 1.

use langevin_rigid::linalg::vector::{add, norm, scale};
use langevin_rigid::linalg::{Quat, Vec3, quat_from_rotation_vector};
use langevin_rigid::{NoiseStream, State, TurbulenceSource};

use crate::baking::characteristic_speed;
use crate::ensemble::product;
use crate::prepared::{Prepared, Release};
use crate::scene::{Direct, Scene, Steering};

/// Numbers of a release: tilt about x and z, heading, position, velocity, spin.
const RELEASE: usize = 12;
/// Control points of a force over the time of a fall, less one.
const INTERVALS: f64 = 8.0;
/// Control points of a force.
const POINTS: usize = 11;
/// Numbers of all.
const ALL: usize = RELEASE + 3 * POINTS;
/// Normals of a draw: three more, which move all control points together.
const NORMALS: usize = ALL + 3;
/// Steps that no run ever takes: their normals are free for the draws.
const DRAW: u64 = u64::MAX;

/// What is searched.
pub(super) struct Space<'a> {
    scene: &'a Scene,
    /// What the numbers of a release are in units of.
    units: [f64; RELEASE],
    /// The force, once it is free.
    force: Option<Force>,
}

struct Force {
    largest: f64,
    every: f64,
}

/// A point of it, and a stream of noise.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Candidate {
    at: [f64; ALL],
    stream: u32,
}

impl<'a> Space<'a> {
    pub(super) fn new(prepared: &'a Prepared, direct: &Direct) -> Self {
        let free = &direct.free;
        let (tilt, heading) = (free.tilt.to_radians(), free.heading.to_radians());
        let [x, y, z] = free.position;
        let (v, w) = (free.velocity, free.spin);
        Self {
            scene: prepared.scene(),
            units: [tilt, tilt, heading, x, y, z, v, v, v, w, w, w],
            force: None,
        }
    }

    /// Frees a force of this share of the weight, for falls of about so many seconds.
    pub(super) fn steer(&mut self, prepared: &Prepared, share: f64, seconds: f64) {
        let weight = prepared.body().mass * norm(self.scene.settings.gravity);
        self.force = Some(Force {
            largest: share * weight,
            every: seconds.max(self.scene.time_step) / INTERVALS,
        });
    }

    /// The numbers that are free.
    fn free(&self) -> impl Iterator<Item = usize> {
        let release = self.units.iter().enumerate();
        let release = release.filter(|(_, unit)| **unit > 0.0);
        let all = if self.force.is_some() { ALL } else { RELEASE };
        release.map(|(place, _)| place).chain(RELEASE..all)
    }

    /// Evenly from all the freedom of the release, with noise of its own and no force.
    pub(super) fn draw(&self, number: u32) -> Candidate {
        let mut at = [0.0; ALL];
        let normals = self.normals(number);
        for place in self.free().filter(|place| *place < RELEASE) {
            at[place] = libm::erf(normals[place] * std::f64::consts::FRAC_1_SQRT_2);
        }
        Candidate { at, stream: number }
    }

    /// A candidate near another, with its noise; with other noise where nothing else is free.
    pub(super) fn near(&self, candidate: &Candidate, spread: f64, number: u32) -> Candidate {
        let mut near = candidate.clone();
        let normals = self.normals(number);
        let mut alone = true;
        for place in self.free() {
            // A force that changes as a whole takes a body farther than one that changes to and fro.
            let together = match place.checked_sub(RELEASE) {
                Some(of_force) => 2.0 * normals[ALL + of_force % 3],
                None => 0.0,
            };
            near.at[place] = reflected(near.at[place] + spread * (normals[place] + together));
            alone = false;
        }
        if alone {
            near.stream = number;
        }
        near
    }

    /// Normals of draw `number`, beside those of the noise.
    fn normals(&self, number: u32) -> [f64; NORMALS] {
        let stream = NoiseStream {
            seed: self.scene.seed,
            body: number,
        };
        let mut normals = [0.0; NORMALS];
        for (step, some) in (0..).zip(normals.chunks_mut(12)) {
            some.copy_from_slice(&stream.normals(DRAW - step)[..some.len()]);
        }
        normals
    }

    /// How different two candidates are: the largest difference of a number that is free, of 2 at most.
    pub(super) fn difference(&self, a: &Candidate, b: &Candidate) -> f64 {
        let each = self.free().map(|place| (a.at[place] - b.at[place]).abs());
        each.reduce(f64::max)
            .unwrap_or(if a.stream == b.stream { 0.0 } else { 2.0 })
    }

    pub(super) fn release(&self, candidate: &Candidate) -> Release {
        let noise = NoiseStream {
            seed: self.scene.seed,
            body: candidate.stream,
        };
        let base = self.scene.release;
        if self.units == [0.0; RELEASE] {
            return Release { state: base, noise };
        }
        let of: [f64; RELEASE] = std::array::from_fn(|i| self.units[i] * candidate.at[i]);
        let [x, z] = within_one([candidate.at[0], candidate.at[1]]);
        let tilt = quat_from_rotation_vector([self.units[0] * x, 0.0, self.units[1] * z]);
        let heading = quat_from_rotation_vector([0.0, of[2], 0.0]);
        let mut state = State {
            position: add(base.position, [of[3], of[4], of[5]]),
            orientation: unit(product(tilt, product(heading, base.orientation))),
            ..base
        };
        state.set_world_velocities(
            add(base.world_velocity(), [of[6], of[7], of[8]]),
            add(base.world_angular_velocity(), [of[9], of[10], of[11]]),
        );
        Release { state, noise }
    }

    pub(super) fn steering(&self, candidate: &Candidate) -> Option<Steering> {
        let force = self.force.as_ref()?;
        let points = candidate.at[RELEASE..].as_chunks().0;
        if points.iter().all(|point: &Vec3| *point == [0.0; 3]) {
            return None;
        }
        Some(Steering {
            every: force.every,
            force: points
                .iter()
                .map(|point| scale(force.largest, within_one(*point)))
                .collect(),
        })
    }
}

/// The scene in which body 0 has this release, this noise and this force.
pub(super) fn scene(prepared: &Prepared, release: &Release, steering: Option<&Steering>) -> Scene {
    let searched = prepared.scene();
    let mut scene = searched.clone();
    scene.direct = None;
    scene.release = release.state;
    scene.stream = release.noise.body;
    scene.steering = steering.or(searched.steering.as_ref()).cloned();
    scene.settings.release_speed = scene.release_speed();
    let speeds = [searched, &scene].map(|scene| characteristic_speed(scene, prepared.body()));
    if speeds[0] != speeds[1] {
        scene.settings.reynolds = Some(prepared.stepper().reynolds());
        if scene.settings.turbulence == TurbulenceSource::History {
            scene.grid.inflow_speed = scene.grid.inflow_speed.or(Some(speeds[0]));
        }
    }
    scene
}

/// Back from the ends -1 and 1 as from walls.
fn reflected(x: f64) -> f64 {
    let inside = match x {
        x if x > 1.0 => 2.0 - x,
        x if x < -1.0 => -2.0 - x,
        x => x,
    };
    inside.clamp(-1.0, 1.0)
}

/// A vector that is no longer than one.
fn within_one<const N: usize>(vector: [f64; N]) -> [f64; N] {
    let length = vector.iter().map(|x| x * x).sum::<f64>().sqrt();
    vector.map(|x| x / length.max(1.0))
}

/// Of unit length to rounding, so that a scene reads back the same.
fn unit(q: Quat) -> Quat {
    let length = |q: Quat| q.iter().map(|x| x * x).sum::<f64>().sqrt();
    let mut unit = q;
    for _ in 0..4 {
        let length = length(unit);
        if (length - 1.0).abs() < 1e-15 {
            break;
        }
        unit = unit.map(|x| x / length);
    }
    unit
}
