//! Pictures of Langevin Rigid: strobe pictures of a body along its path, films of it, and maps of categories over two
//! axes.
//!
//! For whoever wants to see a run without a renderer: in a report, in a test, on a server. It draws on the CPU, without
//! display, graphics card or installed fonts. It knows no science: it is given poses, triangles, numbers and words. Nor
//! is it a charting library.
//!
//! ```
//! use langevin_rigid::{Body, Fluid, NoiseStream, Settings, State, Stepper};
//! use langevin_rigid_pictures::{Film, PictureOptions, Pose, Subject, trajectory_picture};
//!
//! let card = Body::plate(0.085, 0.055, 0.3e-3, 900.0)?;
//! let stepper = Stepper::new(&card, &Fluid::AIR, None, &Settings::default())?;
//! let noise = NoiseStream { seed: 1, body: 0 };
//! let mut state = State::default();
//! let mut poses = Vec::new();
//! for _ in 0..60 {
//!     let State { time, position, orientation, .. } = state;
//!     poses.push(Pose { time, position, orientation });
//!     stepper.step(&mut state, 1.0 / 60.0, &noise.into())?;
//! }
//!
//! let subject = Subject {
//!     vertices: &card.surface.vertices,
//!     triangles: &card.surface.triangles,
//! };
//! let options = PictureOptions { title: Some("A business card".into()), ..PictureOptions::default() };
//! let picture = trajectory_picture(&subject, &poses, &options)?;
//! let file: Vec<u8> = picture.png()?;
//! assert!(file.starts_with(b"\x89PNG"));
//!
//! let film = Film::new(&subject, &poses, &options, 30.0)?;
//! assert_eq!(film.frames(), 30);
//! assert_eq!(film.frame(0)?.width(), picture.width());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # What it draws
//!
//! - [`trajectory_picture`]: the body at equal times, the path between, ground and scale; [`picture_in_flow`] adds arrows of the
//!   fluid. The interval between bodies is
//!   the shortest round one at which they stay apart. The two sides of the body differ in colour, so that a flip shows;
//!   the path darkens with time. A body that would be too small beside its path is magnified, and the caption says how
//!   much.
//! - [`crowd_picture`]: many bodies at their end, with the paths of some.
//! - [`Film`]: the same motions as frames from a fixed camera.
//! - [`kinds`]: categories as marks over coloured regions, on two logarithmic axes.
//!
//! [`Subject`] is the body, a [`Pose`] says where it is, an [`Actor`] is one body of many. The [`Stage`] is what they fall
//! onto and into, [`PictureOptions`] and [`View`] say how they are seen, and a [`Picture`] comes out.
//!
//! # Conventions
//!
//! - Metres, seconds, quaternions x, y, z, w; the world is right-handed with +Y up. Vertices are in the body frame.
//! - All views are orthographic; all panels of a picture have the same scale.
//! - Pixels are sRGB, opaque, row by row from the top.
//! - The same input gives the same bytes on every machine.
//! - What cannot be drawn is a [`PictureError`] that names the first pose, vertex or triangle at fault.
//!
//! There are no features to choose. The font is Inter, which is part of the crate under the SIL Open Font License.

mod arrows;
mod axes;
mod backdrop;
mod camera;
mod canvas;
mod cast;
mod crowd;
mod film;
mod font;
mod hull;
pub mod kinds;
mod labels;
mod layout;
mod legend;
mod numbers;
mod palette;
mod placement;
mod raster;
mod scene;
mod shadows;
#[cfg(test)]
mod shapes;
mod slope;
mod solid;
mod stage;
mod strobe;
mod vector;

use arrows::Arrows;
use backdrop::Backdrop;
use canvas::Canvas;
use cast::Cast;
use crowd::Moment;
pub use film::Film;
use hull::Hull;
use langevin_rigid_formats::track::{Track, TrackError};
use layout::Layout;
use placement::Placement;
use scene::{Motion, Trail};
use solid::Solid;
pub use stage::{Plane, Scenery, Stage};

