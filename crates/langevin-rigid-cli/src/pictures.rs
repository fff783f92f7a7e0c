//! The picture and the film of a run.

use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::Result;
use langevin_rigid::Body;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::export::RecordedBody;
use langevin_rigid_formats::files;
use langevin_rigid_pictures::{
    Actor, Film, Picture, PictureError, PictureOptions, Pose, Subject, View, crowd_picture,
    picture_in_flow, trajectory_picture,
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
    subjects: Vec<Subject<'a>>,
    actors: Vec<Actor<'a>>,
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
    /// All bodies of a world; of bodies that know nothing of each other the first, one body or more.
    pub(crate) fn new(
        shown: Shown,
        from: Option<Viewpoint>,
        prepared: &'a Prepared,
        bodies: &[RecordedBody<'a>],
    ) -> Self {
        let actor = |body: &RecordedBody<'a>| Actor {
            subject: body.kind,
            scale: body.scale,
            poses: &body.trajectory.poses,
        };
        let (subjects, seen) = match prepared.surroundings() {
            None => (vec![subject(prepared.body())], &bodies[..1]),
            Some(surroundings) => {
                let kinds = surroundings.kinds().iter();
                let subjects = kinds.map(|kind| subject(&kind.baked.bake.body));
                (subjects.collect(), bodies)
            }
        };
        let scene = prepared.scene();
        let (model, seed) = (scene.settings.model, scene.seed);
        let usual = PictureOptions::default();
        Self {
            subjects,
            actors: seen.iter().map(actor).collect(),
            prepared,
            options: PictureOptions {
                title: Some(format!("{} ({model}, seed {seed})", scene.name)),
                stage: prepared.stage(),
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

    /// The body, if there is one only, at its own size.
    fn alone(&self) -> Option<(&Subject<'a>, &'a [Pose])> {
        match self.actors[..] {
            [
                Actor {
                    subject,
                    scale: 1.0,
                    poses,
                },
            ] => Some((&self.subjects[subject], poses)),
            _ => None,
        }
    }

    /// The bytes of the PNG.
    pub(crate) fn picture(&self) -> Result<Vec<u8>, PictureError> {
        self.drawn()?.png()
    }

    fn drawn(&self) -> Result<Picture, PictureError> {
        let options = &self.options;
        let poses = || self.actors.iter().flat_map(|actor| actor.poses);
        let times = || poses().map(|pose| pose.time);
        let over = [
            times().reduce(f64::min).unwrap_or(0.0),
            times().reduce(f64::max).unwrap_or(0.0),
        ];
        let flow = |place| self.prepared.mean_flow(place, over);
        let still = self.prepared.is_still();
        match self.alone() {
            Some((subject, poses)) if still => trajectory_picture(subject, poses, options),
            Some((subject, poses)) => picture_in_flow(subject, poses, options, &flow),
            None if still => crowd_picture(&self.subjects, &self.actors, options, None),
            None => crowd_picture(&self.subjects, &self.actors, options, Some(&flow)),
        }
    }

    fn film(&self, fps: f64) -> Result<Film<'_>, PictureError> {
        match self.alone() {
            Some((subject, poses)) => Film::new(subject, poses, &self.options, fps),
            None => Film::of_crowd(&self.subjects, &self.actors, &self.options, fps),
        }
    }
}

fn subject(body: &Body) -> Subject<'_> {
    Subject {
        vertices: &body.surface.vertices,
        triangles: &body.surface.triangles,
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
    let film = shot.film(fps)?;
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
