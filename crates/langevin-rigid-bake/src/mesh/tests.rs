use super::*;
use crate::shapes::Shape;

const CORNERS: [[f64; 3]; 4] = [[0.0; 3], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
const TETRAHEDRON: [[u32; 3]; 4] = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];

fn tetrahedron_with(
    change: impl FnOnce(&mut Vec<[f64; 3]>, &mut Vec<[u32; 3]>),
) -> Result<TriMesh, MeshError> {
    let (mut vertices, mut triangles) = (CORNERS.to_vec(), TETRAHEDRON.to_vec());
    change(&mut vertices, &mut triangles);
    TriMesh::new(vertices, triangles)
}

#[test]
fn a_good_mesh_is_kept_as_given() {
    let mesh = tetrahedron_with(|_, _| {}).unwrap();
    assert_eq!(
        (mesh.vertices(), mesh.triangles()),
        (&CORNERS[..], &TETRAHEDRON[..])
    );
    assert!(!mesh.was_turned() && !mesh.is_smooth());
}

#[test]
fn inward_normals_are_turned_and_told() {
    let mesh = tetrahedron_with(|_, t| t.iter_mut().for_each(|t| t.swap(0, 1))).unwrap();
    assert!(mesh.was_turned());
    assert!((mesh.volume() - 1.0 / 6.0).abs() < 1e-15);
    assert!(dot(mesh.normal(0), [0.0, 0.0, 1.0]) < -0.999);
}

#[test]
fn unused_vertices_are_dropped() {
    let mesh = tetrahedron_with(|v, t| {
        v.insert(1, [9.0; 3]);
        t.as_flattened_mut()
            .iter_mut()
            .filter(|i| **i > 0)
            .for_each(|i| *i += 1);
    });
    assert_eq!(mesh.unwrap().vertices(), CORNERS);
}

#[test]
fn each_fault_is_told_apart() {
    let broken =
        |change: fn(&mut Vec<[f64; 3]>, &mut Vec<[u32; 3]>)| tetrahedron_with(change).unwrap_err();
    assert_eq!(broken(|_, t| t.clear()), MeshError::Empty);
    assert_eq!(
        broken(|v, _| v[2][1] = f64::NAN),
        MeshError::NonFiniteVertex {
            vertex: 2,
            count: 1
        }
    );
    assert_eq!(
        broken(|_, t| t[3] = [2, 0, 4]),
        MeshError::IndexOutOfRange {
            triangle: 3,
            index: 4,
            vertices: 4
        }
    );
    assert_eq!(
        broken(|_, t| t[1] = [0, 1, 1]),
        MeshError::DegenerateTriangle {
            triangle: 1,
            vertices: [0, 1, 1],
            count: 1
        }
    );
    assert!(matches!(
        broken(|v, _| v[3] = [0.5, 0.0, 0.0]),
        MeshError::DegenerateTriangle { triangle: 1, .. }
    ));
    assert_eq!(
        broken(|_, t| t.push([1, 2, 0])),
        MeshError::DuplicateTriangle {
            first: 0,
            second: 4,
            count: 1
        }
    );
    assert!(matches!(
        broken(|_, t| t.truncate(3)),
        MeshError::OpenEdges {
            site: EdgeSite {
                vertices: [0, 2],
                triangle: 0,
                position: [0.0, 0.5, 0.0]
            },
            count: 3
        }
    ));
    assert!(matches!(
        broken(|_, t| t[2] = [2, 1, 3]),
        MeshError::InconsistentOrientation { count: 3, .. }
    ));
    assert!(matches!(
        broken(|v, _| v[3] = [0.4, 0.4, 0.0]),
        MeshError::ZeroVolume { .. }
    ));
}

/// Two tetrahedra, the second shifted and numbered by `map`.
fn two_tetrahedra(map: [u32; 4]) -> Result<TriMesh, MeshError> {
    tetrahedron_with(|v, t| {
        v.extend(CORNERS.map(|c| add(c, [-3.0, 0.0, 0.0])));
        t.extend(TETRAHEDRON.map(|t| t.map(|i| map[i as usize])));
    })
}

#[test]
fn touching_and_separate_parts_are_told_apart() {
    let apart = two_tetrahedra([4, 5, 6, 7]).unwrap();
    assert!((apart.volume() - 1.0 / 3.0).abs() < 1e-15 && !apart.was_turned());
    assert!(matches!(
        two_tetrahedra([4, 0, 6, 7]).unwrap_err(),
        MeshError::NonManifoldVertex {
            vertex: 0,
            count: 1,
            ..
        }
    ));
    assert!(matches!(
        two_tetrahedra([4, 0, 2, 7]).unwrap_err(),
        MeshError::NonManifoldEdge {
            triangles: 4,
            count: 1,
            ..
        }
    ));
}