pub use langevin_rigid_formats::track::Pose;

/// The body to draw.
#[derive(Clone, Copy, Debug)]
pub struct Subject<'a> {
    /// Vertices in the body frame, m.
    pub vertices: &'a [[f64; 3]],
    /// Vertex indices of each triangle, counterclockwise seen from outside. Open sheets and loose
    /// triangles are drawn as well.
    pub triangles: &'a [[u32; 3]],
}

/// One of many bodies to draw.
#[derive(Clone, Copy, Debug)]
pub struct Actor<'a> {
    /// Number of its [`Subject`] among those that are given with it.
    pub subject: usize,
    /// Its size as a multiple of the subject's.
    pub scale: f64,
    /// Where it is, from when it appears on; after the last it stays.
    pub poses: &'a [Pose],
}

/// Where the picture is seen from. All views are orthographic.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum View {
    /// From +z: x to the right, y up.
    Front,
    /// From -x: z to the right, y up.
    Side,
    /// From +y: x to the right, z down.
    Top,
    /// From above, between +x and +z.
    Iso,
    /// [`View::Front`] and [`View::Side`] next to each other on one scale.
    #[default]
    FrontAndSide,
}

/// What to draw besides the body and its path.
#[derive(Clone, Debug, PartialEq)]
pub struct PictureOptions {
    /// Width and height, pixels, each from 240 to 8192; `None` chooses a size that suits the
    /// shape of the path (1000 x 640 to 1500 x 1640).
    pub size: Option<[u32; 2]>,
    /// Where the picture is seen from.
    pub view: View,
    /// Heading, one line.
    pub title: Option<String>,
    /// What stands around the bodies.
    pub stage: Stage,
    /// Most instants at which the body is drawn; fewer are where bodies would cover each other.
    /// Zero draws the path alone.
    pub max_instants: usize,
    /// Time between two instants, s; `None` chooses the shortest at which bodies stay apart.
    /// With a time given, bodies are drawn at all its multiples, up to 256 of them.
    pub interval: Option<f64>,
    /// Whether the path is drawn.
    pub path: bool,
}

impl Default for PictureOptions {
    /// Front and side view, size chosen, no title, an empty stage, the path and at most 32 instants.
    fn default() -> Self {
        Self {
            size: None,
            view: View::default(),
            title: None,
            stage: Stage::default(),
            max_instants: 32,
            interval: None,
            path: true,
        }
    }
}

/// Why there is no picture.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum PictureError {
    /// The poses are no track.
    #[error(transparent)]
    Track(#[from] TrackError),
    /// The body has no surface.
    #[error("the body has no triangles: give the mesh that was simulated")]
    NoTriangles,
    /// A vertex is not a finite point.
    #[error("vertex {index} of the body is not a finite point within 1e12 m: check the mesh")]
    BadVertex {
        /// Its place among the vertices, from zero.
        index: usize,
    },
    /// A triangle names a vertex that does not exist.
    #[error("triangle {index} of the body names a vertex beyond its {vertices}: check the mesh")]
    BadTriangle {
        /// Its place among the triangles, from zero.
        index: usize,
        /// How many vertices there are.
        vertices: usize,
    },
    /// A body of a crowd names a subject that does not exist, or has no size.
    #[error("body {index} names no subject that is there, or its scale is not positive")]
    BadActor {
        /// Its place among the bodies, from zero.
        index: usize,
    },
    /// A solid of the stage cannot be drawn.
    #[error("solid {index} of the stage, taken as a body: {fault}")]
    BadScenery {
        /// Its place among the solids, from zero.
        index: usize,
        /// What is wrong with it.
        fault: Box<PictureError>,
    },
    /// The picture is too small to hold anything, or too large.
    #[error("a picture of {width} x {height} pixels cannot be drawn: ask for 240 to 8192 each way")]
    Size {
        /// Width asked for, pixels.
        width: u32,
        /// Height asked for, pixels.
        height: u32,
    },
    /// The film cannot be divided into frames.
    #[error(
        "{fps} frames a second of {duration} s make no film: ask for a positive rate and at most \
         {} frames",
        Film::MOST_FRAMES
    )]
    FrameRate {
        /// Frames a second asked for.
        fps: f64,
        /// Duration of the motion, s.
        duration: f64,
    },
    /// The font that is part of this library cannot be read.
    #[error("the built-in font cannot be read: this build is damaged, build it again")]
    Font,
    /// The picture cannot be put in the PNG format.
    #[error("the picture cannot be encoded as PNG: {reason}")]
    Encoding {
        /// What the encoder said.
        reason: String,
    },
}

