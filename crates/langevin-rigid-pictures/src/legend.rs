//! The words of the picture: title, caption, and the key to its colours and lengths.

use crate::axes::style;
use crate::canvas::{Align, Canvas, Point, TextStyle};
use crate::cast::Cast;
use crate::font::Weight;
use crate::layout::Layout;
use crate::numbers::{LengthUnit, coarse_below, short};
use crate::palette::{Colour, LOWER_FACE, OUTLINE, TEXT, UPPER_FACE, path as path_colour};
use crate::scene::{end_mark, start_mark};
use crate::solid::Solid;
use crate::strobe::Instants;

/// Page lengths in units.
const TITLE: f64 = 30.0;
/// How much smaller a long title is written before it is cut.
const LEAST_TITLE: f64 = 0.6;
/// Characters of a title that are looked at: more than fit on any page.
const LONGEST_TITLE: usize = 1000;
const TEXT_SIZE: f64 = 18.0;
const TIME_BAR: f64 = 140.0;
const LONGEST_BAR: f64 = 130.0;
const SWATCH: f64 = 17.0;
const SPACE: f64 = 10.0;
const BETWEEN: f64 = 30.0;

/// Writes title and caption (`words`) above the panels.
pub(super) fn draw_header(canvas: &mut Canvas, layout: &Layout, title: Option<&str>, words: &str) {
    let at = layout.caption(title.is_some());
    if let Some(title) = title {
        draw_title(canvas, layout, title);
    }
    let base = at[1] + TEXT_SIZE * layout.unit;
    let style = shrunk(canvas, layout, words, style(layout, TEXT_SIZE, Align::Left));
    canvas.text(words, [at[0], base], &style);
}

fn draw_title(canvas: &mut Canvas, layout: &Layout, title: &str) {
    let [x, y] = layout.caption(false);
    let style = TextStyle {
        weight: Weight::SemiBold,
        colour: TEXT,
        ..style(layout, TITLE, Align::Left)
    };
    let words: Vec<&str> = title.split_whitespace().collect();
    let mut line: String = words.join(" ").chars().take(LONGEST_TITLE).collect();
    let room = layout.legend().width();
    let fits = |line: &str| LEAST_TITLE * canvas.text_width(line, &style) <= room;
    if !fits(&line) {
        while !fits(&format!("{line}\u{2026}")) && line.pop().is_some() {}
        line.push('\u{2026}');
    }
    let style = shrunk(canvas, layout, &line, style);
    canvas.text(&line, [x, y + TITLE * layout.unit], &style);
}

/// The style made small enough for the text to fit the page's width.
fn shrunk(canvas: &Canvas, layout: &Layout, text: &str, style: TextStyle) -> TextStyle {
    let room = layout.legend().width();
    let width = canvas.text_width(text, &style);
    let size = style.size * (room / width).min(1.0);
    TextStyle { size, ..style }
}

/// How large the body is drawn.
pub(super) fn size(layout: &Layout) -> String {
    if layout.magnification > 1.0 {
        format!("magnified {}\u{d7}", short(layout.magnification))
    } else {
        "drawn to scale".to_owned()
    }
}

/// What is drawn, in words.
pub(super) fn caption(layout: &Layout, instants: &Instants) -> String {
    let size = size(layout);
    match (instants.times.as_slice(), instants.interval) {
        ([], _) => "The path of the body".to_owned(),
        ([time], _) => format!("The body at {} s, {size}", short(*time)),
        (_, interval) => format!("The body every {} s, {size}", short(interval)),
    }
}

/// Draws the key below the panels, from left to right, in the rows kept for it.
pub(super) fn draw_legend(canvas: &mut Canvas, layout: &Layout, cast: &Cast<'_>, path: bool) {
    let mut key = Key {
        layout,
        unit: layout.unit,
        path: path && !cast.crowd,
    };
    let mut entries = key.entries(cast);
    let area = layout.legend();
    // Long words take a smaller hand; half the size is room for twice the words.
    while key
        .place(canvas, &entries)
        .last()
        .is_some_and(|p| p[1] > area.high[1])
        && key.unit > 0.5 * layout.unit
    {
        key.unit *= 0.96;
        entries = key.entries(cast);
    }
    let places = key.place(canvas, &entries);
    for (entry, place) in entries.iter().zip(places) {
        key.draw(canvas, entry, place);
    }
}

/// The key at one size of writing.
struct Key<'a> {
    layout: &'a Layout,
    unit: f64,
    /// Whether there is a path whose colours are to be explained.
    path: bool,
}

/// A sign of the key and the words beside it.
struct Entry {
    sign: Sign,
    words: String,
}

enum Sign {
    /// The path's colours from the start, whose time it carries, to the end.
    Path {
        start: String,
    },
    Face(Colour),
    /// A bar of a length on the page, pixels.
    Length(f64),
}

