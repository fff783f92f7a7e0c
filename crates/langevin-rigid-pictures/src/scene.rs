//! What moves: the path and the bodies at their instants, painted from far to near.

use crate::backdrop::{Backdrop, slack};
use crate::camera::Direction;
use crate::canvas::{Area, Canvas, Point};
use crate::hull::Hull;
use crate::labels::{self, Obstacles};
use crate::layout::{Layout, Panel};
use crate::palette::{PAGE, path as path_colour};
use crate::placement::Placement;
use crate::raster::{Before, Facet, View};
use crate::shadows;
use crate::solid::Solid;
use crate::strobe::Instants;
use crate::vector::{norm, sub};
use langevin_rigid_formats::track::Track;

/// Page lengths in units.
const PATH_WIDTH: f64 = 3.4;
const PATH_BORDER: f64 = 1.6;
const PIECE: f64 = 7.0;
const MARK: f64 = 7.0;

/// A body at its instant, as one panel shows it.
struct Body<'a> {
    view: View<'a>,
    /// Corners on the page and their height above the centre's, pixels.
    points: Vec<[f64; 3]>,
    hull: Hull,
    placement: Placement,
    /// Height of its centre toward the viewer, pixels.
    depth: f64,
}

/// A stretch of the path short enough to be wholly before or behind a body.
struct Piece {
    points: Vec<Point>,
    /// Fraction of the motion's time.
    when: f64,
    depth: f64,
    order: Order,
}

/// How a piece of the path lies to the bodies about it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Order {
    Free,
    Under,
    Over,
}

/// One thing to paint; order in time decides between things equally far.
enum Item<'a, 'b> {
    Piece(&'b Piece),
    Body(&'b Body<'a>),
}

/// How much of the path is drawn.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) enum Trail {
    None,
    Whole,
    /// As far as the body has come at this time, seconds; without labels, as in a film.
    Until(f64),
}

/// What is drawn of a body's motion.
#[derive(Clone, Copy, Debug)]
pub(super) struct Motion<'a> {
    pub solid: &'a Solid,
    pub track: &'a Track<'a>,
    pub instants: &'a Instants,
    pub trail: Trail,
}

/// Draws path and bodies in one panel, and the solids between their shadows and them.
pub(super) fn draw(
    canvas: &mut Canvas,
    layout: &Layout,
    panel: &Panel,
    motion: &Motion<'_>,
    backdrop: &Backdrop,
) {
    let Motion {
        solid,
        track,
        instants,
        trail,
    } = *motion;
    let bodies: Vec<Body<'_>> = instants
        .times
        .iter()
        .map(|t| body(layout, panel, solid, Placement::of(track.at(*t))))
        .collect();
    let places = places(layout, panel, track, trail);
    let pieces = pieces(layout, solid, &places, &bodies);
    if panel.camera.direction == Direction::Iso {
        let placements: Vec<Placement> = bodies.iter().map(|b| b.placement).collect();
        let path: Vec<[f64; 3]> = places.iter().map(|p| p.world).collect();
        shadows::draw(canvas, layout, panel, solid, &placements, &path);
    }
    let scenery = backdrop.draw(canvas, layout, panel);
    paint(canvas, layout, panel, &pieces, &bodies, &scenery);
    if let Trail::Until(_) = trail {
        return;
    }
    let marks = match trail {
        Trail::Whole => draw_marks(canvas, layout, panel, track),
        _ => Vec::new(),
    };
    let hulls: Vec<Hull> = bodies.iter().map(|b| b.hull).collect();
    let path: Vec<Point> = pieces.iter().flat_map(|p| p.points.clone()).collect();
    let obstacles = Obstacles {
        bodies: &hulls,
        path: &path,
        marks,
    };
    labels::draw(canvas, layout, panel, instants, obstacles);
}

fn body<'a>(layout: &Layout, panel: &Panel, solid: &'a Solid, placement: Placement) -> Body<'a> {
    let view = layout.view(panel, solid, &placement);
    Body {
        points: view.points(),
        hull: view.hull(),
        depth: panel.place(placement.to_world(solid.centre))[2],
        view,
        placement,
    }
}

