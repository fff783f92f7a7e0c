//! How far a fall is from what is asked.

use langevin_rigid::State;
use langevin_rigid::linalg::vector::{add, dot, norm, scale, sub};

use super::DirectError;
use super::glimpses::{Glimpse, Glimpses};
use super::motion::{self, Motion};
use super::path::DrawnPath;
use crate::ensemble::FallEnding;
use crate::prepared::Prepared;
use crate::scene::{Direct, Landing, Ring, Side};

/// What is asked of a fall, made ready.
pub(super) struct Asks {
    land: Option<Landing>,
    rings: Vec<Ring>,
    motion: Vec<Motion>,
    path: Option<DrawnPath>,
    ground: f64,
    /// Largest half extent of the body (m).
    size: f64,
}

/// By how much a fall misses what is asked: zero if it does it.
pub(super) fn score(misses: &[f64]) -> f64 {
    misses.iter().map(|miss| (miss - 1.0).max(0.0)).sum()
}

impl Asks {
    pub(super) fn new(prepared: &Prepared, direct: &Direct) -> Result<Self, DirectError> {
        Ok(Self {
            land: direct.land,
            rings: direct.rings.clone(),
            motion: direct.motion.clone(),
            path: direct.path.as_ref().map(DrawnPath::read).transpose()?,
            ground: prepared.scene().stop.ground.unwrap_or(0.0),
            size: prepared.body().half_extents[0],
        })
    }

    /// What is asked, in the order of the misses.
    pub(super) fn names(&self) -> Vec<String> {
        let mut names = Vec::new();
        if let Some(land) = &self.land {
            names.extend(land.at.map(|_| "place".to_owned()));
            names.extend(land.time.map(|_| "time".to_owned()));
            names.extend(land.side.map(|_| "side".to_owned()));
        }
        names.extend((1..=self.rings.len()).map(|number| format!("ring {number}")));
        names.extend((!self.motion.is_empty()).then(|| "motion".to_owned()));
        names.extend(self.path.as_ref().map(|_| "path".to_owned()));
        names
    }

    /// How far a fall is from each, in units of the tolerance.
    pub(super) fn misses(
        &self,
        mut glimpses: Glimpses,
        last: &State,
        ending: &FallEnding,
    ) -> Vec<f64> {
        let end = glimpses.of(last);
        if glimpses
            .seen
            .last()
            .is_some_and(|seen| seen.time < end.time)
        {
            glimpses.seen.push(end);
        }
        let seen = &glimpses.seen;
        let mut misses = Vec::new();
        if let Some(land) = &self.land {
            self.landing(land, &end, *ending == FallEnding::Ground, &mut misses);
        }
        misses.extend(self.rings.iter().map(|ring| through(ring, seen)));
        if !self.motion.is_empty() {
            misses.push(motion::miss(&self.motion, seen, self.size));
        }
        misses.extend(self.path.as_ref().map(|path| path.miss(seen)));
        misses
    }

    fn landing(&self, land: &Landing, end: &Glimpse, landed: bool, misses: &mut Vec<f64>) {
        // What has not landed misses by its height as well, and by one.
        let above = match landed {
            true => 0.0,
            false => (end.position[1] - self.ground).max(0.0),
        };
        let late = if landed { 0.0 } else { 1.0 };
        if let Some((at, within)) = land.at {
            let away = [end.position[0] - at[0], above, end.position[2] - at[2]];
            misses.push(late + norm(away) / within);
        }
        if let Some((time, within)) = land.time {
            misses.push(late + (end.time - time).abs() / within);
        }
        if let Some(side) = land.side {
            let up = match side {
                Side::Up => end.axis[1],
                Side::Down => -end.axis[1],
            };
            misses.push(late + 1.0 - up);
        }
    }
}

/// Distance from the axis of a ring where the path passes its plane, in radii; for a path that does not pass it, one more
/// than its distance from the centre.
fn through(ring: &Ring, seen: &[Glimpse]) -> f64 {
    let from_centre = |glimpse: &Glimpse| sub(glimpse.position, ring.centre);
    let passed = seen.windows(2).filter_map(|pair| {
        let [from, to] = [&pair[0], &pair[1]].map(from_centre);
        let [before, after] = [from, to].map(|place| dot(place, ring.normal));
        if (before < 0.0) == (after < 0.0) {
            return None;
        }
        let part = before / (before - after);
        Some(norm(add(from, scale(part, sub(to, from)))))
    });
    let nearest = passed.fold(f64::INFINITY, f64::min);
    if nearest.is_finite() {
        return nearest / ring.radius;
    }
    let away = seen.iter().map(|glimpse| norm(from_centre(glimpse)));
    1.0 + away.fold(f64::INFINITY, f64::min) / ring.radius
}
