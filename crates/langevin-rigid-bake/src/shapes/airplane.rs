//! The classic paper dart, as a solid.
//!
//! A square sheet of side L is folded along its middle, its front corners to the middle line
//! (45° at the nose), the new edges to it again (22.5°), and the wings down along the bisector
//! (δ = 11.25°). What remains, with the nose as apex:
//!
//! - the keel, a triangle of angle δ: the fold along the bottom of length L, the wing root above
//!   of length L / cos δ, a right angle at the bottom rear;
//! - each wing, a triangle of angle δ: the root L / cos δ and the leading edge L / cos 2δ.
//!
//! The sheet covers them several times. In polar coordinates (r, φ) about the nose the folds take
//! the sectors φ of a half sheet to the dart's 0..2δ back and forth, so the wing consists of the
//! sheet's sectors δ..3δ and 5δ..7δ, the keel of the others. The half sheet reaches to
//! r = L / cos φ (rear edge) up to tan φ = 1/2 and L / (2 sin φ) (side) beyond, which makes on
//! average 2.53 layers in a wing and 4.58 in the keel, both its sides together. The solid has
//! these mean thicknesses throughout.

use super::builder::{Builder, nearest};
use super::{ShapeError, enough, positive};
use crate::mass_properties::centroid;
use crate::mesh::TriMesh;
use crate::mesh::vector::{IDENTITY, scale};

const NAME: &str = "paper airplane";
/// The last fold's angle at the nose, a sixteenth of a turn over two (rad).
const DELTA: f64 = std::f64::consts::PI / 16.0;
/// Cells across a wing or the keel per cell along it: near equilateral would be 0.2, but lift
/// and the wings' added mass vary across.
const CELLS_ACROSS: f64 = 0.31;

pub(super) fn mesh(side: f64, thickness: f64, triangles: usize) -> Result<TriMesh, ShapeError> {
    positive(NAME, "side", side)?;
    positive(NAME, "thickness", thickness)?;
    enough(NAME, triangles, 24)?;
    let dart = Dart::folded(side, thickness);
    let rows = Rows::nearest(triangles);
    let mut surface = Builder::new(|place| dart.position(&rows, place));
    for left in [false, true] {
        add_half(&mut surface, &rows, left);
    }
    add_middle(&mut surface, &rows);
    let mesh = surface.finish()?;
    Ok(mesh.transformed(IDENTITY, scale(-1.0, centroid(&mesh)), 1.0)?)
}

/// Dimensions of the folded sheet (m), the nose at the origin, X forward, Y up, Z to the right.
struct Dart {
    root_length: f64,
    /// The wing tip, from the end of the nose's edge: x and span.
    tip: [f64; 2],
    /// The rear end of the keel's bottom fold: x and y below the wing.
    bottom: [f64; 2],
    wing_thickness: f64,
    keel_thickness: f64,
}

impl Dart {
    fn folded(side: f64, thickness: f64) -> Dart {
        let (sin, cos) = (libm::sin(DELTA), libm::cos(DELTA));
        let cos2 = libm::cos(2.0 * DELTA);
        let root_length = side / cos;
        let tip = [-side * cos / cos2, side * sin / cos2];
        let bottom = [-side * cos, -side * sin];
        let wing = 0.5 * root_length * tip[1];
        let keel = 0.5 * root_length * -bottom[1];
        let sheet_in_wing = side * side * (sector(1.0, 3.0) + sector(5.0, 7.0));
        let sheet_in_keel = side * side - 2.0 * sheet_in_wing;
        let wing_thickness = thickness * sheet_in_wing / wing;
        let keel_thickness = thickness * sheet_in_keel / keel;
        // Where the keel meets the wings the solid has a bar more than the sum of its parts;
        // both thicknesses shrink by f with f + f² bar = 1 so that the volume is the sheet's.
        let bar = root_length * wing_thickness * keel_thickness / (side * side * thickness);
        let f = 2.0 / (1.0 + (1.0 + 4.0 * bar).sqrt());
        Dart {
            root_length,
            tip,
            bottom,
            wing_thickness: f * wing_thickness,
            keel_thickness: f * keel_thickness,
        }
    }

    /// Coordinates of a place: the kind of vertex ([`vertex`]), its station, its number across.
    fn position(&self, rows: &Rows, [kind, station, across]: [usize; 3]) -> [f64; 3] {
        let s = station as f64 / (rows.across.len() - 1) as f64;
        let t = across as f64 / rows.across[station].max(1) as f64;
        let along = |end: f64| s * ((1.0 - t) * -self.root_length + t * end);
        let (half_wing, half_keel) = (0.5 * self.wing_thickness, 0.5 * self.keel_thickness);
        let side = if kind % 2 == 1 { -1.0 } else { 1.0 };
        match kind / 2 {
            KEEL => [
                along(self.bottom[0]),
                s * t * self.bottom[1] - half_wing,
                side * half_keel,
            ],
            surface => {
                let y = if surface == TOP {
                    half_wing
                } else {
                    -half_wing
                };
                [
                    along(self.tip[0]),
                    y,
                    side * (half_keel + s * t * self.tip[1]),
                ]
            }
        }
    }
}

