//! Circular cylinders, from thin discs to long rods.

use std::f64::consts::PI;

use super::slices::{Slices, Straight};
use super::{Form, mean_where_degenerate, surface};
use crate::wake::base_suction;

/// The cylinder of this radius and length (m) along `axis`.
pub(super) fn form(radius: f64, length: f64, axis: usize) -> Form {
    let r = radius;
    let ratio = length / r;
    let along_axis = |along: f64, across: f64| {
        let mut values = [across; 3];
        values[axis] = along;
        values
    };
    let half = along_axis(0.5 * length, r);
    let mean_squares = along_axis(length * length / 12.0, 0.25 * r * r);
    let half_extents =
        mean_where_degenerate(mean_squares, half, |_, _| r, 0.25 * (PI * r + length));
    let [end_on, across, turning] = added_mass(ratio);
    let cube = r * r * r;
    let [end_on, across, turning] = [end_on * cube, across * cube, turning * cube * r * r];
    let translations = along_axis(end_on, across);
    let rotations = along_axis(0.0, turning);
    let added_mass = std::array::from_fn(|i| {
        if i < 3 {
            translations[i]
        } else {
            rotations[i - 3]
        }
    });
    let [end, side] = drag_coefficients(ratio);
    let drag_areas = along_axis(end * PI * r * r, side * 2.0 * r * length);
    let slices = Slices::of(half_extents, half).map_or(vec![], |slices| {
        let wall = 2.0 * r * slices.pitch();
        let straight = Straight {
            added_mass,
            drag_areas,
            half,
            end_loss: 0.43,
        };
        straight.slices(&slices, |_, with_end| {
            let cap = if with_end { r * r } else { 0.0 };
            r * r * (0.5 * wall + 0.25 * cap) / (wall + cap)
        })
    });
    Form {
        volume: PI * r * r * length,
        mean_squares,
        added_mass,
        half_extents,
        thickness: 3.0 * r * length / (r + length),
        drag_areas,
        slices,
        surface: surface::cylinder(r, 0.5 * length, axis),
    }
}

/// Added mass of the cylinder of radius 1 and length `l`: along the axis, across it, turning about an
/// axis across it. The thin disc has 8/3 and 16/45, the long cylinder the displaced fluid.
fn added_mass(l: f64) -> [f64; 3] {
    let volume = PI * l;
    [
        8.0 / 3.0
            * (1.0 + 0.2948 * libm::pow(libm::log(1.0 + 2.3253 / (1.0 / l + 0.2337)), 0.7114)),
        volume / (1.0 + 1.4978 / (l * (1.0 + 0.2468 * libm::log(1.0 + 0.3343 / l)))),
        16.0 / 45.0 * (1.0 + 0.4069 * libm::pow(l, 0.5674)) / (1.0 + 0.3239 * libm::pow(l, 1.9063))
            + volume * l * l / 12.0 / (1.0 + 6.0613 * libm::pow(l, -1.1254)),
    ]
}

/// Drag coefficients of radius 1 and length `l`: end on, on the end, and broadside, on the length
/// times the diameter. The base suction is the bake's, the windward pressure a fit.
fn drag_coefficients(l: f64) -> [f64; 2] {
    let aspect = (0.5 * l).max(2.0 / l);
    let side = 0.1419 + 0.322 / (1.0 + (l / 3.074).sqrt());
    // A long body has but a small share of its surface at its edges: the suction of one without.
    let end_on = base_suction(1.0) / (1.0 + l / 80.0);
    let across = base_suction(aspect) * (1.0 - 0.114 * l * l / (l * l + 50.0));
    [end_on + 0.6024 + 0.1212 * l / (l + 0.0969), across + side]
}
