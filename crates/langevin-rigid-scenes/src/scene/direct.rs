//! What a fall shall do, and what is free for it: `[direct]`.

use std::path::PathBuf;

use langevin_rigid::linalg::Vec3;
use serde_spanned::Spanned;

use super::WriteSceneError;
use super::body::utf8;
use super::place::{Document, SceneError, length};
use super::quantity::{
    DEVIATION, DIRECTION, DURATION, FREE_ANGLE, FREE_SPIN, HOLE, PLACE, SHARE, SIZE,
};
use super::raw::{Given, RawDirect, RawFree, RawLand, RawPath, RawRing, given};
use crate::direct::Motion;

/// Most of the best that are kept.
const MOST_BEST: u32 = 1000;
/// Most falls of a search.
const MOST_FALLS: u32 = 1_000_000_000;
/// Most rings of a scene, and most motions.
const MOST_ASKS: usize = 32;

/// What the fall of a scene's body shall do, and the freedom to find it in.
#[derive(Debug, Clone, PartialEq)]
pub struct Direct {
    /// How and where it lands.
    pub land: Option<Landing>,
    /// What its centre of mass passes through.
    pub rings: Vec<Ring>,
    /// The motions that follow each other; any if none.
    pub motion: Vec<Motion>,
    /// The path that it keeps to.
    pub path: Option<Path>,
    /// How the release may differ from the scene's.
    pub free: Freedom,
    /// Largest steering force, a share of the weight; none if none.
    pub steer: Option<f64>,
    /// How many falls are wanted, different from each other.
    pub best: u32,
    /// How many falls are tried at most.
    pub falls: u32,
}

/// How and where a body lands.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Landing {
    /// Where its centre of mass is then (m), world frame, of which the height does not count; and how near (m).
    pub at: Option<(Vec3, f64)>,
    /// When (s), and how near to it (s).
    pub time: Option<(f64, f64)>,
    /// On which side.
    pub side: Option<Side>,
}

/// The side of a body that is up when it lands, told by its thin axis: that of its largest moment of inertia.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Side {
    /// The one that is up in the body frame: of a plate, +Y.
    Up,
    /// It lies turned over.
    Down,
}

/// A ring in the world, through which a centre of mass passes, either way.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Ring {
    /// Its centre (m).
    pub centre: Vec3,
    /// Its axis, of unit length.
    pub normal: Vec3,
    /// Its radius (m).
    pub radius: f64,
}

/// A drawn path.
#[derive(Debug, Clone, PartialEq)]
pub struct Path {
    /// A CSV file of points x, y, z (m), and t (s) if they have times; relative paths start from the scene's folder.
    pub file: PathBuf,
    /// Root mean square distance within which a fall keeps to it (m).
    pub within: f64,
}

/// How far a release may be from that of the scene, either way.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Freedom {
    /// Turn about any horizontal axis (degrees).
    pub tilt: f64,
    /// Turn about the vertical (degrees).
    pub heading: f64,
    /// Position, each component (m).
    pub position: Vec3,
    /// Each component of the velocity, world frame (m/s).
    pub velocity: f64,
    /// Each component of the angular velocity, world frame (rad/s).
    pub spin: f64,
}

/// What else of the scene matters here.
pub(super) struct Surroundings {
    pub(super) ground: bool,
    pub(super) tank: bool,
    pub(super) steered: bool,
}

pub(super) fn resolve(
    doc: &Document,
    raw: Option<&Spanned<RawDirect>>,
    around: &Surroundings,
) -> Result<Option<Direct>, SceneError> {
    let Some(raw) = raw else { return Ok(None) };
    let given = raw.get_ref();
    let count = |value: &Given<i64>, key, most, usual| {
        value
            .as_ref()
            .map_or(Ok(usual), |value| doc.count(value, key, 1..=most))
    };
    if let Some(surplus) = given.ring.get(MOST_ASKS) {
        let message = format!("a scene has at most {MOST_ASKS} rings");
        return Err(doc.error(surplus.span(), message));
    }
    if let Some(steer) = &given.steer
        && around.steered
    {
        let message = "the scene has its [steering]: leave that out, or `steer`";
        return Err(doc.error(steer.span(), message));
    }
    let land = given.land.as_ref();
    let path = given.path.as_ref();
    let direct = Direct {
        land: land.map(|raw| landing(doc, raw, around)).transpose()?,
        rings: given
            .ring
            .iter()
            .map(|raw| ring(doc, raw))
            .collect::<Result<_, _>>()?,
        motion: motion(doc, &given.motion)?,
        path: path.map(|raw| drawn(doc, raw)).transpose()?,
        free: match &given.free {
            Some(raw) => freedom(doc, raw.get_ref(), around)?,
            None => Freedom::default(),
        },
        steer: doc.given(&given.steer, "steer", SHARE)?,
        best: count(&given.best, "best", MOST_BEST, 5)?,
        falls: count(&given.falls, "falls", MOST_FALLS, 20_000)?,
    };
    let asks = direct.land.is_some() || direct.path.is_some();
    if !asks && direct.rings.is_empty() && direct.motion.is_empty() {
        let message = "[direct] asks for nothing: give a `land`, a `ring`, a `motion` or a `path`, or several";
        return Err(doc.error(raw.span(), message));
    }
    Ok(Some(direct))
}

