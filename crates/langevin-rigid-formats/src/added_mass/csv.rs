//! CSV for spreadsheets and numerical programs.

use super::statement::Statement;
use super::{Report, row};

/// Comment lines that begin with `#`, a header, six rows.
pub fn csv(report: &Report) -> String {
    let rows = report
        .added_mass
        .iter()
        .map(|numbers| row(numbers, ",") + "\n");
    Statement::new(report).hashed("") + "x,y,z,rot_x,rot_y,rot_z\n" + &rows.collect::<String>()
}
