//! Median and spread of a sample.

/// The 10th, 50th and 90th percentile of a sample; not numbers where it is empty.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Spread {
    pub(crate) low: f64,
    pub(crate) median: f64,
    pub(crate) high: f64,
}

impl Spread {
    pub(crate) fn new(mut values: Vec<f64>) -> Self {
        values.sort_by(f64::total_cmp);
        Self {
            low: quantile(&values, 0.1),
            median: quantile(&values, 0.5),
            high: quantile(&values, 0.9),
        }
    }
}

/// Linear between the values of a sorted sample.
fn quantile(sorted: &[f64], part: f64) -> f64 {
    let Some(last) = sorted.len().checked_sub(1) else {
        return f64::NAN;
    };
    let place = part * last as f64;
    let i = (place as usize).min(last);
    let next = sorted[(i + 1).min(last)];
    sorted[i] + (place - i as f64) * (next - sorted[i])
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn percentiles_lie_between_values() {
        let spread = Spread::new((0..=10).rev().map(f64::from).collect());
        assert_eq!((spread.low, spread.median, spread.high), (1.0, 5.0, 9.0));
        assert_eq!(Spread::new(vec![3.0, 4.0]).median, 3.5);
        assert!(Spread::new(Vec::new()).median.is_nan());
    }
}
