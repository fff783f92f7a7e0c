//! The page: lines, areas and text in pixels, x to the right and y down.

use tiny_skia::{
    Color, FillRule, LineCap, LineJoin, Paint, Path, PathBuilder, Pixmap, Stroke, Transform,
};

use crate::PictureError;
use crate::font::{CAPITAL, Fonts, Weight};
use crate::palette::{Colour, PAGE};

pub(super) type Point = [f64; 2];

/// An upright rectangle in pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Area {
    pub low: Point,
    pub high: Point,
}

impl Area {
    pub(super) fn about(centre: Point, half: Point) -> Self {
        Self {
            low: std::array::from_fn(|i| centre[i] - half[i]),
            high: std::array::from_fn(|i| centre[i] + half[i]),
        }
    }

    pub(super) fn width(&self) -> f64 {
        self.high[0] - self.low[0]
    }

    pub(super) fn height(&self) -> f64 {
        self.high[1] - self.low[1]
    }

    pub(super) fn centre(&self) -> Point {
        [
            0.5 * (self.low[0] + self.high[0]),
            0.5 * (self.low[1] + self.high[1]),
        ]
    }

    pub(super) fn grown(&self, by: f64) -> Self {
        Self {
            low: self.low.map(|c| c - by),
            high: self.high.map(|c| c + by),
        }
    }

    pub(super) fn contains(&self, p: Point) -> bool {
        (0..2).all(|i| self.low[i] <= p[i] && p[i] <= self.high[i])
    }

    pub(super) fn covers(&self, other: &Area) -> bool {
        self.contains(other.low) && self.contains(other.high)
    }

    pub(super) fn meets(&self, other: &Area) -> bool {
        (0..2).all(|i| self.low[i] <= other.high[i] && other.low[i] <= self.high[i])
    }
}

/// Which part of a text stands at the given point.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Align {
    Left,
    Centre,
    Right,
}

/// Size, weight, colour and alignment of a text.
#[derive(Clone, Copy, Debug)]
pub(super) struct TextStyle {
    pub size: f64,
    pub weight: Weight,
    pub colour: Colour,
    pub align: Align,
    /// Width of a clear border around the letters, for text over a drawing.
    pub halo: f64,
}

/// An opaque page being drawn on.
pub(super) struct Canvas {
    pixmap: Pixmap,
    pub(super) fonts: Fonts,
}

impl Canvas {
    pub(super) fn new([width, height]: [u32; 2]) -> Result<Self, PictureError> {
        let size_error = PictureError::Size { width, height };
        let mut pixmap = Pixmap::new(width, height).ok_or(size_error)?;
        pixmap.fill(colour(PAGE, 1.0));
        Ok(Self {
            pixmap,
            fonts: Fonts::new()?,
        })
    }

    /// Red, green, blue, 255 for each pixel, row by row from the top.
    pub(super) fn into_rgba(self) -> Vec<u8> {
        // The page is opaque from the start, so premultiplied and straight are the same.
        self.pixmap.take()
    }

    pub(super) fn fill(&mut self, area: &Area, fill: Colour) {
        let corners = [
            area.low,
            [area.high[0], area.low[1]],
            area.high,
            [area.low[0], area.high[1]],
        ];
        self.fill_polygon(&corners, fill, 1.0);
    }

    pub(super) fn fill_polygon(&mut self, corners: &[Point], fill: Colour, opacity: f64) {
        if let Some(path) = polyline(corners, true) {
            self.fill_path(&path, fill, opacity);
        }
    }

    fn fill_path(&mut self, path: &Path, fill: Colour, opacity: f64) {
        let (rule, still) = (FillRule::Winding, Transform::identity());
        self.pixmap
            .fill_path(path, &paint(fill, opacity), rule, still, None);
    }

    fn stroke_path(&mut self, path: &Path, width: f64, cap: LineCap, line: Colour) {
        let stroke = Stroke {
            width: width as f32,
            line_cap: cap,
            line_join: LineJoin::Round,
            ..Stroke::default()
        };
        self.pixmap.stroke_path(
            path,
            &paint(line, 1.0),
            &stroke,
            Transform::identity(),
            None,
        );
    }

