//! The report of `check`.

use std::fmt::Write as _;

use langevin_rigid_bake::added_mass::{AddedMassError, Expected, Options, Thinnest, expected};
use langevin_rigid_bake::mesh::{Component, Faults, Hole, Survey};
use serde::Serialize;

use super::remedy::Remedy;
use crate::arguments::Check;
use crate::repair::StepReport;

/// Holes and components that are listed.
const LISTED: usize = 5;
/// The largest box of a body in air or water that is likely (m), and the smallest.
const LIKELY: [f64; 2] = [1e-3, 30.0];
/// What makes a body of too many triangles ready.
const FEWER: &str = " --triangles 100000";
/// Walls thinner than this beside their triangles make `added-mass` warn.
const THIN: f64 = 0.02;

/// The JSON keys are a contract with scripts; lengths in metres.
#[derive(Serialize)]
pub(super) struct Report {
    file: String,
    triangles: usize,
    vertices: usize,
    unit: String,
    size: [f64; 3],
    /// The same box, were the file in another unit.
    size_if_m: [f64; 3],
    size_if_cm: [f64; 3],
    size_if_mm: [f64; 3],
    unit_hint: Option<String>,
    area: f64,
    /// Nothing while there are holes.
    volume: Option<f64>,
    holes: usize,
    largest_holes: Vec<HoleReport>,
    unusable: usize,
    unused_vertices: usize,
    degenerate: usize,
    duplicates: usize,
    unwelded: usize,
    unwelded_distance: f64,
    weld_tolerance: f64,
    flipped: usize,
    inside_out: bool,
    one_sided: bool,
    non_manifold_edges: usize,
    first_non_manifold_edge: Option<[f64; 3]>,
    non_manifold_vertices: usize,
    first_non_manifold_vertex: Option<[f64; 3]>,
    components: usize,
    largest_components: Vec<ComponentReport>,
    /// Of the mesh if it is ready, else of what the repair makes of it.
    expected: Option<ExpectedReport>,
    pub(super) ready: bool,
    fault: Option<String>,
    repair: Option<String>,
    /// The same, if the hole is the rim of a sheet.
    repair_of_sheet: Option<String>,
    repair_steps: Vec<StepReport>,
    left: Option<String>,
}

#[derive(Serialize)]
struct HoleReport {
    edges: usize,
    perimeter: f64,
    centre: [f64; 3],
}

#[derive(Serialize)]
struct ComponentReport {
    triangles: usize,
    area: f64,
    volume: Option<f64>,
    inside: Option<usize>,
}

#[derive(Serialize)]
struct ExpectedReport {
    triangles_solved: usize,
    error_estimate: f64,
    seconds: f64,
    thinnest_wall: Option<f64>,
    thinnest_wall_over_edge: Option<f64>,
    thinnest_wall_at: Option<[f64; 3]>,
}

impl Report {
    pub(super) fn new(options: &Check, survey: &Survey, remedy: &Remedy) -> Report {
        let size: [f64; 3] = std::array::from_fn(|k| survey.bounds[1][k] - survey.bounds[0][k]);
        let in_file = size.map(|x| x / options.unit.to_metres(1.0));
        let [m, cm, mm] = [1.0, 1e-2, 1e-3].map(|unit| in_file.map(|x| x * unit));
        let body = survey.body.as_ref().ok().or(remedy.body.as_ref());
        let foretold = body.map(|body| expected(body, &Options::default()));
        let too_large = foretold.as_ref().is_some_and(Result::is_err);
        let fewer = if too_large { FEWER } else { "" };
        let flags = remedy.flags.clone().or(too_large.then(String::new));
        let closed = survey.holes.is_empty() && survey.non_manifold_edges.count == 0;
        let Faults {
            count: non_manifold_edges,
            first: first_non_manifold_edge,
        } = survey.non_manifold_edges;
        let Faults {
            count: non_manifold_vertices,
            first: first_non_manifold_vertex,
        } = survey.non_manifold_vertices;
        Report {
            file: options.mesh.display().to_string(),
            triangles: survey.triangles,
            vertices: survey.vertices,
            unit: options.unit.to_string(),
            size,
            size_if_m: m,
            size_if_cm: cm,
            size_if_mm: mm,
            unit_hint: unit_hint(size, [m, cm, mm]),
            area: survey.area,
            volume: closed.then_some(survey.volume),
            holes: survey.holes.len(),
            largest_holes: survey
                .holes
                .iter()
                .take(LISTED)
                .map(HoleReport::new)
                .collect(),
            unusable: survey.unusable,
            unused_vertices: survey.unused_vertices,
            degenerate: survey.degenerate,
            duplicates: survey.duplicates,
            unwelded: survey.seams.vertices,
            unwelded_distance: survey.seams.distance,
            weld_tolerance: survey.seams.tolerance,
            flipped: survey.flipped,
            inside_out: survey
                .components
                .iter()
                .any(|c| c.volume.is_some_and(|v| v < 0.0)),
            one_sided: survey.one_sided.is_some(),
            non_manifold_edges,
            first_non_manifold_edge,
            non_manifold_vertices,
            first_non_manifold_vertex,
            components: survey.components.len(),
            largest_components: survey
                .components
                .iter()
                .take(LISTED)
                .map(ComponentReport::new)
                .collect(),
            ready: survey.body.is_ok() && !too_large,
            fault: fault(survey, &foretold),
            expected: foretold.and_then(Result::ok).map(ExpectedReport::new),
            repair: flags.map(|flags| command(options, &(flags + fewer))),
            repair_of_sheet: remedy
                .sheet_flags
                .as_ref()
                .map(|flags| command(options, flags)),
            repair_steps: remedy.steps.iter().map(StepReport::new).collect(),
            left: remedy
                .flags
                .is_none()
                .then(|| remedy.left.as_ref().map(ToString::to_string))
                .flatten(),
        }
    }
}

