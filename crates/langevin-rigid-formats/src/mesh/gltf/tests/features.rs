use super::*;

const LOW: [f64; 3] = [-1.0, -0.5, -0.25];
const HIGH: [f64; 3] = [1.0, 0.5, 0.25];

/// A brick with a skin of two joints: `joints` and `weights` of each vertex by the sign of its x.
fn skinned(set: usize, joints: [[u8; 4]; 2], weights: [[f64; 4]; 2]) -> Maker {
    let mut maker = Maker::brick();
    let side: Vec<usize> = brick()
        .vertices()
        .iter()
        .map(|v| usize::from(v[0] > 0.0))
        .collect();
    if set == 1 {
        // The first set binds to nothing.
        maker.accessor(&[0; 32], UNSIGNED_BYTE, "VEC4", 8, "");
        maker.accessor(&[0; 128], FLOAT, "VEC4", 8, "");
    }
    let joints: Vec<u8> = side.iter().flat_map(|&s| joints[s]).collect();
    maker.accessor(&joints, UNSIGNED_BYTE, "VEC4", 8, "");
    let weights: Vec<f64> = side.iter().flat_map(|&s| weights[s]).collect();
    maker.accessor(&floats(&weights), FLOAT, "VEC4", 8, "");
    maker
}

/// Node 0 holds the skinned mesh (1) and two joints at x = -1 (2) and x = 3 (3), all scaled by 100.
fn with_skin(maker: &Maker, attributes: &str, skin: &str) -> Vec<u8> {
    maker.glb(&format!(
        r#""nodes":[{{"children":[1,2,3],"scale":[100,100,100]}},{{"mesh":0,"skin":0,"translation":[9,9,9]}},
        {{"translation":[-0.01,0,0],"scale":[0.01,0.01,0.01]}},{{"translation":[0.03,0,0],"scale":[0.01,0.01,0.01]}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0{attributes}}},"indices":1}}]}}],
        "skins":[{{"joints":[2,3]{skin}}}]"#
    ))
}

const SET_0: &str = r#","JOINTS_0":2,"WEIGHTS_0":3"#;

