//! What a scene takes, what it refuses and where, and that it is written as it was read.
#![allow(clippy::unwrap_used, reason = "a test may panic")]

use proptest::prelude::*;

use super::*;

/// A scene with every key in it, so that each can be replaced.
const KEYS: &[(&str, &[(&str, &str)])] = &[
    (
        "fluid",
        &[
            ("density", "998.2"),
            ("viscosity", "1e-6"),
            ("velocity", "[0.1, 0.0, 0.2]"),
        ],
    ),
    (
        "body",
        &[
            ("shape", "\"box\""),
            ("size", "[0.01, 0.02, 0.04]"),
            ("triangles", "12"),
            ("density", "1100"),
            ("mass", "0.009"),
            ("centre_of_mass", "[0.0, 0.001, 0.0]"),
            (
                "inertia",
                "[[2e-6, 0.0, 0.0], [0.0, 2e-6, 0.0], [0.0, 0.0, 1e-6]]",
            ),
            ("characteristic_thickness", "0.01"),
            ("characteristic_length", "0.04"),
        ],
    ),
    (
        "release",
        &[
            ("position", "[0.0, 1.0, 0.0]"),
            ("tilt", "33"),
            ("tilt_axis", "[1, 2, 3]"),
            ("velocity", "[0.1, -0.2, 0.3]"),
            ("angular_velocity", "[1.0, 2.0, 3.0]"),
            ("frame", "\"world\""),
            ("carried", "0.01"),
        ],
    ),
    (
        "run",
        &[
            ("time_step", "0.002"),
            ("duration", "1"),
            ("ground", "-5.0"),
            ("gravity", "[0.0, -9.81, 0.0]"),
            ("seed", "7"),
            ("model", "\"separated\""),
            ("integrator", "\"strang\""),
            ("turbulence", "\"wake-age=3\""),
            ("reynolds", "1000.0"),
        ],
    ),
    (
        "turbulence",
        &[
            ("length", "0.01"),
            ("cells", "[4, 8, 4]"),
            ("cell", "0.01"),
            ("inflow_speed", "0.3"),
            ("time_step", "0.01"),
            ("duration", "0.1"),
            ("sampling", "\"fixed\""),
        ],
    ),
    (
        "separated",
        &[
            ("attachment", "0.5"),
            ("broadside_attachment", "0.5"),
            ("dynamic_stall", "6.0"),
            ("rotational_lift", "1.0"),
            ("rotational_damping", "1.0"),
            ("turbulence_intensity", "0.1"),
            ("attached", "false"),
        ],
    ),
    ("picture", &[("interval", "0.1")]),
    (
        "scatter",
        &[
            ("height", "0.1"),
            ("tilt", "1.0"),
            ("heading", "{ uniform = [0.0, 360.0] }"),
            ("velocity", "0.1"),
            ("spin", "2.0"),
        ],
    ),
    ("tank", &[("size", "[1.0, 2.0, 3.0]")]),
    (
        "contact",
        &[
            ("friction", "0.4"),
            ("restitution", "0.2"),
            ("shape", "\"hull\""),
        ],
    ),
    (
        "water",
        &[
            ("level", "-0.5"),
            ("density", "998.2"),
            ("viscosity", "1e-6"),
        ],
    ),
    (
        "water.waves",
        &[
            ("height", "0.1"),
            ("period", "1.5"),
            ("heading", "30.0"),
            ("seed", "3"),
        ],
    ),
    (
        "crowd",
        &[
            ("count", "12"),
            ("over", "[1.0, 0.0, 1.0]"),
            ("during", "2.0"),
            ("orientation", "\"any\""),
        ],
    ),
    ("direct", &[("steer", "0.1")]),
    (
        "direct.land",
        &[
            ("at", "[0.1, 0.0, 0.2]"),
            ("within", "0.1"),
            ("time", "0.5"),
            ("time_within", "0.1"),
            ("side", "\"up\""),
        ],
    ),
    (
        "direct.free",
        &[
            ("tilt", "10.0"),
            ("heading", "180.0"),
            ("position", "[0.0, 0.0, 0.0]"),
            ("velocity", "0.3"),
            ("spin", "2.0"),
        ],
    ),
];

