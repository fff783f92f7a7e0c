//! Where a field is.

use super::{WindError, finite, positive};
use crate::linalg::{Vec3, dot, lift, scale, sub};
use crate::real::Real;

/// A part of space with a soft edge: outside it a field is zero, inside whole, and in the edge it goes from one to the
/// other as 3 q^2 - 2 q^3.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Region {
    /// A box along the axes of the world.
    Box {
        /// Its middle (m).
        centre: Vec3,
        /// Its size along x, y and z (m).
        size: Vec3,
        /// Thickness of the edge, inwards (m).
        edge: f64,
    },
    /// A ball.
    Sphere {
        /// Its middle (m).
        centre: Vec3,
        /// Its radius (m).
        radius: f64,
        /// Thickness of the edge, inwards (m).
        edge: f64,
    },
}

const NAME: &str = "region of a wind";

impl Region {
    pub(super) fn check(&self) -> Result<(), WindError> {
        let (centre, edge) = match self {
            Self::Box { centre, size, edge } => {
                for &size in size {
                    positive(NAME, "size", size)?;
                }
                (centre, edge)
            }
            Self::Sphere {
                centre,
                radius,
                edge,
            } => {
                positive(NAME, "radius", *radius)?;
                (centre, edge)
            }
        };
        finite(NAME, "centre", centre)?;
        positive(NAME, "edge", *edge)
    }

    /// Share of a field that is here, and its gradient (1/m).
    #[inline(always)]
    pub(super) fn weight<R: Real>(&self, position: &Vec3<R>) -> (R, Vec3<R>) {
        let like = position[0];
        match self {
            Self::Box { centre, size, edge } => {
                let away = sub(*position, lift(like, centre));
                let (x, dx) = across(away[0], size[0], *edge);
                let (y, dy) = across(away[1], size[1], *edge);
                let (z, dz) = across(away[2], size[2], *edge);
                (x * y * z, [dx * y * z, x * dy * z, x * y * dz])
            }
            Self::Sphere {
                centre,
                radius,
                edge,
            } => {
                let away = sub(*position, lift(like, centre));
                let r = dot(away, away).sqrt();
                let (weight, slope) = step(like.of(*radius) - r, *edge);
                let inwards = -slope / r.max(like.of(1e-300));
                (weight, scale(inwards, away))
            }
        }
    }
}

/// The weight of a slab of thickness `size`, and its derivative, so far from its middle.
#[inline(always)]
fn across<R: Real>(away: R, size: f64, edge: f64) -> (R, R) {
    let (weight, slope) = step(away.of(0.5 * size) - away.abs(), edge);
    (weight, R::choose(away.less(away.of(0.0)), slope, -slope))
}

/// From 0 outside to 1 at the depth `edge`, and its derivative.
#[inline(always)]
fn step<R: Real>(depth: R, edge: f64) -> (R, R) {
    let (zero, one) = (depth.of(0.0), depth.of(1.0));
    let q = (depth * depth.of(1.0 / edge)).max(zero).min(one);
    (
        q * q * (depth.of(3.0) - q - q),
        depth.of(6.0 / edge) * q * (one - q),
    )
}
