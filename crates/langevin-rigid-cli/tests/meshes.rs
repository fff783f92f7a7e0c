//! `check` and `repair` as their users meet them.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use assert_cmd::Command;
use serde_json::Value;

struct Place(tempfile::TempDir);

impl Place {
    fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    fn write(&self, name: &str, content: &str) {
        std::fs::write(self.0.path().join(name), content).unwrap();
    }

    fn exists(&self, name: &str) -> bool {
        self.0.path().join(name).exists()
    }

    /// Exit code, standard output and standard error.
    fn run(&self, arguments: &[&str]) -> (i32, String, String) {
        let output = Command::cargo_bin("langevin-rigid")
            .unwrap()
            .current_dir(self.0.path())
            .args(arguments)
            .output()
            .unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).unwrap();
        (
            output.status.code().unwrap(),
            text(output.stdout),
            text(output.stderr),
        )
    }

    fn json(&self, arguments: &[&str]) -> (i32, Value) {
        let (code, out, _) = self.run(&[arguments, &["--json"]].concat());
        (code, serde_json::from_str(&out).unwrap())
    }
}

const CUBE: &str = "\
v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1
f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n";

const SHEET: &str = "v 0 0 0\nv 1 0 0\nv 1 0 1\nv 0 0 1\nf 1 2 3\nf 1 3 4\n";

/// A cube without a face, with a face turned and another twice.
fn bad_cube() -> String {
    let open = CUBE.replace("f 5 6 7 8\n", "");
    open.replace("f 4 1 5 8", "f 8 5 1 4") + "f 1 2 6 5\n"
}

#[test]
fn a_good_mesh_is_ready_and_its_cost_foretold() {
    let place = Place::new();
    place.write("cube.obj", CUBE);
    let (code, out, _) = place.run(&["check", "cube.obj"]);
    assert_eq!(code, 0);
    for words in [
        "verdict         ready",
        "added-mass      about",
        "intersections   none",
    ] {
        assert!(out.contains(words), "{out}");
    }
    let (code, report) = place.json(&["check", "cube.obj", "--unit", "cm"]);
    assert_eq!((code, &report["ready"]), (0, &Value::Bool(true)));
    assert!((report["volume"].as_f64().unwrap() / 1e-6 - 1.0).abs() < 1e-12);
    let expected = &report["expected"];
    assert!(expected["seconds"].as_f64().unwrap() > 0.0);
    let (_, out, _) = place.run(&["added-mass", "cube.obj", "--format", "json"]);
    let solved: Value = serde_json::from_str(&out).unwrap();
    assert_eq!(expected["triangles_solved"], solved["triangles_solved"]);
    let ratio =
        expected["error_estimate"].as_f64().unwrap() / solved["error_estimate"].as_f64().unwrap();
    assert!((0.4..2.5).contains(&ratio), "{ratio}");
}

#[test]
fn a_bad_mesh_is_described_and_the_command_that_is_shown_mends_it() {
    let place = Place::new();
    place.write("bad.obj", &bad_cube());
    let (code, report) = place.json(&["check", "bad.obj"]);
    assert_eq!(code, 1);
    for (key, count) in [
        ("holes", 1),
        ("flipped", 2),
        ("duplicates", 2),
        ("components", 1),
    ] {
        assert_eq!(report[key], count, "{key}");
    }
    assert_eq!(
        (&report["ready"], &report["volume"]),
        (&Value::Bool(false), &Value::Null)
    );
    let command = report["repair"].as_str().unwrap();
    assert_eq!(
        command,
        "langevin-rigid repair bad.obj --out bad-repaired.obj"
    );
    let words: Vec<&str> = command.split(' ').skip(1).collect();
    let (code, out, err) = place.run(&words);
    assert_eq!(code, 0, "{err}");
    for done in [
        "dropped 2 duplicate",
        "turned 2 triangles",
        "filled 1 holes of 4 edges",
    ] {
        assert!(out.contains(done), "{out}");
    }
    let (code, report) = place.json(&["check", "bad-repaired.obj"]);
    assert_eq!(code, 0);
    assert!((report["volume"].as_f64().unwrap() - 1.0).abs() < 1e-12);
    // Once more there is nothing to do.
    let (code, out, _) = place.run(&["repair", "bad-repaired.obj", "--out", "again.obj"]);
    assert!(code == 0 && out.contains("nothing to mend"), "{out}");
}

