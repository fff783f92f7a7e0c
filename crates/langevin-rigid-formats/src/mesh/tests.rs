use super::*;
use langevin_rigid_bake::shapes::Shape;
use proptest::prelude::*;

mod mangled;

const ALL: [MeshFormat; 5] = [
    MeshFormat::Obj,
    MeshFormat::Stl,
    MeshFormat::Ply,
    MeshFormat::Gltf,
    MeshFormat::Glb,
];

fn parse(bytes: &[u8], format: MeshFormat) -> Result<RawMesh, ParseError> {
    parse_mesh(bytes, format, Some(LengthUnit::M), None)
}

fn obj(mesh: &TriMesh) -> Vec<u8> {
    let mut out = Vec::new();
    write_obj(mesh, &mut out).unwrap();
    out
}

fn stl_binary(mesh: &TriMesh) -> Vec<u8> {
    let mut out = Vec::new();
    write_stl(mesh, &mut out).unwrap();
    out
}

fn stl_text(mesh: &TriMesh) -> Vec<u8> {
    let mut out = String::from("solid body\n");
    for t in 0..mesh.triangles().len() {
        out += "  facet normal 0 0 0\n    outer loop\n";
        for [x, y, z] in mesh.corners(t) {
            out += &format!("      vertex {x:e} {y:e} {z:e}\n");
        }
        out += "    endloop\n  endfacet\n";
    }
    (out + "endsolid body\n").into_bytes()
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum PlyKind {
    Text,
    Little,
    Big,
}

/// A PLY file with properties and an element a reader must pass over.
fn ply(mesh: &TriMesh, kind: PlyKind) -> Vec<u8> {
    let format = match kind {
        PlyKind::Text => "ascii",
        PlyKind::Little => "binary_little_endian",
        PlyKind::Big => "binary_big_endian",
    };
    let mut out = format!(
        "ply\nformat {format} 1.0\ncomment by hand\nelement vertex {}\nproperty uchar red\n\
         property double x\nproperty double y\nproperty double z\nelement thing 1\n\
         property list uchar short numbers\nelement face {}\nproperty list uchar int vertex_indices\n\
         property float quality\nend_header\n",
        mesh.vertices().len(),
        mesh.triangles().len(),
    )
    .into_bytes();
    let ordered = |mut bytes: Vec<u8>| {
        if kind == PlyKind::Big {
            bytes.reverse();
        }
        bytes
    };
    if kind == PlyKind::Text {
        for [x, y, z] in mesh.vertices() {
            out.extend(format!("255 {x} {y} {z}\n").bytes());
        }
        out.extend(b"2 7 -8\n");
        for [a, b, c] in mesh.triangles() {
            out.extend(format!("3 {a} {b} {c} 0.5\n").bytes());
        }
        return out;
    }
    for v in mesh.vertices() {
        out.push(255);
        v.iter()
            .for_each(|x| out.extend(ordered(x.to_le_bytes().to_vec())));
    }
    out.push(2);
    [7i16, -8]
        .iter()
        .for_each(|n| out.extend(ordered(n.to_le_bytes().to_vec())));
    for t in mesh.triangles() {
        out.push(3);
        t.iter()
            .for_each(|v| out.extend(ordered(v.to_le_bytes().to_vec())));
        out.extend(ordered(0.5f32.to_le_bytes().to_vec()));
    }
    out
}

/// Positions, then vertex numbers, as glTF buffers hold them.
fn gltf_buffer(mesh: &TriMesh) -> Vec<u8> {
    let floats = mesh
        .vertices()
        .as_flattened()
        .iter()
        .flat_map(|x| (*x as f32).to_le_bytes());
    let numbers = mesh
        .triangles()
        .as_flattened()
        .iter()
        .flat_map(|v| v.to_le_bytes());
    floats.chain(numbers).collect()
}

/// A document whose buffer has the address `uri`; the one node has the properties `node`.
fn gltf_json(mesh: &TriMesh, uri: &str, node: &str) -> String {
    let (v, t) = (mesh.vertices().len(), mesh.triangles().len());
    format!(
        r#"{{"asset":{{"version":"2.0"}},"scene":0,"scenes":[{{"nodes":[0]}}],
        "nodes":[{{"children":[1]}},{{"mesh":0{node}}}],
        "meshes":[{{"primitives":[{{"attributes":{{"POSITION":0}},"indices":1}}]}}],
        "accessors":[{{"bufferView":0,"componentType":5126,"count":{v},"type":"VEC3"}},
        {{"bufferView":1,"componentType":5125,"count":{},"type":"SCALAR"}}],
        "bufferViews":[{{"buffer":0,"byteLength":{}}},{{"buffer":0,"byteOffset":{},"byteLength":{}}}],
        "buffers":[{{{uri}"byteLength":{}}}]}}"#,
        3 * t,
        12 * v,
        12 * v,
        12 * t,
        12 * v + 12 * t,
    )
}

fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let group = |c: &[u8]| {
        let bits = c.iter().fold(0u32, |a, &b| a << 8 | u32::from(b)) << (8 * (3 - c.len()));
        let letter = |k: usize| char::from(LETTERS[(bits >> (18 - 6 * k)) as usize & 63]);
        (0..4)
            .map(|k| if k <= c.len() { letter(k) } else { '=' })
            .collect::<String>()
    };
    bytes.chunks(3).map(group).collect()
}

fn gltf(mesh: &TriMesh) -> Vec<u8> {
    let data = base64(&gltf_buffer(mesh));
    gltf_json(
        mesh,
        &format!(r#""uri":"data:application/octet-stream;base64,{data}","#),
        "",
    )
    .into_bytes()
}

fn glb(mesh: &TriMesh, node: &str) -> Vec<u8> {
    let (mut json, buffer) = (gltf_json(mesh, "", node).into_bytes(), gltf_buffer(mesh));
    json.resize(json.len().next_multiple_of(4), b' ');
    let mut out = b"glTF\x02\0\0\0".to_vec();
    out.extend((28 + json.len() as u32 + buffer.len() as u32).to_le_bytes());
    for (kind, chunk) in [(b"JSON", &json), (b"BIN\0", &buffer)] {
        out.extend((chunk.len() as u32).to_le_bytes());
        out.extend(kind);
        out.extend(chunk);
    }
    out
}

/// The body in every format and encoding.
fn files(mesh: &TriMesh) -> Vec<(MeshFormat, Vec<u8>)> {
    let mut files = vec![
        (MeshFormat::Obj, obj(mesh)),
        (MeshFormat::Stl, stl_text(mesh)),
        (MeshFormat::Stl, stl_binary(mesh)),
        (MeshFormat::Gltf, gltf(mesh)),
        (MeshFormat::Glb, glb(mesh, "")),
    ];
    for kind in [PlyKind::Text, PlyKind::Little, PlyKind::Big] {
        files.push((MeshFormat::Ply, ply(mesh, kind)));
    }
    files
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(32) })]

    #[test]
    fn a_body_survives_every_format(
        size in prop::array::uniform3(0.1..10.0f64),
        at in prop::array::uniform3(-1.0..1.0f64),
        triangles in 12usize..200,
    ) {
        let turn = [[0.6, -0.8, 0.0], [0.8, 0.6, 0.0], [0.0, 0.0, 1.0]];
        let body = Shape::Box { size }.mesh(triangles).unwrap().transformed(turn, at, 1.0).unwrap();
        for (format, bytes) in files(&body) {
            prop_assert_eq!(MeshFormat::of_content(&bytes), Some(format));
            let read = parse(&bytes, format).unwrap().body().unwrap();
            prop_assert_eq!(read.triangles().len(), body.triangles().len());
            prop_assert!(!read.was_turned());
            // Single precision in binary STL and glTF.
            prop_assert!((read.volume() / body.volume() - 1.0).abs() < 1e-5, "{:?}", format);
        }
    }
}