fn landing(
    doc: &Document,
    raw: &Spanned<RawLand>,
    around: &Surroundings,
) -> Result<Landing, SceneError> {
    let given = raw.get_ref();
    if !around.ground {
        let message = "nothing to land on: give the run a `ground` (height in m), or a [tank]";
        return Err(doc.error(raw.span(), message));
    }
    let at = match (&given.at, &given.within) {
        (Some(at), Some(within)) => Some((
            doc.numbers(at, "at", PLACE)?,
            doc.number(within, "within", SIZE)?,
        )),
        (None, None) => None,
        (Some(one), None) => return Err(doc.error(one.span(), "`at` needs `within` (m) beside it")),
        (None, Some(one)) => return Err(doc.error(one.span(), "`within` needs `at` beside it")),
    };
    let time = match (&given.time, &given.time_within) {
        (Some(time), Some(within)) => Some((
            doc.number(time, "time", DURATION)?,
            doc.number(within, "time_within", DURATION)?,
        )),
        (None, None) => None,
        (Some(one), None) => {
            return Err(doc.error(one.span(), "`time` needs `time_within` (s) beside it"));
        }
        (None, Some(one)) => {
            return Err(doc.error(one.span(), "`time_within` needs `time` beside it"));
        }
    };
    let sides = [("up", Side::Up), ("down", Side::Down)];
    let side = given.side.as_ref();
    let side = side.map(|name| doc.choose("`side`", name, sides));
    let landing = Landing {
        at,
        time,
        side: side.transpose()?,
    };
    match landing {
        Landing {
            at: None,
            time: None,
            side: None,
        } => {
            let message = "`land` needs `at` and `within`, `time` and `time_within`, or a `side`";
            Err(doc.error(raw.span(), message))
        }
        landing => Ok(landing),
    }
}

fn ring(doc: &Document, raw: &Spanned<RawRing>) -> Result<Ring, SceneError> {
    let given = raw.get_ref();
    let (Some(centre), Some(radius)) = (&given.centre, &given.radius) else {
        let message = "a ring needs its `centre` and `radius` (m)";
        return Err(doc.error(raw.span(), message));
    };
    let normal = match &given.normal {
        None => [0.0, 1.0, 0.0],
        Some(normal) => {
            let axis: Vec3 = doc.numbers(normal, "normal", DIRECTION)?;
            let length = length(&axis);
            if length < 1e-6 {
                let message =
                    format!("`normal` must be at least 1e-6 long, and is {length:e} long");
                return Err(doc.error(normal.span(), message));
            }
            // What is a unit to rounding keeps its bits: resolved scenes read back the same.
            match (length - 1.0).abs() < 1e-15 {
                true => axis,
                false => axis.map(|x| x / length),
            }
        }
    };
    Ok(Ring {
        centre: doc.numbers(centre, "centre", PLACE)?,
        normal,
        radius: doc.number(radius, "radius", SIZE)?,
    })
}

fn motion(doc: &Document, raw: &Given<Vec<Spanned<String>>>) -> Result<Vec<Motion>, SceneError> {
    let Some(names) = raw else {
        return Ok(Vec::new());
    };
    if !(1..=Motion::MOST).contains(&names.get_ref().len()) {
        let message = format!("`motion` takes 1 to {} motions", Motion::MOST);
        return Err(doc.error(names.span(), message));
    }
    let choices = || Motion::ALL.map(|motion| (motion.name(), motion));
    let names = names.get_ref().iter();
    names
        .map(|name| doc.choose("`motion`", name, choices()))
        .collect()
}

