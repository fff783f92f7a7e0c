//! Runs that a signal ends.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#![cfg(unix)]

mod common;

use std::io::Read;
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use common::{BALL, Place, read, scene};
use langevin_rigid_formats::trajectory::read_csv;

const SIGNALS: [(&str, i32); 3] = [("HUP", 129), ("INT", 130), ("TERM", 143)];

fn start(place: &Place, arguments: &[&str]) -> Child {
    // Whoever runs the tests may have signals ignored (`nohup`), which a child inherits.
    Command::new("env")
        .arg("--default-signal=HUP,INT,TERM")
        .arg(assert_cmd::cargo::cargo_bin("langevin-rigid"))
        .current_dir(place.0.path())
        .env("LANGEVIN_RIGID_CACHE", place.path("cache"))
        .args(arguments)
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .spawn()
        .unwrap()
}

fn signal(child: &Child, name: &str) {
    let kill = format!("kill -{name} {}", child.id());
    // It may have ended before.
    let _ = Command::new("sh").args(["-c", &kill]).output().unwrap();
}

/// Sends a signal after a while; how the process ended, and how long that took.
fn ended(child: Child, after: Duration, name: &str) -> (Output, Duration) {
    std::thread::sleep(after);
    signal(&child, name);
    let asked = Instant::now();
    let output = child.wait_with_output().unwrap();
    (output, asked.elapsed())
}

fn ball(run: &str) -> Place {
    let place = Place::new();
    place.write("ball.toml", &scene(BALL, run));
    place
}

#[test]
fn work_under_way_stops_and_tells_what_it_has() {
    let place = ball("duration = 0.1");
    for (name, code) in SIGNALS {
        let crowd = start(
            &place,
            &[
                "crowd",
                "ball.toml",
                "--bodies=8",
                "--seconds=600",
                "--json",
            ],
        );
        let (output, _) = ended(crowd, Duration::from_secs(2), name);
        assert_eq!(output.status.code(), Some(code), "{name}");
        let report: serde_json::Value = serde_json::from_slice(&output.stdout).unwrap();
        assert!(report["frames"].as_u64().unwrap() > 0);
    }
}

#[test]
fn a_stuck_program_ends_at_once() {
    let place = ball("duration = 0.1");
    let made = Command::new("mkfifo").arg(place.path("pipe")).status();
    assert!(made.unwrap().success());
    for (name, code) in SIGNALS {
        // Nobody reads the pipe: opening it waits for ever.
        let bake = start(&place, &["bake", "ball.toml", "--out", "pipe"]);
        let (output, taken) = ended(bake, Duration::from_secs(2), name);
        assert_eq!(output.status.code(), Some(code), "{name}");
        assert!(taken < Duration::from_secs(1), "{name} took {taken:?}");
    }
}

#[test]
fn a_page_is_served_until_a_signal() {
    let place = Place::new();
    for (name, code) in SIGNALS {
        let mut view = start(&place, &["view", "--no-open", "--port=0"]);
        // It listens to signals before it gives its address.
        let mut byte = [0];
        view.stdout.as_mut().unwrap().read_exact(&mut byte).unwrap();
        let (output, taken) = ended(view, Duration::ZERO, name);
        assert_eq!(output.status.code(), Some(code), "{name}");
        assert!(taken < Duration::from_secs(1), "{name} took {taken:?}");
    }
}

#[test]
fn a_second_signal_ends_at_once() {
    let place = ball("duration = 40.0");
    // What was computed takes long to write.
    let run = start(
        &place,
        &["simulate", "ball.toml", "--bodies=1000", "--out=out"],
    );
    std::thread::sleep(Duration::from_millis(2500));
    signal(&run, "INT");
    std::thread::sleep(Duration::from_millis(300));
    let (output, taken) = ended(run, Duration::ZERO, "TERM");
    let code = output.status.code().unwrap();
    assert!([143, 130].contains(&code), "{code}");
    assert!(taken < Duration::from_secs(1), "{taken:?}");
    whole(&place);
}

#[test]
fn whenever_a_run_is_ended_its_files_are_whole() {
    let place = ball("duration = 10.0");
    for round in 0..12u64 {
        let run = start(
            &place,
            &[
                "simulate",
                "ball.toml",
                "--bodies=100",
                "--out=out",
                "--format=csv,npz,glb",
            ],
        );
        let (name, code) = SIGNALS[round as usize % 3];
        // Moments all over the run, as odd as they can be and the same every time.
        let after = Duration::from_millis(20 + (round * 617) % 1500);
        let (output, _) = ended(run, after, name);
        let ended = output.status.code();
        // Before there is a handler the signal itself ends it.
        assert!(
            ended.is_none() || ended == Some(0) || ended == Some(code),
            "{ended:?}"
        );
        whole(&place);
    }
}

/// No temporary file, and no half result.
fn whole(place: &Place) {
    let Ok(files) = std::fs::read_dir(place.path("out")) else {
        return;
    };
    for file in files {
        let path = file.unwrap().path();
        let name = path.file_name().unwrap().to_str().unwrap();
        match name {
            "trajectory.csv" => {
                read_csv(&read(&path)).unwrap();
            }
            "summary.json" => {
                let _: serde_json::Value = serde_json::from_str(&read(&path)).unwrap();
            }
            "trajectory.glb" => {
                let bytes = std::fs::read(&path).unwrap();
                let length = u32::from_le_bytes(bytes[8..12].try_into().unwrap());
                assert_eq!(bytes.len(), length as usize);
            }
            "trajectory.npz" => {
                let bytes = std::fs::read(&path).unwrap();
                assert!(bytes.windows(4).rev().take(64).any(|w| w == b"PK\x05\x06"));
            }
            "trajectory.png" | "scene.toml" => {}
            other => panic!("{other} was left behind"),
        }
    }
}
