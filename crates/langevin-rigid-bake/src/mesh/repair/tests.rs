use super::*;
use crate::mesh::{MeshError, weld};
use crate::shapes::Shape;
use proptest::prelude::*;

type Mesh = (Vec<[f64; 3]>, Vec<[u32; 3]>);

fn cube(triangles: usize) -> Mesh {
    let mesh = Shape::Box { size: [1.0; 3] }.mesh(triangles).unwrap();
    (mesh.vertices().to_vec(), mesh.triangles().to_vec())
}

fn mended(mesh: &Mesh, options: &Options) -> Repaired {
    repair(&mesh.0, &mesh.1, options, &())
}

/// Repairs by default into a body of the given volume.
fn steps_to(mesh: &Mesh, volume: f64) -> Vec<Step> {
    let repaired = mended(mesh, &Options::default());
    let body = repaired.body.unwrap();
    assert!(
        (body.volume() / volume - 1.0).abs() < 1e-5,
        "{}",
        body.volume()
    );
    repaired.steps
}

fn shifted(mesh: &Mesh, by: [f64; 3], scale: f64) -> Mesh {
    let place = |v: &[f64; 3]| std::array::from_fn(|k| scale * v[k] + by[k]);
    (mesh.0.iter().map(place).collect(), mesh.1.clone())
}

fn together(a: &Mesh, b: &Mesh) -> Mesh {
    let n = a.0.len() as u32;
    let second = b.1.iter().map(|t| t.map(|v| v + n));
    (
        [&a.0[..], &b.0].concat(),
        a.1.iter().copied().chain(second).collect(),
    )
}

#[test]
fn a_good_mesh_is_left_alone() {
    let good = cube(300);
    let repaired = mended(&good, &Options::default());
    assert_eq!(repaired.steps, []);
    assert_eq!(
        repaired.body.unwrap(),
        TriMesh::new(good.0, good.1).unwrap()
    );
}

#[test]
fn a_missing_face_is_filled_and_a_flipped_triangle_turned() {
    let mut mesh = cube(12);
    let face: Vec<usize> = (0..12)
        .filter(|&t| mesh.1[t].iter().all(|&v| mesh.0[v as usize][0] > 0.4))
        .collect();
    assert_eq!(face.len(), 2);
    mesh.1
        .retain(|t| !t.iter().all(|&v| mesh.0[v as usize][0] > 0.4));
    assert_eq!(
        steps_to(&mesh, 1.0),
        [Step::Filled {
            holes: 1,
            edges: 4,
            triangles: 2,
            area: 1.0
        }]
    );
    mesh.1[3].swap(0, 1);
    assert_eq!(steps_to(&mesh, 1.0)[0], Step::Turned { triangles: 1 });
}

#[test]
fn a_hole_with_corners_on_a_line_is_filled_without_flat_triangles() {
    let mut mesh = cube(300);
    mesh.1
        .retain(|t| !t.iter().all(|&v| mesh.0[v as usize][0] > 0.4));
    let steps = steps_to(&mesh, 1.0);
    let Step::Filled {
        holes,
        edges,
        triangles,
        area,
    } = steps[1]
    else {
        panic!("{steps:?}")
    };
    assert_eq!((holes, triangles), (1, edges - 2));
    assert!((area - 1.0).abs() < 1e-12);
}

#[test]
fn a_bowl_and_a_sheet_stay_open_until_asked() {
    let mut bowl = cube(300);
    bowl.1
        .retain(|t| t.iter().any(|&v| mesh_x(&bowl.0, v) < 0.0));
    let error = mended(&bowl, &Options::default()).body.unwrap_err();
    assert!(
        matches!(error, Unrepaired::Open { count: 1, .. }),
        "{error}"
    );
    assert!(error.to_string().contains("--thickness LENGTH"));
    let options = Options {
        thickness: Some(0.01),
        ..Options::default()
    };
    let repaired = mended(&bowl, &options);
    assert!(matches!(
        repaired.steps[1],
        Step::Thickened {
            thickness: 0.01,
            ..
        }
    ));
    assert!(repaired.body.unwrap().volume() > 0.01 * 2.5);
}

