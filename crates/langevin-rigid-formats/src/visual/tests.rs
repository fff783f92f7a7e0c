#![allow(clippy::unwrap_used, reason = "a test may panic")]

use langevin_rigid::linalg::quat_from_rotation_vector;
use langevin_rigid::{Bake, Fluid, Settings, State};
use langevin_rigid_bake::body::{BodySpec, bake_body};
use langevin_rigid_bake::shapes::Shape;
use serde_json::json;

use super::references::List;
use super::*;
use crate::export::{Conditions, Format, Kind, Options, RecordedBody, Recording, write};
use crate::mesh::gltf::tests::glb;
use crate::mesh::{RawMesh, read_mesh};
use crate::trajectory::Trajectory;

/// One white pixel.
const PIXEL: &[u8] = b"\x89PNG\r\n\x1a\n\0\0\0\rIHDR\0\0\0\x01\0\0\0\x01\x08\x02\0\0\0\x90wS\xde\
    \0\0\0\x0cIDATx\x9cc\xf8\xff\xff?\0\x05\xfe\x02\xfe\x0d\xefF\xb8\0\0\0\0IEND\xaeB`\x82";

/// A square of one metre in the plane z = 0, its positions, UVs and indices; the image comes after them.
fn square_data() -> Vec<u8> {
    let positions = [
        [0.0f32, 0.0, 0.0],
        [1.0, 0.0, 0.0],
        [1.0, 1.0, 0.0],
        [0.0, 1.0, 0.0],
    ];
    let uvs = [[0.0f32, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];
    let floats = positions.as_flattened().iter().chain(uvs.as_flattened());
    let mut data: Vec<u8> = floats.flat_map(|x| x.to_le_bytes()).collect();
    data.extend([0u16, 1, 2, 0, 2, 3].iter().flat_map(|n| n.to_le_bytes()));
    data.extend(PIXEL);
    data
}

/// Shows the square twice, half as large the second time, below an empty node; there is more that nothing shows.
fn square() -> Value {
    json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [
            { "name": "top", "children": [1, 2, 3] },
            { "name": "whole", "mesh": 1 },
            { "name": "half", "mesh": 1, "scale": [0.5, 0.5, 0.5], "translation": [0, 0, 1] },
            { "name": "camera", "camera": 0 },
        ],
        "cameras": [{ "type": "perspective", "perspective": { "yfov": 1.0, "znear": 0.1 } }],
        "meshes": [
            { "name": "unused", "primitives": [{ "attributes": { "POSITION": 0 } }] },
            { "name": "square", "primitives": [{
                "attributes": { "POSITION": 0, "TEXCOORD_0": 1 }, "indices": 2, "material": 1,
            }] },
        ],
        "materials": [
            { "name": "unused" },
            {
                "name": "paper",
                "doubleSided": true,
                "pbrMetallicRoughness": { "baseColorTexture": { "index": 0, "extensions": {
                    "KHR_texture_transform": { "scale": [2, 2] },
                } } },
                "extensions": {
                    "KHR_materials_sheen": { "sheenColorTexture": { "index": 1 } },
                    "VENDOR_secret": { "index": 17 },
                },
            },
        ],
        "textures": [{ "source": 0, "sampler": 0 }, { "source": 0 }],
        "samplers": [{ "wrapS": 33071 }],
        "images": [{ "bufferView": 3, "mimeType": "image/png" }],
        "accessors": [
            {
                "bufferView": 0, "componentType": 5126, "count": 4, "type": "VEC3",
                "min": [0, 0, 0], "max": [1, 1, 0],
            },
            { "bufferView": 1, "componentType": 5126, "count": 4, "type": "VEC2" },
            { "bufferView": 2, "componentType": 5123, "count": 6, "type": "SCALAR" },
        ],
        "bufferViews": [
            { "buffer": 0, "byteLength": 48, "target": 34962 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 32, "target": 34962 },
            { "buffer": 0, "byteOffset": 80, "byteLength": 12, "target": 34963 },
            { "buffer": 0, "byteOffset": 92, "byteLength": PIXEL.len() },
        ],
        "buffers": [{ "byteLength": 92 + PIXEL.len() }],
        "extensionsUsed": ["KHR_texture_transform", "KHR_materials_sheen", "VENDOR_secret"],
        "extensionsRequired": ["KHR_texture_transform"],
    })
}