/// The scene with some values replaced, left out where they are empty; the line of the last one.
fn written(changes: &[(&str, &str, String)]) -> (String, usize) {
    let (mut text, mut line) = (String::new(), 0);
    for (section, keys) in KEYS {
        text += &format!("[{section}]\n");
        for (key, value) in *keys {
            let change = changes
                .iter()
                .rev()
                .find(|c| (c.0, c.1) == (*section, *key));
            let value = change.map_or(*value, |c| c.2.as_str());
            if !value.is_empty() {
                text += &format!("{key} = {value}\n");
            }
            if change.is_some() {
                line = text.lines().count();
            }
        }
    }
    (text, line)
}

fn parse(text: &str) -> Result<Scene, SceneError> {
    Scene::parse("brick", "brick.toml", text)
}

/// What a scene with one value replaced says, which must be at that value and name its key.
fn refused(section: &'static str, key: &'static str, value: &str) -> String {
    let (text, line) = written(&[(section, key, value.to_owned())]);
    let error = parse(&text).expect_err(&text);
    assert_eq!(error.line, line, "{error}");
    assert!(error.message.contains(key), "{error}");
    error.message
}

fn all_keys() -> impl Iterator<Item = (&'static str, &'static str, &'static str)> {
    KEYS.iter()
        .flat_map(|(section, keys)| keys.iter().map(|(key, value)| (*section, *key, *value)))
}

/// A scene of a leaf with more tables.
fn leaf(more: &str) -> String {
    format!(
        r#"
fluid.preset = "air"
body = {{ shape = "leaf", length = 0.08, width = 0.05, thickness = 6e-4, density = 400.0, triangles = 320 }}
release.position = [0.0, 1.0, 0.0]
run = {{ time_step = 0.002, duration = 3.0, ground = 0.0 }}
{more}
"#
    )
}

#[test]
fn worlds_read_back_as_written() {
    let worlds = [
        "[contact]",
        "contact = { friction = 0.1, restitution = 0.9, shape = \"parts\" }",
        "[water]",
        "[water]\nlevel = 0.2\ncurrent = [0.1, -0.2]\nwaves = { height = 0.1, period = 1.2 }",
        "[crowd]\ncount = 7\nsizes = [0.5, 2.0]\nkinds = [{ scene = \"coin\", share = 0.5 }, { scene = \"fan\" }]",
        "[[obstacle]]\nshape = \"box\"\nsize = [1.0, 0.1, 1.0]\ntilt = 10.0\n[[obstacle]]\nshape = \"plane\"\nnormal = [1.0, 2.0, 0.3]",
        "[[obstacle]]\nshape = \"terrain\"\nmesh = \"hill.obj\"\nunit = \"m\"\nfriction = 1.5",
    ];
    for world in worlds {
        let scene = parse(&leaf(world)).unwrap_or_else(|e| panic!("{e}"));
        assert!(scene.is_world());
        assert_eq!(parse(&scene.to_toml().unwrap()).unwrap(), scene, "{world}");
    }
    assert!(!parse(&leaf("")).unwrap().is_world());
}

