//! Which bodies are inside something.

use langevin_rigid::linalg::vector::{norm, sub};

use super::World;
use super::near::{Met, bounds};

/// Two that are inside each other.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error("body {body} is {:.3} mm inside {other}; place them apart", 1e3 * .depth)]
pub struct Overlap {
    /// Number of the body.
    pub body: usize,
    /// What it is in.
    pub other: String,
    /// How deep (m).
    pub depth: f64,
}

/// What is less deep than this is none, in radii of a body.
const SHALLOW: f64 = 1e-3;

impl World {
    /// The deepest overlap of a body with anything, if there is one of more than a thousandth of its radius.
    pub fn overlap(&self, body: usize) -> Option<Overlap> {
        let here = bounds(&self.members[body]);
        let mut met = self.obstacles_met(body, &here, 0.0);
        for other in (0..self.members.len()).filter(|other| *other != body) {
            if self.is_far(body, other) {
                continue;
            }
            met.extend(self.bodies_met((other.min(body), other.max(body)), 0.0));
        }
        let (depth, met) = met
            .iter()
            .map(|met| (depth(met), met))
            .max_by(|a, b| a.0.total_cmp(&b.0))?;
        (depth > SHALLOW * self.members[body].kind.shape().radius()).then(|| Overlap {
            body,
            other: match met.key.obstacle {
                Some(number) => format!("obstacle {number}"),
                None if met.key.a as usize == body => format!("body {}", met.key.b),
                None => format!("body {}", met.key.a),
            },
            depth,
        })
    }
}

impl World {
    /// Whether two bodies are farther apart than both reach.
    fn is_far(&self, a: usize, b: usize) -> bool {
        let (a, b) = (&self.members[a], &self.members[b]);
        let apart = norm(sub(a.state.position, b.state.position));
        apart > a.kind.shape().radius() + b.kind.shape().radius()
    }
}

fn depth(met: &Met) -> f64 {
    let gaps = met.patch.points.iter().map(|point| point.gap);
    -gaps.fold(f64::INFINITY, f64::min)
}
