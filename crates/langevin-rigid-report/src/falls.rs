//! Figs. 3, 4 and 5: falls under every reading, drawn, plotted, measured and judged.

use std::fmt::Write;

use langevin_rigid::State;
use langevin_rigid::linalg::vector::norm;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::trajectory::{Trajectory, csv};
use langevin_rigid_pictures::View;

use crate::chart::{Chart, Curve};
use crate::error::ReportError;
use crate::measures::{Axes, FIELDS, Field, Measures, Scale};
use crate::options::Options;
use crate::paper;
use crate::runs::{
    CONSISTENT, CONSISTENT_HISTORY, Fall, KIRCHHOFF, READINGS, Reading, SEPARATED, Setting, typical,
};
use crate::section::{Claim, Section, figure};
use crate::spread::Spread;

/// Share of the seeds from which a statement counts as reproduced, and as partly reproduced.
const REPRODUCED: f64 = 0.5;
const PARTLY: f64 = 0.1;

/// The rule of the verdicts, in words.
pub(crate) const RULE: &str = "Verdicts follow from the numbers by one rule: what the paper says in \
    words is put as a condition on measures of the path, given with each statement. It is \
    <b>reproduced</b> under a reading if at least half of the seeds meet the condition, <b>partly</b> \
    if at least a tenth, and <b>not</b> otherwise; a run that diverges does not meet it. \
    Where the paper has a motion at one release angle and not at the other, its condition is counted at \
    both: a control of whether the angle decides.";

/// A scene of a figure.
struct Shown {
    scene: &'static str,
    heading: &'static str,
    /// Readings whose typical run is drawn and plotted.
    drawn: &'static [Reading],
    view: View,
    /// Keys of the measures in the table.
    columns: &'static [&'static str],
    scale: Scale,
    statements: &'static [Statement],
}

/// Something the paper says in words, as a condition.
struct Statement {
    key: &'static str,
    words: &'static str,
    condition: &'static str,
    /// Whether it is about Kirchhoff's equations alone, or about all other readings.
    kirchhoff: bool,
    /// Whether it is counted without a verdict, to see what else meets a condition.
    control: bool,
    holds: fn(&Measures) -> bool,
}

const fn rolls(words: &'static str) -> Statement {
    Statement {
        key: "rolls",
        words,
        condition: "at least one net turn about the long axis, which has most of the mean square spin",
        kirchhoff: false,
        control: false,
        holds: |m| m.rolls >= 1.0 && m.roll_share > 0.5,
    }
}

const ROLLS_75: Statement =
    rolls("Released at 75 degrees it rotates around its long axis while falling.");
const ROLLS_30: Statement =
    rolls("Released at 30 degrees it rotates around its long axis while falling.");

const SHEET: &[&str] = &[
    "fall_speed",
    "drift",
    "turns",
    "winding",
    "radius",
    "pitch",
    "reversals",
    "revolutions",
    "rolls",
    "roll_share",
];

const HELIX: Statement = Statement {
    key: "helix",
    words: "Released at 75 degrees the sheet follows a helical trajectory.",
    condition: "the path turns about the vertical at least once, and at least 70 % of its turning is \
                in one sense",
    kirchhoff: false,
    control: false,
    holds: |m| m.turns >= 1.0 && m.winding >= 0.7,
};

const SIDE_TO_SIDE: Statement = Statement {
    key: "side-to-side",
    words: "Released at 30 degrees it falls in a side-to-side tumbling motion.",
    condition: "at least two reversals of a quarter of the body's length or more, and at least one \
                revolution end over end",
    kirchhoff: false,
    control: false,
    holds: |m| m.reversals >= 2.0 && m.revolutions >= 1.0,
};

const TURNS_FRONT: Statement = Statement {
    key: "turns-front",
    words: "The airplane turns front.",
    condition: "it turns nose over tail by at least a quarter turn",
    kirchhoff: false,
    control: false,
    holds: |m| m.pitch_turn >= 90.0,
};

const TURNS_SIDEWAYS: Statement = Statement {
    key: "turns-sideways",
    words: "The airplane turns sideways.",
    condition: "the heading of its path turns by at least a quarter turn, and the path leaves the vertical \
                plane of the launch by a body length or more",
    kirchhoff: false,
    control: false,
    holds: |m| m.heading_turn >= 90.0 && m.sideways >= 1.0,
};

const FLUTTERS: Statement = Statement {
    key: "flutters",
    words: "With Kirchhoff's equations alone the ellipsoid flutters a little, in one direction.",
    condition: "at least two reversals of a fortieth of the body's length or more along the main \
                direction and none across it, in swings narrower than the body is long",
    kirchhoff: true,
    control: false,
    holds: |m| m.reversals >= 2.0 && m.cross_reversals == 0.0 && m.amplitude < 0.04,
};

