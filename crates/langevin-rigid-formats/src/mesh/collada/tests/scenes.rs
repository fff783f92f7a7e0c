//! Nodes, instances and what bounds them.

use super::*;
use std::time::Instant;

fn placed(transformations: &str) -> TriMesh {
    body(&scene(&format!("<node>{transformations}{SHOWN}</node>")))
}

#[test]
fn transformations_apply_in_their_order() {
    for (transformations, low, high) in [
        (
            "<translate>1 2 3</translate>",
            [1.0, 2.0, 3.0],
            [3.0, 3.0, 3.5],
        ),
        ("<scale>2 1 4</scale>", [0.0; 3], [4.0, 1.0, 2.0]),
        (
            "<rotate>0 0 2 90</rotate>",
            [-1.0, 0.0, 0.0],
            [0.0, 2.0, 0.5],
        ),
        ("<rotate>0 0 0 0</rotate>", [0.0; 3], [2.0, 1.0, 0.5]),
        (
            "<translate>1 0 0</translate><rotate>0 0 1 90</rotate>",
            [0.0, 0.0, 0.0],
            [1.0, 2.0, 0.5],
        ),
        (
            "<rotate>0 0 1 90</rotate><translate>1 0 0</translate>",
            [-1.0, 1.0, 0.0],
            [0.0, 3.0, 0.5],
        ),
        // Rows: x' = -y + 5, y' = x + 6, z' = z + 7.
        (
            "<matrix>0 -1 0 5 1 0 0 6 0 0 1 7 0 0 0 1</matrix>",
            [4.0, 6.0, 7.0],
            [5.0, 8.0, 7.5],
        ),
        // Mirrors are turned over, once or twice.
        ("<scale>-1 1 1</scale>", [-2.0, 0.0, 0.0], [0.0, 1.0, 0.5]),
        ("<scale>-1 -1 1</scale>", [-2.0, -1.0, 0.0], [0.0, 0.0, 0.5]),
    ] {
        let body = placed(transformations);
        assert!(
            fills(&body, low, high),
            "{transformations}: {:?}",
            body.bounding_box()
        );
        assert!(!body.was_turned(), "{transformations}");
    }
    // Y leans towards X by 45 degrees: the box becomes 3 long and keeps its volume.
    let body = placed("<skew>45 0 1 0 1 0 0</skew>");
    let [low, high] = body.bounding_box();
    assert!((high[0] - low[0] - 3.0).abs() < 1e-12 && (high[1] - 1.0).abs() < 1e-12);
    assert!((body.volume() - 1.0).abs() < 1e-12);
    for bad in [
        "<rotate>0 0 0 5</rotate>",
        "<scale>1 2</scale>",
        "<translate>0 0 inf</translate>",
    ] {
        assert!(
            read(&scene(&format!("<node>{bad}{SHOWN}</node>"))).is_err(),
            "{bad}"
        );
    }
}

#[test]
fn nodes_nest_and_are_instanced() {
    let nodes = format!(
        r##"<node><translate>0 10 0</translate><node><scale>-2 2 2</scale>{SHOWN}</node>
        <instance_node url="#twin"/></node>"##
    );
    let library = format!(
        r#"<library_nodes><node id="twin"><translate>5 0 0</translate>{SHOWN}<node><translate>5 0 0</translate>
        {SHOWN}</node></node></library_nodes><library_visual_scenes>"#
    );
    let body = body(&scene(&nodes).replace("<library_visual_scenes>", &library));
    assert_eq!(body.bounding_box(), [[-4.0, 10.0, 0.0], [12.0, 12.0, 1.0]]);
    assert!((body.volume() - 10.0).abs() < 1e-12);
    assert!(!body.was_turned());
}

#[test]
fn without_a_scene_everything_is_taken() {
    let named = scene(&format!("<node>{SHOWN}</node>"));
    let (head, tail) = named.split_once("<scene>").unwrap();
    let unnamed = head.to_owned() + tail.split_once("</scene>").unwrap().1;
    let mesh = read(&unnamed).unwrap();
    assert_eq!(mesh.triangles.len(), 12);
    assert!(mesh.notices[0].contains("names no scene"));
    let library = unnamed
        .replace("library_visual_scenes", "library_nodes")
        .replace(
            "<visual_scene id=\"s\">",
            "<node id=\"a\"><instance_node url=\"#b\"/></node><node id=\"b\">",
        )
        .replace("</visual_scene>", "</node>");
    let mesh = read(&library).unwrap();
    assert_eq!(mesh.triangles.len(), 12);
    assert!(mesh.notices[0].contains("all nodes of its library"));
}

#[test]
fn nodes_inside_themselves_are_refused() {
    let cycle = scene(r##"<node id="a"><node id="b"><instance_node url="#a"/></node></node>"##);
    assert!(fault(&cycle).contains("in `node`: it is inside itself"));
}

/// Small files may not stand for more triangles, nodes or work than their size accounts for.
#[test]
fn what_multiplies_is_counted_first() {
    let start = Instant::now();
    // Twenty levels of ten instances each of the next.
    let levels = |shown: &str| {
        let mut library = String::new();
        for level in 0..20 {
            let next = format!(r##"<instance_node url="#n{}"/>"##, level + 1);
            library += &format!(r#"<node id="n{level}">{}</node>"#, next.repeat(10));
        }
        library += &format!(r#"<node id="n20">{shown}</node>"#);
        let library = format!("<library_nodes>{library}</library_nodes><library_visual_scenes>");
        scene(r##"<node><instance_node url="#n0"/></node>"##)
            .replace("<library_visual_scenes>", &library)
    };
    for shown in [SHOWN, ""] {
        assert!(fault(&levels(shown)).contains("more than 1"));
    }
    let deep = format!(
        "{}{SHOWN}{}",
        "<node>".repeat(100_000),
        "</node>".repeat(100_000)
    );
    assert_eq!(read(&scene(&deep)).unwrap().triangles.len(), 12);
    let unclosed = scene(&"<node>".repeat(100_000));
    assert!(read(&unclosed).is_err());
    let attributes: String = (0..100_000).map(|k| format!(" a{k}='>'")).collect();
    let file = scene(&format!("<node{attributes}>{SHOWN}</node>"));
    assert!(fault(&file).contains("more than 1000 attributes"));
    let spaces: String = (0..20_000)
        .map(|k| format!("<a xmlns:n{k}='u{k}'>"))
        .collect();
    assert!(fault(&scene(&spaces)).contains("more than 1000 namespaces"));
    let seconds = start.elapsed().as_secs();
    assert!(seconds < 20, "{seconds} s");
}