fn parse(document: &Value) -> Result<Visual, ParseError> {
    Visual::parse(&glb(&document.to_string(), &square_data()), None)
}

fn fault(document: &Value) -> String {
    parse(document).unwrap_err().to_string()
}

/// Changes the square's document.
fn changed(place: &str, value: Value) -> Value {
    let mut document = square();
    let (parent, key) = place.rsplit_once('/').unwrap();
    match document.pointer_mut(parent).unwrap() {
        Value::Array(items) => items[key.parse::<usize>().unwrap()] = value,
        object => object[key] = value,
    }
    document
}

#[test]
fn what_is_shown_comes_along_and_nothing_else() {
    let visual = parse(&square()).unwrap();
    assert_eq!(visual.notices(), ["the cameras of the visual are left out"]);
    let part = &visual.part;
    let names: Vec<&str> = part
        .nodes
        .iter()
        .filter_map(|n| n["name"].as_str())
        .collect();
    assert_eq!(names, ["top", "whole", "half"]);
    assert_eq!(part.nodes[0]["children"], json!([1, 2]));
    let counts = List::ALL.map(|list| part.lists[list].len());
    assert_eq!(counts, [3, 4, 1, 1, 1, 1, 2]);
    let paper = &part.lists[List::Materials][0];
    assert_eq!(paper["name"], "paper");
    assert_eq!(paper["extensions"]["VENDOR_secret"], Value::Null);
    let used: Vec<&String> = part.used.iter().collect();
    assert_eq!(used, ["KHR_materials_sheen", "KHR_texture_transform"]);
    assert_eq!(part.required.len(), 1);
    let image = &part.lists[List::Images][0];
    let view = &part.lists[List::BufferViews][image["bufferView"].as_u64().unwrap() as usize];
    let start = view["byteOffset"].as_u64().unwrap() as usize;
    assert_eq!(part.bytes[start..start + PIXEL.len()], *PIXEL);
}

#[test]
fn images_and_buffers_may_be_beside_the_file() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("square.gltf");
    let mut document = changed("/images/0", json!({ "uri": "my%20paper.png" }));
    document["buffers"][0]["uri"] = "square.bin".into();
    std::fs::write(&path, document.to_string()).unwrap();
    std::fs::write(folder.path().join("square.bin"), square_data()).unwrap();
    let message = Visual::read(&path).unwrap_err().to_string();
    for word in ["square.gltf", "image `my%20paper.png`", "beside it"] {
        assert!(message.contains(word), "{message}");
    }
    std::fs::write(folder.path().join("my paper.png"), "P6 1 1 255").unwrap();
    let message = Visual::read(&path).unwrap_err().to_string();
    assert!(message.contains("no PNG, JPEG, WebP or KTX2"), "{message}");
    std::fs::write(folder.path().join("my paper.png"), PIXEL).unwrap();
    let visual = Visual::read(&path).unwrap();
    let image = &visual.part.lists[List::Images][0];
    assert_eq!(image["mimeType"], "image/png");
    assert_eq!(image.get("uri"), None);

    let outside = changed("/images/0", json!({ "uri": "../paper.png" }));
    assert!(fault(&outside).contains("image `../paper.png`"));
    std::fs::remove_file(folder.path().join("square.bin")).unwrap();
    let message = Visual::read(&path).unwrap_err().to_string();
    assert!(message.contains("buffer `square.bin`"), "{message}");
    let message = Visual::read(&folder.path().join("none.glb")).unwrap_err();
    assert!(message.to_string().contains("check the path"));
    std::fs::write(&path, "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n").unwrap();
    let message = Visual::read(&path).unwrap_err().to_string();
    assert!(message.contains("is no glTF file"), "{message}");
}