#[test]
fn a_sheet_needs_a_thickness() {
    let place = Place::new();
    place.write("sheet.obj", SHEET);
    let (code, report) = place.json(&["check", "sheet.obj"]);
    assert_eq!(code, 1);
    assert!(
        report["repair"]
            .as_str()
            .unwrap()
            .contains("--thickness LENGTH")
    );
    let (code, out, err) = place.run(&["repair", "sheet.obj", "--out", "plate.obj"]);
    assert_eq!((code, out.as_str()), (1, ""));
    assert!(
        err.contains("--thickness LENGTH") && err.contains("nothing was written"),
        "{err}"
    );
    assert!(!place.exists("plate.obj"));
    let thick = [
        "repair",
        "sheet.obj",
        "--thickness",
        "0.01",
        "--out",
        "plate.stl",
    ];
    let (code, report) = place.json(&thick);
    assert_eq!(
        (code, &report["steps"][0]["step"]),
        (0, &Value::from("thicken"))
    );
    assert!((report["volume"].as_f64().unwrap() / 0.01 - 1.0).abs() < 1e-12);
    assert_eq!(place.run(&["check", "plate.stl"]).0, 0);
}

#[test]
fn a_gltf_file_is_in_metres_and_says_where_that_is_overruled() {
    let place = Place::new();
    let ball = "../langevin-rigid-formats/tests/data/ball-draco-edgebreaker.glb";
    let ball = std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join(ball);
    let ball = ball.to_str().unwrap();
    let (code, report) = place.json(&["check", ball]);
    assert_eq!((code, &report["unit"]), (0, &"m".into()));
    assert!((report["volume"].as_f64().unwrap() - 0.5059).abs() < 1e-4);
    let (_, _, stderr) = place.run(&["check", ball, "--unit", "mm"]);
    assert!(
        stderr.contains("note: its lengths were taken to be in mm"),
        "{stderr}"
    );
}

#[test]
fn a_unit_is_hinted_at_and_repaired_into_metres() {
    let place = Place::new();
    place.write("leaf.obj", &SHEET.replace("v 1", "v 250"));
    let (_, report) = place.json(&["check", "leaf.obj"]);
    assert!(report["unit_hint"].as_str().unwrap().contains("--unit mm"));
    assert_eq!(report["size_if_mm"][0], 0.25);
    assert_eq!(report["size_if_in"][0], 6.35);
    let (_, report) = place.json(&["check", "leaf.obj", "--unit", "mm"]);
    assert_eq!(
        (&report["unit_hint"], &report["size"][0]),
        (&Value::Null, &Value::from(0.25))
    );
    let command = report["repair"].as_str().unwrap();
    assert!(
        command.contains("--unit mm --thickness LENGTH"),
        "{command}"
    );
}

#[test]
fn several_components_are_kept_or_chosen() {
    let place = Place::new();
    place.write("two.obj", &two_cubes(["1.005", "1.01"]));
    let (code, report) = place.json(&["check", "two.obj"]);
    assert_eq!((code, &report["components"]), (0, &Value::from(2)));
    let (code, report) = place.json(&["repair", "two.obj", "--largest", "--out", "one.obj"]);
    assert_eq!((code, &report["triangles"]), (0, &Value::from(12)));
}

/// The unit cube and another from the one place to the other on all axes.
fn two_cubes([low, high]: [&str; 2]) -> String {
    let second = |corner: &str| match corner {
        "0" => low.to_owned(),
        "1" => high.to_owned(),
        word => word.to_owned(),
    };
    let vertices: String = CUBE
        .lines()
        .filter(|l| l.starts_with('v'))
        .map(|l| l.split(' ').map(second).collect::<Vec<_>>().join(" ") + "\n")
        .collect();
    let faces: String = CUBE
        .lines()
        .filter_map(|l| l.strip_prefix("f "))
        .map(|l| {
            let shifted = l
                .split(' ')
                .map(|v| (v.parse::<u32>().unwrap() + 8).to_string());
            format!("f {}\n", shifted.collect::<Vec<_>>().join(" "))
        })
        .collect();
    format!("{CUBE}{vertices}{faces}")
}

#[test]
fn closed_parts_that_meet_become_one_body() {
    let place = Place::new();
    place.write("two.obj", &two_cubes(["0.5", "1.5"]));
    let (code, report) = place.json(&["check", "two.obj"]);
    assert_eq!(code, 1);
    let command = report["repair"].as_str().unwrap();
    assert_eq!(
        command,
        "langevin-rigid repair two.obj --out two-repaired.obj"
    );
    let words: Vec<&str> = command.split(' ').skip(1).collect();
    let (code, out, err) = place.run(&words);
    assert_eq!((code, err.as_str()), (0, ""));
    let done = "wrapped parts that overlap or touch";
    assert!(
        out.contains(done) && out.contains("2.000000e0 m^3 of parts became 1.8"),
        "{out}"
    );
    let (code, report) = place.json(&["check", "two-repaired.obj"]);
    assert_eq!((code, &report["components"]), (0, &Value::from(1)));
    // Two cubes of 1 m^3 less what they share.
    let volume = report["volume"].as_f64().unwrap();
    assert!((volume / 1.875 - 1.0).abs() < 0.01, "{volume}");
}

