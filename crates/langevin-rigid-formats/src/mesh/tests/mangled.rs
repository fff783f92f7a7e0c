//! Files as programs write, move and damage them without harm.

use super::*;

const BOX: Shape = Shape::Box {
    size: [2.0, 1.0, 0.5],
};

type Mangling = (&'static str, fn(&str) -> Vec<u8>);

const MANGLINGS: [Mangling; 9] = [
    ("CR LF", |t| t.replace('\n', "\r\n").into_bytes()),
    ("CR", |t| t.replace('\n', "\r").into_bytes()),
    ("mixed", |t| {
        t.replacen('\n', "\r\n", 3)
            .replacen("\r\n", "\n", 1)
            .into_bytes()
    }),
    ("UTF-8 mark", |t| [b"\xef\xbb\xbf", t.as_bytes()].concat()),
    ("UTF-16 LE", |t| utf16(t, u16::to_le_bytes)),
    ("UTF-16 BE", |t| utf16(t, u16::to_be_bytes)),
    ("NULs", |t| [t.as_bytes(), &[0; 100]].concat()),
    ("upper case", |t| t.to_uppercase().into_bytes()),
    ("tabs", |t| t.replace(' ', "\t").into_bytes()),
];

fn utf16(text: &str, bytes: fn(u16) -> [u8; 2]) -> Vec<u8> {
    let units = std::iter::once(0xfeff).chain(text.encode_utf16());
    units.flat_map(bytes).collect()
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(16) })]

    #[test]
    fn mangled_text_is_the_same_mesh(
        size in prop::array::uniform3(0.1..10.0f64),
        triangles in 12usize..100,
    ) {
        let body = Shape::Box { size }.mesh(triangles).unwrap();
        let texts = [
            (MeshFormat::Obj, obj(&body)),
            (MeshFormat::Stl, stl_text(&body)),
            (MeshFormat::Ply, ply(&body, PlyKind::Text)),
        ];
        for (format, bytes) in texts {
            let text = String::from_utf8(bytes).unwrap();
            let expected = parse(text.as_bytes(), format).unwrap();
            prop_assert!(expected.notices.is_empty());
            let mut files: Vec<(&str, Vec<u8>)> =
                MANGLINGS.iter().map(|(name, mangle)| (*name, mangle(&text))).collect();
            if format == MeshFormat::Stl {
                files.push(("words", text.replace('\n', " ").into_bytes()));
                files.push(("one word a line", text.replace(" body", "").replace(' ', "\n").into_bytes()));
                files.push(("no end", text.replace("endsolid body\n", "").into_bytes()));
                files.push(("two words", text.replace("endsolid", "end solid").into_bytes()));
                files.push(("a normal", text.replace("normal 0 0 0", "normal nan -nan 1.#QNAN").into_bytes()));
            }
            if format == MeshFormat::Ply {
                let (header, values) = text.split_once("end_header\n").unwrap();
                let one = values.replace('\n', " ");
                files.push(("one line", format!("{header}end_header\n{one}").into_bytes()));
                let more = values.replace('\n', " 7 8\n");
                files.push(("more values", format!("{header}end_header\n{more}").into_bytes()));
            }
            for (name, bytes) in files {
                prop_assert_eq!(MeshFormat::of_content(&bytes), Some(format), "{}", name);
                let read = parse(&bytes, format);
                prop_assert!(read.is_ok(), "{:?} {}: {:?}", format, name, read);
                let read = read.unwrap();
                prop_assert_eq!(&read.triangles, &expected.triangles, "{}", name);
                prop_assert_eq!(&read.vertices, &expected.vertices, "{}", name);
                let silent = ["CR LF", "mixed", "upper case", "tabs", "one word a line", "two words", "a normal", "words"];
                let tells = !silent.contains(&name);
                prop_assert_eq!(read.notices.len(), usize::from(tells), "{}: {:?}", name, read.notices);
            }
        }
    }
}

#[track_caller]
fn error(text: &str, format: MeshFormat) -> String {
    parse(text.as_bytes(), format).unwrap_err().to_string()
}

