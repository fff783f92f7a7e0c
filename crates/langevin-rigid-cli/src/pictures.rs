//! The picture and the film of a run.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Result;
use langevin_rigid::Surface;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::files;
use langevin_rigid_pictures::{
    Film, PictureError, PictureOptions, Pose, Subject, View, picture_in_flow, trajectory_picture,
};
use langevin_rigid_scenes::prepared::Prepared;
use rayon::prelude::*;

use crate::arguments::{Shown, Viewpoint};
use crate::bars::Bars;
use crate::say;

/// Frames drawn at a time: all before them are written when a film is interrupted.
const BATCH: usize = 32;

/// A run as the command line wants it drawn.
pub(crate) struct Shot<'a> {
    surface: &'a Surface,
    poses: &'a [Pose],
    options: PictureOptions,
    prepared: &'a Prepared,
}

/// Frames on disk.
pub(crate) struct Written {
    folder: PathBuf,
    frames: usize,
    of: usize,
    fps: f64,
}

impl<'a> Shot<'a> {
    pub(crate) fn new(
        shown: Shown,
        from: Option<Viewpoint>,
        prepared: &'a Prepared,
        poses: &'a [Pose],
    ) -> Self {
        let scene = prepared.scene();
        let (model, seed) = (scene.settings.model, scene.seed);
        let usual = PictureOptions::default();
        Self {
            surface: &prepared.body().surface,
            poses,
            prepared,
            options: PictureOptions {
                title: Some(format!("{} ({model}, seed {seed})", scene.name)),
                ground: scene.stop.ground,
                interval: scene.picture_interval.filter(|_| shown != Shown::Path),
                view: from.map_or(usual.view, Viewpoint::view),
                path: shown != Shown::Strobe,
                max_instants: match shown {
                    Shown::Path => 0,
                    Shown::Strobe | Shown::Both => usual.max_instants,
                },
                size: usual.size,
            },
        }
    }

    fn subject(&self) -> Subject<'a> {
        Subject {
            vertices: &self.surface.vertices,
            triangles: &self.surface.triangles,
        }
    }

    /// The bytes of the PNG.
    pub(crate) fn picture(&self) -> Result<Vec<u8>, PictureError> {
        let (subject, options) = (self.subject(), &self.options);
        if self.prepared.is_still() {
            return trajectory_picture(&subject, self.poses, options)?.png();
        }
        let [first, last] = [self.poses.first(), self.poses.last()];
        let over = [first, last].map(|pose| pose.map_or(0.0, |pose| pose.time));
        let flow = |place| self.prepared.mean_flow(place, over);
        picture_in_flow(&subject, self.poses, options, &flow)?.png()
    }
}

impl Viewpoint {
    fn view(self) -> View {
        match self {
            Self::Front => View::Front,
            Self::Side => View::Side,
            Self::Top => View::Top,
            Self::Iso => View::Iso,
        }
    }
}

/// Writes the frames of a run into `folder`, as many as there are until Ctrl-C.
pub(crate) fn film(shot: &Shot<'_>, folder: &Path, fps: f64, bars: &Bars) -> Result<Written> {
    let film = Film::new(&shot.subject(), shot.poses, &shot.options, fps)?;
    let mut written = Written {
        folder: folder.to_owned(),
        frames: 0,
        of: film.frames(),
        fps,
    };
    while written.frames < written.of && !bars.cancelled() {
        let batch = written.frames..(written.frames + BATCH).min(written.of);
        let end = batch.end;
        batch.into_par_iter().try_for_each(|number| -> Result<()> {
            let name = format!("frame-{:05}.png", number + 1);
            Ok(files::write(
                &folder.join(name),
                &film.frame(number)?.png()?,
            )?)
        })?;
        written.frames = end;
        bars.report("drawing frames", end as f64 / written.of as f64);
    }
    Ok(written)
}

impl Written {
    /// Says what there is and how it becomes a film; aside when standard output carries JSON.
    pub(crate) fn tell(&self, aside: bool) -> Result<()> {
        let Self {
            folder,
            frames,
            of,
            fps,
        } = self;
        let all = if frames < of {
            format!(" of {of}")
        } else {
            String::new()
        };
        // The count keeps the frames of an older, longer film in the same folder out of this one.
        let text = format!(
            "  wrote {frames}{all} frames to {}; a film of them:\n  ffmpeg -framerate {fps} -i '{}' \
             -frames:v {frames} -pix_fmt yuv420p film.mp4",
            folder.display(),
            folder.join("frame-%05d.png").display()
        );
        match aside {
            true => say::aside(&text),
            false => writeln!(say::out(), "{text}")?,
        }
        Ok(())
    }
}
