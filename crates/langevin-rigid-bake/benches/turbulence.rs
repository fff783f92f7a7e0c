//! Cell updates per second of the whole step of Algorithm 1, in a stream with vortices.

use core::f64::consts::PI;
use core::hint::black_box;

use criterion::{Criterion, Throughput, criterion_group, criterion_main};
use langevin_rigid::turbulence::Turbulence;
use langevin_rigid_bake::turbulence::{
    Boundary, FlowOptions, MacGrid, TurbulentFlow, turbulence_history,
};

fn vortices(cells: [usize; 3]) -> TurbulentFlow {
    let sides = [Boundary::Walls, Boundary::Through, Boundary::Walls];
    let mut grid = MacGrid::new(cells, 1.0 / cells[0] as f64, sides).expect("a grid");
    grid.set_velocity(|[x, y, z]| {
        let (x, y, z) = (PI * x, PI * y, PI * z);
        [
            0.3 * x.sin() * y.cos(),
            1.0 - 0.3 * x.cos() * y.sin(),
            0.1 * z.sin() * x.cos(),
        ]
    });
    TurbulentFlow::new(grid, Turbulence::at_birth(1.0, 1.0 / 32.0)).expect("a flow")
}

fn step(c: &mut Criterion) {
    let mut group = c.benchmark_group("turbulence_step");
    group.sample_size(20);
    for cells in [[32, 32, 8], [32, 32, 16], [32; 3], [64; 3], [128; 3]] {
        group.throughput(Throughput::Elements(cells.iter().product::<usize>() as u64));
        let mut flow = vortices(cells);
        let time_step = flow.grid().cell_size();
        group.bench_function(format!("{}x{}x{}", cells[0], cells[1], cells[2]), |b| {
            b.iter(|| flow.step(black_box(time_step)).expect("a step"));
        });
    }
}

/// The paper's 32 x 32 x 8 table (182 ms there): one transit of the inflow through the box.
fn history(c: &mut Criterion) {
    let options = FlowOptions::new([32, 32, 8], 0.01, 0.81);
    c.bench_function("turbulence_history 32x32x8", |b| {
        b.iter(|| turbulence_history(black_box(&options), &()).expect("a history"));
    });
}

criterion_group!(benches, step, history);
criterion_main!(benches);
