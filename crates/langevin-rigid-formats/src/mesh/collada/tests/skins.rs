//! Controllers.

use super::*;

/// A file that shows a controller of the box in a node that is elsewhere.
fn controlled(controllers: &str, nodes: &str, skeleton: &str) -> String {
    scene(&format!(
        r##"{nodes}<node><translate>100 0 0</translate><instance_controller url="#c">{skeleton}
        </instance_controller></node>"##
    ))
    .replace(
        "<library_visual_scenes>",
        &format!("<library_controllers>{controllers}</library_controllers><library_visual_scenes>"),
    )
}

fn morph(method: &str, weights: &str, id: &str) -> String {
    format!(
        r##"<controller id="{id}"><morph source="#box" method="{method}"><source id="t"><IDREF_array id="t-array" count="1">
        box2</IDREF_array><technique_common><accessor source="#t-array" count="1"><param name="T"/></accessor>
        </technique_common></source>{}<targets><input semantic="MORPH_TARGET" source="#t"/>
        <input semantic="MORPH_WEIGHT" source="#w"/></targets></morph></controller>"##,
        source("w", weights, "W")
    )
}

/// The target is the box with its far end at 4 in place of 2.
fn with_target(file: &str) -> String {
    let target = geometry("box2", &polylist("box2")).replace(CORNERS, &CORNERS.replace('2', "4"));
    file.replace(
        "</library_geometries>",
        &format!("{target}</library_geometries>"),
    )
}

#[test]
fn morphs_are_weighted() {
    let normalized = with_target(&controlled(&morph("NORMALIZED", "0.25", "c"), "", ""));
    assert!(fills(
        &body(&normalized),
        [100.0, 0.0, 0.0],
        [102.5, 1.0, 0.5]
    ));
    let relative = with_target(&controlled(&morph("RELATIVE", "1", "c"), "", ""));
    assert!(fills(
        &body(&relative),
        [100.0, 0.0, 0.0],
        [106.0, 2.0, 1.0]
    ));
    let fewer = normalized
        .replace(">0.25<", ">0.25 1<")
        .replace("count=\"1\" stride", "count=\"2\" stride");
    assert!(read(&fewer).is_err());
}

/// Two joints, the second of which has moved up by 3; the far end of the box follows it.
fn skin(source_id: &str, joints: &str) -> String {
    let identity = "1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1";
    let matrices = format!("{identity} {identity}");
    let inverse = source("m", &matrices, "M")
        .replace("count=\"32\" stride=\"1\"", "count=\"2\" stride=\"16\"")
        .replace("type=\"float\"", "type=\"float4x4\"");
    format!(
        r##"<controller id="c"><skin source="#{source_id}"><bind_shape_matrix>1 0 0 10 0 1 0 0 0 0 1 0 0 0 0 1
        </bind_shape_matrix><source id="j">{joints}<technique_common><accessor source="#j-array" count="2">
        <param name="J"/></accessor></technique_common></source>{inverse}{}
        <joints><input semantic="JOINT" source="#j"/><input semantic="INV_BIND_MATRIX" source="#m"/></joints>
        <vertex_weights count="8"><input semantic="JOINT" source="#j" offset="0"/>
        <input semantic="WEIGHT" source="#sw" offset="1"/><vcount>1 1 1 1 1 1 1 1</vcount>
        <v>0 0 1 0 1 0 0 0 0 0 1 0 1 0 -1 0</v></vertex_weights></skin></controller>"##,
        source("sw", "0.5", "W")
    )
}

const BONES: &str = r#"<node id="root"><translate>0 0 7</translate><node id="id-a" sid="a"/>
    <node id="id-b" sid="b"><translate>0 0 3</translate></node></node>"#;
const SKELETON: &str = "<skeleton>#root</skeleton>";

#[test]
fn skins_follow_their_joints_and_not_their_node() {
    let names = r#"<Name_array id="j-array" count="2">a b</Name_array>"#;
    let ids = r#"<IDREF_array id="j-array" count="2">id-a id-b</IDREF_array>"#;
    for (joints, skeleton) in [(names, SKELETON), (names, ""), (ids, SKELETON), (ids, "")] {
        let file = controlled(&skin("box", joints), BONES, skeleton);
        let mesh = read(&file).unwrap();
        let expected = [
            [10.0, 0.0, 7.0],
            [12.0, 0.0, 10.0],
            [12.0, 1.0, 10.0],
            [10.0, 1.0, 7.0],
            [10.0, 0.0, 7.5],
            [12.0, 0.0, 10.5],
            [12.0, 1.0, 10.5],
            // A joint of -1 is the bind shape.
            [10.0, 1.0, 0.5],
        ];
        assert_eq!(mesh.vertices, expected);
    }
    let good = controlled(&skin("box", names), BONES, SKELETON);
    for (from, to, expected) in [
        (">a b<", ">a c<", "no node with the sid `c`"),
        ("<v>0 0", "<v>2 0", "follows a joint that there is not"),
        ("<v>0 0", "<v>0 1", "has no weight"),
        ("<vcount>1 1", "<vcount>1 2", "not as many joints"),
        ("<vcount>1 1", "<vcount>2", "has no weights"),
        (">0.5<", ">0<", "follows no joint"),
        ("#root", "#elsewhere", "no node with the id `elsewhere`"),
    ] {
        assert!(good.contains(from), "{from}");
        let error = fault(&good.replacen(from, to, 1));
        assert!(error.contains(expected), "{from} -> {to}: {error}");
    }
}

#[test]
fn skins_of_morphs_are_read() {
    let names = r#"<Name_array id="j-array" count="2">a a</Name_array>"#;
    let controllers =
        morph("NORMALIZED", "0.5", "m1") + &skin("m1", names).replace("-1 0</v>", "0 0</v>");
    let file = with_target(&controlled(&controllers, BONES, SKELETON));
    assert!(fills(&body(&file), [10.0, 0.0, 7.0], [13.0, 1.0, 7.5]));
}

#[test]
fn controllers_shown_over_and_over_are_counted() {
    let names = r#"<Name_array id="j-array" count="2">a b</Name_array>"#;
    let mut file = controlled(&skin("box", names), BONES, SKELETON);
    let padding = format!("<extra>{}</extra></skin>", " ".repeat(1 << 20));
    file = file.replace("</skin>", &padding);
    let more = r##"<node><instance_controller url="#c"/>"##.to_owned() + "</node>";
    file = file.replace(
        "</visual_scene>",
        &format!("{}</visual_scene>", more.repeat(1000)),
    );
    assert!(fault(&file).contains("more than"));
}