#[test]
fn impossible_worlds_are_told() {
    for (world, wanted) in [
        ("[[obstacle]]", "its `shape`, one of `plane`, `box`"),
        (
            "[[obstacle]]\nshape = \"ball\"",
            "`ball` is no `shape` of an obstacle",
        ),
        ("[[obstacle]]\nshape = \"box\"", "its `size` (m)"),
        (
            "[[obstacle]]\nshape = \"plane\"\nsize = [1.0, 1.0, 1.0]",
            "has no `size`",
        ),
        (
            "[[obstacle]]\nshape = \"plane\"\nnormal = [0.0, 0.0, 0.0]",
            "at least 1e-6 long",
        ),
        ("[[obstacle]]\nshape = \"mesh\"", "its `mesh`, the path"),
        (
            "[[obstacle]]\nshape = \"mesh\"\nmesh = \"a.obj\"",
            "its `unit` of length",
        ),
        ("[water]\nwaves = { height = 0.1 }", "the `period` (s)"),
        (
            "[water]\nwaves = { height = 1.0, period = 0.5 }",
            "break where they are higher",
        ),
        ("[crowd]", "its `count`"),
        ("[crowd]\ncount = 0", "between 1 and 100000"),
        ("[crowd]\ncount = 3\nsizes = [2.0, 1.0]", "exchange them"),
        (
            "[crowd]\ncount = 3\nkinds = [{ share = 1.0 }]",
            "needs a `scene`",
        ),
    ] {
        let error = parse(&leaf(world)).expect_err(world);
        assert!(error.message.contains(wanted), "{error}");
        assert!(error.line >= 6, "{error}");
    }
    let endless = leaf("[contact]").replace(", duration = 3.0", "");
    assert!(
        parse(&endless)
            .unwrap_err()
            .message
            .contains("give a `duration`")
    );
    let sideways = leaf("[water]").replace("ground = 0.0", "gravity = [1.0, -9.81, 0.0]");
    assert!(parse(&sideways).unwrap_err().message.contains("along -y"));
}

#[test]
fn a_history_of_turbulence_is_that_of_one_body_in_one_fluid() {
    let scene = |source: &str| {
        let text = format!(
            "fluid.preset = \"water\"\nbody = {{ shape = \"disc\", radius = 0.01, thickness = 1e-3, mass = 1e-3 }}\n\
             run = {{ time_step = 0.01, duration = 1.0, turbulence = {source:?} }}\n[scatter]\nsize = [1.0, 2.0]\n"
        );
        Scene::parse("disc", "disc.toml", &text)
    };
    assert!(scene("body-driven").is_ok());
    for source in ["history", "wake-age=2"] {
        let error = scene(source).unwrap_err();
        assert_eq!((error.line, error.column), (5, 8));
        assert!(error.message.contains("precomputed history"), "{error}");
    }
}

#[test]
fn the_whole_scene_is_good() {
    parse(&written(&[]).0).unwrap_or_else(|e| panic!("{e}"));
}

#[test]
fn every_array_has_exactly_its_length() {
    let arrays = all_keys().filter(|(_, _, value)| value.starts_with('['));
    let mut seen = 0;
    for (section, key, value) in arrays {
        let inner = &value[1..value.len() - 1];
        let last = if inner.ends_with(']') { "[1.0]" } else { "1" };
        for other in [
            format!("[{inner}, {last}]"),
            "[]".into(),
            format!("[{last}]"),
        ] {
            let message = refused(section, key, &other);
            assert!(message.contains("takes 3 values"), "{message}");
        }
        seen += 1;
    }
    assert_eq!(seen, 14);
    let row = "[[2e-6, 0.0, 0.0, 9.0], [0.0, 2e-6, 0.0], [0.0, 0.0, 1e-6]]";
    assert!(refused("body", "inertia", row).contains("takes 3 values, and has 4"));
    let (text, _) = written(&[
        ("release", "tilt", String::new()),
        (
            "release",
            "tilt_axis",
            "[1, 0, 0]\norientation = [0, 0, 0, 1, 0]".into(),
        ),
    ]);
    let error = parse(&text).unwrap_err();
    assert!(
        error
            .message
            .contains("`orientation` takes 4 values, and has 5")
    );
}

