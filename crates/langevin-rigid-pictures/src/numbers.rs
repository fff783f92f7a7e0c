//! Round numbers, units of length, and how they are written.

/// Leading digits of lengths and of distances between grid lines.
const COARSE: [f64; 4] = [1.0, 2.0, 5.0, 10.0];
/// Leading digits where a round number should be near the one wanted.
const FINE: [f64; 10] = [1.0, 1.5, 2.0, 2.5, 3.0, 4.0, 5.0, 6.0, 8.0, 10.0];

/// The largest of 1, 2, 5 times a power of ten that is not above `limit` (positive).
pub(super) fn coarse_below(limit: f64) -> f64 {
    let decade = power_of_ten(exponent(limit));
    let mut fits = COARSE.iter().rev().map(|s| s * decade);
    fits.find(|s| *s <= limit * (1.0 + 1e-9)).unwrap_or(decade)
}

/// The smallest of 1, 2, 5 times a power of ten that is not below `limit` (positive).
pub(super) fn coarse_above(limit: f64) -> f64 {
    round_above(&COARSE, limit)
}

/// The smallest of 1, 1.5, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not below `limit`
/// (positive).
pub(super) fn fine_above(limit: f64) -> f64 {
    round_above(&FINE, limit)
}

fn round_above(steps: &[f64], limit: f64) -> f64 {
    let decade = power_of_ten(exponent(limit));
    let mut fits = steps.iter().map(|s| s * decade);
    fits.find(|s| *s >= limit * (1.0 - 1e-9)).unwrap_or(limit)
}

/// Power of ten of the leading digit.
pub(super) fn exponent(value: f64) -> i32 {
    // A hair more than `value`, so that 0.001 computed a little low is still ten to the -3.
    libm::floor(libm::log10(value.abs() * (1.0 + 1e-9))) as i32
}

fn power_of_ten(exponent: i32) -> f64 {
    libm::exp10(f64::from(exponent))
}

/// Digits after the point that tell multiples of `step` apart.
pub(super) fn decimals(step: f64) -> usize {
    let exponent = exponent(step);
    let leading = step / power_of_ten(exponent);
    let halves = (leading - libm::round(leading)).abs() > 0.01;
    (i32::from(halves) - exponent).clamp(0, 12) as usize
}

/// `value` to so many digits after the point, with a true minus sign and no minus zero.
pub(super) fn fixed(value: f64, decimals: usize) -> String {
    let text = format!("{value:.decimals$}");
    match text.strip_prefix('-') {
        Some(digits) if digits.chars().all(|c| c == '0' || c == '.') => digits.to_owned(),
        Some(digits) => format!("\u{2212}{digits}"),
        None => text,
    }
}

/// `value` to three significant digits, without needless zeros.
pub(super) fn short(value: f64) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let exponent = exponent(value);
    if !(-4..7).contains(&exponent) {
        return format!("{value:.2e}").replace('-', "\u{2212}");
    }
    let text = fixed(value, (2 - exponent).max(0) as usize);
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

/// A unit of length and its size in metres.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct LengthUnit {
    pub name: &'static str,
    pub metres: f64,
}

impl LengthUnit {
    /// The unit in which a length reads as a number of few digits.
    pub(super) fn fitting(length: f64) -> Self {
        let units = [
            ("km", 1e3, 1e3),
            ("m", 1.0, 1e-2),
            ("mm", 1e-3, 1e-5),
            ("µm", 1e-6, 1e-8),
        ];
        let fits = units
            .iter()
            .find(|(_, _, least)| length >= least * (1.0 - 1e-9));
        let (name, metres, _) = fits.copied().unwrap_or(("nm", 1e-9, 0.0));
        Self { name, metres }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn round_numbers_are_exact_at_their_own_limits() {
        let close = |a: f64, b: f64| (a / b - 1.0).abs() < 1e-9;
        for decade in [1e-6, 0.001, 0.1, 1.0, 100.0] {
            for value in [1.0, 2.0, 5.0].map(|step| step * decade) {
                assert!(close(coarse_below(value), value));
                assert!(close(coarse_above(value), value));
                assert!(close(fine_above(value), value));
            }
            assert!(close(coarse_below(4.9 * decade), 2.0 * decade));
            assert!(close(coarse_above(2.1 * decade), 5.0 * decade));
            assert!(close(fine_above(2.1 * decade), 2.5 * decade));
            assert!(close(fine_above(8.1 * decade), 10.0 * decade));
        }
    }

    #[test]
    fn numbers_are_written_as_people_write_them() {
        assert_eq!(short(0.2), "0.2");
        assert_eq!(short(1200.0), "1200");
        assert_eq!(short(0.012345), "0.0123");
        assert_eq!(fixed(-0.0001, 2), "0.00");
        assert_eq!(fixed(-1.5, 1), "\u{2212}1.5");
        assert_eq!(decimals(0.25), 2);
        assert_eq!(decimals(0.2), 1);
        assert_eq!(decimals(1.5), 1);
        assert_eq!(decimals(20.0), 0);
        assert_eq!(LengthUnit::fitting(0.5).name, "m");
        assert_eq!(LengthUnit::fitting(0.002).name, "mm");
    }
}
