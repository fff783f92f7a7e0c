//! What was written, read back by other means.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;

use langevin_rigid::linalg::vector::{cross, dot};
use langevin_rigid::linalg::{quat_from_rotation_vector, rotate, rotate_back};
use langevin_rigid::{Bake, Fluid, Settings, State};
use langevin_rigid_bake::body::{BodySpec, bake_body};
use langevin_rigid_bake::shapes::Shape;
use serde_json::Value;

use super::*;
use crate::mesh::{LengthUnit, read_mesh};
use crate::trajectory::Trajectory;

fn brick() -> Bake {
    let mesh = Shape::Box {
        size: [0.01, 0.02, 0.04],
    };
    let spec = BodySpec {
        density: Some(1100.0),
        ..BodySpec::default()
    };
    let (body, added_mass) = bake_body(&mesh.mesh(1280).unwrap(), &spec, &()).unwrap();
    Bake {
        body,
        history: None,
        error_estimate: added_mass.error_estimate,
        warnings: Vec::new(),
        fingerprint: [0; 32],
    }
}

/// A body that tumbles and swings for `seconds` at so many steps a second.
fn tumbling(body: u32, seconds: f64, rate: u32) -> Trajectory {
    let steps = (seconds * f64::from(rate)).round() as u32;
    let phase = f64::from(body);
    let state = |step: u32| {
        let time = f64::from(step) / f64::from(rate);
        State {
            time,
            position: [libm::sin(9.0 * time + phase), -time, phase],
            orientation: quat_from_rotation_vector([libm::sin(11.0 * time), 6.0 * time, phase]),
            ..State::default()
        }
    };
    let states: Vec<State> = (0..=steps).map(state).collect();
    Trajectory::new(body, &states)
}

struct Glb {
    document: Value,
    binary: Vec<u8>,
}

impl Glb {
    fn read(path: &Path) -> Self {
        let bytes = std::fs::read(path).unwrap();
        let word = |at: usize| u32::from_le_bytes(bytes[at..at + 4].try_into().unwrap()) as usize;
        assert_eq!(
            (&bytes[..4], word(4), word(8)),
            (&b"glTF"[..], 2, bytes.len())
        );
        let binary = 20 + word(12);
        assert_eq!(binary + 8 + word(binary), bytes.len());
        Self {
            document: serde_json::from_slice(&bytes[20..binary]).unwrap(),
            binary: bytes[binary + 8..].to_vec(),
        }
    }

    fn numbers(&self, accessor: &Value) -> Vec<f64> {
        let accessor = &self.document["accessors"][accessor.as_u64().unwrap() as usize];
        let view = &self.document["bufferViews"][accessor["bufferView"].as_u64().unwrap() as usize];
        let (at, length) = (view["byteOffset"].as_u64(), view["byteLength"].as_u64());
        let (at, length) = (at.unwrap() as usize, length.unwrap() as usize);
        let numbers = self.binary[at..at + length].as_chunks::<4>().0;
        numbers
            .iter()
            .map(|b| f64::from(f32::from_le_bytes(*b)))
            .collect()
    }

    /// Times and values of a channel, in the order translation and rotation of each body.
    fn channel(&self, number: usize) -> (Vec<f64>, Vec<f64>) {
        let sampler = &self.document["animations"][0]["samplers"][number];
        (
            self.numbers(&sampler["input"]),
            self.numbers(&sampler["output"]),
        )
    }
}

/// The turn from `a` to `b` as a point far out sees it, times `part`: slerp by another way.
fn turned(a: [f64; 4], b: [f64; 4], part: f64) -> [f64; 4] {
    let product = |a: [f64; 4], b: [f64; 4]| -> [f64; 4] {
        let v = |q: [f64; 4]| [q[0], q[1], q[2]];
        let (u, w) = (v(a), v(b));
        let turned = cross(u, w);
        let c = |i: usize| a[3] * w[i] + b[3] * u[i] + turned[i];
        [c(0), c(1), c(2), a[3] * b[3] - dot(u, w)]
    };
    let mut between = product(b, [-a[0], -a[1], -a[2], a[3]]);
    if between[3] < 0.0 {
        between = between.map(|x| -x);
    }
    let sine = between[..3].iter().map(|x| x * x).sum::<f64>().sqrt();
    let angle = 2.0 * libm::atan2(sine, between[3]);
    let axis = |i: usize| {
        if sine > 0.0 {
            part * angle * between[i] / sine
        } else {
            0.0
        }
    };
    product(quat_from_rotation_vector([axis(0), axis(1), axis(2)]), a)
}

