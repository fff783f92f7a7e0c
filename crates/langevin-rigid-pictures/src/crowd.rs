//! Many bodies at one time, painted from far to near, with the paths of some.

use crate::backdrop::slack;
use crate::camera::Direction;
use crate::canvas::{Canvas, Point};
use crate::cast::{Cast, Player};
use crate::layout::{Layout, Panel};
use crate::numbers::fixed;
use crate::palette::FAINT_PATH;
use crate::placement::Placement;
use crate::raster::{Before, Facet, View};
use crate::vector::scale;
use crate::{legend, shadows};

/// Most paths that are drawn: more are a tangle.
const MOST_PATHS: usize = 32;
/// Page lengths in units.
const PATH_WIDTH: f64 = 1.1;
const STEP: f64 = 1.5;

/// What is drawn of a crowd.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    /// Seconds; who has not been let go by then is not there.
    pub time: f64,
    /// Whether there are paths.
    pub paths: bool,
}

/// A body as one panel shows it.
struct Body<'a> {
    view: View<'a>,
    /// Height of its centre toward the viewer, pixels.
    depth: f64,
    radius: f64,
}

/// Draws the bodies and their paths in one panel.
pub(super) fn draw(
    canvas: &mut Canvas,
    layout: &Layout,
    panel: &Panel,
    cast: &Cast<'_>,
    moment: Moment,
    scenery: &[Facet],
) {
    if moment.paths {
        for player in followed(cast) {
            let path = path(layout, panel, player, moment.time);
            canvas.line(&path, PATH_WIDTH * layout.unit, FAINT_PATH);
        }
    }
    let mut bodies = Vec::new();
    for player in present(cast, moment.time) {
        let solid = cast.solid(player);
        let at = Placement::of(player.track.at(moment.time));
        if panel.camera.direction == Direction::Iso {
            shadows::cast(canvas, layout, panel, solid, player.scale, &at);
        }
        let centre = at.to_world(scale(player.scale, solid.centre));
        bodies.push(Body {
            view: layout.view_of_many(panel, solid, player.scale, &at),
            depth: panel.place(centre)[2],
            radius: player.scale * solid.radius,
        });
    }
    bodies.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    for body in &bodies {
        let before = Before {
            facets: scenery,
            depth: body.depth + slack(layout, body.radius),
        };
        body.view.draw(canvas, &panel.plot, before);
    }
}

/// What is drawn, in words.
pub(super) fn caption(layout: &Layout, cast: &Cast<'_>, moment: Moment) -> String {
    let there = present(cast, moment.time).count();
    let all = cast.players().len();
    let bodies = match all {
        1 => "The body".to_owned(),
        _ if there == all => format!("{all} bodies"),
        _ => format!("{there} of {all} bodies"),
    };
    let (time, size) = (fixed(moment.time, 3), legend::size(layout));
    let paths = followed(cast).count();
    let paths = match moment.paths {
        false => String::new(),
        true if paths == all => "; their paths".to_owned(),
        true => format!("; the paths of {paths}"),
    };
    format!("{bodies} at {time} s, {size}{paths}")
}

/// Those that have been let go.
fn present<'a, 'b>(cast: &'b Cast<'a>, time: f64) -> impl Iterator<Item = &'b Player<'a>> {
    let players = cast.players().iter();
    players.filter(move |player| player.track.start() <= time)
}

/// Those whose paths are drawn, evenly among all.
fn followed<'a, 'b>(cast: &'b Cast<'a>) -> impl Iterator<Item = &'b Player<'a>> {
    let players = cast.players();
    players
        .iter()
        .step_by(players.len().div_ceil(MOST_PATHS).max(1))
}

/// The path until `time`, points a visible distance apart.
fn path(layout: &Layout, panel: &Panel, player: &Player<'_>, time: f64) -> Vec<Point> {
    let track = &player.track;
    if track.start() > time {
        return Vec::new();
    }
    let place = |position| {
        let [x, y, _] = panel.place(position);
        [x, y]
    };
    let mut path: Vec<Point> = Vec::new();
    for pose in track.poses().iter().take_while(|pose| pose.time < time) {
        let next = place(pose.position);
        let far = |last: &Point| {
            let (dx, dy) = (next[0] - last[0], next[1] - last[1]);
            dx * dx + dy * dy >= (STEP * layout.unit).powi(2)
        };
        if path.last().is_none_or(far) {
            path.push(next);
        }
    }
    path.push(place(track.at(time).position));
    path
}
