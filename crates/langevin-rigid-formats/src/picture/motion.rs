//! The motion to draw: checked poses, and the placement of the body at any time between them.

use langevin_rigid::linalg::rotation_matrix;

use super::vector::{Mat3, Vec3, add, mul_vec, scale, sub};
use super::{PictureError, Pose};

/// Coordinates beyond this many metres are taken for a diverged simulation.
const FARTHEST: f64 = 1e12;

/// Where the body is at one time: `world = position + rotation * body`.
#[derive(Clone, Copy, Debug)]
pub(super) struct Placement {
    pub position: Vec3,
    pub rotation: Mat3,
}

impl Placement {
    pub(super) fn to_world(self, body_point: Vec3) -> Vec3 {
        add(self.position, mul_vec(&self.rotation, body_point))
    }
}

/// At least one pose, all finite, in time order.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<'a> {
    poses: &'a [Pose],
}

impl<'a> Motion<'a> {
    pub(super) fn new(poses: &'a [Pose]) -> Result<Self, PictureError> {
        if poses.is_empty() {
            return Err(PictureError::NoPoses);
        }
        for (index, pose) in poses.iter().enumerate() {
            check(index, pose)?;
        }
        match poses.windows(2).position(|w| w[1].time < w[0].time) {
            Some(before) => Err(PictureError::TimeOrder { index: before + 1 }),
            None => Ok(Self { poses }),
        }
    }

    pub(super) fn poses(&self) -> &'a [Pose] {
        self.poses
    }

    pub(super) fn start(&self) -> f64 {
        self.poses[0].time
    }

    pub(super) fn end(&self) -> f64 {
        self.poses[self.poses.len() - 1].time
    }

    /// Position interpolated linearly, orientation along the shorter chord, held at the ends.
    pub(super) fn at(&self, time: f64) -> Placement {
        let after = self.poses.partition_point(|p| p.time <= time);
        let b = &self.poses[after.min(self.poses.len() - 1)];
        let a = &self.poses[after.saturating_sub(1)];
        let span = b.time - a.time;
        let w = if span > 0.0 {
            ((time - a.time) / span).clamp(0.0, 1.0)
        } else {
            0.0
        };
        Placement {
            position: add(a.position, scale(w, sub(b.position, a.position))),
            rotation: rotation_matrix(blend(a.orientation, b.orientation, w)),
        }
    }
}

fn check(index: usize, pose: &Pose) -> Result<(), PictureError> {
    let in_range = |v: &f64| v.abs() <= FARTHEST;
    let norm2 = pose.orientation.iter().map(|q| q * q).sum::<f64>();
    if pose.time.is_finite()
        && pose.position.iter().all(in_range)
        && norm2.is_normal()
        && pose.orientation.iter().all(|q| q.is_finite())
    {
        Ok(())
    } else {
        Err(PictureError::BadPose { index, pose: *pose })
    }
}

fn blend(a: [f64; 4], b: [f64; 4], w: f64) -> [f64; 4] {
    let (a, b) = (unit(a), unit(b));
    let cosine: f64 = a.iter().zip(&b).map(|(x, y)| x * y).sum();
    let sign = if cosine < 0.0 { -1.0 } else { 1.0 };
    unit(std::array::from_fn(|i| (1.0 - w) * a[i] + w * sign * b[i]))
}

/// Not called with zero: the poses are checked, and the shorter chord misses the origin.
fn unit(q: [f64; 4]) -> [f64; 4] {
    let norm = q.iter().map(|c| c * c).sum::<f64>().sqrt();
    q.map(|c| c / norm)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pose(time: f64, x: f64, orientation: [f64; 4]) -> Pose {
        Pose {
            time,
            position: [x, 0.0, 0.0],
            orientation,
        }
    }

    #[test]
    fn a_quarter_turn_about_y_is_halfway_to_a_half_turn() {
        // -q is the same rotation as q: the shorter chord must be taken all the same.
        let poses = [
            pose(0.0, 0.0, [0.0, 0.0, 0.0, 1.0]),
            pose(2.0, 4.0, [0.0, -0.5f64.sqrt(), 0.0, -0.5f64.sqrt()]),
        ];
        let motion = Motion::new(&poses).unwrap();
        let middle = motion.at(1.0);
        assert_eq!(middle.position, [2.0, 0.0, 0.0]);
        let c = 0.5f64.sqrt();
        let turned = middle.to_world([1.0, 0.0, 0.0]);
        for (got, want) in turned.iter().zip([2.0 + c, 0.0, -c]) {
            assert!((got - want).abs() < 1e-15, "{turned:?}");
        }
    }

    #[test]
    fn times_outside_hold_the_end_poses() {
        let poses = [
            pose(1.0, 5.0, [0.0, 0.0, 0.0, 2.0]),
            pose(1.0, 6.0, [0.0, 0.0, 0.0, 1.0]),
            pose(3.0, 7.0, [0.0, 0.0, 0.0, 1.0]),
        ];
        let motion = Motion::new(&poses).unwrap();
        assert_eq!(motion.at(0.0).position[0], 5.0);
        assert_eq!(motion.at(9.0).position[0], 7.0);
    }
}
