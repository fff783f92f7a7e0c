//! Where everything goes: the size of the page, its panels, one scale for all of them, and how
//! much larger than life the body is drawn.

use crate::camera::{Camera, Direction};
use crate::canvas::{Area, Point};
use crate::cast::{Cast, Player};
use crate::numbers::fine_above;
use crate::palette::BODY;
use crate::placement::Placement;
use crate::raster::View;
use crate::solid::Solid;
use crate::vector::{Vec3, mul_mat, scale, sub};
use crate::{PictureError, PictureOptions, Stage};

/// Lengths in units of the page, which is a pixel on a page of ordinary size.
const MARGIN: f64 = 36.0;
const GUTTER: f64 = 78.0;
const GAP: f64 = 26.0;
const PANEL_HEADER: f64 = 36.0;
const AXIS_ROWS: f64 = 62.0;
const TITLE_ROW: f64 = 50.0;
const CAPTION_ROW: f64 = 40.0;
const LEGEND_ROW: f64 = 46.0;
/// Width that the whole legend needs in one row.
const LEGEND_WIDTH: f64 = 925.0;
const PADDING: f64 = 16.0;
const LEAST_PANEL: f64 = 170.0;

/// Pages chosen by us are between these sizes, pixels.
const LEAST_PAGE: [f64; 2] = [1000.0, 640.0];
const LARGEST_PAGE: [f64; 2] = [1500.0, 1640.0];
/// Square root of the pixels of a page on which a unit is a pixel.
const ORDINARY_PAGE: f64 = 1200.0;
/// Pages asked for must be between these sizes, pixels.
const SMALLEST_SIZE: u32 = 240;
const LARGEST_SIZE: u32 = 8192;

/// A body that would be smaller than the first is drawn at least as large as the second, units.
const TOO_SMALL: f64 = 56.0;
const LARGE_ENOUGH: f64 = 72.0;
/// The same of the largest of many bodies, which would hide each other.
const TOO_SMALL_OF_MANY: f64 = 22.0;
const LARGE_ENOUGH_OF_MANY: f64 = 28.0;
/// Bodies that are drawn smaller than this have thinner outlines, units.
const FULL_OUTLINE: f64 = 48.0;

/// Parts of the size of the motion: how far away things are drawn, and how much of what is below a surface.
const NEAR: f64 = 0.3;
const BELOW_GROUND: f64 = 0.04;
const BELOW_WATER: f64 = 0.08;
/// Walls around so many times the motion are drawn.
const WIDEST_WALLS: f64 = 4.0;

/// The box around everything drawn, world frame.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bounds {
    pub low: Vec3,
    pub high: Vec3,
}

impl Bounds {
    fn of(points: impl Iterator<Item = Vec3>) -> Self {
        let empty = Self {
            low: [f64::INFINITY; 3],
            high: [f64::NEG_INFINITY; 3],
        };
        points.fold(empty, |b, p| Self {
            low: std::array::from_fn(|i| b.low[i].min(p[i])),
            high: std::array::from_fn(|i| b.high[i].max(p[i])),
        })
    }

    fn grown(self, by: f64) -> Self {
        Self {
            low: self.low.map(|c| c - by),
            high: self.high.map(|c| c + by),
        }
    }

    fn union(self, other: Self) -> Self {
        Self::of([self.low, self.high, other.low, other.high].into_iter())
    }

    fn size(&self) -> Vec3 {
        sub(self.high, self.low)
    }

    pub(super) fn longest(&self) -> f64 {
        self.size().into_iter().fold(0.0, f64::max)
    }

    /// What is in both, if anything is.
    fn common(self, other: Self) -> Option<Self> {
        let both = Self {
            low: std::array::from_fn(|i| self.low[i].max(other.low[i])),
            high: std::array::from_fn(|i| self.high[i].min(other.high[i])),
        };
        (0..3).all(|i| both.low[i] <= both.high[i]).then_some(both)
    }

    pub(super) fn corners(self) -> impl Iterator<Item = Vec3> {
        (0..8).map(move |i| {
            std::array::from_fn(|axis| {
                if i >> axis & 1 == 1 {
                    self.high[axis]
                } else {
                    self.low[axis]
                }
            })
        })
    }
}

/// One view of the motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Panel {
    pub camera: Camera,
    /// Where the motion is drawn, pixels.
    pub plot: Area,
    /// Right and up coordinates at the centre of the plot, metres.
    pub centre: Point,
    /// Pixels per metre.
    pub scale: f64,
}

