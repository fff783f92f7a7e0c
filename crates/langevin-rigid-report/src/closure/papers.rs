//! Discs of paper in air.

use langevin_rigid::{Fluid, NoiseStream, State, Stepper};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::shapes::Shape;
use rayon::prelude::*;

use super::drop::{baked, between, facing, fall, mean, median, stepper};
use crate::error::ReportError;
use crate::options::Options;
use crate::references::papers::{DROPS, HEIGHT, LANDED, LAST, SOURCE, THICKNESS, WEIGHT};
use crate::section::Section;

/// Falls of each kind.
const FALLS: u64 = 24;
/// Scatter of the tilt about each horizontal axis (degrees), and the speed that the tracks begin with (m/s), flat and on edge.
const TILT: f64 = 5.0;
const SPEED: [f64; 2] = [0.15, 1.0];

/// Time (s), speed over the last part of the way (m/s), distance (m).
fn drop(stepper: &Stepper, on_edge: bool, number: u64) -> [f64; 3] {
    let noise = NoiseStream {
        seed: number,
        body: 0,
    };
    let [a, b, ..] = noise.normals(u64::MAX);
    let [a, b] = [a, b].map(|x| (TILT * x).to_radians());
    let axis = if on_edge { [1.0, a, b] } else { [a, 1.0, b] };
    let mut release = State {
        position: [0.0, HEIGHT, 0.0],
        orientation: facing(axis),
        ..State::default()
    };
    let speed = SPEED[usize::from(on_edge)];
    release.set_world_velocities([0.0, -speed, 0.0], [0.0; 3]);
    let states = fall(stepper, release, 1e-3, 6000, noise, |s| {
        s.position[1] < LANDED
    });
    let end = states[states.len() - 1];
    let begin = states
        .iter()
        .find(|s| s.position[1] < LANDED + LAST)
        .unwrap_or(&states[0]);
    let [x, _, z] = end.position;
    [end.time, -between(begin, &end)[1], libm::hypot(x, z)]
}

pub(super) fn papers(
    section: &mut Section,
    _: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("Discs of paper");
    section.text(format!(
        "{SOURCE}; {FALLS} falls of each here, released {TILT} degrees off (standard deviation) at the speeds that the \
         tracks begin with, {} and {} m/s. Times and speeds are means, distances medians.",
        SPEED[0], SPEED[1]
    ));
    let mut rows = Vec::new();
    for (radius, on_edge, measured) in DROPS {
        let shape = Shape::Disc {
            radius,
            thickness: THICKNESS,
        };
        let body = baked(&shape, WEIGHT / THICKNESS, progress)?;
        let stepper = stepper(&body, &Fluid::AIR, true)?;
        let falls: Vec<[f64; 3]> = (0..FALLS)
            .into_par_iter()
            .map(|number| drop(&stepper, on_edge, number))
            .collect();
        let of = |k: usize| falls.iter().map(move |f| f[k]);
        let here = [mean(of(0)), mean(of(1)), median(of(2).collect())];
        let name = if on_edge { "on edge" } else { "flat" };
        let mut row = vec![format!("{:.0} mm, {name}", 1e3 * radius)];
        for ((what, here), measured) in ["time", "speed", "distance"]
            .into_iter()
            .zip(here)
            .zip(measured)
        {
            let key = |of: &str| format!("papers.{:.0}.{name}.{what}.{of}", 1e3 * radius);
            row.push(format!(
                "{}, {}",
                section.quote(key("measured"), measured, 3),
                section.quote(key("here"), here, 3)
            ));
        }
        rows.push(row);
    }
    let head = [
        "radius, release",
        "time (s): measured, here",
        "speed over the last 0.55 m (m/s)",
        "landing distance (m)",
    ];
    section.table("papers", &head, &rows);
    Ok(())
}
