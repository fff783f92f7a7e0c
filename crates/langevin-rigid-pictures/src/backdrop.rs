//! What the stage looks like behind the bodies: water, walls, solids.

use crate::axes::floor;
use crate::camera::Direction;
use crate::canvas::{Area, Canvas, Point};
use crate::layout::{Bounds, Layout, Panel};
use crate::palette::{SCENERY, WALL, WATER, WATER_LINE};
use crate::raster::{Before, Facet, View};
use crate::slope::slab;
use crate::solid::Solid;
use crate::vector::Vec3;
use crate::{PictureError, Scenery, Stage, Subject};

/// How opaque water is, in a body of it and at its surface.
const DEEP: f64 = 0.2;
const SURFACE: f64 = 0.16;
/// Page lengths in units.
const WATER_WIDTH: f64 = 2.0;
const WALL_WIDTH: f64 = 1.6;

/// The solids of a stage as one, ready to draw.
#[derive(Clone, Debug)]
pub(super) struct Backdrop {
    solid: Option<Solid>,
}

impl Backdrop {
    pub(super) fn new(stage: &Stage, layout: &Layout) -> Result<Self, PictureError> {
        let (mut vertices, mut triangles) = (Vec::new(), Vec::new());
        for (index, solid) in stage.solids.iter().enumerate() {
            let fault = |error: PictureError| PictureError::BadScenery {
                index,
                fault: Box::new(error),
            };
            Solid::check(&solid.subject()).map_err(fault)?;
        }
        let mut room = layout.bounds;
        room.low[1] = floor(layout);
        let slopes: Vec<Scenery> = stage.planes.iter().filter_map(|p| slab(p, &room)).collect();
        for solid in stage.solids.iter().chain(&slopes) {
            let first = vertices.len() as u32;
            vertices.extend_from_slice(&solid.vertices);
            triangles.extend(solid.triangles.iter().map(|t| t.map(|v| first + v)));
        }
        if triangles.is_empty() {
            return Ok(Self { solid: None });
        }
        let solid = Solid::new(&Subject {
            vertices: &vertices,
            triangles: &triangles,
        })?;
        Ok(Self { solid: Some(solid) })
    }

    /// Draws it in a panel; gives the triangles that may stand before bodies.
    pub(super) fn draw(&self, canvas: &mut Canvas, layout: &Layout, panel: &Panel) -> Vec<Facet> {
        let Some(solid) = &self.solid else {
            return Vec::new();
        };
        let [x, y, depth] = panel.place(solid.centre);
        let view = View {
            solid,
            rotation: panel.camera.rows,
            centre: [x, y],
            magnified_scale: panel.scale,
            outline: 1.2 * layout.unit,
            border: 0.0,
            lift: layout.unit,
            paints: SCENERY,
        };
        view.draw(canvas, &panel.plot, Before::default());
        view.facets(depth)
    }
}

/// Draws water and walls.
pub(super) fn draw(canvas: &mut Canvas, layout: &Layout, panel: &Panel) {
    draw_water(canvas, layout, panel);
    draw_walls(canvas, layout, panel);
}

fn draw_water(canvas: &mut Canvas, layout: &Layout, panel: &Panel) {
    let Some(level) = layout.water else {
        return;
    };
    match panel.camera.direction {
        Direction::Front | Direction::Side => draw_section(canvas, layout, panel, level),
        Direction::Top => {
            let pool = layout
                .walls
                .map_or(panel.plot, |walls| on_page(panel, &walls));
            canvas.fill_polygon(&corners(&within(&pool, &panel.plot)), WATER, DEEP);
        }
        Direction::Iso => draw_volume(canvas, layout, panel, level),
    }
}

