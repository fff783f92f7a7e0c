//! The wind of a scene.

use std::ops::Range;
use std::path::PathBuf;

use langevin_rigid::linalg::vector::add;
use langevin_rigid::wind::{
    GustSettings, Gusts, Jet, Profile, Region, Shear, Vortex, Wind, WindError, WindField,
};
use langevin_rigid_formats::wind_table::{ReadTableError, read_wind_table};
use serde_spanned::Spanned;

use super::WriteSceneError;
use super::body::utf8;
use super::place::{Document, SceneError, length};
use super::quantity::{CIRCULATION, DEVIATION, DIRECTION, EXPONENT, PLACE, SIZE, SPEED};
use super::raw::{Given, RawWind, RawWithin, given};
use super::seed::Seed;

/// Most winds of a scene: every body feels all of them at every step.
const MAX_WINDS: usize = 32;

/// One of the fields that make the wind of a scene.
#[derive(Debug, Clone, PartialEq)]
pub struct WindPart {
    /// What it is.
    pub field: SceneField,
    /// Where; everywhere if none.
    pub within: Option<Region>,
    /// Which bodies feel it, in a [crowd](super::Crowd) of several kinds: [`OWN`], or those of the scenes of these names; all
    /// if none.
    pub bodies: Vec<String>,
}

/// The name by which a wind knows the scene's own bodies.
pub const OWN: &str = "own";

/// A field as a scene has it.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum SceneField {
    /// The same velocity everywhere (m/s).
    Uniform([f64; 3]),
    /// Wind that grows with height.
    Shear(Shear),
    /// Turbulence.
    Gusts {
        /// Its constants; the seed is that of `seed`.
        settings: GustSettings,
        /// Its seed; that of the run and the place in the list of winds if none.
        seed: Option<u64>,
    },
    /// A line about which the fluid turns.
    Vortex(Vortex),
    /// What a fan blows.
    Jet(Jet),
    /// Velocities on a grid.
    Table {
        /// An NPZ file ([`read_wind_table`]); relative paths start from the scene's folder.
        path: PathBuf,
    },
}