#[test]
fn a_wrap_is_as_fine_as_asked_in_metres_or_as_a_share() {
    let place = Place::new();
    place.write("cube.obj", CUBE);
    let size = |wrap: &str| {
        let (code, report) = place.json(&["repair", "cube.obj", "--wrap", wrap, "--out", "x.obj"]);
        assert_eq!((code, &report["warnings"]), (0, &Value::Array(Vec::new())));
        report["triangles"].as_u64().unwrap()
    };
    let length = (0.05 * f64::sqrt(3.0)).to_string();
    assert_eq!(size("5%"), size(&length));
    assert!(size("10%") < size("5%"));
    for wrap in ["0%", "101%", "x%", "-1", "2 m"] {
        let wrap = format!("--wrap={wrap}");
        let (code, _, err) = place.run(&["repair", "cube.obj", &wrap, "--out", "y.obj"]);
        assert!(code == 2 && err.contains("such as 2%"), "{err}");
    }
    // The outside reaches both sides of a sheet.
    place.write("sheet.obj", SHEET);
    let (code, _, err) = place.run(&["repair", "sheet.obj", "--wrap", "2%", "--out", "y.obj"]);
    assert!(
        code == 0 && err.contains("warning: the wrap encloses"),
        "{err}"
    );
}

#[test]
fn a_file_that_cannot_be_written_is_told_before_the_work() {
    let place = Place::new();
    place.write("bad.obj", &bad_cube());
    place.write("taken", "");
    let (code, out, err) = place.run(&["repair", "bad.obj", "--out", "taken/x.obj"]);
    assert_eq!((code, out.as_str()), (1, ""));
    assert!(err.contains("taken"), "{err}");
    let (code, _, _) = place.run(&["repair", "nowhere.obj", "--out", "new/x.obj"]);
    assert!(code == 1 && !place.exists("new"));
}

#[test]
fn what_cannot_be_written_or_read_is_told() {
    let place = Place::new();
    place.write("cube.obj", CUBE);
    for name in ["cube.ply", "cube", "cube.txt"] {
        let (code, _, err) = place.run(&["repair", "cube.obj", "--out", name]);
        assert!(code == 1 && err.contains(".obj or .stl"), "{err}");
        assert!(!place.exists(name));
    }
    for command in [
        &["check", "nowhere.obj"][..],
        &["repair", "nowhere.obj", "--out", "x.obj"],
    ] {
        let (code, _, err) = place.run(command);
        assert!(code == 1 && err.contains("nowhere.obj"), "{err}");
    }
    place.write("nan.obj", &CUBE.replace("v 1 1 1", "v 1 nan 1"));
    let (code, _, err) = place.run(&["check", "nan.obj"]);
    assert!(code == 1 && err.contains("`nan` is not a number"), "{err}");
    place.write("far.obj", &CUBE.replace("v 1 1 1", "v 1 1e300 1"));
    let (code, report) = place.json(&["check", "far.obj"]);
    assert_eq!(code, 1);
    assert!(report["unusable"].as_u64().unwrap() >= 3);
    assert_eq!(
        place
            .run(&["repair", "cube.obj", "--weld", "-1", "--out", "x.obj"])
            .0,
        2
    );
}

#[test]
fn repair_simplifies() {
    let place = Place::new();
    let ball = langevin_rigid_bake::shapes::Shape::Ellipsoid {
        semi_axes: [0.1, 0.2, 0.3],
    };
    let mesh = ball.mesh(5120).unwrap();
    let mut obj = Vec::new();
    langevin_rigid_formats::mesh::write_obj(&mesh, &mut obj).unwrap();
    place.write("ball.obj", &String::from_utf8(obj).unwrap());
    let fewer = [
        "repair",
        "ball.obj",
        "--triangles",
        "500",
        "--out",
        "few.stl",
    ];
    let (code, report) = place.json(&fewer);
    assert_eq!(
        (code, &report["steps"][0]["step"]),
        (0, &Value::from("simplify"))
    );
    assert!(report["triangles"].as_u64().unwrap() <= 500);
    assert!((report["volume"].as_f64().unwrap() / mesh.volume() - 1.0).abs() < 1e-12);
}

#[test]
fn a_mesh_of_too_many_triangles_is_not_ready_but_can_be_simplified() {
    let place = Place::new();
    let size = [0.1, 0.2, 0.3];
    let mesh = langevin_rigid_bake::shapes::Shape::Box { size }
        .mesh(450_000)
        .unwrap();
    let mut stl = Vec::new();
    langevin_rigid_formats::mesh::write_stl(&mesh, &mut stl).unwrap();
    std::fs::write(place.0.path().join("fine.stl"), stl).unwrap();
    let (code, report) = place.json(&["check", "fine.stl"]);
    assert_eq!((code, &report["expected"]), (1, &Value::Null));
    assert!(
        report["repair"]
            .as_str()
            .unwrap()
            .contains("--triangles 100000")
    );
    assert!(report["fault"].as_str().unwrap().contains("400000"));
}