/// A strip of `n` squares around a circle, with a half twist if `twisted`.
pub(super) fn ring_strip(n: u32, twisted: bool) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let vertices = (0..n).flat_map(|i| {
        let angle = std::f64::consts::TAU * f64::from(i) / f64::from(n);
        let tilt = if twisted { 0.5 * angle } else { 0.0 };
        [-0.3, 0.3].map(|s| {
            let r = 1.0 + s * tilt.cos();
            [r * angle.cos(), s * tilt.sin(), r * angle.sin()]
        })
    });
    let triangles = (0..n).flat_map(|i| {
        let (a, b) = (2 * i, 2 * i + 1);
        let (mut c, mut d) = ((a + 2) % (2 * n), (b + 2) % (2 * n));
        if twisted && i == n - 1 {
            (c, d) = (d, c);
        }
        [[a, b, d], [a, d, c]]
    });
    (vertices.collect(), triangles.collect())
}

#[test]
fn sheets_with_a_hole_thicken_and_one_sided_ones_do_not() {
    let (v, t) = ring_strip(40, false);
    let ring = TriMesh::from_sheet(v, t, 0.01).unwrap();
    let area =
        0.5 * 40.0 * (std::f64::consts::TAU / 40.0).sin() * (1.3f64.powi(2) - 0.7f64.powi(2));
    assert!((ring.volume() / (0.01 * area) - 1.0).abs() < 1e-12);
    let (v, t) = ring_strip(40, true);
    assert!(matches!(
        TriMesh::from_sheet(v, t, 0.01),
        Err(MeshError::NotOrientable { .. })
    ));
}

#[test]
fn a_closed_one_sided_surface_is_not_merely_inconsistent() {
    // The six-vertex real projective plane has no orientation; any embedding will do to say so.
    let triangles = vec![
        [0, 1, 2],
        [0, 2, 3],
        [0, 3, 4],
        [0, 4, 5],
        [0, 5, 1],
        [1, 2, 4],
        [2, 3, 5],
        [3, 4, 1],
        [4, 5, 2],
        [5, 1, 3],
    ];
    let vertices = vec![
        [0.0, 0.0, 1.0],
        [1.0, 0.0, 0.1],
        [0.3, 1.0, 0.2],
        [-0.8, 0.6, 0.3],
        [-0.8, -0.6, 0.5],
        [0.3, -1.0, 0.7],
    ];
    assert!(matches!(
        TriMesh::new(vertices, triangles),
        Err(MeshError::NotOrientable { .. })
    ));
}

#[test]
fn a_flat_sheet_thickens_to_its_exact_volume() {
    let (a, b, t) = (0.083, 0.05, 1e-4);
    let n = 7;
    let vertices: Vec<_> = (0..=n)
        .flat_map(|i| {
            (0..=n).map(move |j| {
                [
                    a * f64::from(i) / f64::from(n),
                    0.2,
                    b * f64::from(j) / f64::from(n),
                ]
            })
        })
        .collect();
    let at = |i: u32, j: u32| i * (n + 1) + j;
    let triangles: Vec<_> = (0..n)
        .flat_map(|i| (0..n).map(move |j| (i, j)))
        .flat_map(|(i, j)| {
            [
                [at(i, j), at(i, j + 1), at(i + 1, j + 1)],
                [at(i, j), at(i + 1, j + 1), at(i + 1, j)],
            ]
        })
        .collect();
    let plate = TriMesh::from_sheet(vertices, triangles, t).unwrap();
    assert!((plate.volume() / (a * b * t) - 1.0).abs() < 1e-10);
    assert_eq!(plate.triangles().len(), 2 * 98 + 8 * 7);
    assert!(!plate.was_turned());
    let [low, high] = plate.bounding_box();
    assert!((high[1] - low[1] - t).abs() < 1e-16);
}

#[test]
fn a_right_angle_fold_keeps_its_thickness_on_both_flaps() {
    // Two unit squares meeting at a right angle along z; the mitred fold leaves the cross-section
    // 2 L t exactly, since what the outside gains the inside loses.
    let vertices = [
        [1.0, 0.0, 0.0],
        [1.0, 0.0, 1.0],
        [0.0, 0.0, 0.0],
        [0.0, 0.0, 1.0],
        [0.0, 1.0, 0.0],
        [0.0, 1.0, 1.0],
    ];
    let triangles = [[0, 2, 1], [1, 2, 3], [2, 4, 3], [3, 4, 5]];
    let fold = TriMesh::from_sheet(vertices.to_vec(), triangles.to_vec(), 0.02).unwrap();
    assert!(
        (fold.volume() / (2.0 * 0.02) - 1.0).abs() < 0.02,
        "{}",
        fold.volume()
    );
}

