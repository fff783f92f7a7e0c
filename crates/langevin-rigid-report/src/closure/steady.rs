//! Drag coefficients of the bake, beside those of measured bodies.

use langevin_rigid_bake::added_mass;
use langevin_rigid_bake::body::BodyBakeError;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::separation::pressure_drag;
use langevin_rigid_bake::shapes::Shape;
use langevin_rigid_scenes::baking::SceneBakeError;

use crate::error::ReportError;
use crate::options::Options;
use crate::section::Section;

const ALONG: [f64; 3] = [1.0, 0.0, 0.0];
const ACROSS: [f64; 3] = [0.0, 1.0, 0.0];

pub(super) fn steady(
    section: &mut Section,
    _: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("Pressure drag");
    section.text(
        "From the surface pressure of the baked potentials, about 1300 triangles, for Reynolds numbers of some thousands; \
         measured bodies at 1e3 to 1e5.",
    );
    let ellipsoid = |semi_axes| Shape::Ellipsoid { semi_axes };
    let plate = |size| Shape::Box { size };
    let disc = Shape::Disc {
        radius: 0.5,
        thickness: 0.085,
    };
    let cylinder = |height| Shape::Cylinder {
        radius: 0.5,
        height,
    };
    let bodies = [
        ("sphere", ellipsoid([0.5; 3]), ACROSS, "0.4 to 0.5"),
        (
            "disc, thickness 0.085 diameters",
            disc,
            ACROSS,
            "1.1 to 1.2",
        ),
        (
            "ellipsoid 1:1:0.05, broadside",
            ellipsoid([0.5, 0.025, 0.5]),
            ACROSS,
            "1.1 to 1.2",
        ),
        (
            "square plate, thickness 0.05",
            plate([1.0, 0.05, 1.0]),
            ACROSS,
            "1.1 to 1.2",
        ),
        ("cube, face on", plate([1.0; 3]), ACROSS, "1.05"),
        ("cylinder across, length 1", cylinder(1.0), ACROSS, "0.64"),
        ("cylinder across, length 10", cylinder(10.0), ACROSS, "0.82"),
        (
            "cylinder end on, length 1",
            cylinder(1.0),
            ALONG,
            "0.9 to 1.15",
        ),
        ("cylinder end on, length 10", cylinder(10.0), ALONG, "0.85"),
        (
            "ellipsoid 1:4, along its axis",
            ellipsoid([2.0, 0.5, 0.5]),
            ALONG,
            "below 0.15",
        ),
    ];
    let mut rows = Vec::new();
    for (name, shape, direction, measured) in bodies {
        let mesh = shape.mesh(1300).map_err(SceneBakeError::from)?;
        let options = added_mass::Options::default();
        let added = added_mass::added_mass(&mesh, &options, progress)
            .map_err(|error| SceneBakeError::from(BodyBakeError::from(error)))?;
        let drag = pressure_drag(&added, direction).coefficient;
        let here = section.quote(format!("steady.{name}"), drag, 2);
        rows.push(vec![name.to_owned(), here.to_string(), measured.to_owned()]);
    }
    let head = ["body", "drag coefficient here", "measured bodies"];
    section.table("steady", &head, &rows);
    Ok(())
}
