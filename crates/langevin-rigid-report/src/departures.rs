//! Where the program departs from print: each run both ways, with its consequence.

use langevin_rigid::linalg::vector::norm;
use langevin_rigid::turbulence::TurbulenceHistory;
use langevin_rigid::{
    Bake, Body, Fluid, Integrator, Model, NoiseStream, SPEED_LIMIT, Settings, State, Stepper,
    TurbulenceSource, UnitSystem,
};
use langevin_rigid_bake::body::{BodySpec, bake_body};
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_bake::shapes::Shape;
use langevin_rigid_bake::turbulence::{FlowOptions, Sampling, turbulence_history};
use langevin_rigid_scenes::baking;
use rayon::prelude::*;

use crate::chart::{Chart, Curve};
use crate::error::ReportError;
use crate::measures::Axes;
use crate::numbers::significant;
use crate::options::Options;
use crate::paper;
use crate::runs::{CONSISTENT, CONSISTENT_HISTORY, Reading, Setting};
use crate::section::{Section, figure};

const PUBLISHED: Model = Model::Published(UnitSystem::Cgs);
const PUBLISHED_SI: Model = Model::Published(UnitSystem::Si);

pub(crate) fn section(options: &Options, progress: &dyn Progress) -> Result<Section, ReportError> {
    let mut section = Section::new("departures", "Where this departs from print");
    section.text(
        "Each departure of docs/departures.md, run as printed (the model <i>published</i>) and as here.",
    );
    cross_term(&mut section)?;
    units(&mut section, options, progress)?;
    decaying_turbulence(&mut section, options, progress)?;
    spin(&mut section, options, progress)?;
    buoyancy(&mut section)?;
    reynolds(&mut section, options, progress)?;
    Ok(section)
}

/// Step of the runs without ground (s): their bodies get fast.
const FINE_STEP: f64 = 1e-3;

/// Turbulence that never changes.
fn frozen(k: f64, epsilon: f64) -> TurbulenceHistory {
    TurbulenceHistory {
        interval: 1.0,
        inflow_speed: 1.0,
        length: 0.01,
        k: vec![k],
        epsilon: vec![epsilon],
    }
}

fn settings(model: Model, gravity: [f64; 3]) -> Settings {
    Settings {
        model,
        integrator: match model {
            Model::Published(_) => Integrator::RungeKutta4,
            _ => Integrator::Strang,
        },
        turbulence: TurbulenceSource::History,
        gravity,
        reynolds: Some(1e4),
        ..Settings::default()
    }
}

fn ellipsoid(semi_axes: [f64; 3], spec: &BodySpec) -> Result<Body, ReportError> {
    let mesh = Shape::Ellipsoid { semi_axes }
        .mesh(320)
        .map_err(|e| ReportError::Bake(e.into()))?;
    let (body, _) = bake_body(&mesh, spec, &()).map_err(|e| ReportError::Bake(e.into()))?;
    Ok(body)
}

/// The states of a run, as far as it goes.
fn states(stepper: &Stepper, start: State, dt: f64, steps: u32, noise: NoiseStream) -> Vec<State> {
    let mut states = vec![start];
    let mut state = start;
    for _ in 0..steps {
        if stepper.step(&mut state, dt, &noise.into()).is_err() {
            break;
        }
        states.push(state);
    }
    states
}

