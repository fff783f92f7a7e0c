//! Added mass of bodies whose tensor is known, and of cones of ever more needles.

use std::f64::consts::TAU;
use std::ops::Range;

use langevin_rigid::{Body, SetupError};
use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::{self, AddedMass};
use langevin_rigid_bake::body::BodyBakeError;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::shapes::Shape;
use langevin_rigid_scenes::baking::SceneBakeError;

use crate::error::ReportError;
use crate::references::{CUBE, PLATES, PRISMS};
use crate::section::Section;

/// Name, semi-axes (m), triangles.
const ELLIPSOIDS: [(&str, [f64; 3], usize); 6] = [
    ("1 : 2 : 4", [1.0, 2.0, 4.0], 320),
    ("1 : 2 : 4", [1.0, 2.0, 4.0], 1280),
    ("1 : 2 : 4", [1.0, 2.0, 4.0], 5120),
    ("4 : 1 : .5", [4.0, 1.0, 0.5], 1280),
    ("4 : 1 : .005", [4.0, 1.0, 0.005], 1280),
    ("4 : 1 : .005", [4.0, 1.0, 0.005], 5120),
];

/// Needles around the cone.
const CONES: [u32; 3] = [100, 500, 5000];

/// Ellipsoids against Lamb's closed forms.
pub(super) fn ellipsoids(
    section: &mut Section,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("Ellipsoids");
    section.text(
        "Against Lamb (<i>Hydrodynamics</i>, 1932, articles 114 and 115), on meshes of the ellipsoid's volume:",
    );
    let mut rows = Vec::new();
    for (name, semi_axes, triangles) in ELLIPSOIDS {
        let lamb = Body::ellipsoid(semi_axes, 1.0).map_err(SetupError::from)?;
        let found = solve(&mesh(&Shape::Ellipsoid { semi_axes }, triangles)?, progress)?;
        let mut row = vec![name.to_owned(), triangles.to_string()];
        for (motion, entries) in [("translation", 0..3), ("rotation", 3..6)] {
            let errors: Vec<String> = entries
                .map(|i| {
                    let error = percent(found.tensor[i][i], lamb.added_mass[i][i]);
                    let key = format!("ellipsoid.{name}.{triangles}.{motion}.{}", i % 3);
                    section.quote(key, error, 2).to_string()
                })
                .collect();
            row.push(errors.join(" "));
        }
        rows.push(row);
    }
    let head = ["ellipsoid", "triangles", "translation", "rotation"];
    section.table("ellipsoids", &head, &rows);
    Ok(())
}

/// A box, the triangles it is given, and what entries of the diagonal are to be.
struct Edged {
    name: String,
    size: [f64; 3],
    triangles: usize,
    translation: (Range<usize>, f64),
    rotation: Option<(Range<usize>, f64)>,
}

impl Edged {
    fn cube(triangles: usize) -> Self {
        Self {
            name: "cube".to_owned(),
            size: [1.0; 3],
            triangles,
            translation: (0..3, CUBE[0]),
            rotation: Some((3..6, CUBE[1])),
        }
    }

    fn plate([thickness, broadside, turning]: [f64; 3], triangles: usize) -> Self {
        Self {
            name: format!(
                "square plate, thickness 1/{:.0}, broadside",
                1.0 / thickness
            ),
            size: [1.0, thickness, 1.0],
            triangles,
            translation: (1..2, broadside),
            rotation: Some((3..4, turning)),
        }
    }

    fn prism([length, axial]: [f64; 2]) -> Self {
        Self {
            name: format!("square prism, length {length}, axial"),
            size: [length, 1.0, 1.0],
            triangles: 12,
            translation: (0..1, axial * length),
            rotation: None,
        }
    }
}

