//! Files that are dropped onto the page.

use std::path::Path;

use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::mesh::{Options, Step, Unrepaired, repair};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::mesh::{
    LengthUnit, ParseError, RawMesh, ReadError, read_mesh, write_obj,
};
use serde::Serialize;

/// A body whose largest side is longer (m) is taken to be drawn in centimetres, and beyond the next in millimetres, where
/// its file does not tell.
const LONG: f64 = 5.0;
const VERY_LONG: f64 = 50.0;

/// A mesh that can be baked.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Checked {
    /// Its triangles.
    pub triangles: usize,
    /// Sides of its box (m).
    pub size: [f64; 3],
    /// The unit that its lengths were taken to be in, by its symbol.
    pub unit: String,
    /// Whether the file does not tell the unit, so that it may be another.
    pub unit_guessed: bool,
    /// What was mended, a sentence each; empty of a mesh that is used as it is.
    pub mended: Vec<String>,
    /// What else there is to know.
    pub notices: Vec<String>,
    /// The mended mesh as OBJ in metres.
    #[serde(skip)]
    pub obj: Option<Vec<u8>>,
}

/// Why a mesh cannot be baked.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum MeshTrouble {
    /// The file is no mesh.
    #[error(transparent)]
    Read(#[from] ReadError),
    /// It is open.
    #[error(
        "the surface is open: {} {perimeter:.4} m around; a sheet (paper, leaf, shell) needs a thickness, other holes are \
         closed in the program that made the mesh",
        match holes {
            1 => "a hole".to_owned(),
            holes => format!("{holes} holes, the largest"),
        }
    )]
    Open {
        /// How many holes are left.
        holes: usize,
        /// Perimeter of the largest (m).
        perimeter: f64,
    },
    /// It could not be mended.
    #[error("it could not be mended: {0}")]
    Unmended(Unrepaired),
    /// It was mended, and could not be written.
    #[error("the mended mesh could not be written: {0}")]
    Write(#[from] std::io::Error),
}

/// Reads the mesh at `path`, with lengths in `unit` where that is known, and mends it if it is no closed body; an open
/// sheet is given a `thickness` (m).
///
/// # Errors
/// [`MeshTrouble`].
pub fn check(
    path: &Path,
    unit: Option<LengthUnit>,
    thickness: Option<f64>,
    progress: &dyn Progress,
) -> Result<Checked, MeshTrouble> {
    let (raw, unit_guessed) = read(path, unit)?;
    let (unit, notices) = (raw.unit.to_string(), raw.notices.clone());
    let checked = |body: &TriMesh, mended, obj| Checked {
        triangles: body.triangles().len(),
        size: size(body.vertices()),
        unit,
        unit_guessed,
        mended,
        notices,
        obj,
    };
    if let Ok(body) = raw.clone().body() {
        return Ok(checked(&body, Vec::new(), None));
    }
    let options = Options {
        thickness,
        ..Options::default()
    };
    let repaired = repair(&raw.vertices, &raw.triangles, &options, progress);
    let body = repaired.body.map_err(|why| match why {
        Unrepaired::Open { count, largest } => MeshTrouble::Open {
            holes: count,
            perimeter: largest.perimeter,
        },
        why => MeshTrouble::Unmended(why),
    })?;
    let steps = repaired.steps.iter().map(Step::to_string);
    let warnings = repaired
        .balance
        .iter()
        .flat_map(|balance| balance.warnings());
    let mended = steps.chain(warnings).collect();
    let mut obj = Vec::new();
    write_obj(&body, &mut obj)?;
    Ok(checked(&body, mended, Some(obj)))
}

/// The triangles, in metres, and whether their unit was guessed.
fn read(path: &Path, unit: Option<LengthUnit>) -> Result<(RawMesh, bool), ReadError> {
    let in_metres = match read_mesh(path, unit) {
        Err(ReadError::Parse {
            error: ParseError::NoUnit,
            ..
        }) => read_mesh(path, Some(LengthUnit::M))?,
        read => return Ok((read?, false)),
    };
    let longest = size(&in_metres.vertices).into_iter().fold(0.0, f64::max);
    let guess = match longest {
        length if length > VERY_LONG => LengthUnit::Mm,
        length if length > LONG => LengthUnit::Cm,
        _ => return Ok((in_metres, true)),
    };
    Ok((read_mesh(path, Some(guess))?, true))
}