/// Whatever happens to a file, reading it ends, and in an answer.
#[test]
fn damaged_files_never_panic() {
    let body = Shape::Box {
        size: [1.0, 2.0, 3.0],
    }
    .mesh(12)
    .unwrap();
    for (format, good) in files(&body) {
        assert!(parse(&good, format).is_ok());
        let (mut refused, mut tried) = (0, 0);
        let mut attempt = |bytes: &[u8]| {
            for format in ALL
                .into_iter()
                .filter(|&f| f == format || bytes.len().is_multiple_of(16))
            {
                tried += 1;
                refused +=
                    usize::from(parse(bytes, format).map(|m| m.body().is_err()) != Ok(false));
            }
            MeshFormat::of_content(bytes);
        };
        for at in 0..good.len() {
            attempt(&good[..at]);
            for damage in [
                0x00,
                0xff,
                good[at] ^ 1,
                good[at] ^ 0x80,
                b'9',
                b'-',
                b' ',
                b'\n',
            ] {
                let mut bytes = good.clone();
                bytes[at] = damage;
                attempt(&bytes);
            }
            let mut bytes = good.clone();
            bytes.remove(at);
            attempt(&bytes);
        }
        assert!(
            refused * 5 > tried,
            "{format:?}: only {refused} of {tried} damaged files are noticed"
        );
    }
}

