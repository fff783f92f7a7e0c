//! The map of the regimes: what the model does, over what experiments found.

use std::f64::consts::PI;

use super::canvas::{Align, Area, Canvas, Point as Place, TextStyle};
use super::font::Weight;
use super::numbers::short;
use super::palette::{Colour, FAINT_TEXT, FRAME, OUTLINE, PAGE, TEXT, mix};
use super::{Picture, PictureError};
use crate::ensemble::Motion;
use crate::regimes::{Plate, Point, Published, REYNOLDS, UNCERTAINTY, inertia_ratios};

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
/// The grid's outermost points are this factor inside the plot.
const ROOM: f64 = 1.7;
/// Strength of a regime's colour behind the marks.
const TINT: f64 = 0.28;

fn colour(motion: Motion) -> Colour {
    match motion {
        Motion::Steady => [120, 128, 140],
        Motion::Flutter => [38, 110, 190],
        Motion::Chaotic => [196, 52, 132],
        Motion::Tumble => [230, 130, 20],
    }
}

/// Corners of the polygon that marks a motion: shapes tell in grey what colours tell.
fn corners(motion: Motion) -> (u32, f64) {
    match motion {
        Motion::Steady => (4, 0.25 * PI),
        Motion::Flutter => (3, 0.0),
        Motion::Chaotic => (4, 0.0),
        Motion::Tumble => (40, 0.0),
    }
}

/// One kind of plate on the page: Re to the right, I* upwards, both logarithmic.
struct Panel {
    plate: Plate,
    plot: Area,
    /// Least and largest Re and I* of the plot.
    range: [[f64; 2]; 2],
}

impl Panel {
    fn new(plate: Plate, left: f64) -> Self {
        let wider = |[low, high]: [f64; 2]| [low / ROOM, high * ROOM];
        Self {
            plate,
            plot: Area {
                low: [left, PLOT_TOP],
                high: [left + PLOT[0], PLOT_TOP + PLOT[1]],
            },
            range: [wider(REYNOLDS), wider(inertia_ratios(plate))],
        }
    }

    /// Where a Re and I* are on the page, held to the plot.
    fn place(&self, reynolds: f64, inertia_ratio: f64) -> Place {
        let part = |axis: usize, value: f64| {
            let [low, high] = self.range[axis];
            (libm::log(value / low) / libm::log(high / low)).clamp(0.0, 1.0)
        };
        [
            self.plot.low[0] + part(0, reynolds) * self.plot.width(),
            self.plot.high[1] - part(1, inertia_ratio) * self.plot.height(),
        ]
    }

    fn area(&self, reynolds: [f64; 2], inertia_ratio: [f64; 2]) -> Area {
        let [left, bottom] = self.place(reynolds[0], inertia_ratio[0]);
        let [right, top] = self.place(reynolds[1], inertia_ratio[1]);
        Area {
            low: [left, top],
            high: [right, bottom],
        }
    }

    fn draw(&self, canvas: &mut Canvas, points: &[Point]) {
        let published = Published::of(self.plate);
        self.draw_published(canvas, published);
        self.draw_axes(canvas);
        let radius = self.radius(points);
        for point in points.iter().filter(|p| p.plate == self.plate) {
            let at = self.place(point.re, point.inertia_ratio);
            if point.compared && !point.agrees {
                ring(canvas, at, radius);
            }
            let unanimous = point.motions.iter().all(|m| *m == point.regime);
            mark(canvas, at, radius, point.regime, unanimous);
        }
        for plate in published.measured {
            let at = self.place(plate.reynolds, plate.inertia_ratio);
            measured(canvas, at, plate.motion);
        }
    }

    /// The radius at which marks and their rings stay apart. The points are in the grid's order.
    fn radius(&self, points: &[Point]) -> f64 {
        let own = points.iter().filter(|p| p.plate == self.plate);
        let places: Vec<Place> = own.map(|p| self.place(p.re, p.inertia_ratio)).collect();
        let apart = places.windows(2).map(|w| {
            let [across, up] = [0, 1].map(|i| (w[1][i] - w[0][i]).abs());
            // Neighbours in a column, and the step from one column to the next.
            if across < 0.5 { up } else { across }
        });
        apart.fold(MARK, |radius, distance| radius.min(DENSE * distance))
    }

