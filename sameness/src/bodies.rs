//! Bodies that take every path of the run time.

use std::f64::consts::PI;

use langevin_rigid::{Body, Slice};

use crate::common::{chiral, ellipsoid};

/// Their names and they, of a density (kg/m^3).
pub(crate) fn bodies(density: f64) -> Vec<(&'static str, Body)> {
    [
        ("ellipsoid", ellipsoid([0.05, 0.03, 0.02], density)),
        ("plate", ellipsoid([0.06, 0.001, 0.04], density)),
        ("chiral", lopsided()),
        ("slices", bent_rod()),
    ]
    .into_iter()
    // A rod lighter than that takes so many parts a step that an emulator needs minutes.
    .filter(|(name, _)| *name != "slices" || density > 100.0)
    .map(|(name, body)| (name, resisted(of_density(body, density))))
    .collect()
}

/// No symmetry in any tensor, and the weight off the buoyancy.
fn lopsided() -> Body {
    let mut body = chiral();
    body.centre_of_buoyancy = [0.001, -0.002, 0.0015];
    let smallest = |tensor: &[[f64; 3]; 3]| tensor[0][0].min(tensor[1][1]).min(tensor[2][2]);
    let separation = &mut body.separation;
    for tensor in [
        &mut body.inertia,
        &mut separation.drag_area,
        &mut separation.extents,
    ] {
        // Smaller than the diagonal, so that the tensor stays positive.
        let coupling = 0.2 * smallest(tensor);
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            tensor[i][j] += coupling;
            tensor[j][i] += coupling;
        }
    }
    body
}

/// A rod along y, bent towards x, in five slices.
fn bent_rod() -> Body {
    const SLICES: usize = 5;
    let (length, radius) = (0.1, 0.008);
    let mut body = ellipsoid([radius, length, radius], 1000.0);
    let share = 1.0 / SLICES as f64;
    body.slices = (0..SLICES)
        .map(|slice| {
            let place = 2.0 * (slice as f64 + 0.5) * share - 1.0;
            let mut part = Slice {
                centre: [0.5 * radius * (place * place - 0.32), length * place, 0.0],
                ..Slice::default()
            };
            let across = [radius, length * share, radius];
            for i in 0..3 {
                part.translation[i][i] = share * body.added_mass[i][i];
                part.rotation[i][i] =
                    share * body.added_mass[i][i] * across[(i + 1) % 3] * across[(i + 2) % 3] / 5.0;
                part.drag_area[i][i] = share * body.separation.drag_area[i][i];
                part.extents[i][i] = body.separation.extents[i][i];
            }
            part
        })
        .collect();
    body
}

fn of_density(mut body: Body, density: f64) -> Body {
    let factor = density * body.volume / body.mass;
    body.mass *= factor;
    for entry in body.inertia.as_flattened_mut() {
        *entry *= factor;
    }
    body
}

/// With the Stokes resistance of the sphere of its volume.
fn resisted(mut body: Body) -> Body {
    let radius = libm::cbrt(0.75 / PI * body.volume);
    for i in 0..3 {
        body.separation.stokes_translation[i][i] = 6.0 * PI * radius;
        body.separation.stokes_rotation[i][i] = 8.0 * PI * radius * radius * radius;
    }
    body
}
