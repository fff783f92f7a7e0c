use super::*;
use crate::shapes::Shape;

fn wrapped(mesh: &TriMesh, size: f64) -> TriMesh {
    wrap(mesh.vertices(), mesh.triangles(), size).unwrap().body
}

#[test]
fn a_ball_and_a_box_keep_their_volume() {
    let ball = Shape::Ellipsoid {
        semi_axes: [1.0; 3],
    }
    .mesh(1280)
    .unwrap();
    let brick = Shape::Box {
        size: [2.0, 1.0, 0.5],
    }
    .mesh(12)
    .unwrap();
    for mesh in [ball, brick] {
        let wrap = wrapped(&mesh, 0.05);
        let bias = wrap.volume() / mesh.volume() - 1.0;
        assert!(bias.abs() < 0.01, "{bias}");
    }
}
