//! The turbulence stage against closed forms.
//!
//! Decaying turbulence carried by a uniform stream ages with its distance from the inflow; steady
//! shear drives it to the fixed point of the k-epsilon model; Taylor-Green vortices are steady
//! solutions of the Euler equations, of which a semi-Lagrangian scheme loses a part that shrinks
//! with the cell. A failure of the first two is an error in the transport or in its boundary
//! values, of the last in the advection (energy grows: paths curve outwards) or the projection
//! (the pattern turns into another one). No result may depend on the number of threads.

use core::f64::consts::{PI, TAU};

use langevin_rigid::turbulence::{C_MU, Turbulence};
use langevin_rigid_bake::turbulence::{
    Boundary::{self, Periodic, Through, Walls},
    C_1, C_2, FlowOptions, MacGrid, Sampling, TurbulentFlow, decayed, turbulence_history,
};

fn flow(
    cells: [usize; 3],
    cell: f64,
    bounds: [Boundary; 3],
    velocity: impl Fn([f64; 3]) -> [f64; 3],
    (k, epsilon): (f64, f64),
) -> TurbulentFlow {
    let mut grid = MacGrid::new(cells, cell, bounds).expect("a grid");
    grid.set_velocity(velocity);
    TurbulentFlow::new(grid, Turbulence { k, epsilon }).expect("a flow")
}

/// k0 = 1, epsilon0 = 7.5 carried over 1 m at 10 m/s, at steps that cross 0.37 to 2.6 cells.
#[test]
fn decay_in_a_stream_depends_on_the_distance_only() {
    for cfl in [0.37, 1.0, 2.6] {
        let stream = |_| [0.0, 10.0, 0.0];
        let mut flow = flow(
            [3, 24, 2],
            0.05,
            [Walls, Through, Walls],
            stream,
            (1.0, 7.5),
        );
        for _ in 0..(240.0 / cfl) as usize {
            flow.step(cfl * 0.05 / 10.0).unwrap();
        }
        let start = Turbulence {
            k: 1.0,
            epsilon: 7.5,
        };
        for distance in [0.0, 0.01, 0.025, 0.3, 0.77, 1.0, 1.15] {
            let Turbulence { k, epsilon } = flow.turbulence().at([0.07, distance, 0.05]);
            let expected = decayed(start, distance / 10.0);
            assert!(
                (k / expected.k - 1.0).abs() < 1e-13,
                "CFL {cfl}, {distance} m: {k}"
            );
            assert!(
                (epsilon / expected.epsilon - 1.0).abs() < 2e-13,
                "CFL {cfl}, {distance} m"
            );
        }
        let Turbulence { k, epsilon } = flow.turbulence().at([0.07, 1.0, 0.05]);
        assert!((k - 0.565324).abs() < 5e-7 && (epsilon - 2.508832).abs() < 5e-7);
    }
}

/// The history at a fixed point: the box ages, then the inflow has come and nothing changes.
#[test]
fn history_is_decay_and_then_a_plateau() {
    for cells in [[32, 32, 16], [5, 9, 1], [1, 1, 1], [6, 13, 7]] {
        let options = FlowOptions::new(cells, 0.02, 1.7);
        let history = turbulence_history(&options, &()).unwrap();
        assert_eq!(history.k.len(), cells[1] + 1);
        assert_eq!((history.inflow_speed, history.length), (1.7, 0.02));
        let start = Turbulence::at_birth(1.7, 0.02);
        let transit = 0.5 * cells[1] as f64 * options.time_step;
        for (i, (k, epsilon)) in history.k.iter().zip(&history.epsilon).enumerate() {
            let time = i as f64 * options.time_step;
            // At the very moment the front is at the point the cells beside it differ in age.
            if (time - transit).abs() > 1e-9 {
                let expected = decayed(start, time.min(transit));
                assert!((k / expected.k - 1.0).abs() < 1e-13, "{cells:?} entry {i}");
                assert!(
                    (epsilon / expected.epsilon - 1.0).abs() < 2e-13,
                    "{cells:?} entry {i}"
                );
            }
        }
    }
}