impl HoleReport {
    fn new(hole: &Hole) -> HoleReport {
        HoleReport {
            edges: hole.edges,
            perimeter: hole.perimeter,
            centre: hole.centre,
        }
    }
}

impl ComponentReport {
    fn new(component: &Component) -> ComponentReport {
        ComponentReport {
            triangles: component.triangles,
            area: component.area,
            volume: component.volume,
            inside: component.inside,
        }
    }
}

impl ExpectedReport {
    fn new(foretold: Expected) -> ExpectedReport {
        let wall = |f: fn(Thinnest) -> f64| foretold.thinnest.map(f);
        ExpectedReport {
            triangles_solved: foretold.triangles_solved,
            error_estimate: foretold.error_estimate,
            seconds: foretold.seconds,
            thinnest_wall: wall(|t| t.thickness),
            thinnest_wall_over_edge: wall(|t| t.ratio),
            thinnest_wall_at: foretold.thinnest.map(|t| t.position),
        }
    }
}

/// Why the mesh is not ready, at first sight.
fn fault(survey: &Survey, foretold: &Option<Result<Expected, AddedMassError>>) -> Option<String> {
    let of_body = survey.body.as_ref().err().map(ToString::to_string);
    let of_size = foretold.as_ref().and_then(|f| f.as_ref().err());
    of_body.or(of_size.map(ToString::to_string))
}

/// The unit in which the box has a likely size, where it has none in the unit given.
fn unit_hint(size: [f64; 3], others: [[f64; 3]; 3]) -> Option<String> {
    let likely = |size: &[f64; 3]| {
        let longest = size.iter().copied().fold(0.0, f64::max);
        LIKELY[0] <= longest && longest <= LIKELY[1]
    };
    if likely(&size) {
        return None;
    }
    let names = ["m", "cm", "mm"];
    // Millimetres are what programs write when they do not write metres.
    let unit = [0, 2, 1].into_iter().find(|&k| likely(&others[k]))?;
    Some(format!(
        "give `--unit {}` if the box is right then",
        names[unit]
    ))
}

/// The command line that mends the mesh.
fn command(options: &Check, flags: &str) -> String {
    let unit = match options.unit.to_string().as_str() {
        "m" => String::new(),
        unit => format!(" --unit {unit}"),
    };
    let stem = options.mesh.file_stem().unwrap_or_default();
    let [mesh, out] = [
        options.mesh.display().to_string(),
        format!("{}-repaired.obj", stem.to_string_lossy()),
    ]
    .map(
        |name| match name.contains(|c: char| c.is_whitespace() || "'\"&;()$`".contains(c)) {
            true => format!("'{}'", name.replace('\'', r"'\''")),
            false => name,
        },
    );
    format!("langevin-rigid repair {mesh}{unit}{flags} --out {out}")
}

impl Report {
    pub(super) fn table(&self) -> String {
        let mut out = String::new();
        // Writing to a string cannot fail.
        let mut line = |name: &str, value: String| {
            let _ = writeln!(out, "{name:<16}{value}");
        };
        line("file", self.file.clone());
        line(
            "triangles",
            format!("{} over {} vertices", self.triangles, self.vertices),
        );
        line(
            "box",
            format!("{} m in the unit `{}`", box_of(self.size), self.unit),
        );
        if let Some(hint) = &self.unit_hint {
            line(
                "",
                "which is no likely size of a body in air or water".into(),
            );
            for (unit, size) in [
                ("m", self.size_if_m),
                ("cm", self.size_if_cm),
                ("mm", self.size_if_mm),
            ] {
                line("", format!("{} m if it is in `{unit}`", box_of(size)));
            }
            line("", hint.clone());
        }
        line("area", format!("{:.6e} m^2", self.area));
        line(
            "volume",
            match self.volume {
                Some(volume) => format!("{volume:.6e} m^3"),
                None => "has no meaning while the surface is not closed".into(),
            },
        );
        self.faults(&mut line);
        self.parts(&mut line);
        line("intersections", "not looked for".into());
        self.outlook(&mut line);
        self.verdict(&mut line);
        out
    }

