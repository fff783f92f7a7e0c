//! The classified discs of Field et al., each point run.

use langevin_rigid_bake::progress::Progress;
use langevin_rigid_scenes::ensemble::MotionClass;
use langevin_rigid_scenes::regimes::{self, Case, Plate, TILTS};

use crate::error::ReportError;
use crate::options::Options;
use crate::section::Section;

/// The classes of the points, from 1.
const CLASSES: [MotionClass; 4] = [
    MotionClass::Steady,
    MotionClass::Flutter,
    MotionClass::Chaotic,
    MotionClass::Tumble,
];
const POINTS: &str = include_str!("../../data/falling-discs.csv");

/// Reynolds number, I*, and what was seen.
fn measured() -> Vec<([f64; 2], MotionClass)> {
    let point = |line: &str| {
        let numbers: Vec<f64> = line.split(',').filter_map(|x| x.parse().ok()).collect();
        let [re, inertia_ratio, class] = numbers[..] else {
            return None;
        };
        Some(([re, inertia_ratio], CLASSES[class as usize - 1]))
    };
    POINTS.lines().filter_map(point).collect()
}

pub(super) fn discs(
    section: &mut Section,
    _: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    section.heading("Discs: every measured point");
    let measured = measured();
    section.text(format!(
        "The {} points of the diagram of Field, Klaus, Moore &amp; Nori (<i>Nature</i> 388, 1997), each released at {} degrees \
         without turbulence; the regime is that of most of the three. Across: what was seen. Down: what comes out.",
        measured.len(),
        TILTS.map(|t| t.to_string()).join(", ")
    ));
    let cases: Vec<Case> = measured
        .iter()
        .flat_map(|&([reynolds, inertia_ratio], _)| {
            TILTS.map(|tilt| Case {
                plate: Plate::Disc,
                reynolds,
                inertia_ratio,
                tilt,
            })
        })
        .collect();
    let runs = regimes::run(&cases, progress)?;
    // The same point measured twice is one point of the runs: looked up by its numbers.
    let points = regimes::points(&runs);
    let regime = |[re, ratio]: [f64; 2]| {
        let same = |p: &&regimes::Point| p.re == re && p.inertia_ratio == ratio;
        points.iter().find(same).map(|p| p.regime)
    };
    let count = |seen: MotionClass, found: MotionClass| {
        let both =
            |(at, class): &&([f64; 2], MotionClass)| *class == seen && regime(*at) == Some(found);
        measured.iter().filter(both).count()
    };
    let mut rows = Vec::new();
    for found in CLASSES {
        let mut row = vec![found.name().to_owned()];
        for seen in CLASSES {
            let key = format!("discs.{}.{}", seen.name(), found.name());
            let number = count(seen, found) as f64;
            row.push(section.quote(key, number, 0).to_string());
        }
        rows.push(row);
    }
    let mut shares = vec!["share that agrees, %".to_owned()];
    let mut agreeing = 0;
    for seen in CLASSES {
        let (right, all) = (
            count(seen, seen),
            measured.iter().filter(|m| m.1 == seen).count(),
        );
        agreeing += right;
        let share = 100.0 * right as f64 / all as f64;
        let key = format!("discs.{}.share", seen.name());
        shares.push(section.quote(key, share, 0).to_string());
    }
    rows.push(shares);
    let all = 100.0 * agreeing as f64 / measured.len() as f64;
    let all = section.quote("discs.share", all, 0);
    let mut last = vec![
        format!("of all {} points, %", measured.len()),
        all.to_string(),
    ];
    last.resize(5, String::new());
    rows.push(last);
    let names = CLASSES.map(MotionClass::name);
    let head: Vec<&str> = ["here"].into_iter().chain(names).collect();
    section.table("discs", &head, &rows);
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_points_are_read() {
        let measured = measured();
        assert_eq!(measured.len(), 347);
        let of = |class| measured.iter().filter(|m| m.1 == class).count();
        assert_eq!(CLASSES.map(of), [82, 167, 71, 27]);
    }
}