const OSCILLATES: Statement = Statement {
    key: "oscillates",
    words: "The full method has oscillations in different directions.",
    condition: "at least two reversals of a fortieth of the body's length or more in each of two \
                directions at right angles",
    kirchhoff: false,
    control: false,
    holds: |m| m.reversals >= 2.0 && m.cross_reversals >= 2.0,
};

/// What the paper has at one release angle alone, counted at the other.
const HELIX_AT_30: Statement = Statement {
    key: "helix",
    words: "Control: the helix of (a) at 30 degrees.",
    control: true,
    ..HELIX
};
const SIDE_TO_SIDE_AT_75: Statement = Statement {
    key: "side-to-side",
    words: "Control: the side-to-side tumbling of (b) at 75 degrees.",
    control: true,
    ..SIDE_TO_SIDE
};

/// The sheet at two release angles.
pub(crate) fn fig3(options: &Options, progress: &dyn Progress) -> Result<Section, ReportError> {
    const fn sheet(
        scene: &'static str,
        heading: &'static str,
        statements: &'static [Statement],
    ) -> Shown {
        Shown {
            scene,
            heading,
            drawn: &[CONSISTENT, CONSISTENT_HISTORY, SEPARATED],
            view: View::Iso,
            columns: SHEET,
            scale: Scale::SHEET,
            statements,
        }
    }
    let scenes = [
        sheet(
            "paper-75",
            "(a) Released at 75 degrees",
            &[HELIX, ROLLS_75, SIDE_TO_SIDE_AT_75],
        ),
        sheet(
            "paper-30",
            "(b) Released at 30 degrees",
            &[SIDE_TO_SIDE, ROLLS_30, HELIX_AT_30],
        ),
    ];
    let mut section = Section::new("fig3", "Fig. 3: a sheet of paper in air");
    section.paper(paper::FIG3_WORDS, "section 7");
    section.paper(paper::LIMITS_WORDS, "section 8");
    add_scenes(&mut section, &scenes, options, progress)?;
    Ok(section)
}

/// The paper airplane.
pub(crate) fn fig4(options: &Options, progress: &dyn Progress) -> Result<Section, ReportError> {
    let scene = Shown {
        scene: "airplane",
        heading: "Launched at 20 cm/s",
        drawn: &[CONSISTENT, SEPARATED],
        view: View::FrontAndSide,
        columns: &[
            "fall_speed",
            "drift",
            "pitch_turn",
            "heading_turn",
            "sideways",
            "revolutions",
            "rolls",
            "spin",
        ],
        scale: Scale::SHEET,
        statements: &[TURNS_FRONT, TURNS_SIDEWAYS],
    };
    let mut section = Section::new("fig4", "Fig. 4: a paper airplane");
    section.paper(paper::FIG4_WORDS, "section 7");
    add_scenes(&mut section, &[scene], options, progress)?;
    Ok(section)
}

/// The rubber ellipsoid, without and with the turbulence.
pub(crate) fn fig5(options: &Options, progress: &dyn Progress) -> Result<Section, ReportError> {
    let scene = Shown {
        scene: "ellipsoid-water",
        heading: "Every 50 ms: Kirchhoff's equations alone against the full method",
        drawn: &[KIRCHHOFF, CONSISTENT, SEPARATED],
        view: View::FrontAndSide,
        columns: &[
            "fall_speed",
            "drift",
            "reversals",
            "cross_reversals",
            "amplitude",
            "rolls",
            "spin",
        ],
        scale: Scale::ELLIPSOID,
        statements: &[FLUTTERS, OSCILLATES],
    };
    let mut section = Section::new("fig5", "Fig. 5: a rubber ellipsoid in water");
    section.paper(paper::FIG5_WORDS, "section 7");
    add_scenes(&mut section, &[scene], options, progress)?;
    Ok(section)
}

/// All falls of a scene under one reading.
struct Ensemble {
    reading: Reading,
    falls: Vec<Fall>,
    /// Of each fall; none of one that diverged.
    measures: Vec<Option<Measures>>,
}

impl Ensemble {
    fn good(&self) -> impl Iterator<Item = &Measures> {
        self.measures.iter().flatten()
    }

    fn diverged(&self) -> usize {
        self.falls.iter().filter(|f| f.diverged()).count()
    }

    fn spread(&self, value: fn(&Measures) -> f64) -> Spread {
        Spread::new(self.good().map(value).collect())
    }
}