#[test]
fn huge_counts_are_not_believed() {
    let header = |count: &str| {
        format!(
            "ply\nformat binary_little_endian 1.0\nelement nothing {count}\nelement vertex {count}\n\
             property float x\nproperty float y\nproperty float z\nelement face {count}\n\
             property list uint int vertex_indices\nend_header\n"
        )
    };
    for count in ["18446744073709551615", "4294967296", "1000000000"] {
        let error = parse(header(count).as_bytes(), MeshFormat::Ply).unwrap_err();
        assert!(error.to_string().contains("ends too early"), "{error}");
    }
    let mut list = header("1").into_bytes();
    list.extend([0; 12]);
    list.extend(u32::MAX.to_le_bytes());
    assert!(parse(&list, MeshFormat::Ply).is_err());

    let mut stl = vec![0; 84];
    stl[80..].copy_from_slice(&u32::MAX.to_le_bytes());
    assert!(parse(&stl, MeshFormat::Stl).is_err());

    let body = Shape::Box { size: [1.0; 3] }.mesh(12).unwrap();
    for count in ["0", "9", "18446744073709551615", "1537228672809129302"] {
        let json = String::from_utf8(gltf(&body)).unwrap();
        let json = json.replace(r#""count":8,"#, &format!(r#""count":{count},"#));
        assert!(parse(json.as_bytes(), MeshFormat::Gltf).is_err(), "{count}");
    }
}

#[test]
fn units_scale_to_metres() {
    let body = Shape::Box { size: [1.0; 3] }.mesh(12).unwrap();
    for (symbol, volume) in [
        ("m", 1.0),
        ("cm", 1e-6),
        ("mm", 1e-9),
        ("um", 1e-18),
        ("in", 0.0254 * 0.0254 * 0.0254),
        ("ft", 0.3048 * 0.3048 * 0.3048),
    ] {
        let unit = symbol.parse().unwrap();
        let read = parse_mesh(&obj(&body), MeshFormat::Obj, Some(unit), None)
            .unwrap()
            .body()
            .unwrap();
        assert!((read.volume() / volume - 1.0).abs() < 1e-12);
    }
    let message = "yd".parse::<LengthUnit>().unwrap_err().to_string();
    assert_eq!(
        message,
        "`yd` is no unit of length; choose one of m, cm, mm, um, in, ft"
    );
}

#[test]
fn obj_reads_what_programs_write() {
    let text = "# by hand\nmtllib x.mtl\no tetrahedron\nv 0 0 0 1.0\nv 1 0 0 0.5 0.5 0.5\r\nv 0 1 0\n\
                v 0 \\\n0 1\nvt 0 0\nvn 0 0 1\ng one\nusemtl m\ns off\nf 1/1 3/1 2/1\nf 1//1 2//1 4//1\n\
                f 2/1/1 -2/1/1 -1/1/1\nl 1 2\nf 3 1 4 # last\n";
    let body = parse(text.as_bytes(), MeshFormat::Obj)
        .unwrap()
        .body()
        .unwrap();
    assert!((body.volume() - 1.0 / 6.0).abs() < 1e-15 && !body.was_turned());
    for (text, expected) in [
        (
            "v 0 0 0\nv 1 0\n",
            "line 2: a vertex needs three coordinates",
        ),
        ("v 0 0 zero\n", "line 1: `zero` is not a number"),
        (
            "v 0 0 0\nf 1 1 2\n",
            "line 2: there is no vertex 2, the file has 1",
        ),
        ("v 0 0 0\nf 0 1 1\n", "line 2: there is no vertex 0"),
        ("v 0 0 0\nf -2 1 1\n", "line 2: there is no vertex -2"),
        (
            "v 0 0 0\nf 1 1\n",
            "line 2: a face needs three corners, not 2",
        ),
        (
            "v 0 0 0\nf -9223372036854775808 1 1\n",
            "line 2: there is no vertex",
        ),
        ("v 0 0 0\n", "no triangles"),
    ] {
        let error = parse(text.as_bytes(), MeshFormat::Obj)
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn obj_seams_are_welded_but_closed_files_are_left_alone() {
    // The text form of STL has three vertices per facet: the same as OBJ.
    let body = Shape::Box { size: [1.0; 3] }.mesh(12).unwrap();
    let mut text = String::new();
    for t in 0..12 {
        for [x, y, z] in body.corners(t) {
            text += &format!("v {x} {y} {z}\n");
        }
        text += "f -3 -2 -1\n";
    }
    let read = parse(text.as_bytes(), MeshFormat::Obj).unwrap();
    assert_eq!((read.vertices.len(), read.body().is_ok()), (8, true));
    // Two closed boxes that touch along a face are two, which do not make one body.
    let shifted = body.transformed(
        [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [1.0, 0.0, 0.0],
        1.0,
    );
    let mut two = obj(&body);
    for [x, y, z] in shifted.unwrap().vertices() {
        two.extend(format!("v {x} {y} {z}\n").bytes());
    }
    for [a, b, c] in body.triangles() {
        two.extend(format!("f {} {} {}\n", a + 9, b + 9, c + 9).bytes());
    }
    let read = parse(&two, MeshFormat::Obj).unwrap();
    assert!(matches!(read.body(), Err(MeshError::PartsMeet { .. })));
}

#[test]
fn binary_stl_may_begin_with_solid() {
    let body = Shape::Box { size: [1.0; 3] }.mesh(12).unwrap();
    let mut bytes = stl_binary(&body);
    bytes[..16].copy_from_slice(b"solid from a CAD");
    assert_eq!(MeshFormat::of_content(&bytes), Some(MeshFormat::Stl));
    assert!(parse(&bytes, MeshFormat::Stl).unwrap().body().is_ok());
    bytes.extend(b"trailing notes");
    assert!(parse(&bytes, MeshFormat::Stl).unwrap().body().is_ok());
    let error = parse(&bytes[..400], MeshFormat::Stl)
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("byte 400: the file ends at facet 6 of 12"),
        "{error}"
    );
}

#[test]
fn text_stl_errors_name_the_line() {
    for (text, expected) in [
        (
            "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nendloop\nendfacet\nendsolid",
            "line 5: a facet has 1 corners",
        ),
        ("solid\nvertex 0 0 x\n", "line 2: `x` is not a number"),
        (
            "solid\nfacet normal 0 0 1\n",
            "line 2: the file ends within a facet",
        ),
        (
            "solid\nbox 1 2 3\nendsolid",
            "line 2: `box` does not belong",
        ),
        ("solid empty\nendsolid empty\n", "no triangles"),
    ] {
        let error = parse(text.as_bytes(), MeshFormat::Stl)
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn ply_errors_name_the_place() {
    let start = "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n";
    for (text, expected) in [
        (format!("{start}0 0\nx\n"), "line 11: `x` is not a number"),
        (
            format!("{start}0 0 0\n3 0 0 -1\n"),
            "a vertex number is negative",
        ),
        (
            format!("{start}0 0 0\n3 0 0 1\n"),
            "a face has vertex 1, there are 1",
        ),
        (
            format!("{start}0 0 0\n-3 0 0 0\n"),
            "a list cannot have -3 entries",
        ),
        (
            "ply\nformat ascii 1.0\nelement vertex many\n".to_owned(),
            "line 3: `many` is not a number",
        ),
        (
            "ply\nformat utf8 1.0\n".to_owned(),
            "line 2: there is no PLY format `utf8`",
        ),
        (
            "ply\nproperty float x\n".to_owned(),
            "line 2: a property without an element",
        ),
        (
            "ply\nend_header\n".to_owned(),
            "line 2: the format line is missing",
        ),
        (
            "ply\nformat ascii 1.0\nelement tristrips 1\nproperty list int int strip\nend_header\n"
                .to_owned(),
            "the element `tristrips` has no property vertex_indices",
        ),
    ] {
        let error = parse(text.as_bytes(), MeshFormat::Ply)
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{error}");
    }
}

#[test]
fn gltf_nodes_place_and_mirror_the_mesh() {
    let body = Shape::Box {
        size: [1.0, 2.0, 4.0],
    }
    .mesh(12)
    .unwrap();
    let node = r#","translation":[10,0,0],"rotation":[0,0,0.70710678118654752,0.70710678118654752],"scale":[-2,1,1]"#;
    let read = parse(&glb(&body, node), MeshFormat::Glb)
        .unwrap()
        .body()
        .unwrap();
    assert!((read.volume() - 16.0).abs() < 1e-9);
    assert!(!read.was_turned(), "a mirroring node turns the triangles");
    // Scale, then a quarter turn about Z: 2 along Y, 2 along X, 4 along Z, around x = 10.
    let [low, high] = read.bounding_box();
    for (k, (expected_low, expected_high)) in [(9.0, 11.0), (-1.0, 1.0), (-2.0, 2.0)]
        .into_iter()
        .enumerate()
    {
        assert!((low[k] - expected_low).abs() < 1e-9 && (high[k] - expected_high).abs() < 1e-9);
    }
    // The same as a matrix (column-major).
    let matrix = r#","matrix":[0,-2,0,0, -1,0,0,0, 0,0,1,0, 10,0,0,1]"#;
    let same = parse(&glb(&body, matrix), MeshFormat::Glb)
        .unwrap()
        .body()
        .unwrap();
    assert!(
        same.vertices()
            .iter()
            .zip(read.vertices())
            .all(|(a, b)| (0..3).all(|k| (a[k] - b[k]).abs() < 1e-9))
    );
}

#[test]
fn gltf_strips_and_fans_are_triangles_and_lines_are_not() {
    let body = Shape::Box { size: [1.0; 3] }.mesh(12).unwrap();
    let with_mode = |mode: u32| {
        let json = String::from_utf8(gltf(&body)).unwrap();
        parse(
            json.replace(r#""indices":1"#, &format!(r#""indices":1,"mode":{mode}"#))
                .as_bytes(),
            MeshFormat::Gltf,
        )
    };
    assert_eq!(with_mode(4).unwrap().triangles.len(), 12);
    assert_eq!(with_mode(5).unwrap().triangles.len(), 34);
    assert_eq!(with_mode(6).unwrap().triangles.len(), 34);
    assert_eq!(with_mode(1), Err(ParseError::NoTriangles));
}

#[test]
fn gltf_faults_are_named() {
    let body = Shape::Box { size: [1.0; 3] }.mesh(12).unwrap();
    let good = String::from_utf8(gltf(&body)).unwrap();
    for (from, to, expected) in [
        (
            r#""version":"2.0""#,
            r#""version":"1.0""#,
            "version 1.0 of glTF",
        ),
        (r#""scene":0"#, r#""scene":3"#, "there is no scene 3"),
        (r#""mesh":0"#, r#""mesh":7"#, "there is no mesh 7"),
        (
            r#""children":[1]"#,
            r#""children":[1,1]"#,
            "node 1 is reached twice",
        ),
        (
            r#""children":[1]"#,
            r#""children":[0]"#,
            "node 0 is reached twice",
        ),
        (
            r#""scene":0,"#,
            r#""scene":0,"extensionsRequired":["EXT_unheard_of"],"#,
            "the extension EXT_unheard_of",
        ),
        (
            "data:application/octet-stream;base64,",
            "data:text/plain,",
            "base64",
        ),
        (
            r#""bufferView":0,"#,
            r#""bufferView":0,"byteOffset":4,"#,
            "accessor 0 reaches beyond its buffer",
        ),
        (r#""bufferView":0,"#, "", "accessor 0 has no buffer view"),
        (r#"{"asset""#, r#"{"asset"::"#, "line 1: "),
    ] {
        assert!(good.contains(from), "{from}");
        let error = parse(good.replacen(from, to, 1).as_bytes(), MeshFormat::Gltf)
            .unwrap_err()
            .to_string();
        assert!(error.contains(expected), "{expected}: {error}");
    }
}

/// A folder of its own for one test, removed at its end.
struct Folder(std::path::PathBuf);

impl Folder {
    fn new(name: &str) -> Folder {
        let path =
            std::env::temp_dir().join(format!("langevin-rigid-{name}-{}", std::process::id()));
        std::fs::create_dir_all(&path).unwrap();
        Folder(path)
    }
}

impl Drop for Folder {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

#[test]
fn files_are_found_out_by_content_and_buffers_beside_them() {
    let folder = Folder::new("mesh-files");
    let body = Shape::Box { size: [1.0; 3] }.mesh(12).unwrap();
    for (format, bytes) in files(&body) {
        for name in ["body", "body.xyz", "body.obj", "body.stl"] {
            std::fs::write(folder.0.join(name), &bytes).unwrap();
            let read = read_mesh(&folder.0.join(name), Some(LengthUnit::M)).unwrap();
            assert!(read.body().is_ok(), "{format:?} as {name}");
        }
    }
    std::fs::write(folder.0.join("a buffer.bin"), gltf_buffer(&body)).unwrap();
    let beside = gltf_json(&body, r#""uri":"a%20buffer.bin","#, "");
    std::fs::write(folder.0.join("body.gltf"), &beside).unwrap();
    assert!(
        read_mesh(&folder.0.join("body.gltf"), Some(LengthUnit::M))
            .unwrap()
            .body()
            .is_ok()
    );
    let missing = beside.replace("a%20buffer", "another");
    std::fs::write(folder.0.join("body.gltf"), missing).unwrap();
    let error = read_mesh(&folder.0.join("body.gltf"), Some(LengthUnit::M))
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("body.gltf") && error.contains("another.bin"),
        "{error}"
    );
}

#[test]
fn unreadable_files_are_told_apart() {
    let folder = Folder::new("mesh-errors");
    let read = |name: &str| read_mesh(&folder.0.join(name), Some(LengthUnit::M)).unwrap_err();
    assert!(matches!(read("missing.obj"), ReadError::NotFound { .. }));
    assert!(matches!(read("."), ReadError::Folder { .. }));
    std::fs::write(folder.0.join("hull.obj"), b"\x89PNG\r\n").unwrap();
    std::fs::write(folder.0.join("hull.blend"), b"\x00\x01").unwrap();
    assert!(read("hull.obj").to_string().contains("is a picture"));
    assert!(
        read("hull.blend")
            .to_string()
            .contains("is a Blender scene")
    );
    std::fs::write(folder.0.join("notes.txt"), b"a hull").unwrap();
    let error = read("notes.txt");
    assert!(matches!(error, ReadError::UnknownFormat { .. }));
    assert!(
        error
            .to_string()
            .contains(".obj, .stl, .ply, .gltf, .glb and .dae")
    );
    std::fs::write(folder.0.join("bad.obj"), b"v 0 0 0\nv 1 x 0\n").unwrap();
    let error = read("bad.obj").to_string();
    assert!(
        error.contains("bad.obj`: line 2: `x` is not a number"),
        "{error}"
    );
}

#[cfg(not(feature = "collada"))]
#[test]
fn without_its_reader_collada_is_refused_by_name() {
    let file = b"<?xml version=\"1.0\"?><COLLADA version=\"1.4.1\"/>";
    assert_eq!(MeshFormat::of_content(file), Some(MeshFormat::Collada));
    let refused = parse_mesh(file, MeshFormat::Collada, None, None).unwrap_err();
    let refused = refused.to_string();
    let named = refused.contains("without the feature `collada`");
    assert!(named, "{refused}");
}