/// The largest distance and angle between a body in the file and its trajectory.
fn measured(glb: &Glb, number: usize, trajectory: &Trajectory) -> Deviation {
    let (times, positions) = glb.channel(2 * number);
    let (_, orientations) = glb.channel(2 * number + 1);
    let mut worst = Deviation::default();
    for pose in &trajectory.poses {
        let after = times
            .partition_point(|t| *t <= pose.time)
            .min(times.len() - 1);
        let before = after.saturating_sub(1);
        let part = ((pose.time - times[before]) / (times[after] - times[before])).min(1.0);
        let point = |frame: usize, i: usize| positions[3 * frame + i];
        let place = |i: usize| point(before, i) + part * (point(after, i) - point(before, i));
        let away = (0..3)
            .map(|i| (place(i) - pose.position[i]).powi(2))
            .sum::<f64>()
            .sqrt();
        let quaternion = |frame: usize| std::array::from_fn(|i| orientations[4 * frame + i]);
        let shown = turned(quaternion(before), quaternion(after), part);
        // The largest angle that any axis is off by is that of the turn, for two axes at least.
        let off = |axis: [f64; 3]| {
            let seen = rotate_back(pose.orientation, rotate(shown, axis));
            let chord = (0..3)
                .map(|i| (seen[i] - axis[i]).powi(2))
                .sum::<f64>()
                .sqrt();
            chord * chord
        };
        let [x, y, z] = [
            off([1.0, 0.0, 0.0]),
            off([0.0, 1.0, 0.0]),
            off([0.0, 0.0, 1.0]),
        ];
        // Chords of the three axes: their squares sum to 8 sin^2(angle / 2).
        let angle = 2.0 * libm::asin(((x + y + z) / 8.0).sqrt().min(1.0));
        worst.position = worst.position.max(away);
        worst.rotation = worst.rotation.max(angle);
    }
    worst
}

