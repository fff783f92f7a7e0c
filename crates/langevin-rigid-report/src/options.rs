//! What to compute.

use std::path::PathBuf;

use langevin_rigid_bake::progress::Progress;

use crate::PARTS;
use crate::error::ReportError;
use crate::section::Section;

/// What to compute; [`Options::new`] checks it.
#[derive(Debug, Clone, PartialEq)]
pub struct Options {
    /// The parts, in the order of the page.
    pub parts: Vec<Part>,
    /// Seeds of each ensemble, one or more.
    pub seeds: u32,
    /// The first of them.
    pub first_seed: u64,
    /// Where bakes are kept, if anywhere.
    pub cache: Option<PathBuf>,
}

/// Why nothing can be computed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum OptionsError {
    /// No part was named.
    #[error("no part is named; name some, or leave them out for all")]
    NoParts,
    /// There are no seeds.
    #[error("there are no seeds; at least one is needed")]
    NoSeeds,
    /// No number holds the last seed.
    #[error(
        "there are no {seeds} seeds from {first} on: the largest is {}; begin lower",
        u64::MAX
    )]
    Seeds {
        /// How many were asked for.
        seeds: u32,
        /// The first.
        first: u64,
    },
}

impl Options {
    /// These parts, or all; in the order of the page, each once.
    ///
    /// # Errors
    /// [`OptionsError`].
    pub fn new(
        parts: Option<&[Part]>,
        seeds: u32,
        first_seed: u64,
        cache: Option<PathBuf>,
    ) -> Result<Self, OptionsError> {
        if parts.is_some_and(<[Part]>::is_empty) {
            return Err(OptionsError::NoParts);
        }
        let others = seeds.checked_sub(1).ok_or(OptionsError::NoSeeds)?;
        if first_seed.checked_add(u64::from(others)).is_none() {
            return Err(OptionsError::Seeds {
                seeds,
                first: first_seed,
            });
        }
        let wanted = |part: &&Part| parts.is_none_or(|parts| parts.contains(part));
        Ok(Self {
            parts: PARTS.iter().filter(wanted).copied().collect(),
            seeds,
            first_seed,
            cache,
        })
    }
}

/// A part of the report.
#[derive(Clone, Copy)]
pub struct Part {
    /// Its name on the command line, in the page and on disk.
    pub name: &'static str,
    pub(crate) compute: fn(&Options, &dyn Progress) -> Result<Section, ReportError>,
}

impl PartialEq for Part {
    fn eq(&self, other: &Self) -> bool {
        self.name == other.name
    }
}

impl std::fmt::Debug for Part {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_tuple("Part").field(&self.name).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parts_come_in_the_order_of_the_page_each_once() {
        let [first, second, third] = [0, 1, 2].map(|place| PARTS[place]);
        let named = [third, first, third];
        let options = Options::new(Some(&named), 1, 0, None).unwrap();
        assert_eq!(options.parts, [first, third]);
        assert!(!options.parts.contains(&second));
        let all = Options::new(None, 1, 0, None).unwrap();
        assert_eq!(all.parts, PARTS);
    }

    #[test]
    fn what_cannot_be_computed_is_refused() {
        let refused = |parts, seeds, first| Options::new(parts, seeds, first, None).unwrap_err();
        assert_eq!(refused(Some(&[]), 1, 1), OptionsError::NoParts);
        assert_eq!(refused(None, 0, 1), OptionsError::NoSeeds);
        let beyond = refused(None, 3, u64::MAX - 1).to_string();
        assert!(
            beyond.starts_with("there are no 3 seeds from 18446744073709551614 on"),
            "{beyond}"
        );
        // The last seed is the largest number.
        assert!(Options::new(None, 2, u64::MAX - 1, None).is_ok());
    }
}