#[test]
fn broken_numbers_of_used_vertices_are_errors_with_their_line() {
    let text = String::from_utf8(obj(&BOX.mesh(12).unwrap())).unwrap();
    let third = text.lines().nth(2).unwrap();
    for (word, expected) in [
        ("1.#IND00", "line 3: `1.#IND00` is not a number"),
        ("-1.#INF", "line 3: `-1.#INF` is not a number"),
        (
            "nan",
            "line 3: a face has this vertex, and `nan` is not a number",
        ),
        (
            "1e999",
            "line 3: a face has this vertex, and `1e999` is not a number",
        ),
        (
            "0,25",
            "line 3: `0,25` is not a number: write numbers with a decimal point",
        ),
    ] {
        let bad = text.replacen(third, &format!("v 1 2 {word}"), 1);
        let error = error(&bad, MeshFormat::Obj);
        assert!(error.contains(expected), "{error}");
    }
    // A vertex that no face has may be anything.
    let read = parse(
        format!("v nan 0 0\n{text}")
            .replace("f ", "f -9 -9 -9\nf ")
            .as_bytes(),
        MeshFormat::Obj,
    );
    assert!(read.is_err());
    let unused = parse(format!("{text}v nan inf 0\n").as_bytes(), MeshFormat::Obj).unwrap();
    assert_eq!((unused.vertices.len(), unused.notices.len()), (8, 1));
    assert!(unused.body().is_ok());
    let stl = String::from_utf8(stl_text(&BOX.mesh(12).unwrap())).unwrap();
    let bad = stl.replacen("vertex ", "vertex inf 0 0 vertex ", 1);
    assert!(error(&bad, MeshFormat::Stl).contains("line 4: `inf` is not a number"));
    let ply = String::from_utf8(ply(&BOX.mesh(12).unwrap(), PlyKind::Text)).unwrap();
    let bad = ply
        .replacen("\n255 ", "\n255 nan 0 0\n255 ", 1)
        .replace("vertex 8", "vertex 9");
    let error = error(&bad, MeshFormat::Ply);
    assert!(error.contains("line 15: a face has vertex 0"), "{error}");
}

#[test]
fn fortran_exponents_and_colours_are_tolerated_once_a_file() {
    let text = String::from_utf8(obj(&BOX.mesh(12).unwrap())).unwrap();
    let coloured: String = text
        .lines()
        .map(|l| {
            if l.starts_with('v') {
                format!("{l}D+00 0.5 0.5 1\n")
            } else {
                format!("{l}\n")
            }
        })
        .collect();
    let read = parse(coloured.as_bytes(), MeshFormat::Obj).unwrap();
    assert_eq!(read.notices.len(), 2, "{:?}", read.notices);
    assert!((read.body().unwrap().volume() - 1.0).abs() < 1e-12);
}

#[test]
fn concave_faces_have_the_volume_of_the_prism() {
    let outline = [[3, 1], [1, 1], [1, 3], [0, 3], [0, 0], [3, 0]];
    let mut text = String::new();
    for z in [0, 1] {
        for [x, y] in outline {
            text += &format!("v {x} {y} {z}\n");
        }
    }
    text += "f 6 5 4 3 2 1\nf 7 8 9 10 11 12\n";
    for i in 1..=6 {
        let j = i % 6 + 1;
        text += &format!("f {i} {j} {} {}\n", j + 6, i + 6);
    }
    let read = parse(text.as_bytes(), MeshFormat::Obj).unwrap();
    assert!(read.notices.is_empty());
    let body = read.body().unwrap();
    assert!((body.volume() - 5.0).abs() < 1e-12);
    // Two L of area 5 and a rim 12 long: a fan of the L would have more.
    assert!((body.surface_area() - 22.0).abs() < 1e-12);
}

#[test]
fn ply_reads_every_type_and_strips() {
    let header = |list: &str, faces: usize| {
        format!(
            "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\nproperty double y\nproperty double z\n\
             element {list}\nend_header\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n{}",
            ["4 0 2 1 3\n", "3 0 2 1\n3 0 1 3\n3 1 2 3\n3 2 0 3\n"][faces]
        )
    };
    for list in [
        "face 4\nproperty list int64 uint64 vertex_indices",
        "face 4\nproperty list double double vertex_index",
        "face 4\nproperty list uint8 int64 vertex_indices",
    ] {
        let read = parse(header(list, 1).as_bytes(), MeshFormat::Ply).unwrap();
        assert!((read.body().unwrap().volume() - 1.0 / 6.0).abs() < 1e-15);
    }
    // Two strips; corners that repeat join parts of the second.
    let strips = header("tristrips 1\nproperty list int int vertex_indices", 0);
    let strips = strips.replace("4 0 2 1 3\n", "11 0 2 1 3 -1 1 2 3 0 0 -1\n");
    let read = parse(strips.as_bytes(), MeshFormat::Ply).unwrap();
    assert_eq!(read.triangles, [[0, 2, 1], [1, 2, 3], [1, 2, 3], [3, 2, 0]]);
    let error = error(&strips.replace("-1 1", "-2 1"), MeshFormat::Ply);
    assert!(
        error.contains("line 14: a vertex number is negative"),
        "{error}"
    );
}