    /// The published regimes as areas; pale where they are uncertain; their boundaries as lines.
    fn draw_published(&self, canvas: &mut Canvas, published: &Published) {
        let [[slow, fast], [light, heavy]] = self.range;
        let onset = published.onset;
        let tint = |motion| mix(PAGE, colour(motion), TINT);
        canvas.fill(
            &self.area([slow, onset], [light, heavy]),
            tint(Motion::Steady),
        );
        let mut from = light;
        for boundary in published.boundaries {
            let area = self.area([onset, fast], [from, boundary.inertia_ratio]);
            canvas.fill(&area, tint(boundary.below));
            from = boundary.inertia_ratio;
        }
        canvas.fill(
            &self.area([onset, fast], [from, heavy]),
            tint(published.above),
        );

        let about = |x: f64| [x / UNCERTAINTY, x * UNCERTAINTY];
        Self::fade(canvas, &self.area(about(onset), [light, heavy]));
        for boundary in published.boundaries {
            let beyond = [onset * UNCERTAINTY, fast];
            Self::fade(canvas, &self.area(beyond, about(boundary.inertia_ratio)));
        }
        let ends = [self.place(onset, light), self.place(onset, heavy)];
        canvas.line(&ends, 2.5, OUTLINE);
        for boundary in published.boundaries {
            let height = boundary.inertia_ratio;
            let ends = [self.place(onset, height), self.place(fast, height)];
            canvas.line(&ends, 2.5, OUTLINE);
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
        let [left, top] = self.plot.low;
        let [right, bottom] = self.plot.high;
        canvas.text(&self.heading(), [left, top - 16.0], &heading);
        canvas.frame(&self.plot, 1.0, FRAME);
        for decade in decades(self.range[0]) {
            let [x, _] = self.place(decade, self.range[1][0]);
            canvas.line(&[[x, bottom], [x, bottom + 7.0]], 1.5, FRAME);
            let below = [x, bottom + 21.0];
            canvas.text_beside(&short(decade), below, &text(17.0, Align::Centre));
        }
        for decade in decades(self.range[1]) {
            let [_, y] = self.place(self.range[0][0], decade);
            canvas.line(&[[left - 7.0, y], [left, y]], 1.5, FRAME);
            let beside = [left - 12.0, y];
            canvas.text_beside(&short(decade), beside, &text(17.0, Align::Right));
        }
        let below = [0.5 * (left + right), bottom + 48.0];
        canvas.text_beside("Reynolds number", below, &text(18.0, Align::Centre));
        let above = [left - 12.0, top + 8.0];
        canvas.text_beside("I*", above, &text(18.0, Align::Right));
    }

    fn heading(&self) -> String {
        let percent = short(100.0 * self.plate.thickness());
        match self.plate {
            Plate::Disc => format!("Discs, thickness {percent} % of the diameter"),
            Plate::Strip => format!("Strips, thickness {percent} % of the chord"),
        }
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

fn shape(at: Place, radius: f64, motion: Motion) -> Vec<Place> {
    let (sides, phase) = corners(motion);
    let corner = |k: u32| {
        let angle = phase + 2.0 * PI * f64::from(k) / f64::from(sides);
        [
            at[0] + radius * libm::sin(angle),
            at[1] - radius * libm::cos(angle),
        ]
    };
    (0..sides).map(corner).collect()
}

/// Filled where all releases agree, hollow where most do.
fn mark(canvas: &mut Canvas, at: Place, radius: f64, motion: Motion, unanimous: bool) {
    // A triangle or square in a circle is smaller than the circle.
    let radius = radius * if corners(motion).0 < 5 { 1.2 } else { 1.0 };
    canvas.fill_polygon(&shape(at, 1.15 * radius, motion), PAGE, 1.0);
    canvas.fill_polygon(&shape(at, radius, motion), colour(motion), 1.0);
    if !unanimous {
        canvas.fill_polygon(&shape(at, 0.55 * radius, motion), PAGE, 1.0);
    }
}

fn ring(canvas: &mut Canvas, at: Place, radius: f64) {
    let mut circle = shape(at, RING * radius, Motion::Tumble);
    circle.extend_from_within(..2);
    canvas.line(&circle, 0.22 * radius, OUTLINE);
}

/// A plate of an experiment.
fn measured(canvas: &mut Canvas, at: Place, motion: Motion) {
    let mut outline = shape(at, 12.0, motion);
    canvas.fill_polygon(&outline, PAGE, 1.0);
    outline.extend_from_within(..2);
    canvas.line(&outline, 3.0, OUTLINE);
    canvas.fill_polygon(&shape(at, 6.0, motion), colour(motion), 1.0);
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

fn draw_legend(canvas: &mut Canvas) {
    let of = |motion| move |canvas: &mut Canvas, at: Place| mark(canvas, at, MARK, motion, true);
    let hollow = |canvas: &mut Canvas, at: Place| mark(canvas, at, MARK, Motion::Tumble, false);
    let experiment = |canvas: &mut Canvas, at: Place| measured(canvas, at, Motion::Tumble);
    legend_row(
        canvas,
        LEGEND[0],
        &[
            ("steady", &of(Motion::Steady)),
            ("flutter", &of(Motion::Flutter)),
            ("chaotic", &of(Motion::Chaotic)),
            ("tumble", &of(Motion::Tumble)),
            ("hollow: two of three releases, or none alike", &hollow),
            ("a plate of an experiment", &experiment),
        ],
    );
    let ringed = |canvas: &mut Canvas, at: Place| ring(canvas, at, MARK);
    let line = |canvas: &mut Canvas, [x, y]: Place| {
        canvas.line(&[[x - 14.0, y], [x + 14.0, y]], 2.5, OUTLINE);
    };
    legend_row(
        canvas,
        LEGEND[1],
        &[
            ("disagrees with the published regime", &ringed),
            (
                "published boundary; pale: not compared, within a factor 1.5 of it",
                &line,
            ),
        ],
    );
}

/// Draws the map of the regimes: a panel for discs and one for strips, Re against I*.
///
/// The colour behind a mark is the published regime, the mark the model's.
///
/// # Errors
/// [`PictureError::Font`], of a damaged build alone.
pub fn regime_map(points: &[Point], caption: &str) -> Result<Picture, PictureError> {
    let mut canvas = Canvas::new(SIZE)?;
    let title = TextStyle {
        weight: Weight::SemiBold,
        colour: TEXT,
        ..text(30.0, Align::Left)
    };
    canvas.text("Regimes of falling plates", [MARGIN, 62.0], &title);
    canvas.text(caption, [MARGIN, 94.0], &text(18.0, Align::Left));
    for (plate, left) in Plate::ALL.into_iter().zip(PLOT_LEFT) {
        Panel::new(plate, left).draw(&mut canvas, points);
    }
    draw_legend(&mut canvas);
    Ok(Picture {
        size: SIZE,
        rgba: canvas.into_rgba(),
        times: Vec::new(),
        magnification: 1.0,
    })
}