#[test]
fn a_bowl_is_closed_if_asked() {
    // A cube of 1 x 1 x 0.4 without its lid, whose disc is 0.49 of the rest.
    let tray = Shape::Box {
        size: [1.0, 1.0, 0.4],
    }
    .mesh(12)
    .unwrap();
    let lid = |t: &&[u32; 3]| t.iter().any(|&v| tray.vertices()[v as usize][2] < 0.0);
    let open: Vec<[u32; 3]> = tray.triangles().iter().filter(lid).copied().collect();
    let run = |fill| {
        let options = Options {
            fill,
            ..Options::default()
        };
        repair(tray.vertices(), &open, &options, &()).body
    };
    assert!(run(None).is_err());
    assert!((run(Some(4)).unwrap().volume() / 0.4 - 1.0).abs() < 1e-12);
    assert!(run(Some(3)).is_err());
}

fn mesh_x(vertices: &[[f64; 3]], v: u32) -> f64 {
    vertices[v as usize][0]
}

#[test]
fn the_holes_of_a_sheet_are_filled_only_if_asked() {
    let plate = Shape::Box {
        size: [1.0, 1.0, 0.5],
    }
    .mesh(2000)
    .unwrap();
    let top = |t: &&[u32; 3]| t.iter().all(|&v| plate.vertices()[v as usize][2] > 0.24);
    let mut sheet: Vec<[u32; 3]> = plate.triangles().iter().filter(top).copied().collect();
    let inner = |v: u32| {
        plate.vertices()[v as usize][..2]
            .iter()
            .all(|x| x.abs() < 0.4)
    };
    let hole = sheet.iter().position(|t| t.iter().all(|&v| inner(v)));
    sheet.remove(hole.unwrap());
    let thick = Options {
        thickness: Some(0.01),
        ..Options::default()
    };
    let run = |options: &Options| repair(plate.vertices(), &sheet, options, &()).body.unwrap();
    assert!(run(&thick).volume() < 0.01 * 0.9999);
    let filled = run(&Options {
        fill: Some(3),
        ..thick
    });
    assert!((filled.volume() / 0.01 - 1.0).abs() < 1e-9);
}

#[test]
fn a_seam_and_a_soup_are_welded() {
    let good = cube(300);
    let mut torn: Mesh = (Vec::new(), Vec::new());
    for (t, corners) in (0u32..).zip(&good.1) {
        let off = 1e-7 * f64::from(t % 3);
        torn.0
            .extend(corners.map(|v| good.0[v as usize].map(|x| x + off)));
        torn.1.push([3 * t, 3 * t + 1, 3 * t + 2]);
    }
    let steps = steps_to(&torn, 1.0);
    let Step::Welded { vertices, distance } = steps[0] else {
        panic!("{steps:?}")
    };
    assert_eq!((steps.len(), vertices), (1, torn.0.len() - good.0.len()));
    assert!(distance > 0.9e-7 && distance < 4e-7);
}

#[test]
fn welding_waits_for_a_tolerance_that_reaches() {
    let mut torn = cube(12);
    torn.0.push(torn.0[torn.1[0][0] as usize].map(|x| x + 1e-4));
    torn.1[0][0] = torn.0.len() as u32 - 1;
    let wide = Options {
        weld: Some(1e-3),
        fill: Some(0),
        ..Options::default()
    };
    assert!(matches!(
        mended(&torn, &wide).steps[..],
        [Step::Welded { vertices: 1, .. }]
    ));
    let narrow = Options {
        weld: Some(1e-5),
        fill: Some(0),
        ..Options::default()
    };
    assert!(mended(&torn, &narrow).body.is_err());
}

