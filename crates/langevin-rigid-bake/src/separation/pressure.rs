//! Steady drag from the pressure of potential flow, cut off where the flow separates.
//!
//! Pressure follows Bernoulli's equation on the windward side. Where potential flow would have
//! given back a part of its suction the boundary layer leaves the surface, and a base pressure holds
//! from there on. A bluff body, whose suction at separation exceeds what a wake sustains, has the
//! base pressure on all of its lee, and a wake that acts as an afterbody and slows the flow around it.

use langevin_rigid::linalg::{Mat3, Vec3, eigen_symmetric};

use super::panels::{Panel, Panels};
use crate::mesh::vector::{add, dot, scale, sub};

/// Constants of the model. All four are set to steady drag at Reynolds numbers of 1e3 to 1e5 and
/// are the same for all bodies.
mod constant {
    /// Share of the potential left by the wake of a bluff body. From 0.5 to 0.75 the Cd of
    /// a sphere goes from 0.63 to 0.52.
    pub(super) const WAKE_SHARE: f64 = 2.0 / 3.0;
    /// Base suction of a body whose silhouette is round: spheres and discs. At 0.45 the sphere's Cd
    /// is 0.59.
    pub(super) const ROUND_SUCTION: f64 = 0.4;
    /// Base suction of a two-dimensional body: a circular cylinder across the stream gets Cd 1.22.
    pub(super) const LONG_SUCTION: f64 = 1.1;
    /// Excess aspect ratio of the silhouette at which the base suction is half-way between: normal
    /// plates and cylinders of finite span.
    pub(super) const ASPECT_SCALE: f64 = 30.0;
    /// Share of the largest squared speed that is lost where the flow separates.
    pub(super) const RECOVERY: f64 = 0.2;
    /// Share of the surface that counts for the largest speed; the rest lies at edges, where
    /// it has no bound.
    pub(super) const QUANTILE: f64 = 0.995;
}
use constant::{ASPECT_SCALE, LONG_SUCTION, QUANTILE, RECOVERY, ROUND_SUCTION, WAKE_SHARE};

/// Steady pressure drag in one direction of motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PressureDrag {
    /// Drag coefficient on the silhouette; the mean of the motions to and fro. Zero where there is no
    /// silhouette, as of the middle of a lath that moves along itself.
    pub coefficient: f64,
    /// Area of the silhouette across the motion (m^2), half of sum |n . e| dA: of a body that is not
    /// convex, with the parts that hide behind others.
    pub silhouette: f64,
}

impl PressureDrag {
    /// Drag coefficient times silhouette (m^2).
    pub fn area(&self) -> f64 {
        self.coefficient * self.silhouette
    }
}

impl Panels {
    /// Drag of the motion along a unit vector.
    pub(super) fn drag(&self, direction: Vec3) -> PressureDrag {
        self.drag_of(direction, |_| 1.0)
    }

    /// Drag of what `share` of each panel takes.
    pub(super) fn drag_of(&self, direction: Vec3, share: impl Fn(&Panel) -> f64) -> PressureDrag {
        let wake = self.wake(direction);
        let term = |p: &Panel| {
            let facing = dot(p.normal, direction);
            let slip = p.squared_slip(direction, wake.share);
            let drop = wake.windward(slip) - wake.leeward(slip);
            (0.5 * facing.abs() * p.area * share(p), drop)
        };
        let (area, force) = self
            .0
            .iter()
            .map(term)
            .fold((0.0, 0.0), |(a, f), (da, drop)| (a + da, f + da * drop));
        PressureDrag {
            coefficient: if area > 0.0 { force / area } else { 0.0 },
            silhouette: area,
        }
    }

    fn wake(&self, direction: Vec3) -> Wake {
        let suction = base_suction(self.aspect(direction));
        let attached = separation_pressure(self.largest_slip(direction, 1.0));
        let bluffness = smoothstep(-attached / suction);
        let share = 1.0 - (1.0 - WAKE_SHARE) * bluffness;
        let largest_slip = self.largest_slip(direction, share);
        Wake {
            suction,
            bluffness,
            share,
            base: separation_pressure(largest_slip).max(-suction),
            separated_slip: (1.0 - RECOVERY) * largest_slip,
        }
    }

    /// The squared slip that all but a sliver of the surface stays below.
    fn largest_slip(&self, direction: Vec3, share: f64) -> f64 {
        let slip = |p: &Panel| (p.squared_slip(direction, share), p.area);
        let mut slips: Vec<(f64, f64)> = self.0.iter().map(slip).collect();
        slips.sort_by(|a, b| a.0.total_cmp(&b.0));
        let wanted = QUANTILE * slips.iter().map(|s| s.1).sum::<f64>();
        let mut below = 0.0;
        for (slip, area) in slips {
            below += area;
            if below >= wanted {
                return slip;
            }
        }
        0.0
    }

    /// Ratio of the silhouette's principal radii of gyration, at least 1.
    fn aspect(&self, direction: Vec3) -> f64 {
        let weight = |p: &Panel| dot(p.normal, direction).abs() * p.area / 3.0;
        let nodes = || {
            self.0
                .iter()
                .flat_map(|p| p.middles.map(|x| (weight(p), x)))
        };
        let (total, sum) = nodes().fold((0.0, [0.0; 3]), |(t, s), (w, x)| {
            (t + w, add(s, scale(w, x)))
        });
        let centre = scale(1.0 / total, sum);
        let mut moments: Mat3 = [[0.0; 3]; 3];
        for (w, x) in nodes() {
            let from_centre = sub(x, centre);
            let across = sub(from_centre, scale(dot(from_centre, direction), direction));
            for (row, a) in moments.iter_mut().zip(across) {
                for (m, b) in row.iter_mut().zip(across) {
                    *m += w * a * b;
                }
            }
        }
        // The least eigenvalue is the zero along the direction.
        let ([_, small, large], _) = eigen_symmetric(&moments);
        (large / small).sqrt().max(1.0)
    }
}

/// What the wake does to the pressure.
struct Wake {
    /// Base suction -Cpb.
    suction: f64,
    /// 0 for a streamlined body, 1 for a bluff one.
    bluffness: f64,
    /// Share of the potential that is left.
    share: f64,
    /// Pressure coefficient behind separation.
    base: f64,
    /// Squared slip at separation.
    separated_slip: f64,
}

impl Wake {
    fn windward(&self, squared_slip: f64) -> f64 {
        (1.0 - squared_slip).max(-self.suction)
    }

    /// Never above the windward pressure, so that drag has the right sign for every body.
    fn leeward(&self, squared_slip: f64) -> f64 {
        let windward = self.windward(squared_slip);
        // The lee of a streamlined body stays attached until it is slower than at separation.
        let attached = if squared_slip < self.separated_slip {
            self.base
        } else {
            windward
        };
        self.bluffness * self.base.min(windward) + (1.0 - self.bluffness) * attached
    }
}

fn base_suction(aspect: f64) -> f64 {
    ROUND_SUCTION + (LONG_SUCTION - ROUND_SUCTION) / (1.0 + ASPECT_SCALE / (aspect - 1.0))
}

/// Pressure coefficient at separation.
fn separation_pressure(largest_squared_slip: f64) -> f64 {
    1.0 - (1.0 - RECOVERY) * largest_squared_slip
}

fn smoothstep(x: f64) -> f64 {
    let t = x.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
