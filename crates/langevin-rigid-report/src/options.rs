//! What to compute.

use std::path::PathBuf;

use langevin_rigid_bake::progress::Progress;

use crate::error::ReportError;
use crate::section::Section;

/// What to compute.
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
