//! Shadows on the floor of a view from above at an angle.

use crate::axes::floor;
use crate::canvas::{Canvas, Point};
use crate::layout::{Layout, Panel};
use crate::palette::{FRAME, SHADOW};
use crate::placement::Placement;
use crate::solid::Solid;
use crate::vector::{Vec3, add, mat_vec, scale};

/// Sizes of the layers that make the edge of a shadow soft.
const LAYERS: [f64; 4] = [1.16, 1.08, 1.0, 0.92];

/// What the bodies and the path cast straight down on the floor, paler from higher up.
pub(super) fn draw(
    canvas: &mut Canvas,
    layout: &Layout,
    panel: &Panel,
    solid: &Solid,
    bodies: &[Placement],
    path: &[Vec3],
) {
    for body in bodies {
        cast(canvas, layout, panel, solid, 1.0, body);
    }
    let reach = layout.magnification * solid.radius;
    // It is in two parts where the body goes into water.
    let floor = |p: &Vec3| under(layout, *p, reach);
    for part in path.chunk_by(|a, b| floor(a) == floor(b)) {
        let track = part.iter().map(|p| fall(panel, *p, floor(p)));
        let track: Vec<Point> = track.collect();
        canvas.line(&track, 1.2 * layout.unit, FRAME);
    }
}

/// The shadow of one body of so many times its kind's size.
pub(super) fn cast(
    canvas: &mut Canvas,
    layout: &Layout,
    panel: &Panel,
    solid: &Solid,
    size: f64,
    body: &Placement,
) {
    let centre = body.to_world(scale(size, solid.centre));
    let reach = size * layout.magnification * solid.radius;
    let floor = under(layout, centre, reach);
    let height = (layout.bounds.high[1] - floor).max(f64::MIN_POSITIVE);
    let strength = 0.22 - 0.16 * ((centre[1] - floor) / height).clamp(0.0, 1.0);
    let cast = |v: &Vec3| {
        let offset = scale(size * layout.magnification, mat_vec(&body.rotation, *v));
        fall(panel, add(centre, offset), floor)
    };
    let hull = convex_hull(solid.vertices.iter().map(cast).collect());
    draw_one(canvas, &hull, fall(panel, centre, floor), strength);
}

/// The height on which a body of radius `reach` casts its shadow: the water if it is not all under that.
fn under(layout: &Layout, [_, height, _]: Vec3, reach: f64) -> f64 {
    let water = layout.water.filter(|level| height + reach >= *level);
    water.unwrap_or_else(|| floor(layout))
}

fn fall(panel: &Panel, [x, _, z]: Vec3, floor: f64) -> Point {
    let [x, y, _] = panel.place([x, floor, z]);
    [x, y]
}

fn draw_one(canvas: &mut Canvas, outline: &[Point], foot: Point, strength: f64) {
    for size in LAYERS {
        let layer = outline
            .iter()
            .map(|p| std::array::from_fn(|i| foot[i] + size * (p[i] - foot[i])));
        let layer: Vec<Point> = layer.collect();
        canvas.fill_polygon(&layer, SHADOW, strength / LAYERS.len() as f64);
    }
}

/// The corners of the convex hull, in order, by the monotone chain.
fn convex_hull(mut points: Vec<Point>) -> Vec<Point> {
    points.sort_by(|a, b| a[0].total_cmp(&b[0]).then(a[1].total_cmp(&b[1])));
    let turn = |o: Point, a: Point, b: Point| {
        (a[0] - o[0]) * (b[1] - o[1]) - (a[1] - o[1]) * (b[0] - o[0])
    };
    let half = |points: &mut dyn Iterator<Item = &Point>| {
        let mut chain: Vec<Point> = Vec::new();
        for p in points {
            while chain.len() >= 2
                && turn(chain[chain.len() - 2], chain[chain.len() - 1], *p) <= 0.0
            {
                chain.pop();
            }
            chain.push(*p);
        }
        chain.pop();
        chain
    };
    let mut hull = half(&mut points.iter());
    hull.extend(half(&mut points.iter().rev()));
    hull
}