/// Why a scene has no wind.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneWindError {
    /// A field is none.
    #[error(transparent)]
    Field(#[from] WindError),
    /// A table cannot be read.
    #[error(transparent)]
    Table(#[from] ReadTableError),
}

/// The fields by name, and the keys of each beside `field` and `within`.
const FIELDS: [(&str, &[&str]); 6] = [
    ("uniform", &["velocity"]),
    (
        "shear",
        &["velocity", "height", "ground", "exponent", "roughness"],
    ),
    ("gusts", &["rms", "length", "smallest", "carried", "seed"]),
    ("vortex", &["centre", "axis", "circulation", "core"]),
    ("jet", &["centre", "axis", "speed", "diameter"]),
    ("table", &["file"]),
];

/// The wind that `parts` make in a run of this seed, for bodies of this name.
pub(super) fn wind(parts: &[WindPart], name: &str, seed: u64) -> Result<Wind, SceneWindError> {
    let mut wind = Wind::default();
    let felt = |part: &WindPart| part.bodies.is_empty() || part.bodies.iter().any(|of| of == name);
    for (number, part) in parts.iter().enumerate().filter(|(_, part)| felt(part)) {
        let field = match &part.field {
            SceneField::Table { path } => read_wind_table(path)?.into(),
            field => closed_form(field, seed.wrapping_add(number as u64))?,
        };
        match part.within {
            Some(region) => wind.add_within(field, region)?,
            None => wind.add(field)?,
        }
    }
    Ok(wind)
}

/// Any field but a table, which has none here.
fn closed_form(field: &SceneField, of_run: u64) -> Result<WindField, WindError> {
    Ok(match field {
        SceneField::Uniform(velocity) => WindField::Uniform(*velocity),
        SceneField::Shear(shear) => WindField::Shear(*shear),
        SceneField::Vortex(vortex) => WindField::Vortex(*vortex),
        SceneField::Jet(jet) => WindField::Jet(*jet),
        SceneField::Gusts { settings, seed } => {
            let seed = seed.unwrap_or(of_run);
            WindField::Gusts(Gusts::new(&GustSettings { seed, ..*settings })?)
        }
        SceneField::Table { .. } => WindField::Uniform([0.0; 3]),
    })
}

/// The velocity at the place and time of a release (m/s), but for tables, which are not read yet.
pub(super) fn at_release(parts: &[WindPart], seed: u64, position: [f64; 3]) -> [f64; 3] {
    let closed = parts.iter().filter(|part| !part.is_table());
    let closed: Vec<WindPart> = closed.cloned().collect();
    // A wind that cannot be made is told elsewhere.
    let wind = wind(&closed, OWN, seed).unwrap_or_default();
    wind.flow(position, 0.0, [0.0; 3]).velocity
}

impl WindPart {
    fn is_table(&self) -> bool {
        matches!(self.field, SceneField::Table { .. })
    }
}

/// Refuses winds for bodies that there are not.
pub(super) fn check_bodies(
    doc: &Document,
    raw: &[Spanned<RawWind>],
    names: &[String],
) -> Result<(), SceneError> {
    for bodies in raw.iter().filter_map(|raw| raw.get_ref().bodies.as_ref()) {
        if let Some(unknown) = bodies.get_ref().iter().find(|name| !names.contains(name)) {
            let message = format!(
                "`bodies` of a wind: there are none of `{unknown}`; this scene has `{}`",
                names.join("`, `")
            );
            return Err(doc.error(bodies.span(), message));
        }
    }
    Ok(())
}

/// `ground` is that of the run, `stream` the velocity of the fluid (m/s).
pub(super) fn resolve(
    doc: &Document,
    raw: &[Spanned<RawWind>],
    ground: Option<f64>,
    stream: [f64; 3],
) -> Result<Vec<WindPart>, SceneError> {
    if let Some(surplus) = raw.get(MAX_WINDS) {
        let message = format!(
            "a scene has at most {MAX_WINDS} winds, and this one {}",
            raw.len()
        );
        return Err(doc.error(surplus.span(), message));
    }
    let parts = raw.iter().map(|raw| part(doc, raw, ground.unwrap_or(0.0)));
    let mut parts = parts.collect::<Result<Vec<_>, _>>()?;
    // What is everywhere carries the gusts, unless they say otherwise.
    let everywhere = parts.iter().filter(|part| part.within.is_none());
    let mean = everywhere.fold(stream, |mean, part| match &part.field {
        SceneField::Uniform(velocity) => add(mean, *velocity),
        SceneField::Shear(shear) => add(mean, shear.velocity),
        _ => mean,
    });
    for (part, raw) in parts.iter_mut().zip(raw) {
        if let SceneField::Gusts { settings, .. } = &mut part.field
            && raw.get_ref().carried.is_none()
        {
            settings.carried = mean;
        }
        // What no single number tells: eddies that do not go together.
        closed_form(&part.field, 0).map_err(|error| doc.error(raw.span(), error.to_string()))?;
    }
    Ok(parts)
}

fn part(doc: &Document, raw: &Spanned<RawWind>, ground: f64) -> Result<WindPart, SceneError> {
    let given = raw.get_ref();
    let Some(name) = &given.field else {
        let names: Vec<String> = FIELDS.iter().map(|(name, _)| format!("`{name}`")).collect();
        let message = format!("a wind needs its `field`, one of {}", names.join(", "));
        return Err(doc.error(raw.span(), message));
    };
    let keys = doc.choose("`field` of a wind", name, FIELDS)?;
    if let Some((key, place)) = given.keys().find(|(key, _)| !keys.contains(key)) {
        let message = format!(
            "a wind that is `{}` has no `{key}`; it has `{}`",
            name.get_ref(),
            keys.join("`, `")
        );
        return Err(doc.error(place, message));
    }
    let needs = Needs { doc, raw };
    let field = match name.get_ref().as_str() {
        "uniform" => SceneField::Uniform(needs.velocity()?),
        "shear" => SceneField::Shear(Shear {
            velocity: needs.velocity()?,
            height: needs.number(&given.height, "height", SIZE)?,
            ground: doc.given(&given.ground, "ground", PLACE)?.unwrap_or(ground),
            profile: profile(doc, raw)?,
        }),
        "gusts" => SceneField::Gusts {
            settings: GustSettings {
                rms: needs.number(&given.rms, "rms", DEVIATION)?,
                length: needs.number(&given.length, "length", SIZE)?,
                smallest: doc.given(&given.smallest, "smallest", SIZE)?,
                carried: doc.vector(&given.carried, "carried", SPEED)?,
                seed: 0,
            },
            seed: given.seed.as_ref().map(|seed| seed.get_ref().0),
        },
        "vortex" => SceneField::Vortex(Vortex {
            centre: needs.numbers(&given.centre, "centre")?,
            axis: needs.axis()?,
            circulation: needs.number(&given.circulation, "circulation", CIRCULATION)?,
            core: needs.number(&given.core, "core", SIZE)?,
        }),
        "table" => SceneField::Table {
            path: match &given.file {
                Some(file) => file.get_ref().into(),
                None => return Err(needs.missing("a `file`, the path of an NPZ file")),
            },
        },
        _ => SceneField::Jet(Jet {
            centre: needs.numbers(&given.centre, "centre")?,
            axis: needs.axis()?,
            speed: needs.number(&given.speed, "speed", SPEED)?,
            diameter: needs.number(&given.diameter, "diameter", SIZE)?,
        }),
    };
    let within = given.within.as_ref();
    let within = within.map(|raw| region(doc, raw)).transpose()?;
    let bodies = given.bodies.as_ref().map(|bodies| bodies.get_ref().clone());
    Ok(WindPart {
        field,
        within,
        bodies: bodies.unwrap_or_default(),
    })
}

fn profile(doc: &Document, raw: &Spanned<RawWind>) -> Result<Profile, SceneError> {
    let RawWind {
        exponent,
        roughness,
        ..
    } = raw.get_ref();
    match (exponent, roughness) {
        (Some(exponent), None) => Ok(Profile::Power {
            exponent: doc.number(exponent, "exponent", EXPONENT)?,
        }),
        (None, Some(roughness)) => Ok(Profile::Log {
            roughness: doc.number(roughness, "roughness", SIZE)?,
        }),
        _ => {
            let message = "a wind that is `shear` needs an `exponent`, for a power of the height, or a `roughness` (m), for \
                           its logarithm, and not both";
            Err(doc.error(raw.span(), message))
        }
    }
}

fn region(doc: &Document, raw: &Spanned<RawWithin>) -> Result<Region, SceneError> {
    let within = raw.get_ref();
    let missing = |key: &str| doc.error(raw.span(), format!("`within` needs {key}"));
    let centre = within
        .centre
        .as_ref()
        .ok_or_else(|| missing("its `centre` (m)"))?;
    let centre = doc.numbers(centre, "centre", PLACE)?;
    let edge = within.edge.as_ref().ok_or_else(|| {
        missing("its `edge` (m): how thick the edge is in which the wind dies down")
    })?;
    let edge = doc.number(edge, "edge", SIZE)?;
    match (&within.size, &within.radius) {
        (Some(size), None) => Ok(Region::Box {
            centre,
            size: doc.numbers(size, "size", SIZE)?,
            edge,
        }),
        (None, Some(radius)) => Ok(Region::Sphere {
            centre,
            radius: doc.number(radius, "radius", SIZE)?,
            edge,
        }),
        _ => Err(missing(
            "a `size` (m), for a box, or a `radius` (m), for a ball, and not both",
        )),
    }
}

/// What a field cannot be without.
struct Needs<'a> {
    doc: &'a Document<'a>,
    raw: &'a Spanned<RawWind>,
}

