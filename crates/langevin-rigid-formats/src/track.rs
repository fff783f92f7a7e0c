//! Where a body is at its recorded times, and at any time between them.

use libm::{atan2, sin};

/// Numbers beyond this many metres, seconds and their quotients are taken for a diverged simulation.
pub(crate) const FARTHEST: f64 = 1e12;

/// Half-angle (rad) below which the arc and its chord agree to rounding.
const STRAIGHT: f64 = 1e-7;

/// Where the body is at one time.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Pose {
    /// Time, s.
    pub time: f64,
    /// Position of the body frame's origin in the world frame (+y up), m.
    pub position: [f64; 3],
    /// Quaternion (x, y, z, w) that turns body coordinates into world coordinates; need not be of
    /// unit length.
    pub orientation: [f64; 4],
}

/// Why poses are no track.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TrackError {
    /// The trajectory is empty.
    #[error("the trajectory has no poses: give at least one")]
    NoPoses,
    /// A pose is not a finite placement: a diverged simulation, or a zero quaternion.
    #[error(
        "pose {index} is no placement: time {} s, position {:?} m, orientation {:?} (times \
         must be within 1e12 s, positions within 1e12 m, the quaternion finite and not zero); cut the trajectory before it",
        pose.time, pose.position, pose.orientation
    )]
    BadPose {
        /// Its place in the trajectory, from zero.
        index: usize,
        /// The pose as given.
        pose: Pose,
    },
    /// Time runs backward.
    #[error("pose {index} is earlier than the one before it: sort the poses by time")]
    TimeOrder {
        /// The later pose's place in the trajectory, from zero.
        index: usize,
    },
}

/// At least one pose, all finite, in time order.
#[derive(Clone, Copy, Debug)]
pub struct Track<'a> {
    poses: &'a [Pose],
}

impl<'a> Track<'a> {
    /// The track through `poses`.
    ///
    /// # Errors
    /// [`TrackError`] names the first pose that has no place in it.
    pub fn new(poses: &'a [Pose]) -> Result<Self, TrackError> {
        if poses.is_empty() {
            return Err(TrackError::NoPoses);
        }
        for (index, pose) in poses.iter().enumerate() {
            check(index, pose)?;
        }
        match poses.windows(2).position(|w| w[1].time < w[0].time) {
            Some(before) => Err(TrackError::TimeOrder { index: before + 1 }),
            None => Ok(Self { poses }),
        }
    }

    /// The poses it goes through.
    pub fn poses(&self) -> &'a [Pose] {
        self.poses
    }

    /// Time of the first pose (s).
    pub fn start(&self) -> f64 {
        self.poses[0].time
    }

    /// Time of the last pose (s).
    pub fn end(&self) -> f64 {
        self.poses[self.poses.len() - 1].time
    }

    /// The pose at `time` (s): position on the straight line, orientation (of unit length) on the shorter
    /// arc between its neighbours; held at the ends.
    ///
    /// ```
    /// use langevin_rigid_formats::track::{Pose, Track};
    /// let pose = |time, orientation| Pose { time, position: [time, 0.0, 0.0], orientation };
    /// let half_turn = [pose(0.0, [0.0, 0.0, 0.0, 1.0]), pose(1.0, [0.0, 1.0, 0.0, 0.0])];
    /// let third = Track::new(&half_turn)?.at(1.0 / 3.0);
    /// assert!((third.orientation[1] - 0.5).abs() < 1e-15); // turned by 60 degrees
    /// # Ok::<(), langevin_rigid_formats::track::TrackError>(())
    /// ```
    pub fn at(&self, time: f64) -> Pose {
        let after = self.poses.partition_point(|p| p.time <= time);
        let b = &self.poses[after.min(self.poses.len() - 1)];
        let a = &self.poses[after.saturating_sub(1)];
        let span = b.time - a.time;
        let part = if span > 0.0 {
            ((time - a.time) / span).clamp(0.0, 1.0)
        } else {
            0.0
        };
        Pose {
            time,
            position: line(a.position, b.position, part),
            orientation: arc(a.orientation, b.orientation, part),
        }
    }
}

