//! The map of kinds: categories as marks over coloured regions, on two logarithmic axes.
//!
//! What it shows is given as numbers and words; [`kind_map`] draws it.

use std::f64::consts::PI;

use crate::canvas::{Align, Area, Canvas, Point as Place, TextStyle};
use crate::font::Weight;
use crate::numbers::short;
use crate::palette::{FAINT_TEXT, FRAME, OUTLINE, PAGE, TEXT, mix};
use crate::{Picture, PictureError};

/// A map of kinds: two panels side by side over a legend.
#[derive(Debug, Clone, PartialEq)]
pub struct KindMap<'a> {
    /// Heading, one line.
    pub title: &'a str,
    /// What to know of it, one line.
    pub caption: &'a str,
    /// Left and right.
    pub panels: [Panel<'a>; 2],
    /// The meaning of the marks.
    pub legend: Legend<'a>,
}

/// One kind, as it looks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Kind<'a> {
    /// Its name in the legend.
    pub name: &'a str,
    /// Red, green, blue in sRGB.
    pub colour: [u8; 3],
    /// Corners of the regular polygon that marks it; shapes tell in grey what colours tell.
    pub corners: u32,
    /// The polygon's turn from one corner up, clockwise (rad).
    pub turn: f64,
}

/// A panel of the map. Places are values on its two axes, to the right and upwards.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel<'a> {
    /// Heading, one line.
    pub heading: String,
    /// The axis to the right and the one upwards.
    pub axes: [Axis<'a>; 2],
    /// Coloured areas, the later over the earlier.
    pub regions: Vec<Region<'a>>,
    /// Areas, least and largest value on each axis, made pale where the regions are uncertain.
    pub uncertain: Vec<[[f64; 2]; 2]>,
    /// Lines between regions, from place to place.
    pub boundaries: Vec<[[f64; 2]; 2]>,
    /// Marks, column by column; they are drawn as small as the columns and their rows are close.
    pub marks: Vec<Mark<'a>>,
    /// Outlined marks over the others: where something is known.
    pub references: Vec<Reference<'a>>,
}

/// A logarithmic axis.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Axis<'a> {
    /// Its name.
    pub name: &'a str,
    /// Least and largest value of the plot, above zero. What lies beyond is drawn at the edge.
    pub range: [f64; 2],
}

/// An area of one kind.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Region<'a> {
    /// Its kind.
    pub kind: Kind<'a>,
    /// Least and largest value on each axis.
    pub area: [[f64; 2]; 2],
}

/// A mark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mark<'a> {
    /// Where it is.
    pub place: [f64; 2],
    /// Its kind.
    pub kind: Kind<'a>,
    /// Whether it is drawn hollow.
    pub hollow: bool,
    /// Whether a ring is around it.
    pub ringed: bool,
}

/// An outlined mark.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reference<'a> {
    /// Where it is.
    pub place: [f64; 2],
    /// Its kind.
    pub kind: Kind<'a>,
}

/// What the legend says.
#[derive(Debug, Clone, PartialEq)]
pub struct Legend<'a> {
    /// The kinds, in order.
    pub kinds: Vec<Kind<'a>>,
    /// The kind that hollow and outlined marks are shown of.
    pub sample: Kind<'a>,
    /// Meaning of a hollow mark.
    pub hollow: &'a str,
    /// Meaning of an outlined mark.
    pub reference: &'a str,
    /// Meaning of a ring.
    pub ringed: &'a str,
    /// Meaning of a boundary.
    pub boundary: &'a str,
}

/// The page and its parts, pixels.
const SIZE: [u32; 2] = [1400, 930];
const MARGIN: f64 = 40.0;
const PLOT_TOP: f64 = 150.0;
const PLOT: [f64; 2] = [560.0, 590.0];
const PLOT_LEFT: [f64; 2] = [110.0, 790.0];
const LEGEND: [f64; 2] = [832.0, 880.0];
/// Radius of a mark, at most, and of the ring around one that disagrees, in such radii.
const MARK: f64 = 10.0;
const RING: f64 = 1.7;
/// Radius of a mark over the distance of the next where they are dense: rings stay apart.
const DENSE: f64 = 0.29;
/// Strength of a region's colour behind the marks.
const TINT: f64 = 0.28;
/// Corners and turn of a polygon that looks round.
const CIRCLE: (u32, f64) = (40, 0.0);

/// A panel on the page.
struct Plot<'a> {
    panel: &'a Panel<'a>,
    /// Where it is, pixels.
    area: Area,
}

impl<'a> Plot<'a> {
    fn new(panel: &'a Panel<'a>, left: f64) -> Self {
        Self {
            panel,
            area: Area {
                low: [left, PLOT_TOP],
                high: [left + PLOT[0], PLOT_TOP + PLOT[1]],
            },
        }
    }