#[test]
fn every_number_has_a_range() {
    for (section, key, value) in all_keys() {
        let extremes = ["1e308", "-1e308", "nan", "inf"];
        if value.parse::<f64>().is_ok() && !["seed", "triangles", "count"].contains(&key) {
            for extreme in extremes {
                let message = refused(section, key, extreme);
                assert!(message.contains("between"), "{message}");
            }
        } else if value.starts_with("[[") {
            for extreme in extremes {
                refused(
                    section,
                    key,
                    &format!("[[{extreme}, 0, 0], [0, 1, 0], [0, 0, 1]]"),
                );
            }
        } else if value.starts_with('[') && key != "cells" {
            for extreme in extremes {
                let message = refused(section, key, &format!("[1.0, {extreme}, 1.0]"));
                assert!(message.contains("between"), "{message}");
            }
        }
    }
    for (section, key) in [
        ("fluid", "density"),
        ("fluid", "viscosity"),
        ("run", "time_step"),
        ("run", "duration"),
        ("turbulence", "cell"),
    ] {
        for small in ["0", "5e-324", "-1"] {
            refused(section, key, small);
        }
    }
    for key in ["density", "mass"] {
        refused("body", key, "-5e-324");
    }
}

#[test]
fn impossible_work_is_refused_before_it_begins() {
    assert!(refused("run", "time_step", "1e-12").contains("1.000e12 steps"));
    assert!(refused("run", "time_step", "1.5").contains("longer than the run"));
    assert!(refused("turbulence", "cells", "[2000000, 1, 1]").contains("2.2 GB"));
    let most = i64::MAX.to_string();
    refused("turbulence", "cells", &format!("[{most}, {most}, {most}]"));
    refused("turbulence", "cells", "[0, 1, 1]");
    refused("turbulence", "time_step", "1e-9");
    refused("body", "triangles", "-1");
}

#[test]
fn impossible_names_and_tensors_are_refused_under_their_key() {
    for age in ["-1", "nan", "inf", "1e300"] {
        refused("run", "turbulence", &format!("\"wake-age={age}\""));
    }
    refused("run", "model", "\"magic\"");
    refused("run", "integrator", "\"euler\"");
    let flat = "[[1e-6, 0.0, 0.0], [0.0, 9e-6, 0.0], [0.0, 0.0, 1e-6]]";
    assert!(refused("body", "inertia", flat).contains("exceeds the sum"));
    assert!(refused("release", "tilt_axis", "[0, 1e-9, 0]").contains("long"));
    assert!(refused("release", "velocity", "[9e5, 9e5, 9e5]").contains("no longer than"));
}

#[test]
fn nothing_that_a_terminal_acts_on_is_echoed() {
    let (text, _) = written(&[("body", "shape", "\"\\u001b[31mEVIL\\u0007\"".into())]);
    let shown = parse(&text).unwrap_err().to_string();
    assert!(
        shown.contains("EVIL") && !shown.contains(['\u{1b}', '\u{7}']),
        "{shown:?}"
    );
}

#[test]
#[cfg(unix)]
fn a_path_that_toml_cannot_hold_is_no_other_path() {
    use std::os::unix::ffi::OsStringExt;
    let mut scene = parse(&written(&[]).0).unwrap();
    scene.body.geometry = Geometry::Mesh {
        path: std::ffi::OsString::from_vec(vec![b'a', 0xff]).into(),
        unit: None,
        thickness: None,
    };
    let message = scene.to_toml().unwrap_err().to_string();
    assert!(message.contains("not UTF-8"), "{message}");
}

#[test]
fn a_scene_that_ends_anywhere_is_read_or_refused_in_its_text() {
    let (text, _) = written(&[]);
    for end in 0..text.len() {
        if let Err(error) = parse(&text[..end]) {
            assert!(
                error.line <= text[..end].matches('\n').count() + 1,
                "{error}"
            );
        }
    }
}

