//! Each file is put together here, around a box of 2 x 1 x 0.5.

use super::super::{LengthUnit, MeshFormat, ParseError, RawMesh, parse_mesh};
use langevin_rigid_bake::mesh::TriMesh;

mod damaged;
mod scenes;
mod shapes;
mod skins;

pub(super) const CORNERS: &str = "0 0 0  2 0 0  2 1 0  0 1 0  0 0 .5  2 0 .5  2 1 .5  0 1 .5";
/// Its sides as quadrangles that wind outward.
pub(super) const SIDES: [[u32; 4]; 6] = [
    [3, 2, 1, 0],
    [4, 5, 6, 7],
    [0, 1, 5, 4],
    [1, 2, 6, 5],
    [2, 3, 7, 6],
    [3, 0, 4, 7],
];

pub(super) fn read(file: &str) -> Result<RawMesh, ParseError> {
    parse_mesh(file.as_bytes(), MeshFormat::Collada, None, None)
}

#[track_caller]
pub(super) fn body(file: &str) -> TriMesh {
    read(file).unwrap().body().unwrap()
}

#[track_caller]
pub(super) fn fault(file: &str) -> String {
    read(file).unwrap_err().to_string()
}

/// Whether the body fills a box of these corners: it has its volume and is nowhere outside.
pub(super) fn fills(body: &TriMesh, low: [f64; 3], high: [f64; 3]) -> bool {
    let volume: f64 = (0..3).map(|k| high[k] - low[k]).product();
    let bounds = body.bounding_box();
    let near = |a: f64, b: f64| (a - b).abs() < 1e-12;
    (body.volume() / volume - 1.0).abs() < 1e-12
        && (0..3).all(|k| near(bounds[0][k], low[k]) && near(bounds[1][k], high[k]))
}

