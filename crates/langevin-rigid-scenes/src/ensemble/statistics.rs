//! What the falls of an ensemble have in common.

use std::collections::BTreeMap;
use std::f64::consts::FRAC_1_SQRT_2;

use langevin_rigid::linalg::Vec3;
use serde::Serialize;

use super::fall::{Fall, FallEnding, SAMPLES_PER_SECOND};
use super::motion_class::MotionClass;

/// Statistics of an ensemble's falls; falls that diverged are left out of all of them.
///
/// Lengths are measured from the scene's release point, depth downwards. Standard deviations are
/// those of a sample (n - 1), about its mean; one fall has none, and its zero says nothing.
///
/// The columns against time are over the falls that are still under way at that time, and stop where
/// fewer than half are: the last drops in the water are not like all drops.
#[derive(Debug, Clone, PartialEq, Default, Serialize)]
pub struct Statistics {
    /// Times: whole sixtieths of a second (s).
    pub t: Vec<f64>,
    /// Falls under way at each time.
    pub falling: Vec<usize>,
    /// Mean depth of the centre of mass (m).
    pub depth_mean: Vec<f64>,
    /// Standard deviation of the depth (m).
    pub depth_std: Vec<f64>,
    /// Standard deviation along x (m).
    pub x_std: Vec<f64>,
    /// Standard deviation along z (m).
    pub z_std: Vec<f64>,
    /// Falls that reached the ground.
    pub landed: usize,
    /// Standard deviation of the landing points along x (m).
    pub landing_sigma_x: Option<f64>,
    /// Standard deviation of the landing points along z (m).
    pub landing_sigma_z: Option<f64>,
    /// Median horizontal distance of the landing points from the release point (m).
    pub median_landing_distance: Option<f64>,
    /// How the bodies that came to rest lie.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub faces: Option<Faces>,
    /// Number of falls of each [`MotionClass`].
    pub motions: BTreeMap<MotionClass, usize>,
}

/// How bodies lie.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize)]
pub struct Faces {
    /// The side of the thin axis up.
    pub up: usize,
    /// The other side up.
    pub down: usize,
    /// Steeper than 45 degrees: on the edge, or leaning.
    pub edge: usize,
}

/// The face that is up where the thin axis has this vertical component: `up`, `down`, or `edge` of a body that is steeper
/// than 45 degrees.
pub(super) fn face(up: f64) -> &'static str {
    match up {
        up if up > FRAC_1_SQRT_2 => "up",
        up if up < -FRAC_1_SQRT_2 => "down",
        _ => "edge",
    }
}

impl Faces {
    fn of(falls: &[&Fall]) -> Option<Self> {
        let lying = falls.iter().filter_map(|fall| fall.lying);
        lying.fold(None, |faces, lying| {
            let mut faces: Self = faces.unwrap_or_default();
            match face(lying.up) {
                "up" => faces.up += 1,
                "down" => faces.down += 1,
                _ => faces.edge += 1,
            }
            Some(faces)
        })
    }
}

impl Statistics {
    /// Of these falls.
    pub fn new(falls: &[Fall]) -> Self {
        let good: Vec<&Fall> = falls
            .iter()
            .filter(|f| !matches!(f.ending, FallEnding::Diverged(_)))
            .collect();
        let mut motions: BTreeMap<MotionClass, usize> = MotionClass::ALL.map(|m| (m, 0)).into();
        for fall in &good {
            *motions.entry(fall.motion.motion()).or_default() += 1;
        }
        let mut statistics = Self {
            faces: Faces::of(&good),
            motions,
            ..Self::default()
        };
        statistics.follow(&good);
        statistics.land(&good);
        statistics
    }

    fn follow(&mut self, falls: &[&Fall]) {
        for sample in 0.. {
            let points: Vec<Vec3> = falls
                .iter()
                .filter_map(|f| f.samples.get(sample).copied())
                .collect();
            if points.is_empty() || 2 * points.len() < falls.len() {
                return;
            }
            let along = |i: usize| mean_and_deviation(&points, |p| p[i]);
            let (depth_mean, depth_std) = along(1);
            self.t.push(sample as f64 / f64::from(SAMPLES_PER_SECOND));
            self.falling.push(points.len());
            self.depth_mean.push(depth_mean);
            self.depth_std.push(depth_std);
            self.x_std.push(along(0).1);
            self.z_std.push(along(2).1);
        }
    }

    fn land(&mut self, falls: &[&Fall]) {
        let points: Vec<Vec3> = falls
            .iter()
            .filter(|f| f.ending == FallEnding::Ground)
            .map(|f| f.end)
            .collect();
        self.landed = points.len();
        if points.is_empty() {
            return;
        }
        self.landing_sigma_x = Some(mean_and_deviation(&points, |p| p[0]).1);
        self.landing_sigma_z = Some(mean_and_deviation(&points, |p| p[2]).1);
        let distances = points.iter().map(|p| (p[0] * p[0] + p[2] * p[2]).sqrt());
        self.median_landing_distance = Some(median(distances.collect()));
    }
}

/// Mean and standard deviation of a sample that is not empty.
fn mean_and_deviation(points: &[Vec3], value: impl Fn(&Vec3) -> f64) -> (f64, f64) {
    let n = points.len() as f64;
    // Deviations from the first value: equal values have a spread of exactly zero.
    let first = value(&points[0]);
    let mean = points.iter().map(|p| value(p) - first).sum::<f64>() / n;
    let squares: f64 = points
        .iter()
        .map(|p| {
            let deviation = value(p) - first - mean;
            deviation * deviation
        })
        .sum();
    (first + mean, (squares / (n - 1.0).max(1.0)).sqrt())
}

/// Of a sample that is not empty.
fn median(mut values: Vec<f64>) -> f64 {
    values.sort_by(f64::total_cmp);
    let middle = values.len() / 2;
    match values.len() % 2 {
        0 => 0.5 * (values[middle - 1] + values[middle]),
        _ => values[middle],
    }
}
