//! A run that `simulate` wrote into a folder.

use std::path::Path;

use anyhow::{Context, Result, bail};
use langevin_rigid_formats::export::{BodyRow, Format, read_bodies};
use langevin_rigid_formats::trajectory::{Trajectory, read_csv};
use langevin_rigid_scenes::scene::{self, Scene};
use serde_json::Value;

/// The table of kinds and sizes.
pub(crate) const BODIES: &str = "bodies.csv";

/// The folder of a run, and what the run said of itself.
pub(crate) struct RecordedRun<'a> {
    folder: &'a Path,
    /// Nothing where it is lost.
    summary: Value,
}

/// A table of a run.
pub(crate) struct Table<R> {
    /// The file.
    pub(crate) text: String,
    /// What it says.
    pub(crate) rows: Vec<R>,
}

impl<'a> RecordedRun<'a> {
    pub(crate) fn open(folder: &'a Path) -> Self {
        let bytes = std::fs::read(folder.join("summary.json")).ok();
        let summary = bytes.and_then(|bytes| serde_json::from_slice(&bytes).ok());
        Self {
            folder,
            summary: summary.unwrap_or_default(),
        }
    }

    /// Its table of every step.
    pub(crate) fn trajectories(&self) -> Result<Table<Trajectory>> {
        let name = Format::Csv.file_name();
        let path = self.folder.join(name);
        let text = std::fs::read_to_string(&path).with_context(|| {
            format!(
                "cannot read `{}`, the table that runs are read from; give a folder that `langevin-rigid \
                 simulate` wrote with csv among its formats",
                path.display()
            )
        })?;
        if self.wrote(name) == Some(false) {
            bail!(
                "`{}` is of an older run: the last one in this folder was not asked for csv; simulate it \
                 again with csv among its formats",
                path.display()
            );
        }
        let rows = read_csv(&text).with_context(|| path.display().to_string())?;
        Ok(Table { text, rows })
    }

    /// Kinds and sizes of its bodies, where they differ.
    pub(crate) fn bodies(&self) -> Result<Option<Table<BodyRow>>> {
        if self.wrote(BODIES) != Some(true) {
            return Ok(None);
        }
        let path = self.folder.join(BODIES);
        let text = std::fs::read_to_string(&path).with_context(|| {
            format!(
                "cannot read `{}`, the kinds and sizes of the bodies",
                path.display()
            )
        })?;
        let rows = read_bodies(&text).with_context(|| path.display().to_string())?;
        Ok(Some(Table { text, rows }))
    }

    /// Its scene, by the name it had.
    pub(crate) fn scene(&self) -> Result<Scene> {
        let path = self.folder.join("scene.toml");
        let scene = scene::find(&path.display().to_string())?;
        let name = self.summary["scene"].as_str().unwrap_or(&scene.name);
        Ok(Scene {
            name: name.to_owned(),
            ..scene
        })
    }

    /// Whether the run wrote this file, if that is known.
    fn wrote(&self, name: &str) -> Option<bool> {
        let files = self.summary["files"].as_array()?;
        Some(files.iter().any(|file| file == name))
    }
}
