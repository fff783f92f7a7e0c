//! What a run comes to, in numbers.

use std::collections::BTreeMap;

use langevin_rigid::{State, Stepper};
use langevin_rigid_formats::export::{Deviation, Format, Written};
use serde::Serialize;

use crate::baking::Baked;
use crate::prepared::{Fall, Prepared};
use crate::scene::Scene;

/// `summary.json`; SI units. Of several bodies the numbers are the first one's, unless they say otherwise.
#[derive(Debug, Serialize)]
pub struct Summary {
    /// Name of the scene.
    pub scene: String,
    /// Version of the program.
    pub version: &'static str,
    /// Seed of the noise.
    pub seed: u64,
    /// Name of the model.
    pub model: String,
    /// Name of the integrator.
    pub integrator: String,
    /// Name of the source of turbulence.
    pub turbulence: String,
    /// Time step (s).
    pub time_step: f64,
    /// Number of bodies.
    pub bodies: usize,
    /// How many bodies ended how.
    pub endings: BTreeMap<&'static str, usize>,
    /// Steps of the run.
    pub steps: u64,
    /// How long it took the body (s).
    pub duration: f64,
    /// Why the run ended: ground, time, interrupted, memory or diverged.
    pub ending: &'static str,
    /// Triangles of its surface.
    pub triangles: usize,
    /// Its mass (kg).
    pub mass: f64,
    /// Its volume (m^3).
    pub volume: f64,
    /// Falling speed U0, Eq. (1) (m/s).
    #[serde(rename = "U0")]
    pub u0: f64,
    /// Reynolds number of the run.
    #[serde(rename = "Re")]
    pub re: f64,
    /// Mean vertical speed over the last half of the run.
    pub terminal_speed: f64,
    /// Energy balance.
    pub energy: Energy,
    /// Relative error of the added mass, as estimated.
    pub added_mass_error_estimate: f64,
    /// How far each animation strays from the trajectory.
    pub deviation: BTreeMap<&'static str, Deviation>,
    /// What was written besides this and the scene.
    pub files: Vec<String>,
    /// What is not as it should be.
    pub warnings: Vec<String>,
    /// Whether the bake had been made before.
    pub bake_cached: bool,
    /// Wall-clock time of each stage.
    pub seconds: Seconds,
}

/// Energy balance of body and fluid, relative to the undisturbed fluid (J).
#[derive(Debug, Serialize)]
pub struct Energy {
    /// Kinetic energy at release.
    pub kinetic_at_release: f64,
    /// Kinetic energy at the end.
    pub kinetic_at_end: f64,
    /// Work of gravity less buoyancy.
    pub weight_work: f64,
    /// What the fluid took, net of what its turbulence and the wind gave.
    pub dissipated: f64,
}

/// Wall-clock time of each stage.
#[derive(Debug, Default, Serialize)]
pub struct Seconds {
    /// Bake, or reading it (s).
    pub bake: f64,
    /// Run (s).
    pub run: f64,
    /// Run, for each step of a body (s).
    pub per_step: f64,
    /// Writing of tables and animations (s).
    pub write: f64,
    /// Picture (s).
    pub picture: f64,
}

impl Summary {
    /// Of a run, which has one body or more.
    pub fn new(prepared: &Prepared, falls: &[Fall]) -> Self {
        let (scene, baked) = (prepared.scene(), prepared.baked());
        let (body, stepper) = (prepared.body(), prepared.stepper());
        let states = &falls[0].states;
        let mut endings = BTreeMap::new();
        for fall in falls {
            *endings.entry(fall.ending()).or_default() += 1;
        }
        let (first, last) = (
            states.first().unwrap_or(&scene.release),
            states.last().unwrap_or(&scene.release),
        );
        Self {
            scene: scene.name.clone(),
            version: env!("CARGO_PKG_VERSION"),
            seed: scene.seed,
            model: scene.settings.model.to_string(),
            integrator: scene.settings.integrator.to_string(),
            turbulence: scene.settings.turbulence.to_string(),
            time_step: scene.time_step,
            bodies: falls.len(),
            endings,
            steps: last.step,
            duration: last.time,
            ending: falls[0].ending(),
            triangles: body.surface.triangles.len(),
            mass: body.mass,
            volume: body.volume,
            u0: langevin_rigid::falling_speed(body, &scene.fluid, scene.settings.gravity),
            re: stepper.reynolds(),
            terminal_speed: terminal_speed(states),
            energy: energy(scene, baked, stepper, first, last),
            added_mass_error_estimate: baked.bake.error_estimate,
            deviation: BTreeMap::new(),
            files: Vec::new(),
            warnings: baked.bake.warnings.clone(),
            bake_cached: baked.cached,
            seconds: Seconds::default(),
        }
    }

    /// Notes the files of a format and how good they are.
    pub fn wrote(&mut self, format: Format, written: Written) {
        self.files.extend(written.files);
        // Of two animations of one run the same is to be said.
        let new = |warning: &String| !self.warnings.contains(warning);
        let warnings: Vec<String> = written.warnings.into_iter().filter(new).collect();
        self.warnings.extend(warnings);
        if let Some(deviation) = written.deviation {
            self.deviation.insert(format.name(), deviation);
        }
    }
}

fn terminal_speed(states: &[State]) -> f64 {
    match (states.get(states.len() / 2), states.last()) {
        (Some(half), Some(last)) if last.time > half.time => {
            ((half.position[1] - last.position[1]) / (last.time - half.time)).abs()
        }
        _ => 0.0,
    }
}

fn energy(scene: &Scene, baked: &Baked, stepper: &Stepper, first: &State, last: &State) -> Energy {
    let body = &baked.bake.body;
    let kinetic_at_release = stepper.kinetic_energy(first);
    let kinetic_at_end = stepper.kinetic_energy(last);
    let net_mass = body.mass - scene.fluid.density * body.volume;
    let carried = |i: usize| scene.fluid.velocity[i] * (last.time - first.time);
    let weight_work: f64 = (0..3)
        .map(|i| {
            let way = last.position[i] - first.position[i] - carried(i);
            net_mass * scene.settings.gravity[i] * way
        })
        .sum();
    Energy {
        kinetic_at_release,
        kinetic_at_end,
        weight_work,
        dissipated: kinetic_at_release + weight_work - kinetic_at_end,
    }
}
