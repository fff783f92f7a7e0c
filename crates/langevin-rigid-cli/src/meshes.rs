//! Mesh files named on the command line.

use std::path::Path;

use anyhow::Result;
use langevin_rigid_formats::mesh::{LengthUnit, RawMesh, read_mesh};

/// Reads a mesh; what the reader has to say goes to the other stream.
pub(crate) fn read(path: &Path, unit: LengthUnit) -> Result<RawMesh> {
    let raw = read_mesh(path, unit)?;
    for notice in &raw.notices {
        eprintln!("note: {notice}");
    }
    Ok(raw)
}