/// Eqs. (14)-(18) hold no length but l and no time but l/U0.
#[test]
fn histories_of_two_speeds_and_cell_sizes_are_one() {
    for sampling in [Sampling::Fixed, Sampling::PassiveParticle] {
        let run = |cell: f64, speed: f64| {
            let mut options = FlowOptions::new([4, 10, 4], cell, speed);
            options.sampling = sampling;
            options.duration *= 2.0;
            turbulence_history(&options, &()).unwrap()
        };
        let (a, b) = (run(0.01, 0.8), run(0.3, 11.0));
        assert_eq!(a.k.len(), b.k.len());
        for (k_a, k_b) in a.k.iter().zip(&b.k) {
            assert!((k_a / (0.8 * 0.8) - k_b / (11.0 * 11.0)).abs() < 1e-13);
        }
    }
}

/// Production over dissipation and strain over frequency, where the fixed point has 2.0909, 4.8200.
fn shear_ratios(flow: &TurbulentFlow, point: [f64; 3], shear: f64) -> [f64; 2] {
    let Turbulence { k, epsilon } = flow.turbulence().at(point);
    [C_MU * (k / epsilon * shear).powi(2), shear * k / epsilon]
}

fn assert_fixed_point(ratios: [f64; 2]) {
    let production = (C_2 - 1.0) / (C_1 - 1.0);
    assert!((ratios[0] - production).abs() < 1e-9, "{ratios:?}");
    assert!(
        (ratios[0] - 2.0909).abs() < 5e-5 && (ratios[1] - 4.8200).abs() < 5e-5,
        "{ratios:?}"
    );
}

/// Turbulence in a shear that is the same everywhere, between slip walls, from above and from below.
#[test]
fn homogeneous_shear_reaches_its_fixed_point() {
    for (k, epsilon) in [(1.0, 30.0), (2.0, 0.4)] {
        let shear = 5.0;
        let stream = |[_, y, _]: [f64; 3]| [shear * y, 0.0, 0.0];
        let mut flow = flow(
            [8, 10, 3],
            0.1,
            [Periodic, Walls, Walls],
            stream,
            (k, epsilon),
        );
        let energy = |flow: &TurbulentFlow| flow.turbulence().at([0.3, 0.5, 0.1]).k;
        for _ in 0..400 {
            flow.step(0.03).unwrap();
        }
        for y in [0.05, 0.33, 0.5, 0.95] {
            assert_fixed_point(shear_ratios(&flow, [0.41, y, 0.15], shear));
        }
        // There k grows by (P - epsilon)/k = (P/epsilon - 1) chi.
        let before = energy(&flow);
        flow.step(0.03).unwrap();
        let rate = (energy(&flow) / before).ln() / 0.03;
        assert!(
            (rate - (2.0909 - 1.0) * shear / 4.8200).abs() < 1e-4,
            "{rate}"
        );
        assert!(flow.grid().max_divergence() < 1e-13);
    }
}

/// A sheared inflow is a steady flow; far above the inflow its turbulence is at the fixed point.
#[test]
fn sheared_inflow_is_steady_and_reaches_the_fixed_point_downstream() {
    let shear = 4.0;
    let stream = |[x, _, _]: [f64; 3]| [0.0, 1.0 + shear * x, 0.0];
    let mut flow = flow(
        [6, 256, 2],
        0.1,
        [Walls, Through, Walls],
        stream,
        (1.0, 3.0),
    );
    for _ in 0..400 {
        flow.step(0.1).unwrap();
    }
    for point in [[0.1, 0.0, 0.1], [0.31, 3.3, 0.05], [0.5, 25.0, 0.1]] {
        let [u, v, w] = flow.grid().velocity_at(point);
        let expected = stream(point)[1];
        assert!(u.abs() < 1e-12 && w.abs() < 1e-12 && (v - expected).abs() < 1e-12);
    }
    assert_fixed_point(shear_ratios(&flow, [0.15, 25.5, 0.1], shear));
}

