//! Turbulence that decays or is sheared against the closed forms of the k-epsilon model, and vortices that a numerical
//! viscosity consumes.

use std::f64::consts::TAU;

use langevin_rigid::turbulence::{C_MU, Turbulence};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::turbulence::{
    Boundary::{self, Periodic, Through, Walls},
    C_1, C_2, MacGrid, TurbulentFlow, decayed,
};

use crate::error::ReportError;
use crate::section::Section;

/// What a stream carries in, and how fast (m/s).
const START: Turbulence = Turbulence {
    k: 1.0,
    epsilon: 7.5,
};
const SPEED: f64 = 10.0;
/// Cells that the stream crosses in a step.
const COURANT_NUMBERS: [f64; 3] = [0.37, 1.0, 2.6];
/// The same shear everywhere (1/s).
const SHEAR: f64 = 5.0;
/// Cells along the sides of the box of vortices.
const CELLS: [usize; 3] = [16, 32, 64];

/// A number and what it is to be.
struct Comparison {
    words: &'static str,
    key: &'static str,
    here: f64,
    closed_form: f64,
    /// Relative difference: the worst, where several are compared.
    difference: f64,
}

/// Decay in a stream, and the fixed point of a homogeneous shear.
pub(super) fn closed_forms(
    section: &mut Section,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("Turbulence against closed forms");
    let [short, middle, long] = COURANT_NUMBERS;
    section.text(format!(
        "k and epsilon carried at {SPEED} m/s; the difference is the worst over the way, in steps that cross {short}, \
         {middle} and {long} cells. In a shear that is the same everywhere production and dissipation come to a fixed \
         ratio.",
    ));
    let mut rows = Vec::new();
    for found in decay(progress)?.into_iter().chain(shear(progress)?) {
        let Comparison { words, key, .. } = found;
        let here = section.quote(format!("{key}.here"), found.here, 7);
        let closed_form = section.quote(format!("{key}.closed_form"), found.closed_form, 7);
        let difference = section.quote(format!("{key}.difference"), found.difference, 1);
        rows.push(vec![
            words.to_owned(),
            here.to_string(),
            closed_form.to_string(),
            difference.to_string(),
        ]);
    }
    let head = ["turbulence", "here", "closed form", "relative difference"];
    section.table("turbulence", &head, &rows);
    Ok(())
}

fn decay(progress: &dyn Progress) -> Result<[Comparison; 2], ReportError> {
    let cell = 0.05;
    let stream = |_| [0.0, SPEED, 0.0];
    let sides = [Walls, Through, Walls];
    let mut found = [
        ("k after 1 m, of k = 1, epsilon = 7.5", "decay.k"),
        ("epsilon after 1 m", "decay.epsilon"),
    ]
    .map(|(words, key)| Comparison {
        words,
        key,
        here: f64::NAN,
        closed_form: f64::NAN,
        difference: 0.0,
    });
    for courant in COURANT_NUMBERS {
        let mut flow = flow([3, 24, 2], cell, sides, stream, START)?;
        for _ in 0..(240.0 / courant) as usize {
            step(&mut flow, courant * cell / SPEED, progress)?;
        }
        // The last is the one that is shown.
        for distance in [0.0, 0.01, 0.025, 0.3, 0.77, 1.15, 1.0] {
            let here = flow.turbulence().at([0.07, distance, 0.05]);
            let closed = decayed(START, distance / SPEED);
            let pairs = [(here.k, closed.k), (here.epsilon, closed.epsilon)];
            for (found, (here, closed_form)) in found.iter_mut().zip(pairs) {
                found.here = here;
                found.closed_form = closed_form;
                found.difference = found.difference.max((here / closed_form - 1.0).abs());
            }
        }
    }
    Ok(found)
}

fn shear(progress: &dyn Progress) -> Result<[Comparison; 2], ReportError> {
    let stream = |[_, y, _]: [f64; 3]| [SHEAR * y, 0.0, 0.0];
    let start = Turbulence {
        k: 1.0,
        epsilon: 30.0,
    };
    let mut flow = flow([8, 10, 3], 0.1, [Periodic, Walls, Walls], stream, start)?;
    for _ in 0..400 {
        step(&mut flow, 0.03, progress)?;
    }
    let Turbulence { k, epsilon } = flow.turbulence().at([0.41, 0.5, 0.15]);
    let strain = SHEAR * k / epsilon;
    // Production C_mu (S k)^2 / epsilon grows with k and epsilon in their fixed ratio.
    let production = (C_2 - 1.0) / (C_1 - 1.0);
    let compared = |words, key, here: f64, closed_form: f64| Comparison {
        words,
        key,
        here,
        closed_form,
        difference: (here / closed_form - 1.0).abs(),
    };
    Ok([
        compared(
            "homogeneous shear, P/epsilon",
            "shear.production",
            C_MU * strain * strain,
            production,
        ),
        compared(
            "homogeneous shear, S k/epsilon",
            "shear.strain",
            strain,
            (production / C_MU).sqrt(),
        ),
    ])
}