/// A finished picture, opaque.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    size: [u32; 2],
    rgba: Vec<u8>,
    times: Vec<f64>,
    magnification: f64,
}

impl Picture {
    /// Width, pixels.
    pub fn width(&self) -> u32 {
        self.size[0]
    }

    /// Height, pixels.
    pub fn height(&self) -> u32 {
        self.size[1]
    }

    /// Red, green, blue and opacity (always 255) of each pixel in sRGB, row by row from the top.
    pub fn rgba(&self) -> &[u8] {
        &self.rgba
    }

    /// The times at which the body is drawn, s.
    pub fn times(&self) -> &[f64] {
        &self.times
    }

    /// How many times larger the body is drawn than the path's scale makes it, 1 or more.
    pub fn magnification(&self) -> f64 {
        self.magnification
    }

    /// The picture as the bytes of a PNG file.
    ///
    /// # Errors
    ///
    /// [`PictureError::Encoding`] when memory runs out.
    pub fn png(&self) -> Result<Vec<u8>, PictureError> {
        let opaque: Vec<u8> = self
            .rgba
            .chunks_exact(4)
            .flat_map(|p| [p[0], p[1], p[2]])
            .collect();
        self.encode(&opaque).map_err(|e| PictureError::Encoding {
            reason: e.to_string(),
        })
    }

    fn encode(&self, rgb: &[u8]) -> Result<Vec<u8>, png::EncodingError> {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, self.size[0], self.size[1]);
        encoder.set_color(png::ColorType::Rgb);
        encoder.set_depth(png::BitDepth::Eight);
        encoder.set_compression(png::Compression::Balanced);
        let mut writer = encoder.write_header()?;
        writer.write_image_data(rgb)?;
        writer.finish()?;
        Ok(bytes)
    }
}

/// Draws the body at equal times along its path.
///
/// The time between drawn bodies is a round number, the shortest at which they mostly do not cover
/// each other; between poses the motion is interpolated.
///
/// # Errors
///
/// [`PictureError`] names the first pose, vertex or triangle that cannot be drawn, an empty
/// trajectory or mesh, and a size out of range.
///
/// # Example
///
/// ```
/// use langevin_rigid_pictures::{PictureOptions, Pose, Subject, trajectory_picture};
///
/// let sheet = Subject {
///     vertices: &[[-0.1, 0.0, -0.1], [0.1, 0.0, -0.1], [0.1, 0.0, 0.1], [-0.1, 0.0, 0.1]],
///     triangles: &[[0, 2, 1], [0, 3, 2]],
/// };
/// let poses: Vec<Pose> = (0..=100)
///     .map(|k| 0.01 * f64::from(k))
///     .map(|time| Pose {
///         time,
///         position: [0.0, -4.905 * time * time, 0.0],
///         orientation: [0.0, 0.0, 0.0, 1.0],
///     })
///     .collect();
/// let options = PictureOptions {
///     title: Some("A sheet in free fall".to_owned()),
///     ..PictureOptions::default()
/// };
/// let picture = trajectory_picture(&sheet, &poses, &options)?;
/// assert!(picture.times().len() > 2);
/// assert!(picture.png()?.starts_with(b"\x89PNG"));
/// # Ok::<(), langevin_rigid_pictures::PictureError>(())
/// ```
pub fn trajectory_picture(
    subject: &Subject<'_>,
    poses: &[Pose],
    options: &PictureOptions,
) -> Result<Picture, PictureError> {
    picture(subject, poses, options, None)
}

