//! Numbers that are both in the page and in the raw data.

use std::collections::BTreeMap;
use std::fmt;

/// The numbers of a section by their keys: what its `numbers.json` holds.
///
/// The page can only show a number that `quote` has put here, so the two cannot differ.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Numbers(BTreeMap<String, f64>);

impl Numbers {
    /// Keeps `value` under `key` and gives it to be shown with `digits` significant digits, or as a
    /// whole number for none.
    pub(crate) fn quote(&mut self, key: impl Into<String>, value: f64, digits: usize) -> Quoted {
        let key = key.into();
        if value.is_finite() {
            self.0.insert(key.clone(), value);
        }
        Quoted { key, value, digits }
    }

    /// The number under `key`.
    pub fn get(&self, key: &str) -> Option<f64> {
        self.0.get(key).copied()
    }

    /// Keys and numbers, in the order of the keys.
    pub fn iter(&self) -> impl Iterator<Item = (&str, f64)> {
        self.0.iter().map(|(key, value)| (key.as_str(), *value))
    }

    /// The numbers as a JSON object.
    pub(crate) fn json(&self) -> std::io::Result<String> {
        Ok(serde_json::to_string_pretty(&self.0)? + "\n")
    }
}

/// A number of the raw data, written as HTML that carries its key and all its digits.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Quoted {
    key: String,
    value: f64,
    digits: usize,
}

impl fmt::Display for Quoted {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let Self { key, value, digits } = self;
        if !value.is_finite() {
            return f.write_str("\u{2013}");
        }
        let shown = significant(*value, *digits);
        write!(
            f,
            r#"<data data-key="{key}" value="{value}">{shown}</data>"#
        )
    }
}

/// `value` to so many significant digits, with a true minus sign; very small and large values as
/// powers of ten.
pub(crate) fn significant(value: f64, digits: usize) -> String {
    if digits == 0 {
        return format!("{value:.0}");
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    // Rounding first: 9.99 to two digits is 10.
    let scientific = format!("{value:.*e}", digits - 1);
    let (mantissa, exponent) = scientific.split_once('e').unwrap_or((&scientific, "0"));
    let exponent: i32 = exponent.parse().unwrap_or(0);
    let text = if (-3..6).contains(&exponent) {
        let decimals = (digits as i32 - 1 - exponent).max(0) as usize;
        format!("{value:.decimals$}")
    } else {
        format!("{mantissa}\u{b7}10<sup>{exponent}</sup>")
    };
    text.replace('-', "\u{2212}")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits_are_kept() {
        for (value, digits, shown) in [
            (0.0, 3, "0"),
            (100.0, 0, "100"),
            (9.99, 2, "10"),
            (-0.01234, 2, "\u{2212}0.012"),
            (123.0, 3, "123"),
            (1234.6, 3, "1235"),
            (1.5e-7, 2, "1.5\u{b7}10<sup>\u{2212}7</sup>"),
            (2e9, 1, "2\u{b7}10<sup>9</sup>"),
        ] {
            assert_eq!(significant(value, digits), shown);
        }
    }

    #[test]
    fn what_is_shown_is_kept() {
        let mut numbers = Numbers::default();
        let shown = numbers.quote("speed", 0.125, 2).to_string();
        assert_eq!(shown, r#"<data data-key="speed" value="0.125">0.12</data>"#);
        assert_eq!(numbers.get("speed"), Some(0.125));
        assert_eq!(numbers.quote("none", f64::NAN, 2).to_string(), "\u{2013}");
        assert_eq!(numbers.get("none"), None);
    }
}
