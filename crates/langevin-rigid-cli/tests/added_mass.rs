//! `added-mass` in every format, as text that other programs take.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use assert_cmd::Command;
use serde_json::Value;

/// A unit cube with a corner at the origin.
const CUBE: &str = "\
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

fn run(arguments: &[&str]) -> (i32, String, String) {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("cube.obj"), CUBE).unwrap();
    let output = Command::cargo_bin("langevin-rigid")
        .unwrap()
        .current_dir(folder.path())
        .args(["added-mass", "cube.obj"])
        .args(arguments)
        .output()
        .unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    (
        output.status.code().unwrap(),
        text(output.stdout),
        text(output.stderr),
    )
}

fn printed(arguments: &[&str]) -> String {
    let (code, out, err) = run(arguments);
    assert_eq!((code, err.as_str()), (0, ""));
    out
}

fn tensor(arguments: &[&str]) -> [[f64; 6]; 6] {
    let report: Value =
        serde_json::from_str(&printed(&[&["--format", "json"], arguments].concat())).unwrap();
    serde_json::from_value(report["added_mass"].clone()).unwrap()
}

fn close(text: &str, value: f64) {
    let number: f64 = text.parse().unwrap();
    assert!(
        (number - value).abs() < 1e-8 * value.abs().max(1e-3),
        "{number} for {value}"
    );
}

#[test]
fn json_keeps_its_keys_and_states_its_conventions() {
    let report: Value = serde_json::from_str(&printed(&["--format", "json"])).unwrap();
    for key in [
        "triangles",
        "triangles_solved",
        "volume",
        "centroid",
        "fluid_density",
        "reference",
        "added_mass",
        "error_estimate",
        "warnings",
        "seconds",
    ] {
        assert!(!report[key].is_null(), "{key}");
    }
    assert_eq!(report["mesh"], "cube.obj");
    for key in ["fluid", "axes", "reference_point", "order", "sign"] {
        assert!(report["conventions"][key].is_string(), "{key}");
    }
}

#[test]
fn csv_is_about_the_point_asked_for() {
    let out = printed(&["--format", "csv", "--about", "origin"]);
    let expected = tensor(&["--about", "origin"]);
    let rows = out.lines().skip_while(|line| line.starts_with('#')).skip(1);
    for (row, numbers) in rows.zip(expected) {
        for (text, value) in row.split(',').zip(numbers) {
            close(text, value);
        }
    }
}

#[test]
fn sdf_and_uuv_are_about_the_origin_and_refuse_another_point() {
    let expected = tensor(&["--about", "origin"]);
    let sdf = printed(&["--format", "sdf"]);
    assert_eq!(sdf, printed(&["--format", "sdf", "--about", "origin"]));
    let yaw = sdf
        .split_once("<rr>")
        .unwrap()
        .1
        .split_once("</rr>")
        .unwrap()
        .0;
    close(yaw, expected[5][5]);
    let uuv = printed(&["--format", "uuv"]);
    let matrix = uuv
        .split_once("<added_mass>")
        .unwrap()
        .1
        .split_once("</")
        .unwrap()
        .0;
    let numbers: Vec<&str> = matrix.split_whitespace().collect();
    assert_eq!(numbers.len(), 36);
    close(numbers[11], expected[1][5]);
    close(numbers[5], -expected[0][5]);
    for format in ["sdf", "uuv"] {
        let (code, _, err) = run(&["--format", format, "--about", "com"]);
        assert!(code == 1 && err.contains("origin of the link"), "{err}");
    }
}

#[test]
fn programs_for_mujoco_and_capytaine_carry_the_matrix() {
    let mujoco = printed(&["--format", "mujoco", "--fluid-density", "500"]);
    let per_density = tensor(&["--fluid-density", "1"])[0][0];
    let first = mujoco.split_once("np.array([\n    [").unwrap().1;
    close(first.split_once(',').unwrap().0, per_density);
    assert!(mujoco.contains("def set_added_mass(model, geom):"));
    let (code, _, err) = run(&["--format", "mujoco", "--about", "origin"]);
    assert!(code == 1 && err.contains("takes no --about"), "{err}");

    let capytaine = printed(&["--format", "capytaine", "--about", "origin"]);
    let first = capytaine.split_once("np.array([\n    [").unwrap().1;
    close(first.split_once(',').unwrap().0, tensor(&[])[0][0]);
    assert!(capytaine.contains("[\"Surge\", \"Sway\", \"Heave\", \"Roll\", \"Pitch\", \"Yaw\"]"));
}

/// What is printed can be piped on whatever the mesh was like: warnings go to the other stream.
#[test]
fn warnings_stay_out_of_the_output() {
    let folder = tempfile::tempdir().unwrap();
    let inside_out = CUBE.lines().map(|line| match line.strip_prefix("f ") {
        Some(face) => format!(
            "f {}\n",
            face.split(' ').rev().collect::<Vec<_>>().join(" ")
        ),
        None => format!("{line}\n"),
    });
    std::fs::write(
        folder.path().join("turned.obj"),
        inside_out.collect::<String>(),
    )
    .unwrap();
    for format in ["table", "json", "csv", "sdf", "uuv", "mujoco", "capytaine"] {
        let output = Command::cargo_bin("langevin-rigid")
            .unwrap()
            .current_dir(folder.path())
            .args(["added-mass", "turned.obj", "--format", format])
            .output()
            .unwrap();
        let (out, err) = (output.stdout, String::from_utf8(output.stderr).unwrap());
        assert!(err.contains("warning: the mesh was inside out"), "{err}");
        let said = String::from_utf8(out).unwrap().contains("warning: ");
        assert!(output.status.success() && !said, "{format}");
    }
}