impl Panel {
    /// x and y on the page and the height toward the viewer, pixels.
    pub(super) fn place(&self, world: Vec3) -> Vec3 {
        let [right, up, toward] = self.camera.project(world);
        let [x, y] = self.plot.centre();
        [
            x + self.scale * (right - self.centre[0]),
            y - self.scale * (up - self.centre[1]),
            self.scale * toward,
        ]
    }

    /// Right and up coordinates of the plot's edges, metres.
    pub(super) fn range(&self, axis: usize) -> [f64; 2] {
        let half = 0.5 * [self.plot.width(), self.plot.height()][axis] / self.scale;
        [self.centre[axis] - half, self.centre[axis] + half]
    }
}

/// Everything about the page that is settled before anything is drawn.
#[derive(Clone, Debug)]
pub(super) struct Layout {
    pub size: [u32; 2],
    /// Pixels per unit of length on the page.
    pub unit: f64,
    pub panels: Vec<Panel>,
    /// Pixels per metre.
    pub scale: f64,
    /// Drawn size of the body over its true size on the scale of the path.
    pub magnification: f64,
    /// The box around the path and the bodies as drawn.
    pub bounds: Bounds,
    /// Height of the ground, where it is near enough to be drawn, metres.
    pub ground: Option<f64>,
    /// Height of the water's surface, unless it is far below, metres.
    pub water: Option<f64>,
    /// The box between the walls, where they are near enough.
    pub walls: Option<Bounds>,
}

impl Layout {
    pub(super) fn new(cast: &Cast<'_>, options: &PictureOptions) -> Result<Self, PictureError> {
        check_size(options)?;
        let mut layout = Self::magnified(1.0, cast, options);
        // The body's drawn size and the scale that makes room for it settle in a step or two.
        for _ in 0..6 {
            let wanted = layout.wanted_magnification(cast);
            if wanted <= layout.magnification {
                break;
            }
            layout = Self::magnified(wanted, cast, options);
        }
        Ok(layout)
    }

    fn wanted_magnification(&self, cast: &Cast<'_>) -> f64 {
        let [too_small, enough] = match cast.crowd {
            false => [TOO_SMALL, LARGE_ENOUGH],
            true => [TOO_SMALL_OF_MANY, LARGE_ENOUGH_OF_MANY],
        };
        let drawn = 2.0 * cast.radius() * self.scale / self.unit;
        if drawn * self.magnification >= too_small || drawn <= 0.0 {
            self.magnification
        } else {
            fine_above(enough / drawn)
        }
    }

    /// The layout with bodies so many times their true size.
    fn magnified(magnification: f64, cast: &Cast<'_>, options: &PictureOptions) -> Self {
        let Surrounded {
            bounds,
            ground,
            water,
            walls,
        } = Surrounded::new(motion(magnification, cast), &options.stage);
        let cameras: Vec<Camera> = options
            .view
            .directions()
            .iter()
            .map(|d| Camera::new(*d))
            .collect();
        let extents: Vec<[Point; 2]> = cameras.iter().map(|c| extent(c, &bounds)).collect();
        let frame = Frame::new(options, &extents);
        let scale = frame.scale(&extents);
        let plots = frame.plots(scale, &extents);
        let panel = |((camera, extent), plot): ((Camera, &[Point; 2]), Area)| Panel {
            camera,
            plot,
            centre: centre(&camera, extent, &plot, scale, ground.is_some()),
            scale,
        };
        let panels = cameras
            .into_iter()
            .zip(&extents)
            .zip(plots)
            .map(panel)
            .collect();
        Self {
            size: frame.size,
            unit: frame.unit,
            panels,
            scale,
            magnification,
            bounds,
            ground,
            water,
            walls,
        }
    }

