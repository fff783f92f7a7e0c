//! Steady drag from the pressure of potential flow, cut off where the flow separates: the model of
//! [`Wake`] on the panels of a surface.

use langevin_rigid::linalg::{Mat3, Vec3, eigen_symmetric};
use langevin_rigid::{SLIP_QUANTILE, Wake};

use super::panels::{Panel, Panels};
use crate::mesh::vector::{add, dot, scale, sub};

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
            let slip = p.squared_slip(direction, wake.potential_share());
            let drop = wake.pressure_drop(slip);
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
        Wake::new(self.aspect(direction), |share| {
            self.largest_slip(direction, share)
        })
    }

    /// The squared slip that all but a sliver of the surface stays below.
    fn largest_slip(&self, direction: Vec3, share: f64) -> f64 {
        let slip = |p: &Panel| (p.squared_slip(direction, share), p.area);
        let mut slips: Vec<(f64, f64)> = self.0.iter().map(slip).collect();
        slips.sort_by(|a, b| a.0.total_cmp(&b.0));
        let wanted = SLIP_QUANTILE * slips.iter().map(|s| s.1).sum::<f64>();
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
