//! Time to compute an added-mass tensor, by body and number of triangles.

use criterion::{Criterion, criterion_group, criterion_main};
use langevin_rigid_bake::added_mass::{Options, added_mass};
use langevin_rigid_bake::shapes::Shape;

fn tensors(c: &mut Criterion) {
    let ellipsoid = Shape::Ellipsoid {
        semi_axes: [1.0, 2.0, 4.0],
    };
    let cube = Shape::Box { size: [1.0; 3] };
    let plate = Shape::Box {
        size: [1.0, 0.01, 1.0],
    };
    let mut group = c.benchmark_group("added_mass");
    group.sample_size(10);
    let cases = [
        ("ellipsoid 320", ellipsoid, 320),
        ("ellipsoid 1280", ellipsoid, 1280),
        ("ellipsoid 5120", ellipsoid, 5120),
        ("cube 1200", cube, 1200),
        ("plate 1/100 1020", plate, 1020),
    ];
    for (name, shape, triangles) in cases {
        let mesh = shape.mesh(triangles).expect("a shape of possible size");
        group.bench_function(name, |b| {
            b.iter(|| added_mass(&mesh, &Options::default(), &()).expect("a body"));
        });
    }
    group.finish();
}

criterion_group!(benches, tensors);
criterion_main!(benches);