    /// Where a place is on the page, held to the plot.
    fn place(&self, [x, y]: [f64; 2]) -> Place {
        let part = |axis: usize, value: f64| {
            let [low, high] = self.panel.axes[axis].range;
            (libm::log(value / low) / libm::log(high / low)).clamp(0.0, 1.0)
        };
        [
            self.area.low[0] + part(0, x) * self.area.width(),
            self.area.high[1] - part(1, y) * self.area.height(),
        ]
    }

    fn area(&self, [across, up]: [[f64; 2]; 2]) -> Area {
        let [left, bottom] = self.place([across[0], up[0]]);
        let [right, top] = self.place([across[1], up[1]]);
        Area {
            low: [left, top],
            high: [right, bottom],
        }
    }

    fn draw(&self, canvas: &mut Canvas) {
        self.draw_regions(canvas);
        self.draw_axes(canvas);
        let radius = self.radius();
        for m in &self.panel.marks {
            let at = self.place(m.place);
            if m.ringed {
                ring(canvas, at, radius);
            }
            mark(canvas, at, radius, m.kind, m.hollow);
        }
        for r in &self.panel.references {
            reference(canvas, self.place(r.place), r.kind);
        }
    }

    /// The radius at which marks and their rings stay apart.
    fn radius(&self) -> f64 {
        let marks = self.panel.marks.iter();
        let places: Vec<Place> = marks.map(|m| self.place(m.place)).collect();
        let apart = places.windows(2).map(|w| {
            let [across, up] = [0, 1].map(|i| (w[1][i] - w[0][i]).abs());
            // Neighbours in a column, and the step from one column to the next.
            if across < 0.5 { up } else { across }
        });
        apart.fold(MARK, |radius, distance| radius.min(DENSE * distance))
    }

    fn draw_regions(&self, canvas: &mut Canvas) {
        for region in &self.panel.regions {
            let tint = mix(PAGE, region.kind.colour, TINT);
            canvas.fill(&self.area(region.area), tint);
        }
        for &area in &self.panel.uncertain {
            Self::fade(canvas, &self.area(area));
        }
        for ends in &self.panel.boundaries {
            canvas.line(&ends.map(|end| self.place(end)), 2.5, OUTLINE);
        }
    }

    fn fade(canvas: &mut Canvas, area: &Area) {
        let [low, high] = [area.low, area.high];
        let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
        canvas.fill_polygon(&corners, PAGE, 0.6);
    }

    fn draw_axes(&self, canvas: &mut Canvas) {
        let heading = TextStyle {
            weight: Weight::SemiBold,
            colour: TEXT,
            ..text(21.0, Align::Left)
        };
        let [left, top] = self.area.low;
        let [right, bottom] = self.area.high;
        canvas.text(&self.panel.heading, [left, top - 16.0], &heading);
        canvas.frame(&self.area, 1.0, FRAME);
        let [across, up] = self.panel.axes;
        for decade in decades(across.range) {
            let [x, _] = self.place([decade, up.range[0]]);
            canvas.line(&[[x, bottom], [x, bottom + 7.0]], 1.5, FRAME);
            let below = [x, bottom + 21.0];
            canvas.text_beside(&short(decade), below, &text(17.0, Align::Centre));
        }
        for decade in decades(up.range) {
            let [_, y] = self.place([across.range[0], decade]);
            canvas.line(&[[left - 7.0, y], [left, y]], 1.5, FRAME);
            let beside = [left - 12.0, y];
            canvas.text_beside(&short(decade), beside, &text(17.0, Align::Right));
        }
        let below = [0.5 * (left + right), bottom + 48.0];
        canvas.text_beside(across.name, below, &text(18.0, Align::Centre));
        let above = [left - 12.0, top + 8.0];
        canvas.text_beside(up.name, above, &text(18.0, Align::Right));
    }
}

/// The powers of ten in a range.
fn decades([low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
    let (first, last) = (libm::ceil(libm::log10(low)), libm::floor(libm::log10(high)));
    (first as i32..=last as i32).map(|k| libm::exp10(f64::from(k)))
}

fn text(size: f64, align: Align) -> TextStyle {
    TextStyle {
        size,
        weight: Weight::Regular,
        colour: FAINT_TEXT,
        align,
        halo: 0.0,
    }
}

fn shape(at: Place, radius: f64, (corners, turn): (u32, f64)) -> Vec<Place> {
    let corner = |k: u32| {
        let angle = turn + 2.0 * PI * f64::from(k) / f64::from(corners);
        [
            at[0] + radius * libm::sin(angle),
            at[1] - radius * libm::cos(angle),
        ]
    };
    (0..corners).map(corner).collect()
}

impl Kind<'_> {
    fn shape(&self, at: Place, radius: f64) -> Vec<Place> {
        shape(at, radius, (self.corners, self.turn))
    }
}

fn mark(canvas: &mut Canvas, at: Place, radius: f64, kind: Kind<'_>, hollow: bool) {
    // A triangle or square in a circle is smaller than the circle.
    let radius = radius * if kind.corners < 5 { 1.2 } else { 1.0 };
    canvas.fill_polygon(&kind.shape(at, 1.15 * radius), PAGE, 1.0);
    canvas.fill_polygon(&kind.shape(at, radius), kind.colour, 1.0);
    if hollow {
        canvas.fill_polygon(&kind.shape(at, 0.55 * radius), PAGE, 1.0);
    }
}