    fn faults(&self, line: &mut impl FnMut(&str, String)) {
        line("holes", self.holes.to_string());
        for hole in &self.largest_holes {
            let HoleReport {
                edges,
                perimeter,
                centre,
            } = hole;
            line(
                "",
                format!("{edges} edges, {perimeter:.4e} m around {}", point(*centre)),
            );
        }
        let mut fault = |name: &str, count: usize, what: String| {
            line(
                name,
                if count == 0 {
                    "none".into()
                } else {
                    format!("{count} {what}")
                },
            );
        };
        let first = |at: Option<[f64; 3]>| at.map(|p| format!(", the first at {}", point(p)));
        fault(
            "unusable",
            self.unusable,
            "triangles, with coordinates or vertices that are none".into(),
        );
        fault(
            "unused",
            self.unused_vertices,
            "vertices of no triangle".into(),
        );
        fault(
            "degenerate",
            self.degenerate,
            "triangles without area".into(),
        );
        fault(
            "duplicate",
            self.duplicates,
            "triangles that repeat another".into(),
        );
        let (distance, tolerance) = (self.unwelded_distance, self.weld_tolerance);
        let seam = format!(
            "vertices within {distance:.1e} m of another (looked within {tolerance:.1e} m)"
        );
        fault("unwelded", self.unwelded, seam);
        fault(
            "flipped",
            self.flipped,
            "triangles wind unlike their neighbours".into(),
        );
        let edge = first(self.first_non_manifold_edge).unwrap_or_default();
        let vertex = first(self.first_non_manifold_vertex).unwrap_or_default();
        fault(
            "non-manifold",
            self.non_manifold_edges,
            format!("edges of more than two triangles{edge}"),
        );
        fault(
            "pinched",
            self.non_manifold_vertices,
            format!("vertices where parts touch{vertex}"),
        );
        if self.inside_out {
            line("inside out", "yes; that is mended on the way".into());
        }
        if self.one_sided {
            line("one-sided", "yes, like a Möbius strip".into());
        }
    }

    fn parts(&self, line: &mut impl FnMut(&str, String)) {
        line("components", self.components.to_string());
        if self.components < 2 {
            return;
        }
        for (place, part) in self.largest_components.iter().enumerate() {
            let volume = match part.volume {
                Some(volume) => format!("{volume:.4e} m^3"),
                None => "open".into(),
            };
            let inside = part.inside.map(|k| format!(", inside component {}", k + 1));
            let (n, inside) = (part.triangles, inside.unwrap_or_default());
            line(
                "",
                format!("{}: {n} triangles, {volume}{inside}", place + 1),
            );
        }
        let more = self.components - self.largest_components.len();
        if more > 0 {
            line("", format!("and {more} of less surface"));
        }
    }

    fn outlook(&self, line: &mut impl FnMut(&str, String)) {
        let Some(expected) = &self.expected else {
            return;
        };
        if let (Some(wall), Some(ratio), Some(at)) = (
            expected.thinnest_wall,
            expected.thinnest_wall_over_edge,
            expected.thinnest_wall_at,
        ) {
            let warning = if ratio < THIN {
                ", too thin for them"
            } else {
                ""
            };
            line(
                "thin parts",
                format!(
                    "{wall:.2e} m at {}, {ratio:.2} of its triangles' edges{warning}",
                    point(at)
                ),
            );
        } else {
            line(
                "thin parts",
                "none thinner than its triangles are long".into(),
            );
        }
        let when = if self.ready { "" } else { ", once repaired" };
        line(
            "added-mass",
            format!(
                "about {:.1} s for an error of about {:.2} % on {} triangles{when}",
                expected.seconds,
                100.0 * expected.error_estimate,
                expected.triangles_solved
            ),
        );
    }

    fn verdict(&self, line: &mut impl FnMut(&str, String)) {
        if self.ready {
            line("verdict", "ready".into());
            return;
        }
        line("verdict", "not ready".into());
        line("at first sight", self.fault.clone().unwrap_or_default());
        if let Some(command) = &self.repair {
            line("repair", command.clone());
            for step in &self.repair_steps {
                line("", step.text().to_owned());
            }
        }
        if let Some(command) = &self.repair_of_sheet {
            line("or, as a sheet", command.clone());
        }
        if let Some(left) = &self.left {
            line("left to do", left.clone());
        }
    }
}

fn point([x, y, z]: [f64; 3]) -> String {
    format!("({x:.4}, {y:.4}, {z:.4}) m")
}

fn box_of([x, y, z]: [f64; 3]) -> String {
    format!("{x:.4} x {y:.4} x {z:.4}")
}
