//! What a fan blows.

use super::{Local, WindError, about_line, decayed, finite, positive, unit};
use crate::elementary::exp;
use crate::linalg::{Vec3, dot, lift};
use crate::real::Real;

/// The mean flow of a round jet, as from a fan: it spreads as turbulent jets do and draws in the air around it.
///
/// The velocity along the axis is Gaussian over the radius, of 1/e-width b with b^2 = diameter^2/2 + (0.113 s)^2 a way s
/// downstream (half-width .094 s: Hussein, Capp & George 1994), and keeps its momentum: far off the centre has
/// 6.3 diameters/s of the speed. Upstream the fluid comes from a widening funnel. Across the axis it is what
/// continuity wants, so the field has no divergence.
#[derive(Debug, Clone, Copy, PartialEq)]
#[cfg_attr(feature = "serde", derive(serde::Serialize, serde::Deserialize))]
pub struct Jet {
    /// Middle of the fan (m), world frame.
    pub centre: Vec3,
    /// Where it blows, of any length.
    pub axis: Vec3,
    /// Speed in the middle of the fan (m/s).
    pub speed: f64,
    /// Diameter of the fan (m).
    pub diameter: f64,
}

const NAME: &str = "jet";
/// Growth of the width along the way, downstream and upstream.
const SPREAD: [f64; 2] = [0.113, 1.0];

impl Jet {
    /// Checks it and gives its axis unit length.
    pub(super) fn make_ready(&mut self) -> Result<(), WindError> {
        finite(NAME, "centre", &self.centre)?;
        finite(NAME, "speed", &[self.speed])?;
        positive(NAME, "diameter", self.diameter)?;
        self.axis = unit(self.axis, NAME)?;
        Ok(())
    }

    /// From Stokes' stream function psi = m (1 - exp(-r^2/b^2)), with m in proportion to b downstream and constant upstream.
    #[inline(always)]
    pub(super) fn at<R: Real>(&self, position: &Vec3<R>) -> Local<R> {
        let like = position[0];
        let (s, away) = about_line(position, self.centre, self.axis);
        let axis = lift(like, &self.axis);
        let r2 = dot(away, away);
        let (zero, two) = (like.of(0.0), like.of(2.0));
        let upstream = s.less(zero);
        let spread = R::choose(
            upstream,
            like.of(SPREAD[1] * SPREAD[1]),
            like.of(SPREAD[0] * SPREAD[0]),
        );
        // b^2 and its first and second derivative along s.
        let wide = like.of(0.5 * self.diameter * self.diameter) + spread * s * s;
        let wide_s = two * spread * s;
        let wide_ss = two * spread;
        let b = wide.sqrt();
        let b_s = spread * s / b;
        // The same of m.
        let flux = like.of(self.speed * self.diameter / libm::sqrt(8.0));
        let m = R::choose(
            upstream,
            flux * like.of(self.diameter / libm::sqrt(2.0)),
            flux * b,
        );
        let m_s = R::choose(upstream, zero, flux * b_s);
        let m_ss = R::choose(upstream, zero, flux * (spread - b_s * b_s) / b);

        let inverse = like.of(1.0) / wide;
        let z = r2 * inverse;
        let e = exp(-z);
        let (f, f_z) = decayed(z, e);
        // Relative growth of b^2.
        let g = wide_s * inverse;
        // Along the axis, and across it over the radius, with their derivatives along s and by r^2.
        let along = two * m * inverse * e;
        let along_s = two * inverse * e * (m_s - m * g + m * g * z);
        let along_q = -(along * inverse);
        let across = inverse * (m * e * g - m_s * f);
        let across_q = -(inverse * inverse * (m_s * f_z + m * e * g));
        let across_s = inverse
            * (m_s * g * (f + f_z * z + e) - m_ss * f
                + m * e * (g * g * z + wide_ss * inverse - two * g * g));
        let mut local = Local::none(like);
        for i in 0..3 {
            local.velocity[i] = along * axis[i] + across * away[i];
            for j in 0..3 {
                let mut slope = axis[i] * (along_s * axis[j] + along_q * (away[j] + away[j]))
                    + away[i] * (across_s * axis[j] + across_q * (away[j] + away[j]))
                    - across * axis[i] * axis[j];
                if i == j {
                    slope = slope + across;
                }
                local.gradient[i][j] = slope;
            }
        }
        local
    }
}
