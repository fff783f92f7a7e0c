//! Bodies lofted through sections along X: leaves, feathers, winged seeds.

use std::f64::consts::PI;

use super::builder::Builder;
use super::{ShapeError, enough, positive};
use crate::mass_properties::centroid;
use crate::mesh::TriMesh;
use crate::mesh::vector::{IDENTITY, scale};

/// Fewest triangles that show a section's two faces and a few stations.
const FEWEST: usize = 64;

/// The flattened cross-section at one station.
struct Section {
    /// Height y and place z of its middle (m).
    middle: [f64; 2],
    /// Half the chord along Z (m).
    half_chord: f64,
    /// Half the thickness in the middle (m).
    half_thickness: f64,
    /// How far its edges bend up (m).
    cup: f64,
    /// Turn of the chord about X, the edge at +Z up (radians).
    pitch: f64,
    /// Share by which the edge at +Z is thicker than the middle, and the other thinner.
    taper: f64,
}

impl Section {
    /// The point at angle `t` around the section, y and z (m).
    fn point(&self, t: f64) -> [f64; 2] {
        let (s, c) = libm::sincos(t);
        let across = self.half_chord * c;
        let up = self.half_thickness * s * (1.0 + self.taper * c) + self.cup * c * c;
        let (sin, cos) = libm::sincos(self.pitch);
        [
            self.middle[0] + cos * up + sin * across,
            self.middle[1] + cos * across - sin * up,
        ]
    }
}

/// A broad leaf, pointed at both ends, its edges and ends bent up, a little twisted.
pub(super) fn leaf(sizes: [f64; 3], triangles: usize) -> Result<TriMesh, ShapeError> {
    let [length, width, thickness] = sizes;
    loft("leaf", sizes, triangles, |s| {
        let half_chord = 0.5 * width * libm::sin(PI * libm::pow(s, 0.85));
        let from_middle = 2.0 * s - 1.0;
        Section {
            middle: [0.07 * length * from_middle * from_middle, 0.0],
            half_chord,
            half_thickness: 0.5 * thickness,
            cup: 0.2 * half_chord,
            pitch: 0.12 * from_middle,
            taper: 0.0,
        }
    })
}

/// A feather: a bare quill, then a vane wider behind the shaft than before it, bent up at the tip.
pub(super) fn feather(sizes: [f64; 3], triangles: usize) -> Result<TriMesh, ShapeError> {
    let [length, width, thickness] = sizes;
    loft("feather", sizes, triangles, |s| {
        let vane = smoothstep((s - 0.12) / 0.2);
        let half_chord = 0.5 * width * (0.08 + 0.92 * vane);
        Section {
            middle: [0.08 * length * s * s, -0.3 * half_chord * vane],
            half_chord,
            half_thickness: 0.5 * thickness * (1.4 - 0.8 * s),
            cup: 0.05 * half_chord * vane,
            pitch: 0.0,
            taper: 0.4 * vane,
        }
    })
}

/// A maple seed: a round nut at one end and a wing with a straight, thick leading edge at +Z.
pub(super) fn samara(sizes: [f64; 3], triangles: usize) -> Result<TriMesh, ShapeError> {
    let [_, width, thickness] = sizes;
    loft("samara", sizes, triangles, |s| {
        let wing = smoothstep((s - 0.12) / 0.22);
        let half_chord = 0.5 * width * (0.6 + 0.4 * smoothstep((s - 0.15) / 0.4));
        Section {
            middle: [0.0, 0.3 * width - half_chord + 0.15 * width * (1.0 - wing)],
            half_chord,
            half_thickness: 0.5 * thickness + (0.16 * width - 0.5 * thickness) * (1.0 - wing),
            cup: 0.0,
            pitch: 0.0,
            taper: 0.7 * wing,
        }
    })
}

/// Closes the sections at stations 0 < s < 1 of a body of the given length, width and thickness; its
/// ends are rounded off over a tenth of the length. Centred at the centroid.
fn loft(
    shape: &'static str,
    [length, width, thickness]: [f64; 3],
    triangles: usize,
    section: impl Fn(f64) -> Section,
) -> Result<TriMesh, ShapeError> {
    for (dimension, value) in [
        ("length", length),
        ("width", width),
        ("thickness", thickness),
    ] {
        positive(shape, dimension, value)?;
    }
    enough(shape, triangles, FEWEST)?;
    let (stations, around) = counts(length, width, triangles);
    // Stations crowd towards the ends, points towards the edges: the loads are there.
    let place = |i: usize| 0.5 * (1.0 - libm::cos(PI * i as f64 / (stations + 1) as f64));
    let position = |[i, j, _]: [usize; 3]| {
        let s = place(i);
        let mut section = section(s);
        let end = round_end(s);
        section.half_chord *= end;
        section.half_thickness *= end;
        section.cup *= end;
        let [y, z] = section.point(2.0 * PI * j as f64 / around as f64);
        [length * (s - 0.5), y, z]
    };
    let mut surface = Builder::new(position);
    for j in 0..around {
        let next = (j + 1) % around;
        surface.triangle([[0, 0, 0], [1, j, 0], [1, next, 0]], false);
        for i in 1..stations {
            let quad = [[i, j, 0], [i + 1, j, 0], [i + 1, next, 0], [i, next, 0]];
            surface.quad(quad, (i + j) % 2 == 0, false);
        }
        let tip = [stations + 1, 0, 0];
        surface.triangle([[stations, j, 0], tip, [stations, next, 0]], false);
    }
    let mesh = surface.finish()?;
    Ok(mesh.transformed(IDENTITY, scale(-1.0, centroid(&mesh)), 1.0)?)
}

/// Stations and points around each that make triangles as equilateral as their number allows.
fn counts(length: f64, width: f64, triangles: usize) -> (usize, usize) {
    let cells = 0.5 * triangles as f64;
    let pairs = (0.5 * (cells * 2.0 * width / length).sqrt()).round() as usize;
    let around = 2 * pairs.max(4);
    let stations = (cells / around as f64).round() as usize;
    (stations.max(4), around)
}

/// 0 at the ends, 1 between: a quarter ellipse over a tenth of the length.
fn round_end(s: f64) -> f64 {
    let from_end = (s.min(1.0 - s) / 0.1).min(1.0);
    (from_end * (2.0 - from_end)).max(0.0).sqrt()
}

fn smoothstep(x: f64) -> f64 {
    let t = x.clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}