fn add_scenes(
    section: &mut Section,
    scenes: &[Shown],
    options: &Options,
    progress: &dyn Progress,
) -> Result<(), ReportError> {
    for shown in scenes {
        let setting = Setting::new(shown.scene, options, progress)?;
        let axes = Axes::new(&setting.baked.bake.body);
        let ensembles = READINGS
            .iter()
            .map(|reading| {
                let falls = setting.falls(reading, options, progress)?;
                let measures = falls
                    .iter()
                    .map(|f| (!f.diverged()).then(|| Measures::new(&axes, &f.states, &shown.scale)))
                    .collect();
                Ok(Ensemble {
                    reading: *reading,
                    falls,
                    measures,
                })
            })
            .collect::<Result<Vec<Ensemble>, ReportError>>()?;
        section.heading(shown.heading);
        for statement in shown.statements {
            judge(section, shown, statement, &ensembles);
        }
        draw(section, shown, &setting, &ensembles)?;
        plot(section, shown, &axes, &ensembles);
        tabulate(section, shown, &ensembles);
        section.file(format!("{}-runs.csv", shown.scene), runs_csv(&ensembles));
    }
    Ok(())
}

/// The verdict on a statement, and the counts behind it.
fn judge(section: &mut Section, shown: &Shown, statement: &Statement, ensembles: &[Ensemble]) {
    let mut by_verdict: [Vec<String>; 3] = Default::default();
    let about = |e: &&Ensemble| (e.reading == KIRCHHOFF) == statement.kirchhoff;
    for ensemble in ensembles.iter().filter(about) {
        let seeds = ensemble.falls.len();
        let held = ensemble.good().filter(|m| (statement.holds)(m)).count();
        let share = held as f64 / seeds.max(1) as f64;
        let verdict = if share >= REPRODUCED {
            0
        } else if share >= PARTLY {
            1
        } else {
            2
        };
        let key = format!(
            "{}.{}.{}",
            shown.scene,
            ensemble.reading.name(),
            statement.key
        );
        let (held, seeds) = (
            section.quote(format!("{key}.held"), held as f64, 0),
            section.quote(format!("{key}.seeds"), seeds as f64, 0),
        );
        let words = ensemble.reading.words();
        by_verdict[verdict].push(format!("<i>{words}</i> ({held} of {seeds})"));
    }
    if statement.control {
        let counts = by_verdict.concat().join("; ");
        section.claim(Claim {
            words: statement.words.to_owned(),
            verdict: format!("The condition is met under {counts}."),
        });
        return;
    }
    // The best verdict leads, in full.
    let mut verdict = String::new();
    for (k, readings) in by_verdict.iter().enumerate().filter(|(_, r)| !r.is_empty()) {
        let name = if verdict.is_empty() {
            [
                "<b>Reproduced</b>",
                "<b>Partly reproduced</b>",
                "<b>Not reproduced</b>",
            ][k]
        } else {
            ["", " Partly", " Not"][k]
        };
        // Writing to a string cannot fail.
        let _ = write!(verdict, "{name} under {}.", readings.join("; "));
    }
    let _ = write!(
        verdict,
        " <span class=\"note\">Condition: {}.</span>",
        statement.condition
    );
    section.claim(Claim {
        words: statement.words.to_owned(),
        verdict,
    });
}

/// The run of median duration of each reading that is drawn, with its trajectory as a table; once
/// more at the paper's own interval where it names one, however close bodies then are.
fn draw(
    section: &mut Section,
    shown: &Shown,
    setting: &Setting,
    ensembles: &[Ensemble],
) -> Result<(), ReportError> {
    let runs = drawn(shown, ensembles);
    let intervals = [Some(None), setting.scene.picture_interval.map(Some)];
    for interval in intervals.into_iter().flatten() {
        let mut figures = Vec::new();
        for (reading, fall) in &runs {
            let mut name = file_name(shown, reading);
            if let Some(seconds) = interval {
                let _ = write!(name, "-every-{}ms", 1e3 * seconds);
            }
            let title = format!("{} ({}, seed {})", shown.scene, reading.words(), fall.seed);
            let picture = setting.picture(fall, title, shown.view, interval)?;
            let caption = caption(section, shown, reading, fall);
            figures.push(section.picture(&name, &picture, &caption)?);
        }
        section.row(&figures);
    }
    for (reading, fall) in &runs {
        let name = file_name(shown, reading);
        section.file(
            format!("{name}.csv"),
            csv(&Trajectory::new(0, &fall.states)),
        );
    }
    Ok(())
}

fn file_name(shown: &Shown, reading: &Reading) -> String {
    format!("{}-{}", shown.scene, reading.name().replace('.', "-"))
}

fn caption(section: &mut Section, shown: &Shown, reading: &Reading, fall: &Fall) -> String {
    let key = format!("{}.{}.shown", shown.scene, reading.name());
    let seed = section.quote(format!("{key}.seed"), fall.seed as f64, 0);
    let duration = section.quote(format!("{key}.duration"), fall.duration(), 3);
    let words = reading.words();
    format!("<i>{words}</i>, seed {seed}: the run of median duration, {duration} s.")
}