#[test]
fn damaged_visuals_say_what_is_wrong() {
    for (place, value, words) in [
        ("/nodes/1/mesh", json!(7), "there is no mesh 7"),
        ("/nodes/0/children", json!([1, 2, 0]), "not a tree"),
        ("/nodes/0/children", json!([1, 2, 9]), "there is no node 9"),
        ("/nodes/1/skin", json!(0), "apply the armature"),
        (
            "/meshes/1/primitives/0/material",
            json!(2),
            "there is no material 2",
        ),
        (
            "/meshes/1/primitives/0/indices",
            json!(9),
            "there is no accessor 9",
        ),
        (
            "/meshes/1/primitives/0/attributes/TEXCOORD_0",
            json!(5),
            "there is no accessor 5",
        ),
        (
            "/meshes/1/primitives/0/attributes/TEXCOORD_0",
            json!(2),
            "differ in number",
        ),
        ("/textures/1/source", json!(1), "there is no image 1"),
        ("/textures/0/sampler", json!(-1), "there is no sampler -1"),
        (
            "/materials/1/extensions/KHR_materials_sheen/sheenColorTexture/index",
            json!(2),
            "there is no texture 2",
        ),
        (
            "/images/0/bufferView",
            json!(4),
            "there is no buffer view 4",
        ),
        (
            "/images/0",
            json!({}),
            "neither an address nor a buffer view",
        ),
        (
            "/accessors/1/byteOffset",
            json!(4),
            "reaches beyond buffer view 1",
        ),
        (
            "/bufferViews/3/byteLength",
            json!(1000),
            "reaches beyond buffer 0",
        ),
        ("/bufferViews/3/buffer", json!(1), "there is no buffer 1"),
        (
            "/bufferViews/3",
            json!([0, 92, 69, null, null]),
            "there is no buffer view 3",
        ),
        ("/scenes/0/nodes", json!([]), "no triangles"),
    ] {
        let message = fault(&changed(place, value));
        assert!(message.contains(words), "{place}: {message}");
    }
}

#[test]
fn no_damage_makes_a_panic() {
    let (json, data) = (square().to_string(), square_data());
    for cut in 0..data.len() {
        assert!(
            Visual::parse(&glb(&json, &data[..cut]), None).is_err(),
            "{cut}"
        );
    }
    for at in 0..json.len() {
        for replacement in [b'9', b'-', b'"', b'[', b'{', b'}', b' ', b'.'] {
            let mut json = json.clone().into_bytes();
            json[at] = replacement;
            if let Ok(json) = String::from_utf8(json) {
                let _ = Visual::parse(&glb(&json, &data), None);
            }
        }
    }
}

fn ball() -> Bake {
    let mesh = Shape::Ellipsoid {
        semi_axes: [0.5; 3],
    };
    let spec = BodySpec {
        density: Some(1100.0),
        ..BodySpec::default()
    };
    let (body, added_mass) = bake_body(&mesh.mesh(80).unwrap(), &spec, &()).unwrap();
    Bake {
        body,
        history: None,
        error_estimate: added_mass.error_estimate,
        warnings: Vec::new(),
        fingerprint: [0; 32],
    }
}

/// Balls that look like these, the first one alone, the second twice as large; what they are exported to.
fn exported(visuals: &[&Visual], format: Format) -> (tempfile::TempDir, Vec<String>) {
    let bake = ball();
    let trajectory = |body: u32| {
        let state = |step: u32| State {
            time: 0.1 * f64::from(step),
            position: [3.0 * f64::from(body), -f64::from(step), 0.0],
            orientation: quat_from_rotation_vector([0.0, 0.0, std::f64::consts::FRAC_PI_2]),
            ..State::default()
        };
        Trajectory::new(body, &[state(0), state(1)])
    };
    let trajectories = [trajectory(0), trajectory(1), trajectory(2)];
    let kinds: Vec<Kind<'_>> = visuals
        .iter()
        .map(|&visual| Kind {
            name: "dressed",
            bake: &bake,
            visual: Some(visual),
        })
        .chain([Kind::new("plain", &bake)])
        .collect();
    let body = |kind: usize, scale: f64, n: usize| RecordedBody {
        kind,
        scale,
        trajectory: &trajectories[n],
    };
    let last = kinds.len() - 1;
    let recording = Recording {
        conditions: Conditions {
            scene: "balls",
            fluid: &Fluid::WATER,
            settings: &Settings::default(),
            seed: 3,
            time_step: 0.1,
        },
        kinds: &kinds,
        bodies: &[body(0, 1.0, 0), body(last - 1, 2.0, 1), body(last, 1.0, 2)],
    };
    let folder = tempfile::tempdir().unwrap();
    let written = write(&recording, format, folder.path(), &Options::default()).unwrap();
    (folder, written.warnings)
}

