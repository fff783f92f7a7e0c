//! How the runs of an ensemble differ: `[scatter]`.

use langevin_rigid::{Fluid, Settings};
use serde_spanned::Spanned;
use toml::Value;

use super::place::{Document, SceneError};
use super::quantity::{
    ANGLE, ANGLE_SCATTER, DENSITY, HEIGHT_SCATTER, Kind, MASS, MASS_SCATTER, PLACE, POSITIVE,
    RATIO_SCATTER, SPEED, SPEED_SCATTER, SPIN, SPIN_SCATTER, Short, VISCOSITY,
};
use super::raw::{Given, RawScatter, given};
use super::surroundings::preset;

/// Most values of a list.
const MOST_VALUES: usize = 100_000;

/// What is drawn anew for each run of an ensemble; what is not given is the scene's.
///
/// Draws of different quantities are independent of each other and of the noise of the steps.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Scatter {
    /// Height of the release point (m).
    pub height: Option<Spread>,
    /// Turn of the body from the scene's release about the world's z axis (degrees). A [`Spread::About`] turns it about a
    /// horizontal axis of any direction: its deviation is that about each of x and z.
    pub tilt: Option<Spread>,
    /// Turn about the vertical after that (degrees).
    pub heading: Option<Spread>,
    /// Velocity, world frame (m/s).
    pub velocity: Option<Spread<3>>,
    /// Angular velocity, world frame (rad/s).
    pub spin: Option<Spread<3>>,
    /// Size of the body, as a multiple of the scene's; of the same density where `mass` is not given.
    pub size: Option<Spread>,
    /// Mass of the body (kg), whatever its size; the inertia goes with it.
    pub mass: Option<Spread>,
    /// Fluids, each as likely as any other: name and properties, without velocity.
    pub fluid: Vec<(&'static str, Fluid)>,
    /// Density of the fluid (kg/m^3).
    pub fluid_density: Option<Spread>,
    /// Kinematic viscosity of the fluid (m^2/s).
    pub fluid_viscosity: Option<Spread>,
    /// Velocity of the fluid, world frame (m/s), to which the fields of the wind are added.
    pub wind: Option<Spread<3>>,
}

/// What the values of a quantity of N components are drawn from.
#[derive(Debug, Clone, PartialEq)]
pub enum Spread<const N: usize = 1> {
    /// Normal about the scene's own value: the standard deviation of each component.
    About(f64),
    /// Uniform, each component between these two.
    Uniform([f64; N], [f64; N]),
    /// Normal: mean and standard deviation of each component. What is impossible, like a mass below zero, is drawn again.
    Normal([f64; N], [f64; N]),
    /// One of these, each as likely as any other.
    Values(Vec<[f64; N]>),
}

impl Scatter {
    /// Whether all runs begin as the scene says.
    pub fn is_none(&self) -> bool {
        *self == Self::default()
    }

    /// Whether runs differ in body or fluid, not in their releases alone.
    pub fn changes_body_or_fluid(&self) -> bool {
        let numbers = [
            &self.size,
            &self.mass,
            &self.fluid_density,
            &self.fluid_viscosity,
        ];
        numbers.iter().any(|spread| spread.is_some())
            || !self.fluid.is_empty()
            || self.wind.is_some()
    }
}

/// A quantity as it may be spread: its key, what its values may be, and its deviations.
#[derive(Clone, Copy)]
struct Quantity {
    key: &'static str,
    kind: Kind,
    deviation: Kind,
}

const fn quantity(key: &'static str, kind: Kind, deviation: Kind) -> Quantity {
    Quantity {
        key,
        kind,
        deviation,
    }
}

const HEIGHT: Quantity = quantity("height", PLACE, HEIGHT_SCATTER);
const TILT: Quantity = quantity("tilt", ANGLE, ANGLE_SCATTER);
const HEADING: Quantity = quantity("heading", ANGLE, ANGLE_SCATTER);
const VELOCITY: Quantity = quantity("velocity", SPEED, SPEED_SCATTER);
const SPIN_OF_BODY: Quantity = quantity("spin", SPIN, SPIN_SCATTER);
const SIZE: Quantity = quantity("size", POSITIVE, RATIO_SCATTER);
const MASS_OF_BODY: Quantity = quantity("mass", MASS, MASS_SCATTER);
const FLUID_DENSITY: Quantity = quantity("fluid_density", DENSITY, DENSITY);
const FLUID_VISCOSITY: Quantity = quantity("fluid_viscosity", VISCOSITY, VISCOSITY);
const WIND: Quantity = quantity("wind", SPEED, SPEED_SCATTER);