impl Key<'_> {
    fn entries(&self, cast: &Cast<'_>) -> Vec<Entry> {
        let (_, track) = cast.first();
        let mut entries = Vec::new();
        if self.path && track.end() > track.start() {
            entries.push(Entry {
                sign: Sign::Path {
                    start: format!("{} s", short(track.start())),
                },
                words: format!("{} s", short(track.end())),
            });
        }
        for (sign, colour) in [(1.0, UPPER_FACE), (-1.0, LOWER_FACE)] {
            entries.push(Entry {
                sign: Sign::Face(colour),
                words: face_name(cast.solids(), sign),
            });
        }
        entries.push(self.bar(1.0, ""));
        if self.layout.magnification > 1.0 {
            let of = match cast.crowd {
                false => " of the body",
                true => " of a body",
            };
            entries.push(self.bar(self.layout.magnification, of));
        }
        entries
    }

    /// A bar of round length on the scale of the path, or on that of the magnified body.
    fn bar(&self, magnification: f64, of: &str) -> Entry {
        let scale = self.layout.scale * magnification;
        let length = coarse_below(LONGEST_BAR * self.unit / scale);
        let unit = LengthUnit::fitting(length);
        Entry {
            sign: Sign::Length(length * scale),
            words: format!("{} {}{of}", short(length / unit.metres), unit.name),
        }
    }

    /// Left end and middle height of each entry.
    fn place(&self, canvas: &Canvas, entries: &[Entry]) -> Vec<Point> {
        let area = self.layout.legend();
        let row = self.layout.legend_row_height();
        let mut pen = [area.low[0], area.low[1] + 0.5 * row];
        let place = |entry: &Entry| {
            let width = self.width(canvas, entry);
            if pen[0] > area.low[0] && pen[0] + width > area.high[0] {
                pen = [area.low[0], pen[1] + row];
            }
            let here = pen;
            pen[0] += width + BETWEEN * self.unit;
            here
        };
        entries.iter().map(place).collect()
    }

    fn style(&self) -> TextStyle {
        TextStyle {
            size: TEXT_SIZE * self.unit,
            colour: TEXT,
            ..style(self.layout, TEXT_SIZE, Align::Left)
        }
    }

    fn sign_width(&self, canvas: &Canvas, sign: &Sign) -> f64 {
        match sign {
            Sign::Path { start } => {
                canvas.text_width(start, &self.style()) + (SPACE + TIME_BAR) * self.unit
            }
            Sign::Face(_) => SWATCH * self.unit,
            Sign::Length(length) => *length,
        }
    }

    fn width(&self, canvas: &Canvas, entry: &Entry) -> f64 {
        let words = canvas.text_width(&entry.words, &self.style());
        self.sign_width(canvas, &entry.sign) + SPACE * self.unit + words
    }

    fn draw(&self, canvas: &mut Canvas, entry: &Entry, [x, y]: Point) {
        let end = x + self.sign_width(canvas, &entry.sign);
        match &entry.sign {
            Sign::Path { start } => {
                canvas.text_beside(start, [x, y], &self.style());
                draw_path_bar(canvas, self.unit, [end - TIME_BAR * self.unit, end], y);
            }
            Sign::Face(colour) => {
                let centre = [0.5 * (x + end), y];
                let rim = 1.5 * self.unit.max(0.7);
                canvas.disc(centre, 0.5 * SWATCH * self.unit, *colour, rim, OUTLINE);
            }
            Sign::Length(_) => draw_length_bar(canvas, self.unit, [x, end], y),
        }
        canvas.text_beside(&entry.words, [end + SPACE * self.unit, y], &self.style());
    }
}

/// A face by the body axis it looks along, or by its colour where the mesh lies askew or bodies differ.
fn face_name(solids: &[Solid], sign: f64) -> String {
    let letter = if sign > 0.0 { '+' } else { '\u{2212}' };
    let thin_axis = solids[0].thin_axis;
    let common = solids.iter().all(|solid| solid.thin_axis == thin_axis);
    let axis = thin_axis.iter().position(|c| *c == 1.0);
    match axis.filter(|_| common) {
        Some(axis) => format!("{letter}{} side", ["x", "y", "z"][axis]),
        None if sign > 0.0 => "one side".to_owned(),
        None => "other side".to_owned(),
    }
}

fn draw_path_bar(canvas: &mut Canvas, unit: f64, [from, to]: [f64; 2], y: f64) {
    let radius = 7.0 * unit;
    let [from, to] = [from + radius, to - radius];
    let parts = 48;
    // Whole pixels, so that no page shows between the parts.
    let x = |k: usize| (from + (to - from) * k as f64 / parts as f64).floor();
    for k in 0..parts {
        let colour = path_colour((k as f64 + 0.5) / parts as f64);
        canvas.line(&[[x(k), y], [x(k + 1), y]], 6.0 * unit, colour);
    }
    start_mark(canvas, [from, y], radius);
    end_mark(canvas, [to, y], radius);
}

fn draw_length_bar(canvas: &mut Canvas, unit: f64, [from, to]: [f64; 2], y: f64) {
    let width = 2.4 * unit;
    let tick = 7.0 * unit;
    canvas.line(&[[from, y], [to, y]], width, TEXT);
    for x in [from + 0.5 * width, to - 0.5 * width] {
        canvas.line(&[[x, y - tick], [x, y + tick]], width, TEXT);
    }
}
