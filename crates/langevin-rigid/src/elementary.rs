//! Elementary functions over [`Real`], without branches and with the same bits in every lane.

use crate::real::Real;

/// c0 + c1 x + c2 x^2 + ...
#[inline(always)]
pub(crate) fn polynomial<R: Real, const N: usize>(x: R, coefficients: &[f64; N]) -> R {
    let mut sum = x.of(coefficients[N - 1]);
    for k in (0..N - 1).rev() {
        sum = sum * x + x.of(coefficients[k]);
    }
    sum
}

/// Natural logarithm of a positive normal number, to 3e-10.
///
/// ln m = 2 artanh s with s = (m - 1)/(m + 1), for the mantissa m in [sqrt(1/2), sqrt(2)).
#[inline(always)]
pub(crate) fn ln<R: Real>(x: R) -> R {
    let (m, exponent) = x.mantissa_and_exponent();
    let one = x.of(1.0);
    let s = (m - one) / (m + one);
    s * polynomial(s * s, &ARTANH) + exponent * x.of(std::f64::consts::LN_2)
}

/// Sine and cosine of at most an eighth of a turn to either side, `x` in turns, to 2e-10.
#[inline(always)]
pub(crate) fn sin_cos_eighth<R: Real>(x: R) -> (R, R) {
    let angle = x * x.of(std::f64::consts::TAU);
    let z = angle * angle;
    (
        angle * polynomial(z, &SINE_OF_EIGHTH),
        polynomial(z, &COSINE_OF_EIGHTH),
    )
}

/// Sine and cosine of any angle `x` in turns, to 2e-10; |x| below 2^20.
#[inline(always)]
pub(crate) fn sin_cos_turns<R: Real>(x: R) -> (R, R) {
    let turn = x - x.nearest();
    let quarter = (turn * x.of(4.0)).nearest();
    let (s, c) = sin_cos_eighth(turn - quarter * x.of(0.25));
    let size = quarter.abs();
    let odd = x.of(0.5).less(size) & size.less(x.of(1.5));
    let (sin, cos) = (R::choose(odd, c, s), R::choose(odd, s, c));
    let (half, more) = (x.of(0.5), x.of(1.5));
    (
        R::choose(quarter.less(-half) | more.less(quarter), -sin, sin),
        R::choose(half.less(quarter) | quarter.less(-more), -cos, cos),
    )
}

/// `sin(a/2)/a` and `cos(a/2)` from `a^2`, to rounding.
#[inline(always)]
pub(crate) fn half_angle<R: Real>(a2: R) -> (R, R) {
    let quarter = a2.of(0.25);
    let x = a2 * quarter;
    let near = x.less(a2.of(0.250_001));
    let series = (polynomial(x, &SINE) * a2.of(0.5), polynomial(x, &COSINE));
    if !R::any(!near) {
        return series;
    }
    let sinc = x.map(|x| 0.5 * libm::sin(x.sqrt()) / x.sqrt());
    let cos = x.map(|x| libm::cos(x.sqrt()));
    (
        R::choose(near, series.0, sinc),
        R::choose(near, series.1, cos),
    )
}

// Interpolated at Chebyshev's nodes of their range, the first coefficient held where it is exact.

/// 2 artanh(s)/s in powers of s^2, for s^2 up to ((sqrt 2 - 1)/(sqrt 2 + 1))^2.
const ARTANH: [f64; 4] = [
    1.999_999_998_631_318_2,
    0.666_668_153_381_511_9,
    0.399_748_505_175_190_5,
    0.299_243_904_791_449_86,
];
/// sin(x)/x and cos(x) in powers of x^2, for x up to an eighth of a turn.
const SINE_OF_EIGHTH: [f64; 5] = [
    1.0,
    -0.166_666_666_638_552_9,
    0.008_333_331_874_710_208,
    -0.000_198_400_867_353_848_46,
    2.724_992_580_305_979e-6,
];
const COSINE_OF_EIGHTH: [f64; 5] = [
    1.0,
    -0.499_999_999_691_193_13,
    0.041_666_650_644_517_03,
    -0.001_388_758_915_560_057_6,
    2.446_378_829_326_574_6e-5,
];
/// The same for x^2 up to 1/4.
const SINE: [f64; 6] = [
    1.0,
    -0.166_666_666_666_666_35,
    0.008_333_333_333_272_254,
    -0.000_198_412_696_457_900_5,
    2.755_710_022_606_947e-6,
    -2.495_193_328_770_448_4e-8,
];
const COSINE: [f64; 7] = [
    1.0,
    -0.5,
    0.041_666_666_666_666_276,
    -0.001_388_888_888_870_566_6,
    2.480_158_698_883_637_4e-5,
    -2.755_707_788_752_316_7e-7,
    2.079_089_421_712_47e-9,
];
/// (e^x - 1)/x in powers of x, for x from -1/8 to 0.
const SMALL_EXPONENTIAL: [f64; 6] = [
    1.0,
    0.499_999_999_988_625_4,
    0.166_666_662_115_396_24,
    0.041_666_374_905_396_396,
    0.008_326_774_059_037_216,
    0.001_328_430_246_798_460_6,
];
/// (2^x - 1)/x in powers of x, for x from -1/2 to 1/2.
const BINARY_EXPONENTIAL: [f64; 9] = [
    std::f64::consts::LN_2,
    0.240_226_506_958_129_9,
    0.055_504_108_664_760_424,
    0.009_618_129_159_402_558,
    0.001_333_355_817_904_313,
    0.000_154_034_558_524_538_38,
    1.525_268_684_625_787_9e-5,
    1.325_522_487_866_881_7e-6,
    1.020_312_106_514_100_6e-7,
];

