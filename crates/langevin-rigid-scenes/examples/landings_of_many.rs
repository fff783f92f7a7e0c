//! Coins dropped into a tank again and again: where they land, on average and how far apart.

use std::error::Error;
use std::ops::Range;

use langevin_rigid_scenes::ensemble::{Fall, FallEnding, Statistics, run};
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene::find;

/// Run i is the same whatever runs are beside it: these could be shared among processes.
const RUNS: Range<u32> = 0..64;

/// Mean and standard deviation of a sample.
fn mean_and_spread(sample: &[f64]) -> (f64, f64) {
    let count = sample.len() as f64;
    let mean = sample.iter().sum::<f64>() / count;
    let squares: f64 = sample.iter().map(|x| (x - mean) * (x - mean)).sum();
    (mean, (squares / (count - 1.0)).sqrt())
}

fn main() -> Result<(), Box<dyn Error>> {
    // A built-in scene, or the path of a file; its [scatter] says how the releases differ.
    let prepared = Prepared::new(find("coin")?, None, &())?;
    let falls = run(&prepared, RUNS, &());

    let landed: Vec<&Fall> = falls
        .iter()
        .filter(|fall| fall.ending == FallEnding::Ground)
        .collect();
    println!("{} of {} coins landed", landed.len(), falls.len());
    let print = |what: &str, value: fn(&Fall) -> f64| {
        let sample: Vec<f64> = landed.iter().map(|fall| value(fall)).collect();
        let (mean, spread) = mean_and_spread(&sample);
        println!("{what:<20}{mean:8.2} +- {spread:.2}");
    };
    print("duration, s", |fall| fall.time);
    print("landing along x, cm", |fall| 100.0 * fall.end[0]);
    print("landing along z, cm", |fall| 100.0 * fall.end[2]);
    print("turnovers", |fall| fall.motion.turnovers().into());

    let statistics = Statistics::new(&falls);
    if let Some(distance) = statistics.median_landing_distance {
        println!("half of them within {:.2} cm", 100.0 * distance);
    }
    for (motion, count) in &statistics.motions {
        println!("{count:4} {}", motion.name());
    }
    Ok(())
}
