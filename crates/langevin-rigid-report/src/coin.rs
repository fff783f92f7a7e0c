//! Beyond the paper: a coin in a tank against its measurement.

use langevin_rigid::Model;
use langevin_rigid_bake::progress::Progress;
use langevin_rigid_scenes::ensemble::{self, SAMPLES_PER_SECOND, Statistics, landings};
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene;

use crate::chart::{Chart, Curve};
use crate::error::ReportError;
use crate::options::Options;
use crate::paper;
use crate::section::{Section, figure};

/// Drops for each seed asked for: a standard deviation wants many.
const DROPS_PER_SEED: u32 = 20;

pub(crate) fn section(options: &Options, progress: &dyn Progress) -> Result<Section, ReportError> {
    let mut scene = scene::find("coin")?;
    scene.seed = options.first_seed;
    scene.settings.model = Model::Separated;
    let prepared = Prepared::new(scene, options.cache.as_deref(), progress)?;
    let runs = options.seeds.saturating_mul(DROPS_PER_SEED);
    let falls = ensemble::run(&prepared, 0..runs, progress);
    if progress.cancelled() {
        return Err(ReportError::Cancelled);
    }
    let statistics = Statistics::new(&falls);

    let mut section = Section::new("coin", "Beyond the paper: a coin against its measurement");
    let drops = section.quote("drops", f64::from(runs), 0);
    section.text(format!(
        "The paper compares with photographs. Here {drops} drops under the model <i>separated</i>, whose \
         releases scatter as the scene <i>coin</i> says, against {}.",
        paper::coin::SOURCE
    ));
    section.row(&[depth_chart(&statistics), spread_chart(&statistics)]);
    table(&mut section, &statistics);
    section.file("landings.csv", landings(&prepared, &falls).csv());
    let json =
        serde_json::to_string_pretty(&statistics).map_err(|e| ReportError::Json(e.into()))?;
    section.file("statistics.json", json + "\n");
    Ok(section)
}

fn depth_chart(statistics: &Statistics) -> String {
    let mean = statistics.t.iter().zip(&statistics.depth_mean);
    let measured = paper::coin::SINKING
        .iter()
        .map(|[t, depth, ..]| [*t, *depth]);
    let curves = vec![
        Curve::new("mean depth, here", mean.map(|(t, d)| [*t, *d]).collect()),
        Curve::new("measured", measured.collect()).dashed(),
    ];
    figure(&Chart::new("time (s)", "depth (m)", curves), "")
}

fn spread_chart(statistics: &Statistics) -> String {
    let here = |values: &[f64]| -> Vec<[f64; 2]> {
        let pairs = statistics.t.iter().zip(values);
        pairs.map(|(t, v)| [*t, *v]).collect()
    };
    let measured = |k: usize| paper::coin::SINKING.iter().map(|m| [m[0], m[k]]).collect();
    let curves = vec![
        Curve::new("depth, here", here(&statistics.depth_std)),
        Curve::new("depth, measured", measured(2)).dashed(),
        Curve::new("x, here", here(&statistics.x_std)),
        Curve::new("x, measured", measured(3)).dashed(),
    ];
    figure(
        &Chart::new("time (s)", "standard deviation (m)", curves),
        "",
    )
}

fn table(section: &mut Section, statistics: &Statistics) {
    let mut rows = Vec::new();
    let mut row = |words: String, key: &str, measured: f64, here: f64| {
        let measured = section.quote(format!("{key}.measured"), 100.0 * measured, 3);
        let here = section.quote(key, 100.0 * here, 3);
        rows.push(vec![words, measured.to_string(), here.to_string()]);
    };
    for [t, depth, depth_std, x_std] in paper::coin::SINKING {
        let sample = (t * f64::from(SAMPLES_PER_SECOND) + 0.5) as usize;
        let here = |values: &[f64]| values.get(sample).copied().unwrap_or(f64::NAN);
        row(
            format!("mean depth at {t} s"),
            &format!("{t}.depth"),
            depth,
            here(&statistics.depth_mean),
        );
        row(
            format!("standard deviation of the depth at {t} s"),
            &format!("{t}.depth_std"),
            depth_std,
            here(&statistics.depth_std),
        );
        row(
            format!("standard deviation of x at {t} s"),
            &format!("{t}.x_std"),
            x_std,
            here(&statistics.x_std),
        );
    }
    let [x, z] = paper::coin::LANDING;
    for (words, key, measured, here) in [
        (
            "landing scatter, x",
            "landing_x",
            x,
            statistics.landing_sigma_x,
        ),
        (
            "landing scatter, z",
            "landing_z",
            z,
            statistics.landing_sigma_z,
        ),
        (
            "median landing distance",
            "landing_distance",
            paper::coin::DISTANCE,
            statistics.median_landing_distance,
        ),
    ] {
        row(words.to_owned(), key, measured, here.unwrap_or(f64::NAN));
    }
    section.table("coin", &["cm", "measured", "here"], &rows);
}