fn drawn(doc: &Document, raw: &Spanned<RawPath>) -> Result<Path, SceneError> {
    let (Some(file), Some(within)) = (&raw.get_ref().file, &raw.get_ref().within) else {
        let message = "`path` needs a `file`, a CSV of points x, y, z, and `within` (m)";
        return Err(doc.error(raw.span(), message));
    };
    Ok(Path {
        file: file.get_ref().into(),
        within: doc.number(within, "within", SIZE)?,
    })
}

fn freedom(doc: &Document, raw: &RawFree, around: &Surroundings) -> Result<Freedom, SceneError> {
    let number = |value, key, kind| Ok(doc.given(value, key, kind)?.unwrap_or(0.0));
    let position = raw.position.as_ref();
    let place = position.map_or(Ok([0.0; 3]), |v| doc.numbers(v, "position", HOLE))?;
    if let Some(given) = position
        && around.tank
        && place != [0.0; 3]
    {
        let message = "a tank goes with the release, so its `position` is not free: leave it out";
        return Err(doc.error(given.span(), message));
    }
    Ok(Freedom {
        tilt: number(&raw.tilt, "tilt", FREE_ANGLE)?,
        heading: number(&raw.heading, "heading", FREE_ANGLE)?,
        position: place,
        velocity: number(&raw.velocity, "velocity", DEVIATION)?,
        spin: number(&raw.spin, "spin", FREE_SPIN)?,
    })
}

/// The section of a resolved scene.
///
/// # Errors
/// A path that TOML, which is UTF-8, cannot hold.
pub(super) fn write(direct: &Direct) -> Result<Spanned<RawDirect>, WriteSceneError> {
    let unplaced = |name: &'static str| Spanned::new(0..0, name.to_owned());
    let names = direct.motion.iter().map(|motion| unplaced(motion.name()));
    let names: Vec<_> = names.collect();
    let land = direct.land.map(|land| RawLand {
        at: land.at.and_then(|(at, _)| given(at.to_vec())),
        within: land.at.and_then(|(_, within)| given(within)),
        time: land.time.and_then(|(time, _)| given(time)),
        time_within: land.time.and_then(|(_, within)| given(within)),
        side: land.side.and_then(|side| given(side.name().to_owned())),
    });
    let path = match &direct.path {
        Some(path) => given(RawPath {
            file: given(utf8(&path.file, "a path")?),
            within: given(path.within),
        }),
        None => None,
    };
    let rings = direct.rings.iter().map(|ring| RawRing {
        centre: given(ring.centre.to_vec()),
        normal: given(ring.normal.to_vec()),
        radius: given(ring.radius),
    });
    let raw = RawDirect {
        best: given(i64::from(direct.best)),
        falls: given(i64::from(direct.falls)),
        motion: (!names.is_empty()).then_some(names).and_then(given),
        steer: direct.steer.and_then(given),
        free: given(RawFree {
            tilt: given(direct.free.tilt),
            heading: given(direct.free.heading),
            position: given(direct.free.position.to_vec()),
            velocity: given(direct.free.velocity),
            spin: given(direct.free.spin),
        }),
        land: land.and_then(given),
        path,
        ring: rings.map(|raw| Spanned::new(0..0, raw)).collect(),
    };
    Ok(Spanned::new(0..0, raw))
}

impl Side {
    fn name(self) -> &'static str {
        match self {
            Self::Up => "up",
            Self::Down => "down",
        }
    }
}

#[cfg(test)]
mod tests {
    use crate::scene::{Scene, SceneError};

    fn parsed(asked: &str) -> Result<Scene, SceneError> {
        let text = format!(
            "fluid.preset = \"water\"\nbody = {{ shape = \"box\", size = [1, 1, 1], mass = 3000 }}\n\
             release.position = [0, 9, 0]\nrun = {{ time_step = 0.1, duration = 1, ground = 0 }}\n{asked}\n"
        );
        Scene::parse("box", "box.toml", &text)
    }

