//! What a body meets in a scene besides its fluid: how it touches, obstacles, water.

use std::f64::consts::TAU;
use std::path::PathBuf;

use langevin_rigid::Fluid;
use langevin_rigid::linalg::{Quat, Vec3};
use langevin_rigid_formats::mesh::{LengthUnit, MeshFormat};
use langevin_rigid_world::Material;
use serde_spanned::Spanned;

use super::WriteSceneError;
use super::body::utf8;
use super::place::{Document, SceneError, length};
use super::quantity::{ANGLE, DIRECTION, DURATION, FRACTION, GAIN, HOLE, PLACE, SIZE, SPEED};
use super::raw::{Given, RawContact, RawFluid, RawObstacle, RawRelease, RawWater, RawWaves, given};
use super::seed::Seed;
use super::{release, surroundings};

/// Most obstacles of a scene.
const MAX_OBSTACLES: usize = 1000;

/// How the bodies of a scene touch.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Contact {
    /// Friction and restitution of the bodies; of ground and tank too.
    pub material: Material,
    /// What of a body touches.
    pub shape: ContactShape,
}

/// What of a body touches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum ContactShape {
    /// Its convex hull.
    #[default]
    Hull,
    /// Convex parts: for rings, cups, boats.
    Parts,
}

/// Something that stands in the way.
#[derive(Debug, Clone, PartialEq)]
pub struct SceneObstacle {
    /// What it is.
    pub geometry: ObstacleGeometry,
    /// How it rubs.
    pub material: Material,
}

/// An obstacle as a scene has it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum ObstacleGeometry {
    /// All that is behind a plane.
    Plane {
        /// A point of it (m).
        position: Vec3,
        /// Out of the obstacle, of unit length.
        normal: Vec3,
    },
    /// A box.
    Box {
        /// Its sides (m).
        size: Vec3,
        /// Its centre (m).
        position: Vec3,
        /// Its orientation.
        orientation: Quat,
    },
    /// The surface in a file.
    Mesh {
        /// Its path; relative ones start from the scene's folder.
        path: PathBuf,
        /// Unit of its coordinates; that of the format if none.
        unit: Option<LengthUnit>,
        /// Where its origin is (m).
        position: Vec3,
        /// How it is turned.
        orientation: Quat,
        /// Whether it is closed; a terrain is not.
        closed: bool,
    },
}

/// Water below a surface; the fluid of the scene is above it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneWater {
    /// Height of the still surface, world y (m).
    pub level: f64,
    /// The water.
    pub fluid: Fluid,
    /// Its current along x and z (m/s).
    pub current: [f64; 2],
    /// Its waves, if it has any.
    pub waves: Option<SceneWaves>,
}

/// A sea of waves.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SceneWaves {
    /// Significant height, from trough to crest (m).
    pub height: f64,
    /// Period of the strongest waves (s).
    pub period: f64,
    /// Where they travel: degrees from +x towards +z.
    pub heading: f64,
    /// Their seed; that of the run if none.
    pub seed: Option<u64>,
}

/// The obstacles by name, and the keys of each beside `shape`, `friction` and `restitution`.
const SHAPES: [(&str, &[&str]); 4] = [
    ("plane", &["position", "normal"]),
    (
        "box",
        &["size", "position", "tilt", "tilt_axis", "orientation"],
    ),
    (
        "mesh",
        &[
            "mesh",
            "unit",
            "position",
            "tilt",
            "tilt_axis",
            "orientation",
        ],
    ),
    (
        "terrain",
        &[
            "mesh",
            "unit",
            "position",
            "tilt",
            "tilt_axis",
            "orientation",
        ],
    ),
];

pub(super) fn contact(doc: &Document, raw: &RawContact) -> Result<Contact, SceneError> {
    let shape = raw.shape.as_ref().map(|name| {
        let choices = [("hull", ContactShape::Hull), ("parts", ContactShape::Parts)];
        doc.choose("`shape` of a contact", name, choices)
    });
    Ok(Contact {
        material: material(doc, &raw.friction, &raw.restitution, Material::default())?,
        shape: shape.transpose()?.unwrap_or_default(),
    })
}

fn material(
    doc: &Document,
    friction: &Given<f64>,
    restitution: &Given<f64>,
    otherwise: Material,
) -> Result<Material, SceneError> {
    let restitution = doc.given(restitution, "restitution", FRACTION)?;
    Ok(Material {
        friction: doc
            .given(friction, "friction", GAIN)?
            .unwrap_or(otherwise.friction),
        restitution: restitution.unwrap_or(otherwise.restitution),
    })
}

