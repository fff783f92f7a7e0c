//! Mesh files named on the command line.

use std::path::Path;

use anyhow::Result;
use langevin_rigid_formats::mesh::{LengthUnit, ParseError, RawMesh, ReadError, read_mesh};

use crate::say;

/// Reads a mesh, in metres where neither the command nor the format says otherwise; what the reader has
/// to say goes to the other stream.
pub(crate) fn read(path: &Path, unit: Option<LengthUnit>) -> Result<RawMesh> {
    let raw = match read_mesh(path, unit) {
        Err(ReadError::Parse {
            error: ParseError::NoUnit,
            ..
        }) => read_mesh(path, Some(LengthUnit::M)),
        read => read,
    }?;
    for notice in &raw.notices {
        say::note(notice);
    }
    Ok(raw)
}