#[test]
fn duplicates_are_dropped_and_one_is_kept() {
    let mut mesh = cube(300);
    mesh.1.extend([mesh.1[5], mesh.1[9]]);
    let last = mesh.1.len() - 1;
    mesh.1[last].swap(0, 1);
    assert_eq!(
        steps_to(&mesh, 1.0),
        [Step::Duplicates {
            dropped: 2,
            interior: 0
        }]
    );
    // A sheet given with both of its sides is a sheet.
    let good = cube(300);
    let both = together(&good, &shifted(&good, [0.0; 3], 1.0));
    let (v, mut t) = weld(&both.0, &both.1);
    for t in &mut t[300..] {
        t.swap(0, 1);
    }
    assert!(matches!(
        steps_to(&(v, t), 1.0)[..],
        [Step::Duplicates { interior: 0, .. }]
    ));
}

#[test]
fn a_wall_between_two_solids_is_taken_out() {
    let one = cube(300);
    let both = together(&one, &shifted(&one, [1.0, 0.0, 0.0], 1.0));
    let welded = weld(&both.0, &both.1);
    let steps = steps_to(&welded, 2.0);
    let Step::Duplicates { dropped, interior } = steps[0] else {
        panic!("{steps:?}")
    };
    assert_eq!((dropped, interior, steps.len()), (interior, 100, 1));
}

#[test]
fn a_vertex_on_the_side_of_a_neighbour_becomes_one_of_its_corners() {
    // The edge from a to b of one triangle is cut at m for its neighbours: first with a triangle without
    // area between, then with a crack.
    let (mut v, mut t) = cube(12);
    let [a, b, c] = t[0];
    let m = v.len() as u32;
    let middle = std::array::from_fn(|k| 0.5 * (v[a as usize][k] + v[b as usize][k]));
    v.push(middle);
    t[0] = [a, m, c];
    t.push([m, b, c]);
    let crack = (v.clone(), t.clone());
    t.push([a, b, m]);
    let steps = steps_to(&(v, t), 1.0);
    assert_eq!(
        steps,
        [Step::Degenerate {
            dropped: 0,
            collapsed: 0,
            flipped: 1
        }]
    );
    let steps = steps_to(&crack, 1.0);
    assert!(matches!(
        steps[0],
        Step::Filled {
            holes: 1,
            edges: 3,
            triangles: 1,
            area
        } if area < 1e-15
    ));
    assert_eq!(
        steps[1],
        Step::Degenerate {
            dropped: 0,
            collapsed: 0,
            flipped: 1
        }
    );
}

#[test]
fn needles_collapse() {
    // An edge is opened and closed with two triangles whose vertices nearly coincide.
    let (mut v, mut t) = cube(12);
    let [a, b, c] = t[0];
    let near = v.len() as u32;
    v.push(v[a as usize].map(|x| x + 1e-12));
    t[0] = [near, b, c];
    t.extend([[a, b, near], [a, near, c]]);
    let steps = steps_to(&(v, t), 1.0);
    assert!(
        matches!(steps[..], [Step::Degenerate { flipped: 0, .. }]),
        "{steps:?}"
    );
}

#[test]
fn components_are_not_chosen_unasked() {
    let both = together(&shifted(&cube(12), [3.0, 0.0, 0.0], 0.1), &cube(300));
    let kept = mended(&both, &Options::default());
    assert_eq!(kept.steps, []);
    assert!((kept.body.unwrap().volume() - 1.001).abs() < 1e-12);
    let repaired = mended(
        &both,
        &Options {
            largest: true,
            ..Options::default()
        },
    );
    let [
        Step::Components {
            dropped: 1,
            triangles: 12,
            area,
        },
    ] = repaired.steps[..]
    else {
        panic!("{:?}", repaired.steps)
    };
    assert!((area - 0.06).abs() < 1e-12);
    assert!((repaired.body.unwrap().volume() - 1.0).abs() < 1e-12);
}

