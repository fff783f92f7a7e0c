//! Bodies of the built-in scenes beside what was measured of their kind.

use langevin_rigid::linalg::vector::norm;
use langevin_rigid::{Model, NoiseStream, State};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene;

use super::drop::{between, fall, mean, median};
use crate::error::ReportError;
use crate::options::Options;
use crate::section::Section;

/// Seeds of each scene.
const SEEDS: u64 = 10;

pub(super) fn seeds(
    section: &mut Section,
    options: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("Seeds");
    section.text(format!(
        "The scene <i>maple-seed</i>, over {SEEDS} seeds of the noise, spun and from rest: medians over the second half of 4 s of \
         fall, beside the range of measured maple seeds."
    ));
    let prepared = Prepared::new(
        scene::find("maple-seed")?,
        options.cache.as_deref(),
        progress,
    )?;
    let mut rows = Vec::new();
    for (name, spun) in [("shed on a spin", true), ("from rest", false)] {
        let falls: Vec<[f64; 4]> = (0..SEEDS)
            .map(|seed| seed_fall(&prepared, spun, seed))
            .collect();
        let of = |k: usize| median(falls.iter().map(|f| f[k]).collect());
        let spinning = falls.iter().filter(|f| f[0] > 5.0).count();
        let mut row = vec![name.to_owned()];
        for (k, what) in ["turns", "sink", "cone", "roll"].into_iter().enumerate() {
            let key = format!("seed.{name}.{what}");
            row.push(section.quote(key, of(k), 3).to_string());
        }
        let key = format!("seed.{name}.spinning");
        row.push(section.quote(key, spinning as f64, 0).to_string());
        rows.push(row);
    }
    let measured = ["measured", "15 to 22", "1.0 to 1.3", "15 to 25", "0", "all"];
    rows.push(measured.map(str::to_owned).to_vec());
    let head = [
        "release",
        "turns/s",
        "sinks, m/s",
        "cone, degrees",
        "turns/s about the span beside the cone's",
        "spin, of ten",
    ];
    section.table("seeds", &head, &rows);
    Ok(())
}

/// Speed and height at which the airplane is thrown (m/s, m).
const THROW: f64 = 2.0;
const HEIGHT: f64 = 8.0;

pub(super) fn airplane(
    section: &mut Section,
    options: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("A folded airplane");
    section.text(format!(
        "The scene <i>airplane</i> thrown level at {THROW} m/s from {HEIGHT} m, over {SEEDS} seeds of the noise: medians over the \
         second half of the fall."
    ));
    let mut scene = scene::find("airplane")?;
    scene.settings.model = Model::Separated;
    scene.release.velocity = [THROW, 0.0, 0.0];
    scene.release.position[1] = HEIGHT;
    let prepared = Prepared::new(scene, options.cache.as_deref(), progress)?;
    let flights: Vec<[f64; 3]> = (0..SEEDS).map(|seed| flight(&prepared, seed)).collect();
    let row = ["speed", "ratio", "incidence"].into_iter().enumerate();
    let row = row.map(|(k, what)| {
        let middle = median(flights.iter().map(|f| f[k]).collect());
        let key = format!("airplane.{what}");
        section.quote(key, middle, 3).to_string()
    });
    let row: Vec<String> = row.collect();
    let head = ["speed, m/s", "glide ratio", "incidence, degrees"];
    section.table("airplane", &head, &[row]);
    Ok(())
}

/// Mean speed (m/s), way along over way down, and mean angle between the wings and the flight (degrees).
fn flight(prepared: &Prepared, seed: u64) -> [f64; 3] {
    let scene = prepared.scene();
    let noise = NoiseStream { seed, body: 0 };
    let steps = (10.0 / scene.time_step) as u32;
    let landed = |state: &State| state.position[1] < 0.0;
    let (stepper, release) = (prepared.stepper(), scene.release);
    let states = fall(stepper, release, scene.time_step, steps, noise, landed);
    let late = &states[states.len() / 2..];
    let [x, y, z] = between(&late[0], &late[late.len() - 1]);
    let along = libm::hypot(x, z);
    let incidence = mean(late.iter().map(|s| {
        let [_, up, _] = s.velocity;
        libm::asin((-up / norm(s.velocity)).clamp(-1.0, 1.0))
    }));
    [libm::hypot(along, y), along / -y, incidence.to_degrees()]
}

/// Turns a second about the vertical, speed of sinking (m/s), angle of the span above level (degrees), and turns a second
/// about the span beyond those that the cone brings.
fn seed_fall(prepared: &Prepared, spun: bool, seed: u64) -> [f64; 4] {
    let scene = prepared.scene();
    let mut release = scene.release;
    if !spun {
        release = State {
            angular_velocity: [0.0; 3],
            ..release
        };
    }
    let noise = NoiseStream { seed, body: 0 };
    let steps = (4.0 / scene.time_step) as u32;
    let states = fall(
        prepared.stepper(),
        release,
        scene.time_step,
        steps,
        noise,
        |_| false,
    );
    let late = &states[states.len() / 2..];
    let turn = std::f64::consts::TAU;
    let about = mean(late.iter().map(|s| s.world_angular_velocity()[1])) / turn;
    let sink = -mean(late.iter().map(|s| s.world_velocity()[1]));
    let rise = mean(late.iter().map(|s| {
        let span = langevin_rigid::linalg::rotation_matrix(s.orientation)[1][0];
        libm::asin(span.clamp(-1.0, 1.0))
    }));
    let roll = mean(late.iter().map(|s| s.angular_velocity[0])) / turn;
    [
        about.abs(),
        sink,
        rise.to_degrees(),
        roll - about * libm::sin(rise),
    ]
}
