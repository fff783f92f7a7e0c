//! Many bodies at one time, painted from far to near, with the paths of some.

use crate::backdrop::{Backdrop, slack};
use crate::camera::Direction;
use crate::canvas::{Canvas, Point};
use crate::cast::{Cast, Player};
use crate::layout::{Layout, Panel};
use crate::numbers::{fine_above, fixed, short};
use crate::palette::FAINT_PATH;
use crate::placement::Placement;
use crate::raster::{Before, View};
use crate::vector::{norm, scale, sub};
use crate::{PictureOptions, Pose, legend, shadows};

/// Most paths that are drawn: more are a tangle.
const MOST_PATHS: usize = 32;
/// Most instants at which one of these bodies is drawn.
const MOST_INSTANTS: u32 = 256;
/// Page lengths in units.
const PATH_WIDTH: f64 = 1.1;
const STEP: f64 = 1.5;

/// Times that a body is drawn on its way.
const ON_THE_WAY: f64 = 3.0;

/// What is drawn of a crowd.
#[derive(Clone, Copy, Debug)]
pub(super) struct Moment {
    /// Seconds; who has not been let go by then is not there.
    pub time: f64,
    /// Whether there are paths, of some.
    pub paths: bool,
    /// Time between two instants at which those are drawn on their way too, s.
    pub interval: Option<f64>,
}

impl Moment {
    /// The end of all motion, with what the options want before it.
    pub(super) fn end(cast: &Cast<'_>, layout: &Layout, options: &PictureOptions) -> Self {
        let mut falls: Vec<f64> = followed(cast)
            .map(|player| arrival(layout, cast, player) - player.track.start())
            .filter(|fall| *fall > 0.0)
            .collect();
        falls.sort_by(f64::total_cmp);
        let usual = falls.get(falls.len() / 2);
        let usual = usual.map(|fall| fine_above(fall / ON_THE_WAY));
        Self {
            time: cast.end(),
            paths: options.path,
            interval: options
                .interval
                .filter(|interval| *interval > 0.0)
                .or(usual)
                .filter(|_| options.max_instants > 0),
        }
    }
}

/// A body as one panel shows it.
struct Body<'a> {
    view: View<'a>,
    /// Height of its centre toward the viewer, pixels.
    depth: f64,
    radius: f64,
}

/// Draws the bodies and their paths in one panel, and the solids between their shadows and them.
pub(super) fn draw(
    canvas: &mut Canvas,
    layout: &Layout,
    panel: &Panel,
    cast: &Cast<'_>,
    moment: Moment,
    backdrop: &Backdrop,
) {
    let now = present(cast, moment.time).map(|player| (player, moment.time));
    let mut bodies = Vec::new();
    for (player, time) in now.chain(before(layout, cast, moment)) {
        let solid = cast.solid(player);
        let at = Placement::of(player.track.at(time));
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
    let scenery = backdrop.draw(canvas, layout, panel);
    if moment.paths {
        for player in followed(cast) {
            let path = path(layout, panel, player, moment.time);
            canvas.line(&path, PATH_WIDTH * layout.unit, FAINT_PATH);
        }
    }
    bodies.sort_by(|a, b| a.depth.total_cmp(&b.depth));
    for body in &bodies {
        let before = Before {
            facets: &scenery,
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
    let some = followed(cast).count();
    let some = match some == all {
        true => "all".to_owned(),
        false => format!("{some} of them"),
    };
    let before = match (moment.interval, moment.paths) {
        (Some(interval), _) => format!("; {some} every {} s on their way", short(interval)),
        (None, true) => format!("; the paths of {some}"),
        (None, false) => String::new(),
    };
    format!("{bodies} at {time} s, {size}{before}")
}

/// Bodies on their way, and when.
fn before<'a, 'b>(
    layout: &Layout,
    cast: &'b Cast<'a>,
    moment: Moment,
) -> Vec<(&'b Player<'a>, f64)> {
    let Some(interval) = moment.interval else {
        return Vec::new();
    };
    let of = |player: &'b Player<'a>| {
        let (start, end) = (player.track.start(), arrival(layout, cast, player));
        let times = (0..MOST_INSTANTS).map(move |k| start + f64::from(k) * interval);
        let on_the_way = times.take_while(move |time| *time < end);
        on_the_way.map(move |time| (player, time))
    };
    followed(cast).flat_map(of).collect()
}

/// When a body has come to where it ends, but for its own size as drawn.
fn arrival(layout: &Layout, cast: &Cast<'_>, player: &Player<'_>) -> f64 {
    let reach = 2.0 * layout.magnification * player.scale * cast.solid(player).radius;
    let poses = player.track.poses();
    let end = poses[poses.len() - 1].position;
    let away = |pose: &&Pose| norm(sub(pose.position, end)) > reach;
    let last = poses.iter().rev().find(away);
    last.map_or(player.track.start(), |pose| pose.time)
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