impl Needs<'_> {
    fn missing(&self, key: &str) -> SceneError {
        let name = self.raw.get_ref().field.as_ref();
        let name = name.map_or("", |name| name.get_ref().as_str());
        let message = format!("a wind that is `{name}` needs {key}");
        self.doc.error(self.raw.span(), message)
    }

    fn number(
        &self,
        value: &Given<f64>,
        key: &str,
        kind: super::quantity::Kind,
    ) -> Result<f64, SceneError> {
        let number = self.doc.given(value, key, kind)?;
        number.ok_or_else(|| self.missing(&kind.named(key)))
    }

    fn numbers(&self, value: &Given<Vec<f64>>, key: &str) -> Result<[f64; 3], SceneError> {
        let values = value
            .as_ref()
            .ok_or_else(|| self.missing(&PLACE.named(key)))?;
        self.doc.numbers(values, key, PLACE)
    }

    fn velocity(&self) -> Result<[f64; 3], SceneError> {
        let value = &self.raw.get_ref().velocity;
        if value.is_none() {
            return Err(self.missing(&SPEED.named("velocity")));
        }
        self.doc.vector(value, "velocity", SPEED)
    }

    /// Of unit length. What is so to rounding keeps its bits: resolved scenes read back the same.
    fn axis(&self) -> Result<[f64; 3], SceneError> {
        let value = self.raw.get_ref().axis.as_ref();
        let value = value.ok_or_else(|| self.missing("an `axis`"))?;
        let axis: [f64; 3] = self.doc.numbers(value, "axis", DIRECTION)?;
        let length = length(&axis);
        if length < 1e-6 {
            let message = format!("`axis` must be at least 1e-6 long, and is {length:e} long");
            return Err(self.doc.error(value.span(), message));
        }
        Ok(match (length - 1.0).abs() < 1e-15 {
            true => axis,
            false => axis.map(|x| x / length),
        })
    }
}

