//! Which repair mends a mesh: each is tried.

use crate::mesh::{Balance, Options, Step, Survey, TriMesh, Unrepaired, fitting_wrap, repair};
use crate::progress::Progress;

/// Thickness of a sheet that is tried, as a share of the diagonal of its box.
const TRIED_THICKNESS: f64 = 1e-3;

/// Share of the area below which a component is debris.
const DEBRIS: f64 = 0.01;

/// The options of [`repair`](crate::mesh::repair()) that make a body of a mesh, and that body.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Remedy {
    /// The mildest options that do.
    pub options: Option<Options>,
    /// Those for a sheet, where the first are for a solid with a hole.
    pub sheet: Option<Options>,
    /// What the first do.
    pub steps: Vec<Step>,
    /// What comes of it; nothing of a sheet, whose thickness is for its owner to say.
    pub body: Option<TriMesh>,
    /// What is lost and made on the way to it.
    pub balance: Option<Balance>,
    /// Why the mildest repair gives none, if it does not.
    pub left: Option<Unrepaired>,
}

impl Remedy {
    /// The first of some repairs that works, from the mildest on; beside a hole to fill, also the first that
    /// reads it as the rim of a sheet.
    pub(super) fn find(
        vertices: &[[f64; 3]],
        triangles: &[[u32; 3]],
        survey: &Survey,
        progress: &dyn Progress,
    ) -> Remedy {
        let mut remedy = Remedy::default();
        let of_debris = others_are_debris(survey);
        for options in tries(survey) {
            let is_sheet = options.thickness.is_some();
            // A wrap is the last resort.
            if (remedy.options.is_some() && !is_sheet) || progress.cancelled() {
                continue;
            }
            let repaired = repair(vertices, triangles, &options, progress);
            match repaired.body {
                Err(error) => {
                    remedy.left.get_or_insert(error);
                    continue;
                }
                // Debris that meets the body is dropped rather than wrapped with it.
                Ok(_) if !options.largest && of_debris && wrapped_unasked(&repaired.steps) => {
                    continue;
                }
                Ok(_) if remedy.options.is_some() => remedy.sheet = Some(options),
                Ok(body) => {
                    remedy.options = Some(options);
                    remedy.steps = repaired.steps;
                    remedy.balance = repaired.balance.filter(|_| !is_sheet);
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

/// Repairs to try.
fn tries(survey: &Survey) -> Vec<Options> {
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
    let wrapped = Options {
        wrap: Some(fitting_wrap(survey.bounds)).filter(|size| *size > 0.0),
        ..mild
    };
    let of_largest = others_are_debris(survey);
    [mild, filled, sheet]
        .into_iter()
        .flat_map(|options| {
            let largest = Options {
                largest: true,
                ..options
            };
            [Some(options), of_largest.then_some(largest)]
        })
        .flatten()
        .chain([wrapped])
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
