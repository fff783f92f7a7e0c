//! Wind: velocity fields that vary in space and time, and add up.

mod gusts;
mod jet;
mod region;
mod shear;
mod table;
mod vortex;

pub use gusts::{GustSettings, Gusts};
pub use jet::Jet;
pub use region::Region;
pub use shear::{Profile, Shear};
pub use table::{Table, TableError};
pub use vortex::Vortex;

use crate::elementary::polynomial;
use crate::input::Flow;
use crate::linalg::{Mat3, Vec3, add, add_scaled, dot, lift, mat_vec, norm, scale, sub};
use crate::real::Real;

/// The velocity of the fluid wherever and whenever a body may be: the sum of any number of fields.
///
/// A pure function of place and time: any order, any number of threads and any number of bodies in lanes give the
/// same bits.
///
/// ```
/// use langevin_rigid::wind::{GustSettings, Gusts, Profile, Shear, Wind};
/// let mut wind = Wind::default();
/// wind.add(Shear { velocity: [3.0, 0.0, 0.0], height: 10.0, ground: 0.0, profile: Profile::Log { roughness: 0.03 } })?;
/// wind.add(Gusts::new(&GustSettings { rms: 0.6, length: 5.0, carried: [3.0, 0.0, 0.0], ..GustSettings::default() })?)?;
/// let flow = wind.flow([0.0, 2.0, 0.0], 1.5, [0.0; 3]);
/// assert!(flow.velocity[0] > 0.0 && flow.gradient[0][1] != 0.0);
/// # Ok::<(), langevin_rigid::wind::WindError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wind {
    /// Those in closed form.
    fields: Vec<Limited>,
    tables: Vec<(Table, Option<Region>)>,
}

/// One field of a [`Wind`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub enum WindField {
    /// The same velocity everywhere (m/s), world frame.
    Uniform(Vec3),
    /// Wind that grows with the height above a ground.
    Shear(Shear),
    /// Homogeneous isotropic turbulence.
    Gusts(Gusts),
    /// A line about which the fluid turns.
    Vortex(Vortex),
    /// What a fan blows.
    Jet(Jet),
    /// Velocities on a grid.
    Table(Table),
}

/// A field in closed form, and where it is.
#[derive(Debug, Clone, PartialEq)]
struct Limited {
    field: WindField,
    region: Option<Region>,
}

/// Why a field is none.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum WindError {
    /// A number is not finite.
    #[error("{name} of the {field} must be finite, not {value}")]
    NotFinite {
        /// Of which field.
        field: &'static str,
        /// What it is.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A number is not positive.
    #[error("{name} of the {field} must be positive, not {value}")]
    NotPositive {
        /// Of which field.
        field: &'static str,
        /// What it is.
        name: &'static str,
        /// Its value.
        value: f64,
    },
    /// A direction has no length.
    #[error("the axis of the {0} has no length")]
    NoAxis(&'static str),
    /// Smallest and largest eddies do not go together.
    #[error(
        "the smallest eddies of the gusts ({smallest} m) must be between a ten-thousandth of their length ({length} m) and \
         that length"
    )]
    Eddies {
        /// Size of the smallest (m).
        smallest: f64,
        /// Integral length scale (m).
        length: f64,
    },
}

macro_rules! fields {
    ($($kind:ident($of:ty)),*) => {
        $(impl From<$of> for WindField {
            fn from(field: $of) -> Self {
                Self::$kind(field)
            }
        })*
    };
}

fields!(
    Shear(Shear),
    Gusts(Gusts),
    Vortex(Vortex),
    Jet(Jet),
    Table(Table)
);

impl Wind {
    /// Whether there is none.
    pub fn is_empty(&self) -> bool {
        self.fields.is_empty() && self.tables.is_empty()
    }

    /// Adds a field, everywhere.
    ///
    /// # Errors
    /// [`WindError`], which names the field and what is wrong with it.
    pub fn add(&mut self, field: impl Into<WindField>) -> Result<(), WindError> {
        self.put(field.into(), None)
    }

    /// Adds a field within a region.
    ///
    /// # Errors
    /// As [`Wind::add`].
    pub fn add_within(
        &mut self,
        field: impl Into<WindField>,
        region: Region,
    ) -> Result<(), WindError> {
        region.check()?;
        self.put(field.into(), Some(region))
    }