/// Eq. (4): energy without loads.
fn cross_term(section: &mut Section) -> Result<(), ReportError> {
    section.heading("The cross term of Eqs. (4) and (11)");
    let spec = BodySpec {
        density: Some(1100.0),
        ..BodySpec::default()
    };
    let body = ellipsoid([0.01, 0.02, 0.04], &spec)?;
    let start = State {
        velocity: [0.3, 0.1, -0.2],
        angular_velocity: [2.0, -3.0, 1.0],
        ..State::default()
    };
    let mut curves = Vec::new();
    let mut drifts = Vec::new();
    for (name, model) in [("published", PUBLISHED), ("kirchhoff", Model::Kirchhoff)] {
        let calm = frozen(1.0, 0.0);
        let stepper = Stepper::new(
            &body,
            &Fluid::WATER,
            Some(&calm),
            &settings(model, [0.0; 3]),
        )?;
        let before = stepper.kinetic_energy(&start);
        let states = states(&stepper, start, 1e-3, 1000, NoiseStream::default());
        let energy = |s: &State| stepper.kinetic_energy(s) / before;
        let drift = states.last().map_or(f64::NAN, |s| energy(s) - 1.0);
        drifts.push(section.quote(format!("cross_term.{name}.drift"), 100.0 * drift, 2));
        let points = states.iter().map(|s| [s.time, energy(s)]).collect();
        curves.push(Curve::new(name, points));
    }
    section.text(format!(
        "Without loads the kinetic energy of body and fluid is conserved. For the 1:2:4 ellipsoid in water, \
         over one second in steps of 1 ms, the printed v \u{d7} (M\u{3c9}) changes it by {} %; Kirchhoff's \
         \u{3c9} \u{d7} (Mv) by {} %, the integrator's error.",
        drifts[0], drifts[1]
    ));
    section.row(&[figure(
        &Chart::new("time (s)", "energy over its start", curves),
        "",
    )]);
    Ok(())
}

/// Eqs. (11), (12): forces without a mass.
fn units(
    section: &mut Section,
    options: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    const END: f64 = 0.5;
    section.heading("The units of Eqs. (11) and (12)");
    section.text(format!(
        "The Langevin terms are accelerations that are divided by mass and inertia, so that the result \
         depends on the units. The sheet of Fig. 3 with the precomputed turbulence: time at which it passes \
         {} m/s or rad/s, if it does within {END} s (first seed).",
        significant(SPEED_LIMIT, 1)
    ));
    let setting = Setting::new("paper-75", options, progress)?;
    let mut rows = Vec::new();
    for model in [PUBLISHED, PUBLISHED_SI, Model::Consistent] {
        let reading = Reading {
            model,
            ..CONSISTENT_HISTORY
        };
        let stepper = setting.stepper(&reading)?;
        let mut row = vec![model.to_string()];
        for (name, dt) in [
            ("5ms", 5e-3),
            ("1ms", 1e-3),
            ("0.1ms", 1e-4),
            ("10us", 1e-5),
        ] {
            let steps = (END / dt + 0.5) as u32;
            let noise = NoiseStream {
                seed: options.first_seed,
                body: 0,
            };
            let mut state = setting.scene.release;
            let lasted = (0..steps).all(|_| stepper.step(&mut state, dt, &noise.into()).is_ok());
            let key = format!("units.{model}.{name}");
            row.push(if lasted {
                let speed = section.quote(format!("{key}.speed"), norm(state.velocity), 3);
                format!("none; {speed} m/s at the end")
            } else {
                let time = section.quote(format!("{key}.diverged"), state.time + dt, 3);
                let step = section.quote(format!("{key}.steps"), (state.step + 1) as f64, 0);
                format!("{time} s, step {step}")
            });
        }
        rows.push(row);
    }
    section.table(
        "units",
        &[
            "model",
            "5 ms (the paper's)",
            "1 ms",
            "0.1 ms",
            "10 \u{b5}s",
        ],
        &rows,
    );
    Ok(())
}