fn drawn<'a>(shown: &Shown, ensembles: &'a [Ensemble]) -> Vec<(Reading, &'a Fall)> {
    ensembles
        .iter()
        .filter(|e| shown.drawn.contains(&e.reading))
        .filter_map(|e| Some((e.reading, typical(&e.falls)?)))
        .collect()
}

/// A curve's name and what it shows of a state.
type Part<'a> = (&'a str, &'a dyn Fn(&State) -> f64);

/// Position, tilt and spin of the runs that are drawn.
fn plot(section: &mut Section, shown: &Shown, axes: &Axes, ensembles: &[Ensemble]) {
    let runs = drawn(shown, ensembles);
    let curves = |parts: &[Part<'_>]| -> Vec<Curve> {
        let mut curves = Vec::new();
        for (colour, (reading, fall)) in runs.iter().enumerate() {
            for (k, (name, value)) in parts.iter().enumerate() {
                let points = fall.states.iter().map(|s| [s.time, value(s)]).collect();
                let words = reading.short();
                let name = if name.is_empty() {
                    words
                } else {
                    format!("{name}, {words}")
                };
                let curve = Curve::new(name, points).coloured(colour);
                curves.push(if k > 0 { curve.dashed() } else { curve });
            }
        }
        curves
    };
    let chart = |y: &str, curves| figure(&Chart::new("time (s)", y, curves), "");
    let start = runs.first().map_or([0.0; 3], |(_, f)| f.states[0].position);
    section.row(&[
        chart("height (m)", curves(&[("", &|s| s.position[1])])),
        chart(
            "horizontal position (m)",
            curves(&[
                ("x", &|s| s.position[0] - start[0]),
                ("z", &|s| s.position[2] - start[2]),
            ]),
        ),
        chart(
            "tilt, elevation (deg)",
            curves(&[
                ("tilt", &|s| axes.tilt(s)),
                ("long axis", &|s| axes.elevation(s)),
            ]),
        ),
        chart(
            "spin (rad/s)",
            curves(&[
                ("long axis", &|s| axes.roll(s)),
                ("total", &|s| norm(s.angular_velocity)),
            ]),
        ),
    ]);
}

/// Medians and spreads of the figure's measures under every reading.
fn tabulate(section: &mut Section, shown: &Shown, ensembles: &[Ensemble]) {
    let fields: Vec<&Field> = shown
        .columns
        .iter()
        .filter_map(|key| FIELDS.iter().find(|f| f.0 == *key))
        .collect();
    let mut head = vec!["reading", "seeds", "diverged"];
    head.extend(fields.iter().map(|f| f.1));
    let mut rows = Vec::new();
    for ensemble in ensembles {
        let key = format!("{}.{}", shown.scene, ensemble.reading.name());
        let mut row = vec![ensemble.reading.words()];
        for (name, count) in [
            ("seeds", ensemble.falls.len()),
            ("diverged", ensemble.diverged()),
        ] {
            let count = section.quote(format!("{key}.{name}"), count as f64, 0);
            row.push(count.to_string());
        }
        for (name, _, value) in &fields {
            row.push(spread(
                section,
                &format!("{key}.{name}"),
                ensemble.spread(*value),
            ));
        }
        rows.push(row);
    }
    section.table(shown.scene, &head, &rows);
}

/// A median with its spread.
fn spread(section: &mut Section, key: &str, spread: Spread) -> String {
    let Spread { low, median, high } = spread;
    if !median.is_finite() {
        return "\u{2013}".to_owned();
    }
    let only = low == high;
    let median = section.quote(format!("{key}.median"), median, 3);
    if only {
        return median.to_string();
    }
    let low = section.quote(format!("{key}.low"), low, 2);
    let high = section.quote(format!("{key}.high"), high, 2);
    format!("{median} <span class=\"note\">[{low}, {high}]</span>")
}

/// One row for each run: SI units, angles in degrees.
fn runs_csv(ensembles: &[Ensemble]) -> String {
    let keys: Vec<&str> = FIELDS.iter().map(|f| f.0).collect();
    let mut table = format!("model,turbulence,seed,ending,duration,{}\n", keys.join(","));
    for ensemble in ensembles {
        let Reading { model, source } = ensemble.reading;
        for (fall, measures) in ensemble.falls.iter().zip(&ensemble.measures) {
            // Writing to a string cannot fail.
            let _ = write!(
                table,
                "{model},{source},{},{},{}",
                fall.seed,
                fall.ending,
                fall.duration()
            );
            for (_, _, value) in FIELDS {
                let _ = match measures {
                    Some(m) => write!(table, ",{}", value(m)),
                    None => write!(table, ","),
                };
            }
            table.push('\n');
        }
    }
    table
}
