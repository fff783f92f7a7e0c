use super::*;
use proptest::prelude::*;

/// Area vector of each triangle, doubled.
fn doubled_areas(vertices: &[[f64; 3]], triangles: &[[u32; 3]]) -> Vec<[f64; 3]> {
    let of = |t: &[u32; 3]| {
        let [a, b, c] = t.map(|v| vertices[v as usize]);
        let (u, v) = (
            [0, 1, 2].map(|k| b[k] - a[k]),
            [0, 1, 2].map(|k| c[k] - a[k]),
        );
        [0, 1, 2].map(|k| u[(k + 1) % 3] * v[(k + 2) % 3] - u[(k + 2) % 3] * v[(k + 1) % 3])
    };
    triangles.iter().map(of).collect()
}

fn cut_one(vertices: &[[f64; 3]]) -> (Vec<[u32; 3]>, Option<String>) {
    let mut polygons = Polygons::default();
    polygons.push(0..vertices.len() as u32);
    polygons.triangles(vertices)
}

fn flat(points: &[[f64; 2]]) -> Vec<[f64; 3]> {
    points.iter().map(|p| [p[0], p[1], 0.0]).collect()
}

/// The area by the shoelace formula, doubled.
fn shoelace(points: &[[f64; 2]]) -> f64 {
    let next = |i: usize| points[(i + 1) % points.len()];
    let terms = points.iter().enumerate();
    terms
        .map(|(i, p)| p[0] * next(i)[1] - p[1] * next(i)[0])
        .sum()
}

#[track_caller]
fn covers(points: &[[f64; 2]]) {
    let vertices = flat(points);
    let (triangles, notice) = cut_one(&vertices);
    assert_eq!(notice, None);
    let areas = doubled_areas(&vertices, &triangles);
    assert!(areas.iter().all(|a| a[2] > 0.0), "all wind as the polygon");
    let sum: f64 = areas.iter().map(|a| a[2]).sum();
    assert!((sum / shoelace(points) - 1.0).abs() < 1e-12, "{sum}");
    // Each side is an edge of one triangle.
    let n = points.len() as u32;
    for i in 0..n {
        let side = [i, (i + 1) % n];
        let runs = triangles
            .iter()
            .flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]);
        assert_eq!(runs.filter(|run| *run == side).count(), 1, "side {i}");
    }
}

const L: [[f64; 2]; 6] = [
    [3.0, 1.0],
    [1.0, 1.0],
    [1.0, 3.0],
    [0.0, 3.0],
    [0.0, 0.0],
    [3.0, 0.0],
];

#[test]
fn concave_polygons_are_covered_from_every_corner() {
    for first in 0..L.len() {
        let mut points = L;
        points.rotate_left(first);
        covers(&points);
        let backwards: Vec<_> = points.iter().rev().copied().collect();
        let (triangles, _) = cut_one(&flat(&backwards));
        let areas = doubled_areas(&flat(&backwards), &triangles);
        assert!(areas.iter().all(|a| a[2] < 0.0));
        assert_eq!(areas.iter().map(|a| a[2]).sum::<f64>(), -10.0);
    }
}

#[test]
fn corners_on_straight_sides_stay() {
    covers(&[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]]);
    covers(&[
        [1.0, 0.0],
        [2.0, 0.0],
        [2.0, 2.0],
        [1.0, 2.0],
        [0.0, 2.0],
        [0.0, 1.0],
        [0.0, 0.0],
    ]);
}

#[test]
fn convex_polygons_are_fans() {
    let (triangles, _) = cut_one(&flat(&[
        [0.0, 0.0],
        [1.0, 0.0],
        [1.5, 1.0],
        [0.5, 2.0],
        [-0.5, 1.0],
    ]));
    assert_eq!(triangles, [[0, 1, 2], [0, 2, 3], [0, 3, 4]]);
}

#[test]
fn a_hole_by_way_of_a_bridge_stays_open() {
    // A square of 3 with a square hole of 1; the bridge is run both ways.
    let points = [
        [0.0, 0.0],
        [3.0, 0.0],
        [3.0, 3.0],
        [0.0, 3.0],
        [0.0, 0.0],
        [1.0, 1.0],
        [1.0, 2.0],
        [2.0, 2.0],
        [2.0, 1.0],
        [1.0, 1.0],
    ];
    let vertices = flat(&points);
    let (triangles, notice) = cut_one(&vertices);
    assert_eq!(notice, None);
    let areas = doubled_areas(&vertices, &triangles);
    assert_eq!(areas.iter().map(|a| a[2]).sum::<f64>(), 16.0);
}

#[test]
fn holes_stay_open_whichever_way_they_run() {
    let square =
        |[x, y]: [f64; 2], side: f64| [[x, y], [x + side, y], [x + side, y + side], [x, y + side]];
    let rings = [
        square([0.0, 0.0], 5.0),
        square([1.0, 1.0], 1.0),
        square([3.0, 2.0], 1.5),
    ];
    let vertices = flat(rings.as_flattened());
    for backwards in [false, true] {
        let mut polygons = Polygons::default();
        polygons.push(0..4);
        if backwards {
            polygons.push_hole((4..8).rev());
        } else {
            polygons.push_hole(4..8);
        }
        polygons.push_hole(8..12);
        polygons.push([0, 2, 1]);
        let (triangles, notice) = polygons.triangles(&vertices);
        assert_eq!(notice, None);
        let areas = doubled_areas(&vertices, &triangles);
        let (last, with_holes) = areas.split_last().unwrap();
        assert!(with_holes.iter().all(|a| a[2] > 0.0));
        let sum: f64 = with_holes.iter().map(|a| a[2]).sum();
        assert_eq!((sum, last[2]), (2.0 * (25.0 - 1.0 - 2.25), -25.0));
    }
}