fn ring(canvas: &mut Canvas, at: Place, radius: f64) {
    let mut circle = shape(at, RING * radius, CIRCLE);
    circle.extend_from_within(..2);
    canvas.line(&circle, 0.22 * radius, OUTLINE);
}

fn reference(canvas: &mut Canvas, at: Place, kind: Kind<'_>) {
    let mut outline = kind.shape(at, 12.0);
    canvas.fill_polygon(&outline, PAGE, 1.0);
    outline.extend_from_within(..2);
    canvas.line(&outline, 3.0, OUTLINE);
    canvas.fill_polygon(&kind.shape(at, 6.0), kind.colour, 1.0);
}

/// Draws a mark at a place.
type Drawing<'a> = &'a dyn Fn(&mut Canvas, Place);

/// Draws the entries one after the other, each a mark and its words.
fn legend_row(canvas: &mut Canvas, y: f64, entries: &[(&str, Drawing<'_>)]) {
    let mut x = MARGIN + 20.0;
    for (words, draw) in entries {
        draw(canvas, [x, y]);
        let style = text(18.0, Align::Left);
        canvas.text_beside(words, [x + 26.0, y], &style);
        x += 26.0 + canvas.text_width(words, &style) + 44.0;
    }
}

fn draw_legend(canvas: &mut Canvas, legend: &Legend<'_>) {
    let of = |kind| move |canvas: &mut Canvas, at: Place| mark(canvas, at, MARK, kind, false);
    let hollow = |canvas: &mut Canvas, at: Place| mark(canvas, at, MARK, legend.sample, true);
    let outlined = |canvas: &mut Canvas, at: Place| reference(canvas, at, legend.sample);
    let kinds: Vec<_> = legend.kinds.iter().map(|k| (k.name, of(*k))).collect();
    let kinds = kinds
        .iter()
        .map(|(name, draw)| (*name, draw as Drawing<'_>));
    let others: [(&str, Drawing<'_>); 2] =
        [(legend.hollow, &hollow), (legend.reference, &outlined)];
    let first: Vec<_> = kinds.chain(others).collect();
    legend_row(canvas, LEGEND[0], &first);
    let ringed = |canvas: &mut Canvas, at: Place| ring(canvas, at, MARK);
    let line = |canvas: &mut Canvas, [x, y]: Place| {
        canvas.line(&[[x - 14.0, y], [x + 14.0, y]], 2.5, OUTLINE);
    };
    let second: [(&str, Drawing<'_>); 2] = [(legend.ringed, &ringed), (legend.boundary, &line)];
    legend_row(canvas, LEGEND[1], &second);
}

/// Draws a map of kinds.
///
/// ```
/// use langevin_rigid_pictures::kinds::*;
/// let kind = Kind { name: "laminar", colour: [38, 110, 190], corners: 4, turn: 0.0 };
/// let range = [10.0, 1e5];
/// let panel = Panel {
///     heading: "Smooth pipes".to_owned(),
///     axes: [Axis { name: "Reynolds number", range }, Axis { name: "L/D", range }],
///     regions: vec![Region { kind, area: [[10.0, 2300.0], range] }],
///     uncertain: vec![],
///     boundaries: vec![[[2300.0, 10.0], [2300.0, 1e5]]],
///     marks: vec![Mark { place: [500.0, 100.0], kind, hollow: false, ringed: false }],
///     references: vec![],
/// };
/// let map = KindMap {
///     title: "Flow in pipes",
///     caption: "",
///     panels: [panel.clone(), Panel { heading: "Rough pipes".to_owned(), ..panel }],
///     legend: Legend {
///         kinds: vec![kind],
///         sample: kind,
///         hollow: "uncertain",
///         reference: "measured",
///         ringed: "disagrees",
///         boundary: "onset of turbulence",
///     },
/// };
/// assert!(kind_map(&map)?.png()?.starts_with(b"\x89PNG"));
/// # Ok::<(), langevin_rigid_pictures::PictureError>(())
/// ```
///
/// # Errors
/// [`PictureError::Font`], of a damaged build alone.
pub fn kind_map(map: &KindMap<'_>) -> Result<Picture, PictureError> {
    let mut canvas = Canvas::new(SIZE)?;
    let title = TextStyle {
        weight: Weight::SemiBold,
        colour: TEXT,
        ..text(30.0, Align::Left)
    };
    canvas.text(map.title, [MARGIN, 62.0], &title);
    canvas.text(map.caption, [MARGIN, 94.0], &text(18.0, Align::Left));
    for (panel, left) in map.panels.iter().zip(PLOT_LEFT) {
        Plot::new(panel, left).draw(&mut canvas);
    }
    draw_legend(&mut canvas, &map.legend);
    Ok(Picture {
        size: SIZE,
        rgba: canvas.into_rgba(),
        times: Vec::new(),
        magnification: 1.0,
    })
}