fn check(index: usize, pose: &Pose) -> Result<(), TrackError> {
    let in_range = |v: &f64| v.abs() <= FARTHEST;
    let norm2 = pose.orientation.iter().map(|q| q * q).sum::<f64>();
    if in_range(&pose.time)
        && pose.position.iter().all(in_range)
        && norm2.is_normal()
        && pose.orientation.iter().all(|q| q.is_finite())
    {
        Ok(())
    } else {
        Err(TrackError::BadPose { index, pose: *pose })
    }
}

/// The point `part` of the way from `a` to `b`.
pub(crate) fn line(a: [f64; 3], b: [f64; 3], part: f64) -> [f64; 3] {
    std::array::from_fn(|i| a[i] + part * (b[i] - a[i]))
}

/// The orientation `part` of the way from `a` to `b` on the shorter arc (slerp), of unit length.
pub(crate) fn arc(a: [f64; 4], b: [f64; 4], part: f64) -> [f64; 4] {
    let a = unit(a);
    let b = nearer(a, unit(b));
    let angle = half_angle(a, b);
    let (of_a, of_b) = if angle < STRAIGHT {
        (1.0 - part, part)
    } else {
        (sin((1.0 - part) * angle), sin(part * angle))
    };
    unit(std::array::from_fn(|i| of_a * a[i] + of_b * b[i]))
}

/// Of `b` and -`b`, which are the same orientation, the one on the side of `a`.
pub(crate) fn nearer(a: [f64; 4], b: [f64; 4]) -> [f64; 4] {
    let cosine: f64 = a.iter().zip(&b).map(|(x, y)| x * y).sum();
    if cosine < 0.0 { b.map(|x| -x) } else { b }
}

/// Half the angle of the turn between two unit quaternions on the same side (rad).
fn half_angle(a: [f64; 4], b: [f64; 4]) -> f64 {
    let length = |sign: f64| {
        let parts = a.iter().zip(&b).map(|(x, y)| x + sign * y);
        parts.map(|x| x * x).sum::<f64>().sqrt()
    };
    2.0 * atan2(length(-1.0), length(1.0))
}

/// Angle of the shorter turn from one orientation to another, the first of unit length (rad).
pub(crate) fn turn(a: [f64; 4], b: [f64; 4]) -> f64 {
    2.0 * half_angle(a, nearer(a, unit(b)))
}

/// Not called with zero: the poses are checked, and the shorter arc misses the origin.
pub(crate) fn unit(q: [f64; 4]) -> [f64; 4] {
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
        // -q is the same rotation as q: the shorter arc must be taken all the same.
        let poses = [
            pose(0.0, 0.0, [0.0, 0.0, 0.0, 1.0]),
            pose(2.0, 4.0, [0.0, -0.5f64.sqrt(), 0.0, -0.5f64.sqrt()]),
        ];
        let middle = Track::new(&poses).unwrap().at(1.0);
        assert_eq!(middle.position, [2.0, 0.0, 0.0]);
        let eighth = std::f64::consts::FRAC_PI_8;
        assert!((middle.orientation[1].abs() - eighth.sin()).abs() < 1e-15);
        assert!((middle.orientation[3].abs() - eighth.cos()).abs() < 1e-15);
    }

    #[test]
    fn the_turn_is_even_in_time() {
        let wide = [
            pose(0.0, 0.0, [0.0, 0.0, 0.0, 1.0]),
            pose(1.0, 0.0, [0.8, 0.0, 0.0, 0.6]),
        ];
        let track = Track::new(&wide).unwrap();
        let whole = libm::asin(0.8);
        for part in [0.0, 0.1, 0.37, 0.5, 0.9, 1.0] {
            let found = libm::asin(track.at(part).orientation[0]);
            assert!((found - part * whole).abs() < 1e-14, "{found} at {part}");
        }
    }

    #[test]
    fn times_outside_hold_the_end_poses() {
        let poses = [
            pose(1.0, 5.0, [0.0, 0.0, 0.0, 2.0]),
            pose(1.0, 6.0, [0.0, 0.0, 0.0, 1.0]),
            pose(3.0, 7.0, [0.0, 0.0, 0.0, 1.0]),
        ];
        let track = Track::new(&poses).unwrap();
        assert_eq!(track.at(0.0).position[0], 5.0);
        assert_eq!(track.at(9.0).position[0], 7.0);
    }
}
