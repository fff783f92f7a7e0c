//! Beyond the paper: the model `separated` against measurements, all with the same constants.

mod airborne;
mod discs;
mod drop;
mod papers;
mod solids;
mod steady;
mod strips;

use langevin_rigid_bake::progress::Progress;

use crate::error::ReportError;
use crate::options::Options;
use crate::section::Section;

pub(crate) fn section(options: &Options, progress: &dyn Progress) -> Result<Section, ReportError> {
    let title = "Beyond the paper: the separated wake against measurements";
    let mut section = Section::new("closure", title);
    section.text(
        "Everything here is under the model <i>separated</i> with its default constants: real meshes, where a body has one, \
         through the bake that every scene takes. Without turbulence where it says so.",
    );
    for table in [
        solids::sphere,
        steady::steady,
        solids::thick,
        papers::papers,
        discs::discs,
        strips::strips,
        airborne::seeds,
        airborne::airplane,
    ] {
        if progress.cancelled() {
            return Err(ReportError::Cancelled);
        }
        table(&mut section, options, progress)?;
    }
    Ok(section)
}
