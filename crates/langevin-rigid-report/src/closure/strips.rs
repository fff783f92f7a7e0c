//! Strips in the plane: heavy ones that tumble, the onset of tumbling, autorotation on an axis, and gliders.

use langevin_rigid::linalg::Mat3;
use langevin_rigid::{Fluid, Input, NoiseStream, SetupError, State};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_scenes::ensemble::MotionClass;
use langevin_rigid_scenes::regimes::{self, Case, Plate, TILTS, broadside_speed};

use super::drop::{between, fall, mean, stepper, turned};
use crate::error::ReportError;
use crate::options::Options;
use crate::references::strips::{GLIDE, ONSET, SHIFTED, TIP_SPEED, autorotation};
use crate::section::Section;

/// Thickness over chord of the strips that fall.
const THICKNESS: f64 = 0.07;

pub(super) fn strips(
    section: &mut Section,
    _: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("Strips");
    section
        .text("Without turbulence, tensors in closed form. Tip speed is over the speed of flight.");
    let mut rows = Vec::new();
    for ratio in [5.0, 20.0] {
        let [tip, glide] = tumbling(ratio)?;
        let key = |what: &str| format!("strips.{ratio}.{what}");
        rows.push(vec![
            format!("tumbling at I* {ratio}: tip speed (Smith 1971)"),
            section.quote(key("tip.measured"), TIP_SPEED, 2).to_string(),
            section.quote(key("tip"), tip, 3).to_string(),
        ]);
        rows.push(vec![
            format!("tumbling at I* {ratio}: angle of the glide, degrees (Smith 1971)"),
            section.quote(key("glide.measured"), GLIDE, 2).to_string(),
            section.quote(key("glide"), glide, 2).to_string(),
        ]);
    }
    let onset = onset(progress)?;
    rows.push(vec![
        "I* from which most releases no longer flutter (Belmonte et al. 1998)".to_owned(),
        section.quote("strips.onset.measured", ONSET, 2).to_string(),
        section.quote("strips.onset", onset, 2).to_string(),
    ]);
    for thickness in [0.02, 0.05, 0.1, 0.2, 0.33, 0.5] {
        let key = |what: &str| format!("strips.axis.{thickness}.{what}");
        let measured = section.quote(key("measured"), autorotation(thickness), 2);
        let speed = on_an_axis(thickness)?;
        let here = match speed {
            Some(speed) => section.quote(key("here"), speed, 2).to_string(),
            None => "none".to_owned(),
        };
        rows.push(vec![
            format!("autorotation on an axis, thickness {thickness}: tip speed (Iversen 1979)"),
            measured.to_string(),
            here,
        ]);
    }
    for (shift, speeds, motion) in SHIFTED {
        let [along, down, swing] = glider(shift)?;
        let key = |what: &str| format!("strips.glider.{shift}.{what}");
        let measured = speeds.map_or(motion.to_owned(), |[u, w]| {
            let u = section.quote(key("along.measured"), u, 3);
            let w = section.quote(key("down.measured"), w, 3);
            format!("{motion}, {u}, {w}")
        });
        let along = section.quote(key("along"), along, 3);
        let down = section.quote(key("down"), down, 3);
        let swing = section.quote(key("swing"), swing, 2);
        rows.push(vec![
            format!(
                "plate in water, mass {shift} chords forward: along, down, cm/s (Li et al. 2022); range of pitch, rad"
            ),
            measured,
            format!("{along}, {down}; {swing}"),
        ]);
    }
    section.table("strips", &["what", "measured", "here"], &rows);
    Ok(())
}

/// Tip speed over flight speed, and angle of the glide (degrees), of a strip released at 40 degrees.
fn tumbling(ratio: f64) -> Result<[f64; 2], ReportError> {
    let body = Plate::Strip.body(ratio, THICKNESS);
    let speed = broadside_speed(&body, 2e4);
    let fluid = unit_fluid(speed / 2e4);
    let stepper = stepper(&body, &fluid, false)?;
    let release = State {
        orientation: turned([0.0, 0.0, 1.0], 40.0),
        ..State::default()
    };
    let quiet = NoiseStream::default();
    let states = fall(
        &stepper,
        release,
        1.0 / (24.0 * speed),
        24_000,
        quiet,
        |_| false,
    );
    let late = &states[states.len() / 2..];
    let flight = mean(late.iter().map(|s| {
        let [x, y, _] = s.world_velocity();
        libm::hypot(x, y)
    }));
    let spin = mean(late.iter().map(|s| s.angular_velocity[2].abs()));
    let [x, y, _] = between(&late[0], &late[late.len() - 1]);
    Ok([0.5 * spin / flight, libm::atan2(-y, x.abs()).to_degrees()])
}

