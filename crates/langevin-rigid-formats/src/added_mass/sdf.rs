//! SDFormat: `<fluid_added_mass>` of a link's `<inertial>`, about the link's origin.

use super::Report;
use super::statement::Statement;

/// The entries in SDFormat's names for the six motions.
const MOTIONS: [char; 6] = ['x', 'y', 'z', 'p', 'q', 'r'];

/// The tags of the hydrodynamics plugin for the diagonal.
const PLUGIN: [&str; 6] = ["xDotU", "yDotV", "zDotW", "kDotP", "mDotQ", "nDotR"];

/// `<fluid_added_mass>` with its 21 entries.
///
/// The tensor is about the origin of the mesh's coordinates, whatever the report's reference: the frame of
/// the mesh is taken to be that of the link.
pub fn sdf(report: &Report) -> String {
    let report = report.about([0.0; 3]);
    let mut out = Statement::new(&report).xml(&comment(&report)) + "<fluid_added_mass>\n";
    for (i, a) in MOTIONS.iter().enumerate() {
        for (j, b) in MOTIONS.iter().enumerate().skip(i) {
            out += &format!("  <{a}{b}>{:.9e}</{a}{b}>\n", report.added_mass[i][j]);
        }
    }
    out + "</fluid_added_mass>\n"
}

fn comment(report: &Report) -> String {
    let plugin = |range: std::ops::Range<usize>| {
        let tag = |i: usize| format!("<{0}>{1:.9e}</{0}>", PLUGIN[i], -report.added_mass[i][i]);
        range.map(tag).collect::<Vec<_>>().join(" ")
    };
    format!(
        "
For <link><inertial>, SDFormat 1.10 or later, where the mesh has the frame of the link. SDFormat wants
the tensor about the origin of the link, not about its centre of mass. Only Gazebo's DART engine uses it.
The hydrodynamics plugin must not add it again: give it <disable_added_mass> and <disable_coriolis>.
If the plugin is to have it instead, its signs are negative:
{}
{}",
        plugin(0..3),
        plugin(3..6)
    )
}