/// What Taylor-Green vortices lose, which are steady without viscosity.
pub(super) fn vortices(section: &mut Section, progress: &dyn Progress) -> Result<(), ReportError> {
    section.heading("Taylor-Green vortices");
    section.text(
        "Steady in a fluid without viscosity. What they lose while the fastest fluid crosses a quarter of the box is the \
         numerical viscosity of semi-Lagrangian advection with linear interpolation; energy in other patterns is an \
         error of its own. The divergence is what the projection leaves, in speeds a cell.",
    );
    let mut rows = Vec::new();
    for cells in CELLS {
        let [amplitude, others, divergence] = losses(cells, progress)?;
        let mut quote = |name: &str, value: f64| {
            let key = format!("vortices.{cells}.{name}");
            section.quote(key, value, 2).to_string()
        };
        rows.push(vec![
            cells.to_string(),
            format!("{} %", quote("amplitude", 100.0 * amplitude)),
            format!("{} %", quote("others", 100.0 * others)),
            quote("divergence", divergence),
        ]);
    }
    let head = [
        "cells a side",
        "loss of amplitude",
        "energy in other patterns",
        "largest divergence",
    ];
    section.table("vortices", &head, &rows);
    Ok(())
}

/// Loss of amplitude and energy in other patterns, of one each, and the largest divergence times the cell.
fn losses(cells: usize, progress: &dyn Progress) -> Result<[f64; 3], ReportError> {
    let vortices = |[x, y, _]: [f64; 3]| {
        let (x, y) = (TAU * x, TAU * y);
        [
            libm::sin(x) * libm::cos(y),
            -libm::cos(x) * libm::sin(y),
            0.0,
        ]
    };
    let cell = 1.0 / cells as f64;
    let still = Turbulence {
        k: 1.0,
        epsilon: 1.0,
    };
    let mut flow = flow([cells, cells, 1], cell, [Periodic; 3], vortices, still)?;
    let [along, energy] = projected(&flow, vortices);
    let mut divergence = 0.0f64;
    for _ in 0..cells / 2 {
        step(&mut flow, 0.5 * cell, progress)?;
        divergence = divergence.max(flow.grid().max_divergence() * cell);
    }
    let [left, energy_left] = projected(&flow, vortices);
    let amplitude = left / along;
    Ok([
        1.0 - amplitude,
        energy_left / energy - amplitude * amplitude,
        divergence,
    ])
}

/// Component along `pattern` and kinetic energy: sums over the faces of the cells.
fn projected(flow: &TurbulentFlow, pattern: impl Fn([f64; 3]) -> [f64; 3]) -> [f64; 2] {
    let (h, [nx, ny, _]) = (flow.grid().cell_size(), flow.grid().cells());
    let mut sums = [0.0; 2];
    for (i, j) in (0..nx).flat_map(|i| (0..ny).map(move |j| (i as f64, j as f64))) {
        let faces = [
            [i * h, (j + 0.5) * h, 0.5 * h],
            [(i + 0.5) * h, j * h, 0.5 * h],
        ];
        for (axis, point) in faces.into_iter().enumerate() {
            let value = flow.grid().velocity_at(point)[axis];
            sums[0] += value * pattern(point)[axis];
            sums[1] += value * value;
        }
    }
    sums
}

fn flow(
    cells: [usize; 3],
    cell: f64,
    sides: [Boundary; 3],
    velocity: impl Fn([f64; 3]) -> [f64; 3],
    turbulence: Turbulence,
) -> Result<TurbulentFlow, ReportError> {
    let mut grid = MacGrid::new(cells, cell, sides)?;
    grid.set_velocity(velocity);
    Ok(TurbulentFlow::new(grid, turbulence)?)
}

fn step(flow: &mut TurbulentFlow, dt: f64, progress: &dyn Progress) -> Result<(), ReportError> {
    if progress.cancelled() {
        return Err(ReportError::Cancelled);
    }
    Ok(flow.step(dt)?)
}