    fn put(&mut self, mut field: WindField, region: Option<Region>) -> Result<(), WindError> {
        match &mut field {
            WindField::Uniform(velocity) => finite("uniform wind", "velocity", velocity)?,
            WindField::Shear(shear) => shear.check()?,
            WindField::Vortex(vortex) => vortex.make_ready()?,
            WindField::Jet(jet) => jet.make_ready()?,
            WindField::Gusts(_) | WindField::Table(_) => {}
        }
        match field {
            WindField::Table(table) => self.tables.push((table, region)),
            field => self.fields.push(Limited { field, region }),
        }
        Ok(())
    }

    /// The fluid at `position` (m, world frame) and `time` (s), for the [`Input`](crate::Input) of a body there.
    ///
    /// `stream` (m/s) is what the wind comes on top of, [`Fluid::velocity`](crate::Fluid::velocity): it is not in the
    /// velocity, but carries the wind along, which counts for its acceleration.
    pub fn flow(&self, position: Vec3, time: f64, stream: Vec3) -> Flow {
        let gusts = |gusts: &Gusts| gusts.alone(&position, time);
        let mut local = self.closed_forms(&position, time, gusts);
        self.add_tables(&mut local, position, time);
        let acceleration = local.acceleration(stream);
        Flow {
            velocity: local.velocity,
            gradient: local.gradient,
            acceleration,
        }
    }

    /// Whether it is the same everywhere and always.
    pub(crate) fn is_uniform(&self) -> bool {
        let uniform = |limited: &Limited| {
            matches!(limited.field, WindField::Uniform(_)) && limited.region.is_none()
        };
        self.tables.is_empty() && self.fields.iter().all(uniform)
    }

    /// Where bodies in lanes are.
    #[inline(always)]
    pub(crate) fn in_lanes<R: Real>(&self, position: &Vec3<R>, time: R) -> Local<R> {
        self.closed_forms(
            position,
            time,
            #[inline(always)]
            |gusts| gusts.over_bodies(position, time),
        )
    }

    /// Whether it has more than [`Wind::in_lanes`] tells.
    pub(crate) fn has_tables(&self) -> bool {
        !self.tables.is_empty()
    }

    /// The sum of the fields in closed form, of one body or of those in lanes.
    #[inline(always)]
    fn closed_forms<R: Real>(
        &self,
        position: &Vec3<R>,
        time: R,
        gusts_at: impl Fn(&Gusts) -> Local<R>,
    ) -> Local<R> {
        let mut sum = Local::none(time);
        for Limited { field, region } in &self.fields {
            let local = match field {
                WindField::Uniform(velocity) => Local {
                    velocity: lift(time, velocity),
                    ..Local::none(time)
                },
                WindField::Shear(shear) => shear.at(position),
                WindField::Gusts(gusts) => gusts_at(gusts),
                WindField::Vortex(vortex) => vortex.at(position),
                WindField::Jet(jet) => jet.at(position),
                WindField::Table(_) => continue,
            };
            sum.add(&match region {
                Some(region) => local.within(region, position),
                None => local,
            });
        }
        sum
    }

    /// Adds what the tables have.
    pub(crate) fn add_tables(&self, local: &mut Local<f64>, position: Vec3, time: f64) {
        for (table, region) in &self.tables {
            let here = table.at(position, time);
            local.add(&match region {
                Some(region) => here.within(region, &position),
                None => here,
            });
        }
    }
}

/// A field at a place and a time: velocity (m/s), `gradient[i][j]` du_i/dx_j (1/s), and its rate of change at that place
/// (m/s^2).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Local<R = f64> {
    pub(crate) velocity: Vec3<R>,
    pub(crate) gradient: Mat3<R>,
    pub(crate) rate: Vec3<R>,
}

impl<R: Real> Local<R> {
    #[inline(always)]
    pub(crate) fn none(like: R) -> Self {
        let zero = [like.of(0.0); 3];
        Self {
            velocity: zero,
            gradient: [zero; 3],
            rate: zero,
        }
    }

    #[inline(always)]
    fn add(&mut self, other: &Self) {
        self.velocity = add(self.velocity, other.velocity);
        self.rate = add(self.rate, other.rate);
        for i in 0..3 {
            self.gradient[i] = add(self.gradient[i], other.gradient[i]);
        }
    }