fn document(folder: &tempfile::TempDir) -> Value {
    let bytes = std::fs::read(folder.path().join("trajectory.glb")).unwrap();
    serde_json::from_slice(crate::mesh::gltf::chunks(&bytes).unwrap().0).unwrap()
}

fn read(folder: &tempfile::TempDir) -> RawMesh {
    read_mesh(&folder.path().join("trajectory.glb"), None).unwrap()
}

#[test]
fn a_visual_rides_on_its_bodies() {
    let mut visual = parse(&square()).unwrap();
    visual.scale = 0.1;
    visual.centre_of_mass = [0.02, 0.0, 0.0];
    let (folder, warnings) = exported(&[&visual], Format::Glb);
    assert_eq!(warnings, [""; 0]);
    let document = document(&folder);
    assert_eq!(document["meshes"].as_array().unwrap().len(), 2);
    assert_eq!(document["nodes"].as_array().unwrap().len(), 3 + 2 * 4);
    assert_eq!(document["nodes"][1]["children"], json!([7]));
    assert_eq!(document["nodes"][8]["children"], json!([9, 10]));
    assert_eq!(
        document["extensionsUsed"],
        json!(["KHR_materials_sheen", "KHR_texture_transform"])
    );
    assert_eq!(
        document["extensionsRequired"],
        json!(["KHR_texture_transform"])
    );
    let run = &document["scenes"][0]["extras"]["langevin_rigid"];
    assert!(run["kinds"]["dressed"]["mass_kg"].as_f64().unwrap() > 0.0);
    // The corner (1, 0, 0) of the squares: 0.08 from the centre of mass, turned to y.
    let vertices = read(&folder).vertices;
    let has = |wanted: [f64; 3]| {
        let near = |v: &[f64; 3]| (0..3).all(|i| (v[i] - wanted[i]).abs() < 1e-6);
        assert!(vertices.iter().any(near), "{wanted:?}");
    };
    has([0.0, 0.08, 0.0]);
    has([0.0, 0.03, 0.1]);
    has([3.0, 0.16, 0.0]);
}

#[test]
fn kinds_may_look_different_or_the_same() {
    let visual = parse(&square()).unwrap();
    let (folder, _) = exported(&[&visual, &visual], Format::Glb);
    let document = document(&folder);
    let last = &document["materials"][1]["extensions"]["KHR_materials_sheen"]["sheenColorTexture"];
    assert!(last["index"].as_u64().unwrap() >= 2);
    assert_eq!(document["textures"].as_array().unwrap().len(), 4);
    assert_eq!(
        read(&folder).triangles.len(),
        8 + ball().body.surface.triangles.len()
    );
}

#[test]
fn usd_says_that_it_has_no_visual() {
    let visual = parse(&square()).unwrap();
    let (_folder, warnings) = exported(&[&visual], Format::Usd);
    assert!(warnings[0].contains("surface of dressed") && warnings[0].contains("GLB only"));
}

/// Compressed meshes come out as they went in.
#[cfg(all(feature = "draco", feature = "meshopt"))]
#[test]
fn compression_stays_as_it_is() {
    let data = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data");
    for name in ["ball-draco-edgebreaker.glb", "ball-meshopt.glb"] {
        let path = data.join(name);
        let visual = Visual::read(&path).unwrap();
        let (folder, _) = exported(&[&visual, &visual], Format::Glb);
        let triangles = read_mesh(&path, None).unwrap().triangles.len();
        let plain = ball().body.surface.triangles.len();
        assert_eq!(
            read(&folder).triangles.len(),
            2 * triangles + plain,
            "{name}"
        );
        let required = document(&folder)["extensionsRequired"].take();
        assert_eq!(required, json!(visual.part.required), "{name}");
        assert!(required.to_string().contains("compression"), "{required}");
    }
}
