//! Lengths that may be shares of the size of a mesh.

use langevin_rigid_bake::mesh::diagonal;
use langevin_rigid_formats::mesh::RawMesh;

use crate::arguments::positive;

#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Size {
    /// In metres.
    Length(f64),
    /// Of the diagonal of the mesh's box.
    Share(f64),
}

impl Size {
    /// In metres. That of a mesh without size is none, as the mesh is.
    pub(crate) fn of(self, mesh: &RawMesh) -> f64 {
        match self {
            Size::Length(length) => length,
            Size::Share(share) => share * diagonal(&mesh.vertices, &mesh.triangles),
        }
    }
}

/// A length in metres, or a share such as `2%`.
pub(crate) fn size(text: &str) -> Result<Size, String> {
    let Some(percent) = text.strip_suffix('%') else {
        return positive(text).map(Size::Length).map_err(|_| wanted());
    };
    match positive(percent.trim_end()) {
        Ok(percent) if percent <= 100.0 => Ok(Size::Share(percent / 100.0)),
        _ => Err(wanted()),
    }
}

fn wanted() -> String {
    "it must be a positive length in m, or a share of the diagonal of the mesh's box such as 2%"
        .into()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lengths_and_shares_are_told_apart() {
        assert_eq!(size("0.02"), Ok(Size::Length(0.02)));
        assert_eq!(size("2%"), Ok(Size::Share(0.02)));
        assert_eq!(size("2.5 %"), Ok(Size::Share(0.025)));
        for text in [
            "", "%", "-1%", "0%", "101%", "nan%", "inf", "2%%", "2 m", "0",
        ] {
            assert!(size(text).is_err(), "{text}");
        }
    }
}