#[test]
fn what_is_lost_and_made_is_said() {
    // Of a cube without a face a sixth is made up, and with another cube of half its size a fifth is lost.
    let mut open = cube(12);
    open.1
        .retain(|t| !t.iter().all(|&v| mesh_x(&open.0, v) > 0.4));
    let both = together(&open, &shifted(&cube(12), [3.0, 0.0, 0.0], 0.5));
    let largest = Options {
        largest: true,
        ..Options::default()
    };
    let balance = mended(&both, &largest).balance.unwrap();
    assert!((balance.made_share() - 1.0 / 6.0).abs() < 1e-12);
    assert!((balance.lost_share() - 1.5 / 6.5).abs() < 1e-12);
    assert!((balance.hull_share() - 1.0).abs() < 1e-12);
    assert_eq!(balance.warnings().len(), 2);
    let kept = mended(&cube(300), &Options::default()).balance.unwrap();
    assert_eq!((kept.lost, kept.made), (0.0, 0.0));
    assert!(kept.warnings().is_empty());
}

/// Two unit cubes half in each other, one of them inside out: together 1.5 m³.
#[cfg(feature = "meshopt")]
#[test]
fn closed_parts_that_meet_become_one() {
    let mut second = shifted(&cube(12), [0.5, 0.0, 0.0], 1.0);
    second.1.iter_mut().for_each(|t| t.swap(0, 1));
    let both = together(&cube(12), &second);
    let repaired = mended(&both, &Options::default());
    let body = repaired.body.unwrap();
    assert!(
        (body.volume() / 1.5 - 1.0).abs() < 0.01,
        "{}",
        body.volume()
    );
    let Some(Step::Wrapped {
        size,
        volume,
        parts: Some(parts),
        leak: None,
        ..
    }) = repaired.steps.last()
    else {
        panic!("{:?}", repaired.steps);
    };
    assert_eq!(*volume, body.volume());
    assert!((parts - 2.0).abs() < 1e-12, "{parts}");
    // A fiftieth of the diagonal of 1.5 by 1 by 1.
    assert_eq!(*size, 0.041);
    let balance = repaired.balance.unwrap();
    assert!(balance.made_share() < 0.01 && balance.warnings().is_empty());
    let few = Options {
        triangles: Some(500),
        ..Options::default()
    };
    let few = mended(&both, &few).body.unwrap();
    assert!(few.triangles().len() <= 500);
    assert!((few.volume() / body.volume() - 1.0).abs() < 1e-12);
}

/// Sheets that would meet once they are thick are not solids that meet.
#[test]
fn sheets_that_meet_are_not_wrapped_unasked() {
    let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
    let sheet = (
        corners.map(|[x, y]| [x, y, 0.0]).to_vec(),
        vec![[0, 1, 2], [0, 2, 3]],
    );
    let both = together(&sheet, &shifted(&sheet, [0.0, 0.0, 0.01], 1.0));
    let thick = Options {
        thickness: Some(0.05),
        ..Options::default()
    };
    let error = mended(&both, &thick).body.unwrap_err();
    assert!(
        matches!(error, Unrepaired::NoBody(MeshError::PartsMeet { .. })),
        "{error}"
    );
}

#[test]
fn the_diagonal_is_that_of_what_can_be_used() {
    let (mut vertices, mut triangles) = cube(12);
    let n = vertices.len() as u32;
    vertices.extend([[9.0; 3], [1e300; 3], [f64::NAN; 3]]);
    triangles.push([n + 1, n + 2, n + 7]);
    assert!((diagonal(&vertices, &triangles) - f64::sqrt(3.0)).abs() < 1e-15);
    assert_eq!(diagonal(&[], &[]), 0.0);
}

#[test]
fn what_touches_is_taken_apart() {
    let one = cube(12);
    for by in [[1.0, 1.0, 0.0], [1.0, 1.0, 1.0]] {
        let both = together(&one, &shifted(&one, by, 1.0));
        let welded = weld(&both.0, &both.1);
        let edges = usize::from(by[2] == 0.0);
        let repaired = mended(&welded, &Options::default());
        assert_eq!(
            repaired.steps,
            [Step::Split {
                edges,
                vertices: 1 + edges
            }],
            "{by:?}"
        );
        assert!((repaired.body.unwrap().volume() - 2.0).abs() < 1e-12);
        let largest = mended(
            &welded,
            &Options {
                largest: true,
                ..Options::default()
            },
        );
        assert!((largest.body.unwrap().volume() - 1.0).abs() < 1e-12);
    }
}

