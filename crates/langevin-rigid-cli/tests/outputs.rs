//! Where results go: permissions, links, devices, folders in use, and a cache that is not believed.
#![allow(clippy::unwrap_used, reason = "a test may panic")]
#![cfg(unix)]

mod common;

use std::fs::{File, Permissions, metadata, set_permissions};
use std::os::unix::fs::{FileTypeExt, PermissionsExt};
use std::path::Path;
use std::process::Command;

use common::{BALL, Place, scene};
use langevin_rigid::Bake;

fn mode(path: &Path) -> u32 {
    metadata(path).unwrap().permissions().mode() & 0o777
}

/// The command after some shell, in a place.
fn shell(place: &Place, line: &str) -> std::process::Output {
    let command = assert_cmd::cargo::cargo_bin("langevin-rigid");
    Command::new("sh")
        .current_dir(place.0.path())
        .env("LANGEVIN_RIGID_CACHE", place.path("cache"))
        .args([
            "-c",
            &line.replace("langevin-rigid", &command.display().to_string()),
        ])
        .output()
        .unwrap()
}

fn ball() -> Place {
    let place = Place::new();
    place.write("ball.toml", &scene(BALL, "duration = 0.1"));
    place
}

#[test]
fn new_files_follow_the_mask_and_old_ones_keep_their_permissions() {
    let place = ball();
    for (mask, expected) in [("077", 0o600), ("022", 0o644), ("002", 0o664)] {
        let line = format!("umask {mask}; langevin-rigid simulate ball.toml --out o{mask}");
        assert!(shell(&place, &line).status.success());
        for name in [
            "trajectory.csv",
            "trajectory.glb",
            "trajectory.png",
            "summary.json",
        ] {
            let file = place.path(&format!("o{mask}/{name}"));
            assert_eq!(mode(&file), expected, "{name} under {mask}");
        }
    }
    let table = place.path("o022/trajectory.csv");
    set_permissions(&table, Permissions::from_mode(0o604)).unwrap();
    let again = "umask 077; langevin-rigid simulate ball.toml --out o022";
    assert!(shell(&place, again).status.success());
    assert_eq!(mode(&table), 0o604);
}

#[test]
fn pipes_and_devices_are_written_into() {
    let place = ball();
    let written = shell(&place, "langevin-rigid bake ball.toml --out ball.lrbake");
    assert!(written.status.success());
    let bake = std::fs::read(place.path("ball.lrbake")).unwrap();

    let through = "mkfifo pipe; cat pipe > copy & langevin-rigid bake ball.toml --out pipe; wait";
    assert!(shell(&place, through).status.success());
    assert!(metadata(place.path("pipe")).unwrap().file_type().is_fifo());
    assert_eq!(std::fs::read(place.path("copy")).unwrap(), bake);

    let out = shell(&place, "langevin-rigid bake ball.toml --out /dev/stdout").stdout;
    assert!(out.starts_with(&bake));

    // Where we may make a device.
    if shell(&place, "mknod null c 1 3 && : > null")
        .status
        .success()
    {
        assert!(
            shell(&place, "langevin-rigid bake ball.toml --out null")
                .status
                .success()
        );
        assert!(
            metadata(place.path("null"))
                .unwrap()
                .file_type()
                .is_char_device()
        );
    }
}

#[test]
fn a_folder_in_place_of_a_file_is_told_once_and_before_the_work() {
    let place = ball();
    std::fs::create_dir(place.path("taken.lrbake")).unwrap();
    let outcome = place.run(&["bake", "ball.toml", "--out", "taken.lrbake"]);
    outcome.fails_with(&["cannot write `taken.lrbake`: it is a folder; name a file"]);
    assert_eq!(outcome.err.matches("folder").count(), 1);
    for command in [
        ["simulate", "ball.toml", "--out", "ball.toml/o"],
        ["regimes", "--grid=2x2", "--out", "ball.toml/o"],
        ["reproduce", "--only=fig2", "--out", "ball.toml/o"],
        ["turbulence", "ball.toml", "--out", "ball.toml/o"],
    ] {
        place
            .run(&command)
            .fails_with(&["cannot write `ball.toml/o`"]);
    }
    assert!(
        !place.path("cache").exists(),
        "there was work before the refusal"
    );
}

#[test]
fn a_run_that_fails_leaves_no_folder() {
    let place = Place::new();
    place.write("low.toml", &scene(BALL, "ground = -0.005"));
    place
        .run(&["simulate", "low.toml", "--out", "a/b"])
        .fails_with(&["already touches the ground"]);
    assert!(!place.path("a").exists());
}

