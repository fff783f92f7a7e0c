//! The k-epsilon model without diffusion, Eqs. (14)-(18), transported so that it is exact and
//! positive for any step.
//!
//! Along the path of the fluid, with the strain `s2 = 2 sum S_ij^2` of the mean flow held over a
//! step, (14)-(17) close in the time scale of the turbulence, `tau = k/epsilon = 1/chi`:
//!
//! ```text
//! k'   = k (C_mu s2 tau - 1/tau)          tau' = (C2 - 1) - (C1 - 1) C_mu s2 tau^2
//! ```
//!
//! The second is a Riccati equation with a closed solution. With `theta = sqrt((C1-1)(C2-1) C_mu s2)`
//! and `g = cosh(theta t) + (C1-1) C_mu s2 tau0 sinh(theta t)/theta`:
//!
//! ```text
//! tau  = (tau0 cosh(theta t) + (C2-1) sinh(theta t)/theta) / g
//! ln q = ln q0 + (1/(C1-1) - 1/(C2-1)) ln g          q = k (tau/tau_in)^(1/(C2-1))
//! ```
//!
//! `q` is the energy with its decay undone: a constant of decay without production, where `tau`
//! grows by `(C2-1) t`. The grid carries `tau` and `ln q`. Both are linear in age, in decay and at
//! the fixed point of shear alike, so that linear interpolation between cells smears neither; there
//! is nothing to keep positive by hand; and a cell without strain costs one addition.

use langevin_rigid::turbulence::{C_MU, Turbulence};
use rayon::prelude::*;
use wide::f64x4;

use super::advection::Trace;
use super::grid::MacGrid;
use super::lanes::{LANES, ln, load, store};
use super::sampler::Sampler;

/// Production constant of Eq. (17).
pub const C_1: f64 = 1.44;
/// Decay constant of Eq. (17).
pub const C_2: f64 = 1.92;

/// Turbulence after it has decayed for `time` (s) with no production:
/// `k0 (1 + (C2-1) chi0 t)^(-1/(C2-1))`, and `epsilon` the same with the power `-C2/(C2-1)`.
///
/// ```
/// use langevin_rigid::turbulence::Turbulence;
/// use langevin_rigid_bake::turbulence::decayed;
/// let old = decayed(Turbulence { k: 1.0, epsilon: 7.5 }, 0.1);
/// assert!((old.k - 0.565324).abs() < 1e-6 && (old.epsilon - 2.508832).abs() < 1e-6);
/// ```
pub fn decayed(start: Turbulence, time: f64) -> Turbulence {
    let growth = 1.0 + (C_2 - 1.0) * time * start.frequency();
    let left = libm::pow(growth, -1.0 / (C_2 - 1.0));
    Turbulence {
        k: start.k * left,
        epsilon: start.epsilon * left / growth,
    }
}

/// The turbulence of a flow: `k` and `epsilon` at the centres of the cells.
#[derive(Debug, Clone)]
pub struct KEpsilon {
    cell: f64,
    sampler: Sampler,
    inflow: Turbulence,
    /// Time scale `k/epsilon` (s).
    time_scale: Vec<f64>,
    /// Logarithm of the energy with its decay undone over that of the inflow.
    log_energy: Vec<f64>,
    /// The same two on the inflow face.
    inflow_planes: [Vec<f64>; 2],
    next: [Vec<f64>; 2],
}

impl KEpsilon {
    /// Uniform turbulence, positive, on `grid`; it is also that of the inflow.
    pub(crate) fn new(grid: &MacGrid, inflow: Turbulence) -> Self {
        let (values, plane) = (grid.lattice.len(), grid.lattice.inflow_len());
        let scale = inflow.k / inflow.epsilon;
        Self {
            cell: grid.cell,
            sampler: Sampler::of_centres(&grid.lattice),
            inflow,
            time_scale: vec![scale; values],
            log_energy: vec![0.0; values],
            inflow_planes: [vec![scale; plane], vec![0.0; plane]],
            next: [vec![scale; values], vec![0.0; values]],
        }
    }