/// Sides of the box around points.
fn size(points: &[[f64; 3]]) -> [f64; 3] {
    std::array::from_fn(|axis| {
        let along = points.iter().map(|point| point[axis]);
        let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
            (low.min(x), high.max(x))
        });
        high - low
    })
}

#[cfg(test)]
mod tests {
    use langevin_rigid_bake::shapes::Shape;

    use super::*;

    fn file(mesh: &TriMesh, scale: f64, without: usize) -> tempfile::NamedTempFile {
        let file = tempfile::Builder::new().suffix(".obj").tempfile().unwrap();
        let mut text = String::new();
        for [x, y, z] in mesh.vertices() {
            text += &format!("v {} {} {}\n", x * scale, y * scale, z * scale);
        }
        for [a, b, c] in &mesh.triangles()[without..] {
            text += &format!("f {} {} {}\n", a + 1, b + 1, c + 1);
        }
        std::fs::write(file.path(), text).unwrap();
        file
    }

    fn card() -> TriMesh {
        Shape::Box {
            size: [0.08, 0.01, 0.05],
        }
        .mesh(300)
        .unwrap()
    }

    #[test]
    fn a_closed_body_is_used_as_it_is_and_its_unit_is_guessed() {
        for (scale, unit) in [(1.0, "m"), (1000.0, "mm"), (100.0, "cm")] {
            let file = file(&card(), scale, 0);
            let checked = check(file.path(), None, None, &()).unwrap();
            assert_eq!((checked.unit.as_str(), checked.unit_guessed), (unit, true));
            assert!(checked.mended.is_empty() && checked.obj.is_none());
            assert!((checked.size[0] - 0.08).abs() < 1e-12, "{:?}", checked.size);
        }
        let told = file(&card(), 10.0, 0);
        let checked = check(told.path(), Some(LengthUnit::Mm), None, &()).unwrap();
        assert!(!checked.unit_guessed && (checked.size[0] - 8e-4).abs() < 1e-12);
    }

    #[test]
    fn a_hole_is_mended_and_said() {
        let file = file(&card(), 1.0, 1);
        let checked = check(file.path(), None, None, &()).unwrap();
        assert!(checked.mended[0].contains("hole"), "{:?}", checked.mended);
        let obj = checked.obj.unwrap();
        let again = tempfile::Builder::new().suffix(".obj").tempfile().unwrap();
        std::fs::write(again.path(), obj).unwrap();
        let again = check(again.path(), Some(LengthUnit::M), None, &()).unwrap();
        assert!(again.mended.is_empty());
        assert_eq!(again.triangles, card().triangles().len());
    }

    #[test]
    fn a_sheet_wants_a_thickness() {
        let sheet = tempfile::Builder::new().suffix(".obj").tempfile().unwrap();
        std::fs::write(
            sheet.path(),
            "v 0 0 0\nv 0.1 0 0\nv 0.1 0 0.05\nv 0 0 0.05\nf 1 2 3 4\n",
        )
        .unwrap();
        let trouble = check(sheet.path(), None, None, &()).unwrap_err();
        assert!(
            matches!(trouble, MeshTrouble::Open { holes: 1, .. }),
            "{trouble}"
        );
        let checked = check(sheet.path(), None, Some(1e-3), &()).unwrap();
        assert!((checked.size[1] - 1e-3).abs() < 1e-9, "{:?}", checked.size);
    }

    #[test]
    fn what_is_no_mesh_says_so() {
        let text = tempfile::Builder::new().suffix(".obj").tempfile().unwrap();
        std::fs::write(text.path(), "a letter").unwrap();
        let trouble = check(text.path(), None, None, &()).unwrap_err().to_string();
        assert!(trouble.contains("obj"), "{trouble}");
    }
}
