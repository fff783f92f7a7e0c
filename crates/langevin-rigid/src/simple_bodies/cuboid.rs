//! Boxes, from thin plates to long bars.

use std::f64::consts::PI;

use super::slices::{Slices, Straight};
use super::{Form, mean_where_degenerate, surface};
use crate::linalg::Vec3;
use crate::wake::base_suction;

/// The box with these edges (m).
pub(super) fn form(size: Vec3) -> Form {
    let half = size.map(|s| 0.5 * s);
    let mean_squares = size.map(|s| s * s / 12.0);
    // The mean over a plane of |cos| is 2 / pi, over space 1 / 2.
    let half_extents = mean_where_degenerate(
        mean_squares,
        half,
        |i, j| 2.0 / PI * (half[i] + half[j]),
        0.5 * (half[0] + half[1] + half[2]),
    );
    let others = |i: usize| [size[(i + 1) % 3], size[(i + 2) % 3]];
    let translation = |i: usize| added_mass(others(i), size[i]);
    let rotation = |i: usize| {
        let [b, c] = others(i);
        turning(size[i], b, c) + turning(size[i], c, b)
    };
    let added_mass: [f64; 6] = std::array::from_fn(|i| {
        if i < 3 {
            translation(i)
        } else {
            rotation(i - 3)
        }
    });
    let drag_areas = drag_areas(size, [0, 1, 2].map(translation));
    let slices = Slices::of(half_extents, half).map_or(vec![], |slices| {
        let straight = Straight {
            added_mass,
            drag_areas,
            half,
            end_loss: 0.49,
        };
        straight.slices(&slices, |axis, with_end| {
            let (own, other) = (size[axis], size[3 - axis - slices.axis]);
            let [top, side] = [other, own].map(|s| 2.0 * s * slices.pitch());
            let cap = if with_end { own * other } else { 0.0 };
            own * own / 4.0 * (top + (side + cap) / 3.0) / (top + side + cap)
        })
    });
    let [x, y, z] = size;
    Form {
        volume: x * y * z,
        mean_squares,
        added_mass,
        half_extents,
        thickness: 3.0 / (1.0 / x + 1.0 / y + 1.0 / z),
        drag_areas,
        slices,
        surface: surface::cuboid(half),
    }
}

/// Added mass of the motion of a `face` with this `depth` behind it (m^3): that of the plate, pi/4 of the
/// short side squared for each length of a strip, with a factor for the depth.
fn added_mass(face: [f64; 2], depth: f64) -> f64 {
    let (a, b) = (face[0].min(face[1]), face[0].max(face[1]));
    let plate = PI / 4.0 * a * a * b / (1.0 + 0.6911 * libm::pow(a / b, 1.0263));
    let thick = libm::log(1.0 + 0.5775 / (a / depth + 0.9844 * a / b));
    plate * (1.0 + 0.8164 * libm::pow(thick, 0.5929))
}

/// What the two faces that lie `lever` long add to the added mass about the axis of length `span`
/// (m^5): the strip's pi/128 of the lever's fourth power, with factors for the span and the `depth`.
fn turning(span: f64, lever: f64, depth: f64) -> f64 {
    let square = lever * lever;
    let strip = PI / 128.0 * square * square * span;
    let finite = 1.0 + 0.338 * libm::pow(lever / span, 1.0431);
    let thick = libm::log(1.0 + 0.0294 * depth * (1.0 / span + 1.0 / lever));
    let blunt = 1.0 + 0.671 * libm::pow(depth / lever, 1.1481);
    strip / finite * (1.0 + 2.4927 * libm::pow(thick, 0.4014)) / blunt
}

/// Drag areas (m^2); where translations have the same added mass, the mean over directions.
fn drag_areas(size: Vec3, added_mass: Vec3) -> Vec3 {
    let areas: Vec3 = std::array::from_fn(|i| {
        let (p, q) = (size[(i + 1) % 3], size[(i + 2) % 3]);
        p * q * drag_coefficient([p.min(q), p.max(q)], size[i])
    });
    // Skew to its faces a bar or a plate is met by edges and has less or more drag: fits.
    let skew = |i: usize, j: usize| {
        let ratio = size[3 - i - j] / size[i];
        let factor = if ratio < 1.0 {
            (0.905 - 0.06 * libm::log(ratio)).min(1.05)
        } else {
            0.845 + 0.06 / ratio
        };
        factor * 0.5 * (areas[i] + areas[j])
    };
    mean_where_degenerate(added_mass, areas, skew, 0.839 * areas[0])
}

/// Drag coefficient of a face with sides a <= b: the bake's base suction and a fit of the windward
/// pressure.
fn drag_coefficient([a, b]: [f64; 2], depth: f64) -> f64 {
    let windward = 0.6175 + 0.1111 * depth / (depth + 0.054 * a) - 0.0165 * libm::log(b / a);
    // A long body has but a small share of its surface at its edges: the suction of one without.
    base_suction(b / a) / (1.0 + depth / (28.0 * (a * b).sqrt())) + windward
}