    /// Material acceleration, on top of a stream (m/s).
    #[inline(always)]
    pub(crate) fn acceleration(&self, stream: Vec3) -> Vec3<R> {
        let like = self.rate[0];
        let carried = add(self.velocity, lift(like, &stream));
        add(self.rate, mat_vec(&self.gradient, carried))
    }

    /// Whether all of it is finite, and the acceleration that it makes.
    #[inline(always)]
    pub(crate) fn is_finite(&self, acceleration: &Vec3<R>) -> R::Mask {
        let mut sum = acceleration[0].abs() + acceleration[1].abs() + acceleration[2].abs();
        for x in self.numbers() {
            sum = sum + x.abs();
        }
        sum.less(sum.of(f64::INFINITY))
    }

    #[inline(always)]
    pub(crate) fn numbers(&self) -> [R; 15] {
        let ([u, v, w], [a, b, c]) = (self.velocity, self.rate);
        let [[d, e, f], [g, h, i], [j, k, l]] = self.gradient;
        [u, v, w, a, b, c, d, e, f, g, h, i, j, k, l]
    }

    #[inline(always)]
    pub(crate) fn of_numbers([u, v, w, a, b, c, d, e, f, g, h, i, j, k, l]: [R; 15]) -> Self {
        Self {
            velocity: [u, v, w],
            rate: [a, b, c],
            gradient: [[d, e, f], [g, h, i], [j, k, l]],
        }
    }

    /// The same times the weight of a region.
    #[inline(always)]
    fn within(self, region: &Region, position: &Vec3<R>) -> Self {
        let (weight, slope) = region.weight(position);
        let mut gradient = self.gradient;
        for i in 0..3 {
            gradient[i] = add_scaled(scale(weight, gradient[i]), self.velocity[i], slope);
        }
        Self {
            velocity: scale(weight, self.velocity),
            gradient,
            rate: scale(weight, self.rate),
        }
    }
}

/// (1 - e^-z)/z and its derivative, for z >= 0.
#[inline(always)]
fn decayed<R: Real>(z: R, exponential: R) -> (R, R) {
    let one = z.of(1.0);
    let small = z.less(z.of(0.1));
    let safe = R::choose(small, one, z);
    let value = (one - exponential) / safe;
    let slope = (exponential - value) / safe;
    (
        R::choose(small, polynomial(z, &DECAYED), value),
        R::choose(small, polynomial(z, &DECAYED_SLOPE), slope),
    )
}

/// Taylor's series of (1 - e^-z)/z and of its derivative.
const DECAYED: [f64; 7] = [
    1.0,
    -1.0 / 2.0,
    1.0 / 6.0,
    -1.0 / 24.0,
    1.0 / 120.0,
    -1.0 / 720.0,
    1.0 / 5040.0,
];
const DECAYED_SLOPE: [f64; 7] = [
    -1.0 / 2.0,
    1.0 / 3.0,
    -1.0 / 8.0,
    1.0 / 30.0,
    -1.0 / 144.0,
    1.0 / 840.0,
    -1.0 / 5760.0,
];

/// The place relative to a line through `centre` along `axis`: how far along it, and the way to it from the line.
#[inline(always)]
fn about_line<R: Real>(position: &Vec3<R>, centre: Vec3, axis: Vec3) -> (R, Vec3<R>) {
    let like = position[0];
    let away = sub(*position, lift(like, &centre));
    let axis = lift(like, &axis);
    let along = dot(away, axis);
    (along, add_scaled(away, -along, axis))
}

fn unit(axis: Vec3, field: &'static str) -> Result<Vec3, WindError> {
    finite(field, "axis", &axis)?;
    let length = norm(axis);
    if length > 0.0 && length.is_finite() {
        Ok(axis.map(|x| x / length))
    } else {
        Err(WindError::NoAxis(field))
    }
}

fn finite(field: &'static str, name: &'static str, values: &[f64]) -> Result<(), WindError> {
    match values.iter().find(|x| !x.is_finite()) {
        Some(&value) => Err(WindError::NotFinite { field, name, value }),
        None => Ok(()),
    }
}

fn positive(field: &'static str, name: &'static str, value: f64) -> Result<(), WindError> {
    finite(field, name, &[value])?;
    if value > 0.0 {
        Ok(())
    } else {
        Err(WindError::NotPositive { field, name, value })
    }
}

#[cfg(test)]
mod tests;