    /// A line through the points that ends exactly at the first and the last.
    pub(super) fn line(&mut self, points: &[Point], width: f64, colour: Colour) {
        if let Some(path) = polyline(points, false) {
            self.stroke_path(&path, width, LineCap::Butt, colour);
        }
    }

    /// A line through the points with round ends.
    pub(super) fn round_line(&mut self, points: &[Point], width: f64, colour: Colour) {
        if let Some(path) = polyline(points, false) {
            self.stroke_path(&path, width, LineCap::Round, colour);
        }
    }

    pub(super) fn frame(&mut self, area: &Area, width: f64, colour: Colour) {
        let [low, high] = [area.low, area.high];
        let corners = [low, [high[0], low[1]], high, [low[0], high[1]]];
        if let Some(path) = polyline(&corners, true) {
            self.stroke_path(&path, width, LineCap::Butt, colour);
        }
    }

    /// A disc with a rim of width `rim` inside its radius.
    pub(super) fn disc(
        &mut self,
        centre: Point,
        radius: f64,
        fill: Colour,
        rim: f64,
        edge: Colour,
    ) {
        for (radius, fill) in [(radius, edge), (radius - rim, fill)] {
            let [x, y] = centre.map(|c| c as f32);
            if let Some(path) = PathBuilder::from_circle(x, y, radius as f32) {
                self.fill_path(&path, fill, 1.0);
            }
        }
    }

    pub(super) fn text_width(&self, text: &str, style: &TextStyle) -> f64 {
        self.fonts.width(text, style.size, style.weight)
    }

    /// A line of text whose base line is at `at[1]`.
    pub(super) fn text(&mut self, text: &str, at: Point, style: &TextStyle) {
        let shift = match style.align {
            Align::Left => 0.0,
            Align::Centre => 0.5,
            Align::Right => 1.0,
        };
        let origin = [at[0] - shift * self.text_width(text, style), at[1]];
        let outline = self.fonts.outline(text, origin, style.size, style.weight);
        if let Some(path) = outline {
            if style.halo > 0.0 {
                self.stroke_path(&path, 2.0 * style.halo, LineCap::Round, PAGE);
            }
            self.fill_path(&path, style.colour, 1.0);
        }
    }

    /// A line of text whose capitals are centred on the height of `at`.
    pub(super) fn text_beside(&mut self, text: &str, at: Point, style: &TextStyle) {
        self.text(text, [at[0], at[1] + 0.5 * CAPITAL * style.size], style);
    }

    /// Lays a premultiplied colour (channels and coverage 0 to 1) over one pixel.
    pub(super) fn blend(&mut self, x: usize, y: usize, over: [f32; 4]) {
        let start = 4 * (y * self.pixmap.width() as usize + x);
        let pixel = &mut self.pixmap.data_mut()[start..start + 3];
        for (channel, c) in pixel.iter_mut().zip(over) {
            let mixed = c * 255.0 + f32::from(*channel) * (1.0 - over[3]);
            *channel = (mixed + 0.5) as u8;
        }
    }
}

fn colour([r, g, b]: Colour, opacity: f64) -> Color {
    Color::from_rgba8(r, g, b, (opacity.clamp(0.0, 1.0) * 255.0 + 0.5) as u8)
}

fn paint(fill: Colour, opacity: f64) -> Paint<'static> {
    let mut paint = Paint::default();
    paint.set_color(colour(fill, opacity));
    paint
}

fn polyline(points: &[Point], closed: bool) -> Option<Path> {
    let (first, rest) = points.split_first()?;
    let mut builder = PathBuilder::new();
    builder.move_to(first[0] as f32, first[1] as f32);
    rest.iter()
        .for_each(|p| builder.line_to(p[0] as f32, p[1] as f32));
    if closed {
        builder.close();
    }
    builder.finish()
}
