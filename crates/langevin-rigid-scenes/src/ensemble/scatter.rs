//! How the releases of an ensemble differ.

use langevin_rigid::linalg::{Quat, Vec3, quat_from_rotation_vector};
use langevin_rigid::{NoiseStream, State};

use crate::scene::{Scatter, Scene};

/// A step that no run ever takes: its normals are free for the release.
const RELEASE_STEP: u64 = u64::MAX;

/// The release of run `run`: the scene's, with its scatter.
///
/// The orientation is turned in the world by a rotation vector in the horizontal plane, so that the
/// body's normal tips about the world's x and z; the velocities get their deviations in the world
/// frame. A pure function of the scene's seed and the run, independent of the noise of the steps.
pub fn scattered_release(scene: &Scene, run: u32) -> State {
    let Scatter {
        tilt,
        spin,
        velocity,
    } = scene.scatter;
    if scene.scatter == Scatter::default() {
        return scene.release;
    }
    let stream = NoiseStream {
        seed: scene.seed,
        body: run,
    };
    let [a, b, sx, sy, sz, vx, vy, vz, ..] = stream.normals(RELEASE_STEP);
    let tilt = tilt.to_radians();
    let turn = quat_from_rotation_vector([tilt * a, 0.0, tilt * b]);
    let mut state = scene.release;
    state.orientation = product(turn, scene.release.orientation);
    state.set_world_velocities(
        scattered(scene.release.world_velocity(), velocity, [vx, vy, vz]),
        scattered(scene.release.world_angular_velocity(), spin, [sx, sy, sz]),
    );
    state
}

fn scattered(mean: Vec3, deviation: f64, normals: Vec3) -> Vec3 {
    std::array::from_fn(|i| mean[i] + deviation * normals[i])
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