/// The same with arrows of what the fluid does behind it, `velocity` (m/s) of a place (m), world frame: on the plane of each
/// view through the middle of the motion. There are none in [`View::Iso`].
///
/// ```
/// use langevin_rigid_pictures::{PictureOptions, Pose, Subject, picture_in_flow};
/// let sheet = Subject {
///     vertices: &[[-0.1, 0.0, -0.1], [0.1, 0.0, -0.1], [0.1, 0.0, 0.1], [-0.1, 0.0, 0.1]],
///     triangles: &[[0, 2, 1], [0, 3, 2]],
/// };
/// let drift = |time: f64| Pose { time, position: [time, -time, 0.0], orientation: [0.0, 0.0, 0.0, 1.0] };
/// let poses: Vec<Pose> = (0..=50).map(|k| drift(0.02 * f64::from(k))).collect();
/// let shear = |[_, y, _]: [f64; 3]| [1.0 + 0.5 * y, 0.0, 0.0];
/// let picture = picture_in_flow(&sheet, &poses, &PictureOptions::default(), &shear)?;
/// assert!(picture.width() > 0);
/// # Ok::<(), langevin_rigid_pictures::PictureError>(())
/// ```
///
/// # Errors
///
/// As [`trajectory_picture`].
pub fn picture_in_flow(
    subject: &Subject<'_>,
    poses: &[Pose],
    options: &PictureOptions,
    velocity: Flow<'_>,
) -> Result<Picture, PictureError> {
    picture(subject, poses, options, Some(velocity))
}

/// A velocity (m/s) at each place (m), world frame.
pub type Flow<'a> = &'a dyn Fn([f64; 3]) -> [f64; 3];

