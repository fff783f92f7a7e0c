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
    pub(super) flags: Option<&'static str>,
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
        let filled = |options: Options| Options {
            fill: Some(1_000_000),
            ..options
        };
        let sheet = |options: Options| Options {
            thickness: thick,
            ..options
        };
        let tries = [
            ("", mild),
            (" --largest", largest),
            (" --fill 1000000", filled(mild)),
            (" --largest --fill 1000000", filled(largest)),
            (" --thickness LENGTH", sheet(mild)),
            (" --largest --thickness LENGTH", sheet(largest)),
        ];
        let debris = others_are_debris(survey);
        let mut remedy = Remedy::default();
        for (flags, options) in tries.into_iter().filter(|(_, o)| debris || !o.largest) {
            let repaired = repair(&raw.vertices, &raw.triangles, &options, bars);
            match repaired.body {
                Ok(body) => {
                    remedy.flags = Some(flags);
                    remedy.steps = repaired.steps;
                    // A sheet's thickness is for its owner to say, and so is what comes of it.
                    remedy.body = Some(body).filter(|_| options.thickness.is_none());
                    return remedy;
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
