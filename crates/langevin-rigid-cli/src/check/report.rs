//! The report of `check`.

mod table;

use langevin_rigid_bake::added_mass::{Expected, Thinnest};
use langevin_rigid_bake::check::Checked;
use langevin_rigid_bake::mesh::{Component, Faults, Finding, Hole, Options};
use langevin_rigid_formats::mesh::{FileUnit, LengthUnit};
use serde::Serialize;

use crate::arguments::Check;
use crate::repair::{BalanceReport, StepReport};

/// Holes and components that are listed.
const LISTED: usize = 5;
/// The largest box of a body in air or water that is likely (m), and the smallest.
const LIKELY: [f64; 2] = [1e-3, 30.0];

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
    size_if_um: [f64; 3],
    size_if_in: [f64; 3],
    size_if_ft: [f64; 3],
    unit_hint: Option<String>,
    area: f64,
    /// Of the solid, without cavities; nothing while there are holes or parts meet.
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
    /// Triangles that pass through others or lie on them.
    meeting: usize,
    first_meeting: Option<[f64; 3]>,
    components: usize,
    largest_components: Vec<ComponentReport>,
    /// For people; scripts have the counts.
    #[serde(skip)]
    findings: Vec<Finding>,
    /// Of the mesh if it is ready, else of what the repair makes of it.
    expected: Option<ExpectedReport>,
    pub(super) ready: bool,
    fault: Option<String>,
    repair: Option<String>,
    /// The same, if the hole is the rim of a sheet.
    repair_of_sheet: Option<String>,
    repair_steps: Vec<StepReport>,
    repair_balance: Option<BalanceReport>,
    repair_warnings: Vec<String>,
    left: Option<String>,
}

#[derive(Serialize)]
struct HoleReport {
    edges: usize,
    perimeter: f64,
    centre: [f64; 3],
    #[serde(skip)]
    text: String,
}

#[derive(Serialize)]
struct ComponentReport {
    triangles: usize,
    area: f64,
    volume: Option<f64>,
    inside: Option<usize>,
    /// Whether it is the wall of a cavity.
    cavity: bool,
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
    pub(super) fn new(options: &Check, unit: FileUnit, checked: &Checked) -> Report {
        let Checked {
            survey,
            remedy,
            expected,
        } = checked;
        let size: [f64; 3] = std::array::from_fn(|k| survey.bounds[1][k] - survey.bounds[0][k]);
        let in_file = size.map(|x| x / unit.to_metres(1.0));
        let sizes = UNITS.map(|unit| in_file.map(|x| unit.to_metres(x)));
        let [m, cm, mm, um, inches, feet] = sizes;
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
            unit: unit.to_string(),
            size,
            size_if_m: m,
            size_if_cm: cm,
            size_if_mm: mm,
            size_if_um: um,
            size_if_in: inches,
            size_if_ft: feet,
            unit_hint: unit_hint(size, sizes),
            area: survey.area,
            volume: survey.closed_volume(),
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
            inside_out: survey.components.iter().any(Component::is_inside_out),
            one_sided: survey.one_sided.is_some(),
            non_manifold_edges,
            first_non_manifold_edge,
            non_manifold_vertices,
            first_non_manifold_vertex,
            meeting: survey.meeting.count,
            first_meeting: survey.meeting.first,
            components: survey.components.len(),
            largest_components: survey
                .components
                .iter()
                .take(LISTED)
                .map(ComponentReport::new)
                .collect(),
            findings: survey.findings(),
            ready: checked.ready(),
            fault: checked.fault(),
            expected: expected
                .as_ref()
                .and_then(|expected| expected.as_ref().ok())
                .map(ExpectedReport::new),
            repair: checked.repair().map(|repair| command(options, &repair)),
            repair_of_sheet: remedy.sheet.map(|repair| command(options, &repair)),
            repair_balance: remedy.balance.as_ref().map(BalanceReport::new),
            repair_warnings: remedy
                .balance
                .as_ref()
                .map_or_else(Vec::new, |balance| balance.warnings()),
            repair_steps: remedy.steps.iter().map(StepReport::new).collect(),
            left: remedy
                .options
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
            text: hole.to_string(),
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
            cavity: component.depth % 2 == 1,
        }
    }
}

impl ExpectedReport {
    fn new(foretold: &Expected) -> ExpectedReport {
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

/// In the order of the report.
const UNITS: [LengthUnit; 6] = [
    LengthUnit::M,
    LengthUnit::Cm,
    LengthUnit::Mm,
    LengthUnit::Um,
    LengthUnit::In,
    LengthUnit::Ft,
];

/// The unit in which the box has a likely size, where it has none in the unit given.
fn unit_hint(size: [f64; 3], others: [[f64; 3]; 6]) -> Option<String> {
    let likely = |size: &[f64; 3]| {
        let longest = size.iter().copied().fold(0.0, f64::max);
        (LIKELY[0]..=LIKELY[1]).contains(&longest)
    };
    if likely(&size) {
        return None;
    }
    // Millimetres are what programs write when they do not write metres.
    let unit = [0, 2, 1, 4, 5, 3]
        .into_iter()
        .find(|&k| likely(&others[k]))?;
    Some(format!(
        "give `--unit {}` if the box is right then",
        UNITS[unit]
    ))
}

/// The command line that mends the mesh.
fn command(options: &Check, repair: &Options) -> String {
    let unit = options.unit.map(|unit| format!(" --unit {unit}"));
    let unit = unit.unwrap_or_default();
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
    let flags = flags(repair);
    format!("langevin-rigid repair {mesh}{unit}{flags} --out {out}")
}

/// Options of `repair` as they are given to it.
fn flags(repair: &Options) -> String {
    let Options {
        weld,
        fill,
        thickness,
        triangles,
        wrap,
        largest,
    } = repair;
    [
        weld.map(|distance| format!(" --weld {distance}")),
        fill.map(|edges| format!(" --fill {edges}")),
        // Which, its owner knows.
        thickness.map(|_| " --thickness LENGTH".to_owned()),
        wrap.map(|size| format!(" --wrap {size}")),
        largest.then(|| " --largest".to_owned()),
        triangles.map(|count| format!(" --triangles {count}")),
    ]
    .into_iter()
    .flatten()
    .collect()
}
