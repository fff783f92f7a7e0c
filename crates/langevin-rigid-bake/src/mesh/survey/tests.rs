use super::*;
use crate::shapes::Shape;

fn cube(triangles: usize) -> (Vec<[f64; 3]>, Vec<[u32; 3]>) {
    let mesh = Shape::Box { size: [1.0; 3] }.mesh(triangles).unwrap();
    (mesh.vertices().to_vec(), mesh.triangles().to_vec())
}

#[test]
fn a_good_mesh_has_nothing_wrong() {
    let (v, t) = cube(300);
    let found = survey(&v, &t, &()).unwrap();
    assert!((found.area - 6.0).abs() < 1e-12 && (found.volume - 1.0).abs() < 1e-12);
    assert_eq!((found.triangles, found.vertices), (t.len(), v.len()));
    assert_eq!(found.unusable + found.unused_vertices + found.degenerate, 0);
    assert_eq!(found.duplicates + found.flipped + found.seams.vertices, 0);
    assert_eq!(found.holes, []);
    assert_eq!(
        (
            found.non_manifold_edges.count,
            found.non_manifold_vertices.count
        ),
        (0, 0)
    );
    assert!(found.one_sided.is_none() && found.body.is_ok());
    assert_eq!(
        (found.components.len(), found.components[0].triangles),
        (1, t.len())
    );
}

#[test]
fn every_fault_is_counted_in_one_go() {
    let (mut v, mut t) = cube(300);
    let lone = v.len() as u32;
    v.extend([[9.0, 9.0, f64::NAN], [0.5 + 1e-8, 0.5, 0.5], [0.0; 3]]);
    t[10].swap(0, 1);
    t.push(t[20]);
    t.push([t[30][0], t[30][0], t[30][1]]);
    t.push([lone, 0, 1]);
    t.push([0, 1, 7_000_000]);
    t.remove(40);
    let found = survey(&v, &t, &()).unwrap();
    assert_eq!(found.unusable, 2);
    assert_eq!(found.unused_vertices, 2);
    assert_eq!(
        (found.degenerate, found.duplicates, found.flipped),
        (1, 1, 1)
    );
    assert_eq!((found.holes.len(), found.holes[0].edges), (1, 3));
    assert!(found.body.is_err());
    assert_eq!(found.bounds, [[-0.5; 3], [0.5; 3]]);
}

#[test]
fn seams_are_found_within_the_tolerance() {
    let (mut v, mut t) = cube(12);
    v.push(v[t[0][0] as usize].map(|x| x + 1e-8));
    t[0][0] = v.len() as u32 - 1;
    let found = survey(&v, &t, &()).unwrap();
    assert_eq!(found.seams.vertices, 1);
    assert!((found.seams.distance / (1e-8 * 3f64.sqrt()) - 1.0).abs() < 1e-6);
}

#[test]
fn components_nest() {
    let (v, t) = cube(12);
    let n = v.len() as u32;
    let part = |scale: f64, x: f64| {
        v.iter()
            .map(move |p| [scale * p[0] + x, scale * p[1], scale * p[2]])
    };
    let vertices = part(1.0, 0.0)
        .chain(part(0.5, 0.0))
        .chain(part(0.25, 0.0))
        .chain(part(0.2, 3.0));
    let triangles: Vec<[u32; 3]> = (0..4)
        .flat_map(|k| t.iter().map(move |t| t.map(|v| v + k * n)))
        .collect();
    let found = survey(&vertices.collect::<Vec<_>>(), &triangles, &()).unwrap();
    let inside: Vec<Option<usize>> = found.components.iter().map(|c| c.inside).collect();
    assert_eq!(inside, [None, Some(0), Some(1), None]);
    assert!((found.components[1].volume.unwrap() - 0.125).abs() < 1e-12);
}

#[test]
fn touching_parts_and_one_sided_strips_are_seen() {
    let (v, t) = cube(12);
    let beside = v.iter().map(|p| [p[0] + 1.0, p[1] + 1.0, p[2]]);
    let n = v.len() as u32;
    let t: Vec<[u32; 3]> = t
        .iter()
        .copied()
        .chain(t.iter().map(|t| t.map(|v| v + n)))
        .collect();
    let v: Vec<[f64; 3]> = v.iter().copied().chain(beside).collect();
    let (v, t) = crate::mesh::weld(&v, &t);
    let found = survey(&v, &t, &()).unwrap();
    assert_eq!(found.non_manifold_edges.count, 1);
    assert_eq!(found.non_manifold_edges.first, Some([0.5, 0.5, 0.0]));
    let (v, t) = crate::mesh::tests::ring_strip(20, true);
    let found = survey(&v, &t, &()).unwrap();
    assert!(found.one_sided.is_some() && found.holes.len() == 1);
}

#[test]
fn nothing_is_surveyed_too() {
    let found = survey(&[], &[], &()).unwrap();
    assert_eq!(found.bounds, [[0.0; 3]; 2]);
    assert_eq!(found.body, Err(MeshError::Empty));
    assert!(found.components.is_empty());
    let found = survey(&[[f64::NAN; 3]; 3], &[[0, 1, 2]], &()).unwrap();
    assert_eq!((found.unusable, found.components.len()), (1, 0));
}
