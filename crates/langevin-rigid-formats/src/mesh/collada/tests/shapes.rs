//! Kinds of primitives.

use super::*;

/// The box drawn by primitives, shown without a scene.
fn drawn(primitives: &str) -> String {
    let geometries = geometry("box", primitives);
    file(&format!(
        "<library_geometries>{geometries}</library_geometries>"
    ))
}

fn primitive(kind: &str, count: usize, lists: &str) -> String {
    format!(
        r##"<{kind} count="{count}"><input semantic="VERTEX" source="#box-vertices" offset="0"/>{lists}</{kind}>"##
    )
}

fn list(corners: &[u32]) -> String {
    let corners: Vec<String> = corners.iter().map(u32::to_string).collect();
    format!("<p>{}</p>", corners.join(" "))
}

fn fills_box(primitives: &str) -> bool {
    fills(&body(&drawn(primitives)), [0.0; 3], [2.0, 1.0, 0.5])
}

#[test]
fn every_primitive_makes_the_same_box() {
    let each = |make: fn([u32; 4]) -> Vec<u32>| -> String {
        SIDES.iter().map(|&side| list(&make(side))).collect()
    };
    let triangles: Vec<u32> = SIDES
        .iter()
        .flat_map(|&[a, b, c, d]| [a, b, c, a, c, d])
        .collect();
    let (first, rest) = triangles.split_at(9);
    let strips = each(|[a, b, c, d]| vec![a, b, d, c]);
    let joined = each(|[a, b, c, d]| vec![a, a, a, b, d, c, c]);
    for primitives in [
        polylist("box"),
        primitive("triangles", 12, &list(&triangles)),
        primitive("triangles", 3, &list(first)) + &primitive("triangles", 9, &list(rest)),
        primitive("polygons", 6, &each(|side| side.to_vec())),
        primitive("trifans", 6, &each(|side| side.to_vec())),
        primitive("tristrips", 6, &strips),
        primitive("tristrips", 6, &joined),
        primitive("triangles", 0, "") + &polylist("box"),
    ] {
        assert!(fills_box(&primitives), "{primitives}");
    }
    assert!(
        fault(&drawn(&primitive("triangles", 1, &list(&[0, 1])))).contains("multiple of three")
    );
    assert!(fault(&drawn(&primitive("triangles", 1, ""))).contains("says 1 and has none"));
}

#[test]
fn holes_of_polygons_go_through() {
    // A square plate of 3 x 3 x 0.5 with a square hole of 1 in its middle.
    let rings = "0 0 0  3 0 0  3 3 0  0 3 0   1 1 0  2 1 0  2 2 0  1 2 0 \
                 0 0 .5  3 0 .5  3 3 .5  0 3 .5   1 1 .5  2 1 .5  2 2 .5  1 2 .5";
    let top = "<ph><p>8 9 10 11</p><h>12 13 14 15</h></ph>";
    let bottom = "<ph><p>3 2 1 0</p><h>4 5 6 7</h></ph>";
    let mut walls = String::new();
    for k in 0..4_u32 {
        let next = (k + 1) % 4;
        walls += &list(&[k, next, 8 + next, 8 + k]);
        walls += &list(&[4 + next, 4 + k, 12 + k, 12 + next]);
    }
    let plate = drawn(&primitive("polygons", 10, &format!("{top}{bottom}{walls}")))
        .replace(CORNERS, rings)
        .replace("count=\"24\"", "count=\"48\"")
        .replace("count=\"8\" stride", "count=\"16\" stride");
    let plate = body(&plate);
    assert!((plate.volume() - 4.0).abs() < 1e-12, "{}", plate.volume());
}

#[test]
fn what_has_no_surface_is_passed_over_with_a_note() {
    let lines = primitive("lines", 1, &list(&[0, 1])) + &primitive("linestrips", 1, &list(&[0, 1]));
    let mesh = read(&drawn(&(lines.clone() + &polylist("box")))).unwrap();
    assert!(
        mesh.notices
            .contains(&"the lines in it were passed over: they enclose nothing".to_owned())
    );
    assert_eq!(mesh.notices.len(), 2, "{:?}", mesh.notices);
    assert!(matches!(read(&drawn(&lines)), Err(ParseError::NoTriangles)));
    let spline = drawn(&polylist("box")).replace(
        "<library_geometries>",
        "<library_geometries><geometry id=\"c\"><spline/></geometry>",
    );
    assert!(
        read(&spline)
            .unwrap()
            .notices
            .iter()
            .any(|n| n.contains("curves and exact surfaces"))
    );
}

#[test]
fn accessors_stride_skip_and_begin_anywhere() {
    let good = drawn(&polylist("box"));
    let spread: String = CORNERS
        .split_whitespace()
        .collect::<Vec<_>>()
        .chunks(3)
        .map(|c| format!("9 {} {} 8 {} ", c[0], c[1], c[2]))
        .collect();
    let file = good
        .replace(CORNERS, &format!("5 5 {spread}"))
        .replace("count=\"24\"", "count=\"42\"")
        .replace("stride=\"3\"", "stride=\"5\" offset=\"2\"")
        .replace(
            r#"<param name="X""#,
            r#"<param type="float"/><param name="X""#,
        )
        .replace(
            r#"<param name="Z""#,
            r#"<param type="float"/><param name="Z""#,
        );
    assert!(fills(&body(&file), [0.0; 3], [2.0, 1.0, 0.5]));
    let unnamed: String = good
        .split("<param")
        .enumerate()
        .map(|(k, part)| match k {
            0 => part.to_owned(),
            _ => part.split_once("/>").unwrap().1.to_owned(),
        })
        .collect();
    assert!(fills(&body(&unnamed), [0.0; 3], [2.0, 1.0, 0.5]));
    let flat = good.replace(r#"<param name="Z" type="float"/>"#, "");
    assert!(fault(&flat).contains("fewer than 3 with a name"));
    // Places that no face uses may be none.
    let more = good
        .replace(CORNERS, &format!("{CORNERS} nan inf 0"))
        .replace("count=\"24\"", "count=\"27\"")
        .replace("count=\"8\" stride", "count=\"9\" stride");
    assert!(fills(&body(&more), [0.0; 3], [2.0, 1.0, 0.5]));
}