/// A source of vectors.
pub(super) fn source(id: &str, numbers: &str, names: &str) -> String {
    let count = numbers.split_whitespace().count();
    let width = names.len();
    let params: String = names
        .chars()
        .map(|name| format!(r#"<param name="{name}" type="float"/>"#))
        .collect();
    format!(
        r##"<source id="{id}"><float_array id="{id}-array" count="{count}">{numbers}</float_array>
        <technique_common><accessor source="#{id}-array" count="{}" stride="{width}">{params}</accessor>
        </technique_common></source>"##,
        count / width
    )
}

/// A geometry of the box's corners and some primitives.
pub(super) fn geometry(id: &str, primitives: &str) -> String {
    format!(
        r##"<geometry id="{id}"><mesh>{}<vertices id="{id}-vertices"><input semantic="POSITION"
        source="#{id}-positions"/></vertices>{primitives}</mesh></geometry>"##,
        source(&format!("{id}-positions"), CORNERS, "XYZ")
    )
}

/// The box as a polylist whose corners have a normal before their vertex.
pub(super) fn polylist(id: &str) -> String {
    let corners = SIDES.as_flattened().iter();
    let p: String = corners.map(|v| format!("7 {v} ")).collect();
    format!(
        r##"<polylist count="6"><input semantic="NORMAL" source="#none" offset="0"/>
        <input semantic="VERTEX" source="#{id}-vertices" offset="1"/><vcount>4 4 4 4 4 4</vcount>
        <p>{p}</p></polylist>"##
    )
}

/// A file in metres.
pub(super) fn file(content: &str) -> String {
    format!(
        r#"<?xml version="1.0" encoding="utf-8"?>
<COLLADA xmlns="http://www.collada.org/2005/11/COLLADASchema" version="1.4.1">
<asset><unit name="meter" meter="1"/><up_axis>Z_UP</up_axis></asset>
{content}</COLLADA>"#
    )
}

/// A file whose scene has some nodes, with the box as geometry `box`.
pub(super) fn scene(nodes: &str) -> String {
    file(&format!(
        r##"<library_geometries>{}</library_geometries>
        <library_visual_scenes><visual_scene id="s">{nodes}</visual_scene></library_visual_scenes>
        <scene><instance_visual_scene url="#s"/></scene>"##,
        geometry("box", &polylist("box"))
    ))
}

pub(super) const SHOWN: &str = r##"<instance_geometry url="#box"/>"##;

#[test]
fn the_unit_is_the_file_s_unless_another_is_given() {
    let metres = scene(&format!("<node>{SHOWN}</node>"));
    let statement = r#"<unit name="meter" meter="1"/>"#;
    for (unit, size) in [
        (r#"<unit meter="0.01"/>"#, 0.02),
        (r#"<unit name="centimeter" meter="0.001000"/>"#, 0.002),
        (r#"<unit meter="0.0254"/>"#, 0.0508),
        (r#"<unit meter="2.5e-1"/>"#, 0.5),
        (r#"<unit meter="25D-2"/>"#, 0.5),
    ] {
        let file = metres.replace(statement, unit);
        let mesh = read(&file).unwrap();
        assert_eq!(mesh.vertices[1], [size, 0.0, 0.0], "{unit}");
    }
    let inches = metres.replace(statement, r#"<unit meter="0.0254"/>"#);
    let given =
        |unit| parse_mesh(inches.as_bytes(), MeshFormat::Collada, Some(unit), None).unwrap();
    assert_eq!(given(LengthUnit::In).notices, [""; 0]);
    let given = given(LengthUnit::Cm);
    assert_eq!(given.vertices[1], [0.02, 0.0, 0.0]);
    assert_eq!(
        given.notices,
        ["its lengths were taken to be in cm in place of in"]
    );
    let none = read(&metres.replace(statement, "")).unwrap();
    assert_eq!(none.vertices[1], [2.0, 0.0, 0.0]);
    assert!(none.notices[0].contains("states no unit"));
    for bad in ["0", "-1", "nan", "1e999", "1,5", ""] {
        let file = metres.replace(r#"meter="1""#, &format!(r#"meter="{bad}""#));
        assert!(fault(&file).contains("in `unit`"), "{bad}");
    }
}

#[test]
fn axes_stay_as_they_are() {
    let file = scene(&format!("<node>{SHOWN}</node>"));
    for up in ["X_UP", "Y_UP", "Z_UP"] {
        let turned = read(&file.replace("Z_UP", up)).unwrap();
        assert_eq!(turned, read(&file).unwrap());
    }
}

#[test]
fn other_encodings_prefixes_and_comments_are_read() {
    let plain = scene(&format!("<node>{SHOWN}</node>"));
    let expected = read(&plain).unwrap();
    let utf16: Vec<u8> = std::iter::once(0xfeff)
        .chain(plain.encode_utf16())
        .flat_map(u16::to_le_bytes)
        .collect();
    assert_eq!(MeshFormat::of_content(&utf16), Some(MeshFormat::Collada));
    let decoded = parse_mesh(&utf16, MeshFormat::Collada, None, None).unwrap();
    assert_eq!(decoded.vertices, expected.vertices);
    assert!(decoded.notices[0].contains("UTF-16"));
    let prefixed = plain
        .replace("xmlns=", "xmlns:c=")
        .replace('<', "<c:")
        .replace("<c:/", "</c:")
        .replace("<c:?", "<?");
    assert_eq!(
        MeshFormat::of_content(prefixed.as_bytes()),
        Some(MeshFormat::Collada)
    );
    assert_eq!(read(&prefixed).unwrap(), expected);
    let commented = plain.replace("2 0 0", "2 <!-- 5 --> 0 <![CDATA[0 ]]>");
    assert_eq!(read(&commented).unwrap(), expected);
}

#[test]
fn what_is_not_read_is_refused_by_its_name() {
    let good = scene(&format!("<node>{SHOWN}</node>"));
    for (from, to, expected) in [
        ("1.4.1", "1.3.0", "version 1.3.0 of Collada"),
        (
            "#box\"",
            "other.dae#box\"",
            "`other.dae#box`, which is in another file",
        ),
        ("#box\"", "#sphere\"", "no geometry with the id `sphere`"),
        (
            "url=\"#box\"",
            "",
            "in `instance_geometry`: it has no attribute `url`",
        ),
        (
            "<node>",
            "<node><lookat>0 0 0 1 1 1 0 0 1</lookat>",
            "placed by `lookat`",
        ),
        ("<COLLADA", "<!DOCTYPE COLLADA><COLLADA", "a document type"),
        (
            "<COLLADA",
            "<!DOCTYPE l [<!ENTITY a \"aaaa\"><!ENTITY b \"&a;&a;&a;\">]><COLLADA",
            "a document type",
        ),
        ("0 0 0  2", "&lol; 0 0  2", "unknown entity"),
        (
            "0 0 0  2",
            "0 0 0 9 2",
            "it says 24 numbers or names and has 25",
        ),
        ("0 0 0  2", "inf 0 0  2", "coordinate that is not a number"),
        (
            "0 0 0  2",
            "x 0 0  2",
            "line 4: in `float_array`: `x` is not a number",
        ),
        (
            "count=\"8\" stride",
            "count=\"9\" stride",
            "reaches beyond the 24 numbers",
        ),
        ("stride=\"3\"", "stride=\"0\"", "reaches beyond"),
        ("stride=\"3\"", "stride=\"2\"", "reaches beyond"),
        ("7 3 7 2", "7 8 7 2", "a face has vertex 8, there are 8"),
        ("7 3 7 2", "7 3 7 -2", "`-2` is not a number of a vertex"),
        ("7 3 7 2", "7 3 7 2 7", "no multiple of 2 a corner"),
        ("7 3 7 2", "7 3 7 2 7 0", "not as many corners"),
        ("<vcount>4", "<vcount>3", "not as many corners"),
        (
            "<vcount>4",
            "<vcount>18446744073709551615",
            "not as many corners",
        ),
        (
            "polylist count=\"6\"",
            "polylist count=\"7\"",
            "it says 7 faces and has 6",
        ),
        ("offset=\"1\"", "", "it has no attribute `offset`"),
        (
            "offset=\"1\"",
            "offset=\"18446744073709551615\"",
            "no multiple of",
        ),
        (
            "#box-vertices",
            "#other",
            "its source is not the `vertices` of its mesh",
        ),
        ("\"VERTEX\"", "\"VORTEX\"", "it has no input VERTEX"),
        ("\"POSITION\"", "\"TEXCOORD\"", "it has no input POSITION"),
        ("id=\"s\"", "id=\"t\"", "no visual_scene with the id `s`"),
    ] {
        assert!(good.contains(from), "{from}");
        let error = fault(&good.replacen(from, to, 1));
        assert!(error.contains(expected), "{from} -> {to}: {error}");
    }
    let twice = good.replacen("<geometry", "<geometry id=\"box\"/><geometry", 1);
    assert!(fault(&twice).contains("several with the id `box`"));
    assert!(matches!(read(&file("")), Err(ParseError::NoTriangles)));
    assert!(fault("<html/>").contains("this XML is not Collada"));
}