    /// Turbulence at a point (m); outside of the domain, that of the nearest point in it.
    pub fn at(&self, point: [f64; 3]) -> Turbulence {
        let position = point.map(|x| f64x4::splat(x / self.cell));
        let stencil = self.sampler.stencil(position);
        let [scale, log_energy] = [&self.time_scale, &self.log_energy]
            .map(|f| self.sampler.read(f, stencil).to_array()[0]);
        let Turbulence { k, epsilon } = self.inflow;
        let decay = libm::pow(scale * epsilon / k, -1.0 / (C_2 - 1.0));
        let k = k * libm::exp(log_energy) * decay;
        Turbulence {
            k,
            epsilon: k / scale,
        }
    }

    /// Carries the turbulence along the paths of a step.
    pub(crate) fn carry(&mut self, grid: &MacGrid, trace: &Trace) {
        let (lattice, length) = (grid.lattice, grid.lattice.row());
        let [scale, log_energy] = &mut self.next;
        let from = [&self.time_scale, &self.log_energy];
        scale
            .par_chunks_exact_mut(length)
            .zip(log_energy.par_chunks_exact_mut(length))
            .enumerate()
            .for_each(|(row, (scale, log_energy))| {
                if let Some([j, k]) = lattice.row_of_cells(row) {
                    let n = lattice.cells[0];
                    for i in (0..n).step_by(LANES) {
                        let feet = trace.feet_of_cells([i, j, k], row * length + i + 1);
                        let stencil = self.sampler.stencil(feet);
                        store(&mut scale[..=n], i + 1, self.sampler.read(from[0], stencil));
                        store(
                            &mut log_energy[..=n],
                            i + 1,
                            self.sampler.read(from[1], stencil),
                        );
                    }
                }
            });
        core::mem::swap(&mut self.time_scale, &mut self.next[0]);
        core::mem::swap(&mut self.log_energy, &mut self.next[1]);
    }

    /// Production and decay over `dt` seconds in the mean flow of `grid`.
    pub(crate) fn evolve(&mut self, grid: &MacGrid, trace: &Trace, dt: f64) {
        let (lattice, length) = (grid.lattice, grid.lattice.row());
        self.time_scale
            .par_chunks_exact_mut(length)
            .zip(self.log_energy.par_chunks_exact_mut(length))
            .enumerate()
            .for_each_init(
                || vec![0.0; lattice.cells[0] + LANES],
                |strain, (row, (scale, log_energy))| {
                    if let Some([j, _]) = lattice.row_of_cells(row) {
                        let (n, first) = (lattice.cells[0], row * length + 1);
                        strain_of_row(grid, first, &mut strain[..n]);
                        for i in (0..n).step_by(LANES) {
                            let time = f64x4::splat(dt) * trace.time_inside(first + i, j);
                            let fields = [&mut scale[1..=n], &mut log_energy[1..=n]];
                            evolve_cells(fields, i, load(strain, i), time);
                        }
                    }
                },
            );
        for axis in 0..3 {
            lattice.fill_layer(&mut self.time_scale, axis, &self.inflow_planes[0]);
            lattice.fill_layer(&mut self.log_energy, axis, &self.inflow_planes[1]);
        }
    }
}

/// Evolves the cells of a row from `i` on.
#[inline(always)]
fn evolve_cells([scale, log_energy]: [&mut [f64]; 2], i: usize, strain: f64x4, time: f64x4) {
    if i + LANES <= scale.len() {
        let (evolved, growth) = evolved(load(scale, i), strain, time);
        store(scale, i, evolved);
        store(log_energy, i, load(log_energy, i) + growth);
        return;
    }
    let mut lanes = [1.0; LANES];
    lanes
        .iter_mut()
        .zip(&scale[i..])
        .for_each(|(lane, value)| *lane = *value);
    let (evolved, growth) = evolved(f64x4::new(lanes), strain, time);
    store(scale, i, evolved);
    for (log_energy, growth) in log_energy[i..].iter_mut().zip(growth.to_array()) {
        *log_energy += growth;
    }
}

