//! Where many falls end.

use std::ops::Range;

use langevin_rigid::linalg::vector::{add, norm};
use langevin_rigid_scenes::ensemble::{self, FallEnding};
use serde::Serialize;

use crate::session::Session;

/// The end of a fall.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Landing {
    /// Number of the run.
    pub run: u32,
    /// How it ended.
    pub ending: &'static str,
    /// Duration (s).
    pub time: f64,
    /// Where, world frame: x and z (m).
    pub place: [f64; 2],
    /// How far it came from the vertical through the release (m).
    pub distance: f64,
    /// How it fell: the class of its motion, if it can be told.
    pub motion: Option<&'static str>,
}

impl Session {
    /// The ends of some of the falls of the scene's ensemble, scattered as it says.
    pub fn landings(&self, runs: Range<u32>) -> Vec<Landing> {
        let release = self.prepared().scene().release.position;
        let falls = ensemble::run(self.prepared(), runs, &());
        let landing = |fall: ensemble::Fall| {
            let [x, _, z] = fall.end;
            let [place_x, _, place_z] = add(release, [x, 0.0, z]);
            let diverged = matches!(fall.ending, FallEnding::Diverged(_));
            let motion = (!diverged).then(|| fall.motion.motion().name());
            Landing {
                run: fall.run,
                ending: fall.ending.name(),
                time: fall.time,
                place: [place_x, place_z],
                distance: norm([x, 0.0, z]),
                motion,
            }
        };
        falls.into_iter().map(landing).collect()
    }
}
