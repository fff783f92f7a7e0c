//! Beyond the paper: which plates flutter and which tumble, against experiments.

use langevin_rigid_bake::progress::Progress;
use langevin_rigid_scenes::regimes::{self, Agreement, Plate};

use crate::error::ReportError;
use crate::options::Options;
use crate::section::Section;

/// Values of I* and of the Reynolds number in the map.
const GRID: [u32; 2] = [10, 6];

pub(crate) fn section(_: &Options, progress: &dyn Progress) -> Result<Section, ReportError> {
    let runs = regimes::run(&regimes::cases(GRID[0], GRID[1]), progress)?;
    if progress.cancelled() {
        return Err(ReportError::Cancelled);
    }
    let points = regimes::points(&runs);
    let mut section = Section::new("regimes", "Beyond the paper: who flutters and who tumbles");
    section.text(
        "The paper closes by saying that fluttering and tumbling are not apparently captured. Discs and \
         long strips of many weights, released at several tilts into fluids of many viscosities under \
         the model <i>separated</i>, each run classified by itself; the colours behind are experiments.",
    );
    let agreement = |of: Option<Plate>| {
        Agreement::of(
            points
                .iter()
                .filter(|p| of.is_none_or(|plate| p.plate == plate)),
        )
    };
    let rows: Vec<Vec<String>> = [
        ("discs", Some(Plate::Disc)),
        ("strips", Some(Plate::Strip)),
        ("together", None),
    ]
    .into_iter()
    .map(|(name, plate)| {
        let found = agreement(plate);
        let compared = section.quote(format!("{name}.compared"), found.compared as f64, 0);
        let agreeing = section.quote(format!("{name}.agreeing"), found.agreeing as f64, 0);
        let share = 100.0 * found.agreement.unwrap_or(f64::NAN);
        let share = section.quote(format!("{name}.share"), share, 0);
        [
            name.to_owned(),
            compared.to_string(),
            agreeing.to_string(),
            format!("{share} %"),
        ]
        .into()
    })
    .collect();
    let map = regimes::regime_map(&points, "Marks: the model. Colours: experiments.")?;
    let figure = section.picture("map", &map, "Regimes over Reynolds number and inertia.")?;
    section.row(&[figure]);
    section.table(
        "agreement",
        &[
            "plates",
            "compared points",
            "agree with experiments",
            "share",
        ],
        &rows,
    );
    section.file("regimes.csv", regimes::csv(&runs));
    Ok(section)
}
