//! UUV Simulator and DAVE: `<hydrodynamic_model>` of type `fossen`.

use super::statement::{Statement, point};
use super::{Report, row};

/// What turning x forward, y left, z up into x forward, y right, z down does to each motion.
const TURN: [f64; 6] = [1.0, -1.0, -1.0, 1.0, -1.0, -1.0];

/// `<hydrodynamic_model>` with the 36 entries, about the origin of the mesh's coordinates.
///
/// The plugin turns velocities to axes with y right and z down before it multiplies, and turns the forces
/// back: entries that couple x or roll with another motion than these change sign, the diagonal does not.
pub fn uuv(report: &Report) -> String {
    let report = report.about([0.0; 3]);
    let turned = |i: usize| -> [f64; 6] {
        // Adding zero leaves no negative zeros.
        std::array::from_fn(|j| TURN[i] * TURN[j] * report.added_mass[i][j] + 0.0)
    };
    let rows: String = (0..6)
        .map(|i| format!("    {}\n", row(&turned(i), " ")))
        .collect();
    comment(&report)
        + "<hydrodynamic_model>\n  <type>fossen</type>\n  <added_mass>\n"
        + &rows
        + "  </added_mass>\n</hydrodynamic_model>\n"
}

fn comment(report: &Report) -> String {
    let axes =
        "x of the mesh; y and z of the mesh reversed, as the plugin reverses them itself".into();
    let stated = Statement {
        axes,
        ..Statement::new(report)
    };
    let (volume, centre) = (report.volume, point(report.centroid));
    stated.xml(&format!(
        "
For a <link> of libuuv_underwater_object_ros_plugin.so (UUV Simulator, and DAVE on top of it), where the
mesh has the frame of the link. The plugin takes the velocity at the link's origin and applies the force at
the centre of mass: exact where the two are one point.
<volume>{volume:.9e}</volume>, center_of_buoyancy {centre}"
    ))
}
