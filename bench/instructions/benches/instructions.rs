//! Instructions of the hot paths: a regression shows on any machine, however busy.
//!
//! The limits are the counts at the last change that meant to alter them, plus five percent. A change
//! that needs more says why and raises its limit.

use std::hint::black_box;

use gungraun::prelude::*;
use gungraun::{Callgrind, EventKind};
use langevin_rigid::{Batch, Body, Fluid, Model, NoiseStream, Settings, State, Stepper};
use langevin_rigid_bake::TriMesh;
use langevin_rigid_bake::added_mass::{Options, added_mass};
use langevin_rigid_bake::body::{BodySpec, bake_body};
use langevin_rigid_bake::shapes::Shape;
use langevin_rigid_bake::turbulence::{Boundary, MacGrid, Projection};

const STEPS: u32 = 100;
const BODIES: u32 = 64;

fn ellipsoid(triangles: usize) -> TriMesh {
    let shape = Shape::Ellipsoid {
        semi_axes: [0.01, 0.02, 0.04],
    };
    shape.mesh(triangles).unwrap()
}

fn stepper(model: Model) -> Stepper {
    alone();
    let spec = BodySpec {
        density: Some(1200.0),
        ..BodySpec::default()
    };
    let (body, _): (Body, _) = bake_body(&ellipsoid(320), &spec, &()).unwrap();
    let settings = Settings {
        model,
        ..Settings::default()
    };
    Stepper::new(&body, &Fluid::WATER, None, &settings).unwrap()
}

/// Threads would be counted by luck: all work on the one that is counted.
fn alone() {
    let pool = rayon::ThreadPoolBuilder::new().num_threads(1);
    pool.use_current_thread().build_global().unwrap();
}

fn many(model: Model) -> (Stepper, Batch) {
    let mut batch = Batch::new(1);
    for _ in 0..BODIES {
        batch.push(&State::default());
    }
    (stepper(model), batch)
}

fn mesh() -> TriMesh {
    alone();
    ellipsoid(320)
}

fn stream() -> (Projection, MacGrid) {
    alone();
    let sides = [Boundary::Walls, Boundary::Through, Boundary::Walls];
    let mut grid = MacGrid::new([32; 3], 1.0 / 32.0, sides).unwrap();
    let turn = std::f64::consts::PI;
    grid.set_velocity(|[x, y, _]| {
        let (x, y) = (turn * x, turn * y);
        [0.3 * x.sin() * y.cos(), 1.0 - 0.3 * x.cos() * y.sin(), 0.0]
    });
    (Projection::new(&grid), grid)
}

/// Fails above the `counted` instructions plus five percent.
fn about(counted: u64) -> LibraryBenchmarkConfig {
    let mut limits = Callgrind::default();
    limits.hard_limits([(EventKind::Ir, counted + counted / 20)]);
    let mut config = LibraryBenchmarkConfig::default();
    config.tool(limits);
    config
}

// 100 steps of one body.
#[library_benchmark]
#[bench::consistent(args = (Model::Consistent), setup = stepper, config = about(350_435))]
#[bench::separated(args = (Model::Separated), setup = stepper, config = about(853_342))]
fn step(stepper: Stepper) -> State {
    let mut state = State::default();
    for _ in 0..STEPS {
        let noise = NoiseStream { seed: 1, body: 0 };
        stepper
            .step(black_box(&mut state), 5e-3, &noise.into())
            .unwrap();
    }
    state
}

// 100 steps of each of 64 bodies, in the lanes that valgrind knows: four of doubles.
#[library_benchmark]
#[bench::consistent(args = (Model::Consistent), setup = many, config = about(6_729_683))]
#[bench::separated(args = (Model::Separated), setup = many, config = about(15_078_993))]
fn step_batch((stepper, mut batch): (Stepper, Batch)) -> Batch {
    for _ in 0..STEPS {
        stepper.step_batch(black_box(&mut batch), 5e-3).unwrap();
    }
    batch
}

// Added mass at 320 triangles, of which the panel integrals are nine tenths.
#[library_benchmark]
#[bench::ellipsoid(args = (), setup = mesh, config = about(58_854_896))]
fn panels(mesh: TriMesh) -> f64 {
    let options = Options {
        target_triangles: 320,
        ..Options::default()
    };
    added_mass(black_box(&mesh), &options, &()).unwrap().tensor[0][0]
}

// One projection on 32^3 cells.
#[library_benchmark]
#[bench::stream(args = (), setup = stream, config = about(9_928_506))]
fn project((mut projection, mut grid): (Projection, MacGrid)) -> f64 {
    projection.project(black_box(&mut grid)).unwrap();
    grid.max_divergence()
}

library_benchmark_group!(
    name = hot_paths,
    benchmarks = [step, step_batch, panels, project]
);
main!(library_benchmark_groups = hot_paths);
