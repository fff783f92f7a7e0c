//! Wind that grows with height.

use super::{Local, WindError, finite, positive};
use crate::elementary::{exp, ln};
use crate::linalg::Vec3;
use crate::real::Real;

/// Wind over a ground, as it is in the lowest hundred metres: one direction, a speed that grows with height (world y).
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Shear {
    /// Velocity at `height` (m/s), world frame.
    pub velocity: Vec3,
    /// Height above the ground at which it is so fast (m).
    pub height: f64,
    /// World y of the ground (m). Below it there is no wind.
    pub ground: f64,
    /// How it grows.
    pub profile: Profile,
}

/// How wind grows with height over a ground.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
#[non_exhaustive]
pub enum Profile {
    /// With this power of the height: 1/7 over open land. Below a thousandth of the height of reference it goes to zero
    /// linearly, since the power's slope is infinite at the ground.
    Power {
        /// The power.
        exponent: f64,
    },
    /// With ln(1 + height/roughness).
    Log {
        /// Roughness length (m): a tenth to a thirtieth of the height of what stands on the ground; 0.03 in grass, 0.001 on
        /// a lawn or a floor.
        roughness: f64,
    },
}

/// Share of the height of reference below which a power law is linear.
const LINEAR: f64 = 1e-3;

impl Shear {
    pub(super) fn check(&self) -> Result<(), WindError> {
        const NAME: &str = "wind shear";
        finite(NAME, "velocity", &self.velocity)?;
        finite(NAME, "ground", &[self.ground])?;
        positive(NAME, "height", self.height)?;
        match self.profile {
            Profile::Power { exponent } => positive(NAME, "exponent", exponent),
            Profile::Log { roughness } => positive(NAME, "roughness", roughness),
        }
    }

    #[inline(always)]
    pub(super) fn at<R: Real>(&self, position: &Vec3<R>) -> Local<R> {
        let height = position[1] - position[1].of(self.ground);
        let (zero, one) = (height.of(0.0), height.of(1.0));
        let above = zero.less(height);
        let (share, slope) = match self.profile {
            Profile::Power { exponent } => {
                let share = height * height.of(1.0 / self.height);
                let low = share.of(LINEAR);
                let near = share.less(low);
                let value = exp(ln(share.max(low)) * share.of(exponent));
                let rise = R::choose(
                    near,
                    value / low,
                    height.of(exponent) * value / share.max(low),
                );
                (
                    R::choose(near, value * share / low, value),
                    rise * height.of(1.0 / self.height),
                )
            }
            Profile::Log { roughness } => {
                let share = one + height.max(zero) * height.of(1.0 / roughness);
                let scale = height.of(1.0 / ln(1.0 + self.height / roughness));
                (
                    ln(share) * scale,
                    scale * height.of(1.0 / roughness) / share,
                )
            }
        };
        let (share, slope) = (R::choose(above, share, zero), R::choose(above, slope, zero));
        let mut local = Local::none(height);
        for i in 0..3 {
            let velocity = height.of(self.velocity[i]);
            local.velocity[i] = share * velocity;
            local.gradient[i][1] = slope * velocity;
        }
        local
    }
}