/// Draws many bodies as they are at the end of all motion, with the paths of some, which are drawn on their way too (at the
/// options' interval, if they have one); `flow` as [`picture_in_flow`] has it.
///
/// # Errors
///
/// As [`trajectory_picture`], and [`PictureError::BadActor`].
///
/// # Example
///
/// ```
/// use langevin_rigid_pictures::{Actor, PictureOptions, Pose, Stage, Subject, crowd_picture};
///
/// let sheet = Subject {
///     vertices: &[[-0.1, 0.0, -0.1], [0.1, 0.0, -0.1], [0.1, 0.0, 0.1], [-0.1, 0.0, 0.1]],
///     triangles: &[[0, 2, 1], [0, 3, 2]],
/// };
/// let fall = |x: f64| [0.0, 1.0].map(|time| Pose {
///     time,
///     position: [x, 1.0 - time, 0.0],
///     orientation: [0.0, 0.0, 0.0, 1.0],
/// });
/// let (left, right) = (fall(-0.5), fall(0.5));
/// let small = Actor { subject: 0, scale: 0.5, poses: &left };
/// let large = Actor { subject: 0, scale: 1.0, poses: &right };
/// let stage = Stage { ground: Some(0.0), ..Stage::default() };
/// let options = PictureOptions { stage, ..PictureOptions::default() };
/// let picture = crowd_picture(&[sheet], &[small, large], &options, None)?;
/// assert_eq!(picture.times(), [1.0]);
/// # Ok::<(), langevin_rigid_pictures::PictureError>(())
/// ```
pub fn crowd_picture(
    subjects: &[Subject<'_>],
    actors: &[Actor<'_>],
    options: &PictureOptions,
    flow: Option<Flow<'_>>,
) -> Result<Picture, PictureError> {
    let cast = Cast::new(subjects, actors)?;
    let layout = Layout::new(&cast, options)?;
    let backdrop = Backdrop::new(&options.stage, &layout)?;
    let moment = Moment::end(&cast, &layout, options);
    let mut canvas = Canvas::new(layout.size)?;
    let arrows = flow.map(|flow| Arrows::new(&layout, &options.stage, flow));
    for (number, panel) in layout.panels.iter().enumerate() {
        set(&mut canvas, &layout, number, arrows.as_ref());
        crowd::draw(&mut canvas, &layout, panel, &cast, moment, &backdrop);
    }
    let words = told(crowd::caption(&layout, &cast, moment), arrows.as_ref());
    legend::draw_header(&mut canvas, &layout, options.title.as_deref(), &words);
    legend::draw_legend(&mut canvas, &layout, &cast, options.path);
    Ok(Picture {
        size: layout.size,
        rgba: canvas.into_rgba(),
        times: vec![moment.time],
        magnification: layout.magnification,
    })
}

fn picture(
    subject: &Subject<'_>,
    poses: &[Pose],
    options: &PictureOptions,
    flow: Option<Flow<'_>>,
) -> Result<Picture, PictureError> {
    let cast = Cast::alone(subject, poses)?;
    let (solid, track) = cast.first();
    let layout = Layout::new(&cast, options)?;
    let backdrop = Backdrop::new(&options.stage, &layout)?;
    let instants = match options.interval {
        Some(interval) => strobe::every(track, interval),
        None => strobe::instants(track, options.max_instants, |times| {
            crowded(&layout, solid, track, times)
        }),
    };
    let mut canvas = Canvas::new(layout.size)?;
    let trail = if options.path {
        Trail::Whole
    } else {
        Trail::None
    };
    let motion = Motion {
        solid,
        track,
        instants: &instants,
        trail,
    };
    let arrows = flow.map(|flow| Arrows::new(&layout, &options.stage, flow));
    for (number, panel) in layout.panels.iter().enumerate() {
        set(&mut canvas, &layout, number, arrows.as_ref());
        scene::draw(&mut canvas, &layout, panel, &motion, &backdrop);
    }
    let words = told(legend::caption(&layout, &instants), arrows.as_ref());
    legend::draw_header(&mut canvas, &layout, options.title.as_deref(), &words);
    legend::draw_legend(&mut canvas, &layout, &cast, options.path);
    Ok(Picture {
        size: layout.size,
        rgba: canvas.into_rgba(),
        times: instants.times,
        magnification: layout.magnification,
    })
}

/// Sets the stage of a panel, but for solids.
fn set(canvas: &mut Canvas, layout: &Layout, number: usize, arrows: Option<&Arrows>) {
    let panel = &layout.panels[number];
    axes::draw(canvas, layout, panel, &axes::Ticks::new(layout));
    if let Some(arrows) = arrows {
        arrows.draw(canvas, layout, number);
    }
    backdrop::draw(canvas, layout, panel);
}

/// What is drawn, and what the arrows are.
fn told(bodies: String, arrows: Option<&Arrows>) -> String {
    match arrows.and_then(Arrows::caption) {
        Some(arrows) => format!("{bodies}; {arrows}"),
        None => bodies,
    }
}

/// Bodies in line with one view may be well apart in the other, so the clearest panel decides.
fn crowded(layout: &Layout, solid: &Solid, track: &Track<'_>, times: &[f64]) -> bool {
    layout.panels.iter().all(|panel| {
        let hull = |t: &f64| {
            layout
                .view(panel, solid, &Placement::of(track.at(*t)))
                .hull()
        };
        let apart = 3.0 * layout.unit;
        let hulls: Vec<Hull> = times.iter().map(|t| hull(t).grown(apart)).collect();
        strobe::crowded(&hulls)
    })
}
