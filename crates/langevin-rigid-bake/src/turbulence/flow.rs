//! One step of Algorithm 1: mean flow, then turbulence.

use langevin_rigid::turbulence::Turbulence;

use super::TurbulenceError;
use super::advection::{Trace, carry_component};
use super::grid::MacGrid;
use super::k_epsilon::KEpsilon;
use super::projection::Projection;

/// A mean flow with its turbulence, stepped in time.
///
/// ```
/// use langevin_rigid::turbulence::Turbulence;
/// use langevin_rigid_bake::turbulence::{Boundary, MacGrid, TurbulentFlow, decayed};
/// let mut grid = MacGrid::new([4, 20, 4], 0.1, [Boundary::Walls, Boundary::Through, Boundary::Walls])?;
/// grid.set_velocity(|_| [0.0, 10.0, 0.0]);
/// let inflow = Turbulence { k: 1.0, epsilon: 7.5 };
/// let mut flow = TurbulentFlow::new(grid, inflow)?;
/// for _ in 0..30 {
///     flow.step(0.01)?;
/// }
/// // Steady by now: what is 1 m above the inflow is 0.1 s old.
/// let above = flow.turbulence().at([0.2, 1.0, 0.2]);
/// let expected = decayed(inflow, 0.1);
/// assert!((above.k - expected.k).abs() < 1e-12);
/// assert!((above.epsilon - expected.epsilon).abs() < 1e-12);
/// # Ok::<(), langevin_rigid_bake::turbulence::TurbulenceError>(())
/// ```
#[derive(Debug, Clone)]
pub struct TurbulentFlow {
    grid: MacGrid,
    turbulence: KEpsilon,
    projection: Projection,
    trace: Trace,
    next: [Vec<f64>; 3],
    time: f64,
}

impl TurbulentFlow {
    /// A flow that starts from the velocity of `grid`, made free of divergence, and from uniform
    /// turbulence, which is also that of the inflow.
    ///
    /// # Errors
    ///
    /// `k` or `epsilon` not positive and finite, or a velocity that is not finite.
    pub fn new(mut grid: MacGrid, turbulence: Turbulence) -> Result<Self, TurbulenceError> {
        let Turbulence { k, epsilon } = turbulence;
        let positive = |x: f64| x > 0.0 && x.is_finite();
        if !(positive(k) && positive(epsilon)) {
            return Err(TurbulenceError::InitialTurbulence { k, epsilon });
        }
        if !grid.is_finite() {
            return Err(TurbulenceError::InitialVelocity);
        }
        let mut projection = Projection::new(&grid);
        projection.project(&mut grid)?;
        Ok(Self {
            turbulence: KEpsilon::new(&grid, turbulence),
            projection,
            trace: Trace::new(grid.lattice),
            next: grid.velocity.clone(),
            grid,
            time: 0.0,
        })
    }

    /// Advances by `dt` seconds: advection, projection, transport and sources of the turbulence.
    ///
    /// Stable for any step; exact for a uniform stream when `dt` is the time it takes to cross a
    /// whole number of cells.
    ///
    /// # Errors
    ///
    /// `dt` not positive and finite; the flow is then left as it was.
    pub fn step(&mut self, dt: f64) -> Result<(), TurbulenceError> {
        if !(dt > 0.0 && dt.is_finite()) {
            return Err(TurbulenceError::TimeStep { time_step: dt });
        }
        self.trace.run(&self.grid, dt);
        for axis in 0..3 {
            carry_component(&self.grid, &self.trace, axis, &mut self.next[axis]);
        }
        self.turbulence.carry(&self.grid, &self.trace);
        core::mem::swap(&mut self.grid.velocity, &mut self.next);
        self.grid.apply_boundaries();
        self.projection.project(&mut self.grid)?;
        self.turbulence.evolve(&self.grid, &self.trace, dt);
        self.time += dt;
        Ok(())
    }

    /// The mean flow.
    pub fn grid(&self) -> &MacGrid {
        &self.grid
    }

    /// The turbulence.
    pub fn turbulence(&self) -> &KEpsilon {
        &self.turbulence
    }

    /// Time since the start (s).
    pub fn time(&self) -> f64 {
        self.time
    }
}

#[cfg(test)]
mod tests {
    use super::super::lattice::Boundary::{Periodic, Through, Walls};
    use super::*;

    const INFLOW: Turbulence = Turbulence {
        k: 1.0,
        epsilon: 2.0,
    };

    #[test]
    fn refuses_what_it_cannot_start_from() {
        let grid = || MacGrid::new([3, 4, 5], 0.1, [Walls, Through, Walls]).unwrap();
        for (k, epsilon) in [
            (0.0, 1.0),
            (1.0, -1.0),
            (f64::NAN, 1.0),
            (1.0, f64::INFINITY),
        ] {
            let error = TurbulentFlow::new(grid(), Turbulence { k, epsilon }).unwrap_err();
            assert!(matches!(error, TurbulenceError::InitialTurbulence { .. }));
        }
        let mut wild = grid();
        wild.set_velocity(|[x, _, _]| [0.0, 1.0 / (x - 0.15).min(0.0), 0.0]);
        let error = TurbulentFlow::new(wild, INFLOW).unwrap_err();
        assert!(matches!(error, TurbulenceError::InitialVelocity));
        let mut flow = TurbulentFlow::new(grid(), INFLOW).unwrap();
        for dt in [0.0, -1.0, f64::NAN, f64::INFINITY] {
            let error = flow.step(dt).unwrap_err();
            assert!(matches!(error, TurbulenceError::TimeStep { .. }));
        }
        assert_eq!(flow.time(), 0.0);
    }

    /// Neither a step of thousands of cells nor points off the map may stop the program.
    #[test]
    fn survives_extreme_steps_and_points() {
        for bounds in [[Walls, Through, Walls], [Periodic; 3]] {
            let mut grid = MacGrid::new([5, 6, 3], 0.1, bounds).unwrap();
            grid.set_velocity(|[x, y, z]| [y - z, 1.0 + x * z, x * y]);
            let mut flow = TurbulentFlow::new(grid, INFLOW).unwrap();
            for dt in [1.0, 1e3, 1e6] {
                flow.step(dt).unwrap();
                let Turbulence { k, epsilon } = flow.turbulence().at([0.2, 0.3, 0.1]);
                assert!(k >= 0.0 && epsilon >= 0.0, "{k} {epsilon}");
            }
            flow.step(1e300).unwrap();
            for x in [f64::NAN, f64::INFINITY, -1e300] {
                let _ = flow.turbulence().at([x, 0.1, x]);
                let _ = flow.grid().velocity_at([x, x, 0.1]);
            }
        }
    }
}