/// The least I* of a row of them from which no more than one of three releases flutters, at Re 2e4.
fn onset(progress: &dyn Progress) -> Result<f64, ReportError> {
    let ratios = (0..30).map(|k| 0.08 * libm::pow(1.1, f64::from(k)));
    let cases: Vec<Case> = ratios
        .flat_map(|inertia_ratio| {
            TILTS.map(|tilt| Case {
                plate: Plate::Strip,
                reynolds: 2e4,
                inertia_ratio,
                tilt,
            })
        })
        .collect();
    let runs = regimes::run(&cases, progress)?;
    let points = regimes::points(&runs);
    let last = points
        .iter()
        .rev()
        .find(|point| point.regime == MotionClass::Flutter);
    Ok(last.map_or(f64::NAN, |point| 1.1 * point.inertia_ratio))
}

/// Tip speed over the wind's at which the mean couple over a turn about a fixed axis vanishes and more spin is braked.
fn on_an_axis(thickness: f64) -> Result<Option<f64>, ReportError> {
    const ANGLES: u32 = 360;
    let body = Plate::Strip.body(100.0 * thickness, thickness);
    let stepper = stepper(&body, &unit_fluid(1e-9), false)?;
    let couple = |tip: f64| {
        mean((0..ANGLES).map(|k| {
            let angle = std::f64::consts::PI * (f64::from(k) + 0.5) / f64::from(ANGLES);
            let state = State {
                velocity: [libm::cos(angle), -libm::sin(angle), 0.0],
                angular_velocity: [0.0, 0.0, 2.0 * tip],
                ..State::default()
            };
            let loads = stepper.loads(&state, &Input::default());
            let causes = [
                loads.added_mass,
                loads.drag,
                loads.normal_force,
                loads.rotational_lift,
                loads.damping,
                loads.lost_couple,
            ];
            causes.iter().map(|wrench| wrench.torque[2]).sum::<f64>()
        }))
    };
    let tips: Vec<f64> = (1..=100).map(|k| 0.02 * f64::from(k)).collect();
    let couples: Vec<f64> = tips.iter().map(|&tip| couple(tip)).collect();
    let last = (1..tips.len())
        .rev()
        .find(|&k| couples[k - 1] > 0.0 && couples[k] <= 0.0);
    Ok(last.map(|k| {
        let part = couples[k - 1] / (couples[k - 1] - couples[k]);
        tips[k - 1] + part * (tips[k] - tips[k - 1])
    }))
}

/// Mean velocity along and down (cm/s) and range of pitch (rad) of a plate of 2.54 cm chord, 2 % thick, with a mass of 1 g
/// and an inertia of 0.5 g cm^2 for each cm of its span, its mass moved forward by so many chords.
fn glider(shift: f64) -> Result<[f64; 3], ReportError> {
    // Lengths in chords, density 1: a mass of 1 / 2.54^2 and an inertia of 0.5 / 2.54^4 for each chord of span.
    const CHORD: f64 = 0.0254;
    let plate = Plate::Strip.body(1.0, 0.02);
    let span = 2.0 * plate.half_extents[0];
    let mass = span / (2.54 * 2.54);
    let about_span = 0.5 * span / (2.54f64 * 2.54 * 2.54 * 2.54);
    let long = plate.inertia[0][0] * mass / plate.mass;
    let inertia: Mat3 = [[long, 0.0, 0.0], [0.0, long, 0.0], [0.0, 0.0, about_span]];
    let body = plate
        .with_mass_properties(mass, [shift, 0.0, 0.0], inertia)
        .map_err(SetupError::from)?;
    // Gravity is 9.81 m/s^2: on the plate's scale times are in units that make it so.
    let unit = CHORD.sqrt();
    let viscosity = 1e-6 / (CHORD * unit);
    let stepper = stepper(&body, &unit_fluid(viscosity), false)?;
    let mut release = State {
        orientation: turned([0.0, 0.0, 1.0], -30.0),
        ..State::default()
    };
    let speed = 0.05 / unit;
    release.set_world_velocities([0.87 * speed, -0.5 * speed, 0.0], [0.0; 3]);
    let steps = (10.0 / unit / (1e-3 / unit)) as u32;
    let quiet = NoiseStream::default();
    let states = fall(&stepper, release, 1e-3 / unit, steps, quiet, |_| false);
    let late = &states[states.len() / 2..];
    let [x, y, _] = between(&late[0], &late[late.len() - 1]);
    let mut pitch = 0.0;
    let (mut low, mut high) = (0.0f64, 0.0f64);
    for pair in late.windows(2) {
        pitch += pair[1].angular_velocity[2] * (pair[1].time - pair[0].time);
        (low, high) = (low.min(pitch), high.max(pitch));
    }
    Ok([100.0 * unit * x, -100.0 * unit * y, high - low])
}

fn unit_fluid(viscosity: f64) -> Fluid {
    Fluid {
        density: 1.0,
        viscosity,
        velocity: [0.0; 3],
    }
}
