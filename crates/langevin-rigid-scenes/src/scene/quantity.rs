//! What the numbers of a scene may be.

use std::fmt::{self, Display, Formatter};

/// A kind of number: its unit, and the range in which bodies and fluids are looked for.
///
/// The ranges are far wider than any use and far narrower than what numbers hold, so that no product on
/// the way overflows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Kind {
    unit: &'static str,
    pub(super) least: f64,
    pub(super) most: f64,
}

impl Kind {
    const fn new(unit: &'static str, least: f64, most: f64) -> Self {
        Self { unit, least, most }
    }

    const fn either_way(unit: &'static str, most: f64) -> Self {
        Self::new(unit, -most, most)
    }

    pub(crate) fn includes(&self, x: f64) -> bool {
        (self.least..=self.most).contains(&x)
    }

    /// The key as messages name it: with its unit.
    pub(super) fn named(&self, key: &str) -> String {
        match self.unit {
            "" => format!("`{key}`"),
            unit => format!("`{key}` ({unit})"),
        }
    }
}

/// "between 0 and 1".
impl Display for Kind {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        write!(f, "between {} and {}", Short(self.least), Short(self.most))
    }
}

/// A number without rows of zeros.
pub(super) struct Short(pub(super) f64);

impl Display for Short {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match self.0 {
            x if x == 0.0 || (1e-3..1e5).contains(&x.abs()) || !x.is_finite() => write!(f, "{x}"),
            x => write!(f, "{x:e}"),
        }
    }
}

/// A dimension of a body, of a tank, of a cell.
pub(super) const SIZE: Kind = Kind::new("m", 1e-9, 1e6);
/// Half of it.
pub(super) const RADIUS: Kind = Kind::new("m", 5e-10, 5e5);
/// A dimension that there may be none of.
pub(super) const HOLE: Kind = Kind::new("m", 0.0, 1e6);
pub(super) const PLACE: Kind = Kind::either_way("m", 1e9);
pub(super) const DIRECTION: Kind = Kind::either_way("", 1e6);
pub(super) const UNIT: Kind = Kind::either_way("", 1.001);
pub(super) const ANGLE: Kind = Kind::either_way("degrees", 1e6);
pub(super) const SPEED: Kind = Kind::either_way("m/s", 1e6);
pub(super) const SPIN: Kind = Kind::either_way("rad/s", 1e6);
pub(super) const INFLOW: Kind = Kind::new("m/s", 1e-9, 1e6);
pub(super) const GRAVITY: Kind = Kind::either_way("m/s^2", 1e6);
pub(crate) const DENSITY: Kind = Kind::new("kg/m^3", 1e-9, 1e9);
/// Of a body, which may be without mass.
pub(super) const BODY_DENSITY: Kind = Kind::new("kg/m^3", 0.0, 1e9);
pub(crate) const VISCOSITY: Kind = Kind::new("kinematic, m^2/s", 1e-12, 1e12);
/// Of a body, which may be without.
pub(crate) const MASS: Kind = Kind::new("kg", 0.0, 1e30);
pub(super) const BALLAST_MASS: Kind = Kind::new("kg", 1e-30, 1e30);
pub(super) const INERTIA: Kind = Kind::either_way("kg m^2", 1e45);
pub(super) const TIME_STEP: Kind = Kind::new("s", 1e-12, 1e3);
pub(super) const DURATION: Kind = Kind::new("s", 1e-12, 1e6);
pub(super) const DELAY: Kind = Kind::new("s", 0.0, 1e6);
pub(super) const FRACTION: Kind = Kind::new("", 0.0, 1.0);
pub(super) const GAIN: Kind = Kind::new("", 0.0, 1e6);
/// A ratio that other numbers are divided by.
pub(crate) const POSITIVE: Kind = Kind::new("", 1e-6, 1e6);
/// Standard deviations of angle, angular velocity and velocity.
pub(super) const ANGLE_SCATTER: Kind = Kind::new("standard deviation, degrees", 0.0, 1e6);
pub(super) const SPIN_SCATTER: Kind = Kind::new("standard deviation, rad/s", 0.0, 1e6);
pub(super) const SPEED_SCATTER: Kind = Kind::new("standard deviation, m/s", 0.0, 1e6);
/// Those of a height, of a ratio and of a mass.
pub(super) const HEIGHT_SCATTER: Kind = Kind::new("standard deviation, m", 0.0, 1e9);
pub(super) const RATIO_SCATTER: Kind = Kind::new("standard deviation", 0.0, 1e6);
pub(super) const MASS_SCATTER: Kind = Kind::new("standard deviation, kg", 0.0, 1e30);
/// Of a fluctuating velocity.
pub(super) const DEVIATION: Kind = Kind::new("m/s", 0.0, 1e6);
/// Of a power law over the height.
pub(super) const EXPONENT: Kind = Kind::new("", 0.01, 1.0);
pub(super) const CIRCULATION: Kind = Kind::either_way("m^2/s", 1e9);
/// Of a control point of a force.
pub(super) const FORCE: Kind = Kind::either_way("N", 1e12);
/// A share of the weight.
pub(super) const SHARE: Kind = Kind::new("share of the weight", 1e-9, 100.0);
/// How far from the release what is free may be.
pub(super) const FREE_ANGLE: Kind = Kind::new("degrees", 0.0, 180.0);
pub(super) const FREE_SPIN: Kind = Kind::new("rad/s", 0.0, 1e6);
pub(super) const REYNOLDS: Kind = Kind::new("", 0.0, 1e30);