/// Area of a half sheet of unit side between angles at the nose of `from` and `to` times
/// [`DELTA`].
fn sector(from: f64, to: f64) -> f64 {
    let corner = libm::atan(0.5);
    let up_to = |phi: f64| {
        let rear = 0.5 * libm::tan(phi.min(corner));
        let side = if phi > corner {
            2.0 - 1.0 / libm::tan(phi)
        } else {
            0.0
        };
        rear + side / 8.0
    };
    up_to(to * DELTA) - up_to(from * DELTA)
}

/// Numbers of cells across the wings and the keel at each station from the nose to the rear.
struct Rows {
    across: Vec<usize>,
}

impl Rows {
    fn with(stations: usize, slope: f64) -> Rows {
        let cells = |i: usize| ((slope * i as f64).round() as usize).max(usize::from(i > 0));
        Rows {
            across: (0..=stations).map(cells).collect(),
        }
    }

    /// Six triangular faces, eight strips along the edges, four cells at the ends.
    fn triangles(&self) -> usize {
        12 * self.across.iter().sum::<usize>() + 8 * (self.across.len() - 1) + 4
    }

    fn nearest(wish: usize) -> Rows {
        let ideal = |n: f64| Rows::with(n as usize, CELLS_ACROSS).triangles();
        let most = 3.0 + (wish as f64).sqrt();
        let stations = nearest(ideal, 1.0, most, wish) as usize;
        let at = |slope: f64| Rows::with(stations, slope);
        at(nearest(|slope| at(slope).triangles(), 0.0, 1.0, wish))
    }
}

const TOP: usize = 0;
const UNDER: usize = 1;
const KEEL: usize = 2;

/// The place of a vertex on the top or underside of a wing or on a side of the keel; the keel's
/// root and nose are those of the wing's underside.
fn vertex(surface: usize, left: bool, station: usize, across: usize) -> [usize; 3] {
    let surface = if across == 0 && surface == KEEL {
        UNDER
    } else {
        surface
    };
    [2 * surface + usize::from(left), station, across]
}

/// A wing and a side of the keel with the wing's rims; the left half mirrors the right.
fn add_half<P: Fn([usize; 3]) -> [f64; 3]>(surface: &mut Builder<P>, rows: &Rows, left: bool) {
    let n = rows.across.len() - 1;
    let row = |kind: usize, i: usize| -> Vec<[usize; 3]> {
        (0..=rows.across[i])
            .map(|j| vertex(kind, left, i, j))
            .collect()
    };
    for i in 0..n {
        surface.strip(&row(TOP, i), &row(TOP, i + 1), left);
        surface.strip(&row(UNDER, i), &row(UNDER, i + 1), !left);
        surface.strip(&row(KEEL, i), &row(KEEL, i + 1), left);
        let edge = |kind: usize, i: usize| vertex(kind, left, i, rows.across[i]);
        let rim = [
            edge(UNDER, i),
            edge(TOP, i),
            edge(TOP, i + 1),
            edge(UNDER, i + 1),
        ];
        surface.quad(rim, false, left);
    }
    for j in 0..rows.across[n] {
        let at = |kind: usize, j: usize| vertex(kind, left, n, j);
        let rim = [at(UNDER, j), at(UNDER, j + 1), at(TOP, j + 1), at(TOP, j)];
        surface.quad(rim, false, left);
    }
}

/// What joins the halves: the strips along the top and the bottom fold, the nose, the rear.
fn add_middle<P: Fn([usize; 3]) -> [f64; 3]>(surface: &mut Builder<P>, rows: &Rows) {
    let n = rows.across.len() - 1;
    let mut across = |surface_a, a: [usize; 2], surface_b, b: [usize; 2]| {
        let right = |kind, [i, j]: [usize; 2]| vertex(kind, false, i, j);
        let left = |kind, [i, j]: [usize; 2]| vertex(kind, true, i, j);
        let quad = [
            right(surface_a, a),
            left(surface_a, a),
            left(surface_b, b),
            right(surface_b, b),
        ];
        surface.quad(quad, false, false);
    };
    for i in 0..n {
        across(TOP, [i, 0], TOP, [i + 1, 0]);
        across(KEEL, [i + 1, rows.across[i + 1]], KEEL, [i, rows.across[i]]);
    }
    across(UNDER, [0, 0], TOP, [0, 0]);
    across(TOP, [n, 0], UNDER, [n, 0]);
    for j in 0..rows.across[n] {
        across(KEEL, [n, j], KEEL, [n, j + 1]);
    }
}