    #[test]
    fn all_that_can_be_asked_is_written_as_it_was_read() {
        let scene = parsed(
            "[direct]\nbest = 3\nfalls = 77\nmotion = [\"steady\", \"helix\"]\nsteer = 0.2\n\
             land = { time = 0.5, time_within = 0.1, side = \"down\" }\n\
             path = { file = \"drawn.csv\", within = 0.1 }\n\
             free = { position = [0, 1, 2], spin = 3 }\n\
             [[direct.ring]]\ncentre = [1, 2, 3]\nradius = 0.5\n\
             [[direct.ring]]\ncentre = [1, 2, 3]\nradius = 0.5\nnormal = [1, 2, 3]",
        )
        .unwrap();
        let text = scene.to_toml().unwrap();
        assert_eq!(
            Scene::parse("box", "again", &text).unwrap(),
            scene,
            "{text}"
        );
        let direct = scene.direct.unwrap();
        assert_eq!((direct.best, direct.falls, direct.rings.len()), (3, 77, 2));
        assert_eq!(direct.rings[0].normal, [0.0, 1.0, 0.0]);
    }

    #[test]
    fn a_stream_and_a_force_are_written_as_they_were_read() {
        let scene = parsed("[steering]\nevery = 0.2\nforce = [[1, 2, 3], [0, 0, 0.1]]").unwrap();
        let text = scene.to_toml().unwrap();
        assert_eq!(
            Scene::parse("box", "again", &text).unwrap(),
            scene,
            "{text}"
        );
        let mut scene = parsed("").unwrap();
        assert!(!scene.to_toml().unwrap().contains("stream"));
        scene.stream = u32::MAX;
        let text = scene.to_toml().unwrap();
        assert_eq!(
            Scene::parse("box", "again", &text).unwrap(),
            scene,
            "{text}"
        );
    }

    #[test]
    fn what_does_not_go_together_is_refused_at_its_place() {
        for (asked, place, words) in [
            ("[direct]", (5, 1), "asks for nothing"),
            ("[direct.free]\ntilt = 9", (5, 2), "asks for nothing"),
            ("[direct.land]", (5, 1), "`land` needs"),
            ("[direct.land]\nat = [0, 0, 0]", (6, 6), "needs `within`"),
            ("[direct.land]\nwithin = 1", (6, 10), "needs `at`"),
            ("[direct.land]\ntime = 1", (6, 8), "needs `time_within`"),
            ("[direct.land]\ntime_within = 1", (6, 15), "needs `time`"),
            ("[direct.land]\nside = \"left\"", (6, 8), "`side`"),
            ("[direct.land]\nnear = 1", (6, 1), "near"),
            ("[[direct.ring]]\nradius = 1", (5, 1), "a ring needs"),
            (
                "[[direct.ring]]\nradius = 1\ncentre = [0, 0, 0]\nnormal = [0, 0, 0]",
                (8, 10),
                "long",
            ),
            ("[direct]\nmotion = []", (6, 10), "`motion` takes"),
            (
                "[direct]\nmotion = [\"steady\", \"hover\"]",
                (6, 21),
                "hover",
            ),
            ("[direct.path]\nfile = \"a.csv\"", (5, 1), "`path` needs"),
            (
                "[direct]\nmotion = [\"steady\"]\nbest = 0",
                (7, 8),
                "`best`",
            ),
            (
                "[direct]\nmotion = [\"steady\"]\nfalls = -1",
                (7, 9),
                "`falls`",
            ),
            (
                "[direct]\nmotion = [\"steady\"]\nfree.tilt = 181",
                (7, 13),
                "`tilt`",
            ),
            (
                "[direct]\nmotion = [\"steady\"]\nfree.position = [0, 1, 0]\n[tank]\nsize = [2, 10, 2]",
                (7, 17),
                "tank",
            ),
            (
                "[direct]\nmotion = [\"steady\"]\nsteer = 0.1\n[steering]\nevery = 1\nforce = [[0, 0, 0]]",
                (7, 9),
                "leave that out",
            ),
            ("[steering]\nevery = 1", (5, 1), "[steering] needs"),
            (
                "[steering]\nevery = 1\nforce = []",
                (7, 9),
                "control points",
            ),
            (
                "[steering]\nevery = 1\nforce = [[0, 0]]",
                (7, 10),
                "takes 3 values",
            ),
        ] {
            let error = parsed(asked).expect_err(asked);
            assert_eq!((error.line, error.column), place, "{asked}: {error}");
            assert!(error.message.contains(words), "{asked}: {error}");
        }
        let text = "fluid.preset = \"water\"\nbody = { shape = \"box\", size = [1, 1, 1], mass = 3000 }\n\
                    run = { time_step = 0.1, duration = 1 }\ndirect.land.side = \"up\"\n";
        let error = Scene::parse("box", "box.toml", text).unwrap_err();
        assert!(
            error.line == 4 && error.message.contains("nothing to land on"),
            "{error}"
        );
    }
}
