//! Transcendental functions on four lanes.
//!
//! Only operations that IEEE 754 rounds correctly are used, so the bits are the same on every
//! processor; the library versions fuse multiplications where the target can.

use fearless_simd::{Bytes, ExtractToken, Select, Simd, SimdBase, f64x4, u64x4};

/// Bits by which a mantissa in [1, 2) is moved to [sqrt(1/2), sqrt(2)).
const SQRT_HALF_BITS: u64 = 0x3fe6_a09e_667f_3bcd;
const ONE_BITS: u64 = 0x3ff0_0000_0000_0000;
const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
const TWO_52: f64 = 4_503_599_627_370_496.0;
const LN2_HI: f64 = 6.931_471_803_691_238e-1;
const LN2_LO: f64 = 1.908_214_929_270_587_7e-10;

/// Natural logarithm of positive normal numbers, to about one unit in the last place.
#[inline(always)]
pub(super) fn ln<S: Simd>(x: f64x4<S>) -> f64x4<S> {
    let shifted = x.bitcast::<u64x4<S>>() + (ONE_BITS - SQRT_HALF_BITS);
    let exponent = ((shifted >> 52) | TWO_52.to_bits()).bitcast::<f64x4<S>>() - (TWO_52 + 1023.0);
    let mantissa = ((shifted & MANTISSA) + SQRT_HALF_BITS).bitcast::<f64x4<S>>();
    let f = mantissa - 1.0;
    let s = f / (f + 2.0);
    let half_square = f * 0.5 * f;
    s * (half_square + log_series(s * s)) + exponent * LN2_LO - half_square + f + exponent * LN2_HI
}

/// The minimax series of (ln(1+f) - 2 s) / s + ..., in z = s^2 (W. J. Cody's form, as in fdlibm).
#[inline(always)]
fn log_series<S: Simd>(z: f64x4<S>) -> f64x4<S> {
    let c = constants(z);
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
pub(super) fn angle<S: Simd>(y: f64x4<S>, x: f64x4<S>) -> f64x4<S> {
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_4, PI};
    let c = constants(x);
    let ax = x.abs();
    let steep = y.simd_gt(ax);
    let large = steep.select(y, ax);
    let small = steep.select(ax, y);
    let reduce = small.simd_gt(large * c(0.414_213_562_373_095_1));
    let numerator = reduce.select(small - large, small);
    let denominator = reduce.select(small + large, large);
    let safe = denominator.simd_gt(c(0.0));
    let q = safe.select(numerator / denominator, c(0.0));
    let octant = atan_small(q) + reduce.select(c(FRAC_PI_4), c(0.0));
    let quadrant = steep.select(c(FRAC_PI_2) - octant, octant);
    x.simd_lt(c(0.0)).select(c(PI) - quadrant, quadrant)
}

/// Arc tangent for |q| <= tan(pi/8), rational approximation of the Cephes library (S. Moshier).
#[inline(always)]
fn atan_small<S: Simd>(q: f64x4<S>) -> f64x4<S> {
    let c = constants(q);
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
pub(super) fn sum([a, b, c, d]: [f64; 4]) -> f64 {
    (a + b) + (c + d)
}

/// A constant in the lanes of `like`.
#[inline(always)]
fn constants<S: Simd>(like: f64x4<S>) -> impl Fn(f64) -> f64x4<S> {
    let simd = like.token();
    move |value| f64x4::splat(simd, value)
}

#[cfg(test)]
mod tests {
    use super::*;
    use fearless_simd::{Level, dispatch};

    fn ln_of(x: f64) -> [f64; 4] {
        dispatch!(Level::new(), simd => ln(f64x4::splat(simd, x)).into())
    }

    fn angle_of(y: f64, x: f64) -> [f64; 4] {
        dispatch!(Level::new(), simd => angle(f64x4::splat(simd, y), f64x4::splat(simd, x)).into())
    }

    #[test]
    fn logarithm_agrees_with_the_scalar_one() {
        for k in 0..4000 {
            let x = libm::exp(f64::from(k - 2000) * 0.037) * (1.0 + f64::from(k) * 1e-5);
            let got = ln_of(x)[2];
            let want = libm::log(x);
            assert!(
                (got - want).abs() <= 4e-16 * want.abs().max(0.25),
                "{x}: {got} {want}"
            );
        }
        assert_eq!(ln_of(1.0), [0.0; 4]);
    }

    #[test]
    fn angle_agrees_with_the_scalar_one() {
        for k in 0..=2000 {
            let t = f64::from(k) * std::f64::consts::PI / 2000.0;
            let (y, x) = (3.0 * libm::sin(t).abs(), 3.0 * libm::cos(t));
            let got = angle_of(y, x)[1];
            assert!((got - libm::atan2(y, x)).abs() <= 1e-15, "{t}: {got}");
        }
        assert_eq!(angle_of(0.0, 0.0), [0.0; 4]);
    }
}
