//! Report of Langevin Rigid: the results of the paper, computed again, as one page.
//!
//! The paper is H. Xie and K. Miyata, "Langevin Rigid: Animating Immersed Rigid Bodies in Real-time" (2014). The page has
//! pictures, curves and tables beside what the paper states, and the raw data next to it. It is for those who want to
//! know what of the paper can be had again; the command `langevin-rigid reproduce` is its usual user.
//!
//! ```
//! use langevin_rigid_report::{Options, Part, reproduce};
//!
//! let options = Options::new(Some(&[Part::named("fig2")?]), 1, 1, None)?;
//! let folder = tempfile::tempdir()?;
//! let report = reproduce(&options, folder.path(), &())?;
//! assert!(report.complete && report.page.is_file());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! [`reproduce`] computes the [`PARTS`] that it is asked for in turn and writes each as soon as it is finished, so that an
//! interruption costs the part under way and no more. A finished part is a [`Section`]: words, [`Numbers`], files, and a
//! verdict on each [`Claim`] of the paper.
//!
//! - Every number is a result of the runs; what the paper states is in one place, [`paper`], what the validation
//!   compares with in another, `references.rs`.
//! - Tables are Markdown as well, and [`pages`] writes them into a manual.
//! - Verdicts follow from the numbers by the rule that the page states.
//! - Numbers depend on the options alone, but for wall-clock times. Units are SI in the data, and stated in the page.
//! - What cannot be computed or written is a [`ReportError`].

mod chart;
mod closure;
mod coin;
mod data_uri;
mod departures;
mod error;
mod falls;
mod fig2;
mod html;
mod machine;
mod measures;
mod numbers;
mod options;
pub mod pages;
pub mod paper;
mod references;
mod regimes;
mod runs;
mod section;
mod showcase;
mod spread;
mod table;
mod table2;
mod validation;

use std::path::{Path, PathBuf};

use langevin_rigid::{UnknownName, choose};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::files;

pub use error::ReportError;
pub use numbers::Numbers;
pub use options::{Options, OptionsError, Part};
pub use section::{Claim, Section};
pub use table::Table;

/// All parts, in the order of the page. A new one is a row here.
pub const PARTS: &[Part] = &[
    Part {
        name: "fig2",
        compute: fig2::section,
    },
    Part {
        name: "fig3",
        compute: falls::fig3,
    },
    Part {
        name: "fig4",
        compute: falls::fig4,
    },
    Part {
        name: "fig5",
        compute: falls::fig5,
    },
    Part {
        name: "table2",
        compute: table2::section,
    },
    Part {
        name: "departures",
        compute: departures::section,
    },
    Part {
        name: "regimes",
        compute: regimes::section,
    },
    Part {
        name: "coin",
        compute: coin::section,
    },
    Part {
        name: "showcase",
        compute: showcase::section,
    },
    Part {
        name: "closure",
        compute: closure::section,
    },
    Part {
        name: "validation",
        compute: validation::section,
    },
];

impl Part {
    /// The part of a name.
    ///
    /// # Errors
    /// [`UnknownName`] if there is none.
    pub fn named(name: &str) -> Result<Self, UnknownName> {
        choose("part", name, PARTS.iter().map(|part| (part.name, *part)))
    }
}

/// A report on disk.
#[derive(Debug, Clone, PartialEq)]
pub struct Report {
    /// The page.
    pub page: PathBuf,
    /// The parts that are finished, in order.
    pub sections: Vec<Section>,
    /// Whether all parts that were asked for are.
    pub complete: bool,
}

/// Computes the parts and writes `report.html` and a folder of data for each part into `folder`.
///
/// When `progress` cancels, the parts finished before are kept and the report says that it is
/// incomplete.
///
/// # Errors
/// [`ReportError`]; the parts finished before are on disk.
pub fn reproduce(
    options: &Options,
    folder: &Path,
    progress: &dyn Progress,
) -> Result<Report, ReportError> {
    let mut report = Report {
        page: folder.join("report.html"),
        sections: Vec::new(),
        complete: false,
    };
    for part in &options.parts {
        progress.report(part.name, 0.0);
        match (part.compute)(options, progress) {
            Ok(_) if progress.cancelled() => return Ok(report),
            Ok(section) => report.sections.push(section),
            Err(_) if progress.cancelled() => return Ok(report),
            Err(error) => return Err(error),
        }
        write(options, folder, &report)?;
    }
    report.complete = true;
    Ok(report)
}

/// The newest section's data, and the page of all so far.
fn write(options: &Options, folder: &Path, report: &Report) -> Result<(), ReportError> {
    if let Some(section) = report.sections.last() {
        let place = folder.join(section.id);
        for (name, content) in &section.files {
            files::write(&place.join(name), content)?;
        }
        for table in &section.tables {
            let name = format!("{}.md", table.name);
            files::write(&place.join(name), table.markdown.as_bytes())?;
        }
        let json = section.numbers.json().map_err(ReportError::Json)?;
        files::write(&place.join("numbers.json"), json.as_bytes())?;
    }
    let done = report.sections.len();
    let missing: Vec<&str> = options.parts[done..].iter().map(|p| p.name).collect();
    let page = html::page(&report.sections, &intro(options), &missing);
    files::write(&report.page, page.as_bytes())?;
    Ok(())
}

fn intro(options: &Options) -> String {
    let (first, last) = (
        options.first_seed,
        options
            .first_seed
            .saturating_add(u64::from(options.seeds) - 1),
    );
    format!(
        "<p>The results of {}, computed by langevin-rigid {} with seeds {first} to {last}. Numbers \
         are medians over the seeds with the 10th and 90th percentile in brackets, unless they say \
         otherwise; the raw data are in a folder for each section beside this page.</p>\
         <p>{}</p>",
        paper::TITLE,
        env!("CARGO_PKG_VERSION"),
        falls::RULE,
    )
}
