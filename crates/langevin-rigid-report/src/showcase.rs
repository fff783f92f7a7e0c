//! Beyond the paper: the scenes that are not the paper's, one picture each.

use langevin_rigid_bake::progress::Progress;
use langevin_rigid_formats::trajectory::{Trajectory, csv};
use langevin_rigid_pictures::View;
use langevin_rigid_scenes::scene::BUILT_IN;

use crate::chart::escape;
use crate::error::ReportError;
use crate::measures::{Axes, Measures, Scale};
use crate::options::Options;
use crate::runs::{Reading, Setting};
use crate::section::Section;

/// The scenes of the paper's own figures; those of its Table 2 have names of one family.
const OF_THE_PAPER: [&str; 4] = ["paper-75", "paper-30", "airplane", "ellipsoid-water"];
const OF_TABLE_2: &str = "table2-";

pub(crate) fn section(options: &Options, progress: &dyn Progress) -> Result<Section, ReportError> {
    let mut section = Section::new("showcase", "Beyond the paper: other bodies");
    section.text(
        "One drop of each other built-in scene, under the scene's own model, with the first seed.",
    );
    let mut figures = Vec::new();
    let others = BUILT_IN
        .iter()
        .filter(|s| !OF_THE_PAPER.contains(&s.name) && !s.name.starts_with(OF_TABLE_2));
    for built_in in others {
        let setting = Setting::as_written(built_in.name, options, progress)?;
        let reading = Reading {
            model: setting.scene.settings.model,
            source: setting.scene.settings.turbulence,
        };
        let first = Options {
            seeds: 1,
            ..options.clone()
        };
        let falls = setting.falls(&reading, &first, progress)?;
        let Some(fall) = falls.first() else { continue };
        let name = built_in.name;
        let title = format!("{name} ({}, seed {})", reading.words(), fall.seed);
        let picture = setting.picture(fall, title, View::FrontAndSide, None)?;
        let measures = Measures::new(
            &Axes::new(&setting.baked.bake.body),
            &fall.states,
            &Scale::SHEET,
        );
        let speed = section.quote(format!("{name}.fall_speed"), measures.fall_speed, 3);
        let revolutions = section.quote(format!("{name}.revolutions"), measures.revolutions, 3);
        let caption = format!(
            "{}: {speed} m/s on average, {revolutions} revolutions end over end.",
            escape(&setting.scene.description)
        );
        figures.push(section.picture(name, &picture, &caption)?);
        section.file(
            format!("{name}.csv"),
            csv(&Trajectory::new(0, &fall.states)),
        );
    }
    section.row(&figures);
    Ok(section)
}