/// Water seen along its surface.
fn draw_section(canvas: &mut Canvas, layout: &Layout, panel: &Panel, level: f64) {
    let height = |y: f64| panel.place([0.0, y, 0.0])[1];
    let sides = layout
        .walls
        .map_or(panel.plot, |walls| on_page(panel, &walls));
    let bottom = layout.ground.map_or(panel.plot.high[1], height);
    let pool = Area {
        low: [sides.low[0], height(level)],
        high: [sides.high[0], bottom],
    };
    let seen = within(&pool, &panel.plot);
    if seen.height() <= 0.0 {
        return;
    }
    canvas.fill_polygon(&corners(&seen), WATER, DEEP);
    if panel.plot.low[1] < pool.low[1] {
        let line = [seen.low, [seen.high[0], seen.low[1]]];
        canvas.line(&line, WATER_WIDTH * layout.unit, WATER_LINE);
    }
}

/// Water seen from above at an angle: its surface and the two sides that are in front.
fn draw_volume(canvas: &mut Canvas, layout: &Layout, panel: &Panel, level: f64) {
    let room = layout.walls.unwrap_or(layout.bounds);
    let (low, high) = (room.low, room.high);
    let floor = floor(layout);
    let level = level.min(layout.bounds.high[1]);
    if level <= floor {
        return;
    }
    let place = |p: Vec3| {
        let [x, y, _] = panel.place(p);
        [x, y]
    };
    let surface = [
        [low[0], level, high[2]],
        [high[0], level, high[2]],
        [high[0], level, low[2]],
        [low[0], level, low[2]],
    ];
    let outline = [
        [low[0], floor, high[2]],
        [high[0], floor, high[2]],
        [high[0], floor, low[2]],
        surface[2],
        surface[3],
        surface[0],
    ];
    canvas.fill_polygon(&outline.map(place), WATER, DEEP);
    canvas.fill_polygon(&surface.map(place), WATER, SURFACE);
    let [a, b, c, d] = surface;
    let edge = [a, b, c, d, a].map(place);
    canvas.line(&edge, 0.6 * WATER_WIDTH * layout.unit, WATER_LINE);
}

/// The edges of the box between walls.
fn draw_walls(canvas: &mut Canvas, layout: &Layout, panel: &Panel) {
    let Some(walls) = layout.walls else {
        return;
    };
    let width = WALL_WIDTH * layout.unit;
    if panel.camera.direction == Direction::Iso {
        let corners: Vec<Point> = walls
            .corners()
            .map(|corner| {
                let [x, y, _] = panel.place(corner);
                [x, y]
            })
            .collect();
        // Corner i has the high side of axis k where bit k of i is set.
        for axis in [1, 2, 4] {
            for corner in (0..8).filter(|corner| corner & axis == 0) {
                canvas.line(&[corners[corner], corners[corner | axis]], width, WALL);
            }
        }
        return;
    }
    let sides = on_page(panel, &walls);
    if panel.camera.direction == Direction::Top {
        canvas.frame(&sides, width, WALL);
        return;
    }
    for x in [sides.low[0], sides.high[0]] {
        canvas.line(&[[x, sides.low[1]], [x, sides.high[1]]], width, WALL);
    }
}

/// What a box covers in a panel that looks along an axis.
fn on_page(panel: &Panel, walls: &Bounds) -> Area {
    let [a, b] = [walls.low, walls.high].map(|corner| panel.place(corner));
    Area {
        low: [a[0].min(b[0]), a[1].min(b[1])],
        high: [a[0].max(b[0]), a[1].max(b[1])],
    }
}

fn within(area: &Area, plot: &Area) -> Area {
    Area {
        low: std::array::from_fn(|i| area.low[i].clamp(plot.low[i], plot.high[i])),
        high: std::array::from_fn(|i| area.high[i].clamp(plot.low[i], plot.high[i])),
    }
}

fn corners(area: &Area) -> [Point; 4] {
    let Area { low, high } = *area;
    [low, [high[0], low[1]], high, [low[0], high[1]]]
}

/// How far a body may be behind the surface of a solid and not be hidden by it: as much as it is magnified into it, and a
/// little.
pub(super) fn slack(layout: &Layout, radius: f64) -> f64 {
    layout.scale * radius * (layout.magnification - 1.0 + 0.1)
}