#[test]
fn velocities_at_their_limit_are_written_as_they_were_read() {
    // In the other frame the last of them is above the limit by rounding.
    for tilt in 0..200 {
        let (text, _) = written(&[
            ("release", "tilt", tilt.to_string()),
            ("release", "tilt_axis", "[1.0, 2.0, 3.0]".into()),
            ("release", "velocity", "[0.0, 0.0, 1e6]".into()),
        ]);
        let scene = parse(&text).unwrap();
        assert_eq!(parse(&scene.to_toml().unwrap()).unwrap(), scene, "{tilt}");
    }
}

/// A scene in which no number is infinite or not one.
fn is_finite(scene: &Scene) -> bool {
    // The debug form has every number in it.
    let text = format!("{scene:?}");
    let mut words = text.split(|c: char| !c.is_alphanumeric() && c != '_');
    !words.any(|word| ["inf", "NaN"].contains(&word))
}

fn number() -> impl Strategy<Value = String> {
    prop_oneof![
        any::<f64>().prop_map(|x| format!("{x:e}")),
        (-13.0..13.0f64, any::<bool>()).prop_map(|(x, minus)| {
            let sign = if minus { -1.0 } else { 1.0 };
            format!("{:e}", sign * libm::pow(10.0, x))
        }),
        (-2.0..2.0f64).prop_map(|x| x.to_string()),
        prop::sample::select(vec![
            "0", "-0.0", "1e6", "-1e6", "1e9", "1e-9", "5e5", "5e-324", "nan"
        ])
        .prop_map(str::to_owned),
    ]
}

/// A key, with a value of the same form.
fn change() -> impl Strategy<Value = (&'static str, &'static str, String)> {
    let keys: Vec<_> = all_keys().collect();
    let three = || [number(), number(), number()].prop_map(|n| format!("[{}]", n.join(", ")));
    prop::sample::select(keys).prop_flat_map(move |(section, key, value)| {
        let other = match value.as_bytes()[0] {
            b'[' if key != "cells" && key != "inertia" => three().boxed(),
            b'0'..=b'9' | b'-' if !["triangles", "count"].contains(&key) => number().boxed(),
            _ => prop::sample::select(vec![value.to_owned(), String::new()]).boxed(),
        };
        other.prop_map(move |value| (section, key, value))
    })
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    #[test]
    fn what_is_read_is_finite_and_is_written_as_it_was_read(
        changes in prop::collection::vec(change(), 1..6),
    ) {
        let (text, _) = written(&changes);
        if let Ok(scene) = parse(&text) {
            prop_assert!(is_finite(&scene), "{text}");
            let again = scene.to_toml().unwrap();
            prop_assert_eq!(parse(&again).map_err(|e| e.to_string()), Ok(scene), "{}", again);
        }
    }

    #[test]
    fn any_orientation_and_velocity_are_written_as_they_were_read(
        tilt in -1e6..1e6f64,
        [x, y, z] in [-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64],
        speed in 0.0..5e5f64,
    ) {
        let vector = format!("[{}, {}, {}]", x * speed, y * speed, z * speed);
        let (text, _) = written(&[
            ("release", "tilt", tilt.to_string()),
            ("release", "tilt_axis", format!("[{x}, {y}, {}]", z + 2.0)),
            ("release", "velocity", vector.clone()),
            ("release", "angular_velocity", vector),
        ]);
        let scene = parse(&text).unwrap();
        prop_assert_eq!(parse(&scene.to_toml().unwrap()).unwrap(), scene);
    }

    #[test]
    fn no_damage_makes_a_scene_panic(
        overwrites in prop::collection::vec((any::<prop::sample::Index>(), any::<char>()), 1..8),
    ) {
        let mut text: Vec<char> = written(&[]).0.chars().collect();
        for (place, c) in overwrites {
            let place = place.index(text.len());
            text[place] = c;
        }
        if let Err(error) = parse(&text.iter().collect::<String>()) {
            prop_assert!(error.line >= 1 && error.column >= 1);
        }
    }
}
