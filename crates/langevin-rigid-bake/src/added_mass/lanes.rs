//! Transcendental functions on four lanes.
//!
//! Only operations that IEEE 754 rounds correctly are used, so the bits are the same on every
//! processor; the library versions fuse multiplications where the target can.

use wide::bytemuck::cast;
use wide::{f64x4, u64x4};

/// Bits by which a mantissa in [1, 2) is moved to [sqrt(1/2), sqrt(2)).
const SQRT_HALF_BITS: u64 = 0x3fe6_a09e_667f_3bcd;
const ONE_BITS: u64 = 0x3ff0_0000_0000_0000;
const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
const TWO_52: f64 = 4_503_599_627_370_496.0;
const LN2_HI: f64 = 6.931_471_803_691_238e-1;
const LN2_LO: f64 = 1.908_214_929_270_587_7e-10;

/// Natural logarithm of positive normal numbers, to about one unit in the last place.
#[inline(always)]
pub(super) fn ln(x: f64x4) -> f64x4 {
    let shifted = cast::<f64x4, u64x4>(x) + u64x4::splat(ONE_BITS - SQRT_HALF_BITS);
    let exponent = cast::<u64x4, f64x4>((shifted >> 52) | u64x4::splat(TWO_52.to_bits()))
        - f64x4::splat(TWO_52 + 1023.0);
    let mantissa: f64x4 = cast((shifted & u64x4::splat(MANTISSA)) + u64x4::splat(SQRT_HALF_BITS));
    let f = mantissa - f64x4::ONE;
    let s = f / (f + f64x4::splat(2.0));
    let half_square = f64x4::HALF * f * f;
    s * (half_square + log_series(s * s)) + exponent * f64x4::splat(LN2_LO) - half_square
        + f
        + exponent * f64x4::splat(LN2_HI)
}

/// The minimax series of (ln(1+f) - 2 s) / s + ..., in z = s^2 (W. J. Cody's form, as in fdlibm).
#[inline(always)]
fn log_series(z: f64x4) -> f64x4 {
    let c = f64x4::splat;
    let w = z * z;
    let even = w
        * (c(3.999_999_999_940_942e-1)
            + w * (c(2.222_219_843_214_978_4e-1) + w * c(1.531_383_769_920_937_3e-1)));
    let odd = z
        * (c(6.666_666_666_666_735e-1)
            + w * (c(2.857_142_874_366_239e-1)
                + w * (c(1.818_357_216_161_805e-1) + w * c(1.479_819_860_511_658_6e-1))));
    even + odd
}

/// Angle in [0, pi] of the point (x, y) with y >= 0; 0 at the origin.
#[inline(always)]
pub(super) fn angle(y: f64x4, x: f64x4) -> f64x4 {
    let c = f64x4::splat;
    let ax = x.abs();
    let steep = y.simd_gt(ax);
    let large = steep.select(y, ax);
    let small = steep.select(ax, y);
    let reduce = small.simd_gt(large * c(0.414_213_562_373_095_1));
    let numerator = reduce.select(small - large, small);
    let denominator = reduce.select(small + large, large);
    let safe = denominator.simd_gt(f64x4::ZERO);
    let q = safe.select(numerator / denominator, f64x4::ZERO);
    let octant = atan_small(q) + reduce.select(f64x4::FRAC_PI_4, f64x4::ZERO);
    let quadrant = steep.select(f64x4::FRAC_PI_2 - octant, octant);
    x.simd_lt(f64x4::ZERO)
        .select(f64x4::PI - quadrant, quadrant)
}

/// Arc tangent for |q| <= tan(pi/8), rational approximation of the Cephes library (S. Moshier).
#[inline(always)]
fn atan_small(q: f64x4) -> f64x4 {
    let c = f64x4::splat;
    let z = q * q;
    let p = (((c(-8.750_608_600_031_904e-1) * z - c(16.157_537_187_333_652)) * z
        - c(75.008_557_923_147_05))
        * z
        - c(122.886_668_449_013_62))
        * z
        - c(64.850_219_049_420_25);
    let d = ((((z + c(24.858_464_901_423_062)) * z + c(165.027_009_831_698_85)) * z
        + c(432.881_060_491_291_3))
        * z
        + c(485.390_399_635_913_7))
        * z
        + c(194.550_657_148_261_4);
    q + q * z * (p / d)
}

/// Sum of the lanes in a fixed order.
#[inline(always)]
pub(super) fn sum(x: f64x4) -> f64 {
    let [a, b, c, d] = x.to_array();
    (a + b) + (c + d)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithm_agrees_with_the_scalar_one() {
        for k in 0..4000 {
            let x = libm::exp(f64::from(k - 2000) * 0.037) * (1.0 + f64::from(k) * 1e-5);
            let got = ln(f64x4::splat(x)).to_array()[2];
            let want = libm::log(x);
            assert!(
                (got - want).abs() <= 4e-16 * want.abs().max(0.25),
                "{x}: {got} {want}"
            );
        }
        assert_eq!(ln(f64x4::ONE).to_array(), [0.0; 4]);
    }

    #[test]
    fn angle_agrees_with_the_scalar_one() {
        for k in 0..=2000 {
            let t = f64::from(k) * std::f64::consts::PI / 2000.0;
            let (y, x) = (3.0 * libm::sin(t).abs(), 3.0 * libm::cos(t));
            let got = angle(f64x4::splat(y), f64x4::splat(x)).to_array()[1];
            assert!((got - libm::atan2(y, x)).abs() <= 1e-15, "{t}: {got}");
        }
        assert_eq!(angle(f64x4::ZERO, f64x4::ZERO).to_array(), [0.0; 4]);
    }
}
