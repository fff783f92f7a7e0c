//! Tables of trajectories, and what is made of them.

use std::path::Path;
use std::sync::LazyLock;

use langevin_rigid::Bake;
use langevin_rigid_formats::export::{Format, Kind, Options, RecordedBody, Recording, write};
use langevin_rigid_formats::trajectory::{CSV_HEADER, Trajectory, read_csv, write_csv};
use langevin_rigid_scenes::baking::bake_scene;
use langevin_rigid_scenes::scene::Scene;
use tempfile::TempDir;

/// Reads a table, and what is written of it again.
pub(crate) fn read(bytes: &[u8]) {
    let Some(runs) = trajectories(bytes) else {
        return;
    };
    let written = text(&runs);
    let again = read_csv(&written).unwrap_or_else(|error| panic!("{error}\n{written}"));
    assert_eq!(text(&again), written);
}

/// Exports a table in every format that this build has.
pub(crate) fn export(bytes: &[u8]) {
    let Some(trajectories) = trajectories(bytes) else {
        return;
    };
    let kind = Kind::new(&STAGE.scene.name, &STAGE.bake);
    let bodies: Vec<RecordedBody<'_>> = trajectories.iter().map(RecordedBody::from).collect();
    let recording = Recording {
        conditions: STAGE.scene.conditions(),
        kinds: &[kind],
        bodies: &bodies,
    };
    for format in Format::ALL.into_iter().filter(|format| format.built()) {
        export_as(format, &recording, STAGE.folder.path());
    }
}

/// Bakes the body whose runs the tables are.
pub(crate) fn prepare() {
    LazyLock::force(&STAGE);
}

/// Whose runs are exported, and where to.
struct Stage {
    scene: Scene,
    bake: Bake,
    folder: TempDir,
}

static STAGE: LazyLock<Stage> = LazyLock::new(|| {
    let text = r#"
        fluid.preset = "air"
        run = { time_step = 0.01, duration = 1.0 }
        body = { shape = "box", size = [0.1, 0.1, 0.1], triangles = 12, density = 100.0 }
    "#;
    let scene = Scene::parse("box", "box.toml", text).unwrap();
    let bake = bake_scene(&scene, None, &()).unwrap().bake;
    let folder = tempfile::tempdir().unwrap();
    Stage {
        scene,
        bake,
        folder,
    }
});

fn export_as(format: Format, recording: &Recording, folder: &Path) {
    match write(recording, format, folder, &Options::default()) {
        Err(error) => assert!(!error.to_string().is_empty()),
        Ok(written) => {
            if let Some(d) = written.deviation {
                assert!(!d.position.is_nan(), "{format}: {d:?}");
            }
        }
    }
}

/// The runs of a table, whose header need not be given.
fn trajectories(bytes: &[u8]) -> Option<Vec<Trajectory>> {
    let rows = str::from_utf8(bytes).ok()?;
    let table = match rows.starts_with(|c: char| c.is_ascii_digit()) {
        true => format!("{CSV_HEADER}\n{rows}"),
        false => rows.to_owned(),
    };
    match read_csv(&table) {
        Ok(runs) => Some(runs),
        Err(error) => {
            assert!(!error.to_string().is_empty());
            None
        }
    }
}

fn text(runs: &[Trajectory]) -> String {
    let mut bytes = Vec::new();
    write_csv(runs, &mut bytes).unwrap();
    String::from_utf8(bytes).unwrap()
}
