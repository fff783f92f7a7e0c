//! Runs of one scene under the readings of the paper, over many seeds.

use std::sync::Arc;
use std::sync::atomic::{AtomicU32, Ordering};

use langevin_rigid::{Ending, Model, State, Stepper, TurbulenceSource, UnitSystem};
use langevin_rigid_bake::progress::{Progress, Silent};
use langevin_rigid_pictures::{
    Picture, PictureOptions, Pose, Stage, Subject, View, picture_in_flow, trajectory_picture,
};
use langevin_rigid_scenes::baking::{self, Baked};
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene::{self, Scene};
use rayon::prelude::*;

use crate::error::ReportError;
use crate::options::Options;

/// Equations of motion and source of turbulence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Reading {
    pub(crate) model: Model,
    pub(crate) source: TurbulenceSource,
}

const BODY_DRIVEN: TurbulenceSource = TurbulenceSource::BodyDriven { wake_age: 0.0 };

/// Kirchhoff's equations alone.
pub(crate) const KIRCHHOFF: Reading = reading(Model::Kirchhoff, BODY_DRIVEN);
/// The full method as the program reads it.
pub(crate) const CONSISTENT: Reading = reading(Model::Consistent, BODY_DRIVEN);
/// The same with the precomputed turbulence.
pub(crate) const CONSISTENT_HISTORY: Reading =
    reading(Model::Consistent, TurbulenceSource::History);
/// The closure for separated flow.
pub(crate) const SEPARATED: Reading = reading(Model::Separated, BODY_DRIVEN);

/// All readings, in the order of the tables.
pub(crate) const READINGS: [Reading; 8] = [
    KIRCHHOFF,
    CONSISTENT,
    CONSISTENT_HISTORY,
    reading(Model::Published(UnitSystem::Cgs), BODY_DRIVEN),
    reading(Model::Published(UnitSystem::Cgs), TurbulenceSource::History),
    reading(Model::Published(UnitSystem::Si), BODY_DRIVEN),
    reading(Model::Published(UnitSystem::Si), TurbulenceSource::History),
    SEPARATED,
];

const fn reading(model: Model, source: TurbulenceSource) -> Reading {
    Reading { model, source }
}

impl Reading {
    /// Its name in tables, keys and files.
    pub(crate) fn name(&self) -> String {
        match self.model {
            Model::Kirchhoff => "kirchhoff".to_owned(),
            _ => format!("{}.{}", self.model, self.source),
        }
    }

    /// Its name in words.
    pub(crate) fn words(&self) -> String {
        match self.model {
            Model::Kirchhoff => "kirchhoff".to_owned(),
            _ => format!("{}, {}", self.model, self.source),
        }
    }

    /// Its name beside others that mostly have the usual source.
    pub(crate) fn short(&self) -> String {
        if self.source == BODY_DRIVEN {
            self.model.to_string()
        } else {
            self.words()
        }
    }

    /// `scene` under this reading.
    pub(crate) fn applied(&self, mut scene: Scene) -> Scene {
        scene.settings.model = self.model;
        scene.settings.turbulence = self.source;
        scene.settings.integrator = self.model.integrator();
        scene
    }
}

/// A built-in scene with its bake.
pub(crate) struct Setting {
    pub(crate) scene: Scene,
    pub(crate) baked: Arc<Baked>,
}

impl Setting {
    /// With the turbulence history, for every reading.
    pub(crate) fn new(
        name: &str,
        options: &Options,
        progress: &dyn Progress,
    ) -> Result<Self, ReportError> {
        let mut scene = scene::find(name)?;
        scene.settings.turbulence = TurbulenceSource::History;
        Self::of(scene, options, progress)
    }

    /// With the history only if the scene itself needs it.
    pub(crate) fn as_written(
        name: &str,
        options: &Options,
        progress: &dyn Progress,
    ) -> Result<Self, ReportError> {
        Self::of(scene::find(name)?, options, progress)
    }

    fn of(scene: Scene, options: &Options, progress: &dyn Progress) -> Result<Self, ReportError> {
        let baked = baking::bake_scene(&scene, options.cache.as_deref(), progress)?;
        let baked = Arc::new(baked);
        Ok(Self { scene, baked })
    }

