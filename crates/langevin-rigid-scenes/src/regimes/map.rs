//! The map of the regimes as a picture: what the model does, over what experiments found.

use std::f64::consts::PI;

use langevin_rigid_pictures::kinds::{
    Axis, Kind, KindMap, Legend, Mark, Panel, Reference, Region, kind_map,
};
use langevin_rigid_pictures::{Picture, PictureError};

use super::plates::Plate;
use super::published::{Published, UNCERTAINTY};
use super::survey::{Point, REYNOLDS, inertia_ratios};
use crate::ensemble::MotionClass;

/// The grid's outermost points are this factor inside the plot.
const ROOM: f64 = 1.7;

fn kind(motion: MotionClass) -> Kind<'static> {
    let (colour, corners, turn) = match motion {
        MotionClass::Steady => ([120, 128, 140], 4, 0.25 * PI),
        MotionClass::Flutter => ([38, 110, 190], 3, 0.0),
        MotionClass::Chaotic => ([196, 52, 132], 4, 0.0),
        MotionClass::Tumble => ([230, 130, 20], 40, 0.0),
    };
    Kind {
        name: motion.name(),
        colour,
        corners,
        turn,
    }
}

fn heading(plate: Plate) -> String {
    let percent = 100.0 * plate.thickness();
    match plate {
        Plate::Disc => format!("Discs, thickness {percent} % of the diameter"),
        Plate::Strip => format!("Strips, thickness {percent} % of the chord"),
    }
}

fn panel(plate: Plate, points: &[Point]) -> Panel<'static> {
    let wider = |[low, high]: [f64; 2]| [low / ROOM, high * ROOM];
    let (reynolds, inertia) = (wider(REYNOLDS), wider(inertia_ratios(plate)));
    let published = Published::of(plate);
    Panel {
        heading: heading(plate),
        axes: [("Reynolds number", reynolds), ("I*", inertia)]
            .map(|(name, range)| Axis { name, range }),
        regions: regions(published, reynolds, inertia),
        uncertain: uncertain(published, reynolds, inertia),
        boundaries: boundaries(published, reynolds, inertia),
        marks: points
            .iter()
            .filter(|p| p.plate == plate)
            .map(mark)
            .collect(),
        references: published
            .measured
            .iter()
            .map(|plate| Reference {
                place: [plate.reynolds, plate.inertia_ratio],
                kind: kind(plate.motion),
            })
            .collect(),
    }
}

/// Hollow where the releases differ.
fn mark(point: &Point) -> Mark<'static> {
    Mark {
        place: [point.re, point.inertia_ratio],
        kind: kind(point.regime),
        hollow: point.motions.iter().any(|m| *m != point.regime),
        ringed: point.compared && !point.agrees,
    }
}

/// The published regimes.
fn regions(published: &Published, reynolds: [f64; 2], inertia: [f64; 2]) -> Vec<Region<'static>> {
    let ([slow, fast], [light, heavy]) = (reynolds, inertia);
    let region = |motion, area| Region {
        kind: kind(motion),
        area,
    };
    let onset = published.onset;
    let mut regions = vec![region(MotionClass::Steady, [[slow, onset], inertia])];
    let mut from = light;
    for boundary in published.boundaries {
        let area = [[onset, fast], [from, boundary.inertia_ratio]];
        regions.push(region(boundary.below, area));
        from = boundary.inertia_ratio;
    }
    regions.push(region(published.above, [[onset, fast], [from, heavy]]));
    regions
}

/// What is near a published boundary.
fn uncertain(published: &Published, reynolds: [f64; 2], inertia: [f64; 2]) -> Vec<[[f64; 2]; 2]> {
    let about = |x: f64| [x / UNCERTAINTY, x * UNCERTAINTY];
    let beyond = [published.onset * UNCERTAINTY, reynolds[1]];
    let mut areas = vec![[about(published.onset), inertia]];
    let boundaries = published.boundaries.iter();
    areas.extend(boundaries.map(|b| [beyond, about(b.inertia_ratio)]));
    areas
}

fn boundaries(published: &Published, reynolds: [f64; 2], inertia: [f64; 2]) -> Vec<[[f64; 2]; 2]> {
    let onset = published.onset;
    let mut lines = vec![inertia.map(|i| [onset, i])];
    let boundaries = published.boundaries.iter();
    lines.extend(boundaries.map(|b| [onset, reynolds[1]].map(|re| [re, b.inertia_ratio])));
    lines
}

/// Draws the map of the regimes: a panel for discs and one for strips, Re against I*.
///
/// The colour behind a mark is the published regime, the mark the model's.
///
/// # Errors
/// [`PictureError::Font`], of a damaged build alone.
pub fn regime_map(points: &[Point], caption: &str) -> Result<Picture, PictureError> {
    let motions = [
        MotionClass::Steady,
        MotionClass::Flutter,
        MotionClass::Chaotic,
        MotionClass::Tumble,
    ];
    kind_map(&KindMap {
        title: "Regimes of falling plates",
        caption,
        panels: Plate::ALL.map(|plate| panel(plate, points)),
        legend: Legend {
            kinds: motions.map(kind).into(),
            sample: kind(MotionClass::Tumble),
            hollow: "hollow: two of three releases, or none alike",
            reference: "a plate of an experiment",
            ringed: "disagrees with the published regime",
            boundary: "published boundary; pale: not compared, within a factor 1.5 of it",
        },
    })
}