#[test]
fn bad_sheets_are_refused() {
    let square = (
        [[0.0; 3], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]],
        [[0, 1, 2], [0, 2, 3]],
    );
    for thickness in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        let got = TriMesh::from_sheet(square.0.to_vec(), square.1.to_vec(), thickness);
        assert!(
            matches!(got, Err(MeshError::BadThickness { .. })),
            "{thickness}"
        );
    }
    let closed = TriMesh::from_sheet(CORNERS.to_vec(), TETRAHEDRON.to_vec(), 0.1);
    assert_eq!(closed, Err(MeshError::ClosedSheet));
    let mut shut = square.0;
    shut[3] = [1.0, 1e-4, 1e-4];
    let folded = TriMesh::from_sheet(shut.to_vec(), square.1.to_vec(), 0.1);
    assert!(
        matches!(folded, Err(MeshError::FoldedSheet { .. })),
        "{folded:?}"
    );
    let twisted = TriMesh::from_sheet(square.0.to_vec(), vec![[0, 1, 2], [0, 3, 2]], 0.1);
    assert!(matches!(
        twisted,
        Err(MeshError::InconsistentOrientation { count: 1, .. })
    ));
}

#[test]
fn an_open_sheet_error_names_the_option_in_both_spellings() {
    let open = tetrahedron_with(|_, t| t.truncate(3))
        .unwrap_err()
        .to_string();
    assert!(
        open.contains("`--thickness LENGTH`") && open.contains("`thickness = LENGTH`"),
        "{open}"
    );
    assert!(
        open.contains("3 open edges, the first between vertices 0 and 2 of triangle 0"),
        "{open}"
    );
}

#[test]
fn welding_joins_equal_positions_and_signed_zeros() {
    // Every triangle with its own three vertices, as STL stores them.
    let soup: Vec<[f64; 3]> = TETRAHEDRON
        .as_flattened()
        .iter()
        .map(|&v| CORNERS[v as usize])
        .collect();
    let own = [[0, 1, 2], [3, 4, 5], [6, 7, 8], [9, 10, 11]];
    assert_eq!(open_edge_count(&own), 12);
    let (vertices, triangles) = weld(&soup, &own);
    assert_eq!((vertices.len(), open_edge_count(&triangles)), (4, 0));
    assert!(TriMesh::new(vertices, triangles).is_ok());
}

#[test]
fn edges_know_both_triangles() {
    let mesh = Shape::Box {
        size: [1.0, 2.0, 3.0],
    }
    .mesh(300)
    .unwrap();
    let edges = mesh.edges();
    assert_eq!(2 * edges.len(), 3 * mesh.triangles().len());
    assert_eq!(
        mesh.vertices().len() + mesh.triangles().len(),
        edges.len() + 2,
        "Euler"
    );
    for Edge {
        vertices: [a, b],
        triangles: [forth, back],
    } in edges
    {
        let runs = |t: u32, from: u32, to: u32| {
            let t = mesh.triangles()[t as usize];
            (0..3).any(|k| t[k] == from && t[(k + 1) % 3] == to)
        };
        assert!(a < b && runs(forth, a, b) && runs(back, b, a));
    }
}

#[test]
fn transforms_keep_the_body_and_refuse_nonsense() {
    let mesh = Shape::Ellipsoid {
        semi_axes: [1.0, 2.0, 3.0],
    }
    .mesh(320)
    .unwrap();
    let turn = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
    let moved = mesh.transformed(turn, [5.0, 6.0, 7.0], 2.0).unwrap();
    assert!(moved.is_smooth());
    assert!((moved.volume() / (8.0 * mesh.volume()) - 1.0).abs() < 1e-13);
    assert!((moved.surface_area() / (4.0 * mesh.surface_area()) - 1.0).abs() < 1e-13);
    let mirror = [[-1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]];
    let mirrored = mesh.transformed(mirror, [0.0; 3], 1.0).unwrap();
    assert!(
        (mirrored.volume() / mesh.volume() - 1.0).abs() < 1e-13,
        "normals stay outward"
    );
    assert!((mesh.scaled_to_volume(3.0).unwrap().volume() - 3.0).abs() < 1e-13);

    let bad = |r, t, s| {
        matches!(
            mesh.transformed(r, t, s),
            Err(MeshError::BadTransform { .. })
        )
    };
    assert!(bad(turn, [0.0; 3], 0.0) && bad(turn, [f64::NAN, 0.0, 0.0], 1.0));
    assert!(bad(
        [[1.0, 1.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]],
        [0.0; 3],
        1.0
    ));
    assert!(mesh.scaled_to_volume(-1.0).is_err());
}

