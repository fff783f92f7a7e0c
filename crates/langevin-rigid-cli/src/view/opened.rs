//! The scene or run that is shown: read and checked before anything is served.

use std::collections::BTreeMap;
use std::path::Path;

use anyhow::Result;
use langevin_rigid_formats::export::Format;
use langevin_rigid_scenes::scene::{self, Scene};
use serde::Serialize;

use super::bundle::Bundle;
use crate::recorded_run::{BODIES, RecordedRun};

pub(super) struct Opened {
    kind: &'static str,
    name: String,
    /// The resolved scene, which names its files as `files` does.
    toml: String,
    pub(super) files: Vec<(String, Vec<u8>)>,
    /// The tables of a run.
    pub(super) tables: Vec<(&'static str, String)>,
}

/// What the page is told of it.
#[derive(Serialize)]
pub(super) struct Described<'a> {
    kind: &'static str,
    name: &'a str,
    toml: &'a str,
    files: Vec<&'a str>,
    tables: BTreeMap<&'static str, &'static str>,
}

impl Opened {
    /// Opens a folder as a run, all else as a scene.
    pub(super) fn read(what: &str) -> Result<Self> {
        let folder = Path::new(what);
        if folder.is_dir() {
            Self::run(folder)
        } else {
            Self::of("scene", scene::find(what)?, Vec::new())
        }
    }

    fn run(folder: &Path) -> Result<Self> {
        let run = RecordedRun::open(folder);
        let trajectories = run.trajectories()?;
        let bodies = run.bodies()?;
        let tables = [(Format::Csv.file_name(), trajectories.text)].into_iter();
        let tables = tables.chain(bodies.map(|bodies| (BODIES, bodies.text)));
        Self::of("run", run.scene()?, tables.collect())
    }

    fn of(kind: &'static str, scene: Scene, tables: Vec<(&'static str, String)>) -> Result<Self> {
        let name = scene.name.clone();
        let mut bundle = Bundle::default();
        let toml = bundle.add(scene)?;
        Ok(Self {
            kind,
            name,
            toml,
            files: bundle.files,
            tables,
        })
    }

    pub(super) fn described(&self) -> Described<'_> {
        let stem = |name: &'static str| name.split('.').next().unwrap_or(name);
        let tables = self.tables.iter().map(|(name, _)| (stem(name), *name));
        Described {
            kind: self.kind,
            name: &self.name,
            toml: &self.toml,
            files: self.files.iter().map(|(name, _)| name.as_str()).collect(),
            tables: tables.collect(),
        }
    }
}