/// Section 6: drag that fades like 1/t.
fn decaying_turbulence(
    section: &mut Section,
    options: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    const END: f64 = 10.0;
    section.heading("The turbulence of a passive particle");
    let setting = Setting::new("paper-75", options, progress)?;
    let bake = &setting.baked.bake;
    let fixed = bake.history.clone().unwrap_or_else(|| frozen(0.0, 0.0));
    let mut flow = FlowOptions::new(setting.scene.grid.cells, fixed.length, fixed.inflow_speed);
    flow.sampling = Sampling::PassiveParticle;
    flow.duration = END;
    let fading = turbulence_history(&flow, progress)?;
    let mut curves = Vec::new();
    let mut rows = Vec::new();
    for (name, reading, history) in [
        ("passive particle (section 6)", CONSISTENT_HISTORY, &fading),
        ("history at the body", CONSISTENT_HISTORY, &fixed),
        ("body-driven", CONSISTENT, &fixed),
    ] {
        let bake = Bake {
            history: Some(history.clone()),
            ..bake.clone()
        };
        let scene = reading.applied(setting.scene.clone());
        let stepper = baking::stepper(&scene, &bake)?;
        let speeds = mean_speed(&stepper, &setting, options, END);
        if progress.cancelled() {
            return Err(ReportError::Cancelled);
        }
        let mut row = vec![name.to_owned()];
        for second in [1, 2, 5, 10] {
            let key = format!("decay.{}.{second}s", name.split(' ').next().unwrap_or(name));
            let speed = speeds.get(second * 10 - 1).map_or(f64::NAN, |p| p[1]);
            row.push(section.quote(key, speed, 3).to_string());
        }
        rows.push(row);
        curves.push(Curve::new(name, speeds));
    }
    section.text(
        "A passive particle in a uniform stream sees turbulence that decays, so its drag fades and a \
         falling body accelerates without limit. Sampled at the body, it settles; born at the body with \
         its present speed, it gives a terminal speed of the order of U0. Downward speed of the sheet of \
         Fig. 3 under <i>consistent</i>, mean over the seeds, with no ground:",
    );
    section.row(&[figure(
        &Chart::new("time (s)", "downward speed (m/s)", curves),
        "",
    )]);
    section.table(
        "decay",
        &["turbulence", "1 s (m/s)", "2 s", "5 s", "10 s"],
        &rows,
    );
    Ok(())
}

/// Mean downward speed over each tenth of a second and over the seeds.
fn mean_speed(stepper: &Stepper, setting: &Setting, options: &Options, end: f64) -> Vec<[f64; 2]> {
    let dt = FINE_STEP;
    let stride = (0.1 / dt + 0.5) as usize;
    let heights: Vec<Vec<f64>> = (0..u64::from(options.seeds))
        .into_par_iter()
        .map(|i| {
            let noise = NoiseStream {
                seed: options.first_seed.saturating_add(i),
                body: 0,
            };
            let steps = (end / dt + 0.5) as u32;
            let states = states(stepper, setting.scene.release, dt, steps, noise);
            states
                .iter()
                .step_by(stride)
                .map(|s| s.position[1])
                .collect()
        })
        .collect();
    let count = heights.iter().map(Vec::len).min().unwrap_or(0);
    (1..count)
        .map(|k| {
            let drop: f64 = heights.iter().map(|h| h[k - 1] - h[k]).sum();
            [0.1 * k as f64, drop / (0.1 * heights.len() as f64)]
        })
        .collect()
}