#[test]
fn ply_that_could_be_read_in_two_ways_is_refused() {
    let header = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\n\
                  property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n\
                  0 0 0\n1 0 0\n1 1 0\n";
    let read = |values: &str| parse(format!("{header}{values}").as_bytes(), MeshFormat::Ply);
    // A value too many before the triangle 0 1 2, or the face 3 0 1 2.
    let error = read("0 1 0 4\n3 0 1 2\n").unwrap_err().to_string();
    assert!(
        error.contains("line 9") && error.contains("two ways"),
        "{error}"
    );
    for (values, triangles, notices) in [
        ("0 1 0 9\n3 0 1 2\n", 1, 1),
        ("0 1 0\n4\n3 0 1 2\n", 2, 1),
        ("0 1 0\n3 0 1 2 255\n", 1, 1),
        ("0 1 0\n3 0 1 2\n255\n", 1, 1),
        ("0 1 0\n3 0 1 2\n", 1, 0),
    ] {
        let read = read(values).unwrap();
        assert_eq!(
            (read.triangles.len(), read.notices.len()),
            (triangles, notices),
            "{values}"
        );
    }
    for values in ["0 1\n0 3 0 1 2 255\n", "0 1 0\n3 0 1\n"] {
        assert!(read(values).is_err(), "{values}");
    }
}

#[test]
fn binary_ply_after_a_header_with_carriage_returns() {
    let body = BOX.mesh(12).unwrap();
    for (ending, kind) in [("\r", PlyKind::Little), ("\r\n", PlyKind::Big)] {
        let good = ply(&body, kind);
        let end = good.windows(11).position(|w| w == b"end_header\n").unwrap() + 11;
        let header = String::from_utf8(good[..end].to_vec()).unwrap();
        // The first byte of the body is one that could end a line.
        let mut bytes = header.replace('\n', ending).into_bytes();
        let start = bytes.len();
        bytes.extend(&good[end..]);
        bytes[start] = b'\n';
        assert_eq!(MeshFormat::of_content(&bytes), Some(MeshFormat::Ply));
        assert!(parse(&bytes, MeshFormat::Ply).unwrap().body().is_ok());
    }
}

#[test]
fn binary_stl_with_a_header_that_is_wrong() {
    let body = BOX.mesh(12).unwrap();
    let good = stl_binary(&body);
    for count in [0, u32::MAX] {
        let mut bytes = good.clone();
        bytes[..6].copy_from_slice(b"solid ");
        bytes[80..84].copy_from_slice(&count.to_le_bytes());
        assert_eq!(MeshFormat::of_content(&bytes), Some(MeshFormat::Stl));
        let read = parse(&bytes, MeshFormat::Stl).unwrap();
        assert!(read.notices[0].contains("took the 12 that are there"));
        assert!((read.body().unwrap().volume() - 1.0).abs() < 1e-6);
        bytes.extend(b"notes");
        assert!(parse(&bytes, MeshFormat::Stl).is_err());
    }
    let mut bytes = good;
    bytes.extend(b"notes");
    assert_eq!(MeshFormat::of_content(&bytes), Some(MeshFormat::Stl));
    let read = parse(&bytes, MeshFormat::Stl).unwrap();
    assert_eq!(
        read.notices,
        ["passed over 5 bytes after the last of its 12 facets"]
    );
}

/// Each corner of each facet is off by a unit in the last place of single precision.
#[test]
fn seams_that_rounding_left_open_are_closed() {
    let body = BOX.mesh(100).unwrap();
    let mut bytes = stl_binary(&body);
    let mut word = 12345u32;
    for facet in bytes[84..].chunks_exact_mut(50) {
        for x in facet[12..48].as_chunks_mut::<4>().0 {
            word = word.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            let off = (word >> 30) % 3;
            let bits = u32::from_le_bytes(*x);
            if bits & 0x7fff_ffff != 0 {
                *x = (bits + off).to_le_bytes();
            }
        }
    }
    let read = parse(&bytes, MeshFormat::Stl).unwrap();
    assert!(
        read.notices[0].contains("to close open edges"),
        "{:?}",
        read.notices
    );
    let closed = read.body().unwrap();
    assert_eq!(closed.triangles().len(), body.triangles().len());
    assert!((closed.volume() - 1.0).abs() < 1e-5);
}

#[test]
fn sheets_and_small_triangles_are_not_welded() {
    // A flap much smaller than the tolerance: welding would leave it without area.
    let flap = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1e-7 0\nv 1 0 1e-7\nf 1 2 3\nf 2 4 5\n";
    let read = parse(flap.as_bytes(), MeshFormat::Obj).unwrap();
    assert_eq!((read.vertices.len(), read.notices.len()), (5, 0));
    let sheet = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1 0\nf 1 2 3\nf 2 4 3\n";
    let read = parse(sheet.as_bytes(), MeshFormat::Obj).unwrap();
    assert_eq!((read.vertices.len(), read.notices.len()), (4, 0));
}
