use std::time::{Duration, Instant};

use super::*;

/// Small files that stand for much more are refused before anything is made of them.
fn refused_at_once(glb: &[u8], expected: &str) {
    let begin = Instant::now();
    let error = fault(glb);
    assert!(error.contains(expected), "{error}");
    assert!(
        begin.elapsed() < Duration::from_secs(2),
        "{:?}",
        begin.elapsed()
    );
}

fn list(item: &str, count: usize) -> String {
    vec![item; count].join(",")
}

/// A file whose mesh has 4000 triangles, all of the brick.
fn long(rest: &str) -> Vec<u8> {
    let mut maker = Maker::brick();
    maker.accessor(&[0, 1, 2].repeat(4000), UNSIGNED_BYTE, "SCALAR", 12_000, "");
    maker.glb(rest)
}

const MESH: &str = r#""meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":2}]}]"#;

#[test]
fn many_nodes_that_show_one_mesh() {
    let nodes = list(r#"{"mesh":0}"#, 4000);
    refused_at_once(
        &long(&format!(r#""nodes":[{nodes}],{MESH}"#)),
        "in a file of",
    );
    // A hundred are fine.
    let nodes = list(r#"{"mesh":0}"#, 100);
    let mesh = read(&long(&format!(r#""nodes":[{nodes}],{MESH}"#))).unwrap();
    assert_eq!(mesh.triangles.len(), 400_000);
}

#[test]
fn many_meshes_and_primitives_of_one_accessor() {
    let primitive = r#"{"attributes":{"POSITION":0},"indices":2}"#;
    let primitives = list(primitive, 4000);
    let one = format!(r#""nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{primitives}]}}]"#);
    refused_at_once(&long(&one), "in a file of");
    let meshes = list(&format!(r#"{{"primitives":[{primitive}]}}"#), 4000);
    let nodes: Vec<String> = (0..4000).map(|n| format!(r#"{{"mesh":{n}}}"#)).collect();
    let many = format!(r#""nodes":[{}],"meshes":[{meshes}]"#, nodes.join(","));
    refused_at_once(&long(&many), "in a file of");
}

#[test]
fn many_instances() {
    let mut maker = Maker::brick();
    let sparse = r#""componentType":5126,"count":1000000000000,"type":"VEC3","sparse":{"count":1,
        "indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}"#;
    let index = maker.accessor_json(sparse);
    let node = format!(
        r#","extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{"TRANSLATION":{index}}}}}}}"#
    );
    refused_at_once(&maker.shown(&node, "", ""), "in a file of");
}

#[test]
fn many_morph_targets() {
    let targets = list(r#"{"POSITION":0}"#, 3000);
    let weights = list("1", 3000);
    let mesh = format!(
        r#""nodes":[{{"mesh":0}}],"meshes":[{{"weights":[{weights}],
        "primitives":[{{"attributes":{{"POSITION":0}},"indices":2,"targets":[{targets}]}}]}}]"#
    );
    refused_at_once(&long(&mesh), "in a file of");
    // Weights of zero cost time too, once a node.
    let weights = list("0", 20_000);
    let targets = list("{}", 20_000);
    let nodes = list(r#"{"mesh":0}"#, 20_000);
    let mesh = format!(
        r#""nodes":[{nodes}],"meshes":[{{"weights":[{weights}],
        "primitives":[{{"attributes":{{"POSITION":0}},"indices":1,"targets":[{targets}]}}]}}]"#
    );
    refused_at_once(&long(&mesh), "in a file of");
}

#[test]
fn vertices_and_sparse_items_out_of_nothing() {
    let sparse = r#""componentType":5126,"count":1000000000,"type":"VEC3","sparse":{"count":1,
        "indices":{"bufferView":1,"componentType":5121},"values":{"bufferView":0}}"#;
    let mut maker = Maker::brick();
    let index = maker.accessor_json(sparse);
    let mesh = |attributes: &str| {
        format!(
            r#""nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{index}}}{attributes}}}]}}]"#
        )
    };
    refused_at_once(&maker.glb(&mesh("")), "in a file of");
    // Of a billion vertices only those that triangles use are read.
    let some = read(&maker.glb(&mesh(r#","indices":1"#))).unwrap();
    assert!(some.vertices.len() <= 8);

    // Ten thousand primitives that each read ten thousand sparse items.
    let mut maker = Maker::brick();
    let numbers: Vec<u8> = (0..10_000u16).flat_map(u16::to_le_bytes).collect();
    let numbers = maker.view(&numbers, "");
    let values = maker.view(&vec![0; 120_000], "");
    let index = maker.accessor_json(&format!(
        r#""componentType":5126,"count":10000,"type":"VEC3","sparse":{{"count":10000,
        "indices":{{"bufferView":{numbers},"componentType":5123}},"values":{{"bufferView":{values}}}}}"#
    ));
    let primitives = list(
        &format!(r#"{{"attributes":{{"POSITION":{index}}},"indices":1}}"#),
        10_000,
    );
    let rest = format!(r#""nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{primitives}]}}]"#);
    refused_at_once(&maker.glb(&rest), "out of proportion");
}

#[test]
fn many_buffers_share_the_binary_chunk() {
    // Each would be a copy of two megabytes if it were taken by itself.
    let mut maker = Maker::brick();
    maker.data.resize(1 << 21, 0);
    let rest = r#""nodes":[{"mesh":0}],"meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1}]}]"#;
    let json = maker.json("", rest);
    let buffers = list(r#"{"byteLength":0}"#, 100_000);
    let json = json.replace(r#""buffers":["#, &format!(r#""buffers":[{buffers},"#));
    let json = json.replace(r#""buffer":0"#, r#""buffer":100000"#);
    refused_at_once(&glb(&json, &maker.data), "there is no binary chunk");
    let json = maker.json("", rest);
    let after = format!(r#"],"ignored":[{buffers}],"buffer"#);
    let json = json.replace(r#"],"buffers"#, &format!("{after}s"));
    let begin = Instant::now();
    assert!(body(&glb(&json, &maker.data)).volume() > 0.0);
    assert!(begin.elapsed() < Duration::from_secs(2));
}

#[test]
fn deep_and_wide_trees_of_nodes() {
    let count = 200_000;
    let chain: Vec<String> = (1..=count)
        .map(|n| format!(r#"{{"children":[{n}]}}"#))
        .collect();
    let rest = format!(
        r#""nodes":[{},{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}]"#,
        chain.join(",")
    );
    let begin = Instant::now();
    assert!((body(&Maker::brick().glb(&rest)).volume() - 1.0).abs() < 1e-6);
    assert!(begin.elapsed() < Duration::from_secs(2));
}

#[test]
fn offsets_that_overflow() {
    let good = Maker::brick();
    for json in [
        r#""bufferView":0,"byteOffset":18446744073709551615,"componentType":5126,"count":8,"type":"VEC3""#,
        r#""bufferView":0,"componentType":5126,"count":18446744073709551615,"type":"VEC3""#,
        r#""bufferView":0,"componentType":5126,"count":1537228672809129302,"type":"VEC3""#,
        r#""bufferView":2,"componentType":5126,"count":8,"type":"VEC3""#,
        r#""bufferView":3,"componentType":5126,"count":8,"type":"VEC3""#,
        r#""bufferView":4,"componentType":5126,"count":8,"type":"VEC3""#,
    ] {
        let mut maker = good.clone();
        maker.view_json(r#""buffer":0,"byteOffset":18446744073709551615,"byteLength":96"#);
        maker.view_json(r#""buffer":0,"byteOffset":96,"byteLength":18446744073709551615"#);
        maker.view_json(r#""buffer":0,"byteLength":96,"byteStride":9223372036854775808"#);
        let index = maker.accessor_json(json);
        let rest = format!(
            r#""nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{index}}},"indices":1}}]}}]"#
        );
        let error = fault(&maker.glb(&rest));
        assert!(error.contains("beyond"), "{error}");
    }
}
