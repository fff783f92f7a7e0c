//! The times written beside the bodies.

use crate::canvas::{Align, Area, Canvas, Point, TextStyle};
use crate::font::Weight;
use crate::hull::Hull;
use crate::layout::{Layout, Panel};
use crate::numbers::{decimals, fixed};
use crate::palette::TEXT;
use crate::strobe::Instants;

/// Page lengths in units.
const SIZE: f64 = 16.0;
const GAP: f64 = 6.0;
/// A label is this far from any body but its own, so that it is plain whose it is.
const APART: f64 = 10.0;
/// Labels in a panel, beyond which only every second, fifth, ... instant is labelled.
const MOST: usize = 14;

/// What the labels must keep clear of.
pub(super) struct Obstacles<'a> {
    /// The bodies, one for each instant.
    pub bodies: &'a [Hull],
    /// The path, points a few pixels apart.
    pub path: &'a [Point],
    pub marks: Vec<Area>,
}

/// Writes the times beside the bodies where there is room.
pub(super) fn draw(
    canvas: &mut Canvas,
    layout: &Layout,
    panel: &Panel,
    instants: &Instants,
    mut obstacles: Obstacles<'_>,
) {
    let style = TextStyle {
        size: SIZE * layout.unit,
        weight: Weight::Regular,
        colour: TEXT,
        align: Align::Centre,
        halo: 2.5 * layout.unit,
    };
    let room = panel.plot.grown(-2.0 * layout.unit);
    for k in labelled(instants.times.len()) {
        let text = format!(
            "{} s",
            fixed(instants.times[k], decimals(instants.interval).min(4))
        );
        let half = [
            0.5 * canvas.text_width(&text, &style) + 2.0 * layout.unit,
            0.5 * SIZE * layout.unit,
        ];
        let free = |at: &Point| {
            let area = Area::about(*at, half);
            room.covers(&area) && obstacles.leave(k, &area, APART * layout.unit)
        };
        let places = places(&obstacles.bodies[k], half, GAP * layout.unit);
        if let Some(at) = places.into_iter().find(free) {
            canvas.text_beside(&text, at, &style);
            obstacles.marks.push(Area::about(at, half));
        }
    }
}

impl Obstacles<'_> {
    /// Whether the area is clear of everything but the `own` body, and that body not hidden.
    fn leave(&self, own: usize, area: &Area, apart: f64) -> bool {
        let hull = Hull::of_area(area).grown(apart);
        let centre = Hull::of(std::iter::once(self.bodies[own].area().centre()));
        let mut others = self.bodies.iter().enumerate().filter(|(k, _)| *k != own);
        !self.marks.iter().any(|m| m.meets(area))
            && !self.path.iter().any(|p| area.contains(*p))
            && !others.any(|(_, body)| body.meets(&hull) || body.meets(&centre))
    }
}

/// Where a label of the given half size may stand against a body, the best first: near, and
/// rather beside the body than above or below.
fn places(body: &Hull, half: Point, gap: f64) -> Vec<Point> {
    let centre = body.area().centre();
    let far = |at: &Point| {
        let (dx, dy) = (at[0] - centre[0], 3.0 * (at[1] - centre[1]));
        dx * dx + dy * dy
    };
    let mut places = body.against(half, gap);
    places.sort_by(|a, b| far(a).total_cmp(&far(b)));
    places
}

/// The instants that get a label: the first, and every so many after it. A single instant is in
/// the caption.
fn labelled(count: usize) -> impl Iterator<Item = usize> {
    let step = [1, 2, 5, 10, 20, 50]
        .into_iter()
        .find(|s| count <= MOST * s)
        .unwrap_or(100);
    let count = if count > 1 { count } else { 0 };
    (0..count).step_by(step)
}
