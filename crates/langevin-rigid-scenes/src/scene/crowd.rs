//! Many bodies in one scene: how many, where and when they are let go, of which kinds and sizes.

use std::path::Path;

use langevin_rigid::linalg::Vec3;
use serde_spanned::Spanned;

use super::place::{Document, SceneError};
use super::quantity::{DELAY, GAIN, HOLE, POSITIVE};
use super::raw::{RawCrowd, RawCrowdKind, given};

/// Most bodies of a crowd.
const MAX_BODIES: i64 = 100_000;
/// Most kinds of bodies in it, beside the scene's own.
const MAX_KINDS: usize = 32;

/// Many bodies that are let go in one scene.
#[derive(Debug, Clone, PartialEq)]
pub struct Crowd {
    /// How many there are.
    pub count: u32,
    /// Sides of the box around the release point within which they are let go (m).
    pub over: Vec3,
    /// Time over which they are let go, evenly (s).
    pub during: f64,
    /// Whether each has an orientation of its own, any as likely as any other; else that of the release with its scatter.
    pub any_orientation: bool,
    /// Smallest and largest size, as multiples of the body's own.
    pub sizes: [f64; 2],
    /// Bodies of other scenes among them.
    pub kinds: Vec<CrowdKind>,
}

/// Bodies of another scene in a crowd.
#[derive(Debug, Clone, PartialEq)]
pub struct CrowdKind {
    /// A built-in scene or the path of one, of which the body is taken; relative paths start from the scene's folder.
    pub scene: String,
    /// How many there are of it for each of the scene's own body.
    pub share: f64,
}

impl CrowdKind {
    /// Name of its scene: that of a built-in one, or the file's without ending.
    pub fn name(&self) -> String {
        let stem = Path::new(&self.scene).file_stem();
        stem.map_or_else(
            || self.scene.clone(),
            |stem| stem.to_string_lossy().into_owned(),
        )
    }
}

pub(super) fn resolve(doc: &Document, raw: &Spanned<RawCrowd>) -> Result<Crowd, SceneError> {
    let RawCrowd {
        count,
        over,
        during,
        orientation,
        sizes,
        kinds,
    } = raw.get_ref();
    let Some(count) = count else {
        return Err(doc.error(
            raw.span(),
            "a crowd needs its `count`, the number of bodies",
        ));
    };
    if !(1..=MAX_BODIES).contains(count.get_ref()) {
        let message = format!(
            "`count` must be between 1 and {MAX_BODIES}, and is {}",
            count.get_ref()
        );
        return Err(doc.error(count.span(), message));
    }
    let over = over.as_ref().map(|over| doc.numbers(over, "over", HOLE));
    let any_orientation = orientation.as_ref().map(|name| {
        let choices = [("any", true), ("release", false)];
        doc.choose("`orientation` of a crowd", name, choices)
    });
    let sizes = match sizes {
        None => [1.0; 2],
        Some(sizes) => {
            let [least, most] = doc.numbers(sizes, "sizes", POSITIVE)?;
            if least > most {
                let message = format!(
                    "`sizes` are the smallest and the largest, and {least} is larger than {most}: exchange them"
                );
                return Err(doc.error(sizes.span(), message));
            }
            [least, most]
        }
    };
    if let Some(surplus) = kinds.get(MAX_KINDS) {
        let message = format!(
            "a crowd has at most {MAX_KINDS} `kinds`, and this one {}",
            kinds.len()
        );
        return Err(doc.error(surplus.span(), message));
    }
    Ok(Crowd {
        count: *count.get_ref() as u32,
        over: over.transpose()?.unwrap_or([0.0; 3]),
        during: doc.given(during, "during", DELAY)?.unwrap_or(0.0),
        any_orientation: any_orientation.transpose()?.unwrap_or(false),
        sizes,
        kinds: kinds
            .iter()
            .map(|raw| kind(doc, raw))
            .collect::<Result<_, _>>()?,
    })
}

fn kind(doc: &Document, raw: &Spanned<RawCrowdKind>) -> Result<CrowdKind, SceneError> {
    let RawCrowdKind { scene, share } = raw.get_ref();
    let Some(scene) = scene else {
        let message = "each of the `kinds` needs a `scene`, of which the body is taken";
        return Err(doc.error(raw.span(), message));
    };
    Ok(CrowdKind {
        scene: scene.get_ref().clone(),
        share: doc.given(share, "share", GAIN)?.unwrap_or(1.0),
    })
}

pub(super) fn write(crowd: &Crowd) -> Spanned<RawCrowd> {
    let orientation = if crowd.any_orientation {
        "any"
    } else {
        "release"
    };
    let kind = |kind: &CrowdKind| {
        Spanned::new(
            0..0,
            RawCrowdKind {
                scene: given(kind.scene.clone()),
                share: given(kind.share),
            },
        )
    };
    Spanned::new(
        0..0,
        RawCrowd {
            count: given(i64::from(crowd.count)),
            over: given(crowd.over.to_vec()),
            during: given(crowd.during),
            orientation: given(orientation.to_owned()),
            sizes: given(crowd.sizes.to_vec()),
            kinds: crowd.kinds.iter().map(kind).collect(),
        },
    )
}
