//! The map of the regimes, through the command.
//!
//! The agreement is computed again here from the table of runs, with the published boundaries as the
//! papers have them: discs steady below Re 100, else flutter to I* 0.01, chaos to 0.04, tumbling above
//! (Field et al. 1997); strips flutter below Fr = sqrt(I*) = 0.67 and tumble above (Belmonte et al.
//! 1998). If it falls below 0.8 the closure no longer knows which plates tumble; if it differs from
//! the command's, the command compares something else than it says.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use std::process::Output;

use assert_cmd::Command;
use serde_json::Value;

const GRID: [usize; 2] = [7, 4];

fn command(folder: &std::path::Path, threads: &str, arguments: &[&str]) -> Output {
    Command::cargo_bin("langevin-rigid")
        .unwrap()
        .current_dir(folder)
        .env("RAYON_NUM_THREADS", threads)
        .arg("regimes")
        .args(arguments)
        .output()
        .unwrap()
}

/// Plate, Re, I*, motion.
fn rows(table: &str) -> Vec<(String, f64, f64, String)> {
    let mut lines = table.lines();
    let header = "plate,re,inertia_ratio,tilt,motion,turnovers,swings";
    assert_eq!(lines.next(), Some(header));
    lines
        .map(|line| {
            let cells: Vec<&str> = line.split(',').collect();
            let number = |i: usize| cells[i].parse::<f64>().unwrap();
            (cells[0].into(), number(1), number(2), cells[4].into())
        })
        .collect()
}

fn published(plate: &str, re: f64, ratio: f64) -> &'static str {
    match plate {
        _ if re < 100.0 => "steady",
        "disc" if ratio < 0.01 => "flutter",
        "disc" if ratio < 0.04 => "chaotic",
        "strip" if ratio.sqrt() < 0.67 => "flutter",
        _ => "tumble",
    }
}

/// None within a factor 1.5 of a boundary.
fn comparable(plate: &str, re: f64, ratio: f64) -> Option<&'static str> {
    let here = published(plate, re, ratio);
    let near = [1.0 / 1.5, 1.5].into_iter().any(|f| {
        [1.0 / 1.5, 1.0, 1.5]
            .into_iter()
            .any(|g| published(plate, f * re, g * ratio) != here)
    }) || [1.0 / 1.5, 1.5]
        .into_iter()
        .any(|g| published(plate, re, g * ratio) != here);
    (!near).then_some(here)
}

fn majority(motions: &[&str]) -> String {
    const BY_DISORDER: [&str; 4] = ["steady", "flutter", "tumble", "chaotic"];
    let count = |m: &str| motions.iter().filter(|n| **n == m).count();
    // The last of several largest.
    BY_DISORDER
        .into_iter()
        .max_by_key(|m| count(m))
        .unwrap()
        .into()
}

/// Compared and agreeing points.
fn agreement(table: &str) -> [u64; 2] {
    let (mut compared, mut agreeing) = (0, 0);
    for point in rows(table).chunks(3) {
        let (plate, re, ratio, _) = &point[0];
        let same = |p: &(String, f64, f64, String)| (&p.0, p.1, p.2) == (plate, *re, *ratio);
        assert!(point.iter().all(same), "{point:?}");
        let motions: Vec<&str> = point.iter().map(|p| p.3.as_str()).collect();
        if let Some(expected) = comparable(plate, *re, *ratio) {
            compared += 1;
            agreeing += u64::from(majority(&motions) == expected);
        }
    }
    [compared, agreeing]
}

#[test]
fn plates_fall_as_published_and_all_of_it_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let output = command(folder.path(), "2", &["--grid", "7x4", "--json"]);
    let complaint = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(0), "{complaint}");
    let path = |name: &str| folder.path().join("out/regimes").join(name);
    let read = |name: &str| std::fs::read_to_string(path(name)).unwrap();

    let table = read("regimes.csv");
    assert_eq!(rows(&table).len(), 2 * GRID[0] * GRID[1] * 3);
    let [compared, agreeing] = agreement(&table);
    assert!(compared > 20, "{compared} compared");
    let share = agreeing as f64 / compared as f64;
    assert!(share >= 0.8, "{agreeing} of {compared} agree");

    let written: Value = serde_json::from_str(&read("regimes.json")).unwrap();
    let printed: Value = serde_json::from_slice(&output.stdout).unwrap();
    assert_eq!(printed, written);
    assert_eq!(written["compared"].as_u64(), Some(compared));
    assert_eq!(written["agreeing"].as_u64(), Some(agreeing));
    assert_eq!(written["agreement"].as_f64(), Some(share));
    assert_eq!(written["model"], "separated");
    for key in ["version", "tilts", "uncertainty", "warnings", "seconds"] {
        assert!(!written[key].is_null(), "{key}");
    }
    for plate in written["plates"].as_array().unwrap() {
        assert_eq!(plate["points"].as_array().unwrap().len(), GRID[0] * GRID[1]);
        let boundaries = plate["published"]["boundaries"].as_array().unwrap();
        assert!(boundaries.iter().all(|b| b["source"].is_string()));
    }

    for name in [
        "regimes",
        "strobe-steady",
        "strobe-flutter",
        "strobe-tumble",
    ] {
        let png = std::fs::read(path(&format!("{name}.png"))).unwrap();
        assert!(png.starts_with(b"\x89PNG"), "{name}");
    }
}

#[test]
fn threads_decide_nothing() {
    let folder = tempfile::tempdir().unwrap();
    let table = |threads: &str| {
        let output = command(folder.path(), threads, &["--grid", "2x3", "--out", "o"]);
        assert!(output.status.success());
        std::fs::read_to_string(folder.path().join("o/regimes.csv")).unwrap()
    };
    assert_eq!(table("1"), table("3"));
}

#[test]
fn bad_grids_and_places_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    for bad in ["10", "1x6", "10x", "0x0", "101x5", "-3x4", "axb", "3x3x3"] {
        let output = command(folder.path(), "1", &[&format!("--grid={bad}")]);
        let complaint = String::from_utf8(output.stderr).unwrap();
        assert_eq!(output.status.code(), Some(2), "{bad}");
        assert!(complaint.contains("2 to 100"), "{complaint}");
    }
    std::fs::write(folder.path().join("file"), "x").unwrap();
    let output = command(folder.path(), "2", &["--grid", "2x2", "--out", "file"]);
    let complaint = String::from_utf8(output.stderr).unwrap();
    assert_eq!(output.status.code(), Some(1), "{complaint}");
    assert!(complaint.contains("cannot write"), "{complaint}");
}