    /// The body at one placement, as a panel shows it.
    pub(super) fn view<'a>(&self, panel: &Panel, solid: &'a Solid, at: &Placement) -> View<'a> {
        let [x, y, _] = panel.place(at.to_world(solid.centre));
        View {
            solid,
            rotation: mul_mat(&panel.camera.rows, &at.rotation),
            centre: [x, y],
            magnified_scale: self.scale * self.magnification,
            outline: 1.5 * self.unit.max(0.7),
            border: 1.6 * self.unit,
            lift: 0.01 * solid.radius * (self.scale * self.magnification),
            paints: BODY,
        }
    }

    /// One of many bodies, of so many times its kind's size.
    pub(super) fn view_of_many<'a>(
        &self,
        panel: &Panel,
        solid: &'a Solid,
        size: f64,
        at: &Placement,
    ) -> View<'a> {
        let [x, y, _] = panel.place(at.to_world(scale(size, solid.centre)));
        let whole = self.view(panel, solid, at);
        let magnified_scale = size * whole.magnified_scale;
        let drawn = 2.0 * solid.radius * magnified_scale;
        let fine = (drawn / (FULL_OUTLINE * self.unit)).clamp(0.3, 1.0);
        View {
            centre: [x, y],
            magnified_scale,
            outline: fine * whole.outline,
            border: if fine < 1.0 { 0.0 } else { whole.border },
            lift: size * whole.lift,
            ..whole
        }
    }

    /// Top left corner of the caption's row.
    pub(super) fn caption(&self, title: bool) -> Point {
        let title = if title { TITLE_ROW } else { 0.0 };
        [MARGIN * self.unit, (MARGIN + title) * self.unit]
    }

    /// Where the legend goes.
    pub(super) fn legend(&self) -> Area {
        let [width, height] = self.size.map(f64::from);
        let margin = MARGIN * self.unit;
        let rows = legend_rows(width, self.unit);
        Area {
            low: [
                margin,
                height - 0.6 * margin - rows * LEGEND_ROW * self.unit,
            ],
            high: [width - margin, height - 0.6 * margin],
        }
    }

    pub(super) fn legend_row_height(&self) -> f64 {
        LEGEND_ROW * self.unit
    }

    pub(super) fn panel_header(&self) -> f64 {
        PANEL_HEADER * self.unit
    }
}

fn check_size(options: &PictureOptions) -> Result<(), PictureError> {
    match options.size {
        Some([width, height])
            if [width, height]
                .iter()
                .any(|s| !(SMALLEST_SIZE..=LARGEST_SIZE).contains(s)) =>
        {
            Err(PictureError::Size { width, height })
        }
        _ => Ok(()),
    }
}

/// The box around the paths and the bodies.
fn motion(magnification: f64, cast: &Cast<'_>) -> Bounds {
    let around = |player: &Player<'_>| {
        let (solid, track) = (cast.solid(player), &player.track);
        let path = Bounds::of(track.poses().iter().map(|p| p.position));
        let centre = scale(player.scale, solid.centre);
        let at = |p: &crate::Pose| Placement::of(track.at(p.time)).to_world(centre);
        let reach = magnification * player.scale * solid.radius;
        let bodies = Bounds::of(track.poses().iter().map(at)).grown(reach);
        path.union(bodies)
    };
    let all = cast.players().iter().map(around).reduce(Bounds::union);
    let bounds = all.unwrap_or(Bounds::of(std::iter::once([0.0; 3])));
    // Room for a path shorter than the digits of its position, or of no length at all.
    let digits = bounds
        .low
        .iter()
        .chain(&bounds.high)
        .fold(0.0, |m: f64, c| m.max(c.abs()));
    let least = (1e-9 * digits).max(1e-9);
    if bounds.longest() < least {
        bounds.grown(least)
    } else {
        bounds
    }
}

/// The motion, and what of the stage is near it.
struct Surrounded {
    /// Around the motion and what is drawn with it.
    bounds: Bounds,
    ground: Option<f64>,
    water: Option<f64>,
    walls: Option<Bounds>,
}

impl Surrounded {
    fn new(motion: Bounds, stage: &Stage) -> Self {
        let mut bounds = motion;
        let widest = WIDEST_WALLS * motion.longest();
        let walls = stage.walls.map(|[low, high]| Bounds { low, high });
        let walls = walls.filter(|walls| walls.longest() <= widest);
        if let Some(walls) = walls {
            bounds = bounds.union(walls);
        }
        let about = motion.grown(NEAR * motion.longest());
        for solid in &stage.solids {
            let solid = Bounds::of(solid.vertices.iter().copied());
            if let Some(near) = solid.common(about) {
                bounds = bounds.union(near);
            }
        }
        let size = bounds.longest();
        let [low, high] = [bounds.low[1], bounds.high[1]];
        let ground = stage
            .ground
            .filter(|height| (low - NEAR * size..=high).contains(height));
        let water = stage.water.filter(|level| *level >= low - NEAR * size);
        let below = [(ground, BELOW_GROUND), (water, BELOW_WATER)];
        for (height, part) in below {
            if let Some(height) = height {
                bounds.low[1] = bounds.low[1].min(height - part * size);
            }
        }
        if let Some(level) = water.filter(|level| *level <= high + NEAR * size) {
            bounds.high[1] = bounds.high[1].max(level + BELOW_GROUND * size);
        }
        // There is no water under the ground.
        if let (Some(ground), Some(_)) = (ground, water) {
            bounds.low[1] = low.min(ground - BELOW_GROUND * size);
        }
        Self {
            bounds,
            ground,
            water,
            walls,
        }
    }
}

