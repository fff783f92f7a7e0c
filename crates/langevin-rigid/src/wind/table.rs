//! Velocities on a grid.

use std::sync::Arc;

use super::Local;
use crate::linalg::Vec3;

/// Velocities on a grid along the axes of the world, as a flow solver or a measurement has them; linear between its points and
/// times, and outside as on its nearest face.
///
/// ```
/// use langevin_rigid::wind::Table;
/// // Two points a metre apart along x.
/// let velocities = vec![[0.0; 3], [2.0, 0.0, 0.0]];
/// let table = Table::new([0.0; 3], [1.0; 3], [2, 1, 1], &[0.0], velocities)?;
/// assert_eq!(table.velocity([0.25, 0.0, 0.0], 0.0), [0.5, 0.0, 0.0]);
/// assert_eq!(table.velocity([9.0, 0.0, 0.0], 0.0), [2.0, 0.0, 0.0]);
/// # Ok::<(), langevin_rigid::wind::TableError>(())
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    origin: Vec3,
    spacing: Vec3,
    counts: [usize; 3],
    times: Arc<[f64]>,
    velocities: Arc<[Vec3]>,
}

/// Why numbers are no [`Table`].
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum TableError {
    /// There are no points along an axis, or no times.
    #[error(
        "the grid has no points along one of its axes or no times: {counts:?} points, {times} times"
    )]
    Empty {
        /// Points along x, y, z.
        counts: [usize; 3],
        /// Times.
        times: usize,
    },
    /// The points do not go with the axes.
    #[error(
        "{velocities} velocities are not those of a grid of {counts:?} points at {times} times"
    )]
    Count {
        /// Velocities given.
        velocities: usize,
        /// Points along x, y, z.
        counts: [usize; 3],
        /// Times.
        times: usize,
    },
    /// The spacing is none.
    #[error(
        "the spacing of the grid must be positive and its origin finite: {spacing:?} m from {origin:?} m"
    )]
    Grid {
        /// First point (m).
        origin: Vec3,
        /// Between neighbours (m).
        spacing: Vec3,
    },
    /// The times do not rise.
    #[error("the times of the grid must be finite and rise: number {0} does not")]
    Times(usize),
    /// A velocity is not finite.
    #[error("velocity number {index} of the grid is not finite: {velocity:?} m/s")]
    NotFinite {
        /// Its place in the list.
        index: usize,
        /// What it is (m/s).
        velocity: Vec3,
    },
}

impl Table {
    /// A grid of `counts` points along x, y and z, `spacing` (m) apart, the first at `origin` (m, world frame), with
    /// velocities (m/s, world frame) at `times` (s). In the list z runs fastest, then y, then x, then time.
    ///
    /// # Errors
    /// [`TableError`].
    pub fn new(
        origin: Vec3,
        spacing: Vec3,
        counts: [usize; 3],
        times: &[f64],
        velocities: Vec<Vec3>,
    ) -> Result<Self, TableError> {
        if counts.contains(&0) || times.is_empty() {
            let times = times.len();
            return Err(TableError::Empty { counts, times });
        }
        let points = counts
            .iter()
            .try_fold(times.len(), |n, &c| n.checked_mul(c));
        if points != Some(velocities.len()) {
            return Err(TableError::Count {
                velocities: velocities.len(),
                counts,
                times: times.len(),
            });
        }
        let spaced = spacing.iter().all(|x| *x > 0.0 && x.is_finite());
        if !(spaced && origin.iter().all(|x| x.is_finite())) {
            return Err(TableError::Grid { origin, spacing });
        }
        let rises = |n: &usize| times[*n].is_finite() && (*n == 0 || times[n - 1] < times[*n]);
        if let Some(n) = (0..times.len()).find(|n| !rises(n)) {
            return Err(TableError::Times(n));
        }
        let bad = |v: &Vec3| v.iter().any(|x| !x.is_finite());
        if let Some(index) = velocities.iter().position(bad) {
            let velocity = velocities[index];
            return Err(TableError::NotFinite { index, velocity });
        }
        Ok(Self {
            origin,
            spacing,
            counts,
            times: times.into(),
            velocities: velocities.into(),
        })
    }

    /// The velocity at a place (m, world frame) and a time (s).
    pub fn velocity(&self, position: Vec3, time: f64) -> Vec3 {
        self.at(position, time).velocity
    }

    pub(super) fn at(&self, position: Vec3, time: f64) -> Local<f64> {
        let axes: [Between; 3] = std::array::from_fn(|i| {
            let place = (position[i] - self.origin[i]) / self.spacing[i];
            Between::points(place, self.counts[i], 1.0 / self.spacing[i])
        });
        let moment = Between::times(time, &self.times);
        let mut local = Local::none(0.0);
        for t in [0, 1] {
            for corner in 0..8 {
                let side: [usize; 3] = std::array::from_fn(|i| (corner >> i) & 1);
                let at: [usize; 3] = std::array::from_fn(|i| axes[i].index[side[i]]);
                let velocity = self.stored(moment.index[t], at);
                let weight: [f64; 3] = std::array::from_fn(|i| axes[i].weight[side[i]]);
                let slope: [f64; 3] = std::array::from_fn(|i| axes[i].slope[side[i]]);
                let [x, y, z] = weight;
                let now = moment.weight[t];
                for i in 0..3 {
                    local.velocity[i] += now * x * y * z * velocity[i];
                    local.rate[i] += moment.slope[t] * x * y * z * velocity[i];
                    local.gradient[i][0] += now * slope[0] * y * z * velocity[i];
                    local.gradient[i][1] += now * x * slope[1] * z * velocity[i];
                    local.gradient[i][2] += now * x * y * slope[2] * velocity[i];
                }
            }
        }
        local
    }

    fn stored(&self, time: usize, [x, y, z]: [usize; 3]) -> Vec3 {
        let [nx, ny, nz] = self.counts;
        self.velocities[((time * nx + x) * ny + y) * nz + z]
    }
}

/// The two points around a place on an axis, with their weights and what these change by along it.
struct Between {
    index: [usize; 2],
    weight: [f64; 2],
    slope: [f64; 2],
}

impl Between {
    /// `place` in units of the spacing.
    fn points(place: f64, count: usize, per_spacing: f64) -> Self {
        let last = (count - 1) as f64;
        // Saturates, and takes what is no number as the first point.
        let low = (place.clamp(0.0, last) as usize).min(count.saturating_sub(2));
        let inside = place >= 0.0 && place <= last && count > 1;
        Self::new(
            [low, (low + 1).min(count - 1)],
            (place.clamp(0.0, last) - low as f64).min(1.0),
            if inside { per_spacing } else { 0.0 },
        )
    }

    fn times(time: f64, times: &[f64]) -> Self {
        let after = times.partition_point(|t| *t <= time);
        if after == 0 || after == times.len() {
            let index = after.min(times.len() - 1);
            return Self::new([index; 2], 0.0, 0.0);
        }
        let width = times[after] - times[after - 1];
        let part = (time - times[after - 1]) / width;
        Self::new([after - 1, after], part, 1.0 / width)
    }

    fn new(index: [usize; 2], part: f64, slope: f64) -> Self {
        Self {
            index,
            weight: [1.0 - part, part],
            slope: [-slope, slope],
        }
    }
}