/// `2 sum S_ij^2` (1/s^2) at the centres of a row of cells, the first one at index `first`, by
/// central differences.
fn strain_of_row(grid: &MacGrid, first: usize, strain: &mut [f64]) {
    let (n, strides) = (strain.len(), grid.lattice.strides);
    let row = |a: usize, at: usize| &grid.velocity[a][at..][..n];
    let inverse = 1.0 / grid.cell;
    strain.fill(0.0);
    for a in 0..3 {
        let (low, high) = (row(a, first), row(a, first + strides[a]));
        for i in 0..n {
            let stretch = (high[i] - low[i]) * inverse;
            strain[i] += 2.0 * (stretch * stretch);
        }
        // Slopes across, from the faces on both sides of the cells.
        let b = (a + 1) % 3;
        let around = |a: usize, across: usize| {
            let (above, below) = (first + strides[across], first - strides[across]);
            let [p, q] = [row(a, above), row(a, above + strides[a])];
            [p, q, row(a, below), row(a, below + strides[a])]
        };
        let ([c, d, e, f], [p, q, r, s]) = (around(a, b), around(b, a));
        for i in 0..n {
            let slope_a = (c[i] + d[i]) - (e[i] + f[i]);
            let slope_b = (p[i] + q[i]) - (r[i] + s[i]);
            let shear = (slope_a + slope_b) * (0.25 * inverse);
            strain[i] += shear * shear;
        }
    }
}

/// Time scale, and growth of the logarithm of the undecayed energy, after `time` in a constant
/// strain `2 sum S_ij^2`.
#[inline(always)]
fn evolved(scale: f64x4, strain: f64x4, time: f64x4) -> (f64x4, f64x4) {
    let decay = f64x4::splat(C_2 - 1.0) * time;
    let production = f64x4::splat((C_1 - 1.0) * C_MU) * strain * time;
    let square = production * decay;
    if square == f64x4::splat(0.0) {
        return (scale + decay, f64x4::splat(0.0));
    }
    let (cosh, sinhc, log_factor) = cosh_sinhc(square);
    let growth = cosh + production * scale * sinhc;
    let power = f64x4::splat(1.0 / (C_1 - 1.0) - 1.0 / (C_2 - 1.0));
    let scale = (scale * cosh + decay * sinhc) / growth;
    (scale, power * (log_factor + ln(growth)))
}

/// `cosh(x)` and `sinh(x)/x` from `x^2`, both over a factor whose logarithm comes third.
#[inline(always)]
fn cosh_sinhc(square: f64x4) -> (f64x4, f64x4, f64x4) {
    // Taylor series up to x = 1/2: the terms left out are below the last digit.
    let one = f64x4::splat(1.0);
    let (mut cosh, mut sinhc) = (one, one);
    for n in (1..=7).rev() {
        let even = f64::from(2 * n);
        cosh = one + cosh * square * f64x4::splat(1.0 / (even * (even - 1.0)));
        sinhc = one + sinhc * square * f64x4::splat(1.0 / (even * (even + 1.0)));
    }
    let squares = square.to_array();
    if squares.iter().all(|square| *square <= 0.25) {
        return (cosh, sinhc, f64x4::splat(0.0));
    }
    let (mut cosh, mut sinhc, mut factor) = (cosh.to_array(), sinhc.to_array(), [0.0; LANES]);
    for (lane, square) in squares.into_iter().enumerate() {
        if square > 0.25 {
            // The factor exp(x) keeps any strain and any step within range.
            let x = libm::sqrt(square);
            let fall = libm::exp(-2.0 * x);
            (cosh[lane], sinhc[lane]) = (0.5 * (1.0 + fall), 0.5 * (1.0 - fall) / x);
            factor[lane] = x;
        }
    }
    (f64x4::new(cosh), f64x4::new(sinhc), f64x4::new(factor))
}

#[cfg(test)]
mod tests {
    use super::*;

    const POWER: f64 = 1.0 / (C_2 - 1.0);

    /// Time scale and logarithm of the energy of one cell.
    fn one_cell(scale: f64, strain: f64, time: f64) -> (f64, f64) {
        let (scale, growth) = evolved(
            f64x4::splat(scale),
            f64x4::splat(strain),
            f64x4::splat(time),
        );
        (scale.to_array()[1], growth.to_array()[1])
    }

    /// Closed solution for `(k, epsilon)`, the reference time scale being the initial one.
    fn closed((k, epsilon): (f64, f64), strain: f64, time: f64) -> (f64, f64) {
        let (scale, growth) = one_cell(k / epsilon, strain, time);
        let k = k * libm::exp(growth) * libm::pow(scale * epsilon / k, -POWER);
        (k, k / scale)
    }

