//! What a run comes to, in numbers.

use std::collections::BTreeMap;

use langevin_rigid::{State, Stepper};
use langevin_rigid_formats::export::{Deviation, Format, Written};
use langevin_rigid_scenes::baking::Baked;
use langevin_rigid_scenes::prepared::{Fall, Prepared};
use langevin_rigid_scenes::scene::Scene;
use serde::Serialize;

/// `summary.json`; SI units. Of several bodies the numbers are the first one's, unless they say otherwise.
#[derive(Debug, Serialize)]
pub(crate) struct Summary {
    pub(crate) scene: String,
    pub(crate) version: &'static str,
    pub(crate) seed: u64,
    pub(crate) model: String,
    pub(crate) integrator: String,
    pub(crate) turbulence: String,
    pub(crate) time_step: f64,
    pub(crate) bodies: usize,
    /// How many bodies ended how.
    pub(crate) endings: BTreeMap<&'static str, usize>,
    pub(crate) steps: u64,
    pub(crate) duration: f64,
    /// Why the run ended: ground, time, interrupted, memory or diverged.
    pub(crate) ending: &'static str,
    pub(crate) triangles: usize,
    pub(crate) mass: f64,
    pub(crate) volume: f64,
    #[serde(rename = "U0")]
    pub(crate) u0: f64,
    #[serde(rename = "Re")]
    pub(crate) re: f64,
    /// Mean vertical speed over the last half of the run.
    pub(crate) terminal_speed: f64,
    pub(crate) energy: Energy,
    pub(crate) added_mass_error_estimate: f64,
    /// How far each animation strays from the trajectory.
    pub(crate) deviation: BTreeMap<&'static str, Deviation>,
    /// What was written besides this and the scene.
    pub(crate) files: Vec<String>,
    pub(crate) warnings: Vec<String>,
    pub(crate) bake_cached: bool,
    pub(crate) seconds: Seconds,
}

/// Energy balance of body and fluid, relative to the undisturbed fluid (J).
#[derive(Debug, Serialize)]
pub(crate) struct Energy {
    pub(crate) kinetic_at_release: f64,
    pub(crate) kinetic_at_end: f64,
    /// Work of gravity less buoyancy.
    pub(crate) weight_work: f64,
    /// What the fluid took, net of what its turbulence and the wind gave.
    pub(crate) dissipated: f64,
}

/// Wall-clock time of each stage.
#[derive(Debug, Default, Serialize)]
pub(crate) struct Seconds {
    pub(crate) bake: f64,
    pub(crate) run: f64,
    pub(crate) per_step: f64,
    pub(crate) write: f64,
    pub(crate) picture: f64,
}

impl Summary {
    /// Of a run, which has one body or more.
    pub(crate) fn new(prepared: &Prepared, falls: &[Fall]) -> Self {
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
    pub(crate) fn wrote(&mut self, format: Format, written: Written) {
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