#[test]
fn a_body_of_parts_knows_its_cavities() {
    let ball = Shape::Ellipsoid {
        semi_axes: [1.0; 3],
    }
    .mesh(320)
    .unwrap();
    // Inside out of each other; the innermost is solid again, and one is beside.
    let balls = [(1.0, 0.0), (0.6, 0.2), (0.3, 0.1), (0.5, 2.0)];
    let n = ball.vertices().len() as u32;
    let vertices = balls.iter().flat_map(|&(size, x)| {
        let place = move |v: &[f64; 3]| add(scale(size, *v), [x, 0.0, 0.0]);
        ball.vertices().iter().map(place)
    });
    let triangles = (0..4).flat_map(|k| ball.triangles().iter().map(move |t| t.map(|v| v + k * n)));
    let mesh = TriMesh::new(vertices.collect(), triangles.collect()).unwrap();
    assert!(mesh.was_turned());
    let ratio = |volume: f64| volume / ball.volume();
    assert!((ratio(mesh.volume()) - (1.0 + 0.125)).abs() < 1e-12);
    assert!((ratio(mesh.solid_volume()) - (1.0 - 0.216 + 0.027 + 0.125)).abs() < 1e-12);
    assert_eq!(mesh.wetted().triangles().len(), 640);
    let away = mesh
        .transformed(vector::IDENTITY, [5.0, 0.0, 0.0], 2.0)
        .unwrap();
    assert!((ratio(away.volume()) - 8.0 * 1.125).abs() < 1e-11);
    // As written to a file, normals out of the solid.
    let again = TriMesh::new(mesh.vertices().to_vec(), mesh.triangles().to_vec()).unwrap();
    assert!(!again.was_turned());
    assert_eq!(again.solid_volume(), mesh.solid_volume());
}

#[test]
fn each_part_must_enclose_something() {
    let flat = two_tetrahedra_of(|v| v[7] = [-2.6, 0.4, 0.0]);
    assert!(matches!(flat, Err(MeshError::ZeroVolume { .. })));
}

#[test]
fn small_parts_are_measured_by_themselves_wherever_they_are() {
    // Rounding gives what is flat a volume about a point far from its plane.
    let flat = [
        [0.0; 3],
        [0.0, 1.0, 0.1],
        [0.0, 0.3, 0.7],
        [0.0, 0.37, 0.21],
    ];
    let flat_at = |x: f64| flat.map(|v| add(scale(3e-10, v), [x, 0.0, 0.0]));
    let flats = two_tetrahedra_of(|v| *v = [flat_at(-1.1), flat_at(1.3)].concat());
    assert!(matches!(flats, Err(MeshError::ZeroVolume { .. })));
    // And hides the volume, and which way is out, of what is small.
    for place in [
        [70.0, 80.0, 90.0],
        [-70.0, 80.0, 91.0],
        [-71.0, -82.0, 93.0],
    ] {
        let speck = |v: &mut Vec<[f64; 3]>| {
            v[4..].copy_from_slice(&CORNERS.map(|c| add(scale(1e-6, c), place)));
        };
        let beside = two_tetrahedra_of(speck).unwrap();
        assert!(!beside.was_turned());
        let mut inward = beside.triangles().to_vec();
        inward[4..].iter_mut().for_each(|t| t.swap(0, 1));
        let beside = TriMesh::new(beside.vertices().to_vec(), inward).unwrap();
        assert_eq!(beside.turned, 4);
    }
}

#[test]
fn parts_whose_volume_is_lost_to_rounding_are_no_body() {
    let apart = |offset: [f64; 3]| {
        two_tetrahedra_of(|v| v[4..].copy_from_slice(&CORNERS.map(|c| add(c, offset))))
    };
    let along = apart([1.0e7 / 3.0, 0.0, 0.0]).unwrap();
    assert!((along.volume() - 1.0 / 3.0).abs() < 1e-6);
    let across = apart([1.0e7 / 3.0, 1.0e7 / 7.0, 1.0e7 / 11.0]).unwrap_err();
    let MeshError::PartsFarApart { volume, .. } = across else {
        panic!("{across}");
    };
    assert!((volume - 1.0 / 3.0).abs() < 1e-6);
}

#[test]
fn a_body_of_any_size_has_a_volume() {
    for power in -320..308 {
        let size = 10f64.powi(power);
        let sized = two_tetrahedra_of(|v| v.iter_mut().for_each(|v| *v = scale(size, *v)));
        let within = (-80..=76).contains(&power);
        match sized {
            Ok(body) => assert!(
                body.volume() > 0.0 && body.volume().is_finite(),
                "1e{power}"
            ),
            Err(error) => assert!(!within, "1e{power}: {error}"),
        }
    }
}

fn two_tetrahedra_of(change: impl FnOnce(&mut Vec<[f64; 3]>)) -> Result<TriMesh, MeshError> {
    tetrahedron_with(|v, t| {
        v.extend(CORNERS.map(|c| add(c, [-3.0, 0.0, 0.0])));
        t.extend(TETRAHEDRON.map(|t| t.map(|i| i + 4)));
        change(v);
    })
}