    /// Eqs. (14)-(17) along a path, as printed.
    fn rates([k, epsilon]: [f64; 2], strain: f64) -> [f64; 2] {
        let g = C_MU * k * k / epsilon * strain;
        [g - epsilon, epsilon / k * (C_1 * g - C_2 * epsilon)]
    }

    fn runge_kutta(mut state: [f64; 2], strain: f64, time: f64) -> [f64; 2] {
        let steps = 4000;
        let h = time / f64::from(steps);
        let add = |s: [f64; 2], r: [f64; 2], h: f64| [s[0] + h * r[0], s[1] + h * r[1]];
        for _ in 0..steps {
            let a = rates(state, strain);
            let b = rates(add(state, a, 0.5 * h), strain);
            let c = rates(add(state, b, 0.5 * h), strain);
            let d = rates(add(state, c, h), strain);
            for i in 0..2 {
                state[i] += h / 6.0 * (a[i] + 2.0 * b[i] + 2.0 * c[i] + d[i]);
            }
        }
        state
    }

    #[test]
    fn closed_solution_is_that_of_the_printed_equations() {
        for (strain, time) in [
            (0.0, 0.3),
            (1.0, 0.5),
            (400.0, 0.2),
            (30.0, 1.5),
            (1e-8, 0.1),
        ] {
            let (k, epsilon) = closed((1.3, 5.0), strain, time);
            let expected = runge_kutta([1.3, 5.0], strain, time);
            assert!((k / expected[0] - 1.0).abs() < 1e-11, "{strain} {time}");
            assert!(
                (epsilon / expected[1] - 1.0).abs() < 1e-11,
                "{strain} {time}"
            );
        }
    }

    #[test]
    fn without_strain_it_is_the_closed_form_of_decay() {
        for time in [1e-6, 0.01, 0.1, 1.0, 50.0] {
            let (k, epsilon) = closed((1.0, 7.5), 0.0, time);
            let start = Turbulence {
                k: 1.0,
                epsilon: 7.5,
            };
            let expected = decayed(start, time);
            assert!((k / expected.k - 1.0).abs() < 2e-15);
            assert!((epsilon / expected.epsilon - 1.0).abs() < 2e-15);
        }
    }

    #[test]
    fn one_long_step_is_many_short_ones() {
        for strain in [0.0, 3.0, 2e4, 1e6] {
            let (mut scale, mut growth) = (0.2, 0.0);
            for _ in 0..100 {
                let step = one_cell(scale, strain, 0.01);
                (scale, growth) = (step.0, growth + step.1);
            }
            let once = one_cell(0.2, strain, 1.0);
            assert!((scale / once.0 - 1.0).abs() < 1e-12);
            assert!(
                (growth - once.1).abs() < 1e-12 * once.1.max(1.0),
                "{growth} {}",
                once.1
            );
        }
    }

    #[test]
    fn any_step_keeps_it_positive_and_finite() {
        for strain in [0.0, 1e-300, 1e-12, 1.0, 1e6, 1e12] {
            for time in [1e-9, 1e-3, 0.1, 1.0, 1e3] {
                for scale in [1e-9, 1.0, 1e9] {
                    let (scale, growth) = one_cell(scale, strain, time);
                    assert!(scale > 0.0 && scale.is_finite());
                    assert!(growth >= 0.0 && growth.is_finite());
                }
            }
        }
    }

    #[test]
    fn hyperbolic_functions_agree_with_the_library_on_both_sides_of_the_series() {
        for square in [0.01, 0.2, 0.25, 0.2500001, 1.0, 9.0_f64] {
            let (cosh, sinhc, factor) = cosh_sinhc(f64x4::new([square, 0.5, 0.0, 2.0]));
            let x = square.sqrt();
            let scaled = |value: f64x4| value.to_array()[0] * libm::exp(factor.to_array()[0]);
            assert!(
                (scaled(cosh) / libm::cosh(x) - 1.0).abs() < 6e-16,
                "{square}"
            );
            assert!(
                (scaled(sinhc) / (libm::sinh(x) / x) - 1.0).abs() < 6e-16,
                "{square}"
            );
        }
    }
}
