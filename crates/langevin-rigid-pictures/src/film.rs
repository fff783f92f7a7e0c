//! A film of the motion: in each frame the body or the bodies, their paths behind them, the camera fixed.

use crate::backdrop::{self, Backdrop};
use crate::canvas::Canvas;
use crate::cast::Cast;
use crate::crowd::{self, Moment};
use crate::layout::Layout;
use crate::numbers::fixed;
use crate::scene::{self, Motion, Trail};
use crate::strobe::Instants;
use crate::{Actor, Picture, PictureError, PictureOptions, Pose, Subject, axes, legend};

/// The frames of a motion, all of one size and seen from one place.
///
/// ```
/// use langevin_rigid_pictures::{Film, PictureOptions, Pose, Subject};
/// let sheet = Subject {
///     vertices: &[[-0.1, 0.0, -0.1], [0.1, 0.0, -0.1], [0.1, 0.0, 0.1]],
///     triangles: &[[0, 2, 1]],
/// };
/// let pose = |time| Pose { time, position: [0.0, -time, 0.0], orientation: [0.0, 0.0, 0.0, 1.0] };
/// let poses = [pose(0.0), pose(1.0)];
/// let film = Film::new(&sheet, &poses, &PictureOptions::default(), 25.0)?;
/// assert_eq!(film.frames(), 26);
/// assert_eq!(film.frame(25)?.times(), [1.0]);
/// # Ok::<(), langevin_rigid_pictures::PictureError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Film<'a> {
    cast: Cast<'a>,
    layout: Layout,
    backdrop: Backdrop,
    title: Option<String>,
    path: bool,
    fps: f64,
    frames: usize,
}

impl<'a> Film<'a> {
    /// Most frames of a film: their numbers have five digits.
    pub const MOST_FRAMES: usize = 99_999;

    /// The film of `poses` at `fps` frames a second, the first at the first pose. The options'
    /// instants and interval mean nothing here.
    ///
    /// # Errors
    ///
    /// As [`super::trajectory_picture`], and [`PictureError::FrameRate`].
    pub fn new(
        subject: &Subject<'_>,
        poses: &'a [Pose],
        options: &PictureOptions,
        fps: f64,
    ) -> Result<Self, PictureError> {
        Self::of(Cast::alone(subject, poses)?, options, fps)
    }

    /// The film of many bodies, each of which is there from its first pose on; the first frame is at the first pose of all.
    ///
    /// ```
    /// use langevin_rigid_pictures::{Actor, Film, PictureOptions, Pose, Subject};
    /// let sheet = Subject {
    ///     vertices: &[[-0.1, 0.0, -0.1], [0.1, 0.0, -0.1], [0.1, 0.0, 0.1]],
    ///     triangles: &[[0, 2, 1]],
    /// };
    /// let pose = |time, x| Pose { time, position: [x, -time, 0.0], orientation: [0.0, 0.0, 0.0, 1.0] };
    /// let (early, late) = ([pose(0.0, 0.0), pose(1.0, 0.0)], [pose(1.0, 1.0), pose(2.0, 1.0)]);
    /// let actors = [&early, &late].map(|poses| Actor { subject: 0, scale: 1.0, poses });
    /// let film = Film::of_crowd(&[sheet], &actors, &PictureOptions::default(), 25.0)?;
    /// assert_eq!(film.frames(), 51);
    /// # Ok::<(), langevin_rigid_pictures::PictureError>(())
    /// ```
    ///
    /// # Errors
    ///
    /// As [`super::crowd_picture`], and [`PictureError::FrameRate`].
    pub fn of_crowd(
        subjects: &[Subject<'_>],
        actors: &[Actor<'a>],
        options: &PictureOptions,
        fps: f64,
    ) -> Result<Self, PictureError> {
        Self::of(Cast::new(subjects, actors)?, options, fps)
    }

    fn of(cast: Cast<'a>, options: &PictureOptions, fps: f64) -> Result<Self, PictureError> {
        let layout = Layout::new(&cast, options)?;
        let backdrop = Backdrop::new(&options.stage, &layout)?;
        let duration = cast.end() - cast.start();
        let after_first = duration * fps * (1.0 + 1e-9);
        let fits = fps > 0.0 && after_first < Self::MOST_FRAMES as f64;
        if !fits {
            return Err(PictureError::FrameRate { fps, duration });
        }
        Ok(Self {
            cast,
            layout,
            backdrop,
            title: options.title.clone(),
            path: options.path,
            fps,
            frames: after_first as usize + 1,
        })
    }

    /// How many frames there are, one or more.
    pub fn frames(&self) -> usize {
        self.frames
    }

    /// The frame of a number from zero; those beyond the last show the end.
    ///
    /// # Errors
    ///
    /// [`PictureError::Size`] and [`PictureError::Font`], if at all at the first frame.
    pub fn frame(&self, number: usize) -> Result<Picture, PictureError> {
        let time = (self.cast.start() + number as f64 / self.fps).min(self.cast.end());
        let layout = &self.layout;
        let mut canvas = Canvas::new(layout.size)?;
        let ticks = axes::Ticks::new(layout);
        let moment = Moment {
            time,
            paths: self.path,
            interval: None,
        };
        let one = Instants {
            times: vec![time],
            interval: 0.0,
        };
        let trail = match self.path {
            true => Trail::Until(time),
            false => Trail::None,
        };
        let (solid, track) = self.cast.first();
        let motion = Motion {
            solid,
            track,
            instants: &one,
            trail,
        };
        for panel in &layout.panels {
            axes::draw(&mut canvas, layout, panel, &ticks);
            backdrop::draw(&mut canvas, layout, panel);
            if self.cast.crowd {
                crowd::draw(
                    &mut canvas,
                    layout,
                    panel,
                    &self.cast,
                    moment,
                    &self.backdrop,
                );
            } else {
                scene::draw(&mut canvas, layout, panel, &motion, &self.backdrop);
            }
        }
        // All digits in every frame, so that the words stand still.
        let words = match self.cast.crowd {
            false => format!("{} s, {}", fixed(time, 3), legend::size(layout)),
            true => crowd::caption(layout, &self.cast, moment),
        };
        legend::draw_header(&mut canvas, layout, self.title.as_deref(), &words);
        legend::draw_legend(&mut canvas, layout, &self.cast, self.path);
        Ok(Picture {
            size: layout.size,
            rgba: canvas.into_rgba(),
            times: one.times,
            magnification: layout.magnification,
        })
    }
}