#[test]
fn cracks_along_a_face_that_is_divided_more_finely_are_closed() {
    // The face at high z is divided by a grid of 4 x 4, its neighbours are not.
    let (mut v, mut t) = cube(12);
    t.retain(|t| t.iter().any(|&w| v[w as usize][2] < 0.0));
    let n = v.len() as u32;
    let at = |i: u32| f64::from(i) / 4.0 - 0.5;
    v.extend((0..25).map(|k| [at(k % 5), at(k / 5), 0.5]));
    for k in (0..20).filter(|k| k % 5 < 4).map(|k| k + n) {
        t.extend([[k, k + 1, k + 6], [k, k + 6, k + 5]]);
    }
    let steps = steps_to(&(v, t), 1.0);
    let [
        _,
        Step::Filled { holes, edges, .. },
        Step::Degenerate { dropped: 0, .. },
    ] = steps[..]
    else {
        panic!("{steps:?}")
    };
    assert_eq!((holes, edges), (4, 20));
}

#[test]
fn a_fin_is_no_body_and_said_to_be_none() {
    let (v, mut t) = cube(12);
    let outside = v.len() as u32;
    let v = [&v[..], &[[3.0, 3.0, 3.0]]].concat();
    t.push([t[0][0], t[0][1], outside]);
    let error = mended(&(v, t), &Options::default()).body.unwrap_err();
    assert!(
        matches!(error, Unrepaired::NoBody(MeshError::NonManifoldEdge { .. })),
        "{error}"
    );
}

#[test]
fn inside_out_is_turned_and_told() {
    let (v, mut t) = cube(12);
    t.iter_mut().for_each(|t| t.swap(0, 1));
    assert_eq!(steps_to(&(v, t), 1.0), [Step::InsideOut { triangles: 12 }]);
}

#[test]
fn a_strip_with_one_side_is_refused() {
    let (v, t) = crate::mesh::tests::ring_strip(40, true);
    let options = Options {
        thickness: Some(0.01),
        ..Options::default()
    };
    let error = mended(&(v, t), &options).body.unwrap_err();
    assert!(
        matches!(error, Unrepaired::NoBody(MeshError::NotOrientable { .. })),
        "{error}"
    );
}

#[test]
fn hostile_meshes_are_errors() {
    let options = Options {
        largest: true,
        fill: Some(usize::MAX),
        ..Options::default()
    };
    let mut cases = vec![(vec![], vec![]), (vec![[0.0; 3]], vec![[0, 0, 0]; 5])];
    for bad in [f64::NAN, f64::INFINITY, 1e300, -1e200, 1e-200, 0.0] {
        let (v, t) = cube(12);
        cases.push((v.iter().map(|p| p.map(|x| bad * x)).collect(), t));
    }
    for mesh in cases {
        assert!(mended(&mesh, &options).body.is_err());
    }
    let (mut v, mut t) = cube(300);
    v[0] = [f64::NAN; 3];
    t[40][1] = 4_000_000_000;
    let steps = steps_to_within(&(v, t), 0.03);
    assert!(
        matches!(steps[0], Step::Unusable { triangles: 2.. }),
        "{steps:?}"
    );
}

fn steps_to_within(mesh: &Mesh, share: f64) -> Vec<Step> {
    let repaired = mended(mesh, &Options::default());
    assert!((repaired.body.unwrap().volume() - 1.0).abs() < share);
    repaired.steps
}

