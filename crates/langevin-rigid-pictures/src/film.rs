//! A film of the motion: one body in each frame, its path behind it, the camera fixed.

use crate::canvas::Canvas;
use crate::layout::Layout;
use crate::numbers::fixed;
use crate::scene::{self, Trail};
use crate::solid::Solid;
use crate::strobe::Instants;
use crate::{Picture, PictureError, PictureOptions, Pose, Subject, axes, legend};
use langevin_rigid_formats::track::Track;

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
    solid: Solid,
    track: Track<'a>,
    layout: Layout,
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
        let track = Track::new(poses)?;
        let solid = Solid::new(subject)?;
        let layout = Layout::new(&solid, &track, options)?;
        let duration = track.end() - track.start();
        let after_first = duration * fps * (1.0 + 1e-9);
        let fits = fps > 0.0 && after_first < Self::MOST_FRAMES as f64;
        if !fits {
            return Err(PictureError::FrameRate { fps, duration });
        }
        Ok(Self {
            solid,
            track,
            layout,
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
        let Self { layout, track, .. } = self;
        let time = (track.start() + number as f64 / self.fps).min(track.end());
        let instants = Instants {
            times: vec![time],
            interval: 0.0,
        };
        let trail = if self.path {
            Trail::Until(time)
        } else {
            Trail::None
        };
        let mut canvas = Canvas::new(layout.size)?;
        let ticks = axes::Ticks::new(layout);
        for panel in &layout.panels {
            axes::draw(&mut canvas, layout, panel, &ticks);
            scene::draw(
                &mut canvas,
                layout,
                panel,
                &self.solid,
                track,
                &instants,
                trail,
            );
        }
        // All digits in every frame, so that the words stand still.
        let words = format!("{} s, {}", fixed(time, 3), legend::size(layout));
        legend::draw_header(&mut canvas, layout, self.title.as_deref(), &words);
        legend::draw_legend(&mut canvas, layout, &self.solid, track, self.path);
        Ok(Picture {
            size: layout.size,
            rgba: canvas.into_rgba(),
            times: instants.times,
            magnification: layout.magnification,
        })
    }
}