/// Lowest and highest right and up coordinates of the box.
fn extent(camera: &Camera, bounds: &Bounds) -> [Point; 2] {
    let seen = Bounds::of(bounds.corners().map(|c| camera.project(c)));
    [[seen.low[0], seen.low[1]], [seen.high[0], seen.high[1]]]
}

/// Right and up coordinates in the middle of a plot: the middle of what is drawn, but no more
/// ground than it takes.
fn centre(
    camera: &Camera,
    [low, high]: &[Point; 2],
    plot: &Area,
    scale: f64,
    ground: bool,
) -> Point {
    let middle = std::array::from_fn(|i| 0.5 * (low[i] + high[i]));
    match camera.axes() {
        Some([_, upward]) if ground && upward.name == "y" => {
            [middle[0], low[1] + 0.5 * plot.height() / scale]
        }
        _ => middle,
    }
}

fn legend_rows(width: f64, unit: f64) -> f64 {
    (LEGEND_WIDTH / (width / unit - 2.0 * MARGIN)).ceil()
}

/// The page before its panels are placed.
struct Frame {
    size: [u32; 2],
    unit: f64,
    /// What the panels' plots share: total width, and height.
    room: Point,
    top: f64,
}

impl Frame {
    fn new(options: &PictureOptions, extents: &[[Point; 2]]) -> Self {
        let title = if options.title.is_some() {
            TITLE_ROW
        } else {
            0.0
        };
        let top = MARGIN + title + CAPTION_ROW + PANEL_HEADER;
        let taken = |width: f64| {
            let panels = extents.len() as f64;
            [
                2.0 * MARGIN + panels * GUTTER + (panels - 1.0) * GAP,
                top + AXIS_ROWS + legend_rows(width, 1.0) * LEGEND_ROW + 0.6 * MARGIN,
            ]
        };
        let size = options
            .size
            .unwrap_or_else(|| page_for(extents, taken(LARGEST_PAGE[0])));
        let [width, height] = size.map(f64::from);
        let unit = if options.size.is_some() {
            let [least_width, least_height] = LEAST_PAGE;
            let ordinary = (width * height).sqrt() / ORDINARY_PAGE;
            ordinary.min(width / least_width).min(height / least_height)
        } else {
            1.0
        };
        let taken = taken(width / unit);
        Self {
            size,
            unit,
            room: [width - unit * taken[0], height - unit * taken[1]],
            top: unit * top,
        }
    }

    fn plot_width(&self, scale: f64, [low, high]: &[Point; 2]) -> f64 {
        (scale * (high[0] - low[0]) + 2.0 * PADDING * self.unit).max(LEAST_PANEL * self.unit)
    }

    /// The largest scale at which everything fits.
    fn scale(&self, extents: &[[Point; 2]]) -> f64 {
        let tallest = extents
            .iter()
            .fold(0.0, |m: f64, [l, h]| m.max(h[1] - l[1]));
        let tall = (self.room[1] - 2.0 * PADDING * self.unit) / tallest;
        let fits = |s: f64| {
            let widths = extents.iter().map(|e| self.plot_width(s, e));
            widths.sum::<f64>() <= self.room[0]
        };
        if fits(tall) {
            return tall;
        }
        let (mut low, mut high) = (0.0, tall);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            *(if fits(middle) { &mut low } else { &mut high }) = middle;
        }
        low
    }

    /// The plots side by side, sharing the width that is left.
    fn plots(&self, scale: f64, extents: &[[Point; 2]]) -> Vec<Area> {
        let widths: Vec<f64> = extents.iter().map(|e| self.plot_width(scale, e)).collect();
        let spare = (self.room[0] - widths.iter().sum::<f64>()) / widths.len() as f64;
        let mut left = MARGIN * self.unit;
        let mut plots = Vec::new();
        for width in widths {
            left += GUTTER * self.unit;
            let right = left + width + spare;
            plots.push(Area {
                low: [left, self.top],
                high: [right, self.top + self.room[1]],
            });
            left = right + GAP * self.unit;
        }
        plots
    }
}

