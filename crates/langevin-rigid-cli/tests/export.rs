//! Runs in other formats: what `simulate --format`, `--bodies` and `export` write, and what they refuse.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

mod common;

use std::path::Path;

use common::{BALL, Place, read, scene};
use serde_json::Value;

fn files(folder: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut names: Vec<String> = entries
        .map(|entry| entry.unwrap().file_name().into_string().unwrap())
        .collect();
    names.sort();
    names
}

#[test]
fn simulate_writes_the_formats_that_are_asked_for() {
    let place = Place::new();
    let file = place.write("ball.toml", &scene(BALL, "duration = 0.3"));
    let usual = place.run(&["simulate", &file]);
    assert!(usual.out.contains("wrote trajectory.csv, trajectory.glb, "));
    let names = [
        "scene.toml",
        "summary.json",
        "trajectory.csv",
        "trajectory.glb",
        "trajectory.png",
    ];
    assert_eq!(files(&place.path("out/ball")), names);
    place.run(&["simulate", &file, "--format", "npz,usd", "--out", "other"]);
    let others = files(&place.path("other"));
    assert!(
        others.contains(&"trajectory.npz".into()) && others.contains(&"trajectory.usda".into())
    );
    assert!(!others.contains(&"trajectory.csv".into()));
}

#[test]
fn an_export_is_what_simulate_had_written() {
    let place = Place::new();
    let file = place.write("ball.toml", &scene(BALL, "duration = 0.3"));
    let all = "csv,glb,usd,npz";
    place.run(&["simulate", &file, "--format", all, "--out", "run"]);
    let outcome = place.run(&["export", "run", "--format", all, "--out", "again"]);
    assert_eq!(outcome.code, 0, "{}", outcome.err);
    assert!(
        outcome.out.contains("60 frames a second, within 0."),
        "{}",
        outcome.out
    );
    for name in files(&place.path("again")) {
        let bytes = |folder: &str| std::fs::read(place.path(folder).join(&name)).unwrap();
        assert!(bytes("run") == bytes("again"), "{name}");
    }
    assert_eq!(files(&place.path("again")).len(), 4);
    place.run(&[
        "export", "run", "--fps", "24", "--up", "z", "--format", "usd",
    ]);
    let layer = read(&place.path("run/trajectory.usda"));
    for line in [
        "upAxis = \"Z\"",
        "timeCodesPerSecond = 24",
        "endTimeCode = 7.2",
    ] {
        assert!(layer.contains(line), "{line}");
    }
}

#[test]
fn many_bodies_are_released_side_by_side_and_the_first_falls_as_it_does_alone() {
    let place = Place::new();
    let file = place.write(
        "ball.toml",
        &scene(BALL, "duration = 0.2\n[scatter]\nvelocity = 0.1"),
    );
    let alone = place.run(&["simulate", &file, "--out", "alone"]);
    assert_eq!(alone.code, 0, "{}", alone.err);
    let summary = place.run(&[
        "simulate", &file, "--bodies", "30", "--out", "many", "--json",
    ]);
    let summary = summary.json();
    assert_eq!(summary["bodies"], 30);
    assert_eq!(summary["endings"]["time"], 30);
    let (one, many) = (
        read(&place.path("alone/trajectory.csv")),
        read(&place.path("many/trajectory.csv")),
    );
    assert!(many.starts_with(&one));
    assert_eq!(many.lines().count(), 1 + 30 * 41);
    let last = many.lines().last().unwrap();
    assert!(last.starts_with("29,"), "{last}");
}

#[test]
fn what_cannot_be_exported_says_what_to_do() {
    let place = Place::new();
    place
        .run(&["export", "nowhere"])
        .fails_with(&["nowhere/trajectory.csv", "langevin-rigid simulate"]);
    let file = place.write("ball.toml", &scene(BALL, "duration = 0.1"));
    place.run(&["simulate", &file, "--out", "run"]);
    let table = read(&place.path("run/trajectory.csv"));

    place
        .run(&["export", "run", "--format", "csv", "--up", "z"])
        .fails_with(&["run's own table", "--out"]);
    place.run(&["export", "run", "--fps", "1e12"]).fails_with(&[
        "--fps 1000000000000.0",
        "of memory",
        "ask for less",
    ]);
    for unknown in [
        ["export", "run", "--format", "fbx"],
        ["export", "run", "--up", "x"],
        ["export", "run", "--fps", "-3"],
    ] {
        let outcome = place.run(&unknown);
        assert_eq!(outcome.code, 2, "{unknown:?}");
    }
    std::fs::write(
        place.path("run/trajectory.csv"),
        table.replacen("\n0,0.005,", "\n0,x,", 1),
    )
    .unwrap();
    place
        .run(&["export", "run"])
        .fails_with(&["trajectory.csv", "line 3", "`x` is not a number"]);
    std::fs::remove_file(place.path("run/scene.toml")).unwrap();
    std::fs::write(place.path("run/trajectory.csv"), table).unwrap();
    place.run(&["export", "run"]).fails_with(&["scene.toml"]);
}

#[test]
#[cfg(not(feature = "parquet"))]
fn a_format_that_was_left_out_says_so_before_anything_is_computed() {
    let place = Place::new();
    let words = ["cannot write parquet", "--features parquet"];
    place
        .run(&["simulate", "leaf", "--format", "csv,parquet"])
        .fails_with(&words);
    assert!(!place.path("out").exists());
    place
        .run(&["export", "run", "--format", "parquet"])
        .fails_with(&words);
}

#[test]
fn the_table_of_an_older_run_is_not_taken_for_that_of_the_last() {
    let place = Place::new();
    let file = place.write("ball.toml", &scene(BALL, "duration = 0.1"));
    place.run(&["simulate", &file, "--out", "run"]);
    assert_eq!(place.run(&["export", "run"]).code, 0);
    place.run(&[
        "simulate", &file, "--seed", "9", "--format", "glb", "--out", "run",
    ]);
    place
        .run(&["export", "run", "--format", "usd"])
        .fails_with(&["run/trajectory.csv", "older run", "csv among its formats"]);
}

#[test]
fn a_format_that_fails_takes_no_other_with_it() {
    let place = Place::new();
    let file = place.write("ball.toml", &scene(BALL, "duration = 0.1"));
    let impossible = ["simulate", &file, "--format", "glb,npz", "--fps", "2e8"];
    place
        .run(&impossible)
        .fails_with(&["200000000 frames a second of 0.1", "at most"]);
    let written = files(&place.path("out/ball"));
    for name in [
        "trajectory.npz",
        "trajectory.csv",
        "scene.toml",
        "summary.json",
    ] {
        assert!(written.contains(&name.into()), "{name}");
    }
}

#[test]
fn what_was_computed_before_it_diverged_is_exported_too() {
    let place = Place::new();
    let run = "duration = 50.0\nmodel = \"published\"";
    let file = place.write("wild.toml", &scene(BALL, run));
    let outcome = place.run(&["simulate", &file, "--dt", "0.5", "--out", "wild"]);
    outcome.fails_with(&["diverged"]);
    let summary: Value = serde_json::from_str(&read(&place.path("wild/summary.json"))).unwrap();
    assert_eq!(summary["ending"], "diverged");
    assert!(place.path("wild/trajectory.glb").exists());
}