pub(super) fn resolve(doc: &Document, raw: &RawScatter) -> Result<Scatter, SceneError> {
    let scatter = Scatter {
        height: spread(doc, &raw.height, HEIGHT)?,
        tilt: spread(doc, &raw.tilt, TILT)?,
        heading: spread(doc, &raw.heading, HEADING)?,
        velocity: spread(doc, &raw.velocity, VELOCITY)?,
        spin: spread(doc, &raw.spin, SPIN_OF_BODY)?,
        size: spread(doc, &raw.size, SIZE)?,
        mass: spread(doc, &raw.mass, MASS_OF_BODY)?,
        fluid: fluids(doc, &raw.fluid)?,
        fluid_density: spread(doc, &raw.fluid_density, FLUID_DENSITY)?,
        fluid_viscosity: spread(doc, &raw.fluid_viscosity, FLUID_VISCOSITY)?,
        wind: spread(doc, &raw.wind, WIND)?,
    };
    let stated_twice = [&raw.fluid_density, &raw.fluid_viscosity];
    match stated_twice.into_iter().flatten().next() {
        Some(other) if !scatter.fluid.is_empty() => {
            let message = "give `fluid`, or its density and viscosity, not both";
            Err(doc.error(other.span(), message))
        }
        _ => Ok(scatter),
    }
}

/// A history of turbulence is that of one body in one fluid.
pub(super) fn check_history(
    doc: &Document,
    raw: &RawScatter,
    scatter: &Scatter,
    settings: &Settings,
) -> Result<(), SceneError> {
    if !(settings.turbulence.needs_history() && scatter.changes_body_or_fluid()) {
        return Ok(());
    }
    let fluid = raw.fluid.as_ref().map(Spanned::span);
    let others = [
        &raw.size,
        &raw.mass,
        &raw.fluid_density,
        &raw.fluid_viscosity,
        &raw.wind,
    ];
    let spans = others.into_iter().flatten().map(Spanned::span);
    let place = fluid.into_iter().chain(spans).next().unwrap_or(0..0);
    let message = "body and fluid cannot be drawn where `turbulence` takes a precomputed history, which is that of one \
                   body in one fluid: leave this out, or take `turbulence = \"body-driven\"`";
    Err(doc.error(place, message))
}

fn fluids(
    doc: &Document,
    raw: &Given<Vec<Spanned<String>>>,
) -> Result<Vec<(&'static str, Fluid)>, SceneError> {
    let Some(names) = raw else {
        return Ok(Vec::new());
    };
    if names.get_ref().is_empty() {
        return Err(doc.error(names.span(), "`fluid` takes at least one name"));
    }
    names
        .get_ref()
        .iter()
        .map(|name| preset(doc, name))
        .collect()
}

/// A quantity of N components: a standard deviation, a list of values, or a table of what they are drawn from.
fn spread<const N: usize>(
    doc: &Document,
    raw: &Given<Value>,
    quantity: Quantity,
) -> Result<Option<Spread<N>>, SceneError> {
    let Some(raw) = raw else { return Ok(None) };
    let Quantity { key, kind, .. } = quantity;
    let wrong = |message: String| doc.error(raw.span(), message);
    let read = |value: &Value, kind: Kind| components::<N>(value, key, kind).map_err(wrong);
    let pair = |value: &Value, names: [&str; 2], kinds: [Kind; 2]| match value.as_array() {
        Some(two) if two.len() == 2 => Ok((read(&two[0], kinds[0])?, read(&two[1], kinds[1])?)),
        _ => Err(wrong(format!(
            "`{key}` takes [{}, {}] here",
            names[0], names[1]
        ))),
    };
    let spread = match raw.get_ref() {
        Value::Array(values) if (1..=MOST_VALUES).contains(&values.len()) => {
            let values: Result<_, _> = values.iter().map(|value| read(value, kind)).collect();
            Spread::Values(values?)
        }
        Value::Array(_) => {
            return Err(wrong(format!(
                "`{key}` takes a list of 1 to {MOST_VALUES} values"
            )));
        }
        Value::Table(table) => match table.iter().next() {
            Some((name, value)) if name == "uniform" && table.len() == 1 => {
                let (least, most) = pair(value, ["least", "most"], [kind, kind])?;
                if least.iter().zip(&most).any(|(least, most)| least > most) {
                    return Err(wrong(format!("`{key}` takes [least, most] in this order")));
                }
                Spread::Uniform(least, most)
            }
            Some((name, value)) if name == "normal" && table.len() == 1 => {
                let kinds = [kind, quantity.deviation];
                let (mean, deviation) = pair(value, ["mean", "standard deviation"], kinds)?;
                Spread::Normal(mean, deviation)
            }
            _ => return Err(wrong(forms::<N>(key))),
        },
        value => match number(value) {
            Some(x) if quantity.deviation.includes(x) => Spread::About(x),
            Some(x) => {
                let what = quantity.deviation.named(key);
                let kind = quantity.deviation;
                return Err(wrong(format!("{what} must be {kind}, and is {}", Short(x))));
            }
            None => return Err(wrong(forms::<N>(key))),
        },
    };
    Ok(Some(spread))
}