    fn under(&self, reading: &Reading) -> Result<Prepared, ReportError> {
        let scene = reading.applied(self.scene.clone());
        Ok(Prepared::of(scene, Arc::clone(&self.baked))?)
    }

    pub(crate) fn stepper(&self, reading: &Reading) -> Result<Stepper, ReportError> {
        Ok(self.under(reading)?.stepper().clone())
    }

    /// A fall for each seed, in the order of the seeds. Kirchhoff's equations have no noise: one fall
    /// is all of them.
    pub(crate) fn falls(
        &self,
        reading: &Reading,
        options: &Options,
        progress: &dyn Progress,
    ) -> Result<Vec<Fall>, ReportError> {
        let prepared = self.under(reading)?;
        let seeds = if *reading == KIRCHHOFF {
            1
        } else {
            options.seeds
        };
        let done = AtomicU32::new(0);
        let stage = format!("{}, {}", self.scene.name, reading.words());
        let falls: Vec<Option<Fall>> = (0..seeds)
            .into_par_iter()
            .map(|i| {
                let seed = options.first_seed.saturating_add(u64::from(i));
                let fall = fall(&prepared, seed, progress);
                let done = done.fetch_add(1, Ordering::Relaxed) + 1;
                progress.report(&stage, f64::from(done) / f64::from(seeds));
                fall
            })
            .collect();
        falls
            .into_iter()
            .collect::<Option<_>>()
            .ok_or(ReportError::Cancelled)
    }

    /// The body along its path: `interval` seconds apart, or as close as bodies stay apart.
    pub(crate) fn picture(
        &self,
        fall: &Fall,
        title: String,
        view: View,
        interval: Option<f64>,
    ) -> Result<Picture, ReportError> {
        let surface = &self.baked.bake.body.surface;
        let subject = Subject {
            vertices: &surface.vertices,
            triangles: &surface.triangles,
        };
        let pose = |s: &State| Pose {
            time: s.time,
            position: s.position,
            orientation: s.orientation,
        };
        let poses: Vec<Pose> = fall.states.iter().map(pose).collect();
        let options = PictureOptions {
            title: Some(title),
            view,
            stage: Stage {
                ground: self.scene.stop.ground,
                ..Stage::default()
            },
            interval,
            ..PictureOptions::default()
        };
        let prepared = Prepared::of(self.scene.clone(), Arc::clone(&self.baked))?;
        if prepared.is_still() {
            return Ok(trajectory_picture(&subject, &poses, &options)?);
        }
        let [first, last] = [fall.states.first(), fall.states.last()];
        let over = [first, last].map(|state| state.map_or(0.0, |state| state.time));
        let flow = |place| prepared.mean_flow(place, over);
        Ok(picture_in_flow(&subject, &poses, &options, &flow)?)
    }
}

/// The fall of one seed; none if it was cancelled.
fn fall(prepared: &Prepared, seed: u64, progress: &dyn Progress) -> Option<Fall> {
    let mut release = prepared.release(0);
    release.noise.seed = seed;
    let fall = prepared.drop(&release, &Silent(progress));
    (fall.ended != Ok(Ending::Stopped)).then(|| Fall {
        seed,
        ending: fall.ending(),
        states: fall.states,
    })
}

/// One run.
#[derive(Debug, Clone)]
pub(crate) struct Fall {
    pub(crate) seed: u64,
    /// The release and every step after it.
    pub(crate) states: Vec<State>,
    /// ground, time or diverged.
    pub(crate) ending: &'static str,
}

impl Fall {
    pub(crate) fn diverged(&self) -> bool {
        self.ending == "diverged"
    }

    /// Time of the last state (s).
    pub(crate) fn duration(&self) -> f64 {
        self.states.last().map_or(0.0, |s| s.time)
    }
}

/// The fall that lasts the median time, of those that did not diverge: the one that is shown.
pub(crate) fn typical(falls: &[Fall]) -> Option<&Fall> {
    let mut good: Vec<&Fall> = falls.iter().filter(|f| !f.diverged()).collect();
    good.sort_by(|a, b| {
        a.duration()
            .total_cmp(&b.duration())
            .then(a.seed.cmp(&b.seed))
    });
    good.get(good.len().saturating_sub(1) / 2).copied()
}