pub(super) fn obstacles(
    doc: &Document,
    raw: &[Spanned<RawObstacle>],
    otherwise: Material,
) -> Result<Vec<SceneObstacle>, SceneError> {
    if let Some(surplus) = raw.get(MAX_OBSTACLES) {
        let message = format!(
            "a scene has at most {MAX_OBSTACLES} obstacles, and this one {}: join them in one mesh",
            raw.len()
        );
        return Err(doc.error(surplus.span(), message));
    }
    raw.iter()
        .map(|raw| obstacle(doc, raw, otherwise))
        .collect()
}

fn obstacle(
    doc: &Document,
    raw: &Spanned<RawObstacle>,
    otherwise: Material,
) -> Result<SceneObstacle, SceneError> {
    let given = raw.get_ref();
    let missing = |what: &str| doc.error(raw.span(), format!("an obstacle needs {what}"));
    let Some(name) = &given.shape else {
        let names = SHAPES.map(|(name, _)| format!("`{name}`")).join(", ");
        return Err(missing(&format!("its `shape`, one of {names}")));
    };
    let keys = doc.choose("`shape` of an obstacle", name, SHAPES)?;
    if let Some((key, place)) = given.keys().find(|(key, _)| !keys.contains(key)) {
        let message = format!(
            "an obstacle that is a `{}` has no `{key}`; it has `{}`",
            name.get_ref(),
            keys.join("`, `")
        );
        return Err(doc.error(place, message));
    }
    let position = given.position.as_ref();
    let position = position
        .map(|v| doc.numbers(v, "position", PLACE))
        .transpose()?;
    let position = position.unwrap_or([0.0; 3]);
    let orientation = release::orientation(
        doc,
        &RawRelease {
            tilt: given.tilt.clone(),
            tilt_axis: given.tilt_axis.clone(),
            orientation: given.orientation.clone(),
            ..RawRelease::default()
        },
    )?;
    let geometry = match name.get_ref().as_str() {
        "plane" => ObstacleGeometry::Plane {
            position,
            normal: match &given.normal {
                Some(normal) => unit(doc, normal)?,
                None => [0.0, 1.0, 0.0],
            },
        },
        "box" => {
            let size = given
                .size
                .as_ref()
                .ok_or_else(|| missing("its `size` (m)"))?;
            ObstacleGeometry::Box {
                size: doc.numbers(size, "size", SIZE)?,
                position,
                orientation,
            }
        }
        shape => {
            let mesh = given.mesh.as_ref();
            let mesh = mesh.ok_or_else(|| missing("its `mesh`, the path of a file"))?;
            let format = MeshFormat::of_extension(mesh.get_ref().as_ref());
            if given.unit.is_none() && format.is_some_and(|format| !format.has_unit()) {
                let message = "the mesh of an obstacle needs its `unit` of length: \"m\", \"cm\", \"mm\", \"um\", \
                               \"in\" or \"ft\"";
                return Err(doc.error(mesh.span(), message));
            }
            let unit = given.unit.as_ref();
            ObstacleGeometry::Mesh {
                path: mesh.get_ref().into(),
                unit: unit
                    .map(|unit| doc.name::<LengthUnit>(unit, "unit"))
                    .transpose()?,
                position,
                orientation,
                closed: shape == "mesh",
            }
        }
    };
    Ok(SceneObstacle {
        geometry,
        material: material(doc, &given.friction, &given.restitution, otherwise)?,
    })
}

/// Of unit length; what is so to rounding keeps its bits.
fn unit(doc: &Document, given: &Spanned<Vec<f64>>) -> Result<Vec3, SceneError> {
    let vector: Vec3 = doc.numbers(given, "normal", DIRECTION)?;
    let length = length(&vector);
    if length < 1e-6 {
        let message = format!("`normal` must be at least 1e-6 long, and is {length:e} long");
        return Err(doc.error(given.span(), message));
    }
    Ok(match (length - 1.0).abs() < 1e-15 {
        true => vector,
        false => vector.map(|x| x / length),
    })
}

/// `gravity` is that of the run (m/s^2).
pub(super) fn water(
    doc: &Document,
    raw: &Spanned<RawWater>,
    gravity: Vec3,
) -> Result<SceneWater, SceneError> {
    let given = raw.get_ref();
    if gravity[0] != 0.0 || gravity[2] != 0.0 || gravity[1] >= 0.0 {
        let message = "a surface of water is level: it needs a `gravity` along -y";
        return Err(doc.error(raw.span(), message));
    }
    let fluid = RawFluid {
        preset: match (&given.preset, &given.density) {
            (None, None) => super::raw::given("water".to_owned()),
            _ => given.preset.clone(),
        },
        density: given.density.clone(),
        viscosity: given.viscosity.clone(),
        velocity: None,
    };
    let current = given.current.as_ref();
    let current = current
        .map(|v| doc.numbers(v, "current", SPEED))
        .transpose()?;
    let waves = given
        .waves
        .as_ref()
        .map(|waves| sea(doc, waves, -gravity[1]));
    Ok(SceneWater {
        level: doc.given(&given.level, "level", PLACE)?.unwrap_or(0.0),
        fluid: surroundings::fluid(doc, &Spanned::new(raw.span(), fluid))?,
        current: current.unwrap_or([0.0; 2]),
        waves: waves.transpose()?,
    })
}