#[test]
fn a_folder_that_another_run_writes_to_is_left_alone() {
    let place = ball();
    std::fs::create_dir(place.path("out")).unwrap();
    let held = File::open(place.path("out")).unwrap();
    held.try_lock().unwrap();
    let run = ["simulate", "ball.toml", "--out", "out"];
    place
        .run(&run)
        .fails_with(&["`out`", "another run is writing"]);
    drop(held);
    assert_eq!(place.run(&run).code, 0);
    // Pictures may go where the rest goes.
    let film = place.run(&[
        "simulate",
        "ball.toml",
        "--out",
        "out",
        "--frames",
        "out",
        "--fps",
        "10",
    ]);
    assert_eq!(film.code, 0, "{}", film.err);
}

#[test]
fn a_kept_bake_is_not_believed() {
    let place = ball();
    let run = ["simulate", "ball.toml", "--json"];
    let mass = place.run(&run).json()["mass"].as_f64().unwrap();
    let mut kept = std::fs::read_dir(place.path("cache")).unwrap();
    let kept = kept.next().unwrap().unwrap().path();
    let honest = std::fs::read(&kept).unwrap();

    let mut changed = Bake::from_bytes(&honest).unwrap();
    changed.body.mass *= 3.0;
    for forged in [changed.to_bytes(), honest[..honest.len() / 2].to_vec()] {
        std::fs::write(&kept, forged).unwrap();
        let outcome = place.run(&run);
        assert!(
            outcome.err.contains("note: the kept bake"),
            "{}",
            outcome.err
        );
        assert_eq!(outcome.json()["mass"].as_f64().unwrap(), mass);
        assert_eq!(std::fs::read(&kept).unwrap(), honest);
    }
    let outcome = place.run(&run);
    assert!(!outcome.err.contains("note:"), "{}", outcome.err);
    assert_eq!(outcome.json()["bake_cached"], true);
}

#[test]
fn streams_that_are_full_or_closed_are_no_panic() {
    if !Path::new("/dev/full").exists() {
        return;
    }
    let place = ball();
    for (line, code) in [
        ("langevin-rigid simulate nope 2>/dev/full", 1),
        ("langevin-rigid simulate nope 2>&-", 1),
        ("langevin-rigid scenes >/dev/full", 1),
        (
            "langevin-rigid simulate ball.toml >/dev/full 2>/dev/full",
            1,
        ),
    ] {
        assert_eq!(shell(&place, line).status.code(), Some(code), "{line}");
    }
    let told = shell(&place, "langevin-rigid scenes >/dev/full").stderr;
    let told = String::from_utf8(told).unwrap();
    assert!(told.contains("cannot write to standard output"), "{told}");
}

#[test]
fn names_do_not_act_on_the_terminal() {
    let place = Place::new();
    let name = "\u{1b}[31mred\u{7}.toml";
    place.write(name, &scene(BALL, "duration = 0.05"));
    let good = place.run(&["simulate", name]);
    assert_eq!(good.code, 0, "{}", good.err);
    place.write(name, &scene("shape = \"\\u001b[2J\"", ""));
    let bad = place.run(&["simulate", name]);
    bad.fails_with(&["\\u{1b}[31mred"]);
    for text in [good.out, good.err, bad.out, bad.err] {
        assert!(
            text.chars().all(|c| c == '\n' || !c.is_control()),
            "{text:?}"
        );
    }
}

#[test]
fn work_that_cannot_be_is_refused_by_its_option() {
    let place = ball();
    for (arguments, words) in [
        (
            ["simulate", "ball.toml", "--bodies=4000000000"],
            ["--bodies 4000000000", "ask for less"],
        ),
        (
            ["simulate", "ball.toml", "--fps=1e12"],
            ["--fps 1000000000000.0", "memory"],
        ),
        (["simulate", "ball.toml", "--dt=1e-300"], ["--dt", "steps"]),
        (
            ["ensemble", "ball.toml", "--runs=4294967295"],
            ["--runs 4294967295", "ask for less"],
        ),
        (
            ["crowd", "ball.toml", "--bodies=4000000000"],
            ["--bodies 4000000000", "steps"],
        ),
        (
            ["crowd", "ball.toml", "--seconds=1e17"],
            ["--seconds 1e17", "steps"],
        ),
        (
            ["crowd", "ball.toml", "--seconds=1e308"],
            ["--seconds 1e308", "steps"],
        ),
        (
            ["reproduce", "--only=fig2", "--seeds=4000000000"],
            ["--seeds 4000000000", "steps"],
        ),
        (
            ["reproduce", "--only=fig2", "--seed=18446744073709551615"],
            ["--seed 18446744073709551615", "begin lower"],
        ),
    ] {
        place.run(&arguments).fails_with(&words);
    }
    let film = ["simulate", "ball.toml", "--fps=1e7", "--frames=film"];
    place.run(&film).fails_with(&["--frames", "99999"]);
    assert!(!place.path("film").exists());
}