/// What Taylor-Green vortices, steady in an inviscid fluid, lose of their amplitude while the
/// fastest fluid crosses a quarter of the unit box, and the energy found in other patterns.
fn taylor_green_losses(bounds: [Boundary; 3], cells: usize) -> [f64; 2] {
    let vortices = |[x, y, _]: [f64; 3]| {
        let (x, y) = (TAU * x, TAU * y);
        [x.sin() * y.cos(), -x.cos() * y.sin(), 0.0]
    };
    let cell = 1.0 / cells as f64;
    let mut flow = flow([cells, cells, 1], cell, bounds, vortices, (1.0, 1.0));
    let start = project_on(&flow, vortices);
    let mut energy = start[1];
    for _ in 0..cells / 2 {
        flow.step(0.5 * cell).expect("a step");
        let [_, now] = project_on(&flow, vortices);
        assert!(now < energy, "energy grew from {energy} to {now}");
        energy = now;
        assert!(flow.grid().max_divergence() * cell < 4e-15);
    }
    let amplitude = project_on(&flow, vortices)[0] / start[0];
    [1.0 - amplitude, energy / start[1] - amplitude * amplitude]
}

/// Component along `pattern` and kinetic energy, sums over the face centres of the cells.
fn project_on(flow: &TurbulentFlow, pattern: impl Fn([f64; 3]) -> [f64; 3]) -> [f64; 2] {
    let (h, [nx, ny, _]) = (flow.grid().cell_size(), flow.grid().cells());
    let mut sums = [0.0; 2];
    for (i, j) in (0..nx).flat_map(|i| (0..ny).map(move |j| (i as f64, j as f64))) {
        let faces = [
            [i * h, (j + 0.5) * h, 0.5 * h],
            [(i + 0.5) * h, j * h, 0.5 * h],
        ];
        for (axis, point) in faces.into_iter().enumerate() {
            let value = flow.grid().velocity_at(point)[axis];
            sums[0] += value * pattern(point)[axis];
            sums[1] += value * value;
        }
    }
    sums
}

#[test]
fn taylor_green_vortices_fade_with_the_cell_size_and_keep_their_shape() {
    for bounds in [[Periodic; 3], [Walls; 3]] {
        let losses = [16, 32, 64].map(|cells| taylor_green_losses(bounds, cells));
        println!("{bounds:?} {losses:?}");
        for pair in losses.windows(2) {
            let ratio = pair[0][0] / pair[1][0];
            assert!((1.6..2.6).contains(&ratio), "{losses:?}");
        }
        // Linear interpolation adds a viscosity of at most h^2/(8 dt) = h/4 in each direction.
        for (cells, [amplitude, others]) in [16.0, 32.0, 64.0].into_iter().zip(losses) {
            let most = 1.0 - f64::exp(-2.0 * TAU * TAU * 0.25 / cells * 0.25);
            assert!(amplitude < most && others < 0.01 / cells, "{losses:?}");
        }
    }
}

/// Vortices in the stream of the box: everything is in play, and no bit may depend on the threads.
#[test]
fn bits_do_not_depend_on_the_number_of_threads() {
    let stream = |[x, y, z]: [f64; 3]| {
        let (x, y, z) = (PI * x, PI * y, PI * z);
        [
            0.5 * x.sin() * y.cos(),
            1.0 - 0.5 * x.cos() * y.sin(),
            0.2 * z.sin() * x.cos(),
        ]
    };
    let run = || {
        let mut flow = flow(
            [19, 23, 14],
            0.1,
            [Walls, Through, Periodic],
            stream,
            (0.3, 0.7),
        );
        for _ in 0..10 {
            flow.step(0.07).unwrap();
        }
        let mut bits = Vec::new();
        for n in 0..2000 {
            let point = [7, 11, 13].map(|p| f64::from(n * p % 199) / 199.0 * 2.0);
            let Turbulence { k, epsilon } = flow.turbulence().at(point);
            assert!(k > 0.0 && epsilon > 0.0);
            let [u, v, w] = flow.grid().velocity_at(point);
            bits.extend([k, epsilon, u, v, w].map(f64::to_bits));
        }
        bits
    };
    let on = |threads: usize| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.unwrap().install(run)
    };
    let one = on(1);
    assert_eq!(one, on(2));
    assert_eq!(one, on(5));
}
