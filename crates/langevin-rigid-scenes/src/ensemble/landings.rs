//! How each run of an ensemble began and ended, as a table.

use langevin_rigid::linalg::Vec3;
use langevin_rigid::linalg::vector::norm;
use langevin_rigid_formats::table::{Column, Table, Values};

use super::draw::Change;
use super::fall::Fall;
use super::lying::Lying;
use super::statistics::face;
use crate::prepared::Prepared;

/// What a file of landings says of itself.
pub const LANDINGS_ABOUT: &str = "landings of an ensemble; SI units and degrees; x, z and depth from the release point of the scene";

/// A row for each fall, in their order; SI units and degrees.
///
/// | columns | |
/// |---|---|
/// | `run` | number of the run |
/// | `height`, `tilt`, `heading` | of the release, as drawn: see [`Scatter`](crate::scene::Scatter) |
/// | `release_qx` ... `release_qw` | orientation at release, from body to world |
/// | `release_vx` ..., `release_wx` ... | velocity and angular velocity at release, world frame |
/// | `size`, `mass` | of the body: a multiple of the scene's, and kg |
/// | `fluid_density`, `fluid_viscosity`, `wind_x` ... | of the fluid; the wind without the fields that are added to it |
/// | `t` | when the fall ended |
/// | `x`, `z`, `depth` | where the centre of mass was then, from the scene's release point, depth downwards |
/// | `ending` | `ground`, `time`, `rest` or `diverged` |
/// | `motion`, `turnovers`, `swings` | its [`MotionClass`](super::MotionClass), and what that counts |
/// | `speed`, `spin` | when the fall ended: m/s, rad/s |
/// | `up`, `face` | the world's up in the body's thin axis, and which face that is: `up`, `down` or `edge` (steeper than 45 degrees); where the body came to rest, if it did, else when the fall ended |
/// | `lying_t`, `lying_x`, `lying_z`, `lying_depth` | when and where the body came to rest, if it did |
pub fn landings(prepared: &Prepared, falls: &[Fall]) -> Table {
    let scene = prepared.scene();
    let body = prepared.body();
    let change = |f: &Fall| f.draw.change.unwrap_or_default();
    let drawn_mass = |f: &Fall| {
        let Change { size, mass, .. } = change(f);
        mass.unwrap_or_else(|| size.map_or(body.mass, |s| s * s * s * body.mass))
    };
    let fluid = &scene.fluid;
    let of = Of(falls);
    let mut columns = vec![
        of.counts("run", |f| f.run),
        of.numbers("height", |f| f.draw.release.position[1]),
        of.numbers("tilt", |f| f.draw.tilt),
        of.numbers("heading", |f| f.draw.heading),
    ];
    for (i, name) in ["release_qx", "release_qy", "release_qz", "release_qw"]
        .into_iter()
        .enumerate()
    {
        columns.push(of.numbers(name, |f| f.draw.release.orientation[i]));
    }
    let velocity = |f: &Fall| f.draw.release.world_velocity();
    columns.extend(of.vector(["release_vx", "release_vy", "release_vz"], velocity));
    let spin = |f: &Fall| f.draw.release.world_angular_velocity();
    columns.extend(of.vector(["release_wx", "release_wy", "release_wz"], spin));
    columns.extend([
        of.numbers("size", |f| change(f).size.unwrap_or(1.0)),
        of.numbers("mass", drawn_mass),
        of.numbers("fluid_density", |f| {
            change(f).density.unwrap_or(fluid.density)
        }),
        of.numbers("fluid_viscosity", |f| {
            change(f).viscosity.unwrap_or(fluid.viscosity)
        }),
    ]);
    let wind = |f: &Fall| change(f).wind.unwrap_or(fluid.velocity);
    columns.extend(of.vector(["wind_x", "wind_y", "wind_z"], wind));
    let up = |f: &Fall| f.lying.map_or(f.up, |lying| lying.up);
    let lying = |name: &'static str, value: fn(&Lying) -> f64| {
        let values = falls.iter().map(|f| f.lying.as_ref().map(value));
        Column {
            name: name.into(),
            values: Values::Optional(values.collect()),
        }
    };
    columns.extend([
        of.numbers("t", |f| f.time),
        of.numbers("x", |f| f.end[0]),
        of.numbers("z", |f| f.end[2]),
        of.numbers("depth", |f| f.end[1]),
        of.words("ending", |f| f.ending.name()),
        of.words("motion", |f| f.motion.motion().name()),
        of.counts("turnovers", |f| f.motion.turnovers()),
        of.counts("swings", |f| f.motion.swings()),
        of.numbers("speed", |f| norm(f.velocity)),
        of.numbers("spin", |f| norm(f.angular_velocity)),
        of.numbers("up", up),
        of.words("face", |f| face(up(f))),
        lying("lying_t", |lying| lying.time),
        lying("lying_x", |lying| lying.place[0]),
        lying("lying_z", |lying| lying.place[2]),
        lying("lying_depth", |lying| lying.place[1]),
    ]);
    Table::new(columns)
}

/// Columns of these falls.
struct Of<'a>(&'a [Fall]);

impl Of<'_> {
    fn numbers(&self, name: &'static str, value: impl Fn(&Fall) -> f64) -> Column {
        Column {
            name: name.into(),
            values: Values::Numbers(self.0.iter().map(value).collect()),
        }
    }

    fn vector(&self, names: [&'static str; 3], value: impl Fn(&Fall) -> Vec3) -> [Column; 3] {
        std::array::from_fn(|i| self.numbers(names[i], |f| value(f)[i]))
    }

    fn counts(&self, name: &'static str, value: impl Fn(&Fall) -> u32) -> Column {
        Column {
            name: name.into(),
            values: Values::Counts(self.0.iter().map(value).collect()),
        }
    }

    fn words(&self, name: &'static str, value: impl Fn(&Fall) -> &'static str) -> Column {
        Column {
            name: name.into(),
            values: Values::Words(self.0.iter().map(|fall| value(fall).into()).collect()),
        }
    }
}
