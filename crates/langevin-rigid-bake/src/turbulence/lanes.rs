//! Four cells of a row at a time: how they are read, written and taken the logarithm of.

use wide::f64x4;

/// Cells that are worked on together.
pub(crate) const LANES: usize = 4;

/// `first`, `first + 1`, ... in the lanes.
#[inline(always)]
pub(crate) fn counted_from(first: f64) -> f64x4 {
    f64x4::splat(first) + f64x4::new([0.0, 1.0, 2.0, 3.0])
}

/// The lanes from `at` on.
#[inline(always)]
pub(crate) fn load(field: &[f64], at: usize) -> f64x4 {
    match field[at..].first_chunk::<LANES>() {
        Some(lanes) => f64x4::new(*lanes),
        None => f64x4::splat(f64::NAN),
    }
}

/// Writes as many lanes as `row` has room for from `at` on.
#[inline(always)]
pub(crate) fn store(row: &mut [f64], at: usize, lanes: f64x4) {
    let row = &mut row[at..];
    let lanes = lanes.to_array();
    match row.first_chunk_mut::<LANES>() {
        Some(full) => *full = lanes,
        None => row
            .iter_mut()
            .zip(lanes)
            .for_each(|(value, lane)| *value = lane),
    }
}

/// 2^52: a number in [0, 2^52) that is added to it loses its fraction, rounded to nearest.
const INTEGERS: f64 = 4_503_599_627_370_496.0;

/// The next whole number below, or the number itself or one less where it is whole; for 0.5 and up.
#[inline(always)]
pub(crate) fn whole_below(x: f64x4) -> f64x4 {
    (x + f64x4::splat(INTEGERS - 0.5)) - f64x4::splat(INTEGERS)
}

/// The nearest whole number, of either sign.
#[inline(always)]
pub(crate) fn nearest_whole(x: f64x4) -> f64x4 {
    let shift = f64x4::splat(1.5 * INTEGERS);
    (x + shift) - shift
}

/// Whole numbers in [0, 2^32) as indices.
#[inline(always)]
pub(crate) fn indices(whole: f64x4) -> [usize; LANES] {
    let [a, b, c, d] = (whole + f64x4::splat(INTEGERS)).to_array();
    let index = |x: f64| x.to_bits() as u32 as usize;
    [index(a), index(b), index(c), index(d)]
}

/// Natural logarithm of positive normal numbers, to an error of about one last digit.
#[inline(always)]
pub(crate) fn ln(x: f64x4) -> f64x4 {
    /// Bits of sqrt(1/2), the lower end of the mantissas, and of 1.
    const LOWEST: u64 = 0x3fe6_a09e_667f_3bcd;
    const ONE: u64 = 0x3ff0_0000_0000_0000;
    const MANTISSA: u64 = 0x000f_ffff_ffff_ffff;
    let shifted = x.to_array().map(|x| x.to_bits().wrapping_add(ONE - LOWEST));
    let mantissa = f64x4::new(shifted.map(|b| f64::from_bits((b & MANTISSA) + LOWEST)));
    let biased = f64x4::new(shifted.map(|b| f64::from_bits((b >> 52) | INTEGERS.to_bits())));
    let exponent = biased - f64x4::splat(INTEGERS + 1023.0);
    // ln m = 2 atanh((m - 1)/(m + 1)), of which |z| < 0.172.
    let one = f64x4::splat(1.0);
    let z = (mantissa - one) / (mantissa + one);
    let square = z * z;
    let mut series = f64x4::splat(1.0 / 21.0);
    for n in (0..10).rev() {
        series = series * square + f64x4::splat(1.0 / f64::from(2 * n + 1));
    }
    exponent * f64x4::splat(core::f64::consts::LN_2) + (z + z) * series
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn logarithm_has_the_digits_of_the_library() {
        let mut x = 1.0;
        while x < 1e300 {
            for value in [
                x,
                1.0 + 1e-3 * libm::fmod(x, 1.0),
                1.0 + 1e-12 * x.min(1e6),
                1.0 / x,
            ] {
                let (got, expected) = (ln(f64x4::splat(value)).to_array()[2], libm::log(value));
                let error = (got - expected).abs() / expected.abs().max(1e-300);
                assert!(error < 6e-16, "ln {value}: {got} {expected}");
            }
            x *= 1.0371;
        }
        assert_eq!(ln(f64x4::splat(1.0)).to_array(), [0.0; LANES]);
    }

    #[test]
    fn whole_numbers_are_found_on_the_right_side() {
        let x = f64x4::new([0.5, 0.75, 7.25, 1e6 + 0.999]);
        assert_eq!(whole_below(x).to_array(), [0.0, 0.0, 7.0, 1e6]);
        assert_eq!(indices(whole_below(x)), [0, 0, 7, 1_000_000]);
        let x = f64x4::new([-3.4, -0.6, 2.4, 1e9 + 0.6]);
        assert_eq!(nearest_whole(x).to_array(), [-3.0, -1.0, 2.0, 1e9 + 1.0]);
        for whole in [1.0, 2.0, 31.0, 32.0] {
            let below = whole - whole_below(f64x4::splat(whole)).to_array()[0];
            assert!(below == 0.0 || below == 1.0);
        }
    }

    #[test]
    fn short_rows_take_the_lanes_that_fit() {
        let mut row = [0.0; 6];
        store(&mut row, 1, counted_from(5.0));
        assert_eq!(row, [0.0, 5.0, 6.0, 7.0, 8.0, 0.0]);
        store(&mut row, 4, counted_from(1.0));
        assert_eq!(row, [0.0, 5.0, 6.0, 7.0, 1.0, 2.0]);
        assert_eq!(load(&row, 2).to_array(), [6.0, 7.0, 1.0, 2.0]);
    }
}