#[cfg(feature = "meshopt")]
#[test]
fn it_simplifies_last() {
    let ball = Shape::Ellipsoid {
        semi_axes: [1.0, 2.0, 3.0],
    }
    .mesh(5120)
    .unwrap();
    let options = Options {
        triangles: Some(800),
        ..Options::default()
    };
    let repaired = repair(ball.vertices(), &ball.triangles()[1..], &options, &());
    let body = repaired.body.unwrap();
    assert!(body.triangles().len() <= 800);
    assert!((body.volume() / ball.volume() - 1.0).abs() < 1e-3);
    assert!(matches!(
        repaired.steps[1],
        Step::Simplified { from: 5120, .. }
    ));
}

#[test]
fn it_stops_when_asked() {
    struct Stop;
    impl Progress for Stop {
        fn cancelled(&self) -> bool {
            true
        }
    }
    let (v, t) = cube(12);
    let stopped = repair(&v, &t[1..], &Options::default(), &Stop);
    assert_eq!(stopped.body, Err(Unrepaired::Cancelled));
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn damage_to_a_convex_body_is_undone(
        missing in proptest::collection::btree_set(0usize..320, 0..4),
        turned in proptest::collection::btree_set(0usize..320, 0..40),
        copied in proptest::collection::btree_set(0usize..320, 0..10),
        soup in any::<bool>(),
        noise in 0.0..1e-7f64,
    ) {
        let size = [1.0, 2.0, 0.5];
        let body = Shape::Box { size }.mesh(320).unwrap();
        let given = body.triangles().len();
        let mut damaged = (body.vertices().to_vec(), body.triangles().to_vec());
        for &t in copied.iter().filter(|t| **t < given) {
            damaged.1.push(damaged.1[t]);
        }
        for &t in turned.iter().filter(|t| **t < given) {
            damaged.1[t].swap(0, 2);
        }
        for &t in missing.iter().rev().filter(|t| **t < given) {
            if !copied.contains(&t) {
                damaged.1.remove(t);
            }
        }
        if soup {
            let corners = damaged.1.as_flattened().iter().enumerate();
            damaged.0 = corners.map(|(i, &v)| {
                damaged.0[v as usize].map(|x| x + noise * (i % 3) as f64 / 3.0)
            }).collect();
            damaged.1 = (0..damaged.1.len() as u32).map(|t| [3 * t, 3 * t + 1, 3 * t + 2]).collect();
        }
        let repaired = mended(&damaged, &Options::default());
        let volume = repaired.body.clone().map(|b| b.volume() / body.volume() - 1.0);
        prop_assert!(volume.as_ref().is_ok_and(|v| v.abs() < 1e-5), "{:?} {volume:?}", repaired.steps);
        // Once more changes nothing.
        let body = repaired.body.unwrap();
        let again = repair(body.vertices(), body.triangles(), &Options::default(), &());
        prop_assert!(again.steps.is_empty());
        prop_assert_eq!(again.body.unwrap(), TriMesh { turned: 0, ..body });
    }
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(4000))]

    /// On a grid of few points triangles meet in every way there is.
    #[test]
    fn what_is_left_of_any_soup_is_not_what_repair_mends(
        triangles in proptest::collection::vec([0u32..18, 0u32..18, 0u32..18], 4..40),
        fill in proptest::option::of(3usize..20),
        largest in any::<bool>(),
    ) {
        let place = |i: u32| [f64::from(i % 3), f64::from(i / 3 % 3), f64::from(i / 9)];
        let vertices: Vec<[f64; 3]> = (0..18).map(place).collect();
        let options = Options { fill, largest, ..Options::default() };
        let repaired = mended(&(vertices, triangles), &options);
        let mended = matches!(
            repaired.body,
            Err(Unrepaired::NoBody(
                MeshError::DegenerateTriangle { .. }
                    | MeshError::DuplicateTriangle { .. }
                    | MeshError::InconsistentOrientation { .. }
                    | MeshError::NonManifoldVertex { .. }
                    | MeshError::IndexOutOfRange { .. }
                    | MeshError::NonFiniteVertex { .. }
            ))
        );
        prop_assert!(!mended, "{:?} {:?}", repaired.steps, repaired.body);
    }
}