#[test]
fn a_hole_that_leaves_its_polygon_is_noted() {
    let vertices = flat(&[
        [0.0, 0.0],
        [2.0, 0.0],
        [0.0, 2.0],
        [1.0, 0.5],
        [3.0, 0.5],
        [1.0, 0.7],
    ]);
    let mut polygons = Polygons::default();
    polygons.push(0..3);
    polygons.push_hole(3..6);
    let (triangles, notice) = polygons.triangles(&vertices);
    assert_eq!(triangles, [[0, 1, 2]]);
    assert!(notice.unwrap().contains("1 of 1 faces"));
}

#[test]
fn repeated_corners_count_once() {
    let vertices = flat(&[[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]]);
    let mut polygons = Polygons::default();
    polygons.push([0, 1, 1, 2, 2, 0]);
    let (triangles, notice) = polygons.triangles(&vertices);
    assert_eq!((triangles.len(), notice), (1, None));
    assert_eq!(doubled_areas(&vertices, &triangles), [[0.0, 0.0, 1.0]]);
}

#[test]
fn what_is_no_simple_polygon_is_a_fan_with_a_notice() {
    let inf = f64::MAX;
    for points in [
        &[[0.0, 0.0], [1.0, 1.0], [1.0, 0.0], [0.0, 1.0]][..],
        &[[0.0, 0.0], [1.0, 0.0], [2.0, 0.0], [3.0, 0.0]],
        &[[0.0, 0.0]; 5],
        &[[0.0, 0.0], [inf, 0.0], [0.0, inf], [-inf, -inf]],
        // Twice around.
        &[
            [0.0, 0.0],
            [1.0, 0.0],
            [0.0, 1.0],
            [0.0, 0.0],
            [1.0, 0.0],
            [0.0, 1.0],
        ],
        // A corner on a side of its own polygon.
        &[[0.0, 0.0], [4.0, 0.0], [4.0, 2.0], [2.0, 0.0], [0.0, 2.0]],
    ] {
        let (triangles, notice) = cut_one(&flat(points));
        assert_eq!(triangles.len(), points.len() - 2);
        assert!(
            notice.unwrap().contains("1 of 1 faces, the first number 1"),
            "{points:?}"
        );
    }
}

/// A million corners take seconds; so do polygons that cross or touch themselves all over.
#[test]
fn many_corners_take_little_time() {
    let ring = |n: usize, radius: fn(f64) -> f64| -> Vec<[f64; 2]> {
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / n as f64;
        let at = |t: f64| [radius(t) * libm::cos(t), radius(t) * libm::sin(t)];
        (0..n).map(|i| at(angle(i))).collect()
    };
    let start = std::time::Instant::now();
    let concave = flat(&ring(100_000, |t| 1.0 + 0.1 * libm::cos(7.0 * t)));
    let (triangles, notice) = cut_one(&concave);
    assert_eq!((triangles.len(), notice), (99_998, None));
    let (triangles, notice) = cut_one(&flat(&ring(1_000_000, |_| 1.0)));
    assert_eq!((triangles.len(), notice), (999_998, None));
    let same: Vec<[f64; 2]> = (0..100_000).map(|i| L[i % 3]).collect();
    assert!(cut_one(&flat(&same)).1.is_some());
    let star = ring(20_000, |t| 1.0 / (1e-3 + libm::sin(9_999.0 * t).abs()));
    cut_one(&flat(&star));
    let seconds = start.elapsed().as_secs();
    assert!(seconds < 60, "{seconds} s");
}

proptest! {
    #![proptest_config(ProptestConfig { failure_persistence: None, ..ProptestConfig::with_cases(200) })]

    /// A star-shaped polygon of any radii in any plane has the area that its corners say.
    #[test]
    fn any_simple_polygon_is_covered(
        radii in prop::collection::vec(0.1..1.0f64, 4..40),
        turn in prop::array::uniform2(0.0..6.3f64),
        at in prop::array::uniform3(-10.0..10.0f64),
    ) {
        let n = radii.len() as f64;
        let angle = |i: usize| std::f64::consts::TAU * i as f64 / n;
        let points: Vec<[f64; 2]> = radii.iter().enumerate()
            .map(|(i, r)| [r * libm::cos(angle(i)), r * libm::sin(angle(i))])
            .collect();
        let ([s, c], [sin, cos]) = (
            [libm::sin(turn[0]), libm::cos(turn[0])],
            [libm::sin(turn[1]), libm::cos(turn[1])],
        );
        let vertices: Vec<[f64; 3]> = points.iter().map(|&[x, y]| {
            let (x, z) = (c * x, s * x);
            [at[0] + cos * x - sin * y, at[1] + sin * x + cos * y, at[2] + z]
        }).collect();
        let (triangles, notice) = cut_one(&vertices);
        prop_assume!(c.abs() > 1e-3);
        prop_assert_eq!(notice, None);
        prop_assert_eq!(triangles.len(), points.len() - 2);
        let areas = doubled_areas(&vertices, &triangles);
        let length = |a: &[f64; 3]| a.iter().map(|x| x * x).sum::<f64>().sqrt();
        // All in one plane and wound alike: lengths and the vector add up to the same.
        let sum: f64 = areas.iter().map(length).sum();
        prop_assert!((sum / shoelace(&points) - 1.0).abs() < 1e-9, "{}", sum);
    }
}
