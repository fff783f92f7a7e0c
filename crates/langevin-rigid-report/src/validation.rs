//! Beyond the paper: the precomputation against closed forms and extrapolated values.

mod added_mass;
mod turbulence;

use langevin_rigid_bake::progress::Progress;

use crate::error::ReportError;
use crate::options::Options;
use crate::section::Section;

pub(crate) fn section(_: &Options, progress: &dyn Progress) -> Result<Section, ReportError> {
    let title = "Beyond the paper: the precomputation against closed forms";
    let mut section = Section::new("validation", title);
    section.text(
        "Errors are in percent of each entry of the diagonal, in the order of the axes. Left out is what takes \
         longer than a few seconds: meshes of more than some ten thousand triangles.",
    );
    added_mass::ellipsoids(&mut section, progress)?;
    added_mass::edges(&mut section, progress)?;
    added_mass::cones(&mut section, progress)?;
    turbulence::closed_forms(&mut section, progress)?;
    turbulence::vortices(&mut section, progress)?;
    Ok(section)
}
