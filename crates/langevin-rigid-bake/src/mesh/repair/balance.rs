//! How much of a repaired body is the mesh that was given.

use super::Step;
use crate::mesh::{Leak, TriMesh, hull};

/// Share of the area that may be lost or made without a word.
const NOTABLE: f64 = 0.05;

/// Area lost and made in a repair, and how much of its convex hull the body fills.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Balance {
    /// Area of the triangles given, each once (m²).
    pub given: f64,
    /// What was dropped of it with whole components (m²).
    pub lost: f64,
    /// What was made to close it (m²).
    pub made: f64,
    /// Area of the body (m²).
    pub area: f64,
    /// Volume displaced by the body (m³).
    pub volume: f64,
    /// Volume of its convex hull (m³).
    pub hull: f64,
    /// Where a wrap encloses less than a coarser one.
    pub leak: Option<Leak>,
}

impl Balance {
    pub(super) fn new(given: f64, steps: &[Step], body: &TriMesh) -> Balance {
        let (mut lost, mut made, mut leaking) = (0.0, 0.0, None);
        for step in steps {
            match step {
                Step::Components { area, .. } => lost += area,
                Step::Filled { area, .. } => made += area,
                Step::Wrapped {
                    made: area, leak, ..
                } => {
                    made += area;
                    leaking = *leak;
                }
                _ => {}
            }
        }
        Balance {
            given,
            lost,
            made,
            area: body.surface_area(),
            volume: body.volume(),
            hull: hull::volume(body.vertices()),
            leak: leaking,
        }
    }

    /// Share of the area given that was dropped.
    pub fn lost_share(&self) -> f64 {
        share(self.lost, self.given)
    }

    /// Share of the body's area that was not given.
    pub fn made_share(&self) -> f64 {
        share(self.made, self.area)
    }

    /// Share of the convex hull that the body fills.
    pub fn hull_share(&self) -> f64 {
        share(self.volume, self.hull)
    }

    /// What the owner of the mesh should look at.
    pub fn warnings(&self) -> Vec<String> {
        let [lost, made] = [self.lost_share(), self.made_share()];
        let lost = (lost > NOTABLE).then(|| {
            format!(
                "{:.1} % of the area given was dropped with smaller components: is the body whole?",
                100.0 * lost
            )
        });
        let made = (made > NOTABLE).then(|| {
            format!(
                "{:.1} % of the body's surface was made to close holes: is it the shape of the thing?",
                100.0 * made
            )
        });
        let leak = self.leak.map(|leak| leak.to_string());
        [lost, made, leak].into_iter().flatten().collect()
    }
}

impl std::fmt::Display for Balance {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "kept {:.1} % of the area given, {:.1} % of the surface is made up; the volume is {:.1} % of the convex hull's",
            100.0 * (1.0 - self.lost_share()),
            100.0 * self.made_share(),
            100.0 * self.hull_share()
        )
    }
}

fn share(part: f64, whole: f64) -> f64 {
    if whole > 0.0 { part / whole } else { 0.0 }
}
