//! The command as its users meet it: what it writes, what it says of bad input, and how it exits.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use assert_cmd::Command;
use common::{BALL, Place, read, scene};
use serde_json::Value;

#[test]
fn simulate_writes_everything_it_promises() {
    let place = Place::new();
    let outcome = place.run(&["simulate", "paper-75"]);
    assert_eq!(outcome.code, 0, "{}", outcome.err);
    let folder = place.path("out/paper-75");

    let csv = read(&folder.join("trajectory.csv"));
    let mut lines = csv.lines();
    assert_eq!(
        lines.next(),
        Some("body,t,x,y,z,qx,qy,qz,qw,vx,vy,vz,wx,wy,wz")
    );
    let rows: Vec<Vec<f64>> = lines
        .map(|l| l.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    assert!(rows.iter().all(|r| r.len() == 15));
    assert_eq!(rows[0][3], 3.0);
    assert!(rows[rows.len() - 1][3] < 0.05, "it fell to the ground");

    let summary: Value = serde_json::from_str(&read(&folder.join("summary.json"))).unwrap();
    for key in [
        "U0",
        "Re",
        "terminal_speed",
        "energy",
        "warnings",
        "seed",
        "version",
        "seconds",
    ] {
        assert!(!summary[key].is_null(), "{key}");
    }
    assert_eq!(summary["ending"], "ground");
    assert_eq!(summary["steps"].as_u64().unwrap() as usize + 1, rows.len());
    let speed = summary["terminal_speed"].as_f64().unwrap();
    assert!(speed > 0.6 && speed < 1.6, "{speed}");

    let png = std::fs::read(folder.join("trajectory.png")).unwrap();
    assert!(png.starts_with(b"\x89PNG") && png.len() > 10_000);

    // The resolved scene runs to the same states.
    let resolved = folder.join("scene.toml").display().to_string();
    assert_eq!(
        place.run(&["simulate", &resolved, "--out", "again"]).code,
        0
    );
    assert_eq!(read(&place.path("again/trajectory.csv")), csv);
}

/// The whole method on a small body, to the bit: mesh, added mass, turbulence, run, table. The hash
/// is the same on every platform and with any number of threads; when it changes, so do the
/// trajectories of users, and the changelog must say so.
#[test]
fn golden_run() {
    let place = Place::new();
    let body = BALL
        .replace("ellipsoid", "box")
        .replace("semi_axes", "size");
    let file = place.write(
        "golden.toml",
        &scene(
            &body,
            "model = \"consistent\"\nduration = 0.5\nturbulence = \"history\"",
        ),
    );
    for threads in ["1", "2", "3"] {
        let output = Command::cargo_bin("langevin-rigid")
            .unwrap()
            .current_dir(place.0.path())
            .env("LANGEVIN_RIGID_CACHE", place.path(threads))
            .env("RAYON_NUM_THREADS", threads)
            .args(["simulate", &file, "--seed", "5", "--out", "golden"])
            .output()
            .unwrap();
        assert!(output.status.success());
        let csv = read(&place.path("golden/trajectory.csv"));
        let hash = csv.bytes().fold(0xCBF2_9CE4_8422_2325u64, |hash, byte| {
            (hash ^ u64::from(byte)).wrapping_mul(0x0000_0100_0000_01B3)
        });
        assert_eq!(hash, 17_848_633_060_189_663_007, "{threads} threads");
    }
}

#[test]
fn the_seed_decides_and_options_override_the_scene() {
    let place = Place::new();
    let file = place.write("ball.toml", &scene(BALL, "duration = 0.3"));
    let run = |options: &[&str]| {
        place
            .run(&[&["simulate", &file, "--json"], options].concat())
            .json()
    };
    let csv = || read(&place.path("out/ball/trajectory.csv"));
    run(&["--seed", "3"]);
    let first = csv();
    run(&["--seed", "3"]);
    assert_eq!(csv(), first);
    run(&["--seed", "4"]);
    assert_ne!(csv(), first);
    let summary = run(&["--dt", "0.01", "--duration", "0.5", "--model", "kirchhoff"]);
    assert_eq!(summary["steps"], 50);
    assert_eq!(summary["model"], "kirchhoff");
    assert_eq!(run(&["--turbulence", "history"])["turbulence"], "history");
    assert_eq!(
        run(&["--turbulence", "wake-age=16"])["turbulence"],
        "wake-age=16"
    );
}

#[test]
fn a_bake_is_made_once_and_made_again_when_its_input_changes() {
    let place = Place::new();
    let file = place.write("ball.toml", &scene(BALL, "duration = 0.1"));
    let cached = |file: &str| {
        place.run(&["simulate", file, "--json"]).json()["bake_cached"]
            .as_bool()
            .unwrap()
    };
    assert!(!cached(&file));
    assert!(cached(&file));
    let denser = BALL.replace("1500.0", "1600.0");
    let file = place.write("ball.toml", &scene(&denser, "duration = 0.1"));
    assert!(!cached(&file));
    // A damaged cache is no obstacle.
    for entry in std::fs::read_dir(place.path("cache")).unwrap() {
        std::fs::write(entry.unwrap().path(), b"LRBAKE").unwrap();
    }
    assert!(!cached(&file));
    assert!(cached(&file));
}

#[test]
fn a_bake_file_is_what_the_run_time_reads() {
    let place = Place::new();
    assert_eq!(
        place
            .run(&["bake", "table2-ellipsoid-320-5ms", "--out", "body.lrbake"])
            .code,
        0
    );
    let bytes = std::fs::read(place.path("body.lrbake")).unwrap();
    let bake = langevin_rigid::Bake::from_bytes(&bytes).unwrap();
    assert_eq!(bake.body.surface.triangles.len(), 320);
}

#[test]
fn divergence_is_an_error_that_keeps_what_was_computed() {
    let place = Place::new();
    let outcome = place.run(&["simulate", "paper-75", "--model", "published"]);
    outcome.fails_with(&["diverged", "t = ", "step", "consistent"]);
    let csv = read(&place.path("out/paper-75/trajectory.csv"));
    assert!(csv.lines().count() > 2);
    let summary: Value =
        serde_json::from_str(&read(&place.path("out/paper-75/summary.json"))).unwrap();
    assert_eq!(summary["ending"], "diverged");
}

const CUBE: &str = "\
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

#[test]
fn added_mass_of_a_cube_file() {
    let place = Place::new();
    let file = place.write("cube.obj", CUBE);
    let run = |options: &[&str]| {
        place
            .run(&[&["added-mass", &file, "--format", "json"], options].concat())
            .json()
    };
    let report = run(&["--fluid-density", "1"]);
    assert_eq!(report["triangles"], 12);
    let entry = |report: &Value, i: usize, j: usize| report["added_mass"][i][j].as_f64().unwrap();
    for i in 0..3 {
        assert!((entry(&report, i, i) / 0.638423 - 1.0).abs() < 3e-3);
        assert!((report["centroid"][i].as_f64().unwrap() - 0.5).abs() < 1e-12);
    }
    assert!((report["volume"].as_f64().unwrap() - 1.0).abs() < 1e-12);
    // In millimetres and water the mass is 1e-9 m^3 times 1000 kg/m^3.
    let small = run(&["--unit", "mm"]);
    assert!((entry(&small, 0, 0) / (1e-6 * entry(&report, 0, 0)) - 1.0).abs() < 1e-9);
    // About the corner a turn about z carries the cube along x and y.
    let corner = run(&["--about", "origin", "--fluid-density", "1"]);
    let wanted = entry(&report, 5, 5) + 0.25 * (entry(&report, 0, 0) + entry(&report, 1, 1));
    assert!((entry(&corner, 5, 5) / wanted - 1.0).abs() < 1e-9);

    let table = place.run(&["added-mass", &file]);
    assert!(table.out.contains("error estimate") && table.out.contains("rot z"));
}

#[test]
fn an_open_sheet_points_to_the_option_that_thickens_it() {
    let place = Place::new();
    let sheet = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3\nf 1 3 4\n";
    let file = place.write("sheet.obj", sheet);
    place
        .run(&["added-mass", &file])
        .fails_with(&["sheet.obj", "open", "--thickness"]);
    let outcome = place
        .run(&[
            "added-mass",
            &file,
            "--thickness",
            "0.01",
            "--format",
            "json",
        ])
        .json();
    assert!((outcome["volume"].as_f64().unwrap() - 0.01).abs() < 1e-12);
    let body = "mesh = \"sheet.obj\"\nunit = \"m\"\nthickness = 0.01\ndensity = 3000.0";
    let scene_file = place.write("sheet.toml", &scene(body, "duration = 0.1"));
    assert_eq!(place.run(&["simulate", &scene_file]).code, 0);
}

#[test]
fn bad_meshes_are_told_apart() {
    let place = Place::new();
    let refuse = |content: &str, words: &[&str]| {
        let file = place.write("bad.obj", content);
        place
            .run(&["added-mass", &file])
            .fails_with(&[&["bad.obj"], words].concat());
    };
    refuse(&CUBE.replace("v 1 1 1\n", "v 1 nan 1\n"), &["vertex"]);
    refuse(&CUBE.replace("f 4 1 5 8", "f 4 1 5 99"), &["99"]);
    refuse(&CUBE.replace("f 4 1 5 8", "f 4 1 5 5"), &["triangle"]);
    refuse(
        &CUBE.replace("f 4 1 5 8\n", "f 4 1 5 8\nf 4 1 5\n"),
        &["triangle"],
    );
    refuse(
        &CUBE.replace("f 4 1 5 8", "f 8 5 1 4"),
        &["opposite senses", "normals"],
    );
    refuse("v 0 0 0\n", &["triangle"]);
    refuse("", &[]);
    place
        .run(&["added-mass", "nowhere.obj"])
        .fails_with(&["nowhere.obj"]);

    // Inside out is mended and said.
    let turned: String = CUBE
        .lines()
        .map(|l| match l.strip_prefix("f ") {
            Some(f) => format!("f {}\n", f.split(' ').rev().collect::<Vec<_>>().join(" ")),
            None => format!("{l}\n"),
        })
        .collect();
    let outcome = place.run(&["added-mass", &place.write("turned.obj", &turned)]);
    assert_eq!(outcome.code, 0);
    assert!(outcome.err.contains("inside out"), "{}", outcome.err);
}

#[test]
fn mistakes_in_scenes_come_with_line_and_column() {
    let place = Place::new();
    let refuse = |text: &str, words: &[&str]| {
        let file = place.write("bad.toml", text);
        place.run(&["simulate", &file]).fails_with(words);
    };
    let good = scene(BALL, "duration = 0.1");
    refuse(
        &good.replace("triangles", "triangels"),
        &["bad.toml:6:1", "triangels"],
    );
    refuse(
        &good.replace("1500.0", "-1.0"),
        &["bad.toml:7:11", "density", "between 0 and 1e9"],
    );
    refuse(&good.replace("1500.0", "\"heavy\""), &["bad.toml:7:11"]);
    refuse(&good.replace("duration = 0.1", ""), &["duration", "ground"]);
    refuse(&good.replace("time_step = 0.005", ""), &["time_step"]);
    refuse(
        &good.replace("ellipsoid", "blob"),
        &["bad.toml:4:9", "blob", "washer"],
    );
    refuse(&good.replace("density = 1500.0", ""), &["density", "mass"]);
    refuse(
        &good.replace("[run]", "[run]\nmodel = \"magic\""),
        &["magic", "consistent"],
    );
    refuse(&good.replace("[run]", "[run"), &["bad.toml:8"]);
    refuse(
        &good.replace("triangles = 80", "triangles = 3"),
        &["triangles"],
    );
    place
        .run(&["simulate", "no-such-scene"])
        .fails_with(&["no-such-scene", "paper-75"]);
}

#[test]
fn a_run_that_cannot_end_or_begins_on_the_ground_is_refused() {
    let place = Place::new();
    let light = BALL.replace("1500.0", "500.0");
    let release = "ground = 0.0\n[release]\nposition = [0.0, 1.0, 0.0]";
    let file = place.write("cork.toml", &scene(&light, release));
    place.run(&["simulate", &file]).fails_with(&["duration"]);
    let low = release.replace("1.0", "0.005");
    let file = place.write("low.toml", &scene(BALL, &low));
    place
        .run(&["simulate", &file])
        .fails_with(&["ground", "higher"]);
}

#[test]
fn turbulence_is_a_table_that_decays_to_a_plateau() {
    let place = Place::new();
    let outcome = place.run(&["turbulence", "paper-75"]);
    let mut lines = outcome.out.lines();
    assert_eq!(lines.next(), Some("t,k,epsilon,chi"));
    let rows: Vec<Vec<f64>> = lines
        .map(|l| l.split(',').map(|x| x.parse().unwrap()).collect())
        .collect();
    for row in &rows {
        assert!((row[3] / (row[2] / row[1]) - 1.0).abs() < 1e-12);
    }
    assert!(rows[rows.len() - 1][3] < 0.5 * rows[0][3]);
    assert_eq!(
        place
            .run(&["turbulence", "paper-75", "--out", "t.csv"])
            .code,
        0
    );
    assert_eq!(read(&place.path("t.csv")), outcome.out);
}

#[test]
fn scenes_lists_every_scene_with_a_line() {
    let outcome = Place::new().run(&["scenes"]);
    for name in [
        "paper-75",
        "paper-30",
        "airplane",
        "ellipsoid-water",
        "table2-paper-5ms",
    ] {
        assert!(
            outcome
                .out
                .lines()
                .any(|l| l.starts_with(name) && l.len() > 30),
            "{name}"
        );
    }
}

#[test]
fn the_command_line_itself_is_checked() {
    let place = Place::new();
    for arguments in [
        &["simulate", "paper-75", "--dt", "-1"][..],
        &["simulate", "paper-75", "--model", "magic"],
        &["added-mass", "x.obj", "--unit", "furlong"],
        &["fly"],
    ] {
        assert_eq!(place.run(arguments).code, 2, "{arguments:?}");
    }
    let help = place.run(&["simulate", "--help"]);
    assert!(help.code == 0 && help.out.contains("Examples"));
}

#[test]
fn a_film_is_numbered_and_of_one_size() {
    let place = Place::new();
    let scene = place.write("ball.toml", &scene(BALL, "duration = 0.2"));
    let outcome = place.run(&[
        "simulate",
        &scene,
        "--view",
        "side",
        "--picture",
        "strobe",
        "--frames",
        "film",
        "--fps",
        "30",
    ]);
    assert_eq!(outcome.code, 0, "{}", outcome.err);
    assert!(
        outcome.out.contains("ffmpeg -framerate 30 -i"),
        "{}",
        outcome.out
    );
    // Width and height are in a PNG's first 24 bytes.
    let head = |n: u32| {
        let png = std::fs::read(place.path(&format!("film/frame-{n:05}.png"))).unwrap();
        png[16..24].to_vec()
    };
    assert!((2..=7).all(|n| head(n) == head(1)));
    assert_eq!(std::fs::read_dir(place.path("film")).unwrap().count(), 7);
    let refused = place.run(&["simulate", &scene, "--frames", "film", "--fps", "1e9"]);
    refused.fails_with(&["frames a second", "99999 at most"]);
}

#[test]
fn reproduce_writes_a_page_and_its_data() {
    let place = Place::new();
    let outcome = place.run(&[
        "reproduce",
        "--only",
        "fig5,fig2",
        "--seeds",
        "3",
        "--out",
        "r",
    ]);
    assert_eq!(outcome.code, 0, "{}", outcome.err);
    assert!(
        outcome.out.contains("report.html (fig2, fig5)"),
        "{}",
        outcome.out
    );
    let page = read(&place.path("r/report.html"));
    assert!(page.contains("<section id=\"fig5\">") && !page.contains("Not finished"));
    for part in ["fig2", "fig5"] {
        let numbers: Value =
            serde_json::from_str(&read(&place.path(&format!("r/{part}/numbers.json")))).unwrap();
        assert!(numbers.as_object().unwrap().len() > 10, "{part}");
    }
    let unknown = place.run(&["reproduce", "--only", "fig9"]);
    assert_eq!(unknown.code, 2);
    assert!(unknown.err.contains("fig2, fig3, fig4"), "{}", unknown.err);
}

#[test]
fn reproduce_updates_the_pages_of_a_manual() {
    let place = Place::new();
    let manual = place.path("manual");
    std::fs::create_dir(&manual).unwrap();
    let page = |name: &str| manual.join(name);
    let marked =
        |mark: &str| format!("Words.\n\n<!-- table: {mark} -->\nold\n<!-- end -->\nMore.\n");
    std::fs::write(page("a.md"), marked("fig2/turbulence")).unwrap();
    std::fs::write(page("b.md"), marked("coin/coin")).unwrap();
    let run = || {
        let only = ["reproduce", "--only", "fig2", "--seeds", "1", "--out", "r"];
        place.run(&[only.as_slice(), &["--update", "manual"]].concat())
    };
    let outcome = run();
    assert_eq!(outcome.code, 0, "{}", outcome.err);
    assert!(
        outcome.err.contains("updated manual/a.md"),
        "{}",
        outcome.err
    );
    let table = read(&place.path("r/fig2/turbulence.md"));
    assert!(table.starts_with("| where |"), "{table}");
    let wanted = marked("fig2/turbulence").replace("old\n", &table);
    assert_eq!(read(&page("a.md")), wanted);
    assert_eq!(read(&page("b.md")), marked("coin/coin"));

    std::fs::write(page("b.md"), marked("fig2/other")).unwrap();
    run().fails_with(&["manual/b.md", "`fig2/other`", "turbulence"]);
    assert_eq!(read(&page("a.md")), wanted);

    let nowhere = place.run(&["reproduce", "--only", "fig2", "--update", "nowhere"]);
    nowhere.fails_with(&["cannot read `nowhere`"]);
    assert!(!place.path("out").exists(), "said before the work");
}

#[test]
fn bench_prints_a_positive_figure_for_each_of_its_names() {
    let outcome = Place::new().run(&["bench", "--json"]);
    assert_eq!(outcome.code, 0, "{}", outcome.err);
    let figures: serde_json::Value = serde_json::from_str(&outcome.out).unwrap();
    let positive = |value: &serde_json::Value| value.as_f64().unwrap() > 0.0;
    for name in [
        "step",
        "step_batch",
        "step_batch_f32",
        "step_separated",
        "step_separated_batch",
        "step_separated_batch_f32",
        "step_gusts",
        "step_gusts_batch",
        "batch_scaling",
        "added_mass_1280_ms",
        "added_mass_5120_ms",
        "turbulence_cells_per_s",
        "turbulence_paper_ms",
    ] {
        assert!(positive(&figures[name]), "{name}");
    }
    let rows = figures["table2"].as_object().unwrap();
    assert!(rows.len() == 6 && rows.values().all(positive));
}

#[test]
fn a_crowd_counts_its_frames() {
    let place = Place::new();
    let file = place.write("ball.toml", &scene(BALL, "duration = 0.3"));
    let few = ["--bodies", "50", "--seconds", "0.05", "--json"];
    let report = place.run(&[&["crowd", &file], &few[..]].concat()).json();
    assert_eq!(report["bodies"], 50);
    assert_eq!(report["frames"], 3);
    assert!(report["missed_frames"].as_u64().unwrap() <= 3);
    assert!(report["median_frame_ms"].as_f64().unwrap() > 0.0);
    assert_eq!(place.run(&["crowd", &file, "--bodies", "0"]).code, 2);
}

#[test]
fn a_proxy_is_simpler_and_says_what_it_may_cost() {
    let place = Place::new();
    let sphere = langevin_rigid_bake::shapes::Shape::Ellipsoid {
        semi_axes: [0.1, 0.2, 0.3],
    };
    let mesh = sphere.mesh(5120).unwrap();
    let mut obj = String::new();
    for [x, y, z] in mesh.vertices() {
        obj += &format!("v {x} {y} {z}\n");
    }
    for t in mesh.triangles() {
        let [a, b, c] = t.map(|v| v + 1);
        obj += &format!("f {a} {b} {c}\n");
    }
    let file = place.write("sphere.obj", &obj);
    let run = |options: &[&str]| {
        place
            .run(&[&["added-mass", &file, "--format", "json"], options].concat())
            .json()
    };
    let (full, proxy) = (run(&[]), run(&["--proxy", "800"]));
    assert!(full.get("proxy").is_none());
    assert!(proxy["proxy"]["triangles"].as_u64().unwrap() <= 800);
    let number = |value: &serde_json::Value| value.as_f64().unwrap();
    assert!((number(&proxy["volume"]) / number(&full["volume"]) - 1.0).abs() < 1e-12);
    let entry = |report: &serde_json::Value| number(&report["added_mass"][0][0]);
    let error = (entry(&proxy) / entry(&full) - 1.0).abs();
    assert!(error < number(&proxy["error_estimate"]), "{error}");
    let table = place.run(&["added-mass", &file, "--proxy", "800"]).out;
    assert!(table.contains("which may cost"), "{table}");
    assert_eq!(place.run(&["added-mass", &file, "--proxy", "3"]).code, 2);
}
