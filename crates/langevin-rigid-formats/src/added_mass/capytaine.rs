//! Capytaine: the matrix as its labelled array.

use super::statement::Statement;
use super::{Report, row};

const COMMENT: &str = "
Comparable with Capytaine's added mass of a body with
rigid_body_dofs(rotation_center=ROTATION_CENTER), normals outwards, and
RadiationProblem(..., free_surface=inf, water_depth=inf, rho=RHO): any omega gives the same.";

/// A Python program that makes an `xarray.DataArray` with the dofs of Capytaine's rigid bodies.
pub fn capytaine(report: &Report) -> String {
    let rows = report
        .added_mass
        .iter()
        .map(|numbers| format!("    [{}],\n", row(numbers, ", ")));
    format!(
        "{comment}\
import numpy as np
import xarray as xr

DOFS = [\"Surge\", \"Sway\", \"Heave\", \"Roll\", \"Pitch\", \"Yaw\"]
RHO = {rho:e}  # kg/m^3
ROTATION_CENTER = ({centre})  # m
MATRIX = np.array([
{rows}])
added_mass = xr.DataArray(
    MATRIX,
    dims=[\"influenced_dof\", \"radiating_dof\"],
    coords={{\"influenced_dof\": DOFS, \"radiating_dof\": DOFS}},
    name=\"added_mass\",
    attrs={{\"rho\": RHO, \"rotation_center\": ROTATION_CENTER}},
)
",
        comment = Statement::new(report).hashed(COMMENT),
        rho = report.fluid_density,
        centre = row(&report.reference, ", "),
        rows = rows.collect::<String>(),
    )
}