/// The page that suits the shape of what is drawn.
fn page_for(extents: &[[Point; 2]], taken: Point) -> [u32; 2] {
    let padding = 2.0 * PADDING;
    let wide: f64 = extents.iter().map(|[l, h]| h[0] - l[0]).sum();
    let tall = extents
        .iter()
        .fold(0.0, |m: f64, [l, h]| m.max(h[1] - l[1]));
    let fixed = [
        taken[0] + padding * extents.len() as f64,
        taken[1] + padding,
    ];
    let scale = ((LARGEST_PAGE[0] - fixed[0]) / wide).min((LARGEST_PAGE[1] - fixed[1]) / tall);
    let length = |i: usize, content: f64| {
        let length = fixed[i] + scale * content;
        length.clamp(LEAST_PAGE[i], LARGEST_PAGE[i]) as u32 / 2 * 2
    };
    [length(0, wide), length(1, tall)]
}

impl crate::View {
    fn directions(self) -> &'static [Direction] {
        match self {
            crate::View::Front => &[Direction::Front],
            crate::View::Side => &[Direction::Side],
            crate::View::Top => &[Direction::Top],
            crate::View::Iso => &[Direction::Iso],
            crate::View::FrontAndSide => &[Direction::Front, Direction::Side],
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shapes::plate;
    use crate::{PictureOptions, Pose, Subject, View};
    use langevin_rigid_formats::track::Track;

    const VIEWS: [View; 5] = [
        View::Front,
        View::Side,
        View::Top,
        View::Iso,
        View::FrontAndSide,
    ];

    /// A body of length `length` that tumbles along a slanted wave of extent `path`.
    fn tumbling(path: Vec3, count: u32) -> Vec<Pose> {
        let pose = |k: u32| {
            let time = f64::from(k) / 50.0;
            let w = [libm::sin(9.0 * time), -time, libm::cos(7.0 * time)];
            Pose {
                time,
                position: std::array::from_fn(|i| 3.0 + path[i] * w[i]),
                orientation: [
                    libm::sin(2.0 * time),
                    0.3,
                    libm::sin(5.0 * time),
                    libm::cos(2.0 * time),
                ],
            }
        };
        (0..count).map(pose).collect()
    }

    fn layouts(path: Vec3, count: u32, check: impl Fn(&Layout, &Solid, &Track<'_>)) {
        let (mut vertices, triangles) = plate([0.1, 0.002, 0.05]);
        // The reference point need not be in the middle of the mesh.
        vertices.iter_mut().for_each(|v| v[0] += 0.02);
        let subject = Subject {
            vertices: &vertices,
            triangles: &triangles,
        };
        let poses = tumbling(path, count);
        let cast = Cast::alone(&subject, &poses).unwrap();
        let (solid, track) = cast.first();
        for view in VIEWS {
            for size in [None, Some([240, 240]), Some([4000, 300]), Some([300, 4000])] {
                let options = PictureOptions {
                    size,
                    view,
                    stage: Stage {
                        ground: Some(2.9),
                        ..Stage::default()
                    },
                    ..PictureOptions::default()
                };
                check(&Layout::new(&cast, &options).unwrap(), solid, track);
            }
        }
    }

    #[test]
    fn no_body_and_no_point_of_the_path_is_cut_off() {
        // A fall, a glide, a speck of a body, a body larger than its path, and one pose.
        for (path, count) in [
            ([0.1, 4.0, 0.1], 101),
            ([8.0, 0.4, 0.0], 101),
            ([500.0, 900.0, 20.0], 101),
            ([1e-4, 1e-4, 0.0], 101),
            ([1.0, 1.0, 1.0], 1),
        ] {
            layouts(path, count, |layout, solid, track| {
                let page = Area {
                    low: [0.0; 2],
                    high: layout.size.map(f64::from),
                };
                for panel in &layout.panels {
                    assert!(page.covers(&panel.plot), "{path:?} {:?}", panel.plot);
                    for pose in track.poses() {
                        let at = Placement::of(track.at(pose.time));
                        let body = layout.view(panel, solid, &at).hull().area();
                        assert!(
                            panel.plot.covers(&body),
                            "{path:?} {body:?} {:?}",
                            panel.plot
                        );
                        let [x, y, _] = panel.place(pose.position);
                        assert!(panel.plot.contains([x, y]));
                    }
                }
            });
        }
    }

    #[test]
    fn a_speck_of_a_body_is_magnified_until_it_can_be_seen() {
        layouts([50.0, 90.0, 20.0], 101, |layout, solid, _| {
            let drawn = 2.0 * solid.radius * layout.magnification * layout.scale;
            assert!(layout.magnification > 10.0);
            assert!(drawn >= TOO_SMALL * layout.unit, "{drawn} px");
        });
        layouts([0.05, 0.1, 0.1], 101, |layout, _, _| {
            // Even on the smallest page the body is a good part of the whole.
            assert_eq!(layout.magnification, 1.0, "{:?}", layout.size);
        });
    }
}