/// What can be written.
fn forms<const N: usize>(key: &str) -> String {
    let value = if N == 1 { "a" } else { "[x, y, z]" };
    format!(
        "`{key}` takes a standard deviation about the scene's value, a list of values [{value}, ...], \
         {{ uniform = [least, most] }} or {{ normal = [mean, deviation] }}"
    )
}

/// N numbers; a single one stands for all.
fn components<const N: usize>(value: &Value, key: &str, kind: Kind) -> Result<[f64; N], String> {
    let numbers = match value {
        Value::Array(list) if N > 1 => {
            let numbers: Option<Vec<f64>> = list.iter().map(number).collect();
            numbers.and_then(|numbers| numbers.try_into().ok())
        }
        value => number(value).map(|x| [x; N]),
    };
    let Some(numbers) = numbers else {
        let what = if N == 1 {
            "numbers"
        } else {
            "numbers or [x, y, z]"
        };
        return Err(format!(
            "the values of `{key}` must be {what}, and one is {value}"
        ));
    };
    match numbers.iter().find(|x| !kind.includes(**x)) {
        None => Ok(numbers),
        Some(x) => {
            let what = kind.named(key);
            Err(format!("{what} must be {kind}, and one is {}", Short(*x)))
        }
    }
}

fn number(value: &Value) -> Option<f64> {
    match value {
        Value::Float(x) => Some(*x),
        Value::Integer(n) => Some(*n as f64),
        _ => None,
    }
}

/// The section of a resolved scene.
pub(super) fn write(scatter: &Scatter) -> RawScatter {
    let names = scatter.fluid.iter();
    let names: Vec<_> = names
        .map(|(name, _)| Spanned::new(0..0, (*name).to_owned()))
        .collect();
    RawScatter {
        height: written(&scatter.height),
        tilt: written(&scatter.tilt),
        heading: written(&scatter.heading),
        velocity: written(&scatter.velocity),
        spin: written(&scatter.spin),
        size: written(&scatter.size),
        mass: written(&scatter.mass),
        fluid: (!names.is_empty()).then_some(names).and_then(given),
        fluid_density: written(&scatter.fluid_density),
        fluid_viscosity: written(&scatter.fluid_viscosity),
        wind: written(&scatter.wind),
    }
}

fn written<const N: usize>(spread: &Option<Spread<N>>) -> Given<Value> {
    let value = |numbers: &[f64; N]| match numbers.as_slice() {
        [x] => Value::Float(*x),
        numbers => Value::Array(numbers.iter().map(|x| Value::Float(*x)).collect()),
    };
    let pair = |name: &str, a, b| {
        let pair = Value::Array(vec![value(a), value(b)]);
        Value::Table(std::iter::once((name.to_owned(), pair)).collect())
    };
    spread.as_ref().and_then(|spread| {
        given(match spread {
            Spread::About(deviation) => Value::Float(*deviation),
            Spread::Uniform(least, most) => pair("uniform", least, most),
            Spread::Normal(mean, deviation) => pair("normal", mean, deviation),
            Spread::Values(values) => Value::Array(values.iter().map(value).collect()),
        })
    })
}
