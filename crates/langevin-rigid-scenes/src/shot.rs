//! The picture and the film of a run.

use std::path::Path;

use langevin_rigid::Body;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::export::RecordedBody;
use langevin_rigid_formats::files::{self, WriteError};
use langevin_rigid_pictures::{
    Actor, Film, Picture, PictureError, PictureOptions, Pose, Subject, View, crowd_picture,
    picture_in_flow, trajectory_picture,
};
use rayon::prelude::*;

use crate::prepared::Prepared;

/// Frames drawn at a time: all before them are written when a film is interrupted.
const BATCH: usize = 32;

/// What a picture shows of a motion.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Shown {
    /// The bodies at equal times.
    Strobe,
    /// Their paths.
    Path,
    /// Both.
    #[default]
    Both,
}

/// A run, ready to be drawn.
///
/// ```
/// use langevin_rigid_formats::trajectory::Trajectory;
/// use langevin_rigid_pictures::View;
/// use langevin_rigid_scenes::prepared::Prepared;
/// use langevin_rigid_scenes::scene::Scene;
/// use langevin_rigid_scenes::shot::{Shot, Shown};
///
/// let scene = Scene::parse("ball", "ball.toml", r#"
///     fluid.preset = "water"
///     run = { time_step = 0.002, duration = 0.5 }
///     body = { shape = "ellipsoid", semi_axes = [0.01, 0.01, 0.01], triangles = 80, density = 1100.0 }
/// "#)?;
/// let ball = Prepared::new(scene, None, &())?;
/// let falls = ball.drop_bodies(1, &())?;
/// let trajectory = falls[0].trajectory();
/// let shot = Shot::new(Shown::Both, View::Front, &ball, &[falls[0].recorded(&trajectory)]);
/// assert!(shot.picture()?.width() > 0);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct Shot<'a> {
    subjects: Vec<Subject<'a>>,
    actors: Vec<Actor<'a>>,
    options: PictureOptions,
    prepared: &'a Prepared,
}

/// Frames on disk.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Frames {
    /// How many are written.
    pub written: usize,
    /// How many the film has.
    pub of: usize,
}

/// Why there is no film.
#[derive(Debug, thiserror::Error)]
pub enum FilmError {
    /// A frame cannot be drawn.
    #[error(transparent)]
    Picture(#[from] PictureError),
    /// A frame cannot be written.
    #[error(transparent)]
    Write(#[from] WriteError),
}

impl<'a> Shot<'a> {
    /// All bodies of a world; of bodies that know nothing of each other the first. `bodies` has one or more.
    pub fn new(
        shown: Shown,
        view: View,
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
                view,
                path: shown != Shown::Strobe,
                max_instants: match shown {
                    Shown::Path => 0,
                    Shown::Strobe | Shown::Both => usual.max_instants,
                },
                size: usual.size,
            },
        }
    }

    /// The picture.
    ///
    /// # Errors
    /// [`PictureError`].
    pub fn picture(&self) -> Result<Picture, PictureError> {
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

    /// Writes a film of `fps` frames a second into `folder` as `frame-00001.png` and so on, on all cores; as many as there
    /// are until `progress` cancels.
    ///
    /// # Errors
    /// [`FilmError`]; the frames before stay.
    pub fn film(
        &self,
        folder: &Path,
        fps: f64,
        progress: &dyn Progress,
    ) -> Result<Frames, FilmError> {
        let film = match self.alone() {
            Some((subject, poses)) => Film::new(subject, poses, &self.options, fps)?,
            None => Film::of_crowd(&self.subjects, &self.actors, &self.options, fps)?,
        };
        let of = film.frames();
        let mut written = 0;
        while written < of && !progress.cancelled() {
            let end = (written + BATCH).min(of);
            (written..end)
                .into_par_iter()
                .try_for_each(|number| -> Result<(), FilmError> {
                    let name = format!("frame-{:05}.png", number + 1);
                    let png = film.frame(number)?.png()?;
                    Ok(files::write(&folder.join(name), &png)?)
                })?;
            written = end;
            progress.report("drawing frames", end as f64 / of as f64);
        }
        Ok(Frames { written, of })
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
}

fn subject(body: &Body) -> Subject<'_> {
    Subject {
        vertices: &body.surface.vertices,
        triangles: &body.surface.triangles,
    }
}