/// Boxes against extrapolated values.
pub(super) fn edges(section: &mut Section, progress: &dyn Progress) -> Result<(), ReportError> {
    section.heading("Bodies with edges");
    section.text("Against values extrapolated from meshes that are graded towards the edges:");
    let [plate, sheet] = PLATES;
    let boxes = [
        Edged::cube(1200),
        Edged::cube(12),
        Edged::plate(plate, 2112),
        Edged::plate(plate, 12),
        Edged::plate(sheet, 2112),
    ];
    let mut rows = Vec::new();
    for edged in boxes.into_iter().chain(PRISMS.map(Edged::prism)) {
        let mesh = mesh(&Shape::Box { size: edged.size }, edged.triangles)?;
        let found = solve(&mesh, progress)?;
        let key = format!("box.{}.{}", edged.name, edged.triangles);
        let triangles = triangles(section, &key, &found);
        let mut compared = |motion: &str, (entries, wanted): (Range<usize>, f64)| {
            let errors: Vec<String> = entries
                .map(|i| {
                    let error = percent(found.tensor[i][i], wanted);
                    let key = format!("{key}.{motion}.{}", i % 3);
                    section.quote(key, error, 2).to_string()
                })
                .collect();
            let wanted = section.quote(format!("{key}.{motion}.wanted"), wanted, 4);
            [wanted.to_string(), errors.join(" ")]
        };
        let [moving, translation] = compared("translation", edged.translation);
        let [turning, rotation] = match edged.rotation {
            Some(entry) => compared("rotation", entry),
            None => Default::default(),
        };
        let wanted = [moving, turning].join(" ");
        let wanted = wanted.trim_end().to_owned();
        rows.push(vec![edged.name, triangles, wanted, translation, rotation]);
    }
    let head = [
        "body",
        "triangles given, solved on",
        "compared with",
        "translation",
        "rotation",
    ];
    section.table("edges", &head, &rows);
    Ok(())
}

/// Cones of needles that crowd: what they give must not depend on their number.
pub(super) fn cones(section: &mut Section, progress: &dyn Progress) -> Result<(), ReportError> {
    section.heading("Cones of needles");
    section.text("Radius and height of 1 m; added mass per density of the fluid, and the error that it states itself:");
    let mut rows = Vec::new();
    for needles in CONES {
        let found = solve(&cone(needles)?, progress)?;
        let key = format!("cone.{needles}");
        let triangles = triangles(section, &key, &found);
        let axial = section.quote(format!("{key}.axial"), found.tensor[2][2], 5);
        let across = section.quote(format!("{key}.across"), found.tensor[0][0], 5);
        let estimate = 100.0 * found.error_estimate;
        let estimate = section.quote(format!("{key}.estimate"), estimate, 2);
        rows.push(vec![
            format!("{needles} needles"),
            triangles,
            format!("{axial} {across} {estimate} %"),
        ]);
    }
    let head = [
        "cone",
        "triangles given, solved on",
        "axial, across, estimate",
    ];
    section.table("cones", &head, &rows);
    Ok(())
}

/// A cone of radius and height 1 along Z, with so many triangles from its rim to its tip.
fn cone(needles: u32) -> Result<TriMesh, ReportError> {
    let rim = (0..needles).map(|i| {
        let angle = TAU * f64::from(i) / f64::from(needles);
        [libm::cos(angle), libm::sin(angle), 0.0]
    });
    let vertices = [[0.0; 3], [0.0, 0.0, 1.0]].into_iter().chain(rim).collect();
    let at = |i: u32| 2 + i % needles;
    let triangles = (0..needles).flat_map(|i| [[0, at(i + 1), at(i)], [1, at(i), at(i + 1)]]);
    TriMesh::new(vertices, triangles.collect()).map_err(|error| {
        let source_name = format!("cone of {needles} needles");
        SceneBakeError::Mesh { source_name, error }.into()
    })
}

fn mesh(shape: &Shape, triangles: usize) -> Result<TriMesh, ReportError> {
    Ok(shape.mesh(triangles).map_err(SceneBakeError::from)?)
}

fn solve(mesh: &TriMesh, progress: &dyn Progress) -> Result<AddedMass, ReportError> {
    added_mass::added_mass(mesh, &added_mass::Options::default(), progress)
        .map_err(|error| SceneBakeError::from(BodyBakeError::from(error)).into())
}

/// Triangles given and solved on.
fn triangles(section: &mut Section, key: &str, found: &AddedMass) -> String {
    let quality = &found.quality;
    let given = section.quote(format!("{key}.given"), quality.triangles_given as f64, 0);
    let solved = section.quote(format!("{key}.solved"), quality.triangles_solved as f64, 0);
    format!("{given}, {solved}")
}

fn percent(found: f64, wanted: f64) -> f64 {
    100.0 * (found / wanted - 1.0)
}
