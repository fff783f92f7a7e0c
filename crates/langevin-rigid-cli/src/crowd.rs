//! `langevin-rigid crowd`

use std::io::Write;

use anyhow::Result;
use langevin_rigid_scenes::real_time::{self, RealTime, real_time};
use langevin_rigid_scenes::scene;

use crate::arguments::Crowd;
use crate::bars::Bars;
use crate::{cache, forecast, say};

pub(crate) fn crowd(options: &Crowd, bars: &Bars) -> Result<()> {
    let (bodies, seconds) = (options.bodies, options.seconds);
    let mut scene = scene::find(&options.scene)?;
    if let Some(model) = options.model {
        scene.set_model(model);
    }
    let prepared = cache::prepare(scene, bars)?;
    forecast::check(
        real_time::need(bodies, seconds, prepared.scene().time_step),
        &format!("`--bodies {bodies} --seconds {seconds:?}`"),
    )?;
    let crowd = bars.stoppable(|| real_time(&prepared, bodies, seconds, bars))?;
    bars.clear();
    tell(&crowd, options.json)
}

fn tell(crowd: &RealTime, json: bool) -> Result<()> {
    let mut out = say::out();
    if json {
        writeln!(out, "{}", serde_json::to_string_pretty(crowd)?)?;
        return Ok(());
    }
    let RealTime {
        scene,
        model,
        bodies,
        threads,
        ..
    } = crowd;
    writeln!(
        out,
        "{bodies} bodies of {scene} ({model}), steps of {:.1} ms, {threads} threads:",
        1e3 * crowd.time_step
    )?;
    writeln!(
        out,
        "{} frames at 60 a second, {} missed; a frame took {:.1} ms (median), {:.1} ms at most",
        crowd.frames, crowd.missed_frames, crowd.median_frame_ms, crowd.longest_frame_ms
    )?;
    Ok(())
}