/// Eqs. (8), (12): noise without relaxation.
fn spin(
    section: &mut Section,
    options: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("The spin of Eqs. (8) and (12)");
    let spec = BodySpec {
        density: Some(3.0),
        ..BodySpec::default()
    };
    let body = ellipsoid([0.05, 0.02, 0.05], &spec)?;
    let history = frozen(0.5, 10.0);
    let mut curves = Vec::new();
    let mut rows = Vec::new();
    for (name, model) in [("published", PUBLISHED), ("consistent", Model::Consistent)] {
        let stepper = Stepper::new(
            &body,
            &Fluid::AIR,
            Some(&history),
            &settings(model, [0.0; 3]),
        )?;
        let squares: Vec<Vec<f64>> = (0..u64::from(options.seeds))
            .into_par_iter()
            .map(|i| {
                let noise = NoiseStream {
                    seed: options.first_seed.saturating_add(i),
                    body: 0,
                };
                let states = states(&stepper, State::default(), 1e-3, 1600, noise);
                states
                    .iter()
                    .map(|s| norm(s.angular_velocity).powi(2))
                    .collect()
            })
            .collect();
        if progress.cancelled() {
            return Err(ReportError::Cancelled);
        }
        let count = squares.iter().map(Vec::len).min().unwrap_or(0);
        let rms =
            |k: usize| (squares.iter().map(|s| s[k]).sum::<f64>() / squares.len() as f64).sqrt();
        let points: Vec<[f64; 2]> = (0..count).map(|k| [1e-3 * k as f64, rms(k)]).collect();
        let mut row = vec![name.to_owned()];
        for time in [0.1, 0.4, 1.6] {
            let value = points
                .get((1e3 * time + 0.5) as usize)
                .map_or(f64::NAN, |p| p[1]);
            row.push(
                section
                    .quote(format!("spin.{name}.{time}s"), value, 3)
                    .to_string(),
            );
        }
        rows.push(row);
        curves.push(Curve::new(name, points));
    }
    section.text(
        "With noise and no relaxation the angular velocity is a random walk: four times the time, twice the \
         spin. An ellipsoid of 10 x 4 x 10 cm and 3 kg/m\u{b3} in turbulence with k = 0.5 m\u{b2}/s\u{b2} and \u{3b5} = 10 \
         m\u{b2}/s\u{b3}, root mean square over the seeds:",
    );
    section.row(&[figure(
        &Chart::new("time (s)", "spin, rms (rad/s)", curves),
        "",
    )]);
    section.table("spin", &["model", "0.1 s (rad/s)", "0.4 s", "1.6 s"], &rows);
    Ok(())
}

/// Eq. (6): which way up is stable.
fn buoyancy(section: &mut Section) -> Result<(), ReportError> {
    section.heading("The sign of Eq. (6)");
    let spec = BodySpec {
        density: Some(1000.0),
        centre_of_mass: Some([0.0, -0.005, 0.0]),
        ..BodySpec::default()
    };
    let body = ellipsoid([0.02, 0.02, 0.02], &spec)?;
    let mut axes = Axes::new(&body);
    axes.set_thin([0.0, 1.0, 0.0]);
    let half = 5f64.to_radians();
    let start = State {
        orientation: [0.0, 0.0, libm::sin(half), libm::cos(half)],
        ..State::default()
    };
    let calm = frozen(1.0, 0.0);
    let mut curves = Vec::new();
    let mut widest = Vec::new();
    for (name, model) in [("published", PUBLISHED), ("kirchhoff", Model::Kirchhoff)] {
        let settings = settings(model, langevin_rigid::GRAVITY);
        let stepper = Stepper::new(&body, &Fluid::WATER, Some(&calm), &settings)?;
        let states = states(&stepper, start, 1e-3, 2000, NoiseStream::default());
        let points: Vec<[f64; 2]> = states.iter().map(|s| [s.time, axes.lean(s)]).collect();
        let most = points.iter().map(|p| p[1]).fold(0.0, f64::max);
        widest.push(section.quote(format!("buoyancy.{name}.widest"), most, 3));
        curves.push(Curve::new(name, points));
    }
    section.text(format!(
        "A ball whose centre of mass is below its centre of buoyancy, let go at 10 degrees from upright: as \
         printed it leans up to {} degrees in two seconds, with the sign of here up to {}.",
        widest[0], widest[1]
    ));
    section.row(&[figure(&Chart::new("time (s)", "lean (deg)", curves), "")]);
    Ok(())
}

/// Section 7: the Reynolds number of the sheet.
fn reynolds(
    section: &mut Section,
    options: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("The Reynolds number of the sheet");
    let setting = Setting::new("paper-75", options, progress)?;
    let body = &setting.baked.bake.body;
    let here = setting.stepper(&CONSISTENT)?.reynolds();
    let speed = baking::characteristic_speed(&setting.scene, body);
    let speed = section.quote("reynolds.speed", speed, 3);
    let printed = section.quote("reynolds.paper", paper::SHEET_REYNOLDS, 2);
    let here = section.quote("reynolds.here", here, 3);
    section.text(format!(
        "Eq. (1) gives U0 = {speed} m/s and Re = {here} for the sheet; section 7 states {printed}."
    ));
    Ok(())
}
