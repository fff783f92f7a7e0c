//! Built-in scenes from their TOML to ensembles: mesh, bake, a fall, several in lanes.

use std::error::Error;

use langevin_rigid::{Bake, Model, TurbulenceSource};
use langevin_rigid_scenes::ensemble::{self, Statistics};
use langevin_rigid_scenes::prepared::Prepared;
use langevin_rigid_scenes::scene::{Geometry, Scene, find};

use crate::Line;
use crate::fnv::Fnv;

/// Thick and thin, flat and bent, in air and in water and between them, touching; under the models separated and
/// consistent.
const NAMES: [&str; 11] = [
    "leaf",
    "coin",
    "ellipsoid-water",
    "paper-30",
    "maple-seed",
    "feather",
    "airplane",
    "autumn",
    "pond",
    "coin-toss",
    "leaves",
];
/// Coarse, for bakes in a second without the optimizer.
const TRIANGLES: usize = 200;
/// Of the turbulence history.
const CELLS: [usize; 3] = [16, 16, 8];
const STEPS: u32 = 300;
/// Bodies of a crowd.
const CROWD: u32 = 12;
/// No multiple of any number of lanes.
const RUNS: u32 = 5;

/// Three lines for each scene: its bake's bytes, the states of a fall or of all bodies of a world, an ensemble.
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
    if let Some(crowd) = &mut scene.crowd {
        // Soon on the ground, and on each other.
        crowd.count = CROWD;
        crowd.during = 0.1;
        crowd.over = [0.2, 0.1, 0.2];
        scene.release.position = [0.0, 0.2, 0.0];
    }
    scene.stop.time = Some(scene.carried + f64::from(STEPS) * scene.time_step);
    scene
}

fn of_scene(scene: Scene) -> Result<[Line; 3], Box<dyn Error>> {
    let name = scene.name.clone();
    let prepared = Prepared::new(scene, None, &())?;

    let mut bake = Fnv::default();
    // What it was made from counts the sources in, which change without a bit of the body.
    let made = Bake {
        fingerprint: [0; 32],
        ..prepared.baked().bake.clone()
    };
    bake.bytes(&made.to_bytes());

    let falls = match prepared.surroundings() {
        Some(_) => prepared.drop_together(1, usize::MAX, &())?,
        None => vec![prepared.drop(&prepared.release(0), &())],
    };
    let mut states = Fnv::default();
    for fall in falls {
        fall.ended?;
        fall.states.iter().for_each(|state| states.state(state));
    }

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