/// A point of the path: where it is in the world and on the page, and when.
#[derive(Clone, Copy, Debug)]
struct Place {
    world: [f64; 3],
    on_page: [f64; 3],
    when: f64,
}

/// The points of the path a visible distance apart.
fn places(layout: &Layout, panel: &Panel, track: &Track<'_>, trail: Trail) -> Vec<Place> {
    let poses = track.poses();
    let until = match trail {
        Trail::None => return Vec::new(),
        Trail::Whole => track.end(),
        Trail::Until(time) => time,
    };
    let place = |position: [f64; 3], time: f64| Place {
        world: position,
        on_page: panel.place(position),
        when: (time - track.start()) / duration(track),
    };
    let least = 0.4 * layout.unit;
    let mut places: Vec<Place> = Vec::new();
    for pose in poses.iter().take_while(|p| p.time < until) {
        let next = place(pose.position, pose.time);
        let far = |p: &Place| norm(sub(p.on_page, next.on_page)) >= least;
        if places.last().is_none_or(far) {
            places.push(next);
        }
    }
    places.push(place(track.at(until).position, until));
    places
}

fn duration(track: &Track<'_>) -> f64 {
    (track.end() - track.start()).max(f64::MIN_POSITIVE)
}

fn pieces(layout: &Layout, solid: &Solid, places: &[Place], bodies: &[Body<'_>]) -> Vec<Piece> {
    let longest = PIECE * layout.unit;
    let steps = subdivided(places, longest);
    let mut pieces = Vec::new();
    let mut first = 0;
    for last in 1..steps.len() {
        let length = norm(sub(steps[last].on_page, steps[first].on_page));
        if length >= 0.9 * longest || last + 1 == steps.len() {
            pieces.push(piece(layout, solid, bodies, &steps[first..=last]));
            first = last;
        }
    }
    pieces
}

/// The path with more points, none farther than `longest` from the next on the page.
fn subdivided(places: &[Place], longest: f64) -> Vec<Place> {
    let between = |[a, b]: [&Place; 2], w: f64| Place {
        world: std::array::from_fn(|i| a.world[i] + w * (b.world[i] - a.world[i])),
        on_page: std::array::from_fn(|i| a.on_page[i] + w * (b.on_page[i] - a.on_page[i])),
        when: a.when + w * (b.when - a.when),
    };
    let mut steps: Vec<Place> = places.first().copied().into_iter().collect();
    for pair in places.windows(2) {
        let length = norm(sub(pair[1].on_page, pair[0].on_page));
        let parts = (length / longest).ceil().clamp(1.0, 2000.0) as usize;
        let along = |k: usize| between([&pair[0], &pair[1]], k as f64 / parts as f64);
        steps.extend((1..=parts).map(along));
    }
    steps
}

fn piece(layout: &Layout, solid: &Solid, bodies: &[Body<'_>], steps: &[Place]) -> Piece {
    let middle = &steps[steps.len() / 2];
    let (depth, order) = order(layout, solid, bodies, middle);
    Piece {
        points: steps.iter().map(|p| [p.on_page[0], p.on_page[1]]).collect(),
        when: middle.when,
        depth,
        order,
    }
}

/// The depth at which a point of the path is painted: under a body that it is inside or behind,
/// over one that it is in front of, however their centres lie.
fn order(layout: &Layout, solid: &Solid, bodies: &[Body<'_>], place: &Place) -> (f64, Order) {
    let reach = layout.magnification * solid.radius;
    let near =
        |body: &&Body<'_>| norm(sub(place.world, body.placement.to_world(solid.centre))) < reach;
    let (over, under): (Vec<&Body<'_>>, Vec<&Body<'_>>) = bodies
        .iter()
        .filter(near)
        .partition(|body| body.is_behind(place.on_page));
    let under = under.iter().map(|b| b.depth).reduce(f64::min);
    let over = over.iter().map(|b| b.depth).reduce(f64::max);
    match (under, over) {
        (Some(depth), _) => (depth, Order::Under),
        (None, Some(depth)) => (depth.max(place.on_page[2]).next_up(), Order::Over),
        (None, None) => (place.on_page[2], Order::Free),
    }
}

impl Body<'_> {
    /// Whether the whole body is behind a point of the page at the given height that it covers.
    fn is_behind(&self, [x, y, height]: [f64; 3]) -> bool {
        if !self.hull.area().contains([x, y]) {
            return false;
        }
        let height_in = |&[a, b, c]: &[usize; 3]| {
            height_in([self.points[a], self.points[b], self.points[c]], [x, y])
        };
        let heights = self.view.solid.triangles.iter().filter_map(height_in);
        let highest = heights.reduce(f64::max);
        highest.is_some_and(|surface| self.depth + surface < height)
    }
}

/// The height of a triangle over a point of the page, where it covers that point.
fn height_in([a, b, c]: [[f64; 3]; 3], [x, y]: Point) -> Option<f64> {
    let cross = |p: [f64; 3], q: [f64; 3]| (p[0] - x) * (q[1] - y) - (q[0] - x) * (p[1] - y);
    let (wa, wb, wc) = (cross(b, c), cross(c, a), cross(a, b));
    let area = wa + wb + wc;
    let inside = (wa >= 0.0) == (wb >= 0.0) && (wb >= 0.0) == (wc >= 0.0) && area != 0.0;
    inside.then(|| (wa * a[2] + wb * b[2] + wc * c[2]) / area)
}

fn paint(
    canvas: &mut Canvas,
    layout: &Layout,
    panel: &Panel,
    pieces: &[Piece],
    bodies: &[Body<'_>],
    scenery: &[Facet],
) {
    let mut items: Vec<(f64, Item<'_, '_>)> = pieces
        .iter()
        .map(|p| (p.depth, Item::Piece(p)))
        .chain(bodies.iter().map(|b| (b.depth, Item::Body(b))))
        .collect();
    // The sort is stable: at one depth the path lies under the bodies, and later over earlier.
    items.sort_by(|a, b| a.0.total_cmp(&b.0));
    for (_, item) in items {
        match item {
            Item::Body(body) => {
                let before = Before {
                    facets: scenery,
                    depth: body.depth + slack(layout, body.view.solid.radius),
                };
                body.view.draw(canvas, &panel.plot, before);
            }
            Item::Piece(piece) => {
                let width = PATH_WIDTH * layout.unit;
                let border = width + 2.0 * PATH_BORDER * layout.unit;
                if piece.order != Order::Over {
                    canvas.line(&piece.points, border, PAGE);
                }
                canvas.round_line(&piece.points, width, path_colour(piece.when));
            }
        }
    }
}

/// A ring at the start of the path and a dot at its end; gives the areas they cover.
fn draw_marks(canvas: &mut Canvas, layout: &Layout, panel: &Panel, track: &Track<'_>) -> Vec<Area> {
    let radius = MARK * layout.unit;
    let mark = |time: f64| {
        let [x, y, _] = panel.place(track.at(time).position);
        [x, y]
    };
    let (start, end) = (mark(track.start()), mark(track.end()));
    end_mark(canvas, end, radius);
    if track.end() > track.start() {
        start_mark(canvas, start, radius);
    }
    [start, end]
        .map(|p| Area { low: p, high: p }.grown(radius))
        .to_vec()
}

pub(super) fn start_mark(canvas: &mut Canvas, centre: Point, radius: f64) {
    canvas.disc(centre, 1.2 * radius, PAGE, 0.0, PAGE);
    canvas.disc(centre, radius, PAGE, 0.42 * radius, path_colour(0.75));
}

pub(super) fn end_mark(canvas: &mut Canvas, centre: Point, radius: f64) {
    canvas.disc(centre, 1.2 * radius, PAGE, 0.0, PAGE);
    canvas.disc(centre, radius, path_colour(1.0), 0.0, path_colour(1.0));
}
