//! What the motion is drawn against: grid, ticks, ground.

use crate::canvas::{Align, Area, Canvas, TextStyle};
use crate::font::Weight;
use crate::layout::{Layout, Panel};
use crate::numbers::{LengthUnit, coarse_above, decimals, fixed};
use crate::palette::{FAINT_TEXT, FRAME, GRID, GROUND, GROUND_LINE, PLOT, TEXT};
use crate::vector::Vec3;

/// Least distance of grid lines on the page, units.
const SPACING: f64 = 84.0;

/// Multiples of a round number of metres, and how they are written.
#[derive(Clone, Copy, Debug)]
pub(super) struct Ticks {
    pub step: f64,
    pub unit: LengthUnit,
}

impl Ticks {
    pub(super) fn new(layout: &Layout) -> Self {
        let step = coarse_above(SPACING * layout.unit / layout.scale);
        let unit = LengthUnit::fitting(step);
        Self { step, unit }
    }

    /// The multiples of the step from `low` to `high`, metres.
    fn between(&self, [low, high]: [f64; 2]) -> impl Iterator<Item = f64> {
        let first = (low / self.step).ceil();
        // A range of more than so many steps cannot be on a page.
        let count = ((high / self.step).floor() - first + 1.0).clamp(0.0, 1000.0) as usize;
        let step = self.step;
        (0..count).map(move |k| (first + k as f64) * step)
    }

    fn label(&self, value: f64) -> String {
        let (value, step) = (value / self.unit.metres, self.step / self.unit.metres);
        fixed(value, decimals(step))
    }
}

pub(super) fn style(layout: &Layout, size: f64, align: Align) -> TextStyle {
    TextStyle {
        size: size * layout.unit,
        weight: Weight::Regular,
        colour: FAINT_TEXT,
        align,
        halo: 0.0,
    }
}

/// Draws the empty panel.
pub(super) fn draw(canvas: &mut Canvas, layout: &Layout, panel: &Panel, ticks: &Ticks) {
    canvas.fill(&panel.plot, PLOT);
    let heading = TextStyle {
        weight: Weight::SemiBold,
        colour: TEXT,
        ..style(layout, 19.0, Align::Left)
    };
    let [x, y] = panel.plot.low;
    let beside = [x, y - 0.5 * layout.panel_header()];
    canvas.text_beside(panel.camera.name(), beside, &heading);
    if panel.camera.axes().is_some() {
        draw_flat(canvas, layout, panel, ticks);
    } else {
        draw_room(canvas, layout, panel, ticks);
    }
}

/// Grid and ticks of a panel whose sides are along world axes.
fn draw_flat(canvas: &mut Canvas, layout: &Layout, panel: &Panel, ticks: &Ticks) {
    draw_ground(canvas, layout, panel);
    let Some([across, upward]) = panel.camera.axes() else {
        return;
    };
    let plot = panel.plot;
    let centre = plot.centre();
    let thin = layout.unit.max(1.0);
    let number = style(layout, 16.0, Align::Centre);
    for value in ticks.between(panel.range(0)) {
        let x = centre[0] + panel.scale * (value - panel.centre[0]);
        canvas.line(&[[x, plot.low[1]], [x, plot.high[1]]], thin, GRID);
        let below = [x, plot.high[1] + 15.0 * layout.unit];
        canvas.text_beside(&ticks.label(across.sign * value), below, &number);
    }
    let number = style(layout, 16.0, Align::Right);
    for value in ticks.between(panel.range(1)) {
        let y = centre[1] - panel.scale * (value - panel.centre[1]);
        canvas.line(&[[plot.low[0], y], [plot.high[0], y]], thin, GRID);
        let beside = [plot.low[0] - 9.0 * layout.unit, y];
        canvas.text_beside(&ticks.label(upward.sign * value), beside, &number);
    }
    draw_ground_line(canvas, layout, panel);
    canvas.frame(&plot, thin, FRAME);
    let unit = ticks.unit.name;
    let below = [centre[0], plot.high[1] + 41.0 * layout.unit];
    let name = style(layout, 17.0, Align::Centre);
    canvas.text_beside(&format!("{} ({unit})", across.name), below, &name);
    let above = [
        plot.low[0] - 9.0 * layout.unit,
        plot.low[1] - 0.5 * layout.panel_header(),
    ];
    let name = style(layout, 17.0, Align::Right);
    canvas.text_beside(&format!("{} ({unit})", upward.name), above, &name);
}

/// Where the ground's surface is on the page, for panels in which it is seen edge-on.
fn ground_level(layout: &Layout, panel: &Panel) -> Option<f64> {
    let [_, upward] = panel.camera.axes()?;
    let height = layout.ground.filter(|_| upward.name == "y")?;
    Some(panel.place([0.0, height, 0.0])[1])
}

