//! Built-in scenes from their TOML to ensembles: mesh, bake, a fall, several in lanes.

use std::error::Error;

use langevin_rigid::{Model, TurbulenceSource};
use langevin_rigid_scenes::ensemble::{self, Statistics};
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene::{Geometry, Scene, find};

use crate::Line;
use crate::fnv::Fnv;

/// Thick and thin, flat and bent, in air and in water; under the models separated and consistent.
const NAMES: [&str; 7] = [
    "coin",
    "ellipsoid-water",
    "paper-30",
    "maple-seed",
    "feather",
    "airplane",
    "autumn",
];
/// Coarse, for bakes in a second without the optimizer.
const TRIANGLES: usize = 200;
/// Of the turbulence history.
const CELLS: [usize; 3] = [16, 16, 8];
const STEPS: u32 = 300;
/// No multiple of any number of lanes.
const RUNS: u32 = 5;

/// Three lines for each scene: its bake's bytes, the states of a fall, an ensemble.
pub(crate) fn lines() -> Result<Vec<Line>, Box<dyn Error>> {
    let mut lines = Vec::new();
    for name in NAMES {
        let of_scene = of_scene(coarse(find(name)?));
        lines.extend(of_scene.map_err(|error| format!("{name}: {error}"))?);
    }
    Ok(lines)
}

/// With few triangles and cells, and to be followed for [`STEPS`] from its release.
fn coarse(mut scene: Scene) -> Scene {
    if let Geometry::Shape { triangles, .. } = &mut scene.body.geometry {
        *triangles = TRIANGLES;
    }
    // A history is baked, noise is not.
    if scene.settings.model == Model::Consistent {
        scene.settings.turbulence = TurbulenceSource::History;
        scene.grid.cells = CELLS;
    }
    scene.stop.time = Some(scene.carried + f64::from(STEPS) * scene.time_step);
    scene
}

fn of_scene(scene: Scene) -> Result<[Line; 3], Box<dyn Error>> {
    let name = scene.name.clone();
    let prepared = Prepared::new(scene, None, &())?;

    let mut bake = Fnv::default();
    bake.bytes(&prepared.baked().bake.to_bytes());

    let fall = prepared.drop(&prepared.release(0), &());
    fall.ended?;
    let mut states = Fnv::default();
    fall.states.iter().for_each(|state| states.state(state));

    let falls = ensemble::run(&prepared, 0..RUNS, &());
    let statistics = Statistics::new(&falls);
    let mut ensemble = Fnv::default();
    // The debug form prints numbers so that they read back.
    ensemble.bytes(format!("{falls:?} {statistics:?}").as_bytes());

    Ok(
        [("bake", bake), ("fall", states), ("ensemble", ensemble)].map(|(what, hash)| Line {
            name: format!("{name} {what}"),
            hash: hash.0,
        }),
    )
}