impl RawWind {
    /// The keys that are given and go with some fields alone, and where they stand.
    fn keys(&self) -> impl Iterator<Item = (&'static str, Range<usize>)> {
        fn at<T>(value: &Given<T>) -> Option<Range<usize>> {
            value.as_ref().map(Spanned::span)
        }
        let all = [
            ("velocity", at(&self.velocity)),
            ("height", at(&self.height)),
            ("ground", at(&self.ground)),
            ("exponent", at(&self.exponent)),
            ("roughness", at(&self.roughness)),
            ("rms", at(&self.rms)),
            ("length", at(&self.length)),
            ("smallest", at(&self.smallest)),
            ("carried", at(&self.carried)),
            ("seed", at(&self.seed)),
            ("centre", at(&self.centre)),
            ("axis", at(&self.axis)),
            ("circulation", at(&self.circulation)),
            ("core", at(&self.core)),
            ("speed", at(&self.speed)),
            ("diameter", at(&self.diameter)),
            ("file", at(&self.file)),
        ];
        let present = all.into_iter();
        present.filter_map(|(key, place)| Some((key, place?)))
    }
}

/// # Errors
/// A path that TOML, which is UTF-8, cannot hold.
pub(super) fn write(part: &WindPart) -> Result<Spanned<RawWind>, WriteSceneError> {
    let raw = match &part.field {
        SceneField::Uniform(velocity) => RawWind {
            field: given("uniform".to_owned()),
            velocity: given(velocity.to_vec()),
            ..RawWind::default()
        },
        SceneField::Shear(shear) => {
            let (exponent, roughness) = match shear.profile {
                Profile::Power { exponent } => (given(exponent), None),
                Profile::Log { roughness } => (None, given(roughness)),
                _ => (None, None),
            };
            RawWind {
                field: given("shear".to_owned()),
                velocity: given(shear.velocity.to_vec()),
                height: given(shear.height),
                ground: given(shear.ground),
                exponent,
                roughness,
                ..RawWind::default()
            }
        }
        SceneField::Gusts { settings, seed } => RawWind {
            field: given("gusts".to_owned()),
            rms: given(settings.rms),
            length: given(settings.length),
            smallest: settings.smallest.and_then(given),
            carried: given(settings.carried.to_vec()),
            seed: seed.and_then(|seed| given(Seed(seed))),
            ..RawWind::default()
        },
        SceneField::Vortex(vortex) => RawWind {
            field: given("vortex".to_owned()),
            centre: given(vortex.centre.to_vec()),
            axis: given(vortex.axis.to_vec()),
            circulation: given(vortex.circulation),
            core: given(vortex.core),
            ..RawWind::default()
        },
        SceneField::Jet(jet) => RawWind {
            field: given("jet".to_owned()),
            centre: given(jet.centre.to_vec()),
            axis: given(jet.axis.to_vec()),
            speed: given(jet.speed),
            diameter: given(jet.diameter),
            ..RawWind::default()
        },
        SceneField::Table { path } => RawWind {
            field: given("table".to_owned()),
            file: given(utf8(path, "a wind")?),
            ..RawWind::default()
        },
    };
    let within = part.within.map(|region| {
        let raw = match region {
            Region::Box { centre, size, edge } => RawWithin {
                centre: given(centre.to_vec()),
                size: given(size.to_vec()),
                radius: None,
                edge: given(edge),
            },
            Region::Sphere {
                centre,
                radius,
                edge,
            } => RawWithin {
                centre: given(centre.to_vec()),
                size: None,
                radius: given(radius),
                edge: given(edge),
            },
            _ => RawWithin::default(),
        };
        Spanned::new(0..0, raw)
    });
    let bodies = match part.bodies.is_empty() {
        true => None,
        false => given(part.bodies.clone()),
    };
    Ok(Spanned::new(
        0..0,
        RawWind {
            bodies,
            within,
            ..raw
        },
    ))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test may panic")]

    use super::*;
    use crate::scene::Scene;

    fn parse(wind: &str) -> Result<Scene, SceneError> {
        let text = format!(
            "fluid = {{ preset = \"air\", velocity = [0.5, 0, 0] }}\n\
             run = {{ time_step = 0.01, duration = 1.0, ground = -3.0 }}\n\
             body = {{ shape = \"box\", size = [0.1, 0.02, 0.04], density = 50.0 }}\n{wind}"
        );
        Scene::parse("box", "box.toml", &text)
    }

    const ALL: &str = r#"
        [[wind]]
        field = "uniform"
        velocity = [1.0, 0.0, 0.5]
        within = { centre = [0, 1, 0], size = [2, 3, 4], edge = 0.5 }
        [[wind]]
        field = "shear"
        velocity = [3.0, 0.0, 0.0]
        height = 10.0
        roughness = 0.03
        [[wind]]
        field = "gusts"
        rms = 0.5
        length = 2.0
        [[wind]]
        field = "vortex"
        centre = [0, 0, 0]
        axis = [0, 2, 0]
        circulation = -0.3
        core = 0.2
        within = { centre = [0, 0, 0], radius = 3.0, edge = 1.0 }
        [[wind]]
        field = "jet"
        centre = [-1, 0, 0]
        axis = [1, 1, 0]
        speed = 4.0
        diameter = 0.4
        [[wind]]
        field = "table"
        file = "room.npz"
    "#;

    #[test]
    fn a_wind_may_be_for_some_bodies() {
        let text = |bodies: &str| {
            format!(
                "fluid.preset = \"air\"\n\
                 run = {{ time_step = 0.01, duration = 1.0, ground = -3.0 }}\n\
                 body = {{ shape = \"box\", size = [0.1, 0.01, 0.1], density = 500.0 }}\n\
                 crowd = {{ count = 4, kinds = [{{ scene = \"coin\" }}] }}\n\
                 [[wind]]\nfield = \"uniform\"\nvelocity = [1.0, 0.0, 0.0]\nbodies = {bodies}\n"
            )
        };
        let parse = |bodies: &str| Scene::parse("crowd", "crowd.toml", &text(bodies));
        let coins = parse("[\"coin\"]").unwrap();
        assert!(coins.make_wind().unwrap().is_empty());
        assert!(!coins.make_wind_for("coin").unwrap().is_empty());
        assert!(!parse("[\"own\"]").unwrap().make_wind().unwrap().is_empty());
        let again = Scene::parse("crowd", "", &coins.to_toml().unwrap()).unwrap();
        assert_eq!(again, coins);
        let error = parse("[\"leaf\"]").unwrap_err();
        assert!(
            error.message.contains("this scene has `own`, `coin`"),
            "{error}"
        );
    }

    #[test]
    fn every_field_is_read_and_written_as_it_was() {
        let scene = parse(ALL).unwrap();
        assert_eq!(scene.wind.len(), 6);
        let again = Scene::parse("box", "resolved", &scene.to_toml().unwrap()).unwrap();
        assert_eq!(again, scene);
        // The ground is the run's; fluid and winds everywhere carry the gusts.
        assert!(matches!(scene.wind[1].field, SceneField::Shear(shear) if shear.ground == -3.0));
        let SceneField::Gusts { settings, seed } = &scene.wind[2].field else {
            panic!("{:?}", scene.wind[2]);
        };
        assert_eq!((settings.carried, *seed), ([3.5, 0.0, 0.0], None));
        let at = |seed: u64| at_release(&scene.wind, seed, [0.1, 0.2, 0.3]);
        assert_eq!(at(1), at(1));
        assert_ne!(at(1), at(2));
        let told = scene.make_wind().unwrap_err().to_string();
        assert!(told.starts_with("room.npz: "), "{told}");
    }

    #[test]
    fn what_cannot_be_is_refused_where_it_stands() {
        for (wind, line, words) in [
            (
                "[[wind]]\nrms = 1",
                4,
                "a wind needs its `field`, one of `uniform`",
            ),
            ("[[wind]]\nfield = \"gust\"", 5, "gusts"),
            (
                "[[wind]]\nfield = \"jet\"\nrms = 1",
                6,
                "a wind that is `jet` has no `rms`",
            ),
            (
                "[[wind]]\nfield = \"gusts\"\nrms = 1",
                4,
                "needs `length` (m)",
            ),
            (
                "[[wind]]\nfield = \"gusts\"\nrms = -1\nlength = 1",
                6,
                "`rms`",
            ),
            (
                "[[wind]]\nfield = \"gusts\"\nrms = 1\nlength = 1\nsmallest = 2",
                4,
                "the smallest eddies of the gusts (2 m)",
            ),
            (
                "[[wind]]\nfield = \"shear\"\nvelocity = [1, 0, 0]\nheight = 1",
                4,
                "needs an `exponent`",
            ),
            (
                "[[wind]]\nfield = \"jet\"\ncentre = [0, 0, 0]\naxis = [0, 0, 0]\nspeed = 1\ndiameter = 1",
                7,
                "`axis` must be at least",
            ),
            (
                "[[wind]]\nfield = \"uniform\"\nvelocity = [nan, 0, 0]",
                6,
                "`velocity` (m/s) must be numbers",
            ),
            (
                "[[wind]]\nfield = \"uniform\"\nvelocity = [1, 0, 0]\nwithin = { centre = [0, 0, 0], edge = 1 }",
                7,
                "needs a `size` (m)",
            ),
            (
                "[[wind]]\nfield = \"uniform\"\nvelocity = [1, 0, 0]\nwithin = { centre = [0, 0, 0], radius = 1 }",
                7,
                "needs its `edge` (m)",
            ),
        ] {
            let error = parse(wind).unwrap_err();
            assert!(error.message.contains(words), "{error}");
            assert_eq!(error.line, line, "{error}");
        }
        let many = "[[wind]]\nfield = \"uniform\"\nvelocity = [1, 0, 0]\n".repeat(33);
        let error = parse(&many).unwrap_err();
        assert!(error.message.contains("at most 32 winds"), "{error}");
    }
}