#[test]
fn skins_follow_their_joints_and_not_their_node() {
    let ends = skinned(0, [[0; 4], [1, 0, 0, 0]], [[1.0, 0.0, 0.0, 0.0]; 2]);
    let read = body(&with_skin(&ends, SET_0, ""));
    assert!(fills(&read, [-2.0, -0.5, -0.25], [4.0, 0.5, 0.25], 1e-5));
    // Weights need not sum to one; both joints in equal parts are at their middle, x = 1.
    let equal = skinned(0, [[0, 1, 0, 0]; 2], [[0.2, 0.2, 0.0, 0.0]; 2]);
    let read = body(&with_skin(&equal, SET_0, ""));
    assert!(fills(&read, [0.0, -0.5, -0.25], [2.0, 0.5, 0.25], 1e-5));
    // The same in a second set.
    let second = skinned(1, [[0, 1, 0, 0]; 2], [[0.2, 0.2, 0.0, 0.0]; 2]);
    let sets = r#","JOINTS_0":2,"WEIGHTS_0":3,"JOINTS_1":4,"WEIGHTS_1":5"#;
    assert_eq!(body(&with_skin(&second, sets, "")), read);
    // Weights as bytes.
    let mut bytes = skinned(0, [[0, 1, 0, 0]; 2], [[0.0; 4]; 2]);
    let weights = [128, 128, 0, 0].repeat(8);
    let index = bytes.accessor(&weights, UNSIGNED_BYTE, "VEC4", 8, r#","normalized":true"#);
    let set = format!(r#","JOINTS_0":2,"WEIGHTS_0":{index}"#);
    assert_eq!(body(&with_skin(&bytes, &set, "")), read);
}

#[test]
fn inverse_bind_matrices_come_before_the_joints() {
    let mut maker = skinned(0, [[0; 4]; 2], [[1.0, 0.0, 0.0, 0.0]; 2]);
    let half = [
        [0.5, 0.0, 0.0, 0.0],
        [0.0, 0.5, 0.0, 0.0],
        [0.0, 0.0, 0.5, 0.0],
        [0.0, 4.0, 0.0, 1.0],
    ];
    let two = floats(&[half, half].as_flattened().concat());
    let index = maker.accessor(&two, FLOAT, "MAT4", 2, "");
    let skin = format!(r#","inverseBindMatrices":{index}"#);
    let read = body(&with_skin(&maker, SET_0, &skin));
    assert!(fills(
        &read,
        [-1.5, 3.75, -0.125],
        [-0.5, 4.25, 0.125],
        1e-5
    ));
    let index = maker.accessor(&two[..64], FLOAT, "MAT4", 1, "");
    let skin = format!(r#","inverseBindMatrices":{index}"#);
    let error = fault(&with_skin(&maker, SET_0, &skin));
    assert!(error.contains("fewer inverse bind matrices"), "{error}");
}

#[test]
fn faults_of_skins_are_named() {
    let good = skinned(0, [[0; 4]; 2], [[1.0, 0.0, 0.0, 0.0]; 2]);
    let error = fault(&with_skin(&good, "", ""));
    assert!(error.contains("follows no joint"), "{error}");
    let error = fault(&with_skin(&good, r#","JOINTS_0":2"#, ""));
    assert!(error.contains("no attribute WEIGHTS_0"), "{error}");
    let beyond = skinned(0, [[2, 0, 0, 0]; 2], [[1.0, 0.0, 0.0, 0.0]; 2]);
    let error = fault(&with_skin(&beyond, SET_0, ""));
    assert!(error.contains("follows joint 2, there are 2"), "{error}");
    let loose = skinned(0, [[0; 4]; 2], [[0.0; 4]; 2]);
    let error = fault(&with_skin(&loose, SET_0, ""));
    assert!(
        error.contains("vertex 0 of a skin follows no joint"),
        "{error}"
    );
    // The joint holds itself.
    let cycle = good.glb(
        r#""scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"skin":0},{"children":[1]}],"skins":[{"joints":[1]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]}]"#,
    );
    assert!(fault(&cycle).contains("node 1 is in no tree"));
}

#[test]
fn joints_may_be_outside_the_scene() {
    let maker = skinned(0, [[0; 4]; 2], [[1.0, 0.0, 0.0, 0.0]; 2]);
    let read = body(&maker.glb(
        r#""scenes":[{"nodes":[0]}],"nodes":[{"mesh":0,"skin":0},{"mesh":0,"children":[2],"scale":[2,2,2]},
        {"translation":[0,1,0]}],"skins":[{"joints":[2]}],
        "meshes":[{"primitives":[{"attributes":{"POSITION":0,"JOINTS_0":2,"WEIGHTS_0":3},"indices":1}]}]"#,
    ));
    assert!(fills(&read, [-2.0, 1.0, -0.5], [2.0, 3.0, 0.5], 1e-6));
}

#[test]
fn morph_targets_have_the_weights_of_the_node_or_the_mesh() {
    let mut maker = Maker::brick();
    let brick = brick();
    let longer: Vec<f64> = brick
        .vertices()
        .iter()
        .flat_map(|v| [v[0], 0.0, 0.0])
        .collect();
    let longer = maker.accessor(&floats(&longer), FLOAT, "VEC3", 8, "");
    let target = format!(r#","targets":[{{"NORMAL":0}},{{"POSITION":{longer}}}]"#);
    for (node, mesh, half_length) in [
        ("", "", 1.0),
        ("", r#","weights":[1,1]"#, 2.0),
        (r#","weights":[0,0.5]"#, r#","weights":[1,1]"#, 1.5),
        (r#","weights":[1,0]"#, r#","weights":[1,1]"#, 1.0),
        (r#","weights":[1]"#, "", 1.0),
    ] {
        let read = body(&maker.shown(node, &target, mesh));
        let (low, high) = ([-half_length, -0.5, -0.25], [half_length, 0.5, 0.25]);
        assert!(fills(&read, low, high, 1e-6), "{node} {mesh}");
    }
    let error = fault(&maker.shown("", r#","targets":[{"POSITION":1}]"#, ""));
    assert!(error.contains("accessor 1 is SCALAR"), "{error}");
    let short = maker.accessor(&[0; 84], FLOAT, "VEC3", 7, "");
    let error = fault(&maker.shown("", &format!(r#","targets":[{{"POSITION":{short}}}]"#), ""));
    assert!(error.contains("differ in number"), "{error}");
}

fn instancing(attributes: &str) -> String {
    format!(r#","extensions":{{"EXT_mesh_gpu_instancing":{{"attributes":{{{attributes}}}}}}}"#)
}

#[test]
fn instances_are_placed_within_their_node() {
    let mut maker = Maker::brick();
    let places = maker.accessor(
        &floats(&[0.0, 0.0, 0.0, 5.0, 0.0, 0.0]),
        FLOAT,
        "VEC3",
        2,
        "",
    );
    let turns: Vec<u8> = [[0i16, 0, 0, 32767], [0, 0, 23170, 23170]]
        .as_flattened()
        .iter()
        .flat_map(|x| x.to_le_bytes())
        .collect();
    let turns = maker.accessor(&turns, SHORT, "VEC4", 2, r#","normalized":true"#);
    let scales = maker.accessor(
        &floats(&[1.0, 1.0, 1.0, -2.0, 2.0, 2.0]),
        FLOAT,
        "VEC3",
        2,
        "",
    );
    let node = instancing(&format!(
        r#""TRANSLATION":{places},"ROTATION":{turns},"SCALE":{scales},"_ID":77"#
    ));
    let read = read(&maker.shown(&format!(r#","scale":[1,1,3]{node}"#), "", "")).unwrap();
    assert_eq!(read.triangles.len(), 24);
    let half = |range: std::ops::Range<usize>| {
        let part = RawMesh {
            vertices: read.vertices[8 * range.start / 12..8 * range.end / 12].to_vec(),
            triangles: read.triangles[range.clone()]
                .iter()
                .map(|t| t.map(|v| v - 8 * (range.start / 12) as u32))
                .collect(),
            notices: Vec::new(),
            ..RawMesh::default()
        };
        part.body().unwrap()
    };
    assert!(fills(
        &half(0..12),
        [-1.0, -0.5, -0.75],
        [1.0, 0.5, 0.75],
        1e-4
    ));
    // Twice as large, mirrored, turned by a quarter about z.
    let second = half(12..24);
    assert!(fills(&second, [4.0, -2.0, -1.5], [6.0, 2.0, 1.5], 1e-4));
    assert!(!second.was_turned());

    let one = maker.accessor(&[0; 12], FLOAT, "VEC3", 1, "");
    let node = instancing(&format!(r#""TRANSLATION":{one},"SCALE":{scales}"#));
    assert!(fault(&maker.shown(&node, "", "")).contains("not as many"));
    assert!(fills(
        &body(&maker.shown(&instancing(""), "", "")),
        LOW,
        HIGH,
        1e-6
    ));
    let node = format!(r#","skin":0{}"#, instancing(r#""TRANSLATION":0"#));
    assert!(fault(&maker.shown(&node, "", "")).contains("instances of a mesh with a skin"));
}

#[test]
fn positions_may_be_integers() {
    let unit: Vec<[f64; 3]> = brick()
        .vertices()
        .iter()
        .map(|v| [v[0], 2.0 * v[1], 4.0 * v[2]])
        .collect();
    // Corners of a cube from -1 to 1, times the greatest number.
    for (component, greatest, size) in [(BYTE, 127.0, 1), (SHORT, 32767.0, 2)] {
        let mut maker = Maker::brick();
        let bytes: Vec<u8> = unit
            .iter()
            .flat_map(|v| {
                let mut item: Vec<u8> = v
                    .iter()
                    .flat_map(|x| ((x * greatest) as i16).to_le_bytes()[..size].to_vec())
                    .collect();
                item.resize(item.len().next_multiple_of(4), 0);
                item
            })
            .collect();
        let stride = format!(r#","byteStride":{}"#, bytes.len() / 8);
        let view = maker.view(&bytes, &stride);
        for (normalized, half) in [(true, 1.0), (false, greatest)] {
            let index = maker.accessor_json(&format!(
                r#""bufferView":{view},"componentType":{component},"normalized":{normalized},"count":8,"type":"VEC3""#
            ));
            let read = body(&maker.glb(&format!(
                r#""extensionsRequired":["KHR_mesh_quantization"],"nodes":[{{"mesh":0}}],
                "meshes":[{{"primitives":[{{"attributes":{{"POSITION":{index}}},"indices":1}}]}}]"#
            )));
            assert!(fills(&read, [-half; 3], [half; 3], 1e-9), "{component}");
        }
    }
    // Unsigned, from 0 to 1.
    for (component, greatest) in [(UNSIGNED_BYTE, vec![255]), (UNSIGNED_SHORT, vec![255, 255])] {
        let mut maker = Maker::brick();
        let digit = |x: &f64| {
            if *x > 0.0 {
                greatest.clone()
            } else {
                vec![0; greatest.len()]
            }
        };
        let bytes: Vec<u8> = unit.as_flattened().iter().flat_map(digit).collect();
        let index = maker.accessor(&bytes, component, "VEC3", 8, r#","normalized":true"#);
        let read = body(&maker.glb(&format!(
            r#""nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{index}}},"indices":1}}]}}]"#
        )));
        assert!(fills(&read, [0.0; 3], [1.0; 3], 1e-9), "{component}");
    }
}

#[test]
fn sparse_accessors_replace_items() {
    let mut maker = Maker::brick();
    let all = brick();
    let doubled: Vec<f64> = all
        .vertices()
        .as_flattened()
        .iter()
        .map(|x| 2.0 * x)
        .collect();
    let values = maker.view(&floats(&doubled), "");
    let numbers = maker.view(&[0, 1, 2, 3, 4, 5, 6, 7], "");
    let sparse = |count: usize, view: &str, numbers: usize| {
        format!(
            r#"{view}"componentType":5126,"count":8,"type":"VEC3","sparse":{{"count":{count},
            "indices":{{"bufferView":{numbers},"componentType":5121}},"values":{{"bufferView":{values}}}}}"#
        )
    };
    let shown = |maker: &Maker, index: usize| {
        maker.glb(&format!(
            r#""nodes":[{{"mesh":0}}],"meshes":[{{"primitives":[{{"attributes":{{"POSITION":{index}}},"indices":1}}]}}]"#
        ))
    };
    // All items, over nothing.
    let index = maker.accessor_json(&sparse(8, "", numbers));
    let read = body(&shown(&maker, index));
    assert!(fills(
        &read,
        LOW.map(|x| 2.0 * x),
        HIGH.map(|x| 2.0 * x),
        1e-6
    ));
    // One item over those of the brick: a corner goes out by itself, half the diagonal farther.
    let index = maker.accessor_json(&sparse(1, r#""bufferView":0,"#, numbers));
    let read = self::read(&shown(&maker, index)).unwrap();
    for (k, (v, before)) in read.vertices.iter().zip(all.vertices()).enumerate() {
        let times = if k == 0 { 2.0 } else { 1.0 };
        assert_eq!(*v, before.map(|x| times * x));
    }
    let unsorted = maker.view(&[1, 0, 0, 0, 0, 0, 0, 0], "");
    let beyond = maker.view(&[0, 8], "");
    for (count, numbers) in [(2, unsorted), (2, beyond)] {
        let index = maker.accessor_json(&sparse(count, "", numbers));
        assert!(fault(&shown(&maker, index)).contains("do not increase up to 8"));
    }
    for count in [9, usize::MAX, usize::MAX / 12 + 2] {
        let index = maker.accessor_json(&sparse(count, "", numbers));
        assert!(fault(&shown(&maker, index)).contains("sparse items beyond their buffer"));
    }
}

#[test]
fn lines_and_points_are_passed_over_with_a_notice() {
    let maker = Maker::brick();
    let with = |primitives: &str| {
        maker.glb(&format!(
            r#""nodes":[{{"mesh":0}},{{"mesh":0,"translation":[3,0,0]}}],"meshes":[{{"primitives":[{primitives}]}}]"#
        ))
    };
    let line = r#"{"attributes":{"POSITION":0},"mode":1}"#;
    let loop_ = r#"{"attributes":{"POSITION":0},"mode":2}"#;
    let point = r#"{"attributes":{"POSITION":0},"mode":0}"#;
    let surface = r#"{"attributes":{"POSITION":0},"indices":1}"#;
    let mesh = read(&with(&[line, surface, loop_, point].join(","))).unwrap();
    assert_eq!(mesh.triangles.len(), 24);
    assert_eq!(mesh.notices.len(), 2, "{:?}", mesh.notices);
    assert!(mesh.notices[0].contains("points") && mesh.notices[1].contains("lines"));
    assert_eq!(read(&with(surface)).unwrap().notices.len(), 0);
    assert_eq!(
        read(&with(&[line, point].join(","))),
        Err(ParseError::NoTriangles)
    );
    let seven = r#"{"attributes":{"POSITION":0},"mode":7}"#;
    assert!(fault(&with(seven)).contains("no primitive mode 7"));
}

#[test]
fn the_first_version_is_refused_by_its_name() {
    let mut header = glb("{}", &[]);
    header[4] = 1;
    assert!(fault(&header).contains("version 1.0 of glTF"));
    for (json, expected) in [
        (
            r#"{"asset":{"version":"1.0"},"meshes":{"a":{}}}"#,
            "version 1.0 of glTF",
        ),
        (r#"{"asset":{"version":"1.1"}}"#, "version 1.0 of glTF"),
        (
            r#"{"meshes":{"a":{"primitives":[]}}}"#,
            "version 1.0 of glTF",
        ),
        (
            r#"{"asset":{"version":"2.0"},"meshes":{"a":{}}}"#,
            "version 1.0 of glTF",
        ),
        (r#"{"meshes":[]}"#, "no `asset`"),
        (r#"{"asset":{"version":"3.0"}}"#, "version 3.0 of glTF"),
        (
            r#"{"asset":{"version":"2.0"},"meshes":7}"#,
            "line 1: invalid type",
        ),
        (r#"{"asset":{"version":"2.0"},"meshes":["#, "line 1: EOF"),
    ] {
        let error = parse_mesh(json.as_bytes(), MeshFormat::Gltf, None, None).unwrap_err();
        let error = error.to_string();
        assert!(error.contains(expected), "{json}: {error}");
        let remedied = !expected.contains("1.0") || error.contains("gltf-pipeline");
        assert!(remedied, "{error}");
    }
}

#[test]
fn another_unit_than_metres_is_noticed() {
    let glb = Maker::brick().shown("", "", "");
    let read = |unit| parse_mesh(&glb, MeshFormat::Glb, unit, None).unwrap();
    assert_eq!(read(None), read(Some("m".parse().unwrap())));
    assert_eq!(read(None).notices.len(), 0);
    let small = read(Some("mm".parse().unwrap()));
    assert!(small.notices[0].contains("in mm in place of m"));
    assert!((small.body().unwrap().volume() / 1e-9 - 1.0).abs() < 1e-9);
    let obj = b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
    let error = parse_mesh(obj, MeshFormat::Obj, None, None).unwrap_err();
    assert_eq!(error, ParseError::NoUnit);
}
