//! Which repair mends a mesh: each is tried.

use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::mesh::{Options, Step, Survey, Unrepaired, repair};
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
    /// Why the mildest repair gives none.
    pub(super) left: Option<Unrepaired>,
}

impl Remedy {
    /// The first of some repairs that works, from the mildest on.
    pub(super) fn find(raw: &RawMesh, survey: &Survey, bars: &Bars) -> Remedy {
        let [low, high] = survey.bounds;
        let diagonal2: f64 = (0..3).map(|k| (high[k] - low[k]).powi(2)).sum();
        let thick = Some(TRIED_THICKNESS * diagonal2.sqrt()).filter(|t| *t > 0.0);
        let mild = Options::default();
        let largest = Options {
            largest: true,
            ..mild
        };
        let most = survey
            .holes
            .iter()
            .map(|hole| hole.edges)
            .max()
            .unwrap_or(0);
        let fill = format!(" --fill {most}");
        let filled = |options: Options| Options {
            fill: Some(most),
            ..options
        };
        let sheet = |options: Options| Options {
            thickness: thick,
            ..options
        };
        let tries = [
            (String::new(), mild),
            (" --largest".to_owned(), largest),
            (fill.clone(), filled(mild)),
            (format!("{fill} --largest"), filled(largest)),
            (" --thickness LENGTH".to_owned(), sheet(mild)),
            (" --thickness LENGTH --largest".to_owned(), sheet(largest)),
        ];
        let debris = others_are_debris(survey);
        let mut remedy = Remedy::default();
        for (flags, options) in tries.into_iter().filter(|(_, o)| debris || !o.largest) {
            // Beside a hole to fill only a sheet is another reading.
            if remedy.flags.is_some() && options.thickness.is_none() {
                continue;
            }
            let repaired = repair(&raw.vertices, &raw.triangles, &options, bars);
            match repaired.body {
                Ok(_) if remedy.flags.is_some() => {
                    remedy.sheet_flags = Some(flags);
                    break;
                }
                Ok(body) => {
                    remedy.flags = Some(flags);
                    remedy.steps = repaired.steps;
                    // A sheet's thickness is for its owner to say, and so is what comes of it.
                    remedy.body = Some(body).filter(|_| options.thickness.is_none());
                    if options.fill.is_none() {
                        break;
                    }
                }
                Err(error) => {
                    remedy.left.get_or_insert(error);
                }
            }
        }
        remedy
    }
}

/// Whether all components but the largest are small or inside it, so that dropping them is not to lose a
/// part of the body.
fn others_are_debris(survey: &Survey) -> bool {
    let mut others = survey.components.iter().skip(1);
    others.all(|c| c.inside == Some(0) || c.area < DEBRIS * survey.area)
}
