//! A field of velocities as arrows behind the motion.

use crate::Stage;
use crate::camera::Direction;
use crate::canvas::{Canvas, Point};
use crate::layout::{Layout, Panel};
use crate::numbers::short;
use crate::palette::ARROW;
use crate::vector::{Vec3, transposed_mat_vec};

/// Page lengths in units: between arrows, of the longest, of a head, of a line, of the shortest that is drawn.
const SPACING: f64 = 58.0;
const LONGEST: f64 = 50.0;
const HEAD: f64 = 7.0;
const WIDTH: f64 = 1.7;
const SHORTEST: f64 = 3.0;

/// An arrow of a panel: where it is on the page, and the velocity along the page, right and up (m/s).
struct Arrow {
    at: Point,
    velocity: Point,
}

/// The arrows of all panels.
pub(super) struct Arrows {
    panels: Vec<Vec<Arrow>>,
    fastest: f64,
}

impl Arrows {
    /// Samples `velocity` (m/s) of places (m) on the plane of each panel through the middle of the motion, above ground and
    /// water.
    pub(super) fn new(layout: &Layout, stage: &Stage, velocity: &dyn Fn(Vec3) -> Vec3) -> Self {
        let panels: Vec<Vec<Arrow>> = layout
            .panels
            .iter()
            .map(|panel| sampled(layout, panel, stage, velocity))
            .collect();
        let speeds = panels.iter().flatten().map(|arrow| length(arrow.velocity));
        let fastest = speeds.filter(|speed| speed.is_finite()).fold(0.0, f64::max);
        Self { panels, fastest }
    }

    /// What they are, in words; nothing where nothing moves.
    pub(super) fn caption(&self) -> Option<String> {
        let speed = short(self.fastest);
        (self.fastest > 0.0).then(|| format!("arrows: the fluid, at most {speed} m/s"))
    }

    /// Draws those of panel number `panel`.
    pub(super) fn draw(&self, canvas: &mut Canvas, layout: &Layout, panel: usize) {
        for Arrow { at, velocity } in &self.panels[panel] {
            let page = LONGEST * layout.unit / self.fastest;
            let [x, y] = [page * velocity[0], -page * velocity[1]];
            let long = length([x, y]);
            if !(long >= SHORTEST * layout.unit && long.is_finite()) {
                continue;
            }
            let tip = [at[0] + 0.5 * x, at[1] + 0.5 * y];
            let tail = [at[0] - 0.5 * x, at[1] - 0.5 * y];
            let head = HEAD.min(0.4 * long / layout.unit) * layout.unit / long;
            let side = |s: f64| {
                let [back, aside] = [[head * x, head * y], [-head * y, head * x]];
                [
                    tip[0] - back[0] + 0.6 * s * aside[0],
                    tip[1] - back[1] + 0.6 * s * aside[1],
                ]
            };
            let width = WIDTH * layout.unit;
            canvas.line(&[tail, tip], width, ARROW);
            canvas.line(&[side(1.0), tip, side(-1.0)], width, ARROW);
        }
    }
}

fn length([x, y]: Point) -> f64 {
    (x * x + y * y).sqrt()
}

fn sampled(
    layout: &Layout,
    panel: &Panel,
    stage: &Stage,
    velocity: &dyn Fn(Vec3) -> Vec3,
) -> Vec<Arrow> {
    // Seen at an angle, arrows on a plane would tell of no place that one could find.
    if panel.camera.direction == Direction::Iso {
        return Vec::new();
    }
    let bounds = layout.bounds;
    let middle = std::array::from_fn(|i| 0.5 * (bounds.low[i] + bounds.high[i]));
    let depth = panel.camera.project(middle)[2];
    let spacing = SPACING * layout.unit;
    let count = |size: f64| (size / spacing).floor().clamp(1.0, 200.0) as usize;
    let [across, upward] = [count(panel.plot.width()), count(panel.plot.height())];
    let centre = panel.plot.centre();
    let offset = |k: usize, of: usize| (k as f64 - 0.5 * (of as f64 - 1.0)) * spacing;
    let mut arrows = Vec::new();
    for row in 0..upward {
        for column in 0..across {
            let [x, y] = [offset(column, across), offset(row, upward)];
            let right = panel.centre[0] + x / panel.scale;
            let up = panel.centre[1] - y / panel.scale;
            let world = transposed_mat_vec(&panel.camera.rows, [right, up, depth]);
            let mut lowest = [stage.ground, stage.water].into_iter().flatten();
            if lowest.any(|height| world[1] < height) {
                continue;
            }
            let [along, upwards, _] = panel.camera.project(velocity(world));
            arrows.push(Arrow {
                at: [centre[0] + x, centre[1] + y],
                velocity: [along, upwards],
            });
        }
    }
    arrows
}