/// A recording of bodies of two kinds at most, to work with.
pub(super) fn recorded<R>(
    bodies: &[RecordedBody<'_>],
    work: impl FnOnce(&Recording<'_>) -> R,
) -> R {
    let bake = brick();
    let kinds = ["brick-7", "\"long\", brick"].map(|name| Kind::new(name, &bake));
    let several = bodies.iter().any(|body| body.kind > 0);
    work(&Recording {
        conditions: Conditions {
            scene: "brick-7",
            fluid: &Fluid::WATER,
            settings: &Settings::default(),
            seed: 3,
            time_step: 0.002,
        },
        kinds: if several { &kinds } else { &kinds[..1] },
        bodies,
    })
}

/// Writes trajectories of the brick in one format, into a folder that goes away with the result.
fn written(
    trajectories: &[Trajectory],
    format: Format,
    fps: f64,
) -> Result<(tempfile::TempDir, Option<Deviation>), ExportError> {
    let bodies: Vec<RecordedBody<'_>> = trajectories.iter().map(RecordedBody::from).collect();
    let options = Options {
        fps,
        ..Options::default()
    };
    let folder = tempfile::tempdir().unwrap();
    let written = recorded(&bodies, |run| write(run, format, folder.path(), &options));
    if written.is_err() {
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0);
    }
    Ok((folder, written?.deviation))
}

#[test]
fn a_glb_strays_as_far_as_it_says_slerp_and_all() {
    let trajectories = [tumbling(0, 1.0, 500), tumbling(1, 0.613, 500)];
    for fps in [24.0, 60.0, 240.0] {
        let (folder, stated) = written(&trajectories, Format::Glb, fps).unwrap();
        let stated = stated.unwrap();
        let glb = Glb::read(&folder.path().join("trajectory.glb"));
        let said = &glb.document["scenes"][0]["extras"]["langevin_rigid"];
        for (key, wanted) in [
            ("largest_position_error_m", stated.position),
            ("largest_rotation_error_rad", stated.rotation),
        ] {
            let said = said[key].as_f64().unwrap();
            assert!(
                (said / wanted - 1.0).abs() < 1e-15,
                "{key}: {said} {wanted}"
            );
        }
        let found: Vec<Deviation> = (0..2)
            .map(|body| measured(&glb, body, &trajectories[body]))
            .collect();
        let position = found[0].position.max(found[1].position);
        let rotation = found[0].rotation.max(found[1].rotation);
        assert!(
            (position / stated.position - 1.0).abs() < 1e-3,
            "{position} {stated:?}"
        );
        assert!(
            (rotation / stated.rotation - 1.0).abs() < 1e-3,
            "{rotation} {stated:?}"
        );
        // A swing of 1 m at 9 rad/s: chords between frames and between steps, g h^2 / 8 each.
        let sagittas = 81.0 / 8.0 * (1.0 / (fps * fps) + 1.0 / (500.0 * 500.0));
        assert!(position < sagittas, "{position} {sagittas}");
    }
}

/// Steps of a rounded length end a little past a frame or short of it: no time in single precision.
#[test]
fn an_end_that_is_hardly_off_a_frame_is_that_frame() {
    for late in [1e-8, 1e-7, -1e-8, -1e-7] {
        let mut off = tumbling(0, 10.0, 60);
        for pose in &mut off.poses {
            pose.time *= 1.0 + late;
        }
        let exact = tumbling(1, 10.0, 60);
        let (folder, deviation) = written(&[off, exact], Format::Glb, 60.0).unwrap();
        assert!(deviation.unwrap().position < 3e-5, "{deviation:?}");
        let glb = Glb::read(&folder.path().join("trajectory.glb"));
        for channel in [0, 2] {
            let (times, values) = glb.channel(channel);
            assert_eq!(3 * times.len(), values.len());
            assert!(times.windows(2).all(|pair| pair[0] < pair[1]));
            assert!((times[times.len() - 1] - 10.0).abs() < 2e-6);
        }
    }
}

#[test]
fn bodies_share_one_mesh_and_their_times() {
    let bake = brick();
    let trajectories: Vec<Trajectory> = (0..5).map(|body| tumbling(body, 0.5, 100)).collect();
    let (folder, _) = written(&trajectories, Format::Glb, 60.0).unwrap();
    let path = folder.path().join("trajectory.glb");
    let Glb { document, .. } = Glb::read(&path);
    assert_eq!(document["meshes"].as_array().unwrap().len(), 1);
    let samplers = document["animations"][0]["samplers"].as_array().unwrap();
    assert_eq!(samplers.len(), 10);
    assert!(samplers.iter().all(|s| s["input"] == samplers[0]["input"]));
    assert_eq!(document["nodes"][3]["name"], "brick-7.0003");
    // Placed five times, read as one surface: the mesh itself, to single precision.
    let read = read_mesh(&path, Some(LengthUnit::M)).unwrap();
    assert_eq!(read.triangles.len(), 5 * bake.body.surface.triangles.len());
}

#[test]
fn the_mesh_of_a_glb_is_the_body() {
    let bake = brick();
    let still = Trajectory::new(0, &[State::default()]);
    let (folder, _) = written(&[still], Format::Glb, 60.0).unwrap();
    let path = folder.path().join("trajectory.glb");
    // A brick has three normals at each corner, and welds to itself.
    let read = read_mesh(&path, Some(LengthUnit::M))
        .unwrap()
        .body()
        .unwrap();
    assert_eq!(read.triangles().len(), bake.body.surface.triangles.len());
    assert!((read.volume() / bake.body.volume - 1.0).abs() < 1e-6);
}

#[test]
fn a_thousand_bodies_fit_into_sixty_megabytes() {
    let trajectories: Vec<Trajectory> = (0..1000).map(|body| tumbling(body, 10.0, 60)).collect();
    let formats = [Format::Glb, Format::Usd, Format::Npz];
    for format in formats.into_iter().filter(|format| format.built()) {
        let (folder, _) = written(&trajectories, format, 60.0).unwrap();
        let file = folder.path().join(format.file_name());
        let size = std::fs::metadata(file).unwrap().len();
        assert!(
            size > 1000 * 601 * 28,
            "{format} has all of it: {size} bytes"
        );
        if format != Format::Npz {
            assert!(size < 60_000_000, "{format}: {size} bytes");
        }
    }
}

#[test]
fn a_format_left_out_is_refused_by_name() {
    let still = [Trajectory::new(0, &[State::default()])];
    for format in Format::ALL {
        let told = [check(&[format]).err(), written(&still, format, 60.0).err()];
        for told in told {
            assert_eq!(told.is_none(), format.built(), "{format}");
            let feature = format!("--features {format}`");
            assert!(told.is_none_or(|told| told.to_string().contains(&feature)));
        }
    }
}

#[cfg(feature = "npz")]
#[test]
fn arrays_read_back_to_the_last_bit() {
    let trajectories = [tumbling(0, 0.1, 100), tumbling(4, 0.05, 100)];
    let mut bytes = std::io::Cursor::new(Vec::new());
    let bodies = [0, 1].map(|n| RecordedBody {
        kind: 1 - n,
        scale: 1.3,
        trajectory: &trajectories[n],
    });
    recorded(&bodies, |run| npz::write(run, Up::Y, &mut bytes)).unwrap();
    let mut archive = zip::ZipArchive::new(bytes).unwrap();
    let mut array = |name: &str| {
        let file = archive.by_name(&format!("{name}.npy")).unwrap();
        let array = npyz::NpyFile::new(file).unwrap();
        (array.shape().to_vec(), array.into_vec::<f64>().unwrap())
    };
    assert_eq!(array("t").0, [17]);
    let (shape, orientations) = array("orientation");
    assert_eq!(shape, [17, 4]);
    assert_eq!(orientations[44..48], trajectories[1].poses[0].orientation);
    assert_eq!(array("angular_velocity").0, [17, 3]);
    let file = archive.by_name("body.npy").unwrap();
    let bodies = npyz::NpyFile::new(file).unwrap().into_vec::<u32>().unwrap();
    assert_eq!(bodies[10..12], [0, 4]);
    // A row for each body.
    let file = archive.by_name("kind.npy").unwrap();
    let kinds = npyz::NpyFile::new(file)
        .unwrap()
        .into_vec::<String>()
        .unwrap();
    assert_eq!(kinds, ["\"long\", brick", "brick-7"]);
    let file = archive.by_name("scale.npy").unwrap();
    let scales = npyz::NpyFile::new(file).unwrap().into_vec::<f64>().unwrap();
    assert_eq!(scales, [1.3, 1.3]);
    let file = archive.by_name("bodies.npy").unwrap();
    let bodies = npyz::NpyFile::new(file).unwrap().into_vec::<u32>().unwrap();
    assert_eq!(bodies, [0, 4]);
}

#[test]
fn what_cannot_be_shown_says_why() {
    let fails = |trajectories: &[Trajectory], fps: f64| {
        let [glb, usd] = [Format::Glb, Format::Usd]
            .map(|format| written(trajectories, format, fps).unwrap_err().to_string());
        assert_eq!(glb, usd);
        glb
    };
    assert!(fails(&[], 60.0).contains("no trajectory"));
    assert!(fails(&[tumbling(0, 1.0, 10)], 0.0).contains("0 frames a second of 1 s"));
    let mut bad = tumbling(7, 1.0, 10);
    bad.poses[3].position[1] = f64::NAN;
    assert!(fails(&[bad], 60.0).starts_with("body 7: pose 3 is no placement"));
}

/// A brick of scale one and one of another kind, twice as large.
#[test]
fn bodies_have_kinds_and_sizes() {
    let trajectories = [tumbling(0, 0.2, 100), tumbling(1, 0.2, 100)];
    let bodies = [(0, 1.0), (1, 2.0)];
    let bodies: Vec<RecordedBody<'_>> = bodies
        .into_iter()
        .zip(&trajectories)
        .map(|((kind, scale), trajectory)| RecordedBody {
            kind,
            scale,
            trajectory,
        })
        .collect();
    let folder = tempfile::tempdir().unwrap();
    let write = |format| {
        let options = Options::default();
        recorded(&bodies, |run| write(run, format, folder.path(), &options)).unwrap()
    };

    assert_eq!(write(Format::Csv).files, ["trajectory.csv", "bodies.csv"]);
    let table = std::fs::read_to_string(folder.path().join("bodies.csv")).unwrap();
    assert_eq!(
        table,
        "body,kind,scale\n0,brick-7,1\n1,\"\"\"long\"\", brick\",2\n"
    );

    assert_eq!(write(Format::Glb).files, ["trajectory.glb"]);
    let path = folder.path().join("trajectory.glb");
    let Glb { document, .. } = Glb::read(&path);
    assert_eq!(document["meshes"].as_array().unwrap().len(), 2);
    let [small, large] = [0, 1].map(|n| &document["nodes"][n]);
    assert_eq!(small["scale"], Value::Null);
    assert_eq!(large["scale"], serde_json::json!([2.0, 2.0, 2.0]));
    assert_eq!(large["mesh"], 1);
    assert_eq!(large["extras"]["langevin_rigid"]["scale"], 2.0);
    let volume = read_mesh(&path, Some(LengthUnit::M)).unwrap().body();
    let one = brick().body.volume;
    assert!((volume.unwrap().volume() / (9.0 * one) - 1.0).abs() < 1e-6);

    write(Format::Usd);
    let layer = std::fs::read_to_string(folder.path().join("trajectory.usda")).unwrap();
    for line in [
        "        class Xform \"brick_7_0\" (",
        "        class Xform \"__long___brick_1\" (",
        "references = </World/Shapes/__long___brick_1>",
        "def Xform \"__long___brick_1\" (",
        "double3 xformOp:scale = (2, 2, 2)",
        "[\"xformOp:translate\", \"xformOp:orient\", \"xformOp:scale\"]",
    ] {
        assert!(layer.contains(line), "{line}");
    }
}

#[test]
fn impossible_bodies_are_refused() {
    let trajectory = tumbling(3, 0.1, 100);
    let fails = |kind, scale| {
        let body = RecordedBody {
            kind,
            scale,
            trajectory: &trajectory,
        };
        let folder = tempfile::tempdir().unwrap();
        let options = Options::default();
        let written = recorded(&[body], |run| {
            write(run, Format::Csv, folder.path(), &options)
        });
        written.unwrap_err().to_string()
    };
    assert!(fails(2, 1.0).starts_with("body 3 is of kind 2, and there are 2 kinds"));
    for scale in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(
            fails(0, scale).contains("give a positive number"),
            "{scale}"
        );
    }
}
