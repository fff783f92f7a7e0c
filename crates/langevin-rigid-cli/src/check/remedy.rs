//! Which repair mends a mesh: each is tried.

use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::mesh::{Balance, Options, Step, Survey, Unrepaired, fitting_wrap, repair};
use langevin_rigid_formats::mesh::RawMesh;

use crate::bars::Bars;

/// Thickness of a sheet that is tried, as a share of the diagonal of its box.
const TRIED_THICKNESS: f64 = 1e-3;

/// Share of the area below which a component is debris.
const DEBRIS: f64 = 0.01;

/// The options of `repair` that make a body of the mesh, and that body.
#[derive(Default)]
pub(super) struct Remedy {
    pub(super) flags: Option<String>,
    /// Those for a sheet, where the first are for a solid with a hole.
    pub(super) sheet_flags: Option<String>,
    pub(super) steps: Vec<Step>,
    pub(super) body: Option<TriMesh>,
    /// What is lost and made on the way to it.
    pub(super) balance: Option<Balance>,
    /// Why the mildest repair gives none.
    pub(super) left: Option<Unrepaired>,
}

impl Remedy {
    /// The first of some repairs that works, from the mildest on; beside a hole to fill, also the first that
    /// reads it as the rim of a sheet.
    pub(super) fn find(raw: &RawMesh, survey: &Survey, bars: &Bars) -> Remedy {
        let mut remedy = Remedy::default();
        let of_debris = others_are_debris(survey);
        for (flags, options) in tries(survey) {
            let is_sheet = options.thickness.is_some();
            // A wrap is the last resort.
            if (remedy.flags.is_some() && !is_sheet) || bars.interrupted() {
                continue;
            }
            let repaired = repair(&raw.vertices, &raw.triangles, &options, bars);
            match repaired.body {
                Err(error) => {
                    remedy.left.get_or_insert(error);
                    continue;
                }
                // Debris that meets the body is dropped rather than wrapped with it.
                Ok(_) if !options.largest && of_debris && wrapped_unasked(&repaired.steps) => {
                    continue;
                }
                Ok(_) if remedy.flags.is_some() => remedy.sheet_flags = Some(flags),
                Ok(body) => {
                    remedy.flags = Some(flags);
                    remedy.steps = repaired.steps;
                    remedy.balance = repaired.balance.filter(|_| !is_sheet);
                    // A sheet's thickness is for its owner to say, and so is what comes of it.
                    remedy.body = Some(body).filter(|_| !is_sheet);
                    if options.fill.is_some() {
                        continue;
                    }
                }
            }
            break;
        }
        remedy
    }
}

/// Repairs to try, and how they are asked for.
fn tries(survey: &Survey) -> Vec<(String, Options)> {
    let [low, high] = survey.bounds;
    let diagonal2: f64 = (0..3).map(|k| (high[k] - low[k]).powi(2)).sum();
    let mild = Options::default();
    let most = survey.holes.iter().map(|hole| hole.edges).max();
    let filled = Options {
        fill: Some(most.unwrap_or(0)),
        ..mild
    };
    let sheet = Options {
        thickness: Some(TRIED_THICKNESS * diagonal2.sqrt()).filter(|t| *t > 0.0),
        ..mild
    };
    let size = fitting_wrap(survey.bounds);
    let wrap = Options {
        wrap: Some(size).filter(|size| *size > 0.0),
        ..Options::default()
    };
    let wrapped = format!(" --wrap {size}");
    let of_largest = others_are_debris(survey);
    [
        (String::new(), mild),
        (format!(" --fill {}", most.unwrap_or(0)), filled),
        (" --thickness LENGTH".to_owned(), sheet),
    ]
    .into_iter()
    .flat_map(|(flags, options)| {
        let largest = Options {
            largest: true,
            ..options
        };
        let with_largest = (format!("{flags} --largest"), largest);
        [Some((flags, options)), of_largest.then_some(with_largest)]
    })
    .flatten()
    .chain([(wrapped, wrap)])
    .collect()
}

fn wrapped_unasked(steps: &[Step]) -> bool {
    let unasked = |step: &Step| matches!(step, Step::Wrapped { parts: Some(_), .. });
    steps.iter().any(unasked)
}

/// Whether all components but the largest are small or inside it, so that dropping them is not to lose a
/// part of the body. Where some meet, a first vertex inside does not say that all is.
fn others_are_debris(survey: &Survey) -> bool {
    let mut others = survey.components.iter().skip(1);
    let apart = survey.meeting.count == 0;
    others.all(|c| (apart && c.inside == Some(0)) || c.area < DEBRIS * survey.area)
}
