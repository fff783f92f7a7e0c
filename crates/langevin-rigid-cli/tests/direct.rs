//! Falls that are found, through the command: what `direct` writes falls again under `simulate` to the same end.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::path::Path;
use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

const CARD: &str = "fluid.preset = \"air\"\n\
    run = { time_step = 0.004, duration = 4.0, ground = 0.0 }\n\
    body = { shape = \"box\", size = [0.085, 0.0003, 0.055], triangles = 300, density = 900.0 }\n\
    release = { position = [0.0, 0.5, 0.0], tilt = 20.0 }\n";

fn run(place: &Path, arguments: &[&str]) -> Output {
    Command::cargo_bin("langevin-rigid")
        .unwrap()
        .current_dir(place)
        .env("LANGEVIN_RIGID_CACHE", place.join("cache"))
        .args(arguments)
        .output()
        .unwrap()
}

fn json(place: &Path, arguments: &[&str]) -> Value {
    let output = run(place, arguments);
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{complaint}");
    serde_json::from_slice(&output.stdout).unwrap()
}

#[test]
fn what_is_found_is_simulated_again() {
    let place = tempfile::tempdir().unwrap();
    let place = place.path();
    std::fs::write(place.join("drawn.csv"), "x,y,z\n0,0.5,0\n0.1,0,0\n").unwrap();
    let asked = "[direct]\nbest = 2\nfalls = 600\nsteer = 0.2\nfree = { tilt = 30, heading = 180 }\n\
                 land = { at = [0.1, 0, 0], within = 0.1 }\npath = { file = \"drawn.csv\", within = 0.1 }\n";
    std::fs::write(place.join("card.toml"), format!("{CARD}{asked}")).unwrap();
    let found = json(place, &["direct", "card.toml", "--json"]);
    let best = found["best"].as_array().unwrap();
    assert_eq!(best.len(), 2);
    assert_eq!(best[0]["score"], 0.0);
    assert!(found["hits"].as_u64().unwrap() >= found["drawn_hits"].as_u64().unwrap());
    let folder = place.join("out/card-direct");
    let table = std::fs::read_to_string(folder.join("best.csv")).unwrap();
    let mut lines = table.lines();
    assert!(lines.next().unwrap().ends_with("miss_place,miss_path"));
    assert_eq!(lines.count(), 2);
    for (number, best) in (1..).zip(best) {
        assert!(folder.join(format!("best-{number}.png")).exists());
        let scene = format!("out/card-direct/best-{number}.toml");
        let again = json(place, &["simulate", &scene, "--json", "--out", "again"]);
        assert_eq!(again["duration"], best["time"]);
        let states = std::fs::read_to_string(place.join("again/trajectory.csv")).unwrap();
        let last: Vec<&str> = states.lines().last().unwrap().split(',').collect();
        for coordinate in best["end"].as_array().unwrap() {
            let wanted = coordinate.as_f64().unwrap();
            assert!(
                last.iter().any(|x| x.parse() == Ok(wanted)),
                "{wanted} in {last:?}"
            );
        }
    }
}

#[test]
fn what_cannot_be_found_is_told() {
    let place = tempfile::tempdir().unwrap();
    let place = place.path();
    let asked = "direct.land = { at = [100, 0, 0], within = 0.1 }\n";
    std::fs::write(place.join("far.toml"), format!("{CARD}{asked}")).unwrap();
    let output = run(
        place,
        &["direct", "far.toml", "--falls", "40", "--best", "1"],
    );
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{complaint}");
    assert!(
        complaint.contains("no fall of 40 does what is asked"),
        "{complaint}"
    );

    std::fs::write(place.join("card.toml"), CARD).unwrap();
    let output = run(place, &["direct", "card.toml"]);
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1));
    assert!(complaint.contains("[direct]"), "{complaint}");
}
