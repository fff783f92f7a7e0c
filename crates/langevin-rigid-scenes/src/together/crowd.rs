//! Where and when the bodies of a crowd are let go.

use std::f64::consts::TAU;

use langevin_rigid::linalg::{Quat, Vec3};
use langevin_rigid::{NoiseStream, State};

use super::Release;
use crate::ensemble::{scattered_release, uniform};
use crate::scene::{Crowd, Scene};

/// A step that no run ever takes, beside that of the scatter: its normals are free.
const CROWD_STEP: u64 = u64::MAX - 1;

/// The releases of a crowd, in the order of their times. Each is a pure function of seed and number.
pub(super) fn releases(scene: &Scene, crowd: &Crowd) -> Vec<Release> {
    (0..crowd.count)
        .map(|number| release(scene, crowd, number))
        .collect()
}

/// A release of the scene's body anywhere in a box around the scene's, with sides `over` (m), any way round: a pure function
/// of the scene's seed and `number`.
pub fn anywhere(scene: &Scene, over: Vec3, number: u32) -> State {
    let crowd = Crowd {
        count: 1,
        over,
        during: 0.0,
        any_orientation: true,
        sizes: [1.0; 2],
        kinds: Vec::new(),
    };
    release(scene, &crowd, number).state
}

fn release(scene: &Scene, crowd: &Crowd, number: u32) -> Release {
    let stream = NoiseStream {
        seed: scene.seed,
        body: number,
    };
    let [x, y, z, a, b, c, size, kind, time, ..] = stream.normals(CROWD_STEP).map(uniform);
    let mut state = scattered_release(scene, number);
    for ((position, side), share) in state.position.iter_mut().zip(crowd.over).zip([x, y, z]) {
        *position += side * (share - 0.5);
    }
    if crowd.any_orientation {
        let (velocity, spin) = (state.world_velocity(), state.world_angular_velocity());
        state.orientation = any_orientation([a, b, c]);
        state.set_world_velocities(velocity, spin);
    }
    let [least, most] = crowd.sizes;
    Release {
        time: crowd.during * (f64::from(number) + time) / f64::from(crowd.count),
        kind: choose_kind(crowd, kind),
        scale: least + (most - least) * size,
        state,
    }
}

/// Any as likely as any other (Shoemake 1992).
fn any_orientation([a, b, c]: [f64; 3]) -> Quat {
    let ((s1, c1), (s2, c2)) = (libm::sincos(TAU * b), libm::sincos(TAU * c));
    let (first, second) = ((1.0 - a).sqrt(), a.sqrt());
    [first * s1, first * c1, second * s2, second * c2]
}

/// The scene's own body is 0, those of the crowd's kinds follow.
fn choose_kind(crowd: &Crowd, share: f64) -> usize {
    let whole: f64 = 1.0 + crowd.kinds.iter().map(|kind| kind.share).sum::<f64>();
    let mut left = share * whole - 1.0;
    for (number, kind) in crowd.kinds.iter().enumerate() {
        if left < 0.0 {
            return number;
        }
        left -= kind.share;
    }
    crowd.kinds.len()
}
