//! `langevin-rigid regimes`

use std::io::Write;
use std::path::Path;
use std::time::Instant;

use anyhow::{Result, bail};
use langevin_rigid_formats::files::{self, Claim};
use langevin_rigid_pictures::{PictureOptions, Pose, Subject, View, trajectory_picture};
use langevin_rigid_scenes::ensemble::MotionClass;
use langevin_rigid_scenes::regimes::{
    self, Agreement, Case, Plate, Point, Published, Run, TILTS, UNCERTAINTY,
};
use serde::Serialize;

use crate::arguments::Regimes;
use crate::bars::Bars;
use crate::say;

/// Length of the path in a strobe picture, diameters or chords.
const STROBE: f64 = 22.0;

/// `regimes.json`.
#[derive(Debug, Serialize)]
struct Report {
    version: &'static str,
    model: &'static str,
    /// Tilts of the releases, degrees.
    tilts: [f64; TILTS.len()],
    /// Runs that were asked for.
    runs: usize,
    /// Runs that came to an end.
    done: usize,
    diverged: usize,
    /// Points within this factor of a published boundary are not compared.
    uncertainty: f64,
    /// Over both kinds of plate.
    #[serde(flatten)]
    agreement: Agreement,
    plates: Vec<Map>,
    warnings: Vec<String>,
    seconds: f64,
}

/// The map of one kind of plate.
#[derive(Debug, Serialize)]
struct Map {
    plate: Plate,
    /// Over the diameter or chord.
    thickness: f64,
    published: &'static Published,
    #[serde(flatten)]
    agreement: Agreement,
    points: Vec<Point>,
}

pub(crate) fn regimes(options: &Regimes, bars: &Bars) -> Result<()> {
    let started = Instant::now();
    let [inertia_ratios, reynolds] = options.grid;
    let cases = regimes::cases(inertia_ratios, reynolds);
    let _claim = Claim::folder(&options.out)?;
    let runs = bars.stoppable(|| regimes::run(&cases, bars))?;
    bars.clear();
    if runs.is_empty() {
        bail!("no run came to an end");
    }
    let points = regimes::points(&runs);
    let report = report(&cases, &runs, &points, started);
    let pictures = write_all(options, &runs, &points, &report)?;
    tell(options, &report, &pictures)?;
    if report.diverged == runs.len() {
        bail!("every run diverged; see {}", options.out.display());
    }
    Ok(())
}

fn report(cases: &[Case], runs: &[Run], points: &[Point], started: Instant) -> Report {
    let mut warnings = Vec::new();
    if runs.len() < cases.len() {
        let (done, asked) = (runs.len(), cases.len());
        warnings.push(format!(
            "interrupted: {done} of {asked} runs came to an end; points without all their runs are missing, and the agreement is of the rest"
        ));
    }
    let mut diverged = 0;
    for Run { case, motion } in runs {
        if let Err(error) = motion {
            diverged += 1;
            let (plate, tilt) = (case.plate.name(), case.tilt);
            warnings.push(format!(
                "the {plate} of I* {:.4} at Re {:.0} from {tilt} degrees is left out: {error}",
                case.inertia_ratio, case.reynolds
            ));
        }
    }
    Report {
        version: env!("CARGO_PKG_VERSION"),
        model: "separated",
        tilts: TILTS,
        runs: cases.len(),
        done: runs.len(),
        diverged,
        uncertainty: UNCERTAINTY,
        agreement: Agreement::of(points.iter()),
        plates: Plate::ALL.map(|plate| map(plate, points)).into(),
        warnings,
        seconds: started.elapsed().as_secs_f64(),
    }
}

fn map(plate: Plate, points: &[Point]) -> Map {
    let points: Vec<Point> = points
        .iter()
        .filter(|p| p.plate == plate)
        .cloned()
        .collect();
    Map {
        plate,
        thickness: plate.thickness(),
        published: Published::of(plate),
        agreement: Agreement::of(points.iter()),
        points,
    }
}

