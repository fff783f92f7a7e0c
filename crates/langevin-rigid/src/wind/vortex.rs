//! A vortex.

use super::{Local, WindError, about_line, decayed, finite, positive, unit};
use crate::elementary::exp;
use crate::linalg::{Vec3, cross, dot, lift};
use crate::real::Real;

/// A straight line about which the fluid turns, with a viscous core: the vortex of Lamb (1932) and Oseen (1911),
/// u = circulation/(2 pi r) (1 - exp(-r^2/core^2)).
///
/// It is fastest at 1.12 core radii: 0.102 circulation/core.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Vortex {
    /// A point on the line (m), world frame.
    pub centre: Vec3,
    /// Along the line, of any length: seen from its tip the fluid turns counter-clockwise.
    pub axis: Vec3,
    /// Circulation (m^2/s).
    pub circulation: f64,
    /// Radius of the core (m).
    pub core: f64,
}

const NAME: &str = "vortex";

impl Vortex {
    /// Checks it and gives its axis unit length.
    pub(super) fn make_ready(&mut self) -> Result<(), WindError> {
        finite(NAME, "centre", &self.centre)?;
        finite(NAME, "circulation", &[self.circulation])?;
        positive(NAME, "core", self.core)?;
        self.axis = unit(self.axis, NAME)?;
        Ok(())
    }

    #[inline(always)]
    pub(super) fn at<R: Real>(&self, position: &Vec3<R>) -> Local<R> {
        let like = position[0];
        let (_, away) = about_line(position, self.centre, self.axis);
        let axis = lift(like, &self.axis);
        let inverse = like.of(1.0 / (self.core * self.core));
        let z = dot(away, away) * inverse;
        let (value, slope) = decayed(z, exp(-z));
        let strength = inverse * like.of(self.circulation / std::f64::consts::TAU);
        let around = cross(axis, away);
        let mut local = Local::none(like);
        let [x, y, zz] = axis;
        let turn = [
            [like.of(0.0), -zz, y],
            [zz, like.of(0.0), -x],
            [-y, x, like.of(0.0)],
        ];
        for i in 0..3 {
            local.velocity[i] = strength * value * around[i];
            for j in 0..3 {
                local.gradient[i][j] = strength
                    * (value * turn[i][j] + slope * around[i] * inverse * (away[j] + away[j]));
            }
        }
        local
    }
}