/// Refuses waves that would break. `gravity` is its magnitude (m/s^2).
fn sea(doc: &Document, raw: &Spanned<RawWaves>, gravity: f64) -> Result<SceneWaves, SceneError> {
    let RawWaves {
        height,
        period,
        heading,
        seed,
    } = raw.get_ref();
    let missing = |what: &str| doc.error(raw.span(), format!("`waves` need {what}"));
    let height = doc.given(height, "height", HOLE)?;
    let period = doc.given(period, "period", DURATION)?;
    let height = height.ok_or_else(|| missing("their significant `height` (m)"))?;
    let period = period.ok_or_else(|| missing("the `period` (s) of the strongest"))?;
    // Michell 1893: the highest wave on deep water.
    let highest = 0.142 * gravity * period * period / TAU;
    if height > highest {
        let message = format!(
            "`waves` of {period} s break where they are higher than {highest:.3e} m, and these are {height} m high: lower \
             the `height` or lengthen the `period`"
        );
        return Err(doc.error(raw.span(), message));
    }
    Ok(SceneWaves {
        height,
        period,
        heading: doc.given(heading, "heading", ANGLE)?.unwrap_or(0.0),
        seed: seed.as_ref().map(|seed| seed.get_ref().0),
    })
}

pub(super) fn write_contact(contact: &Contact) -> RawContact {
    let shape = match contact.shape {
        ContactShape::Hull => "hull",
        ContactShape::Parts => "parts",
    };
    RawContact {
        friction: given(contact.material.friction),
        restitution: given(contact.material.restitution),
        shape: given(shape.to_owned()),
    }
}

pub(super) fn write_obstacle(
    obstacle: &SceneObstacle,
) -> Result<Spanned<RawObstacle>, WriteSceneError> {
    let named = |shape: &str, position: Vec3| RawObstacle {
        shape: given(shape.to_owned()),
        friction: given(obstacle.material.friction),
        restitution: given(obstacle.material.restitution),
        position: given(position.to_vec()),
        ..RawObstacle::default()
    };
    let raw = match &obstacle.geometry {
        ObstacleGeometry::Plane { position, normal } => RawObstacle {
            normal: given(normal.to_vec()),
            ..named("plane", *position)
        },
        ObstacleGeometry::Box {
            size,
            position,
            orientation,
        } => RawObstacle {
            size: given(size.to_vec()),
            orientation: given(orientation.to_vec()),
            ..named("box", *position)
        },
        ObstacleGeometry::Mesh {
            path,
            unit,
            position,
            orientation,
            closed,
        } => RawObstacle {
            mesh: given(utf8(path, "the mesh of an obstacle")?),
            unit: unit.and_then(|unit| given(unit.to_string())),
            orientation: given(orientation.to_vec()),
            ..named(if *closed { "mesh" } else { "terrain" }, *position)
        },
    };
    Ok(Spanned::new(0..0, raw))
}

pub(super) fn write_water(water: &SceneWater) -> Spanned<RawWater> {
    let waves = water.waves.map(|waves| {
        Spanned::new(
            0..0,
            RawWaves {
                height: given(waves.height),
                period: given(waves.period),
                heading: given(waves.heading),
                seed: waves.seed.and_then(|seed| given(Seed(seed))),
            },
        )
    });
    Spanned::new(
        0..0,
        RawWater {
            level: given(water.level),
            preset: None,
            density: given(water.fluid.density),
            viscosity: given(water.fluid.viscosity),
            current: given(water.current.to_vec()),
            waves,
        },
    )
}

impl RawObstacle {
    /// The keys that are given and go with some shapes alone, and where they stand.
    fn keys(&self) -> impl Iterator<Item = (&'static str, std::ops::Range<usize>)> {
        fn at<T>(value: &Given<T>) -> Option<std::ops::Range<usize>> {
            value.as_ref().map(Spanned::span)
        }
        [
            ("size", at(&self.size)),
            ("position", at(&self.position)),
            ("normal", at(&self.normal)),
            ("tilt", at(&self.tilt)),
            ("tilt_axis", at(&self.tilt_axis)),
            ("orientation", at(&self.orientation)),
            ("mesh", at(&self.mesh)),
            ("unit", at(&self.unit)),
        ]
        .into_iter()
        .filter_map(|(key, place)| place.map(|place| (key, place)))
    }
}