/// Up to here [`small_expm1`] is good.
pub(crate) const SMALL_EXPONENT: f64 = 0.125;

/// `e^x - 1` from -[`SMALL_EXPONENT`] to 0, to 2e-12 of itself.
#[inline(always)]
pub(crate) fn small_expm1<R: Real>(x: R) -> R {
    x * polynomial(x, &SMALL_EXPONENTIAL)
}

/// `e^x - 1` to 3e-14 of e^x, with `|x|` cut at [`Real::LARGEST_EXPONENT`].
#[inline(always)]
pub(crate) fn expm1<R: Real>(x: R) -> R {
    let (scale, rest) = reduced(x);
    scale * rest + (scale - x.of(1.0))
}

/// `e^x` to 3e-14 of itself for |x| up to 100, with `|x|` cut at [`Real::LARGEST_EXPONENT`].
#[inline(always)]
pub(crate) fn exp<R: Real>(x: R) -> R {
    let (scale, rest) = reduced(x);
    scale * rest + scale
}

/// (2^n, 2^r - 1) with x log2 e = n + r and |r| <= 1/2.
#[inline(always)]
fn reduced<R: Real>(x: R) -> (R, R) {
    let limit = x.of(R::LARGEST_EXPONENT);
    let y = x.min(limit).max(-limit) * x.of(std::f64::consts::LOG2_E);
    let n = y.nearest();
    let r = y - n;
    (n.power_of_two(), r * polynomial(r, &BINARY_EXPONENTIAL))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithm_and_circle_are_good_to_their_bound() {
        for i in 1..4000 {
            let u = f64::from(i) / 4000.0;
            assert!((ln(u) - libm::log(u)).abs() < 3e-10, "{u}");
            let x = (u - 0.5) / 4.0;
            let (s, c) = sin_cos_eighth(x);
            assert!((s - libm::sin(std::f64::consts::TAU * x)).abs() < 3e-10);
            assert!((c - libm::cos(std::f64::consts::TAU * x)).abs() < 3e-10);
        }
        assert!((ln(1e-10) - libm::log(1e-10)).abs() < 3e-10);
    }

    #[test]
    fn a_circle_is_good_all_around_and_many_times() {
        for i in -40_000..40_000 {
            let x = f64::from(i) / 1024.0;
            let (s, c) = sin_cos_turns(x);
            let angle = std::f64::consts::TAU * x;
            assert!((s - libm::sin(angle)).abs() < 1e-9, "{x}: {s}");
            assert!((c - libm::cos(angle)).abs() < 1e-9, "{x}: {c}");
        }
    }

    #[test]
    fn exponentials_meet_the_library() {
        for i in -3000..3000 {
            let x = f64::from(i) / 100.0;
            assert!((exp(x) / libm::exp(x) - 1.0).abs() < 4e-14, "{x}");
            let wanted = libm::expm1(x);
            assert!(
                (expm1(x) - wanted).abs() < 4e-14 * (1.0 + wanted.abs()),
                "{x}"
            );
            let small = -(x / 240.0).abs();
            let wanted = libm::expm1(small);
            assert!((small_expm1(small) - wanted).abs() <= 2e-12 * wanted.abs());
        }
        assert!(exp(-1e9f64) < 1e-300 && exp(1e9f64).is_finite());
    }

    #[test]
    fn half_angles_meet_the_library_across_the_seam() {
        for i in 1..4000 {
            let a = f64::from(i) / 1000.0;
            let (s, c) = half_angle(a * a);
            assert!((s - libm::sin(0.5 * a) / a).abs() < 3e-16, "{a}");
            assert!((c - libm::cos(0.5 * a)).abs() < 3e-16, "{a}");
        }
        assert_eq!(half_angle(0.0), (0.5, 1.0));
    }
}