fn draw_ground(canvas: &mut Canvas, layout: &Layout, panel: &Panel) {
    if let Some(level) = ground_level(layout, panel) {
        let earth = Area {
            low: [panel.plot.low[0], level],
            high: panel.plot.high,
        };
        canvas.fill(&earth, GROUND);
    }
}

fn draw_ground_line(canvas: &mut Canvas, layout: &Layout, panel: &Panel) {
    if let Some(level) = ground_level(layout, panel) {
        let ends = [panel.plot.low[0], panel.plot.high[0]].map(|x| [x, level]);
        canvas.line(&ends, 2.0 * layout.unit, GROUND_LINE);
    }
}

/// The height on which shadows fall in a view from above at an angle.
pub(super) fn floor(layout: &Layout) -> f64 {
    layout.ground.unwrap_or(layout.bounds.low[1])
}

/// Floor and two back walls with grid lines.
fn draw_room(canvas: &mut Canvas, layout: &Layout, panel: &Panel, ticks: &Ticks) {
    let (low, high) = (layout.bounds.low, layout.bounds.high);
    let floor = floor(layout);
    let place = |p: Vec3| {
        let [x, y, _] = panel.place(p);
        [x, y]
    };
    let corners = [
        [low[0], floor, low[2]],
        [high[0], floor, low[2]],
        [high[0], floor, high[2]],
        [low[0], floor, high[2]],
    ];
    let fill = if layout.ground.is_some() {
        GROUND
    } else {
        GRID
    };
    canvas.fill_polygon(&corners.map(place), fill, 0.55);
    let thin = layout.unit.max(1.0);
    let number = style(layout, 16.0, Align::Centre);
    for x in ticks.between([low[0], high[0]]) {
        let line = [
            [x, floor, high[2]],
            [x, floor, low[2]],
            [x, high[1], low[2]],
        ];
        canvas.line(&line.map(place), thin, GRID);
        let [px, py] = place(line[0]);
        // The numbers of x and z would meet at the nearest corner.
        if panel.scale * (high[0] - x) > 24.0 * layout.unit {
            let below = [px - 4.0 * layout.unit, py + 16.0 * layout.unit];
            canvas.text_beside(&ticks.label(x), below, &number);
        }
    }
    let number = style(layout, 16.0, Align::Left);
    for z in ticks.between([low[2], high[2]]) {
        let line = [
            [high[0], floor, z],
            [low[0], floor, z],
            [low[0], high[1], z],
        ];
        canvas.line(&line.map(place), thin, GRID);
        let [px, py] = place(line[0]);
        let beside = [px + 8.0 * layout.unit, py + 8.0 * layout.unit];
        canvas.text_beside(&ticks.label(z), beside, &number);
    }
    let number = style(layout, 16.0, Align::Right);
    for y in ticks.between([floor, high[1]]) {
        let line = [
            [low[0], y, high[2]],
            [low[0], y, low[2]],
            [high[0], y, low[2]],
        ];
        canvas.line(&line.map(place), thin, GRID);
        let [px, py] = place(line[0]);
        canvas.text_beside(&ticks.label(y), [px - 8.0 * layout.unit, py], &number);
    }
    draw_room_edges(canvas, layout, panel, ticks);
}

fn draw_room_edges(canvas: &mut Canvas, layout: &Layout, panel: &Panel, ticks: &Ticks) {
    let (low, high) = (layout.bounds.low, layout.bounds.high);
    let floor = floor(layout);
    let place = |p: Vec3| {
        let [x, y, _] = panel.place(p);
        [x, y]
    };
    let outline = [
        [low[0], high[1], high[2]],
        [low[0], floor, high[2]],
        [high[0], floor, high[2]],
        [high[0], floor, low[2]],
        [high[0], high[1], low[2]],
        [low[0], high[1], low[2]],
        [low[0], high[1], high[2]],
    ];
    let thin = layout.unit.max(1.0);
    canvas.line(&outline.map(place), thin, FRAME);
    let middle = |i: usize| 0.5 * (low[i] + high[i]);
    let names = [
        (
            "x",
            [middle(0), floor, high[2]],
            [-14.0, 40.0],
            Align::Right,
        ),
        ("z", [high[0], floor, middle(2)], [30.0, 34.0], Align::Left),
        ("y", [low[0], high[1], high[2]], [0.0, -16.0], Align::Right),
    ];
    for (name, at, [dx, dy], align) in names {
        let [x, y] = place(at);
        let at = [x + dx * layout.unit, y + dy * layout.unit];
        let text = format!("{name} ({})", ticks.unit.name);
        canvas.text_beside(&text, at, &style(layout, 17.0, align));
    }
}
