use super::*;

/// A sphere of unit volume away from the origin, in water: half the displaced mass, and nothing turns it.
fn sphere() -> Report {
    let mass = |i: usize, j: usize| if i == j && i < 3 { 500.0 } else { 0.0 };
    Report {
        mesh: "a--b\n.stl".into(),
        triangles: 320,
        triangles_solved: 320,
        volume: 1.0,
        centroid: [2.0, 3.0, -1.0],
        fluid_density: 1000.0,
        reference: [2.0, 3.0, -1.0],
        added_mass: std::array::from_fn(|i| std::array::from_fn(|j| mass(i, j))),
        error_estimate: 0.001,
        proxy: None,
        warnings: Vec::new(),
        seconds: 0.5,
    }
}

/// All numbers of a text, in order.
fn numbers(text: &str) -> Vec<f64> {
    let words = text.split(|c: char| !(c.is_ascii_alphanumeric() || "+-.".contains(c)));
    words.filter_map(|word| word.parse().ok()).collect()
}

/// The text without its XML comment, which must be well formed.
fn body(xml: &str) -> &str {
    let (comment, body) = xml.strip_prefix("<!--").unwrap().split_once("-->").unwrap();
    assert!(!comment.contains("--") && !body.contains("<!--"));
    body
}

fn entry(sdf: &str, name: &str) -> f64 {
    let inside = sdf.split_once(&format!("<{name}>")).unwrap().1;
    inside
        .split_once(&format!("</{name}>"))
        .unwrap()
        .0
        .parse()
        .unwrap()
}

/// About the origin a turn carries the sphere along: 500 kg at the distance from the axis.
#[test]
fn sdf_is_about_the_origin_of_the_link() {
    let text = sdf(&sphere());
    let sdf = body(&text);
    let all = numbers(sdf);
    assert_eq!(all.len(), 21);
    let expected = [
        ("xx", 500.0),
        ("xy", 0.0),
        ("pp", 500.0 * (9.0 + 1.0)),
        ("qq", 500.0 * (4.0 + 1.0)),
        ("rr", 500.0 * (4.0 + 9.0)),
        ("pq", -500.0 * 2.0 * 3.0),
        ("xr", -500.0 * 3.0),
        ("yr", 500.0 * 2.0),
        ("zp", 500.0 * 3.0),
    ];
    for (name, value) in expected {
        assert!((entry(sdf, name) - value).abs() < 1e-6, "{name}");
    }
    // What it is about does not depend on what the report was about.
    assert_eq!(super::sdf(&sphere().about([0.0; 3])), text);
    assert!(text.contains("<xDotU>-5.0") && text.contains("origin of the mesh"));
}

/// The plugin computes S A' S x with S = diag(1, -1, -1, 1, -1, -1): that must be A x.
#[test]
fn uuv_cancels_the_turn_of_the_plugin() {
    let text = uuv(&sphere());
    let matrix = numbers(body(&text));
    assert_eq!(matrix.len(), 36);
    let about_origin = sphere().about([0.0; 3]).added_mass;
    let sign = |i: usize| if i == 0 || i == 3 { 1.0 } else { -1.0 };
    for (n, value) in matrix.iter().enumerate() {
        let (i, j) = (n / 6, n % 6);
        assert!((sign(i) * sign(j) * value - about_origin[i][j]).abs() < 1e-6);
        assert_eq!(*value, matrix[6 * j + i]);
    }
    assert!(!text.contains("-0.0"));
}

#[test]
fn csv_has_comments_a_header_and_six_rows() {
    let text = csv(&sphere());
    let rows: Vec<&str> = text
        .lines()
        .skip_while(|line| line.starts_with('#'))
        .collect();
    assert_eq!(rows.len(), 7);
    assert!(rows[1..].iter().all(|row| row.split(',').count() == 6));
    assert_eq!(numbers(rows[3])[2], 500.0);
}

#[test]
fn mujoco_is_per_unit_density_about_the_centroid() {
    let text = mujoco(&sphere().about([0.0; 3]));
    let (_, matrix) = text.split_once("ADDED_MASS = np.array(").unwrap();
    let matrix = numbers(matrix.split_once("])\n").unwrap().0);
    for (n, value) in matrix.iter().enumerate() {
        let expected = if n % 7 == 0 && n < 18 { 0.5 } else { 0.0 };
        assert!((value - expected).abs() < 1e-12, "{n}: {value}");
    }
    assert!(text.contains("about CENTROID: 0.0e0"), "{text}");
}

#[test]
fn every_format_states_its_conventions() {
    let report = sphere();
    let texts = [
        table(&report),
        json(&report).unwrap(),
        csv(&report),
        sdf(&report),
        uuv(&report),
        mujoco(&report),
        capytaine(&report),
    ];
    let stated = [
        ["1000 kg/m^3, unbounded", "per unit density"],
        ["those of the mesh", "x of the mesh"],
        ["the centroid of the volume", "the origin of the mesh"],
        ["then rotation about", "linear first"],
        ["positive", "positive"],
    ];
    for text in &texts {
        for words in stated {
            let found = words.iter().any(|word| text.contains(word));
            assert!(found, "{words:?} are not in: {text}");
        }
    }
    // A hostile name stays inside its comment.
    assert!(texts[2].starts_with("# Added mass of a- -b .stl,"));
}