/// The table first: it is what the rest is made of. Gives the names of the pictures.
fn write_all(
    options: &Regimes,
    runs: &[Run],
    points: &[Point],
    report: &Report,
) -> Result<Vec<String>> {
    let folder = &options.out;
    files::write(&folder.join("regimes.csv"), regimes::csv(runs).as_bytes())?;
    let json = serde_json::to_string_pretty(report)? + "\n";
    files::write(&folder.join("regimes.json"), json.as_bytes())?;
    let map = regimes::regime_map(points, &caption(report))?;
    files::write(&folder.join("regimes.png"), &map.png()?)?;
    let mut pictures = vec!["regimes.png".to_owned()];
    for motion in MotionClass::ALL {
        if let Some(case) = typical(motion, runs, points) {
            let name = format!("strobe-{}.png", motion.name());
            strobe(&folder.join(&name), motion, case)?;
            pictures.push(name);
        }
    }
    Ok(pictures)
}

fn caption(report: &Report) -> String {
    let Agreement {
        compared, agreeing, ..
    } = report.agreement;
    format!(
        "Marks: the model {}. Colour behind them: experiments. {agreeing} of {compared} compared \
         points agree.",
        report.model
    )
}

/// A run of this motion: of a point in the middle of those whose releases are of one mind and agree
/// with experiments, or at least are of one mind; discs before strips.
fn typical<'a>(motion: MotionClass, runs: &'a [Run], points: &[Point]) -> Option<&'a Case> {
    let middle = |plate: Plate, confirmed: bool| {
        let fits = |p: &&Point| {
            p.plate == plate
                && p.motions == [motion; TILTS.len()]
                && (!confirmed || p.compared && p.agrees)
        };
        let fitting: Vec<&Point> = points.iter().filter(fits).collect();
        fitting.get(fitting.len() / 2).copied()
    };
    let confirmed = Plate::ALL.into_iter().find_map(|p| middle(p, true));
    let point = confirmed.or_else(|| Plate::ALL.into_iter().find_map(|p| middle(p, false)))?;
    let mut cases = runs.iter().map(|r| &r.case);
    cases.find(|c| {
        (c.plate, c.reynolds, c.inertia_ratio) == (point.plate, point.re, point.inertia_ratio)
    })
}

fn strobe(path: &Path, motion: MotionClass, case: &Case) -> Result<()> {
    let states = case.path(STROBE)?;
    let start = states.first().map_or(0.0, |s| s.time);
    let origin = states.first().map_or([0.0; 3], |s| s.position);
    let poses: Vec<Pose> = states
        .iter()
        .map(|s| Pose {
            time: s.time - start,
            position: std::array::from_fn(|i| s.position[i] - origin[i]),
            orientation: s.orientation,
        })
        .collect();
    let surface = case.plate.drawn(&case.body());
    let subject = Subject {
        vertices: &surface.vertices,
        triangles: &surface.triangles,
    };
    let width = match case.plate {
        Plate::Disc => "diameter",
        Plate::Strip => "chord",
    };
    let title = format!(
        "Settled {}: a {} of {width} 1 m, I* {:.3}, Re {:.0}",
        motion.name(),
        case.plate.name(),
        case.inertia_ratio,
        case.reynolds
    );
    let options = PictureOptions {
        title: Some(title),
        view: View::Front,
        ..PictureOptions::default()
    };
    let picture = trajectory_picture(&subject, &poses, &options)?;
    files::write(path, &picture.png()?)?;
    Ok(())
}

fn tell(options: &Regimes, report: &Report, pictures: &[String]) -> Result<()> {
    for warning in &report.warnings {
        say::warning(warning);
    }
    let mut out = say::out();
    if options.json {
        writeln!(out, "{}", serde_json::to_string_pretty(report)?)?;
        return Ok(());
    }
    writeln!(
        out,
        "{} runs ({}), {} diverged, in {:.3} s",
        report.done, report.model, report.diverged, report.seconds
    )?;
    let maps = report.plates.iter();
    let maps = maps.map(|m| (format!("{}s", m.plate.name()), &m.agreement));
    for (name, agreement) in maps.chain([("together".to_owned(), &report.agreement)]) {
        writeln!(out, "  {name}: {}", in_words(agreement))?;
    }
    writeln!(
        out,
        "  wrote regimes.csv, regimes.json, {} to {}",
        pictures.join(", "),
        options.out.display()
    )?;
    Ok(())
}

fn in_words(agreement: &Agreement) -> String {
    match agreement.agreement {
        Some(share) => format!(
            "{} of {} points outside a factor {UNCERTAINTY} of the published boundaries agree ({:.0} %)",
            agreement.agreeing,
            agreement.compared,
            100.0 * share
        ),
        None => format!("no point is outside a factor {UNCERTAINTY} of the published boundaries"),
    }
}
