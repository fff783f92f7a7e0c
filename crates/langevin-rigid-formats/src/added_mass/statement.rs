//! What every output says of its numbers.

use serde::Serialize;

use super::Report;

/// The conventions of one output, in the order they are stated.
#[derive(Serialize)]
pub(super) struct Statement {
    #[serde(skip)]
    pub(super) title: String,
    pub(super) fluid: String,
    pub(super) axes: String,
    pub(super) reference_point: String,
    pub(super) order: String,
    pub(super) sign: String,
}

impl Statement {
    pub(super) fn new(report: &Report) -> Statement {
        let percent = 100.0 * report.error_estimate;
        Statement {
            title: format!(
                "Added mass of {}, estimated error {percent:.2} %",
                name(report)
            ),
            fluid: format!("{} kg/m^3, unbounded", report.fluid_density),
            axes: "those of the mesh".into(),
            reference_point: reference_point(report),
            order: "x, y, z, then rotation about x, y, z; kg, kg m, kg m^2".into(),
            sign: "positive: minus the force from rest per acceleration".into(),
        }
    }

    /// The lines of a comment, with more text under them.
    fn lines(self, more: &str) -> Vec<String> {
        let mut lines = vec![
            self.title,
            format!("fluid: {}", self.fluid),
            format!("axes: {}", self.axes),
            format!("reference point: {}", self.reference_point),
            format!("order: {}", self.order),
            format!("sign: {}", self.sign),
        ];
        lines.extend(more.lines().map(String::from));
        lines
    }

    /// As comment lines of Python and CSV.
    pub(super) fn hashed(self, more: &str) -> String {
        let comment = |line: &String| format!("{}\n", format!("# {line}").trim_end());
        self.lines(more).iter().map(comment).collect()
    }

    /// As one comment of XML.
    pub(super) fn xml(self, more: &str) -> String {
        let indented = |line: &String| format!("{}\n", format!("  {line}").trim_end());
        let lines: String = self.lines(more).iter().map(indented).collect();
        format!("<!--\n{lines}-->\n")
    }
}

/// The reference point and what it is.
fn reference_point(report: &Report) -> String {
    let place = point(report.reference);
    if report.reference == report.centroid {
        format!("{place}, the centroid of the volume")
    } else if report.reference == [0.0; 3] {
        format!("{place}, the origin of the mesh's coordinates")
    } else {
        place
    }
}

pub(super) fn point(p: [f64; 3]) -> String {
    format!("({:.6e}, {:.6e}, {:.6e}) m", p[0], p[1], p[2])
}

/// The name of the mesh, harmless in every comment: on one line, without the `--` that XML forbids.
fn name(report: &Report) -> String {
    let one_line = report.mesh.replace(char::is_control, " ");
    one_line.replace("--", "- -").replace("--", "- -")
}
